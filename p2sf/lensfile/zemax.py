"""Zemax .zmx prescriptions: one keyword a line, surface lines indented under SURF n (OpticStudio manual, "ZMX").

Surface numbers are the file's: SURF 0 is the object, the last SURF the image, so SURF 1 is surface 1.
"""

from dataclasses import dataclass, field
from math import inf

from p2sf.lens.lens import Lens
from p2sf.lensfile import zemax as zemaxwords
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook, note_vignetting
from p2sf.lensfile.source_text import LensText, number, whole

REFUSED_TYPES = {
    "TOROIDAL": "a toroid that is not round",
    "BICONICX": "a surface that is not round",
    "BICONICZ": "a surface that is not round",
    "IRREGULA": "a surface that is not round",
    "DGRATING": "a grating that diffracts",
    "BINARY_1": "a diffractive surface",
    "BINARY_2": "a diffractive surface",
    "BINARY_3": "a diffractive surface",
    "PARAXIAL": "an ideal lens without a prescription",
    "PARAX_XY": "an ideal lens without a prescription",
    "NONSEQCO": "a non-sequential part",
    "BLACKBOX": "a black box that hides its surfaces",
    "BLCKBOX1": "a black box that hides its surfaces",
    "ODDASPHE": "an asphere with odd powers",
    "QED_TYPE": "an asphere in Forbes's polynomials",
    "XOSPHERE": "an extended odd asphere",
    "XASPHERE": "an extended asphere",
    "FRESNELS": "a Fresnel surface",
    "GRINSUR1": "a gradient index",
    "ALTERNAT": "the root of the sphere on its other side",
}

HARMLESS = {
    "drawing and editor settings": "MIRR HIDE SLAB PICB BLNK LANG PUSH SDMA OMMA MEMA OEMA DRAW CBOR COLR ECON",
    "tolerances and merit function": "TOL TOLE MOFF DMFS OPDX EFLY EFFL REAY REAX TRAC MNCA MNEA MNCG MNEG MXCA MXCG "
    "TCMM PMAG TOTR TCED RGLA WFNO GLCB ACOS ISNA DBDT",
    "coatings, polarisation, scatter": "COAT COFN POLS FIMP FLAP PFIL GFAC",
    "computing settings": "VERS GSTD NSCD RAIM ROPD POPS PUPD CONF HYPR RCMF ENVD GLRS XDAT YDAT SCBD AUTH NOTE",
    "variables, pickups and solves, whose stored values are read": "VCON VDSZ VPAR PPAR PKUP PZUP MAZH EDGE VCUR SOLV",
    "weights of fields and wavelengths": "FWGN FWGT WWGT WWGN WAVN",
}
REASON = {keyword: reason for reason, keywords in HARMLESS.items() for keyword in keywords.split()}
VIGNETTING = ("VDXN", "VDYN", "VCXN", "VCYN", "VANN", "ZVDX", "ZVDY", "ZVCX", "ZVCY", "ZVAN")
RIMS = ("SQAP", "RECA", "ELAP", "SPID", "UDAD", "USAP")


def note(notes: Notebook, words: list[str], surface: int | None, line: int) -> None:
    """Note a keyword that is not read: harmless ones once per reason, rims and unknown ones by name."""
    keyword = words[0].upper()
    if keyword in REASON:
        notes.add("ignored", REASON[keyword])
    elif keyword in VIGNETTING:
        note_vignetting(notes, words[1:])
    elif keyword in RIMS:
        notes.add("caution", f"its rim ({keyword}) is not round; the round semi-diameter stands in", surface, line)
    else:
        notes.add("ignored", f"{keyword[:20]}, which is not known to describe the lens", None, line)


UNITS_MM = {"MM": 1.0, "CM": 10.0, "M": 1000.0, "METER": 1000.0, "METERS": 1000.0, "IN": 25.4, "INCH": 25.4}
APERTURES = {"ENPD": "entrance_pupil_diameter", "FNUM": "f_number", "OBNA": "object_na", "FLOA": "stop_semi_diameter"}
FIELD_KINDS = ("angle", "object_height", "image_height", "real_image_height")
# Placeholders OpticStudio leaves beside a catalogue glass; they say nothing about it.
PLACEHOLDERS = ((1.5, 40.0), (0.0, 0.0))


@dataclass
class Reading:
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

    def number(self, words: list[str], place: int, what: str, default: float | None = None) -> float:
        """Return the number at a place of the line; a missing one is ``default``, or an error where there is none."""
        if place >= len(words):
            if default is not None:
                return default
            raise self.source.error(f"{words[0] if words else 'line'}: {what} is missing; complete the line", self.line)
        return number(words[place], what, self.source, self.line)

    def refuse(self, why: str) -> None:
        """Raise LensFileError about the current surface, by number and name."""
        raise self.source.error(f"{self.surface.name} {why}", self.line)


