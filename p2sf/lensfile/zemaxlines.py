"""What each line of a .zmx file says: one small function per keyword, found by `ON_SURFACE` and `IN_SYSTEM`."""

from dataclasses import dataclass, field
from math import inf

from p2sf.lensfile import zemaxwords
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number, whole

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
