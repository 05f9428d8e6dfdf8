"""CODE V .seq files: commands of three letters.

Numbers after S are radius (or curvature, RDM N, which is what a file without RDM means), thickness, glass.
Surfaces count from 1; the object is SO, the image SI. Other programs write files without RDM that hold radii; such
numbers are told by their size (`_finish`).
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from math import atan2, degrees, inf, log, nan, pi
from typing import NamedTuple

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.errors import GeometryError, LensFileError
from p2sf.glass.media import MIRROR, Medium
from p2sf.lens.anamorphic import Anamorphic, Biconic, Toroid
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.grating import Grating
from p2sf.lens.lens import Lens
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Diffraction, RadialPolynomial, Shape
from p2sf.lens.tilts import Breaks, decentred_surface
from p2sf.lensfile.assemble import check_stop, private_glass
from p2sf.lensfile.configurations import MOST_COLUMNS, Configuration, assemble_all
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import (
    ParaxialSolve,
    PupilEnds,
    RawApertureKind,
    RawFieldKind,
    RawGlass,
    RawLens,
    RawSurface,
    VignettingFactors,
)
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number
from p2sf.messages import Message

TILT_NAMES = ("XDE", "YDE", "ZDE", "ADE", "BDE", "CDE")
RIM_NAMES = ("REX", "REY", "ADX", "ADY", "ARO")  # half-widths of a rectangle, the centre of a rim, and its turn
TILTS = Message("is tilted or decentred otherwise than by XDE to CDE")
SHAPES = Message("has a shape that is not a sphere, a conic or an asphere in powers of r")
REFUSED = {
    **dict.fromkeys("XOD YOD ZOD GLB RET".split(), TILTS),
    **dict.fromkeys("HOE HX1 HX2 HY1 HY2 HZ1 HZ2".split(), Message("diffracts")),
    **dict.fromkeys("XYP ZRN UDS ODD ANA BIC SPL AR BR CR DR AP BP CP DP".split(), SHAPES),
    **dict.fromkeys("GRN GIR URN".split(), Message("is followed by a gradient index")),
    **dict.fromkeys("NSS NSE ENT EXI".split(), Message("begins a non-sequential part")),
    **dict.fromkeys("CUF FRE".split(), Message("is a Fresnel surface")),
    **dict.fromkeys("MOD LMO".split(), Message("is a lens module that hides its surfaces")),
    **dict.fromkeys("INS".split(), Message("reads another file, which was not found")),
}

HARMLESS = (
    (Message("control codes of the optimiser"), "CCY THC KC AC BC CC DC EC FC GC HC GLC CUM THM CCX DEL CCF"),
    (Message("solves, whose stored values are read"), "SOL CUS RED"),
    (Message("weights of fields"), "WTF WTA"),
    (
        Message("titles, sessions and computing settings"),
        "SET LEN INI GO DER CLS VER OUT CON ASP SPH POL CA APE ROT PIV CMT WID AFI AFC RFO RSI PFR PTP POR HCC SCC",
    ),
)
REASON = {name: reason for reason, names in HARMLESS for name in names.split()}


VIGNETTING = ("VUY", "VLY", "VUX", "VLX")
PICKUP = "the pickup {command} is not evaluated; the numbers that the file states are read"


def note(notes: Notebook, name: str, words: tuple[str, ...], line: int) -> None:
    """Note a command that is not read: harmless ones once per reason, unknown ones by name."""
    if name in REASON:
        notes.add("ignored", REASON[name])
    elif name == "PIK":
        notes.add("caution", PICKUP, None, line, command=" ".join((name, *words))[:60])
    else:
        notes.add_unknown(name, line)


@dataclass(frozen=True)
class CodeVCommand:
    """One command: its name in capitals, its words without quotation marks, and the line it starts on."""

    name: str
    words: tuple[str, ...]
    line: int


def commands(source: LensText) -> Iterator[CodeVCommand]:
    """Yield the commands of a file; comments are dropped, continued lines joined, quotation marks respected."""
    pending, start = "", 0
    for line, text in enumerate(source.lines, 1):
        code, continued = _without_comment(text)
        start = start or line
        pending += code
        if continued and len(pending) < 100_000:
            pending += " "
            continue
        for part in re.findall(r"(?:'[^']*'|\"[^\"]*\"|[^;'\"]|['\"])+", pending):
            found = re.findall(r"'[^']*'|\"[^\"]*\"|\S+", part)
            if found:
                yield CodeVCommand(
                    found[0].upper(),
                    tuple(word.strip("'\"") if word[0] in "'\"" else word for word in found[1:]),
                    start,
                )
        pending, start = "", 0


def _without_comment(text: str) -> tuple[str, bool]:
    """Return a line without its comment, and whether it continues on the next line."""
    found = re.match(r"(?:'[^']*'|\"[^\"]*\"|[^!])*", text)
    code = found[0].rstrip() if found else ""
    return (code[:-1], True) if code.endswith("&") else (code, False)


UNITS_MM = {"M": 1.0, "MM": 1.0, "C": 10.0, "CM": 10.0, "I": 25.4, "IN": 25.4, "INC": 25.4, "INCH": 25.4}
APERTURES: dict[str, RawApertureKind] = {
    "EPD": "entrance_pupil_diameter",
    "FNO": "image_f_number",
    "NA": "image_na",
    "NAO": "object_na",
}
FIELD_KINDS: dict[str, RawFieldKind] = {
    "AN": "angle",
    "OB": "object_height",
    "IM": "image_height",
    "RI": "real_image_height",
}
# No lens of a file has a surface of a shorter radius than this, mm.
SMALLEST_LENS_MM = 0.1
MM_HG = 760.0  # an atmosphere, in mm of mercury


class Places(NamedTuple):
    """The number of the first coefficient of a special surface, and how many it has."""

    first: int
    terms: int


FREEFORMS = {"XYP": Places(2, 65), "ZRN": Places(2, 66), "ZFR": Places(4, 37)}
# (n, m) of ZRN's terms, each 1 on the edge: by degree, from cos nθ down to the middle and on to sin nθ, θ from +x.
BORN_WOLF = tuple((n, n - 2 * place) for n in range(11) for place in range(n + 1))
ORDERS = {letter: 4 + 2 * place for place, letter in enumerate("ABCDEFGHJ")}


@dataclass
class CodeVReading:
    """What has been read so far; surface 0 is the object."""

    source: LensText
    notes: Notebook
    raw: RawLens = field(default_factory=RawLens)
    surfaces: list[RawSurface] = field(default_factory=lambda: [RawSurface(0)])
    image: RawSurface | None = None
    current: RawSurface | None = None
    radii: bool | None = None  # None: the file does not say
    surfaces_by_number: dict[int, RawSurface] = field(
        default_factory=dict
    )  # whose shape is the number after S, by their id
    fields: dict[str, list[float]] = field(default_factory=dict)
    special: dict[int, dict[str, float]] = field(default_factory=dict)
    special_kinds: dict[int, str] = field(default_factory=dict)
    phase: dict[int, dict[str, float]] = field(default_factory=dict)
    anamorphic: dict[int, dict[str, float]] = field(default_factory=dict)  # KX, KY and the radius RDX in xz, by the id
    anamorphic_kinds: dict[int, str] = field(default_factory=dict)
    tilts: dict[int, dict[str, float]] = field(default_factory=dict)  # numbers of XDE … CDE by the surface's id
    rims: dict[int, dict[str, float]] = field(default_factory=dict)  # numbers of RIM_NAMES by the surface's id
    returns: dict[int, str] = field(default_factory=dict)  # DAR, REV or BEN by the surface's id
    private: dict[str, Medium] = field(default_factory=dict)
    private_nm: list[float] | None = None
    vignetting: dict[str, list[float]] = field(default_factory=dict)  # VUX, VLX, VUY and VLY
    vignetting_line: int = 0
    at_focus: bool = False
    in_private: bool = False
    position: str = ""  # the name of the zoom position
    pupil: dict[str, float] = field(default_factory=dict)  # PUX, PUY, PUI
    pupil_line: int = 0
    faulty: dict[str, LensFileError] = field(default_factory=dict)  # private glasses that cannot be read

    def number(self, command: CodeVCommand, place: int, what: Message, default: float | None = None) -> float:
        """Return the number at a place of a command; LensFileError where it is missing without a ``default``."""
        if place >= len(command.words):
            if default is not None:
                return default
            raise self.source.error(
                "{command}: {what} is missing; complete the command", command.line, command=command.name, what=what
            )
        return number(command.words[place], what, self.source, command.line)

    def numbers(self, command: CodeVCommand, what: Message) -> list[float]:
        """Return all numbers of a command."""
        return [number(word, what, self.source, command.line) for word in command.words[:1000]]


def to_curvature(value: float, is_radius: bool) -> float:
    """Return the curvature for a number that is a radius (0 for a plane) or the curvature itself."""
    return (1 / value if value else 0.0) if is_radius else value


def distance(reading: CodeVReading, command: CodeVCommand, place: int, surface: RawSurface) -> float:
    """Return a thickness; the object may be infinitely far, no other surface; LensFileError."""
    infinite = command.words[place : place + 1] and re.fullmatch(r"[+-]?inf(inity)?", command.words[place], re.I)
    value = inf if infinite else reading.number(command, place, Message("thickness"), 0.0 if place else None)
    if abs(value) < FAR:
        return value
    if surface.number == 0:
        return inf
    raise reading.source.error(
        "{surface} has an infinite thickness; give a finite one", command.line, surface=surface.name
    )


def read_glass(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read a glass: NAME_MAKER, a private name, nnnvvv, nnn.vvv, or nd:vd; REFL is a mirror."""
    word = command.words[0] if command.words else ""
    if word.upper() in ("REFR", "AIR", ""):
        return
    if word.upper() == "REFL":
        surface.glass = RawGlass(medium=MIRROR, line=command.line)
        return
    pair = re.fullmatch(r"(\d\.\d+):(\d+(?:\.\d*)?)", word)
    code = re.fullmatch(r"(\d{3,9})\.(\d{3,9})|(\d{3})(\d{3})", word)
    if pair:
        surface.glass = RawGlass(model=(float(pair[1]), float(pair[2])), line=command.line)
        return
    if code:
        index, abbe = (code[1], code[2]) if code[1] else (code[3], code[4])
        model = (1 + int(index) / 10 ** len(index), int(abbe) / 10 ** (len(abbe) - 2))
        surface.glass = RawGlass(model=model, line=command.line)
        return
    if re.fullmatch(r"[\d.]+", word):
        raise reading.source.error(
            '{surface}: glass "{name}" is neither a name nor a six-digit code such as 517642 or 517.642; correct it',
            command.line,
            surface=surface.name,
            name=word[:20],
        )
    name, _, maker = word.rpartition("_") if "_" in word else (word, "", "")
    surface.glass = RawGlass(name, (maker.upper(),) if maker else (), line=command.line)


