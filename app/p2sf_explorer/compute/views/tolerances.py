"""Sensitivities and ten thousand builds of the lens on screen: what they depend on, and the figures the panel shows.

They take seconds: only `question` runs on the live path, and a worker runs `Analyst.answer`.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import floor, inf, isfinite, log10

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.tolerance.builds import Builds, by_form, simulate
from p2sf.tolerance.criteria import LARGE_IS_GOOD, Criterion, best_first, harms, of_worst_field, share_of, within_limit
from p2sf.tolerance.differentials import Differentials, differentials, usual_sources
from p2sf.tolerance.errors_of_build import MOVES, Kind, Tolerance, usual_tolerances
from p2sf.tolerance.files import COMPENSATING_MM, with_compensators
from p2sf.tolerance.single import form_errors, sensitivities
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.build_errors import BuildErrors, order_errors
from p2sf_explorer.state.pinning import pin, unpin
from p2sf_explorer.state.state import State, ToleranceView, change

BUILDS = 10_000
PREPARATION = 0.4  # of the time, as progress is told, for differentials, and as much for single errors
LISTED = 50  # worst builds
BINS, LIMITS = 60, 121
MOST_PLACES = 9
MOST_SHOWN = 99.5  # per cent of the builds that histogram and yield reach
USUAL_SHARE = 80.0  # per cent of builds that keep the limit where none is asked for
TILTING_DEG = 0.05  # over which the effect of a tilt as a compensator is looked at


@dataclass(frozen=True)
class ToleranceRequest:
    """Everything sensitivities and builds depend on; ``places``: which of the tolerances are compensators."""

    lens: Lens
    sources: tuple[Source, ...]
    tolerances: tuple[Tolerance, ...]
    places: tuple[int, ...]
    frequency_per_mm: float | None
    draw: int


@dataclass(frozen=True)
class ToleranceQuestion:
    """What is asked of the lens as designed, its ``state``, and how the panel shows it."""

    request: ToleranceRequest
    view: ToleranceView
    state: State


@dataclass(frozen=True, eq=False)
class ToleranceResult:
    """The lens with one error at a time, by exact rays and by the quadratic form, and random builds."""

    request: ToleranceRequest
    known: Differentials
    alone: Builds
    form: Builds
    builds: Builds


@dataclass(frozen=True, eq=False)
class Figures:
    """What the panel shows, by its criterion in the worst field, which is written with ``places`` decimals.

    ``errors``: each tolerance, its place and by how much it makes the lens worse, the largest first, NaN where it loses
    rays; ``form_errors`` of each: how much more the form of the builds says. ``edges`` and ``counts`` of the histogram.
    ``yields``: (3, limits) limit, share of the builds that keep it and its standard error.
    ``share`` and ``error``: of ``limit``. ``worst``: number, from 0, and value of builds, the worst first.
    """

    criterion: Criterion
    places: int
    nominal: float
    errors: tuple[tuple[Tolerance, int, float], ...]
    form_errors: tuple[float, ...]
    edges: np.ndarray
    counts: np.ndarray
    yields: np.ndarray
    limit: float
    share: float
    error: float
    worst: tuple[tuple[int, float], ...]


def question(live: Live) -> View[None]:
    """Return what is asked of the lens on screen as designed: without the errors of a build that is opened."""
    state, setup = change(unpin(live.state), errors=()), live.setup
    if live.state.optics.errors:
        setup = paraxial_setup(state)
    return View(
        None, ToleranceQuestion(request_of(setup.lens, setup.source, state.tolerances), state.tolerances, state)
    )


def errors_of(found: ToleranceResult, number: int) -> BuildErrors:
    """Return the errors of a build, from 0, as a state has them."""
    amounts = found.builds.errors[number].tolist()
    pairs = zip(found.known.tolerances, amounts, strict=True)
    return order_errors([(one.kind, *one.piece, amount) for one, amount in pairs if amount])


def opened_build(state: State, found: ToleranceResult) -> int:
    """Return which build is on screen as A, from 1; 0 where none is, or it was altered."""
    number = state.tolerances.build
    known = 0 < number <= len(found.builds.errors) and errors_of(found, number - 1) == state.optics.errors
    return number if known else 0


def request_of(lens: Lens, source: Source, view: ToleranceView) -> ToleranceRequest:
    """Return the request for a lens; GeometryError for own values of surfaces that it does not have."""
    last = len(lens.surfaces)
    compensators = [compensator(kind, first or last + (kind in MOVES), to) for kind, first, to in view.compensators]
    tolerances, places = with_compensators(chosen_tolerances(lens, view), compensators)
    frequency = view.frequency_per_mm if view.criterion == "mtf" else None
    return ToleranceRequest(lens, usual_sources(lens, source), tolerances, places, frequency, view.draw)


def compensator(kind: Kind, first: int, last: int) -> Tolerance:
    """Return what is set at assembly, with the amount over which its effect is looked at."""
    tilts = kind.startswith("tilt")
    return Tolerance(kind, first, TILTING_DEG if tilts else COMPENSATING_MM, last)


def chosen_tolerances(lens: Lens, view: ToleranceView) -> tuple[Tolerance, ...]:
    """Return the tolerances of the grade, with own values of kinds, and of single ones, in their place."""
    of_kinds = {kind: amount for kind, first, _, amount in view.own if not first}
    single = {(kind, first, max(first, last)): amount for kind, first, last, amount in view.own if first}
    found = []
    for one in usual_tolerances(lens, view.grade):
        amount = single.pop((one.kind, *one.piece), of_kinds.get(one.kind, one.amount))
        found.append(replace(one, amount=amount))
    for (kind, first, last), amount in single.items():
        if last <= len(lens.surfaces):
            found.append(Tolerance(kind, first, amount, last))
    return tuple(found)


def with_own(view: ToleranceView, kinds: tuple[Kind, ...], first: int, last: int, amount: float) -> ToleranceView:
    """Return the view with own amounts of a piece, or with ``first`` 0 of all of these kinds, single ones included."""
    kept = [row for row in view.own if row[0] not in kinds or (first and row[1:3] != (first, last))]
    return replace(view, own=(*kept, *((kind, first, last, amount) for kind in kinds)))


class Analyst:
    """Answers requests, and keeps the differentials of the last one: other draws and criteria take them again."""

    def __init__(self) -> None:
        self._last: Differentials | None = None
        self._single: tuple[Builds, Builds] | None = None
        self._single_of: tuple[Differentials, tuple[int, ...], float | None] | None = None

    def answer(
        self, asked: ToleranceRequest, cancelled: Callable[[], bool], progress: Callable[[float], None]
    ) -> ToleranceResult:
        """Return the answer. Raises P2SFError where a ray is lost, and Cancelled."""
        if not asked.tolerances:
            raise GeometryError("nothing in this lens can be wrong; give it a surface with power")
        known = self._last
        if known is None or (known.lens, known.sources, known.tolerances) != (
            asked.lens,
            asked.sources,
            asked.tolerances,
        ):
            known = differentials(
                asked.lens, asked.sources, asked.tolerances, lambda share: progress(PREPARATION * share), cancelled
            )
            self._last = known
        alone, form = self._alone(known, asked, cancelled, progress)
        builds = simulate(
            known,
            BUILDS,
            asked.places,
            asked.draw,
            asked.frequency_per_mm,
            lambda share: progress(2 * PREPARATION + (1 - 2 * PREPARATION) * share),
            cancelled,
        )
        return ToleranceResult(asked, known, alone, form, builds)

    def _alone(
        self,
        known: Differentials,
        asked: ToleranceRequest,
        cancelled: Callable[[], bool],
        progress: Callable[[float], None],
    ) -> tuple[Builds, Builds]:
        """Return one error at a time by exact rays and by the form, kept for other draws of the same builds."""
        key = known, asked.places, asked.frequency_per_mm
        if self._single is None or self._single_of != key:
            alone = sensitivities(*key, lambda share: progress(PREPARATION * (1 + share)), cancelled)
            self._single, self._single_of = (alone, by_form(*key)), key
        return self._single


def figures(found: ToleranceResult, view: ToleranceView) -> Figures:
    """Return what the panel shows of a result by its criterion and limit."""
    criterion = view.criterion
    values, alone = of_worst_field(found.builds, criterion), of_worst_field(found.alone, criterion)
    good = criterion in LARGE_IS_GOOD
    limit, places = view.limit, _places(values)
    if limit is None:
        limit = round(float(np.percentile(values, 100 - USUAL_SHARE if good else USUAL_SHARE)), places)
    low, high = _reach(values, limit, criterion)
    counts, edges = np.histogram(values, BINS, (low, high))
    limits = np.linspace(low, high, LIMITS)
    yields = [share_of(within_limit(values, criterion, one)) for one in limits]
    worse = harms(found.alone, criterion, found.request.places)
    rows = [
        (one, place, float(worse[place]))
        for place, one in enumerate(found.known.tolerances)
        if place not in found.request.places
    ]
    rows.sort(key=lambda row: -row[2] if isfinite(row[2]) else -inf)
    excess = form_errors(found.form, found.alone, criterion, found.request.places)
    order = best_first(values, criterion)[::-1][:LISTED]
    return Figures(
        criterion,
        places,
        float(alone[-1]),
        tuple(rows),
        tuple(float(excess[place]) for _, place, _ in rows),
        edges,
        counts,
        np.stack([limits, *np.transpose(yields)]),
        limit,
        *share_of(within_limit(values, criterion, limit)),
        tuple((int(number), float(values[number])) for number in order),
    )


def _places(values: np.ndarray) -> int:
    """Return with how many decimals values are written, that round by little of what they differ by."""
    spread = float(values.std()) or float(abs(values).max()) or 1.0
    return min(max(0, 2 - floor(log10(spread))), MOST_PLACES)


def _reach(values: np.ndarray, limit: float, criterion: Criterion) -> tuple[float, float]:
    """Return from where to where values are shown: all but the worst, and the limit."""
    good = criterion in LARGE_IS_GOOD
    ends = np.percentile(values, (100 - MOST_SHOWN, 100.0) if good else (0.0, MOST_SHOWN))
    low, high = min(float(ends[0]), limit), max(float(ends[1]), limit)
    air = 0.02 * (high - low) or max(abs(low), 1e-6)
    return max(0.0, low - air), high + air


def with_build(asked: ToleranceQuestion, found: ToleranceResult, number: int) -> State:
    """Return the state that shows a build, from 0, as A and the designed lens as B; P2SFError without a picture."""
    made = change(pin(asked.state), errors=errors_of(found, number), tolerances_build=number + 1)
    paraxial_setup(made)
    return made


def without_build(state: State) -> State:
    """Return the state with the lens as designed, and nothing beside it."""
    return change(unpin(state), errors=(), tolerances_build=0)
