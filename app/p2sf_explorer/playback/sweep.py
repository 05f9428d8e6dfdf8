"""A slider that moves from one value to another and back: its value at each moment. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass
from math import log
from typing import Any

from p2sf.conventions import depth_of
from p2sf.messages import Message
from p2sf_explorer.compare.contrasts import LINK_WORDS
from p2sf_explorer.compute.quantities import QUANTITIES
from p2sf_explorer.compute.setup import prescription, ranges
from p2sf_explorer.state.limits import ADDED, DRAGGED
from p2sf_explorer.state.scales import read_number, with_sign
from p2sf_explorer.state.state import State
from p2sf_explorer.state.terms import TERMS
from p2sf_explorer.state.what_if import with_added

RATIOS, VERGENCES = ("f_number",), ("depth_mm", "focus_mm", "apodisation")
USUAL_WAVES = (-2.0, 2.0)
ADDED_TITLES = "W40 added", "W31 added", "W22 added", "W20 added", "Wd added", "W11 added"  # as TERMS are ordered
TITLES = {key: LINK_WORDS[key] for key in DRAGGED} | {
    ADDED + term: title for term, title in zip(TERMS, ADDED_TITLES, strict=True)
}


@dataclass(frozen=True)
class Moment:
    """One frame of a film: the state that is on show, and the words below the picture, None for no words."""

    state: State
    caption: Message | None = None


@dataclass(frozen=True)
class SliderSweep:
    """The slider ``key`` from ``first`` to ``last`` in ``seconds``; ``write`` and ``read`` are its number's."""

    key: str
    first: float
    last: float
    seconds: float
    write: Callable[[float], str]
    read: Callable[[str], float]

    def value(self, part: float) -> float:
        """Return the value at a part (0 to 1) of the way, linear in 1/distance, in log f-number, or in the value."""
        if self.key in VERGENCES:
            vergence = (1 - part) / self.first + part / self.last
            return depth_of(vergence)
        if self.key in RATIOS:
            return self.first * (self.last / self.first) ** part
        return self.first + part * (self.last - self.first)

    def part(self, value: float) -> float:
        """Return the part of the way at which a value is, clipped to 0 to 1."""
        ends = [self._linear(x) for x in (self.first, self.last)]
        found = (self._linear(value) - ends[0]) / (ends[1] - ends[0]) if ends[0] != ends[1] else 0.0
        return min(1.0, max(0.0, found))

    def _linear(self, value: float) -> float:
        """Return the quantity in which equal times make equal changes."""
        return 1 / value if self.key in VERGENCES else log(value) if self.key in RATIOS else value

    def at(self, seconds: float) -> float:
        """Return the value so many seconds after the start: there, back, there again."""
        turns = seconds / self.seconds % 2
        return self.value(turns if turns <= 1 else 2 - turns)


def sweep(state: State) -> SliderSweep:
    """Return the sweep that the state describes, over all of the slider's travel where it names no range."""
    key = state.playback.slider
    if key.startswith(ADDED):
        first, last = state.playback.range or USUAL_WAVES
        return SliderSweep(
            key, first, last, state.playback.seconds, waves, lambda text: read_number(text, "waves", LAMBDAS)
        )
    quantity = next(quantity for quantity in QUANTITIES if quantity.key == key)
    scale = quantity.scale(ranges(prescription(state)))
    first, last = state.playback.range or (scale.low, scale.high)
    return SliderSweep(key, first, last, state.playback.seconds, quantity.write, quantity.read)


LAMBDAS = {"": 1.0, "λ": 1.0}


def waves(value: float) -> str:
    """Return a number of waves as people write it."""
    return f"{with_sign(value, 2)} λ"


def present(state: State) -> float:
    """Return where the swept slider stands."""
    key = state.playback.slider
    if key.startswith(ADDED):
        return state.what_if.added_waves[TERMS.index(key.removeprefix(ADDED))]
    quantity = next(quantity for quantity in QUANTITIES if quantity.key == key)
    return quantity.shown(state, ranges(prescription(state)))


def changes(state: State, value: float) -> dict[str, Any]:
    """Return the entries of the state that put its swept slider at a value."""
    if state.playback.slider.startswith(ADDED):
        return {"added_waves": with_added(state, state.playback.slider.removeprefix(ADDED), value)}
    return next(quantity for quantity in QUANTITIES if quantity.key == state.playback.slider).entries(value)