def read_private(reading: CodeVReading, command: CodeVCommand) -> None:
    """Read one line of a private catalogue: PWL and wavelengths in nm, or 'NAME' and an index for each."""
    reading.in_private = True
    if command.name == "PWL":
        reading.private_nm = reading.numbers(command, Message("wavelength"))
        return
    name = command.name.strip("'\"")
    if not reading.private_nm:
        raise reading.source.error(
            "private glass {name} has no wavelengths (PWL) before it; add them", command.line, name=name
        )
    waves = [w / NM_PER_UM for w in reading.private_nm]
    try:
        table = private_glass(name, waves, reading.numbers(command, Message("index")), reading.source, command.line)
    except LensFileError as failure:
        reading.faulty[name.upper()] = failure  # which matters only if a surface has this glass
        return
    reading.private[name] = replace(table, label=name)
    reading.notes.add(
        "read",
        "private glass {name} as a table of {count} indices, straight lines between them",
        name=name,
        count=len(waves),
    )


def _set_private(reading: CodeVReading, command: CodeVCommand) -> None:
    reading.in_private = command.name.startswith("PRV")


def _radius_mode(reading: CodeVReading, command: CodeVCommand) -> None:
    reading.radii = not command.words or command.words[0].upper().startswith("Y")


def _title(reading: CodeVReading, command: CodeVCommand) -> None:
    reading.raw.title = " ".join(command.words)[:200]


