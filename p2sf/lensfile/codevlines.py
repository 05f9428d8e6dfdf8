"""What each CODE V command says: one small function per command, found by `ON_SURFACE` and `IN_SYSTEM`."""

import re
from dataclasses import dataclass, field
from math import inf

from p2sf.conventions import NM_PER_UM
from p2sf.errors import GlassError
from p2sf.glass.media import Medium, measured_index
from p2sf.lensfile.codevtext import Command
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number

UNITS_MM = {"M": 1.0, "MM": 1.0, "C": 10.0, "CM": 10.0, "I": 25.4, "IN": 25.4, "INC": 25.4, "INCH": 25.4}
APERTURES = {"EPD": "entrance_pupil_diameter", "FNO": "image_f_number", "NA": "image_na", "NAO": "object_na"}
FIELD_KINDS = {"AN": "angle", "OB": "object_height", "IM": "image_height", "RI": "real_image_height"}
ORDERS = {letter: 4 + 2 * place for place, letter in enumerate("ABCDEFGHJ")}


@dataclass
class Reading:
    """What has been read so far; surface 0 is the object."""

    source: LensText
    notes: Notebook
    raw: RawLens = field(default_factory=RawLens)
    surfaces: list[RawSurface] = field(default_factory=lambda: [RawSurface(0)])
    image: RawSurface | None = None
    current: RawSurface | None = None
    radii: bool = False
    fields: dict[str, list[float]] = field(default_factory=dict)
    private: dict[str, Medium] = field(default_factory=dict)
    private_nm: list[float] | None = None
    in_private: bool = False

    def number(self, command: Command, place: int, what: str, default: float | None = None) -> float:
        """Return the number at a place of a command; a missing one is ``default`` or an error."""
        if place >= len(command.words):
            if default is not None:
                return default
            raise self.source.error(f"{command.name}: {what} is missing; complete the command", command.line)
        return number(command.words[place], what, self.source, command.line)

    def numbers(self, command: Command, what: str) -> list[float]:
        """Return all numbers of a command."""
        return [number(word, what, self.source, command.line) for word in command.words[:1000]]


def curved(value: float, is_radius: bool) -> float:
    """Return the curvature of a number that is a radius (0: a plane) or the curvature itself."""
    return (1 / value if value else 0.0) if is_radius else value


def distance(reading: Reading, value: float, surface: RawSurface, line: int) -> float:
    """Return a thickness; the object may be infinitely far, no other surface; LensFileError."""
    if abs(value) < FAR:
        return value
    if surface.number == 0:
        return inf
    raise reading.source.error(f"{surface.name} has an infinite thickness; give a finite one", line)


def read_glass(reading: Reading, command: Command, surface: RawSurface) -> None:
    """Read a glass: NAME_MAKER, a private name, nnnvvv, or nnn.vvv; REFL is a mirror."""
    word = command.words[0] if command.words else ""
    if word.upper() in ("REFL", "REFR", "AIR", ""):
        if word.upper() == "REFL":
            raise reading.source.error(
                f"{surface.name} is a mirror (REFL); only refracting lenses are read", command.line
            )
        return
    code = re.fullmatch(r"(\d{3,9})\.(\d{3,9})|(\d{3})(\d{3})", word)
    if code:
        index, abbe = (code[1], code[2]) if code[1] else (code[3], code[4])
        model = (1 + int(index) / 10 ** len(index), int(abbe) / 10 ** (len(abbe) - 2))
        surface.glass = RawGlass(model=model, line=command.line)
        return
    if re.fullmatch(r"[\d.]+", word):
        why = f'glass "{word[:20]}" is neither a name nor a six-digit code such as 517642 or 517.642; correct it'
        raise reading.source.error(f"{surface.name}: {why}", command.line)
    name, _, maker = word.rpartition("_") if "_" in word else (word, "", "")
    surface.glass = RawGlass(name, (maker.upper(),) if maker else (), line=command.line)


def read_private(reading: Reading, command: Command) -> None:
    """Read one line of a private catalogue: PWL and wavelengths in nm, or 'NAME' and an index for each."""
    reading.in_private = True
    if command.name == "PWL":
        reading.private_nm = reading.numbers(command, "wavelength")
        return
    name = command.name.strip("'\"")
    if not reading.private_nm:
        raise reading.source.error(f"private glass {name} has no wavelengths (PWL) before it; add them", command.line)
    pairs = sorted(zip(reading.private_nm, reading.numbers(command, "index"), strict=False))
    if len(pairs) != len(reading.private_nm) or len(command.words) != len(pairs):
        raise reading.source.error(f"private glass {name} has not one index per wavelength; complete it", command.line)
    try:
        table = measured_index([w / NM_PER_UM for w, _ in pairs], [n for _, n in pairs])
    except GlassError as failure:
        raise reading.source.error(f"private glass {name}: {failure}", command.line) from failure
    reading.private[name] = type(table)(table.wavelengths_um, table.values, name)
    reading.notes.add("read", f"private glass {name} as a table of {len(pairs)} indices, straight lines between them")


