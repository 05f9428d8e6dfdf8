"""Zemax .zmx prescriptions: one keyword a line, surface lines indented under SURF n (OpticStudio manual, "ZMX").

Surface numbers are the file's: SURF 0 is the object, the last SURF the image, so SURF 1 is surface 1.
"""

import re
from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from math import inf
from typing import Any, NoReturn

from p2sf.conventions import UM_PER_MM
from p2sf.glass.media import MIRROR
from p2sf.lens.anamorphic import Anamorphic, Biconic, Toroid
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.grating import Grating
from p2sf.lens.lens import Lens
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Diffraction, Qbfs, Qcon, RadialPolynomial
from p2sf.lens.tilts import coordinate_break
from p2sf.lensfile.assemble import check_stop
from p2sf.lensfile.configurations import MOST_COLUMNS, Configuration, assemble_all
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.formats.zemax_solves import SOLVES, Solve, SolvedSurfaces, apply_solves
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import (
    PupilEnds,
    RawApertureKind,
    RawFieldKind,
    RawGlass,
    RawLens,
    RawSurface,
    VignettingFactors,
)
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number, whole
from p2sf.messages import Message

REFUSED_TYPES = {
    "BICONICZ": Message("a surface that is not round"),
    "IRREGULA": Message("a surface that is not round"),
    "BINARY_1": Message("a diffractive surface"),
    "BINARY_3": Message("a diffractive surface"),
    "PARAX_XY": Message("an ideal lens that is not round"),
    "NONSEQCO": Message("a non-sequential part"),
    "BLACKBOX": Message("a black box that hides its surfaces"),
    "BLCKBOX1": Message("a black box that hides its surfaces"),
    "FRESNELS": Message("a Fresnel surface"),
    "GRINSUR1": Message("a gradient index"),
    "ALTERNAT": Message("the root of the sphere on its other side"),
}
FREEFORMS: dict[str, type[XYPolynomial] | type[ZernikeStandardSag] | type[ZernikeFringeSag]] = {
    "XPOLYNOM": XYPolynomial,
    "SZERNSAG": ZernikeStandardSag,
    "FZERNSAG": ZernikeFringeSag,
}
ANAMORPHIC: dict[str, type[Anamorphic]] = {shape.zemax[0]: shape for shape in (Biconic, Toroid)}
READ_TYPES = (
    *("STANDARD", "EVENASPH", "ODDASPHE", "XASPHERE", "XOSPHERE", "BINARY_2", "DGRATING", "QED_TYPE", "PARAXIAL"),
    *ANAMORPHIC,
    *FREEFORMS,
)
WITH_EXTRA_DATA = "XASPHERE", "XOSPHERE", "BINARY_2", "QED_TYPE"
MOST_TERMS = 60  # of an extended asphere or a phase
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
    (Message("coatings, polarisation, scatter"), "COAT COFN POLS FIMP FLAP PFIL"),
    (
        Message("computing settings"),
        "VERS WAVN GSTD NSCD ROPD POPS PUPD CONF HYPR RCMF GLRS YDAT AUTH NOTE",
    ),
    (
        Message("variables and solves, whose stored values are read"),
        "VCON VDSZ VPAR PKUP VCUR SOLV",
    ),
    (Message("weights of fields"), "FWGN FWGT"),
)
REASON = {keyword: reason for reason, keywords in HARMLESS for keyword in keywords.split()}
VIGNETTING = ("VDXN", "VDYN", "VCXN", "VCYN", "VANN", "ZVDX", "ZVDY", "ZVCX", "ZVCY", "ZVAN")
RIMS = ("RECA", "ELAP", "SPID", "UDAD", "USAP")


def note(notes: Notebook, words: list[str], surface: int | None, line: int) -> None:
    """Note a keyword that is not read: harmless ones once per reason, rims and unknown ones by name."""
    keyword = words[0].upper()
    if keyword in REASON:
        notes.add("ignored", REASON[keyword])
    elif keyword in RIMS:
        notes.add(
            "caution",
            "its rim ({keyword}) is not round; the round semi-diameter is used instead",
            surface,
            line,
            keyword=keyword,
        )
    else:
        notes.add_unknown(keyword, line)