def _mode(reading: Reading, words: list[str]) -> None:
    if len(words) > 1 and words[1].upper() != "SEQ":
        raise reading.source.error(f"mode {words[1]} is not sequential; export the sequential lens", reading.line)


def _unit(reading: Reading, words: list[str]) -> None:
    unit = words[1].upper() if len(words) > 1 else ""
    if unit not in UNITS_MM:
        raise reading.source.error(f'lens unit "{unit[:20]}" is none of MM, CM, IN, M; correct it', reading.line)
    reading.raw.unit_mm = UNITS_MM[unit]


def _aperture(reading: Reading, words: list[str]) -> None:
    kind = APERTURES[words[0].upper()]
    reading.raw.aperture_line = reading.line
    if kind == "stop_semi_diameter":
        reading.raw.aperture = (kind, 0.0)  # the stop's own DIAM, known at the end
        return
    if kind == "f_number" and reading.number(words, 2, "f-number flag", 0.0) == 1:
        kind = "image_f_number"
    value = reading.number(words, 1, "aperture")
    if value > 0 or reading.raw.aperture is None:  # other statements are left in the file as zeros
        reading.raw.aperture = (kind, value)


def _field_type(reading: Reading, words: list[str]) -> None:
    kind = whole(words[1] if len(words) > 1 else "", "field type", reading.source, reading.line)
    if kind not in range(len(FIELD_KINDS)):
        raise reading.source.error(f"field type {kind} is none of 0 to 3; choose angle or height", reading.line)
    reading.raw.field_kind, reading.raw.field_line = FIELD_KINDS[kind], reading.line
    if reading.number(words, 2, "telecentric flag", 0.0):
        text = "the file asks for telecentric object space; chief rays pass the centre of its stop instead"
        reading.notes.add("caution", text, None, reading.line)
    reading.field_count = max(0, int(reading.number(words, 3, "number of fields", 0.0))) or None
    reading.wavelength_count = max(0, int(reading.number(words, 4, "number of wavelengths", 0.0))) or None


def _fields(reading: Reading, words: list[str]) -> None:
    values = [number(word, "field", reading.source, reading.line) for word in words[1:]]
    if words[0][0].upper() == "X":
        reading.x_fields = values
    else:
        reading.y_fields = values


def _wavelength(reading: Reading, words: list[str]) -> None:
    place = whole(words[1] if len(words) > 1 else "", "wavelength number", reading.source, reading.line)
    if place == len(reading.raw.wavelengths_um) + 1:
        _add_wavelength(reading, reading.number(words, 2, "wavelength"))


def _wavelengths(reading: Reading, words: list[str]) -> None:
    reading.raw.wavelengths_um = []
    for place in range(1, len(words)):
        _add_wavelength(reading, reading.number(words, place, "wavelength"))


def _add_wavelength(reading: Reading, value: float) -> None:
    if not 0.05 <= value <= 50:
        raise reading.source.error(f"wavelength {value:g} µm is not light; give micrometres", reading.line)
    reading.raw.wavelengths_um.append(value)
    reading.raw.wavelength_line = reading.line


def _primary(reading: Reading, words: list[str]) -> None:
    reading.raw.primary = (
        whole(words[1] if len(words) > 1 else "", "primary wavelength", reading.source, reading.line) - 1
    )


def _glass_catalogues(reading: Reading, words: list[str]) -> None:
    reading.catalogues = tuple(word.upper() for word in words[1:])


def _configurations(reading: Reading, words: list[str]) -> None:
    count, current = (int(reading.number(words, place, "configuration", 1.0)) for place in (1, 2))
    if count > 1:
        text = f"the file holds {count} configurations; the one its surface lines show, number {current}, is read"
        reading.notes.add("caution", text, None, reading.line)


def begin_surface(reading: Reading, words: list[str]) -> None:
    """Begin surface SURF n, which must be the next one; LensFileError."""
    count = whole(words[1] if len(words) > 1 else "", "surface number", reading.source, reading.line)
    if count != len(reading.surfaces):
        raise reading.source.error(
            f"surface {count} stands where {len(reading.surfaces)} is due; sort them", reading.line
        )
    reading.surfaces.append(RawSurface(count, reading.line))


def _type(reading: Reading, words: list[str]) -> None:
    reading.kinds[reading.surface.number] = kind = words[1].upper() if len(words) > 1 else ""
    if kind not in ("STANDARD", "EVENASPH", "COORDBRK"):
        why = zemaxwords.REFUSED_TYPES.get(kind, "which P2SF does not trace")
        reading.refuse(f"has type {kind or 'nothing'}, {why}; only STANDARD and EVENASPH surfaces are read")