def _unit(reading: CodeVReading, command: CodeVCommand) -> None:
    unit = command.words[0].upper() if command.words else ""
    if unit not in UNITS_MM:
        raise reading.source.error(
            'lens unit "{unit}" is none of M (mm), C, I; correct it', command.line, unit=unit[:20]
        )
    reading.raw.unit_mm = UNITS_MM[unit]


def _aperture(reading: CodeVReading, command: CodeVCommand) -> None:
    reading.raw.aperture = (APERTURES[command.name[:3]], reading.number(command, 0, Message("aperture")))
    reading.raw.aperture_line = command.line


def _wavelengths(reading: CodeVReading, command: CodeVCommand) -> None:
    before = [wavelength * NM_PER_UM for wavelength in reading.raw.wavelengths_um]
    values = _split_values(reading, command, "W", before, Message("wavelength"))
    if not all(50 <= value <= 50_000 for value in values):
        raise reading.source.error("a wavelength is not that of light; give nanometres", command.line)
    reading.raw.wavelengths_um, reading.raw.wavelength_line = [value / NM_PER_UM for value in values], command.line


def _ellipse(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    told = "its rim ({keyword}) is not round; the round semi-diameter is used instead"
    if not any(word.upper() == "EDG" for word in command.words):
        reading.notes.add("caution", told, surface.number, command.line, keyword=command.name[:3])


def _apodisation(reading: CodeVReading, command: CodeVCommand) -> None:
    """Read PUX, PUY, where the Gaussian intensity over the pupil has fallen to PUI, as shares of the pupil's radius."""
    reading.pupil[command.name[:3]] = reading.number(command, 0, Message("apodisation"))
    reading.pupil_line = command.line


def _environment(reading: CodeVReading, command: CodeVCommand) -> None:
    """Read TEM, °C, and PRE, mm of mercury."""
    temperature, pressure = reading.raw.environment
    value = reading.number(command, 0, Message("temperature or pressure"))
    reading.raw.environment_line = command.line
    reading.raw.environment = (value, pressure) if command.name[:3] == "TEM" else (temperature, value / MM_HG)


def _weights(reading: CodeVReading, command: CodeVCommand) -> None:
    before = reading.raw.weights or [1.0] * len(reading.raw.wavelengths_um)
    reading.raw.weights = _split_values(reading, command, "W", before, Message("weight of a wavelength"))


def _reference(reading: CodeVReading, command: CodeVCommand) -> None:
    reading.raw.primary = int(reading.number(command, 0, Message("reference wavelength"))) - 1


def _set(name: str, what: Message) -> Callable[[CodeVReading, CodeVCommand, RawSurface], None]:
    """Return a reader that sets one number of a surface."""

    def read(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
        setattr(surface, name, reading.number(command, 0, what))

    return read


def _two_radii(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read YTO, XTO, CYL or AAS, a surface with two radii, and its RDX or CUX in xz, its KX and KY."""
    name = command.name[:3]
    if name in TWO_RADII:
        reading.anamorphic_kinds[id(surface)] = name
        return
    value = reading.number(command, 0, Message("number of a toroid or an anamorphic asphere"))
    if name in ("RDX", "CUX"):
        name, value = "RDX", to_curvature(value, True) if name == "CUX" else value
    reading.anamorphic.setdefault(id(surface), {})[name] = value


def _stop(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    reading.raw.stop = surface.number


def _paraxial_image(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read PIM: the image stands at the paraxial focus of the last surface, its thickness beyond that."""
    reading.at_focus = True


def _label(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    surface.label = " ".join(command.words)[:60]


def _radius(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read a radius or a curvature; a solve for it (CUY UMY −0.1) leaves the one that is stored."""
    if _solved(reading, command, surface):
        return
    surface.curvature = to_curvature(reading.number(command, 0, Message("radius")), command.name.startswith("RD"))
    reading.surfaces_by_number.pop(id(surface), None)


SOLVES: dict[str, ParaxialSolve] = {
    "UMY": ParaxialSolve("curvature", "angle"),
    "UCY": ParaxialSolve("curvature", "angle", ray="chief"),
    "IMY": ParaxialSolve("curvature", "incidence"),
    "ICY": ParaxialSolve("curvature", "incidence", ray="chief"),
    "HMY": ParaxialSolve("thickness", "height"),
    "HCY": ParaxialSolve("thickness", "height", ray="chief"),
}


def _solved(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> bool:
    """Take note of a solve such as CUY UMY −0.1 or THI HMY 0; return whether the command is one."""
    name = command.words[0].upper() if command.words else ""
    if not name.isalpha() or name.startswith("INF"):
        return False
    if name in SOLVES:
        value = reading.number(command, 1, Message("number of a solve"), 0.0)
        surface.solve(replace(SOLVES[name], value=value, name=f"{command.name[:3]} {name}"))
    else:
        told = "the solve {command} is not evaluated; the number that the file states is read"
        words = " ".join((command.name, *command.words))[:60]
        reading.notes.add("caution", told, surface.number, command.line, command=words)
    return True


def _thickness(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    if _solved(reading, command, surface):
        return
    surface.thickness = distance(reading, command, 0, surface)


def _coefficient(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    surface.aspheric[ORDERS[command.name]] = reading.number(command, 0, Message("aspheric coefficient"))


def _special(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read SPS kind radius: ODD, a polynomial in r, XYP, one in x and y, ZRN or ZFR, Zernike's; LensFileError."""
    kind = command.words[0].upper() if command.words else ""
    if kind not in ("ODD", *FREEFORMS):
        raise reading.source.error(
            "{surface} is a special surface of type {kind}, which is not read; {known} are",
            command.line,
            surface=surface.name,
            kind=kind[:20] or Message("nothing"),
            known=("ODD", *FREEFORMS),
        )
    reading.special_kinds[surface.number] = kind
    reading.special[surface.number] = {"NRADIUS": reading.number(command, 1, Message("normalisation radius"), 0.0)}


def _special_value(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read SCO name value; C1 is K, and of ODD C2 is AR1, the coefficient of r, and C33 the normalisation radius."""
    name = command.words[0].upper() if command.words else ""
    place = int(name[1:]) if re.fullmatch(r"C\d{1,3}", name) else 0
    kind, values = reading.special_kinds.get(surface.number, ""), reading.special.get(surface.number)
    if kind in FREEFORMS:
        if place:
            name = "K" if place == 1 else f"T{place - FREEFORMS[kind].first}"
        if kind == "ZFR" and place == 3:
            name = "NRADIUS"
        known = name in ("K", "NRADIUS") or name in {f"T{term}" for term in range(FREEFORMS[kind].terms)}
    else:
        name = {0: name, 1: "K", 33: "NRADIUS"}.get(place, f"AR{place - 1}")
        known = re.fullmatch(r"K|NRADIUS|AR([1-9]|[12]\d|30)", name) is not None
    if values is None or not known:
        raise reading.source.error(
            "{surface}: coefficient {name} of a special surface is not known; K, AR1 to AR30 and NRADIUS after SPS ODD "
            "are, and K, NRADIUS and the coefficients by their numbers after {known}",
            command.line,
            surface=surface.name,
            name=command.words[0][:20] if command.words else Message("nothing"),
            known=tuple(FREEFORMS),
        )
    values[name] = reading.number(command, 1, Message("aspheric coefficient"))


def _diffracts(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read DIF DOE, HCT R, HOR order, HWL nm and HCO C1 value …: a phase of revolution; LensFileError for others.

    GRT or DIF GRT with GRO order, GRS spacing and the direction GRX, GRY, GRZ across its planes is a grating in lines.
    """
    values, words = reading.phase.setdefault(surface.number, {}), [word.upper() for word in command.words]
    place = re.fullmatch(r"C(\d{1,2})", words[0]) if words and command.name[:3] == "HCO" else None
    if command.name[:3] in ("HOR", "HWL"):
        values[command.name[:3]] = reading.number(command, 0, Message("order or wavelength of a phase"))
    elif place:
        values[f"C{int(place[1])}"] = reading.number(command, 1, Message("coefficient of a phase"))
    elif command.name[:3] in GRATING:
        values[command.name[:3]] = reading.number(command, 0, Message("number of a grating"), 0.0)
    elif (command.name[:3], *words[:1]) == ("DIF", "GRT"):
        values["GRT"] = 0.0
    elif (command.name[:3], *words[:1]) not in (("DIF", "DOE"), ("HCT", "R")):
        raise reading.source.error(
            "{surface} diffracts by {command} {kind}, which is not read; only DOE with a phase in r (HCT R) is",
            command.line,
            surface=surface.name,
            command=command.name[:20],
            kind=words[0][:20] if words else "",
        )


def _rim(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read CIR radius and RIM_NAMES; an edge is not a clear rim, and within an obscuration or a hole rays are lost."""
    kind = next((word.upper() for word in command.words if word.upper() in ("EDG", "OBS", "HOL")), "")
    if kind == "EDG":
        return
    value = reading.number(command, len(command.words) - 1, Message("clear rim")) if command.words else 0.0
    if command.name[:3] in RIM_NAMES:
        if kind and value:
            told = "its obscuration or hole ({name} {kind}) is left out, so the picture shows the full aperture"
            names = {"name": command.name[:3], "kind": kind}
            reading.notes.add("caution", told, surface.number, command.line, **names)
        elif not kind:
            reading.rims.setdefault(id(surface), {})[command.name[:3]] = value
    elif kind:
        surface.inner_radius, surface.obscured = max(value, 0.0), kind == "OBS"
    else:
        surface.semi_diameter = value if value > 0 else inf


GRATING = ("GRT", "GRO", "GRS", "GRX", "GRY", "GRZ")
TWO_RADII = ("YTO", "XTO", "CYL", "AAS")
ONE_LETTER = {"WL", "NA", "K", *ORDERS}


def _tilt(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    """Read XDE, YDE, ZDE, a length, or ADE, BDE, CDE, an angle in degrees."""
    value = reading.number(command, 0, Message("tilt or decentre"))
    if value and surface.number == 0:
        raise reading.source.error(
            "the object is tilted or decentred ({command}), which is not read; move the lens instead",
            command.line,
            command=command.name,
        )
    reading.tilts.setdefault(id(surface), {})[command.name[:3]] = value


def _returns(reading: CodeVReading, command: CodeVCommand, surface: RawSurface) -> None:
    reading.returns[id(surface)] = command.name[:3]


ON_SURFACE = {
    **dict.fromkeys(TILT_NAMES, _tilt),
    **dict.fromkeys(("DAR", "REV", "BEN"), _returns),
    "STO": _stop,
    "PIM": _paraxial_image,
    "SLB": _label,
    "GLA": read_glass,
    "RMD": read_glass,  # the mode of refraction: REFL or REFR
    "THI": _thickness,
    "K": _set("conic", Message("conic constant")),
    **dict.fromkeys(("CIR", *RIM_NAMES), _rim),
    **dict.fromkeys(("ELX", "ELY"), _ellipse),
    "SPS": _special,
    "SCO": _special_value,
    **dict.fromkeys(("DIF", "HOR", "HWL", "HCT", "HCO", *GRATING), _diffracts),
    **dict.fromkeys((*TWO_RADII, "RDX", "CUX", "KX", "KY"), _two_radii),
    **dict.fromkeys(("RDY", "CUY"), _radius),
    **dict.fromkeys(ORDERS, _coefficient),
}
IN_SYSTEM = {
    "RDM": _radius_mode,
    "TIT": _title,
    "DIM": _unit,
    "WL": _wavelengths,
    "REF": _reference,
    "WTW": _weights,
    **dict.fromkeys(("TEM", "PRE"), _environment),
    **dict.fromkeys(("PUX", "PUY", "PUI"), _apodisation),
    "PRV": _set_private,
    "END": _set_private,
    **dict.fromkeys(APERTURES, _aperture),
}


def read_codev(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a .seq file; LensFileError with its line for what P2SF does not trace.

    Refused by surface number and name: tilts of unread kinds, holograms and special surfaces of other kinds.
    """
    listed = list(commands(source))
    count = max((int(number) for command in listed for number in _zoom_count(command)), default=1)
    readings = []
    for position in range(1, min(count, MOST_COLUMNS) + 1):
        reading = CodeVReading(source, notes if position == 1 else Notebook())
        for command in listed:
            own = _at_position(reading, command, position, count)
            if own:
                _run(reading, own)
        _finish(reading)
        readings.append(reading)
    private = {**sources.private, **readings[0].private}
    glasses = GlassSources(sources.catalogues, private, sources.accept_substitutes)
    return assemble_all([Configuration(reading.raw, reading.position) for reading in readings], glasses, notes, source)


def _zoom_count(command: CodeVCommand) -> list[str]:
    """Return the number of zoom positions that a command ZOO n states, nothing for another command."""
    return [word for word in command.words[:1] if command.name[:3] == "ZOO" and re.fullmatch(r"\d{1,4}", word)]


def _at_position(reading: CodeVReading, command: CodeVCommand, position: int, count: int) -> CodeVCommand | None:
    """Return what a command means at one zoom position, None where it says nothing about it.

    ZOO THI S5 a b c is THI S5 b at the second position, and so is THI S5 Z2 b.
    """
    if command.name[:3] == "ZOO" and command.words:
        return _zoom_value(reading, command, position, count)
    where = next((k for k, word in enumerate(command.words[:2]) if re.fullmatch(r"Z\d+", word, re.I)), None)
    if where is None or reading.in_private or count == 1:
        return command
    if int(command.words[where][1:]) != position:
        return None
    words = command.words[:where] + command.words[where + 1 :]
    if command.name[:3] == "TIT":
        reading.position = " ".join(words).strip()[:60]
        return None
    return CodeVCommand(command.name, words, command.line)


def _zoom_value(reading: CodeVReading, command: CodeVCommand, position: int, count: int) -> CodeVCommand | None:
    name, *words = command.words
    qualifiers = [word for word in words[:1] if re.fullmatch(r"[SFW](O|I|\d+)", word, re.I)]
    values = words[len(qualifiers) :]
    if _zoom_count(command) or not values:
        return None
    if len(values) not in (1, count):
        raise reading.source.error(
            "ZOO {name} has {values} values for {count} zoom positions; write one for each",
            command.line,
            name=name,
            values=len(values),
            count=count,
        )
    return CodeVCommand(name.upper(), (*qualifiers, values[position - 1 if len(values) > 1 else 0]), command.line)


def _run(reading: CodeVReading, command: CodeVCommand) -> None:
    if reading.in_private and command.name != "END":
        read_private(reading, command)
    elif re.fullmatch(r"S(O|I|S|\d+)?", command.name):
        _surface(reading, command)
    else:
        _dispatch(reading, command, command.name if command.name in ONE_LETTER else command.name[:3])


def _dispatch(reading: CodeVReading, command: CodeVCommand, name: str) -> None:
    command, surface = _split_qualifier(reading, command)
    if name in REFUSED:
        _refuse_unless_zero(reading, command, surface, REFUSED[name])
    elif name in ON_SURFACE:
        if surface is None:
            raise reading.source.error(
                "{command} stands before any surface; put it after one", command.line, command=command.name
            )
        ON_SURFACE[name](reading, command, surface)
    elif name in IN_SYSTEM:
        IN_SYSTEM[name](reading, command)
    elif name[:1] in "XY" and name[1:] in FIELD_KINDS:
        listed = reading.fields.setdefault(name, [])
        listed[:] = _split_values(reading, command, "F", listed, Message("field"))
        reading.raw.field_line = command.line
    elif name in VIGNETTING:
        listed = reading.vignetting.setdefault(name, [])
        listed[:] = _split_values(reading, command, "F", listed, Message("vignetting factor"))
        reading.vignetting_line = reading.vignetting_line or command.line
    else:
        note(reading.notes, name, command.words, command.line)


def _split_values(
    reading: CodeVReading, command: CodeVCommand, letter: str, before: list[float], what: Message
) -> list[float]:
    """Return the numbers of a command, or those before it with another number for the one it names, as in YAN F2 5."""
    if not command.words or not re.fullmatch(rf"{letter}\d+", command.words[0], re.I):
        return reading.numbers(command, what)
    place = int(command.words[0][1:])
    if not 1 <= place <= len(before):
        raise reading.source.error(
            "{command} is of number {number}, which does not exist yet; put it behind the list of all",
            command.line,
            command=command.name,
            number=place,
        )
    return [*before[: place - 1], reading.number(command, 1, what), *before[place:]]


def _split_qualifier(reading: CodeVReading, command: CodeVCommand) -> tuple[CodeVCommand, RawSurface | None]:
    """Return the command without its surface qualifier (S3, SI, SO), and the surface it applies to."""
    if command.words and re.fullmatch(r"S(O|I|S|\d+)", command.words[0], re.I):
        surface = _find_surface(reading, command.words[0][1:].upper(), command)
        return CodeVCommand(command.name, command.words[1:], command.line), surface
    return command, reading.current


def _find_surface(reading: CodeVReading, name: str, command: CodeVCommand) -> RawSurface | None:
    if name in ("I", "S"):
        return reading.image if name == "I" else reading.current
    place = 0 if name == "O" else int(name[:6])
    if place >= len(reading.surfaces):
        raise reading.source.error(
            "{command} refers to surface {number}, which does not exist yet",
            command.line,
            command=command.name,
            number=place,
        )
    return reading.surfaces[place]


def _refuse_unless_zero(
    reading: CodeVReading, command: CodeVCommand, surface: RawSurface | None, reason: Message
) -> None:
    """Raise LensFileError for a tilt of an unread kind or a grating; one whose numbers are all zero does nothing."""
    if command.words and all(re.fullmatch(r"[+-]?0*(?:\.0*)?([eE][+-]?\d+)?", word) and word for word in command.words):
        return
    where = surface.name if surface and surface.number else Message("the lens")
    if reading.image is surface and surface is not None:
        where = Message("the image surface")
    raise reading.source.error(
        "{surface} {reason} ({command}), which is not read; give a lens without it",
        command.line,
        surface=where,
        reason=reason,
        command=command.name,
    )


def _surface(reading: CodeVReading, command: CodeVCommand) -> None:
    """Read S radius thickness glass; SO is the object, SI the image, S3 the third surface."""
    name = command.name[1:]
    if name == "I":
        reading.image = surface = RawSurface(len(reading.surfaces), command.line)
    elif name == "O":
        reading.surfaces[0] = surface = RawSurface(0, command.line)
    elif name.isdigit() and int(name[:6]) < len(reading.surfaces):
        surface = reading.surfaces[int(name)]
        surface.glass = None
    else:
        if name.isdigit() and int(name[:6]) != len(reading.surfaces):
            raise reading.source.error(
                "surface {number} is where {due} is expected",
                command.line,
                number=int(name[:6]),
                due=len(reading.surfaces),
            )
        surface = RawSurface(len(reading.surfaces), command.line)
        reading.surfaces.append(surface)
    reading.current = surface
    surface.curvature = to_curvature(reading.number(command, 0, Message("radius"), 0.0), bool(reading.radii))
    reading.surfaces_by_number[id(surface)] = surface
    surface.thickness = distance(reading, command, 1, surface)
    for word in command.words[2:]:
        read_glass(reading, CodeVCommand("GLA", (word,), command.line), surface)


def _finish(reading: CodeVReading) -> None:
    """Complete the raw lens once all commands are read."""
    raw = reading.raw
    if reading.radii is None:
        _tell_radii(reading)
    first, *raw.surfaces = reading.surfaces
    raw.object_distance, raw.object_glass = first.thickness, first.glass
    if first.line is None:
        raw.object_distance = inf
    if not raw.surfaces:
        raise reading.source.error(
            ("the file contains no surface (S) between object and image"), len(reading.source.lines)
        )
    if reading.at_focus:
        beyond = reading.image.thickness if reading.image else 0.0
        raw.surfaces[-1].solve(ParaxialSolve("thickness", "height", beyond=beyond, name="PIM"))
    if reading.image is not None:
        last = raw.surfaces[-1]
        last.thickness += reading.image.thickness if last.thickness or not reading.at_focus else 0.0  # defocus
        _shape(reading, reading.image)
        raw.image = reading.image
    if raw.stop is None:
        raw.stop = 1
        reading.notes.add("read", "no stop (STO) is stated; surface 1 is the stop, which is what CODE V takes")
    check_stop(raw, reading.source, first.line)
    for surface in raw.surfaces:
        _shape(reading, surface)
        surface.rim = _shaped_rim(reading.rims.get(id(surface), {}))
    _place(reading)
    _gather_fields(reading)
    _apodise(reading)
    for surface in raw.surfaces:
        if surface.glass and surface.glass.name.upper() in reading.faulty:
            raise reading.faulty[surface.glass.name.upper()]


def _apodise(reading: CodeVReading) -> None:
    """Let the pupil's amplitude fall as its Gaussian says; a PUI of 1, as where it is not stated, or 0 means none."""
    x, y, intensity = (reading.pupil.get(name, 1.0) for name in ("PUX", "PUY", "PUI"))
    if not 0 < intensity < 1:
        return
    if x != y:
        raise reading.source.error(
            "the pupil's apodisation differs between x and y ({x:g}, {y:g}), which is not read; give it round",
            reading.pupil_line,
            x=x,
            y=y,
        )
    reading.raw.apodise(-log(intensity) / 2 / x**2 if x else nan, reading.source, reading.pupil_line)


def _shaped_rim(numbers: dict[str, float]) -> Rim | None:
    """Return the rim that REX, REY, ADX, ADY and ARO mean; None for a circle about the axis."""
    x, y, across, up, turn = (numbers.get(name, 0.0) for name in RIM_NAMES)
    sides = (x if x > 0 else inf, y if y > 0 else inf) if x > 0 or y > 0 else None
    return Rim((across, up), sides, turn if sides else 0.0) if sides or across or up else None


def _place(reading: CodeVReading) -> None:
    """Give every surface, and the sensor, the breaks that its tilts and decentres mean."""
    raw = reading.raw
    for place, surface in enumerate(raw.surfaces):
        numbers, kind = reading.tilts.get(id(surface), {}), reading.returns.get(id(surface), "")
        if not kind and numbers.get("ZDE") and place:
            raw.surfaces[place - 1].thickness += numbers.pop("ZDE")  # the same, and known to paraxial rays
        surface.before, surface.after = _breaks(reading, surface, numbers, kind)
    if reading.image is not None:
        raw.sensor_before, _ = _breaks(reading, reading.image, reading.tilts.get(id(reading.image), {}), "")


def _breaks(reading: CodeVReading, surface: RawSurface, numbers: dict[str, float], kind: str) -> Breaks:
    values = [numbers.get(name, 0.0) for name in TILT_NAMES]
    try:
        return decentred_surface(kind, tuple(values[:3]), tuple(values[3:]))
    except GeometryError as failure:
        raise reading.source.error("{surface}: {error}", surface.line, surface=surface.name, error=failure) from failure


def _tell_radii(reading: CodeVReading) -> None:
    """Take the numbers of a file without RDM as radii where a surface would else be curved too strongly for a lens."""
    numbered = [surface for surface in reading.surfaces_by_number.values() if surface.curvature]
    strongest = max(numbered, key=lambda surface: abs(surface.curvature), default=None)
    if strongest is None or abs(strongest.curvature) * SMALLEST_LENS_MM < reading.raw.unit_mm:
        return
    reading.notes.add(
        "caution",
        "the file does not say RDM; its numbers are read as radii, since {value:g} cannot be a lens's curvature",
        strongest.number,
        strongest.line,
        value=strongest.curvature,
    )
    for surface in numbered:
        surface.curvature = 1 / surface.curvature


def _shape(reading: CodeVReading, surface: RawSurface) -> None:
    """Give a surface its odd polynomial and its phase, which is 2π/λ₀ times the sum of Cⱼr²ʲ."""
    special = dict(reading.special.get(surface.number, {}))
    radius = special.pop("NRADIUS", 0.0) or 1.0
    if special:
        surface.conic = special.pop("K", surface.conic)
    kind = reading.special_kinds.get(surface.number, "")
    if kind in FREEFORMS:
        surface.shape, special = _freeform(kind, special, abs(radius)), {}
    terms = {int(name[2:]): value for name, value in special.items() if value}
    if terms and radius == 1:
        surface.aspheric = {power: surface.aspheric.get(power, 0.0) + value for power, value in terms.items()}
    elif terms:
        surface.shape = RadialPolynomial(tuple(terms.get(k, 0.0) for k in range(1, max(terms) + 1)), abs(radius))
    _anamorphic(reading, surface)
    phase = dict(reading.phase.get(surface.number, {}))
    if phase.keys() & set(GRATING):
        surface.diffraction = _grating(reading, surface, phase)
        return
    order, wavelength_nm = phase.pop("HOR", 1.0), phase.pop("HWL", 0.0)
    paths = {int(name[1:]): value for name, value in phase.items() if value}
    if not paths or not order:
        return
    if not wavelength_nm > 0:
        raise reading.source.error(
            "{surface} diffracts without a wavelength (HWL) of its phase; add it", surface.line, surface=surface.name
        )
    wave = 2 * pi * reading.raw.unit_mm * NM_PER_UM * UM_PER_MM / wavelength_nm
    numbers = tuple(wave * paths.get(place, 0.0) for place in range(1, max(paths) + 1))
    surface.diffraction = Diffraction(numbers, 1.0, order)


def _anamorphic(reading: CodeVReading, surface: RawSurface) -> None:
    """Give a surface its two radii: S or RDY is that in yz. K and A, B, … are of the curve, in xz for XTO."""
    kind, numbers = reading.anamorphic_kinds.get(id(surface), ""), reading.anamorphic.get(id(surface), {})
    if not kind:
        if any(numbers.values()):
            raise reading.source.error(
                "{surface} has a radius or a conic constant in x, but is neither YTO, XTO, CYL nor AAS; state which",
                surface.line,
                surface=surface.name,
            )
        return
    x, y = numbers.get("RDX", 0.0) or inf, 1 / surface.curvature if surface.curvature else inf
    terms = tuple(surface.aspheric.get(power, 0.0) for power in range(2, max(surface.aspheric, default=0) + 1, 2))
    if kind == "AAS" and any(terms):
        raise reading.source.error("{surface} {reason}", surface.line, surface=surface.name, reason=SHAPES)
    shape: Anamorphic
    if kind == "AAS":
        conic_x, conic_y = numbers.get("KX", 0.0), numbers.get("KY", surface.conic)
        shape = Biconic(radius_x=x, radius_y=y, conic_x=conic_x, conic_y=conic_y)
    elif kind == "XTO":
        shape = Toroid(radius_x=y, radius_y=x, conic_y=surface.conic, coefficients=terms, turn_deg=90.0)
    else:
        shape = Toroid(radius_x=x, radius_y=y, conic_y=surface.conic, coefficients=terms)
    surface.shape, surface.curvature, surface.conic, surface.aspheric = shape, 0.0, 0.0, {}


def _grating(reading: CodeVReading, surface: RawSurface, numbers: dict[str, float]) -> Grating | None:
    """Return the grating of GRS and GRO across GRX, GRY, by default y; its order counts as Zemax counts it."""
    spacing, order = numbers.get("GRS", 0.0), numbers.get("GRO", 1.0)
    if not spacing or numbers.get("GRZ"):
        raise reading.source.error(
            "{surface} is a grating without a spacing (GRS), or its planes are not parallel to the axis (GRZ); correct "
            "it",
            surface.line,
            surface=surface.name,
        )
    x, y = numbers.get("GRX", 0.0), numbers.get("GRY", 0.0)
    told = "the order of the grating ({order:g}) turns rays towards +y where it is positive; see that it is meant so"
    reading.notes.add("caution", told, surface.number, surface.line, order=order)
    return Grating(1 / spacing, order, degrees(atan2(-x, y)) if x or y else 0.0) if order else None


def _freeform(kind: str, values: dict[str, float], radius: float) -> Shape | None:
    """Return XYP's polynomial in x and y, or the Zernike terms of ZRN or ZFR, by their places from 0."""
    numbers = {int(name[1:]): value for name, value in values.items() if value}
    if not numbers:
        return None
    if kind == "ZRN":
        return ZernikeStandardSag.of_terms({BORN_WOLF[place]: value for place, value in numbers.items()}, radius)
    listed = tuple(numbers.get(place, 0.0) for place in range(max(numbers) + 1))
    return XYPolynomial(listed, radius) if kind == "XYP" else ZernikeFringeSag(listed, radius)


def _gather_fields(reading: CodeVReading) -> None:
    kinds = dict.fromkeys(name[1:] for name in reading.fields)
    if not kinds:
        return
    kind = next((kind for kind in kinds if any(reading.fields.get(f"{axis}{kind}", [0.0]) for axis in "XY")), "AN")
    columns = [reading.fields.get(f"{axis}{kind}", []) for axis in "XY"]
    count = max(map(len, columns))
    padded = [[*column, *[0.0] * count][:count] for column in columns]
    reading.raw.field_kind, reading.raw.fields = FIELD_KINDS[kind], list(zip(*padded, strict=True))
    if reading.vignetting:
        lists = ([*reading.vignetting.get(name, ()), *[0.0] * count][:count] for name in VIGNETTING)
        rows = list(zip(*lists, strict=True))
        ends = tuple(PupilEnds(up, low, right) for up, low, right, _ in rows)
        skew = "VLX" in reading.vignetting and any(right != left for _, _, right, left in rows)
        reading.raw.vignetting = VignettingFactors(ends, reading.vignetting_line, skew)