UNITS_MM = {"MM": 1.0, "CM": 10.0, "M": 1000.0, "METER": 1000.0, "METERS": 1000.0, "IN": 25.4, "INCH": 25.4}
APERTURES: dict[str, RawApertureKind] = {
    "ENPD": "entrance_pupil_diameter",
    "FNUM": "f_number",
    "OBNA": "object_na",  # or, flag 1, the half angle of the cone
    "FLOA": "stop_semi_diameter",
}
FIELD_KINDS: tuple[RawFieldKind, ...] = ("angle", "object_height", "image_height", "real_image_height")


@dataclass(frozen=True)
class Operand:
    """One line of the multi-configuration editor: what it sets, of which surface or number, where, and to what."""

    name: str
    number: int
    configuration: int
    word: str
    line: int
    last: int = 0


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
    extra: dict[int, dict[int, float]] = field(default_factory=dict)
    extra_lines: dict[int, int] = field(default_factory=dict)  # the first of each surface
    x_fields: list[float] = field(default_factory=list)
    y_fields: list[float] = field(default_factory=list)
    field_count: int | None = None
    wavelength_count: int | None = None
    configurations: int = 1
    current: int = 1
    operands: list["Operand"] = field(default_factory=list)
    solves: list[Solve] = field(default_factory=list)
    vignetting: dict[str, list[float]] = field(default_factory=dict)  # VDX, VDY, VCX, VCY and VAN
    vignetting_line: int = 0
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
    if kind == "object_na" and reading.number(words, 2, Message("flag of the aperture"), 0.0) == 1:
        kind = "object_cone_angle"
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
    reading.raw.telecentric = reading.number(words, 2, Message("telecentric flag"), 0.0) != 0
    reading.field_count = max(0, int(reading.number(words, 3, Message("number of fields"), 0.0))) or None
    reading.wavelength_count = max(0, int(reading.number(words, 4, Message("number of wavelengths"), 0.0))) or None


def _fields(reading: ZemaxReading, words: list[str]) -> None:
    values = [number(word, Message("field"), reading.source, reading.line) for word in words[1:]]
    if words[0][0].upper() == "X":
        reading.x_fields = values
    else:
        reading.y_fields = values


def _vignetting(reading: ZemaxReading, words: list[str]) -> None:
    """Read VDXN, VDYN, VCXN, VCYN or VANN: a number for each field. Those with a Z count unless all are 0."""
    values = [number(word, Message("vignetting factor"), reading.source, reading.line) for word in words[1:]]
    reading.vignetting_line = reading.vignetting_line or reading.line
    name = words[0].upper().removeprefix("Z")[:3]
    if any(values) or name not in reading.vignetting:
        reading.vignetting[name] = values


def _wavelength(reading: ZemaxReading, words: list[str]) -> None:
    place = whole(words[1] if len(words) > 1 else "", Message("wavelength number"), reading.source, reading.line)
    if place == len(reading.raw.wavelengths_um) + 1:
        _add_wavelength(reading, reading.number(words, 2, Message("wavelength")))
        reading.raw.weights.append(reading.number(words, 3, Message("weight of a wavelength"), 1.0))


def _weights(reading: ZemaxReading, words: list[str]) -> None:
    reading.raw.weights = [
        number(word, Message("weight of a wavelength"), reading.source, reading.line) for word in words[1:]
    ]


def _aim(reading: ZemaxReading, words: list[str]) -> None:
    """Read RAIM a mode: rays fill the paraxial entrance pupil, 0, or are aimed at the stop, paraxial, 1, or real, 2."""
    mode = reading.number(words, 2, Message("ray aiming"), 0.0)
    reading.raw.aim = "stop" if mode else "paraxial"
    if mode == 1:
        told = "the file aims rays at the paraxial image of the stop; here they are aimed at the stop itself"
        reading.notes.add("caution", told, None, reading.line)


def _apodisation(reading: ZemaxReading, words: list[str]) -> None:
    """Read GFAC kind factor: amplitude exp(−Gρ²) for kind 1, and that of an even source on a plane, cos³, for 2."""
    kind, factor = (reading.number(words, place, Message("apodisation"), 0.0) for place in (1, 2))
    if kind == 1 and factor:
        reading.raw.apodise(factor, reading.source, reading.line)
    elif kind not in (0, 1):
        told = "the pupil's apodisation (GFAC {kind:g}) is left out; its light is even here"
        reading.notes.add("caution", told, None, reading.line, kind=kind)


