"""Zemax .zmx prescriptions: one keyword a line, surface lines indented under SURF n (OpticStudio manual, "ZMX").

Surface numbers are the file's: SURF 0 is the object, the last SURF the image, so SURF 1 is surface 1.
"""

from dataclasses import dataclass, field
from math import inf
from typing import NoReturn

from p2sf.glass.media import MIRROR
from p2sf.lens.lens import Lens
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawApertureKind, RawFieldKind, RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number, whole
from p2sf.messages import Message

REFUSED_TYPES = {
    "TOROIDAL": Message("a toroid that is not round"),
    "BICONICX": Message("a surface that is not round"),
    "BICONICZ": Message("a surface that is not round"),
    "IRREGULA": Message("a surface that is not round"),
    "DGRATING": Message("a grating that diffracts"),
    "BINARY_1": Message("a diffractive surface"),
    "BINARY_2": Message("a diffractive surface"),
    "BINARY_3": Message("a diffractive surface"),
    "PARAXIAL": Message("an ideal lens without a prescription"),
    "PARAX_XY": Message("an ideal lens without a prescription"),
    "NONSEQCO": Message("a non-sequential part"),
    "BLACKBOX": Message("a black box that hides its surfaces"),
    "BLCKBOX1": Message("a black box that hides its surfaces"),
    "ODDASPHE": Message("an asphere with odd powers"),
    "QED_TYPE": Message("an asphere in Forbes's polynomials"),
    "XOSPHERE": Message("an extended odd asphere"),
    "XASPHERE": Message("an extended asphere"),
    "FRESNELS": Message("a Fresnel surface"),
    "GRINSUR1": Message("a gradient index"),
    "ALTERNAT": Message("the root of the sphere on its other side"),
}
UNKNOWN_TYPE = Message("which P2SF does not trace")
HARMLESS = (
    (
        Message("drawing and editor settings"),
        "MIRR HIDE SLAB PICB BLNK LANG PUSH SDMA OMMA MEMA OEMA DRAW CBOR COLR ECON",
    ),
    (
        Message("tolerances and merit function"),
        "TOL TOLE MOFF DMFS OPDX EFLY EFFL REAY REAX TRAC MNCA MNEA MNCG MNEG MXCA MXCG "
        "TCMM PMAG TOTR TCED RGLA WFNO GLCB ACOS ISNA DBDT",
    ),
    (Message("coatings, polarisation, scatter"), "COAT COFN POLS FIMP FLAP PFIL GFAC"),
    (
        Message("computing settings"),
        "VERS GSTD NSCD RAIM ROPD POPS PUPD CONF HYPR RCMF ENVD GLRS XDAT YDAT SCBD AUTH NOTE",
    ),
    (
        Message("variables, pickups and solves, whose stored values are read"),
        "VCON VDSZ VPAR PPAR PKUP PZUP MAZH EDGE VCUR SOLV",
    ),
    (Message("weights of fields and wavelengths"), "FWGN FWGT WWGT WWGN WAVN"),
)
REASON = {keyword: reason for reason, keywords in HARMLESS for keyword in keywords.split()}
VIGNETTING = ("VDXN", "VDYN", "VCXN", "VCYN", "VANN", "ZVDX", "ZVDY", "ZVCX", "ZVCY", "ZVAN")
RIMS = ("SQAP", "RECA", "ELAP", "SPID", "UDAD", "USAP")


def note(notes: Notebook, raw: RawLens, words: list[str], surface: int | None, line: int) -> None:
    """Note a keyword that is not read: harmless ones once per reason, rims and unknown ones by name."""
    keyword = words[0].upper()
    if keyword in REASON:
        notes.add("ignored", REASON[keyword])
    elif keyword in VIGNETTING:
        raw.add_vignetting(words[1:])
    elif keyword in RIMS:
        notes.add(
            "caution",
            "its rim ({keyword}) is not round; the round semi-diameter stands in",
            surface,
            line,
            keyword=keyword,
        )
    else:
        notes.add("ignored", "{name}, which is not known to describe the lens", None, line, name=keyword[:20])


UNITS_MM = {"MM": 1.0, "CM": 10.0, "M": 1000.0, "METER": 1000.0, "METERS": 1000.0, "IN": 25.4, "INCH": 25.4}
APERTURES: dict[str, RawApertureKind] = {
    "ENPD": "entrance_pupil_diameter",
    "FNUM": "f_number",
    "OBNA": "object_na",
    "FLOA": "stop_semi_diameter",
}
FIELD_KINDS: tuple[RawFieldKind, ...] = ("angle", "object_height", "image_height", "real_image_height")
# The nd and vd that OpticStudio writes beside any catalogue glass, whatever its own are.
PLACEHOLDERS = ((1.5, 40.0), (0.0, 0.0))