def _set_private(reading: Reading, command: Command) -> None:
    reading.in_private = command.name.startswith("PRV")


def _radius_mode(reading: Reading, command: Command) -> None:
    reading.radii = not command.words or command.words[0].upper().startswith("Y")


def _title(reading: Reading, command: Command) -> None:
    reading.raw.title = " ".join(command.words)[:200]


def _unit(reading: Reading, command: Command) -> None:
    unit = command.words[0].upper() if command.words else ""
    if unit not in UNITS_MM:
        raise reading.source.error(f'lens unit "{unit[:20]}" is none of M (mm), C, I; correct it', command.line)
    reading.raw.unit_mm = UNITS_MM[unit]


def _aperture(reading: Reading, command: Command) -> None:
    reading.raw.aperture = (APERTURES[command.name[:3]], reading.number(command, 0, "aperture"))
    reading.raw.aperture_line = command.line


def _wavelengths(reading: Reading, command: Command) -> None:
    values = reading.numbers(command, "wavelength")
    if not all(50 <= value <= 50_000 for value in values):
        raise reading.source.error("a wavelength is not light; give nanometres", command.line)
    reading.raw.wavelengths_um, reading.raw.wavelength_line = [value / NM_PER_UM for value in values], command.line


def _reference(reading: Reading, command: Command) -> None:
    reading.raw.primary = int(reading.number(command, 0, "reference wavelength")) - 1


def _zoom(reading: Reading, command: Command) -> None:
    reading.notes.add("caution", "the file holds several zoom positions; the first, as its surfaces show it, is read")


def _set(name: str, what: str):
    """Return a reader that sets one number of a surface."""

    def read(reading: Reading, command: Command, surface: RawSurface) -> None:
        setattr(surface, name, reading.number(command, 0, what))

    return read


def _stop(reading: Reading, command: Command, surface: RawSurface) -> None:
    reading.raw.stop = surface.number


def _label(reading: Reading, command: Command, surface: RawSurface) -> None:
    surface.label = " ".join(command.words)[:60]


def _radius(reading: Reading, command: Command, surface: RawSurface) -> None:
    surface.curvature = curved(reading.number(command, 0, "radius"), command.name.startswith("RD"))


def _thickness(reading: Reading, command: Command, surface: RawSurface) -> None:
    surface.thickness = distance(reading, reading.number(command, 0, "thickness"), surface, command.line)


def _coefficient(reading: Reading, command: Command, surface: RawSurface) -> None:
    surface.aspheric[ORDERS[command.name]] = reading.number(command, 0, "aspheric coefficient")


def _rim(reading: Reading, command: Command, surface: RawSurface) -> None:
    """Read CIR radius; an edge is not a clear rim, an obscuration or a hole is open here."""
    kind = next((word.upper() for word in command.words if word.upper() in ("EDG", "OBS", "HOL")), "")
    if kind in ("OBS", "HOL"):
        reading.notes.add("caution", "its obscuration or hole is left out", surface.number, command.line)
    if kind in ("EDG", "OBS", "HOL"):
        return
    value = reading.number(command, len(command.words) - 1, "clear rim") if command.words else 0.0
    surface.semi_diameter = value if value > 0 else inf


ONE_LETTER = {"WL", "NA", "K", *ORDERS}
ON_SURFACE = {
    "STO": _stop,
    "SLB": _label,
    "GLA": read_glass,
    "THI": _thickness,
    "K": _set("conic", "conic constant"),
    "CIR": _rim,
    **dict.fromkeys(("RDY", "CUY"), _radius),
    **dict.fromkeys(ORDERS, _coefficient),
}
IN_SYSTEM = {
    "RDM": _radius_mode,
    "TIT": _title,
    "DIM": _unit,
    "WL": _wavelengths,
    "REF": _reference,
    "ZOO": _zoom,
    "PRV": _set_private,
    "END": _set_private,
    **dict.fromkeys(APERTURES, _aperture),
}