def _curvature(reading: Reading, words: list[str]) -> None:
    reading.surface.curvature = reading.number(words, 1, "curvature")


def _thickness(reading: Reading, words: list[str]) -> None:
    infinite = len(words) > 1 and words[1].upper() in ("INFINITY", "INF", "-INFINITY")
    value = inf if infinite else reading.number(words, 1, "thickness")
    if reading.surface.number and not abs(value) < FAR:
        reading.refuse("has an infinite thickness; give a finite one")
    reading.surface.thickness = value


def _conic(reading: Reading, words: list[str]) -> None:
    reading.surface.conic = reading.number(words, 1, "conic constant")


def _parameter(reading: Reading, words: list[str]) -> None:
    place = whole(words[1] if len(words) > 1 else "", "parameter number", reading.source, reading.line)
    reading.parameters.setdefault(reading.surface.number, {})[place] = reading.number(words, 2, "parameter")


def _stop(reading: Reading, words: list[str]) -> None:
    reading.raw.stop = reading.surface.number


def _semi_diameter(reading: Reading, words: list[str]) -> None:
    value = reading.number(words, 1, "semi-diameter")
    reading.surface.semi_diameter = value if value > 0 else inf


def _clear_rim(reading: Reading, words: list[str]) -> None:
    """Read CLAP inner outer: the outer rim bounds the light; an inner one shades its centre."""
    if reading.number(words, 1, "inner radius", 0.0) > 0:
        reading.notes.add("caution", "its central hole is open here", reading.surface.number, reading.line)
    outer = reading.number(words, 2, "outer radius", 0.0)
    reading.surface.semi_diameter = outer if outer > 0 else reading.surface.semi_diameter


def _obscuration(reading: Reading, words: list[str]) -> None:
    text = "its obscuration is left out, so the picture shows the full aperture"
    reading.notes.add("caution", text, reading.surface.number, reading.line)


def _decentred_rim(reading: Reading, words: list[str]) -> None:
    offset = [reading.number(words, place, "rim offset", 0.0) for place in (1, 2)]
    if any(offset):
        reading.refuse(f"has a rim decentred by ({offset[0]:g}, {offset[1]:g}); only centred lenses are read")


def _glass(reading: Reading, words: list[str]) -> None:
    """Read GLAS name mode pickup nd vd …; mode 1 to 3 with the name ___BLANK is a model glass."""
    name = words[1] if len(words) > 1 else ""
    if name.upper() == "MIRROR":
        reading.refuse("is a mirror; only refracting lenses are read")
    nd, vd = (reading.number(words, place, what, 0.0) for place, what in ((4, "nd"), (5, "vd")))
    beside = None if (nd, vd) in PLACEHOLDERS or not (1.2 < nd < 2.5 and 15 < vd < 100) else (nd, vd)
    if name.upper() == "___BLANK":
        model = {"model": (nd, vd)} if vd else {"index": nd}
        reading.surface.glass = RawGlass(line=reading.line, **model)
        if reading.number(words, 6, "partial dispersion", 0.0):
            text = "the model glass's deviation in partial dispersion is left out; n changes by less than 1e-4"
            reading.notes.add("caution", text, reading.surface.number, reading.line)
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

    Refused by surface number and name: mirrors, gratings, coordinate breaks, toroids, gradients,
    non-sequential parts, black boxes, decentred or non-circular clear rims, and any unknown type.
    """
    reading = Reading(source, notes)
    for reading.line, text in enumerate(source.lines, 1):
        words = text.split()
        if words:
            _read_line(reading, words, text.strip())
    _finish(reading)
    return assemble(reading.raw, sources, notes, source)


def _read_line(reading: Reading, words: list[str], text: str) -> None:
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
        zemaxwords.note(reading.notes, words, reading.surface.number if reading.surfaces else None, reading.line)


def _finish(reading: Reading) -> None:
    """Put together what the order of lines left apart."""
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


def _shape(reading: Reading, surface: RawSurface) -> None:
    """Give an even asphere its terms, and let a coordinate break pass only where it breaks nothing."""
    parameters = reading.parameters.get(surface.number, {})
    kind = reading.kinds.get(surface.number, "STANDARD")
    if kind == "COORDBRK" and any(parameters.values()):
        why = "is a coordinate break (tilt or decentre); only centred lenses are read"
        raise reading.source.error(f"{surface.name} {why}", surface.line)
    if kind == "EVENASPH":
        surface.aspheric = {2 * place: value for place, value in parameters.items() if value}