@dataclass
class ZemaxReading:
    """What has been read so far; surface 0 is the object, the last one the image."""

    source: LensText
    notes: Notebook
    raw: RawLens = field(default_factory=RawLens)
    surfaces: list[RawSurface] = field(default_factory=list)
    catalogues: tuple[str, ...] = ()
    kinds: dict[int, str] = field(default_factory=dict)
    parameters: dict[int, dict[int, float]] = field(default_factory=dict)
    x_fields: list[float] = field(default_factory=list)
    y_fields: list[float] = field(default_factory=list)
    field_count: int | None = None
    wavelength_count: int | None = None
    line: int = 0

    @property
    def surface(self) -> RawSurface:
        """Return the surface the current line belongs to."""
        return self.surfaces[-1]

    def number(self, words: list[str], place: int, what: str | Message, default: float | None = None) -> float:
        """Return the number at a place of the line; LensFileError where it is missing without a ``default``."""
        if place >= len(words):
            if default is not None:
                return default
            raise self.source.error(
                "{keyword}: {what} is missing; complete the line", self.line, keyword=words[0], what=what
            )
        return number(words[place], what, self.source, self.line)

    def refuse(self, template: str, /, **values: object) -> NoReturn:
        """Raise LensFileError about the current surface, which the template calls ``{surface}``."""
        raise self.source.error(template, self.line, surface=self.surface.name, **values)


def _mode(reading: ZemaxReading, words: list[str]) -> None:
    if len(words) > 1 and words[1].upper() != "SEQ":
        raise reading.source.error(
            "mode {mode} is not sequential; export the sequential lens", reading.line, mode=words[1]
        )


def _unit(reading: ZemaxReading, words: list[str]) -> None:
    unit = words[1].upper() if len(words) > 1 else ""
    if unit not in UNITS_MM:
        raise reading.source.error(
            'lens unit "{unit}" is none of MM, CM, IN, M; correct it', reading.line, unit=unit[:20]
        )
    reading.raw.unit_mm = UNITS_MM[unit]


def _aperture(reading: ZemaxReading, words: list[str]) -> None:
    kind = APERTURES[words[0].upper()]
    reading.raw.aperture_line = reading.line
    if kind == "stop_semi_diameter":
        reading.raw.aperture = (kind, 0.0)  # the stop's own DIAM, known at the end
        return
    if kind == "f_number" and reading.number(words, 2, Message("f-number flag"), 0.0) == 1:
        kind = "image_f_number"
    value = reading.number(words, 1, Message("aperture"))
    if value > 0 or reading.raw.aperture is None:  # other statements are left in the file as zeros
        reading.raw.aperture = (kind, value)


def _field_type(reading: ZemaxReading, words: list[str]) -> None:
    kind = whole(words[1] if len(words) > 1 else "", Message("field type"), reading.source, reading.line)
    if kind not in range(len(FIELD_KINDS)):
        raise reading.source.error(
            "field type {kind} is none of 0 to 3; choose angle or height", reading.line, kind=kind
        )
    reading.raw.field_kind, reading.raw.field_line = FIELD_KINDS[kind], reading.line
    if reading.number(words, 2, Message("telecentric flag"), 0.0):
        reading.notes.add(
            "caution",
            "the file asks for telecentric object space; chief rays pass the centre of its stop instead",
            None,
            reading.line,
        )
    reading.field_count = max(0, int(reading.number(words, 3, Message("number of fields"), 0.0))) or None
    reading.wavelength_count = max(0, int(reading.number(words, 4, Message("number of wavelengths"), 0.0))) or None


def _fields(reading: ZemaxReading, words: list[str]) -> None:
    values = [number(word, Message("field"), reading.source, reading.line) for word in words[1:]]
    if words[0][0].upper() == "X":
        reading.x_fields = values
    else:
        reading.y_fields = values


def _wavelength(reading: ZemaxReading, words: list[str]) -> None:
    place = whole(words[1] if len(words) > 1 else "", Message("wavelength number"), reading.source, reading.line)
    if place == len(reading.raw.wavelengths_um) + 1:
        _add_wavelength(reading, reading.number(words, 2, Message("wavelength")))


def _wavelengths(reading: ZemaxReading, words: list[str]) -> None:
    reading.raw.wavelengths_um = []
    for place in range(1, len(words)):
        _add_wavelength(reading, reading.number(words, place, Message("wavelength")))


def _add_wavelength(reading: ZemaxReading, value: float) -> None:
    if not 0.05 <= value <= 50:
        raise reading.source.error(
            "wavelength {wavelength:g} µm is not light; give micrometres", reading.line, wavelength=value
        )
    reading.raw.wavelengths_um.append(value)
    reading.raw.wavelength_line = reading.line


def _primary(reading: ZemaxReading, words: list[str]) -> None:
    reading.raw.primary = (
        whole(words[1] if len(words) > 1 else "", Message("primary wavelength"), reading.source, reading.line) - 1
    )


