"""A and B side by side: both answers over one window, and what differs between them. No Qt in here."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from time import perf_counter

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.pupil.wavefront_map import WavefrontMap, disc, map_of_samples
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.deferred_sums import Request, SumCache
from p2sf_explorer.compute.live import Live, ViewFunction
from p2sf_explorer.compute.method import Least
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.state.panels import PANELS, REGISTRY
from p2sf_explorer.state.pinning import side_b
from p2sf_explorer.state.state import State
from p2sf_explorer.state.terms import TERMS

DIFFERENCE = "A − B"


@dataclass(frozen=True)
class Difference:
    """A − B: the PSFs (each of unit sum) over the larger peak, the wavefronts, the six coefficients in waves.

    ``why``: by panel, why it shows A in place of a difference.
    """

    psf: np.ndarray
    pupil: WavefrontMap
    coefficients: Mapping[str, float]
    why: Mapping[str, Message] = field(default_factory=dict)


@dataclass(frozen=True)
class Answers:
    """A's answer, B's, and the one that is on screen; B is None while nothing is pinned.

    ``beside`` is B's answer with the view of the stage, where that stands beside A's.
    """

    a: Live
    b: Live | None
    seen: Live
    beside: Live | None = None

    @property
    def pending(self) -> Request | None:
        """Return the sum of waves that A's picture stands in for, else B's."""
        return self.a.pending or (self.b.pending if self.b else None)


def answers(
    state: State,
    quality: str,
    views: Mapping[str, ViewFunction],
    last: Answers | None = None,
    cache: SumCache | None = None,
) -> Answers:
    """Return the answers for a state. While a slider moves, ``auto`` keeps the methods it had chosen in ``last``.

    ``cache`` as for `compute.live`.

    Raises P2SFError where there is no answer.
    """
    moving = quality == "preview"
    if not state.compare.pinned:
        former = last if moving else None
        kept, before = kept_method(former.a if former else None, state), former.seen.views if former else None
        a = compute.live(state, quality, views, kept, cache=cache, before=before)
        return Answers(a, None, a)
    begun, other = perf_counter(), side_b(state)
    a = compute.live(state, quality, {}, kept_method(last.a if last and moving else None, state), cache=cache)
    conditions = _Conditions(
        quality,
        kept_method(last.b if last and moving else None, other),
        window_of(a),
        cache,
        cache.version if cache else 0,
    )
    b = _b(other, conditions, prescription(other))
    if larger(window_of(b), window_of(a)):
        a = compute.live(state, quality, {}, a.method if state.optics.automatic else "", window_of(b), cache)
    return Answers(a, b, choose_side(state, a, b, views, begun), second_side(state, a, b, views, begun))


@dataclass(frozen=True)
class _Conditions:
    """What B's answer depends on besides its state; ``version`` is that of ``cache``."""

    quality: str
    kept: str
    least: Least
    cache: SumCache | None
    version: int


@lru_cache(maxsize=4)
def _b(state: State, conditions: _Conditions, lens: Lens) -> Live:
    """Return B's answer, kept while only A changes. ``lens`` is in the key because its file may change."""
    return compute.live(state, conditions.quality, {}, conditions.kept, conditions.least, conditions.cache)


def kept_method(last: Live | None, state: State) -> str:
    """Return the method that ``auto`` had chosen in the last answer, if the state still leaves it to ``auto``."""
    return last.method if last and state.optics.automatic and not last.setup.altered else ""


def window_of(live: Live) -> Least:
    """Return the samples and the width, µm, of an answer's window."""
    samples = live.psf.values.shape[-1]
    return samples, samples * live.psf.pixel_um


def larger(one: Least, other: Least) -> bool:
    """Return whether a window has more samples than another, or is wider beyond rounding."""
    return one[0] > other[0] or one[1] > other[1] * (1 + 1e-9)


def choose_side(state: State, a: Live, b: Live, views: Mapping[str, ViewFunction], begun: float) -> Live:
    """Return the answer on screen, its views computed."""
    from p2sf_explorer.compare.differences import subtract

    chosen = b if state.compare.shown == "b" else a
    chosen = compute.with_views(replace(chosen, sides=(a.state, b.state)), views, begun)
    if state.compare.shown != "difference":
        return replace(chosen, side="B" if state.compare.shown == "b" else "A")
    found = {name: subtract(name, chosen.views[name], compute.try_view(view, b)) for name, view in views.items()}
    why = {entry.key: entry.minus for entry in REGISTRY if isinstance(entry.minus, Message)}
    why |= {name: message for name, (_, message) in found.items() if message}
    minus = replace(difference(a, b), why=why)
    return replace(chosen, views={name: view for name, (view, _) in found.items()}, side=DIFFERENCE, difference=minus)


def second_side(state: State, a: Live, b: Live, views: Mapping[str, ViewFunction], begun: float) -> Live | None:
    """Return B's answer with the view of the stage, where that stands beside A's; None where A stands alone."""
    stage = state.display.stage
    if state.compare.shown != "both" or stage not in PANELS or not PANELS[stage].has_two_sides:
        return None
    view = {stage: views[stage]} if stage in views else {}
    return compute.with_views(replace(b, side="B", sides=(a.state, b.state)), view, begun)


def difference(a: Live, b: Live) -> Difference:
    """Return what differs; B's wavefront on A's samples, straight lines between its own."""
    peak = max(float(a.psf.values.max()), float(b.psf.values.max())) or 1.0
    pupil = a.pupil.waves - resample(b.pupil.waves, a.pupil.waves.shape[0])
    least = min((a.pupil, b.pupil), key=lambda side: side.clear)
    common = map_of_samples(pupil, disc(len(pupil))[2], DIFFERENCE)  # without the pixel that maps go on beyond the rim
    minus = replace(
        common,
        waves=pupil,
        outline=least.outline,
        clear=least.clear,
        iris=least.iris,
        obstructions=(*a.pupil.obstructions, *b.pupil.obstructions),
    )
    six = {name: float(getattr(a.setup.coefficients, name) - getattr(b.setup.coefficients, name)) for name in TERMS}
    return Difference((a.psf.values - b.psf.values) / peak, minus, six)


def resample(values: np.ndarray, count: int) -> np.ndarray:
    """Return a square map over the pupil at another number of samples; NaN where a neighbour is."""
    if values.shape[0] == count:
        return values
    matrix = _between(values.shape[0], count)
    empty = np.isnan(values)
    found = matrix @ np.where(empty, 0.0, values) @ matrix.T
    return np.where(matrix @ empty @ matrix.T > 0, np.nan, found)


@lru_cache(maxsize=8)
def _between(known: int, wanted: int) -> np.ndarray:
    """Return the linear interpolation between the cell centres of two grids over one length, (wanted, known)."""
    place = np.clip((np.arange(wanted) + 0.5) * known / wanted - 0.5, 0, known - 1)
    left = np.minimum(place.astype(int), known - 2)
    matrix, rows = np.zeros((wanted, known)), np.arange(wanted)
    matrix[rows, left], matrix[rows, left + 1] = left + 1 - place, place - left
    return matrix
