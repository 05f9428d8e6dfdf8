"""The quantities a person sets: their scale, how they are written and read, and what they mean. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf
from typing import Any

from p2sf.errors import P2SFError
from p2sf.lens.positions import Kind
from p2sf.parameters import PARAMETERS, Parameter, unit_behind
from p2sf_explorer.compute.setup import Ranges, focus_place, zoom_place
from p2sf_explorer.state.limits import COUNTS, MASK
from p2sf_explorer.state.scales import (
    INFINITE,
    Linear,
    Logarithmic,
    Stepped,
    Vergence,
    distance_ticks,
    read_distance,
    read_f_number,
    read_number,
    significant,
    ticks,
    with_sign,
    written_distance,
)
from p2sf_explorer.state.state import State, entry

Scale = Linear | Logarithmic | Vergence | Stepped
BEYOND = "beyond ∞"  # where a file's sensor stands nearer than the image of a star, so that no object is sharp on it
F_NM, D_NM, C_NM = 486.1327, 587.5618, 656.2725  # Fraunhofer lines


@dataclass(frozen=True)
class Quantity:
    """One control: ``key`` of the State, and everything a slider and its number need to know.

    ``shown`` gives the value to display for a state and its lens (a file's default spelled out); ``buttons``
    are (label, value, tooltip); ``ticks`` are (value, label), those whose label matters most first, and ``marks``
    values that stand out, such as the fields that the file states. ``ring``: that of the lens which it turns.
    """

    key: str
    title: str
    tip: str
    scale: Callable[[Ranges], Scale]
    write: Callable[[float], str]
    read: Callable[[str], float]
    shown: Callable[[State, Ranges], float]
    buttons: tuple[tuple[str, float | None, str], ...] = ()
    ticks: Callable[[Ranges], tuple[tuple[float, str], ...]] = lambda ranges: ()
    marks: Callable[[State, Ranges], tuple[float, ...]] = lambda state, ranges: ()
    ring: Kind | None = None

    def entries(self, value: float | None) -> dict[str, Any]:
        """Return the entries of the state that set the quantity: a ring of focus is turned by hand or by a distance."""
        return {self.key: value} | ({"focus_mm": None} if self.ring == "focus" else {})

    def there(self, ranges: Ranges) -> bool:
        """Return whether a lens has this quantity."""
        return self.ring is None or ranges.ring(self.ring) is not None

    def text(self, value: float, ranges: Ranges) -> str:
        """Return a value as a person reads it, with the unit of the lens's own ring."""
        axis = ranges.ring(self.ring) if self.ring else None
        return f"{self.write(value)} {axis.unit}".strip() if axis else self.write(value)

    def typed(self, text: str, ranges: Ranges) -> float:
        """Return the value that a person typed, on a ring also the name of a column; P2SFError."""
        axis = ranges.ring(self.ring) if self.ring else None
        if axis is None:
            return self.read(text)
        named = dict(zip(map(str.casefold, axis.columns), axis.at, strict=True))
        plain = text.strip().casefold()
        return named[plain] if plain in named else axis.place(self.read(plain.removesuffix(axis.unit.casefold())))


def _plain(key: str) -> Callable[[State, Ranges], float]:
    return lambda state, ranges: entry(state, key)


def _reader(words: str, **units: float) -> Callable[[str], float]:
    """Return a reader of numbers in the quantity's own unit or followed by one of these units, with their factors."""
    known = {"": 1.0, **units}
    return lambda text: read_number(text, words, known)


def _distances(ranges: Ranges) -> Vergence:
    return Vergence(ranges.closest_mm, ranges.middle_mm)


def _focus_distance(state: State, ranges: Ranges) -> float:
    return ranges.focused_mm if state.optics.focus_mm is None else state.optics.focus_mm


def _shift_text(value: float) -> str:
    return f"{with_sign(value, 0)} µm" if value else "0"


def _angle_text(value: float) -> str:
    return f"{value:g}°".replace("-", "−")


def _field_ticks(ranges: Ranges) -> tuple[tuple[float, str], ...]:
    one_side = tuple((value, f"{text}°") for value, text in ticks(0.0, ranges.field_deg, 3 if ranges.both_sides else 5))
    return (*one_side, *((-v, f"−{text}") for v, text in one_side if v)) if ranges.both_sides else one_side


F_STOPS = tuple((stop, f"{stop:g}") for stop in (2.0, 4.0, 8.0, 16.0, 32.0, 1.4, 2.8, 5.6, 11.0, 22.0))


DEPTH = Quantity(
    key="depth_mm",
    title="Depth",
    tip=(
        "Depth: distance from the source to the first vertex. Half of the slider goes from ten focal lengths to ∞; "
        "far away its steps are equal in dioptres, 1/depth. ▾ marks where the lens is focused."
    ),
    scale=_distances,
    write=written_distance,
    read=read_distance,
    shown=_plain("depth_mm"),
    buttons=(("∞", inf, "Put the source at infinity"),),
    ticks=lambda ranges: distance_ticks(ranges.closest_mm),
    marks=lambda state, ranges: (_focus_distance(state, ranges),),
)
FAR_UM = 1000.0  # from it on a shift is written to whole µm, which has room for its sign
FINE_DEG = 0.1  # below it a field, such as a telescope's, is written to 1e-4°
FIELD = Quantity(
    key="field_deg",
    title="Field",
    tip=(
        "Field: angle of the chief ray at the entrance pupil; the image height is about f′·tan(field). ▾ marks the "
        "fields of the lens file."
    ),
    scale=lambda ranges: Linear(-ranges.field_deg if ranges.both_sides else 0.0, ranges.field_deg),
    write=lambda value: f"{with_sign(value, 2 if not value or abs(value) >= FINE_DEG else 4)}°",
    read=_reader("field angle", **{"°": 1.0, "deg": 1.0}),
    shown=_plain("field_deg"),
    ticks=lambda ranges: _field_ticks(ranges),
    marks=lambda state, ranges: tuple(dict.fromkeys(y for _, y in ranges.stated_deg)),
)
FIELD_X = Quantity(
    key="field_x_deg",
    title="Field in x",
    tip=(
        "Field in x: the field angle along x, for a lens that is not symmetric. The PSF is then drawn with +y "
        "pointing away from the axis, turned with its field."
    ),
    scale=lambda ranges: Linear(-ranges.field_deg, ranges.field_deg),
    write=FIELD.write,
    read=_reader("field angle along x", **{"°": 1.0, "deg": 1.0}),
    shown=_plain("field_x_deg"),
    ticks=lambda ranges: tuple((part * ranges.field_deg, _angle_text(part * ranges.field_deg)) for part in (0, -1, 1)),
    marks=lambda state, ranges: tuple(dict.fromkeys(x for x, _ in ranges.stated_deg)),
)
WAVELENGTH = Quantity(
    key="wavelength_nm",
    title="Wavelength",
    tip="Wavelength λ in vacuum; the index of each glass n(λ) follows it. F, d and C are Fraunhofer's lines.",
    scale=lambda ranges: Linear(*ranges.wavelength_nm),
    write=lambda value: f"{value:.1f} nm",
    read=_reader("wavelength", **{"nm": 1.0, "µm": 1e3, "um": 1e3}),
    shown=_plain("wavelength_nm"),
    ticks=lambda ranges: ((F_NM, "F"), (D_NM, "d"), (C_NM, "C")),
)
FOCUS = Quantity(
    key="focus_mm",
    title="Focus distance",
    tip=(
        "Focus distance: the sensor is at the paraxial image of this distance, 1/s′ = 1/f′ − 1/s. Beyond ∞ it is "
        "nearer to the lens than the image of infinity. ▾ marks where the source is."
    ),
    scale=_distances,
    write=lambda value: BEYOND if value < 0 else written_distance(value),
    read=read_distance,
    shown=_focus_distance,
    buttons=(("∞", inf, "Focus at infinity"), ("file", None, "Return the sensor to where the lens file has it")),
    ticks=lambda ranges: distance_ticks(ranges.closest_mm),
    marks=lambda state, ranges: (state.optics.depth_mm,),
)
SHIFT = Quantity(
    key="sensor_shift_um",
    title="Sensor shift",
    tip="Sensor shift Δz away from the lens, in addition to focus; it adds the defocus Wd = NA²Δz/(2n′λ).",
    scale=lambda ranges: Linear(-ranges.shift_um, ranges.shift_um),
    write=lambda value: f"{with_sign(value, 1 if abs(value) < FAR_UM else 0)} µm",
    read=_reader("sensor shift", **{"µm": 1.0, "um": 1.0, "mm": 1e3}),
    shown=_plain("sensor_shift_um"),
    ticks=lambda ranges: tuple((part * ranges.shift_um, _shift_text(part * ranges.shift_um)) for part in (0, -1, 1)),
)
F_NUMBER = Quantity(
    key="f_number",
    title="f-number",
    tip="f-number N = f′/D: focal length over the diameter of the entrance pupil.",
    scale=lambda ranges: Logarithmic(*ranges.f_number),
    write=lambda value: f"f/{significant(value, 3)}",
    read=read_f_number,
    shown=lambda state, ranges: ranges.file_f_number if state.optics.f_number is None else state.optics.f_number,
    buttons=(("file", None, "Open the lens as its file has it"),),
    ticks=lambda ranges: F_STOPS,
)


def _in_the_stop(parameter: Parameter) -> Quantity:
    """Return a quantity of the mask in the stop, as the table of parameters has it."""
    low, high = parameter.travel or parameter.typed or (0.0, 1.0)
    name, unit, words = parameter.name, unit_behind(parameter.name), str(parameter.words)
    scale: Scale = Linear(low, high)
    places = 1 if high - low > 100 else 2 if high - low > 0.5 else 3
    read = _reader(words, **UNITS[parameter.unit])
    if name in COUNTS:
        scale, places, read = Stepped(_counts_of(parameter, int(low), int(high))), 0, _whole(words)
    named = tuple((value, f"{value:g}{unit}".replace("-", "−")) for value in parameter.labels)
    plain = Quantity(
        name,
        parameter.control,
        parameter.tip,
        lambda ranges: scale,
        lambda value: f"{with_sign(value, places)}{unit}",
        read,
        lambda state, ranges: _mask_value(state, ranges, name),
        ticks=lambda ranges: named,
    )
    return replace(plain, **WIDTH) if name == "apodisation" else plain


def _mask_value(state: State, ranges: Ranges, name: str) -> float:
    given: float | None = entry(state, name)
    return float(getattr(ranges.mask, name)) if given is None else given


def _counts_of(parameter: Parameter, low: int, high: int) -> tuple[int, ...]:
    """Return the whole numbers of a range that a mask may have: blades are 0 or 3 at least, powers even."""
    found = []
    for value in range(low, high + 1):
        try:
            parameter.check(parameter.name, value)
        except P2SFError:
            continue
        found.append(value)
    return tuple(found)


def _whole(words: str) -> Callable[[str], float]:
    """Return a reader of whole numbers; others are returned as they are, and the state says that they cannot be."""

    def read(text: str) -> float:
        number = read_number(text, words)
        return int(number) if number == round(number) else number

    return read


def _width(text: str) -> float:
    return inf if text.strip().lower() in INFINITE else _reader("apodisation", **UNITS[""])(text)


UNITS = {"": {"%": 0.01}, "°": {"°": 1.0, "deg": 1.0}, "µm": {"µm": 1.0, "um": 1.0, "mm": 1e3}}
NARROW_APODISATION = 0.3
# The width of an apodisation goes to infinity, evenly in its inverse.
WIDTH: dict[str, Any] = {
    "scale": lambda ranges: Vergence(NARROW_APODISATION, 1.0),
    "write": lambda value: "∞" if value == inf else significant(value, 3),
    "read": _width,
    "ticks": lambda ranges: ((inf, "∞"), (1.0, "1"), (0.5, "0.5"), (2.0, "2")),
    "buttons": (("∞", inf, "Let light through evenly"),),
}


def _ring(kind: Kind, key: str, title: str, tip: str, place: Callable[[State], float | None]) -> Quantity:
    """Return the quantity of a ring of the lens; of a lens without it one that stands at 0."""

    def scale(ranges: Ranges) -> Linear:
        axis = ranges.ring(kind)
        return Linear(axis.low, axis.high) if axis else Linear(0.0, 1.0)

    def shown(state: State, ranges: Ranges) -> float:
        axis, there = ranges.ring(kind), place(state)
        return 0.0 if axis is None else axis.low if there is None else there

    def columns(ranges: Ranges) -> tuple[tuple[float, str], ...]:
        axis = ranges.ring(kind)
        first, *between, last = zip(axis.at, axis.columns, strict=True) if axis else ((0.0, ""),) * 2
        return (first, last, *between) if axis else ()

    def marks(state: State, ranges: Ranges) -> tuple[float, ...]:
        return tuple(at for at, _ in columns(ranges))

    return Quantity(key, title, tip, scale, _on_a_ring, _reader(title.lower()), shown, (), columns, marks, kind)


def _on_a_ring(value: float) -> str:
    return with_sign(value, 1) if abs(value) >= 10 else with_sign(value, 2)


ZOOM = _ring(
    "zoom",
    "zoom",
    "Zoom",
    "Zoom: position of the ring, on the lens's own scale. ▾ marks the columns of the lens file, between which the "
    "lens is interpolated.",
    zoom_place,
)
FOCUS_RING = _ring(
    "focus",
    "focus_position",
    "Focus",
    "Focus: position of the ring that moves groups inside the lens; a focus distance turns it too. ▾ marks the "
    "columns of the lens file.",
    focus_place,
)
RING_QUANTITIES = (ZOOM, FOCUS_RING)
SOURCE_QUANTITIES = (DEPTH, FIELD, FIELD_X, WAVELENGTH, FOCUS, SHIFT, F_NUMBER)
# The iris stands before the spider.
BEFORE_VANES = ("obscuration", "blades", "roundness", "blade_angle_deg")
MASK_QUANTITIES = tuple(
    sorted(
        (_in_the_stop(each) for each in PARAMETERS.values() if each.name in MASK),
        key=lambda quantity: quantity.key not in BEFORE_VANES,
    )
)
QUANTITIES = (*RING_QUANTITIES, *SOURCE_QUANTITIES, *MASK_QUANTITIES)


def visible_colour(wavelength_nm: float) -> str:
    """Return a display colour for a wavelength as #rrggbb: a picture of the spectrum, not colorimetry.

    Anchors chosen by eye between the spectral hues; the ends fade like the response of the eye.
    """
    anchors = (
        (380, (40, 0, 70)), (420, (90, 0, 200)), (450, (30, 40, 255)), (490, (0, 190, 230)), (520, (0, 210, 60)),
        (560, (170, 220, 0)), (585, (255, 200, 0)), (610, (255, 120, 0)), (640, (240, 30, 0)), (700, (110, 0, 0)),
    )  # fmt: skip
    held = min(max(wavelength_nm, anchors[0][0]), anchors[-1][0])
    (low, dark), (high, bright) = next((a, b) for a, b in pairwise(anchors) if held <= b[0])
    part = (held - low) / (high - low)
    red, green, blue = (round(a + part * (b - a)) for a, b in zip(dark, bright, strict=True))
    return f"#{red:02x}{green:02x}{blue:02x}"