def _glass_catalogues(reading: ZemaxReading, words: list[str]) -> None:
    reading.catalogues = tuple(word.upper() for word in words[1:])


def _configurations(reading: ZemaxReading, words: list[str]) -> None:
    count, current = (int(reading.number(words, place, Message("configuration"), 1.0)) for place in (1, 2))
    if count > 1:
        reading.notes.add(
            "caution",
            "the file holds {count} configurations; the one its surface lines show, number {current}, is read",
            None,
            reading.line,
            count=count,
            current=current,
        )


def begin_surface(reading: ZemaxReading, words: list[str]) -> None:
    """Begin surface SURF n, which must be the next one; LensFileError."""
    count = whole(words[1] if len(words) > 1 else "", Message("surface number"), reading.source, reading.line)
    if count != len(reading.surfaces):
        raise reading.source.error(
            "surface {number} stands where {due} is due; sort them",
            reading.line,
            number=count,
            due=len(reading.surfaces),
        )
    reading.surfaces.append(RawSurface(count, reading.line))


def _type(reading: ZemaxReading, words: list[str]) -> None:
    reading.kinds[reading.surface.number] = kind = words[1].upper() if len(words) > 1 else ""
    if kind not in ("STANDARD", "EVENASPH", "COORDBRK"):
        reading.refuse(
            "{surface} has type {kind}, {description}; only STANDARD and EVENASPH surfaces are read",
            kind=kind or Message("nothing"),
            description=REFUSED_TYPES.get(kind, UNKNOWN_TYPE),
        )


def _curvature(reading: ZemaxReading, words: list[str]) -> None:
    reading.surface.curvature = reading.number(words, 1, Message("curvature"))


def _thickness(reading: ZemaxReading, words: list[str]) -> None:
    infinite = len(words) > 1 and words[1].upper() in ("INFINITY", "INF", "-INFINITY")
    value = inf if infinite else reading.number(words, 1, Message("thickness"))
    if reading.surface.number and not abs(value) < FAR:
        reading.refuse("{surface} has an infinite thickness; give a finite one")
    reading.surface.thickness = value


def _conic(reading: ZemaxReading, words: list[str]) -> None:
    reading.surface.conic = reading.number(words, 1, Message("conic constant"))


def _parameter(reading: ZemaxReading, words: list[str]) -> None:
    place = whole(words[1] if len(words) > 1 else "", Message("parameter number"), reading.source, reading.line)
    reading.parameters.setdefault(reading.surface.number, {})[place] = reading.number(words, 2, Message("parameter"))


def _stop(reading: ZemaxReading, words: list[str]) -> None:
    reading.raw.stop = reading.surface.number


def _semi_diameter(reading: ZemaxReading, words: list[str]) -> None:
    value = reading.number(words, 1, Message("semi-diameter"))
    reading.surface.semi_diameter = value if value > 0 else inf


def _clear_rim(reading: ZemaxReading, words: list[str]) -> None:
    """Read CLAP inner outer: the outer radius is the rim; an inner one, a central obscuration, is noted."""
    if reading.number(words, 1, Message("inner radius"), 0.0) > 0:
        reading.notes.add("caution", "its central hole is open here", reading.surface.number, reading.line)
    outer = reading.number(words, 2, Message("outer radius"), 0.0)
    reading.surface.semi_diameter = outer if outer > 0 else reading.surface.semi_diameter


def _obscuration(reading: ZemaxReading, words: list[str]) -> None:
    reading.notes.add(
        "caution",
        "its obscuration is left out, so the picture shows the full aperture",
        reading.surface.number,
        reading.line,
    )


def _decentred_rim(reading: ZemaxReading, words: list[str]) -> None:
    offset = [reading.number(words, place, Message("rim offset"), 0.0) for place in (1, 2)]
    if any(offset):
        reading.refuse(
            "{surface} has a rim decentred by ({x:g}, {y:g}); only centred lenses are read", x=offset[0], y=offset[1]
        )


def _glass(reading: ZemaxReading, words: list[str]) -> None:
    """Read GLAS name mode pickup nd vd …; mode 1 to 3 with the name ___BLANK is a model glass."""
    name = words[1] if len(words) > 1 else ""
    if name.upper() == "MIRROR":
        reading.surface.glass = RawGlass(medium=MIRROR, line=reading.line)
        return
    nd, vd = (reading.number(words, place, what, 0.0) for place, what in ((4, "nd"), (5, "vd")))
    beside = None if (nd, vd) in PLACEHOLDERS or not (1.2 < nd < 2.5 and 15 < vd < 100) else (nd, vd)
    if name.upper() == "___BLANK":
        line = reading.line
        reading.surface.glass = RawGlass(model=(nd, vd), line=line) if vd else RawGlass(index=nd, line=line)
        if reading.number(words, 6, Message("partial dispersion"), 0.0):
            reading.notes.add(
                "caution",
                "the model glass's deviation in partial dispersion is left out; n changes by less than 1e-4",
                reading.surface.number,
                line,
            )
    elif name.isdigit() and len(name) == 6:
        reading.surface.glass = RawGlass(model=(1 + int(name[:3]) / 1000, int(name[3:]) / 10), line=reading.line)
    elif name:
        reading.surface.glass = RawGlass(name, beside=beside, line=reading.line)


