"""The six quantities a person sets: their scale, how they are written and read, and what they mean. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from p2sf_explorer.compute.setup import Ranges
from p2sf_explorer.state.scales import (
    Linear,
    Logarithmic,
    Vergence,
    distance_ticks,
    read_distance,
    read_f_number,
    read_number,
    signed,
    significant,
    ticks,
    written_distance,
)
from p2sf_explorer.state.state import State, entry

Scale = Linear | Logarithmic | Vergence
BEYOND = "beyond ∞"  # where a file's sensor stands that no object is sharp on
F_NM, D_NM, C_NM = 486.1327, 587.5618, 656.2725  # Fraunhofer lines


@dataclass(frozen=True)
class Quantity:
    """One control: ``key`` of the State, and everything a slider and its number need to know.

    ``shown`` gives the value to display for a state and its lens (a file's default spelled out); ``buttons``
    are (label, value, tooltip); ``ticks`` are (value, label), those whose label matters most first, and ``marks``
    values that stand out, such as the fields that the file states.
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


def _plain(key: str) -> Callable[[State, Ranges], float]:
    return lambda state, ranges: entry(state, key)


def _reader(words: str, **units: float) -> Callable[[str], float]:
    """Return a reader of numbers in the quantity's own unit or followed by one of these units, with their factors."""
    known = {"": 1.0, **units}
    return lambda text: read_number(text, words, known)


def _distances(ranges: Ranges) -> Vergence:
    return Vergence(ranges.closest_mm, ranges.middle_mm)


def _focused(state: State, ranges: Ranges) -> float:
    return ranges.focused_mm if state.optics.focus_mm is None else state.optics.focus_mm


def _shift_text(value: float) -> str:
    return f"{signed(value, 0)} µm" if value else "0"


F_STOPS = tuple((stop, f"{stop:g}") for stop in (2.0, 4.0, 8.0, 16.0, 32.0, 1.4, 2.8, 5.6, 11.0, 22.0))


DEPTH = Quantity(
    key="depth_mm",
    title="Depth",
    tip="Depth: distance from the source to the first vertex. Half of the slider is from ten focal lengths to ∞; far "
    "away it is even in dioptres, 1/depth. ▾ is where the lens is focused.",
    scale=_distances,
    write=written_distance,
    read=read_distance,
    shown=_plain("depth_mm"),
    buttons=(("∞", inf, "Put the source at infinity"),),
    ticks=lambda ranges: distance_ticks(ranges.closest_mm),
    marks=lambda state, ranges: (_focused(state, ranges),),
)
FIELD = Quantity(
    key="field_deg",
    title="Field",
    tip="Field: angle of the chief ray at the entrance pupil; image height is about f′·tan(field). ▾ are the fields "
    "that the lens file states.",
    scale=lambda ranges: Linear(0.0, ranges.field_deg),
    write=lambda value: f"{signed(value, 2)}°",
    read=_reader("field angle", **{"°": 1.0, "deg": 1.0}),
    shown=_plain("field_deg"),
    ticks=lambda ranges: tuple((value, f"{text}°") for value, text in ticks(0.0, ranges.field_deg, 5)),
    marks=lambda state, ranges: ranges.stated_deg,
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
    tip="Focus distance: the sensor sits at the paraxial image of this distance, 1/s′ = 1/f′ − 1/s. "
    "beyond ∞: nearer to the lens than the image of infinity. ▾ is where the source is.",
    scale=_distances,
    write=lambda value: BEYOND if value < 0 else written_distance(value),
    read=read_distance,
    shown=_focused,
    buttons=(("∞", inf, "Focus at infinity"), ("file", None, "Put the sensor where the lens file has it")),
    ticks=lambda ranges: distance_ticks(ranges.closest_mm),
    marks=lambda state, ranges: (state.optics.depth_mm,),
)
SHIFT = Quantity(
    key="sensor_shift_um",
    title="Sensor shift",
    tip="Sensor shift Δz away from the lens, on top of focus; it adds defocus Wd = NA²Δz/(2n′λ).",
    scale=lambda ranges: Linear(-ranges.shift_um, ranges.shift_um),
    write=lambda value: f"{signed(value, 1)} µm",
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
QUANTITIES = (DEPTH, FIELD, WAVELENGTH, FOCUS, SHIFT, F_NUMBER)


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