def _environment(reading: ZemaxReading, words: list[str]) -> None:
    """Read ENVD temperature pressure adjust, °C and atmospheres; indices follow them only where adjust is 1."""
    temperature, pressure, adjust = (
        reading.number(words, place, Message("temperature or pressure"), usual)
        for place, usual in ((1, 20.0), (2, 1.0), (3, 0.0))
    )
    if adjust:
        reading.raw.environment, reading.raw.environment_line = (temperature, pressure), reading.line


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
    reading.configurations, reading.current = (
        max(1, int(reading.number(words, place, Message("number of configurations"), 1.0))) for place in (1, 2)
    )


def _operand(reading: ZemaxReading, text: str) -> None:
    """Read THIC 5 2 12.5 …: operand, surface or number, configuration, value; texts may be in quotation marks.

    The sixth word of IGNM is the last of several surfaces.
    """
    words = re.findall(r'"[^"]*"|\S+', text)
    if len(words) < 4:
        raise reading.source.error("{keyword}: a value is missing; complete the line", reading.line, keyword=words[0])
    place, configuration = (
        whole(word, what, reading.source, reading.line)
        for word, what in ((words[1], Message("surface or number")), (words[2], Message("configuration")))
    )
    name, last = words[0].upper(), place
    if name == "IGNM" and len(words) > 5:
        last = whole(words[5], Message("surface or number"), reading.source, reading.line)
    reading.operands.append(Operand(name, place, configuration, words[3].strip('"'), reading.line, last))


def begin_surface(reading: ZemaxReading, words: list[str]) -> None:
    """Begin surface SURF n, which must be the next one; LensFileError."""
    count = whole(words[1] if len(words) > 1 else "", Message("surface number"), reading.source, reading.line)
    due = len(reading.surfaces)
    if count < due:
        raise reading.source.error(
            "surface {number} is where {due} is expected; sort them", reading.line, number=count, due=due
        )
    if count > due:
        raise reading.source.error(
            "surface {due} is missing before surface {number}; add it, or close the gap in the numbers",
            reading.line,
            number=count,
            due=due,
        )
    reading.surfaces.append(RawSurface(count, reading.line))


def _type(reading: ZemaxReading, words: list[str]) -> None:
    reading.kinds[reading.surface.number] = kind = words[1].upper() if len(words) > 1 else ""
    if kind not in (*READ_TYPES, "COORDBRK"):
        reading.refuse(
            "{surface} has type {kind}, {description}; only the types {known} are read",
            kind=kind or Message("nothing"),
            known=READ_TYPES,
            description=REFUSED_TYPES.get(kind, UNKNOWN_TYPE),
        )


def _curvature(reading: ZemaxReading, words: list[str]) -> None:
    reading.surface.curvature = reading.number(words, 1, Message("curvature"))
    if len(words) > 2:
        _add_solve(reading, words)


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


def _extra(reading: ZemaxReading, words: list[str]) -> None:
    """Read XDAT number value: the extra data of extended aspheres and phases."""
    place = whole(words[1] if len(words) > 1 else "", Message("number of extra data"), reading.source, reading.line)
    reading.extra.setdefault(reading.surface.number, {})[place] = reading.number(words, 2, Message("extra data"))
    reading.extra_lines.setdefault(reading.surface.number, reading.line)


def _stop(reading: ZemaxReading, words: list[str]) -> None:
    reading.raw.stop = reading.surface.number


def _semi_diameter(reading: ZemaxReading, words: list[str]) -> None:
    value = reading.number(words, 1, Message("semi-diameter"))
    reading.surface.semi_diameter = value if value > 0 else inf


def _clear_rim(reading: ZemaxReading, words: list[str]) -> None:
    """Read CLAP inner outer: light passes between the two radii."""
    _inner_radius(reading, reading.number(words, 1, Message("inner radius"), 0.0))
    outer = reading.number(words, 2, Message("outer radius"), 0.0)
    reading.surface.semi_diameter = outer if outer > 0 else reading.surface.semi_diameter