ON_SURFACE = {
    "TYPE": _type,
    "CURV": _curvature,
    "DISZ": _thickness,
    "CONI": _conic,
    "PARM": _parameter,
    "STOP": _stop,
    "DIAM": _semi_diameter,
    "GLAS": _glass,
    "CLAP": _clear_rim,
    "OBSC": _obscuration,
    "OBDC": _decentred_rim,
}
IN_SYSTEM = {
    "MODE": _mode,
    "UNIT": _unit,
    "FTYP": _field_type,
    "WAVM": _wavelength,
    "WAVL": _wavelengths,
    "PWAV": _primary,
    "GCAT": _glass_catalogues,
    "MNUM": _configurations,
    **dict.fromkeys(APERTURES, _aperture),
    **dict.fromkeys(("XFLN", "YFLN", "XFLD", "YFLD"), _fields),
}


def read_zemax(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a .zmx file; LensFileError with its line for what P2SF does not trace.

    Refused by surface number and name: gratings, coordinate breaks, toroids, gradients,
    non-sequential parts, black boxes, decentred or non-circular clear rims, and any unknown type.
    """
    reading = ZemaxReading(source, notes)
    for reading.line, text in enumerate(source.lines, 1):
        words = text.split()
        if words:
            _read_line(reading, words, text.strip())
    _finish(reading)
    return assemble(reading.raw, sources, notes, source)


def _read_line(reading: ZemaxReading, words: list[str], text: str) -> None:
    keyword = words[0].upper()
    if keyword == "SURF":
        begin_surface(reading, words)
    elif reading.surfaces and keyword in ON_SURFACE:
        ON_SURFACE[keyword](reading, words)
    elif keyword in IN_SYSTEM:
        IN_SYSTEM[keyword](reading, words)
    elif keyword == "NAME":
        reading.raw.title = text[4:].strip().strip('"')
    elif keyword == "COMM" and reading.surfaces:
        reading.surface.label = text[4:].strip()
    else:
        note(reading.notes, reading.raw, words, reading.surface.number if reading.surfaces else None, reading.line)


def _finish(reading: ZemaxReading) -> None:
    """Complete the raw lens once all lines are read."""
    raw = reading.raw
    if len(reading.surfaces) < 3:
        raise reading.source.error("the file holds no surface between object and image", len(reading.source.lines))
    for surface in reading.surfaces:
        if surface.glass and surface.glass.name:
            surface.glass = RawGlass(
                surface.glass.name, reading.catalogues, beside=surface.glass.beside, line=surface.glass.line
            )
        _shape(reading, surface)
    first, *raw.surfaces, image = reading.surfaces
    raw.object_distance, raw.object_glass = first.thickness, first.glass
    if not abs(raw.object_distance) < FAR:
        raw.object_distance = inf
    if image.curvature:
        reading.notes.add(
            "caution", "the image surface is curved in the file; the sensor here is flat", None, image.line
        )
    if raw.stop in (0, image.number):
        raise reading.source.error("the stop is on the object or the image; put it on a surface between", image.line)
    if raw.aperture and raw.aperture[0] == "stop_semi_diameter":
        raw.aperture = None  # float by stop size: the stop's rim, which is what a lens without aperture gets
    if reading.wavelength_count:
        raw.wavelengths_um = raw.wavelengths_um[: reading.wavelength_count]
    longest = max(len(reading.x_fields), len(reading.y_fields))
    count = min(reading.field_count or longest, longest)
    padded = [[*values, *[0.0] * count][:count] for values in (reading.x_fields, reading.y_fields)]
    raw.fields = list(zip(*padded, strict=True))


def _shape(reading: ZemaxReading, surface: RawSurface) -> None:
    """Give an even asphere its terms; LensFileError for a coordinate break that is not all zeros."""
    parameters = reading.parameters.get(surface.number, {})
    kind = reading.kinds.get(surface.number, "STANDARD")
    if kind == "COORDBRK" and any(parameters.values()):
        raise reading.source.error(
            "{surface} is a coordinate break (tilt or decentre); only centred lenses are read",
            surface.line,
            surface=surface.name,
        )
    if kind == "EVENASPH":
        surface.aspheric = {2 * place: value for place, value in parameters.items() if value}
