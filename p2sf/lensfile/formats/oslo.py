"""OSLO .len files: one command a line; surface 0 is the object, NXT goes on to the next, the last is the image."""

import re
from dataclasses import dataclass, field
from math import atan, degrees, inf

from p2sf.glass.media import MIRROR
from p2sf.lens.lens import Lens
from p2sf.lensfile.assemble import assemble, check_stop, private_glass
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawApertureKind, RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number
from p2sf.messages import Message

APERTURES: dict[str, RawApertureKind] = {
    "EBR": "entrance_pupil_diameter",  # stated as a radius
    "FNO": "image_f_number",
    "NAO": "object_na",
}
ORDERS = {"AD": 4, "AE": 6, "AF": 8, "AG": 10}
SHAPES = Message("has a shape that is not a sphere, a conic or an even asphere")
TILTS = Message("is tilted or decentred")
REFUSED = {
    **dict.fromkeys("DCX DCY DCZ TLA TLB TLC TOX TOY TOZ GC GCD BEN RCO RCD".split(), TILTS),
    **dict.fromkeys("ASP ASI ASX ASR CVX RDX SPL".split(), SHAPES),
    **dict.fromkeys("GSP GOR DOE".split(), Message("diffracts")),
    **dict.fromkeys("PFM".split(), Message("is an ideal lens for one magnification")),
    **dict.fromkeys("LMO".split(), Message("is a lens module that hides its surfaces")),
}
HARMLESS = {
    **dict.fromkeys("DES SNO NOT".split(), Message("titles, sessions and computing settings")),
    **dict.fromkeys("TCE DRW LME".split(), Message("drawing and editor settings")),
}
SOLVES = ("PY", "PYC", "PU", "PUC", "PK", "CVM", "THM")


@dataclass
class OsloReading:
    """What has been read so far; surface 0 is the object. ``glasses`` waits for the wavelengths at the end."""

    source: LensText
    notes: Notebook
    raw: RawLens = field(default_factory=RawLens)
    surfaces: list[RawSurface] = field(default_factory=lambda: [RawSurface(0, 1)])
    stated: set[int] = field(default_factory=set)  # surfaces whose thickness the file states
    object_height: float | None = None
    focal_length: tuple[float, int] | None = None  # in the file's unit, which comes later
    models: dict[int, tuple[str, list[float]]] = field(default_factory=dict)
    line: int = 0

    @property
    def surface(self) -> RawSurface:
        """Return the surface the current line belongs to."""
        return self.surfaces[-1]

    def value(self, words: list[str]) -> float:
        """Return the one number of a command; LensFileError where it is missing."""
        if len(words) < 2:
            raise self.source.error("{command}: a number is missing; complete the command", self.line, command=words[0])
        return number(words[-1], words[0], self.source, self.line)


