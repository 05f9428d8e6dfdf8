"""The quantities a person sets: their scale, how they are written and read, and what they mean. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Any

from p2sf.lens.positions import Kind
from p2sf.parameters import FEWEST_BLADES, LARGEST_OBSCURATION, MOST_POWER, MOST_VANES, PARAMETERS
from p2sf_explorer.compute.setup import Ranges, focus_place, zoom_place
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
BEYOND = "beyond ∞"  # where a file's sensor stands that no object is sharp on
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
    marks=lambda state, ranges: ranges.stated_deg,
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
    write=lambda value: f"{with_sign(value, 1)} µm",
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


def _in_the_stop(
    key: str,
    tip: str,
    scale: Scale,
    write: Callable[[float], str],
    read: Callable[[str], float],
    ticks: tuple[tuple[float, str], ...],
    none: tuple[tuple[str, float | None, str], ...] = (),
) -> Quantity:
    """Return a quantity of the mask in the stop, whose key is its field of `PupilMask`."""

    def shown(state: State, ranges: Ranges) -> float:
        given: float | None = entry(state, key)
        return float(getattr(ranges.mask, key)) if given is None else given

    return Quantity(
        key, PARAMETERS[key].control, tip, lambda ranges: scale, write, read, shown, none, lambda ranges: ticks
    )


def _whole(words: str) -> Callable[[str], float]:
    """Return a reader of whole numbers; others are returned as they are, and the state says that they cannot be."""

    def read(text: str) -> float:
        number = read_number(text, words)
        return int(number) if number == round(number) else number

    return read


def _ratio(words: str) -> Callable[[str], float]:
    return _reader(words, **{"%": 0.01})


def _width(text: str) -> float:
    return inf if text.strip().lower() in INFINITE else _ratio("apodisation")(text)


def _labels(*values: float) -> tuple[tuple[float, str], ...]:
    return tuple((value, f"{value:g}") for value in values)


def _degrees(value: float) -> str:
    return f"{with_sign(value, 1)}°"


def _angles(*values: float) -> tuple[tuple[float, str], ...]:
    return tuple((value, f"{with_sign(value, 0)}°") for value in values)


READ_ANGLE = {"°": 1.0, "deg": 1.0}
COMMON_BLADES, WIDE_VANE, NARROW_APODISATION, LARGE_CUBIC_UM = 16, 0.2, 0.3, 10.0
OBSCURATION = _in_the_stop(
    "obscuration",
    "Obscuration ε: radius of the dark disc in the middle of the stop, as a share of the rim's. It blocks ε² of the "
    "light, narrows the core and brightens the rings.",
    Linear(0.0, LARGEST_OBSCURATION),
    lambda value: f"{value:.2f}",
    _ratio("obscuration"),
    _labels(0, 0.5, 0.25, 0.75),
)
BLADES = _in_the_stop(
    "blades",
    "Blades of the iris, their corners on the rim's circle; 0: round. An even number of blades gives as many spikes "
    "in the PSF, an odd number twice as many.",
    Stepped((0, *range(FEWEST_BLADES, COMMON_BLADES + 1))),
    lambda value: f"{value:.0f}",
    _whole("number of blades"),
    _labels(0, 5, 10, 16),
)
ROUNDNESS = _in_the_stop(
    "roundness",
    "Roundness of the blades' edges: their curvature times the rim's radius, 0 straight, 1 a circle.",
    Linear(0.0, 1.0),
    lambda value: f"{value:.2f}",
    _ratio("roundness"),
    _labels(0, 1, 0.5),
)
BLADE_ANGLE = _in_the_stop(
    "blade_angle_deg",
    "Blade angle: direction of the first corner, from the direction of the field (+η) towards +ξ.",
    Linear(-60.0, 60.0),
    _degrees,
    _reader("blade angle", **READ_ANGLE),
    _angles(0, -60, 60, -30, 30),
)
VANES = _in_the_stop(
    "vanes",
    "Vanes of the spider that holds the obscuration, from the middle to the rim, evenly spaced; 0: none. Each makes "
    "a spike at right angles to itself.",
    Stepped(tuple(range(MOST_VANES + 1))),
    lambda value: f"{value:.0f}",
    _whole("number of vanes"),
    _labels(0, 3, 6, 12),
)
VANE_WIDTH = _in_the_stop(
    "vane_width",
    "Vane width, as a share of the rim's diameter.",
    Linear(0.0, WIDE_VANE),
    lambda value: f"{value:.3f}",
    _ratio("vane width"),
    _labels(0, 0.1, 0.2),
)
VANE_ANGLE = _in_the_stop(
    "vane_angle_deg",
    "Vane angle: direction of the first vane, from the direction of the field (+η) towards +ξ.",
    Linear(-180.0, 180.0),
    _degrees,
    _reader("vane angle", **READ_ANGLE),
    _angles(0, -180, 180, -90, 90),
)
APODISATION = _in_the_stop(
    "apodisation",
    "Apodisation: the radius, as a share of the rim's, where the amplitude has fallen to 1/e and the intensity to "
    "1/e²; ∞: uniform light. It dims the rings and widens the core.",
    Vergence(NARROW_APODISATION, 1.0),
    lambda value: "∞" if value == inf else significant(value, 3),
    _width,
    ((inf, "∞"), *_labels(1, 0.5, 2)),
    (("∞", inf, "Let light through evenly"),),
)
APODISATION_POWER = _in_the_stop(
    "apodisation_power",
    "Apodisation power p of the amplitude exp(−(ρ/width)ᵖ): 2 is a Gaussian, a larger even number a super-Gaussian.",
    Stepped(tuple(range(2, MOST_POWER + 1, 2))),
    lambda value: f"{value:.0f}",
    _whole("apodisation power"),
    _labels(2, 20, 10),
)
CUBIC = _in_the_stop(
    "cubic_um",
    "Cubic phase plate: α of the optical path α(ξ³ + η³) that it adds. It blurs every depth nearly alike, so one "
    "deconvolution can remove the blur.",
    Linear(-LARGE_CUBIC_UM, LARGE_CUBIC_UM),
    lambda value: f"{with_sign(value, 2)} µm",
    _reader("cubic phase", **{"µm": 1.0, "um": 1.0, "mm": 1e3}),
    tuple((value, f"{with_sign(value, 0)} µm") for value in (0.0, -LARGE_CUBIC_UM, LARGE_CUBIC_UM)),
)


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
OF_THE_LENS = (ZOOM, FOCUS_RING)
OF_THE_SOURCE = (DEPTH, FIELD, FIELD_X, WAVELENGTH, FOCUS, SHIFT, F_NUMBER)
OF_THE_MASK = (
    *(OBSCURATION, BLADES, ROUNDNESS, BLADE_ANGLE, VANES, VANE_WIDTH, VANE_ANGLE),
    *(APODISATION, APODISATION_POWER, CUBIC),
)
QUANTITIES = (*OF_THE_LENS, *OF_THE_SOURCE, *OF_THE_MASK)


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