def _obscuration(reading: ZemaxReading, words: list[str]) -> None:
    """Read OBSC inner outer: no light passes between the two radii; a ring that is open in its middle is left out."""
    if reading.number(words, 1, Message("inner radius"), 0.0) == 0:
        _inner_radius(reading, reading.number(words, 2, Message("outer radius"), 0.0))
        reading.surface.obscured = True
        return
    reading.notes.add(
        "caution",
        "its obscuration is left out, so the picture shows the full aperture",
        reading.surface.number,
        reading.line,
    )


def _inner_radius(reading: ZemaxReading, radius: float) -> None:
    if radius > 0:
        reading.surface.inner_radius, reading.surface.obscured = radius, False


def _rectangle(reading: ZemaxReading, words: list[str]) -> None:
    """Read SQAP x y, half the sides of a clear rectangle."""
    x, y = (reading.number(words, place, Message("half-width of a rim"), 0.0) for place in (1, 2))
    if x > 0 and y > 0:
        reading.surface.rim = replace(reading.surface.rim or Rim(), half_widths=(x, y))


def _decentred_rim(reading: ZemaxReading, words: list[str]) -> None:
    """Read OBDC x y, the centre of the clear rim or the obscuration."""
    x, y = (reading.number(words, place, Message("rim offset"), 0.0) for place in (1, 2))
    if x or y:
        reading.surface.rim = replace(reading.surface.rim or Rim(), decentre=(x, y))


def _own_tilt(reading: ZemaxReading, words: list[str]) -> None:
    """Refuse a tilt or decentre among a surface's own properties, whose line is not documented; zeros do nothing."""
    if any(re.fullmatch(r"[+-]?\d*\.\d*([eE][+-]?\d+)?", word) and float(word) for word in words[1:]):
        reading.refuse("{surface} is tilted or decentred by its properties (SCBD); give coordinate breaks instead")


def _glass(reading: ZemaxReading, words: list[str]) -> None:
    """Read GLAS name mode pickup nd vd …; nd and vd count for the name ___BLANK, a model glass, else with consent."""
    name = words[1] if len(words) > 1 else ""
    if name.upper() == "MIRROR":
        reading.surface.glass = RawGlass(medium=MIRROR, line=reading.line)
        return
    if name.upper() == "___BLANK":
        nd, vd = (reading.number(words, place, what, 0.0) for place, what in ((4, "nd"), (5, "vd")))
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
        nd, vd = (reading.number(words, place, what, 0.0) for place, what in ((4, "nd"), (5, "vd")))
        beside = (nd, vd) if nd > 1 and vd > 0 else None
        reading.surface.glass = RawGlass(name, line=reading.line, beside=beside)


ON_SURFACE = {
    "TYPE": _type,
    "CURV": _curvature,
    "DISZ": _thickness,
    "CONI": _conic,
    "PARM": _parameter,
    "XDAT": _extra,
    "STOP": _stop,
    "DIAM": _semi_diameter,
    "GLAS": _glass,
    "CLAP": _clear_rim,
    "OBSC": _obscuration,
    "SQAP": _rectangle,
    "OBDC": _decentred_rim,
    "SCBD": _own_tilt,
}
IN_SYSTEM = {
    "MODE": _mode,
    "UNIT": _unit,
    "FTYP": _field_type,
    "WAVM": _wavelength,
    "WAVL": _wavelengths,
    **dict.fromkeys(("WWGT", "WWGN"), _weights),
    "PWAV": _primary,
    "RAIM": _aim,
    "GFAC": _apodisation,
    "ENVD": _environment,
    "GCAT": _glass_catalogues,
    "MNUM": _configurations,
    **dict.fromkeys(APERTURES, _aperture),
    **dict.fromkeys(VIGNETTING, _vignetting),
    **dict.fromkeys(("XFLN", "YFLN", "XFLD", "YFLD"), _fields),
}