def read_oslo(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a .len file; LensFileError with its line for tilts, gratings and shapes not known."""
    reading = OsloReading(source, notes)
    for reading.line, text in enumerate(source.lines, 1):
        for command in re.findall(r'(?:"[^"]*"|[^;"])+', text.split("//")[0]):
            words = re.findall(r'"[^"]*"|\S+', command)
            if words:
                _command(reading, words)
    _finish(reading)
    return assemble(reading.raw, sources, notes, source)


def _command(reading: OsloReading, words: list[str]) -> None:
    name = words[0].upper()
    if name == "NXT":
        reading.surfaces.append(RawSurface(len(reading.surfaces), reading.line))
    elif name in REFUSED:
        raise reading.source.error(
            "{surface} {reason} ({command}); only centred systems are read",
            reading.line,
            surface=reading.surface.name,
            reason=REFUSED[name],
            command=name,
        )
    elif name in ("AIR", "GLA", "RFL", "RFH"):
        _medium(reading, name, words)
    elif name in ON_SURFACE or name in ORDERS:
        _on_surface(reading, name, reading.value(words))
    elif re.fullmatch(r"WV\d*", name):
        _wavelengths(reading, name, words)
    elif re.fullmatch(r"WW\d*", name):
        values = [number(word, Message("weight of a wavelength"), reading.source, reading.line) for word in words[1:]]
        reading.raw.weights[int(name[2:] or 1) - 1 :] = values
    elif name in SYSTEM:
        _system(reading, name, words)
    elif name == "AST":
        reading.raw.stop = reading.surface.number
    elif name in SOLVES:
        reading.notes.add("ignored", "variables, pickups and solves, whose stored values are read")
    else:
        known = HARMLESS.get(name.rstrip("0123456789"))
        reading.notes.add("ignored", known) if known else reading.notes.add_unknown(name, reading.line)


ON_SURFACE = ("RD", "CV", "TH", "CC", "AP", "LN", "PFL")
SYSTEM = ("LEN", "UNI", "EBR", "FNO", "NAO", "ANG", "OBH", "END")


def _on_surface(reading: OsloReading, name: str, value: float) -> None:
    surface = reading.surface
    if name == "RD":
        surface.curvature = 1 / value if value else 0.0
    elif name == "CV":
        surface.curvature = value
    elif name == "PFL":
        surface.ideal_focal_length = value
    elif name == "TH":
        reading.stated.add(surface.number)
        surface.thickness = value
        if surface.number and not abs(value) < FAR:
            raise reading.source.error(
                "{surface} has an infinite thickness; give a finite one", reading.line, surface=surface.name
            )
    elif name == "CC":
        surface.conic = value
    elif name == "AP":
        surface.semi_diameter = value if value > 0 else inf
    elif name in ORDERS:
        surface.aspheric[ORDERS[name]] = value


def _medium(reading: OsloReading, name: str, words: list[str]) -> None:
    """Read AIR, RFL, GLA name, GLA index, or GLA MOD name and an index for each wavelength."""
    surface = reading.surface
    if name == "AIR":
        surface.glass = None
    elif name in ("RFL", "RFH"):
        surface.glass = RawGlass(medium=MIRROR, line=reading.line)
    elif len(words) > 2 and words[1].upper() == "MOD":
        indices = [number(word, Message("index"), reading.source, reading.line) for word in words[3:]]
        reading.models[surface.number] = words[2], indices
        surface.glass = RawGlass(words[2], line=reading.line)
    elif len(words) == 2 and re.fullmatch(r"\d\.\d+", words[1]):
        surface.glass = RawGlass(index=float(words[1]), line=reading.line)
    elif len(words) > 1:
        name = words[1].strip('"')
        # A name without a maker's prefix is one of Schott's.
        surface.glass = RawGlass(name, () if "_" in name else ("SCHOTT",), line=reading.line)


def _wavelengths(reading: OsloReading, name: str, words: list[str]) -> None:
    """Read WV and up to all wavelengths, or WVn and the n-th, µm."""
    values = [number(word, Message("wavelength"), reading.source, reading.line) for word in words[1:]]
    if not all(0.05 <= value <= 50 for value in values):
        raise reading.source.error("a wavelength is not that of light; give micrometres", reading.line)
    place = int(name[2:] or 1) - 1
    reading.raw.wavelengths_um[place:] = values
    reading.raw.wavelength_line = reading.line


def _system(reading: OsloReading, name: str, words: list[str]) -> None:
    raw = reading.raw
    if name == "LEN":
        title = next((word for word in words if word.startswith('"')), '""')
        raw.title = " ".join(title.strip('"').split())[:200]
        _state_focal_length(reading, words)
    elif name == "UNI":
        raw.unit_mm = reading.value(words)
        if not 1e-3 <= raw.unit_mm <= 1e6:
            raise reading.source.error('lens unit "{unit}" is not in mm; correct it', reading.line, unit=words[-1][:20])
    elif name in ("EBR", "FNO", "NAO"):
        value = reading.value(words)
        raw.aperture_line = reading.line
        raw.aperture = APERTURES[name], 2 * value if name == "EBR" else value
    elif name in ("ANG", "OBH"):
        raw.field_line, value = reading.line, abs(reading.value(words))
        reading.object_height = value if name == "OBH" else None
        raw.fields = [(0.0, share * value) for share in (0.0, 0.7, 1.0)] if value else [(0.0, 0.0)]


def _state_focal_length(reading: OsloReading, words: list[str]) -> None:
    """Take the focal length of LEN NEW "title" focal-length surfaces, which OSLO writes before it reads the unit."""
    numbers = [float(word) for word in words if re.fullmatch(r"[-+]?(\d+(?:\.\d*)?|\.\d+)([eE][-+]?\d+)?", word)]
    if len(numbers) > 1 and 0 < abs(numbers[0]) < FAR:
        reading.focal_length = numbers[0], reading.line


def _finish(reading: OsloReading) -> None:
    """Complete the raw lens once all lines are read."""
    raw = reading.raw
    if len(reading.surfaces) < 3:
        raise reading.source.error("the file contains no surface between object and image", len(reading.source.lines))
    first, *raw.surfaces, image = reading.surfaces
    raw.object_distance, raw.object_glass, raw.primary = first.thickness, first.glass, 0
    if reading.object_height is not None:
        raw.field_kind = "object_height"
    if not abs(raw.object_distance) < FAR:
        _angles(reading, raw)
    raw.surfaces[-1].thickness += image.thickness  # defocus
    raw.image = image
    if reading.focal_length:
        raw.state("focal_length", reading.focal_length[0] * raw.unit_mm, reading.focal_length[1])
    raw.sensor_stated = raw.surfaces[-1].number in reading.stated
    check_stop(raw, reading.source, image.line)
    if raw.stop is None:
        raw.stop = 1
        reading.notes.add("read", "no stop (AST) is stated; surface 1 is the stop, which is what OSLO takes")
    for place, (name, values) in reading.models.items():
        _model(reading, place, name, values)


def _angles(reading: OsloReading, raw: RawLens) -> None:
    """Take the object's height for an object so far away that it stands for infinity as an angle."""
    if reading.object_height is not None:
        height, distance = reading.object_height, abs(raw.object_distance)
        raw.fields = [(0.0, degrees(atan(y / distance))) for _, y in raw.fields]
        reading.notes.add("read", "the object's height of {height:g} as an angle, for it is far away", height=height)
    raw.field_kind, raw.object_distance = "angle", inf


def _model(reading: OsloReading, place: int, name: str, values: list[float]) -> None:
    """Give a surface a glass of the file's own, an index at each wavelength."""
    surface = reading.surfaces[place]
    line = (surface.glass.line if surface.glass else None) or reading.line
    medium = private_glass(name, reading.raw.wavelengths_um, values, reading.source, line)
    surface.glass = RawGlass(medium=medium, line=line)
