"""The choice of the cheapest method that is accurate enough, without running the reference.

How the errors are predicted is described in `prediction`. See handbook 5.6.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from math import hypot, inf

from p2sf.choice import first_within
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.errors import GeometryError, P2SFError, RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import coefficients, reason_against_coefficients
from p2sf.psf.prediction import EDGE_ERROR, TRACED_ERROR, USELESS, error_of_six, predicted_error
from p2sf.psf.spherical import half_window_um, is_long_comparison, plane_wave_bound, plane_wave_error
from p2sf.pupil.cost import COLUMN_SECONDS, LAST_PASS, RAY_SECONDS
from p2sf.pupil.fit import LEVELS, FittedPencil, behind_mask, fit_rays, level_rays, levels_for, trace_check_rays
from p2sf.pupil.rays import nodes_from
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.smooth_pupil import PROBE, all_reach, coarse_pencil, coarse_points, coarse_weights
from p2sf.raytrace.exit_sphere import exit_sphere
from p2sf.raytrace.pencil import Rays, pencil
from p2sf.raytrace.ray_field import steepness
from p2sf.threads import one_blas_thread

BELOW_ONE = 1 - 2.0**-53  # the largest R² that can be required of a choice
AUTO_SECONDS = 1.0  # that `auto` may take for a sum by its estimate: two passes have to agree, 5 s with all else
PLANE_SHARE = 0.9  # of the allowed error that plane waves may use up: spherical ones take fifty times as long as a fit
PLANE_NODES = 2.0  # times those of spherical waves, more than plane waves of the same blur take
WHOLE = 2.0  # times their comparison, which holds for 99.7 % of states (python -m tests.long.spherical_prediction)
COMPARED = 1.25  # the same at the samples of the picture: 0.80 to 1.21 of the difference in 134 random states
QUICK_LEVELS = LEVELS[:2]  # fitted to the same 64 rays


@dataclass(frozen=True)
class Choice:
    """The method to use, its predicted 1 − R², its number of coefficients (0: rays), and the basis of the decision.

    ``tried_rays`` were traced for the choice and ``lost_rays`` of them did not reach the sensor. ``allowed_error`` is
    the tolerated 1 − R², less that of plane waves where it counts; ``seidel_error`` and ``fitted_error``, that of
    ``fitted_numbers``, are predictions, None where none was made. ``plane_wave_error``: predicted, of plane waves
    against spherical ones. ``flatness``: by which errors count more in R² of a window than of a whole PSF. ``open``:
    whether a comparison of more nodes might still find that plane waves do.
    ``compared``: whether ``plane_wave_error`` is by two sums in this window. ``fit``: the fit made for the choice, if
    the method would make the same.
    """

    method: str
    predicted_error: float
    numbers: int
    lost_rays: int = 0
    tried_rays: int = 0
    allowed_error: float = 0.0
    seidel_error: float | None = None
    fitted_error: float | None = None
    fitted_numbers: int = 0
    plane_wave_error: float | None = None
    flatness: float = 1.0
    open: bool = False
    compared: bool = False
    fit: FittedPencil | None = field(default=None, repr=False, compare=False)

    @property
    def reason(self) -> Message:
        """Return why this method was chosen, as a sentence."""
        reason = REASONS[self.method]
        missed = self.plane_wave_error or 0.0
        if self.method == "spherical" or missed <= PLANE_SHARE * self.allowed_error:
            return reason(self)
        return Message(
            "{reason}; plane waves may miss 1 − R² = {error:.1e} here, and spherical ones would take too long",
            reason=reason(self),
            error=min(missed, USELESS),
        )

    @property
    def against_a_fit(self) -> Message:
        """Return why no fit suffices."""
        if self.lost_rays:
            return Message(
                "{lost} of {rays} rays are lost, and a smooth pupil does not describe that",
                lost=self.lost_rays,
                rays=self.tried_rays,
            )
        return Message(
            "{numbers} fitted numbers leave 1 − R² ≤ {error:.1e} only",
            numbers=self.fitted_numbers,
            error=self.fitted_error,
        )


@one_blas_thread
def choose(
    lens: Lens,
    source: Source,
    min_r2: float = 0.99,
    clip: bool = False,
    window: tuple[int, float] | None = None,
    flatness: float = 1.0,
    quick: bool = False,
) -> Choice:
    """Return the cheapest method whose predicted R² is at least ``min_r2``, without running the reference.

    The prediction is for a ``window`` (samples a side, µm between samples) with a picture of this `flatness_of`, or for
    one that shows the whole PSF. Where the sum that keeps ``min_r2`` is estimated to take more than AUTO_SECONDS, the
    best one within them is chosen, and its predicted error is above what is allowed. A ``quick`` choice leaves a long
    comparison `open`. Raises GeometryError if the chief ray does not reach the sensor, RequestError for a ``min_r2``
    not below 1.
    """
    check_min_r2(min_r2, BELOW_ONE)
    allowed = 1 - min_r2
    xi, eta = coarse_points(lens.pupil_domain)
    # Those that `traced`, and what tells the nodes of every sum, take too.
    rays = pencil(lens, source, xi, eta, clip=True) if clip else coarse_pencil(lens, source, PROBE)
    steep, weight = steepness(rays, xi, eta), coarse_weights(lens.pupil_domain)
    half = inf if window is None else window[0] * window[1] / 2
    bound = flatness * plane_wave_bound(lens, source, rays, weight, steep, half)
    left_open = quick and bound > PLANE_SHARE * allowed and is_long_comparison(lens, source, clip, half)
    compared = False
    if bound > PLANE_SHARE * allowed and not left_open:
        by_sums = _compared(lens, source, clip, half, window)
        bound, compared = min(bound, by_sums), by_sums < bound
    if bound <= PLANE_SHARE * allowed or not _sphere_is_affordable(lens, source, clip, window):
        left = allowed - bound if bound <= PLANE_SHARE * allowed else allowed
        choice = _choose_plane(lens, source, clip, rays, left / flatness)
        both = flatness * choice.predicted_error + bound
        choice = replace(choice, predicted_error=both, allowed_error=allowed, plane_wave_error=bound, flatness=flatness)
        return replace(choice, open=left_open, compared=compared)
    error = TRACED_ERROR if rays.passed.all() and not clip else EDGE_ERROR
    error = error if flatness * error <= allowed else SETTLED_TOLERANCE**2
    lost = int((~rays.passed).sum())
    return Choice(
        "spherical",
        flatness * error,
        0,
        lost,
        xi.size,
        allowed_error=allowed,
        plane_wave_error=bound,
        flatness=flatness,
        open=left_open,
        compared=compared,
    )


def _compared(lens: Lens, source: Source, clip: bool, half_um: float, window: tuple[int, float] | None) -> float:
    """Return what plane waves may miss by a comparison of two sums; infinite where it takes too many nodes, or none.

    Where rays end it would have to follow rims, which takes seconds.
    """
    if not _smooth(lens, source, clip):
        return inf
    try:
        if window is None:
            return WHOLE * plane_wave_error(lens, source, clip)
        return COMPARED * plane_wave_error(lens, source, clip, half_um, window[0])
    except P2SFError:
        return inf


def _smooth(lens: Lens, source: Source, clip: bool) -> bool:
    """Return whether all rays of the pupil arrive and nothing stands in it, so that few rays describe the rest."""
    return not clip and mask_seen(lens, source).clear and all_reach(lens, source)


def _sphere_is_affordable(lens: Lens, source: Source, clip: bool, window: tuple[int, float] | None) -> bool:
    """Return whether a sum of spherical waves with one column takes AUTO_SECONDS at most; False without a sphere."""
    try:
        smooth = _smooth(lens, source, clip)
        most = AUTO_SECONDS / (2 * COLUMN_SECONDS) if smooth else AUTO_SECONDS * LAST_PASS / RAY_SECONDS
        half = half_window_um(lens, source) if window is None else window[0] * window[1] / 2
        reach = hypot(half, half)
        if nodes_from(lens, source, reach) > PLANE_NODES * most:  # spared the neighbouring fields that a sphere takes
            return False
        sphere = exit_sphere(lens, source)
        return sphere is not None and nodes_from(lens, source, reach, sphere) <= most
    except GeometryError:
        return False


def _choose_plane(lens: Lens, source: Source, clip: bool, rays: Rays, allowed: float) -> Choice:
    """Return the cheapest method of plane waves whose predicted error is allowed, from a coarse pencil."""
    tried = _plane_choices(lens, source, clip, rays)
    choice, _ = first_within(((each, each.predicted_error) for each in tried), allowed)
    return replace(choice, allowed_error=allowed)


def _plane_choices(lens: Lens, source: Source, clip: bool, rays: Rays) -> Iterator[Choice]:
    """Yield every method of plane waves with its predicted error, the cheapest first, each with the errors before.

    Where few rays describe the pupil they are traced by now, and a fit would take rays of its own; behind a mask and
    within rims `traced` takes a ray for every node, RAY_SECONDS each, and a fit TABLE_SECONDS.
    """
    whole = bool(rays.passed.all())
    tried = Choice("", inf, 0, int((~rays.passed).sum()), rays.passed.size)
    by_rays = TRACED_ERROR if whole else EDGE_ERROR
    smooth = _smooth(lens, source, clip)
    if whole:  # only rays represent an edge; six coefficients and fits do not
        c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
        mask = mask_seen(lens, source)
        checks = None if mask.clear else trace_check_rays(lens, source, mask)
        against = reason_against_coefficients(lens)
        error = error_of_six(lens, c, rays, checks, mask) if against is None else inf
        tried = replace(tried, seidel_error=error)
        yield replace(tried, method="seidel", numbers=6, predicted_error=error)
        if smooth:
            yield replace(tried, method="traced", predicted_error=by_rays)
        few = pencil(lens, source, *level_rays(levels_for(lens)[0])[:2])
        for level in levels_for(lens)[: len(QUICK_LEVELS)]:
            found = fit_rays(few, level, level.rays)
            found = found if checks is None else behind_mask(found, checks)
            error = predicted_error(found.error_waves, "fitted")
            tried = replace(tried, fitted_error=error, fitted_numbers=level.numbers)
            own = None if clip or checks is not None else found
            yield replace(tried, method="fitted", numbers=level.numbers, predicted_error=error, fit=own)
    if not smooth:
        yield replace(tried, method="traced", predicted_error=by_rays)
    yield replace(tried, method="huygens", predicted_error=SETTLED_TOLERANCE**2)


def check_min_r2(min_r2: float, largest: float = 1.0) -> None:
    """Raise RequestError unless a least R² is finite and at most ``largest``."""
    if not -inf < min_r2 <= largest:
        raise RequestError("{parameter} is {value:g}; give the R² to hold, below 1", parameter="min_r2", value=min_r2)


def _six_suffice(choice: Choice) -> Message:
    return Message(
        "six coefficients keep 1 − R² ≤ {error:.1e}, where {allowed:.1e} is allowed",
        error=choice.predicted_error,
        allowed=choice.allowed_error,
    )


def _a_fit_suffices(choice: Choice) -> Message:
    return Message(
        "{numbers} fitted numbers keep 1 − R² ≤ {error:.1e}, where {allowed:.1e} is allowed and six coefficients would "
        "leave more",
        numbers=choice.numbers,
        error=choice.predicted_error,
        allowed=choice.allowed_error,
    )


def _rays_suffice(choice: Choice) -> Message:
    if choice.lost_rays or choice.fitted_error is not None or choice.seidel_error is None:
        return Message("exact rays, since {because}", because=choice.against_a_fit)
    return Message(
        "exact rays, which cost a single picture no more than a fit, where six coefficients may leave 1 − R² = "
        "{error:.1e}",
        error=min(choice.seidel_error, USELESS),
    )


def _nothing_else_suffices(choice: Choice) -> Message:
    return Message("the reference itself, since {because}", because=choice.against_a_fit)


def _waves_are_spherical(choice: Choice) -> Message:
    return Message(
        "spherical waves from the exit pupil, since plane ones may leave 1 − R² = {error:.1e}",
        error=min(choice.plane_wave_error or 0.0, USELESS),
    )


REASONS: dict[str, Callable[[Choice], Message]] = {
    "seidel": _six_suffice,
    "fitted": _a_fit_suffices,
    "traced": _rays_suffice,
    "huygens": _nothing_else_suffices,
    "spherical": _waves_are_spherical,
}
"""Why `choose` takes a method, of every one that it may take."""