def read_zemax(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a .zmx file; LensFileError with its line for what P2SF does not trace.

    Refused by surface number and name: gradients, non-sequential parts, black boxes, and any unknown type.
    """
    reading = ZemaxReading(source, notes)
    for reading.line, text in enumerate(source.lines, 1):
        words = text.split()
        if words:
            _read_line(reading, words, text.strip())
    _note_unread(reading)
    count = min(reading.configurations, MOST_COLUMNS)
    numbers = _with_same_surfaces(reading, count)
    stated = [_configuration(reading, k, notes if k == numbers[0] else Notebook()) for k in numbers]
    return assemble_all(stated, sources, notes, source)


def _with_same_surfaces(reading: ZemaxReading, count: int) -> Sequence[int]:
    """Return the numbers of all configurations, or of the present one where they do without different surfaces."""
    every = range(1, count + 1)
    gone = {k: [(o.number, o.last) for o in reading.operands if o.configuration == k and _ignores(o)] for k in every}
    if all(each == gone[1] for each in gone.values()):
        return every
    present = reading.current if reading.current in every else 1
    told = "the configurations ignore different surfaces ({names}); the present one, {number}, is read alone"
    reading.notes.add("caution", told, names=IGNORED, number=present)
    return (present,)


def _configuration(reading: ZemaxReading, number: int, notes: Notebook) -> Configuration:
    """Return the lens of one configuration: what the surface lines say, with the operands' values in their place."""
    own = replace(
        reading,
        notes=notes,
        raw=deepcopy(reading.raw),
        surfaces=deepcopy(reading.surfaces),
        kinds=dict(reading.kinds),
        parameters=deepcopy(reading.parameters),
        x_fields=list(reading.x_fields),
        y_fields=list(reading.y_fields),
    )
    mine = [operand for operand in reading.operands if operand.configuration == number]
    for operand in sorted(mine, key=lambda each: each.name in IGNORED):
        if operand.name in OPERANDS:
            own.line = operand.line
            OPERANDS[operand.name](own, operand)
    stated = {operand.number for operand in mine if operand.name == "THIC"}
    count = reading.configurations if mine else 1
    lists = SolvedSurfaces(own.surfaces, own.parameters, stated, count, own.source, own.notes)
    apply_solves(reading.solves, lists)
    own.line = reading.line
    _finish(own)
    title = next((operand.word for operand in mine if operand.name == "LTTL"), "")
    return Configuration(own.raw, title)


def _note_unread(reading: ZemaxReading) -> None:
    """Note what differs between configurations and is not read."""
    unread: dict[tuple[str, int], set[str]] = {}
    for operand in reading.operands:
        if operand.name in UNREAD_OPERANDS:
            unread.setdefault((operand.name, operand.number), set()).add(operand.word)
    names = tuple(dict.fromkeys(name for (name, _), words in unread.items() if len(words) > 1))
    if names:
        reading.notes.add(
            "caution",
            "configurations differ in {names}, which are not read; all have those of the surfaces",
            names=names,
        )


def _on_surface(name: str, what: Message) -> Callable[[ZemaxReading, Operand], None]:
    """Return what sets one number of a surface in one configuration."""

    def apply(reading: ZemaxReading, operand: Operand) -> None:
        surface = _surface_of(reading, operand)
        far = name == "thickness" and operand.number == 0 and operand.word.upper() in ("INFINITY", "INF")
        value = inf if far else number(operand.word, what, reading.source, operand.line)
        setattr(surface, name, inf if name == "semi_diameter" and value <= 0 else value)

    return apply


def _surface_of(reading: ZemaxReading, operand: Operand) -> RawSurface:
    if not 0 <= operand.number < len(reading.surfaces):
        raise reading.source.error(
            "{keyword} is of surface {number}, which does not exist; correct it",
            operand.line,
            keyword=operand.name,
            number=operand.number,
        )
    return reading.surfaces[operand.number]


def _in_parameters(place: int) -> Callable[[ZemaxReading, Operand], None]:
    """Return what sets one parameter of a surface in one configuration."""

    def apply(reading: ZemaxReading, operand: Operand) -> None:
        value = number(operand.word, Message("parameter"), reading.source, operand.line)
        reading.parameters.setdefault(_surface_of(reading, operand).number, {})[place] = value

    return apply


def _other_glass(reading: ZemaxReading, operand: Operand) -> None:
    name = operand.word.upper()
    glass = None if name in ("", "AIR") else RawGlass(operand.word, line=operand.line)
    _surface_of(reading, operand).glass = RawGlass(medium=MIRROR, line=operand.line) if name == "MIRROR" else glass


def _other_aperture(reading: ZemaxReading, operand: Operand) -> None:
    value = number(operand.word, Message("aperture"), reading.source, operand.line)
    if reading.raw.aperture and reading.raw.aperture[0] != "stop_semi_diameter":
        reading.raw.aperture, reading.raw.aperture_line = (reading.raw.aperture[0], value), operand.line
    elif reading.raw.stop is not None:
        reading.surfaces[reading.raw.stop].semi_diameter = value if value > 0 else inf


def _in_list(values: Callable[[ZemaxReading], list[float]], what: Message) -> Callable[[ZemaxReading, Operand], None]:
    """Return what sets one number of a list, which counts from 1, in one configuration."""

    def apply(reading: ZemaxReading, operand: Operand) -> None:
        listed = values(reading)
        if not 1 <= operand.number <= len(listed):
            raise reading.source.error(
                "{keyword} is of number {number}, which does not exist; correct it",
                operand.line,
                keyword=operand.name,
                number=operand.number,
            )
        listed[operand.number - 1] = number(operand.word, what, reading.source, operand.line)

    return apply


def _other_stop(reading: ZemaxReading, operand: Operand) -> None:
    reading.raw.stop = whole(operand.word, Message("stop surface"), reading.source, operand.line)


def _ignores(operand: Operand) -> bool:
    return operand.name in IGNORED and operand.word.strip("+-0.") != ""


def _ignore(reading: ZemaxReading, operand: Operand) -> None:
    """Make planes without effect, at no distance, of surfaces that a configuration does without."""
    if not _ignores(operand):
        return
    for place in range(operand.number, max(operand.number, operand.last) + 1):
        surface = _surface_of(reading, replace(operand, number=place))
        reading.surfaces[place] = RawSurface(place, surface.line, surface.label, keeps_medium=True)
        reading.kinds[place], reading.parameters[place] = "STANDARD", {}


def _other_primary(reading: ZemaxReading, operand: Operand) -> None:
    reading.raw.primary = whole(operand.word, Message("primary wavelength"), reading.source, operand.line) - 1


IGNORED = "IGNR", "IGNM"
OPERANDS: dict[str, Callable[[ZemaxReading, Operand], None]] = {
    "THIC": _on_surface("thickness", Message("thickness")),
    **{f"PAR{place}": _in_parameters(place) for place in range(1, 9)},
    "CRVT": _on_surface("curvature", Message("curvature")),
    "CONN": _on_surface("conic", Message("conic constant")),
    "SDIA": _on_surface("semi_diameter", Message("semi-diameter")),
    "GLSS": _other_glass,
    "APER": _other_aperture,
    "STPS": _other_stop,
    "XFIE": _in_list(lambda reading: reading.x_fields, Message("field")),
    "YFIE": _in_list(lambda reading: reading.y_fields, Message("field")),
    "WAVE": _in_list(lambda reading: reading.raw.wavelengths_um, Message("wavelength")),
    "PRWV": _other_primary,
    **dict.fromkeys(IGNORED, _ignore),
}
UNREAD_OPERANDS = (
    "PRAM MCOM CROR COTN EDVA FLTP FLWT FVAN FVCX FVCY FVDX FVDY HOLD MABB MDPG MIND NPAR NPOS NPRO PRES "
    "PXAR PYAR PZAR PUCN PUPR SATP SDRW SWCN TELE TEMP TSP1 TSP2 TSP3 UDAF "
    "WLWT CADX CADY CATX CATY CATZ CBDX CBDY CBTX CBTY CBTZ CPCN"
).split()


def _add_solve(reading: ZemaxReading, words: list[str]) -> None:
    reading.solves.append(Solve(words[0].upper(), reading.surface.number, tuple(words[1:]), reading.line))


def _read_line(reading: ZemaxReading, words: list[str], text: str) -> None:
    keyword = words[0].upper()
    if keyword == "SURF":
        begin_surface(reading, words)
    elif reading.surfaces and keyword in ON_SURFACE:
        ON_SURFACE[keyword](reading, words)
    elif reading.surfaces and reading.configurations == 1 and keyword in SOLVES:
        _add_solve(reading, words)
    elif keyword in IN_SYSTEM:
        IN_SYSTEM[keyword](reading, words)
    elif keyword in IGNORED or (reading.configurations > 1 and keyword in (*OPERANDS, *UNREAD_OPERANDS, "LTTL")):
        _operand(reading, text)
    elif keyword == "NAME":
        reading.raw.title = text[4:].strip().strip('"')
    elif keyword == "COMM" and reading.surfaces:
        reading.surface.label = text[4:].strip()
    else:
        note(reading.notes, words, reading.surface.number if reading.surfaces else None, reading.line)


def _finish(reading: ZemaxReading) -> None:
    """Complete the raw lens once all lines are read."""
    raw = reading.raw
    if len(reading.surfaces) < 3:
        raise reading.source.error("the file contains no surface between object and image", len(reading.source.lines))
    for surface in reading.surfaces:
        if surface.glass and surface.glass.name:
            surface.glass = replace(surface.glass, makers=reading.catalogues)
        _shape(reading, surface)
    first, *raw.surfaces, image = reading.surfaces
    raw.object_distance, raw.object_glass = first.thickness, first.glass
    if not abs(raw.object_distance) < FAR:
        raw.object_distance = inf
    raw.image = image
    check_stop(raw, reading.source, image.line)
    if raw.aperture and raw.aperture[0] == "stop_semi_diameter":
        raw.aperture = None  # float by stop size: the stop's rim, which is what a lens without aperture gets
    if reading.wavelength_count:
        raw.wavelengths_um = raw.wavelengths_um[: reading.wavelength_count]
    longest = max(len(reading.x_fields), len(reading.y_fields))
    count = min(reading.field_count or longest, longest)
    padded = [[*values, *[0.0] * count][:count] for values in (reading.x_fields, reading.y_fields)]
    raw.fields = list(zip(*padded, strict=True))
    raw.vignetting = _factors(reading, count)


def _factors(reading: ZemaxReading, count: int) -> VignettingFactors | None:
    """Return the factors of the fields: the pupil goes from VDY ± (1 − VCY) along y, and ± (1 − VCX) about VDX."""
    if not reading.vignetting:
        return None
    lists = (
        [*reading.vignetting.get(name, ()), *[0.0] * count][:count] for name in ("VDX", "VDY", "VCX", "VCY", "VAN")
    )
    rows = list(zip(*lists, strict=True))
    ends = tuple(PupilEnds(cy - dy, cy + dy, cx) for _, dy, cx, cy, _ in rows)
    skew = any(dx or (turn and (dy or cx != cy)) for dx, dy, cx, cy, turn in rows)
    return VignettingFactors(ends, reading.vignetting_line, skew)


def _shape(reading: ZemaxReading, surface: RawSurface) -> None:
    """Give an asphere its terms and a phase; a coordinate break is a plane in the medium before it."""
    parameters = reading.parameters.get(surface.number, {})
    kind = reading.kinds.get(surface.number, "STANDARD")
    if kind not in (*WITH_EXTRA_DATA, *FREEFORMS, *ANAMORPHIC):
        _note_extra(reading, surface, kind)
    if kind == "COORDBRK":
        placement = coordinate_break(parameters)
        surface.keeps_medium, surface.before = True, () if placement.idle else (placement,)
        surface.curvature = surface.conic = 0.0
        return
    if kind == "PARAXIAL":
        surface.ideal_focal_length = parameters.get(1, 0.0)
        surface.curvature = surface.conic = 0.0
    step = 1 if kind in ("ODDASPHE", "XOSPHERE") else 2
    if kind in ("EVENASPH", "ODDASPHE", "BINARY_2"):
        surface.aspheric = {step * place: value for place, value in parameters.items() if place and value}
    if kind in FREEFORMS:
        _freeform(reading, surface, kind, parameters)
    if kind in ANAMORPHIC:
        _anamorphic(reading, surface, ANAMORPHIC[kind], parameters)
    if kind == "DGRATING" and parameters.get(1) and parameters.get(2):
        lines = parameters[1] * UM_PER_MM * reading.raw.unit_mm  # per unit of length, as all of a raw surface
        surface.diffraction = Grating(lines, parameters[2])
    if kind == "QED_TYPE":
        _forbes(reading, surface)
    if kind not in ("XASPHERE", "XOSPHERE", "BINARY_2"):
        return
    terms, radius = _extra_terms(reading, surface)
    if kind == "BINARY_2":  # parameter 0 is the order
        order = parameters.get(0, 1.0)
        surface.diffraction = Diffraction(terms, radius, order) if order and any(terms) else None
    elif radius == 1:
        surface.aspheric = {step * place: value for place, value in enumerate(terms, 1) if value}
    elif any(terms):
        every = terms if step == 1 else tuple(x for term in terms for x in (0.0, term))
        surface.shape = RadialPolynomial(every, radius)


def _note_extra(reading: ZemaxReading, surface: RawSurface, kind: str) -> None:
    """Note extra data of a type that has none."""
    places = tuple(place for place, value in reading.extra.get(surface.number, {}).items() if value)
    if places:
        told = "its extra data (XDAT {places}) are left out, since a surface of type {kind} has none"
        line = reading.extra_lines[surface.number]
        reading.notes.add("caution", told, surface.number, line, places=places, kind=kind)


def _anamorphic(
    reading: ZemaxReading, surface: RawSurface, shape: type[Anamorphic], parameters: dict[int, float]
) -> None:
    """Give a surface a biconic or a toroid, whose curvature and conic constant in yz are its own; LensFileError.

    A toroid may have Zernike terms in its extra data, whose number they begin with.
    """
    _, names = shape.zemax
    numbers: dict[str, Any] = {name: parameters.get(place, 0.0) for place, name in enumerate(names, 1)}
    numbers["radius_x"] = numbers["radius_x"] or inf
    if "coefficients" in shape.__dataclass_fields__:
        terms = [parameters.get(place, 0.0) for place in range(len(names) + 1, len(names) + 8)]
        used = max((count for count, term in enumerate(terms, 1) if term), default=0)
        numbers["coefficients"] = tuple(terms[:used])
    if reading.extra.get(surface.number, {}).get(1):
        raise reading.source.error(
            "{surface} has Zernike terms on a shape that is not of revolution ({kind}), which is not read; leave them "
            "out",
            surface.line,
            surface=surface.name,
            kind=shape.name,
        )
    radius = 1 / surface.curvature if surface.curvature else inf
    surface.shape = shape(radius_y=radius, conic_y=surface.conic, **numbers)
    surface.curvature = surface.conic = 0.0


def _forbes(reading: ZemaxReading, surface: RawSurface) -> None:
    """Give a surface Forbes's polynomials: the first of the extra data tells Qbfs, 0, from Qcon, 1."""
    kind = reading.extra.get(surface.number, {}).get(1, 0.0)
    if kind not in (0, 1):
        raise reading.source.error(
            "{surface} has Forbes's polynomials of type {kind:g}, which is neither Qbfs (0) nor Qcon (1); correct it",
            surface.line,
            surface=surface.name,
            kind=kind,
        )
    terms, radius = _extra_terms(reading, surface, 2)
    if any(terms):
        surface.shape = Qcon(terms, radius) if kind else Qbfs(terms, radius)


def _freeform(reading: ZemaxReading, surface: RawSurface, kind: str, parameters: dict[int, float]) -> None:
    """Give a surface a polynomial in x and y, or Zernike's beside even terms from r² to r¹⁶, parameters 1 to 8."""
    shape = FREEFORMS[kind]
    if kind != "XPOLYNOM":
        surface.aspheric = {2 * place: value for place, value in parameters.items() if 0 < place <= 8 and value}
        if any(parameters.get(place) for place in (9, 10)):
            raise reading.source.error(
                "{surface} has Zernike terms that are decentred, which is not read; centre them",
                surface.line,
                surface=surface.name,
            )
    terms, radius = _extra_terms(reading, surface, most=shape.most)
    if any(terms):
        surface.shape = shape(terms, radius)


def _extra_terms(
    reading: ZemaxReading, surface: RawSurface, first: int = 1, most: int = MOST_TERMS
) -> tuple[tuple[float, ...], float]:
    """Return coefficients and normalisation radius of the extra data: from ``first`` their number, the radius, each."""
    extra = reading.extra.get(surface.number, {})
    count, radius = extra.get(first, 0.0), extra.get(first + 1, 1.0)
    if not (0 <= count <= most and count == int(count) and radius > 0):
        raise reading.source.error(
            "{surface} has {count:g} terms and a normalisation radius of {radius:g} in its extra data (XDAT); give up "
            "to {most} terms and a positive radius",
            surface.line,
            surface=surface.name,
            count=count,
            radius=radius,
            most=most,
        )
    return tuple(extra.get(place, 0.0) for place in range(first + 2, first + 2 + int(count))), radius
