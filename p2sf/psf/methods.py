"""All methods behind one function, the error each is predicted to make, and the cheapest that is good enough.

How the error is predicted is described in `prediction`. See handbook 5.6.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from time import perf_counter

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import GeometryError, RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Alternatives, Message
from p2sf.paraxial.seidel import Coefficients, check_seidel, coefficients, without_coefficients
from p2sf.psf.fitted import MOST_NODES as MOST_FITTED
from p2sf.psf.fitted import psf_of_fit
from p2sf.psf.gaussian_fit import gaussian_psf
from p2sf.psf.huygens import MOST_NODES as MOST_RAYS
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.prediction import EDGE_ERROR, SAFETY, TRACED_ERROR, predicted_error, seidel_sigma
from p2sf.psf.result import Psf
from p2sf.psf.seidel import (
    AIRY_RADIUS,
    WINDOW_AIRY_RADII,
    check_focus,
    check_quality,
    check_samples,
    seidel_psf,
    suitable_pixel_um,
)
from p2sf.psf.seidel_stack import LARGEST_NODES
from p2sf.psf.traced import MOST_NODES as MOST_TRACED
from p2sf.psf.traced import traced_psf
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.quadrature import SETTLED_TOLERANCE
from p2sf.raytrace.fit import (
    LEVELS,
    RESIDUAL_WAVES,
    Judges,
    behind_mask,
    fit,
    fit_rays,
    judging_rays,
    level_rays,
    levels_for,
)
from p2sf.raytrace.pencil import Rays, pencil, to_the_rim
from p2sf.raytrace.ray_field import steepness
from p2sf.raytrace.seen_mask import mask_seen
from p2sf.threads import one_blas_thread

AUTO = "auto"
BELOW_ONE = 1 - 2.0**-53  # the largest R² that can be asked of a choice
PITCH_RINGS = 8  # of rays, to see how far light reaches
QUICK_LEVELS = LEVELS[:2]  # fitted to the same 64 rays
TABLE_SECONDS, RAY_SECONDS = 4e-7, 4e-6  # of a node from tables of polynomials, and of a ray through a dozen surfaces


@dataclass(frozen=True)
class Choice:
    """The method to use, its predicted 1 − R², how many numbers it needs (0: rays), and what that was decided on.

    ``tried_rays`` were traced for the choice and ``lost_rays`` of them did not reach the sensor. ``allowed_error`` is
    the 1 − R² asked for; ``seidel_error`` and ``fitted_error``, that of ``fitted_numbers``, are predictions, None where
    none was made.
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

    @property
    def reason(self) -> Message:
        """Return why this method was chosen, as a sentence."""
        reason = method_of(self.method).reason
        if reason is None:
            raise ValueError(f"{self.method} is never chosen")
        return reason(self)

    @property
    def against_a_fit(self) -> Message:
        """Return why no fit will do."""
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


Cancelled = Callable[[], bool]


@dataclass(frozen=True)
class PsfRequest:
    """What a method is asked for: everything a PSF depends on; ``window`` is (samples a side, µm between samples).

    ``numbers``: of a fit, as many as ``tolerance`` asks for where None. ``converged``: whether the reference adds rays
    until two sums agree, or sums once. ``six``: coefficients in place of the lens's own, which
    ``by_hand`` are altered so that no ray judges them.
    """

    lens: Lens
    source: Source
    method: str
    window: tuple[int, float]
    quality: str = "settled"
    tolerance: float = 0.99
    clip: bool = False
    numbers: int | None = None
    converged: bool = True
    six: Coefficients | None = None
    by_hand: bool = False


def _most_by_six(mask: PupilMask) -> float:
    """Return the most nodes of six coefficients: in rows over a quarter of the pupil where nothing stands in it."""
    return 2 * LARGEST_NODES if mask.clear else MOST_FITTED / 2


@dataclass(frozen=True)
class Method:
    """A way to describe the pupil of a lens for a source, and to make a PSF from it.

    ``psf``: returns the PSF, and may poll whether it is cancelled. ``reason``: why `choose` takes it, None where it
    never does. ``six``: whether six coefficients describe the pupil, and no rays. ``previewed``: whether it has a
    "preview" that costs less. ``whole``: whether it describes the whole pupil, and knows no rims that clip it.
    ``pupil``: whether figures of the pupil can be had of it. ``node_seconds``: of a node of a settled sum on one core,
    the peak included, and ``most_nodes``: behind a mask, the mirror half of a pupil not counted.
    """

    name: str
    psf: Callable[[PsfRequest, Cancelled | None], Psf]
    reason: Callable[[Choice], Message] | None
    six: bool = False
    previewed: bool = False
    whole: bool = False
    pupil: bool = True
    node_seconds: float = TABLE_SECONDS
    most_nodes: Callable[[PupilMask], float] = lambda mask: MOST_FITTED / 2


def residual_for(tolerance: float) -> float:
    """Return the RMS phase error in waves that keeps R² of a fit above ``tolerance``; at most RESIDUAL_WAVES."""
    return min(RESIDUAL_WAVES, float(np.sqrt(max(1 - tolerance, 0) / SAFETY["fitted"]) / (2 * np.pi)))


@one_blas_thread
def choose(lens: Lens, source: Source, tolerance: float = 0.99, clip: bool = False) -> Choice:
    """Return the cheapest method whose predicted R² is at least ``tolerance``, without running the reference.

    The prediction is for the window that shows the whole PSF; in one that shows only its core the error may be larger.
    Raises GeometryError where the chief ray does not reach the sensor, RequestError for a tolerance not below 1.
    """
    _check_tolerance(tolerance, BELOW_ONE)
    allowed = 1 - tolerance
    xi, eta, weight = level_rays(levels_for(lens)[0])
    rays = pencil(lens, source, xi, eta, clip=clip)
    if not rays.passed.all():
        # Only rays know an edge: neither six coefficients nor a fit do.
        lost = int((~rays.passed).sum())
        return _by_rays(Choice("traced", EDGE_ERROR, 0, lost, xi.size, allowed), EDGE_ERROR)
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    steep, mask = steepness(rays, xi, eta), mask_seen(lens, source)
    judges = None if mask.clear else judging_rays(lens, source, mask)
    seidel = _seidel_error(c, (xi, eta, weight), rays, judges, mask) if without_coefficients(lens) is None else inf
    tried = Choice("seidel", seidel, 6, tried_rays=xi.size, allowed_error=allowed, seidel_error=seidel)
    if seidel <= allowed:
        return tried
    for level in levels_for(lens)[: len(QUICK_LEVELS)]:
        found = fit_rays(rays, level, level.rays, steep)
        found = found if judges is None else behind_mask(found, judges)
        fitted = predicted_error(found.error_waves, "fitted")
        if fitted <= allowed:
            return replace(tried, method="fitted", predicted_error=fitted, numbers=level.numbers, fitted_error=fitted)
    return _by_rays(replace(tried, fitted_error=fitted, fitted_numbers=level.numbers), TRACED_ERROR)


def _check_tolerance(tolerance: float, largest: float = 1.0) -> None:
    if not -inf < tolerance <= largest:
        raise RequestError("a tolerance of {tolerance:g}; give the R² to hold, below 1", tolerance=tolerance)


def _by_rays(tried: Choice, error: float) -> Choice:
    """Return `traced` where the error it makes is allowed, else the reference."""
    if error <= tried.allowed_error:
        return replace(tried, method="traced", predicted_error=error, numbers=0)
    return replace(tried, method="huygens", predicted_error=SETTLED_TOLERANCE**2, numbers=0)


def seidel_error(lens: Lens, source: Source, c: Coefficients) -> float:
    """Return the predicted 1 − R² of six coefficients ``c``; infinite where they do not know what rays do.

    That is where rays are lost, and for a lens that `without_coefficients` names.
    """
    if without_coefficients(lens):
        return inf
    xi, eta, weight = level_rays(levels_for(lens)[0])
    try:
        rays = pencil(lens, source, xi, eta)
    except GeometryError:  # not even the chief ray arrives
        return inf
    if not rays.passed.all():
        return inf
    mask = mask_seen(lens, source)
    judges = None if mask.clear else judging_rays(lens, source, mask)
    return _seidel_error(c, (xi, eta, weight), rays, judges, mask)


def _seidel_error(
    c: Coefficients,
    points: tuple[np.ndarray, np.ndarray, np.ndarray],
    data: Rays,
    judges: Judges | None,
    mask: PupilMask,
) -> float:
    """Return the predicted 1 − R² of six coefficients from rays, where there is a mask from those that pass it."""
    # A narrow ring spreads its light so much more.
    spread = steepness(data, *points[:2]).light_um / (1 - mask.obscuration)
    if judges is not None:
        points, data = (judges.xi, judges.eta, judges.share), judges.data
    return predicted_error(seidel_sigma(c, data, points, spread), "seidel")


@one_blas_thread
def render(
    lens: Lens,
    source: Source,
    method: str = "auto",
    pixels: int = 64,
    pixel_um: float | None = None,
    quality: str = "settled",
    tolerance: float = 0.99,
    clip: bool = False,
) -> Psf:
    """Return the PSF of one source by one method, or by the cheapest one that holds R² ≥ ``tolerance`` ("auto").

    Without ``pixel_um`` the pitch is that at which the six coefficients show the whole PSF. A fit takes as many numbers
    as ``tolerance`` asks for, 26 at least. ``clip`` applies the clear semi-diameters; where a rim does clip, methods
    that describe the whole pupil refuse it. Raises P2SFError: for an unknown method, no image, no rays, for
    samples, a quality or a tolerance that cannot be.
    """
    check_samples(pixels, pixel_um)
    check_quality(quality)
    _check_tolerance(tolerance)
    if pixel_um is None:
        pixel_um = whole_pixel_um(lens, source, pixels)
    asked = PsfRequest(lens, source, method, (pixels, pixel_um), quality, tolerance, clip)
    if method != AUTO:
        return psf_of(asked)
    choice = choose(lens, source, tolerance, clip)
    return psf_of(replace(asked, method=choice.method, numbers=choice.numbers))


def whole_pixel_um(lens: Lens, source: Source, pixels: int) -> float:
    """Return the pitch at which the window shows the whole PSF, µm, by six coefficients or, without them, by rays."""
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    if np.isfinite(c.w40):
        return float(suitable_pixel_um(c, pixels))
    check_focus(c)
    rays = pencil(lens, source, *to_the_rim(PITCH_RINGS))
    reach = float(np.nanmax(np.hypot(rays.dx, rays.dy), initial=0.0)) * UM_PER_MM
    return 2 * (reach + WINDOW_AIRY_RADII * float(AIRY_RADIUS * c.wavelength_um / c.na)) / max(1, pixels)


def method_of(name: str) -> Method:
    """Return the method of this name. Raises RequestError."""
    found = next((method for method in METHODS if method.name == name), None)
    if found is None:
        raise RequestError(
            'method "{method}" is unknown; choose {methods}', method=name, methods=Alternatives((AUTO, *NAMES))
        )
    return found


def by_six(name: str) -> bool:
    """Return whether six coefficients make the PSF of what is asked for by this name, whatever ``auto`` may choose."""
    return any(method.six for method in METHODS if method.name == name)


def psf_of(asked: PsfRequest, cancelled: Cancelled | None = None) -> Psf:
    """Return the PSF of a request. ``cancelled`` is polled between blocks of rays and ends the work with `Cancelled`.

    Raises P2SFError's kinds.
    """
    method = method_of(asked.method)
    if asked.clip and method.whole:
        check_unclipped(asked.lens, asked.source, method.name)
    return method.psf(asked, cancelled)


def _by_six(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    lens, source, c = asked.lens, asked.source, asked.six
    if c is None:
        check_seidel(lens)
        c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    psf = seidel_psf(c, *asked.window, asked.quality, mask=mask_seen(lens, source))
    if asked.by_hand:
        return psf
    psf = psf.with_fields(predicted_error=seidel_error(lens, source, c))
    straight = Message(
        "{sampling}; the aligned lens, without its tilts, decentres and irregularities", sampling=psf.sampling
    )
    return psf.with_fields(sampling=straight) if lens.misaligned else psf


def _by_fit(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    started = perf_counter()
    found = fit(asked.lens, asked.source, asked.numbers, residual_waves=residual_for(asked.tolerance))
    return psf_of_fit(found, asked.source.wavelength_um, asked.window, asked.quality, started)


def _by_traced_rays(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    return traced_psf(asked.lens, asked.source, *asked.window, asked.quality, asked.clip, cancelled)


def _by_huygens(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    tolerance = SETTLED_TOLERANCE if asked.quality == "settled" and asked.converged else None
    window, clip, quality = asked.window, asked.clip, asked.quality
    return huygens_psf(asked.lens, asked.source, *window, tolerance, cancelled=cancelled, clip=clip, quality=quality)


def _by_gaussian(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    return gaussian_psf(_by_huygens(asked, cancelled))


def check_unclipped(lens: Lens, source: Source, method: str) -> None:
    """Raise GeometryError where rims clip a pupil that this method describes as whole."""
    xi, eta, _ = level_rays(levels_for(lens)[0])
    lost = int((~pencil(lens, source, xi, eta, clip=True).passed).sum())
    if lost:
        raise GeometryError(
            "rims clip {lost} of {rays} rays, and {method} describes the whole pupil; choose traced or huygens, or "
            "leave {parameter} off",
            parameter="clip",
            lost=lost,
            rays=xi.size,
            method=method,
        )


def _six_suffice(choice: Choice) -> Message:
    return Message(
        "six coefficients keep 1 − R² ≤ {error:.1e}, where {allowed:.1e} is allowed",
        error=choice.predicted_error,
        allowed=choice.allowed_error,
    )


def _a_fit_suffices(choice: Choice) -> Message:
    return Message(
        "{numbers} numbers from {rays} rays keep 1 − R² ≤ {error:.1e}, where {allowed:.1e} is allowed and six "
        "coefficients would leave more",
        numbers=choice.numbers,
        rays=choice.tried_rays,
        error=choice.predicted_error,
        allowed=choice.allowed_error,
    )


def _rays_suffice(choice: Choice) -> Message:
    return Message("exact rays, since {because}", because=choice.against_a_fit)


def _nothing_else_suffices(choice: Choice) -> Message:
    return Message("the reference itself, since {because}", because=choice.against_a_fit)


SEIDEL = Method("seidel", _by_six, _six_suffice, six=True, previewed=True, whole=True, most_nodes=_most_by_six)
FITTED = Method("fitted", _by_fit, _a_fit_suffices, previewed=True, whole=True)
TRACED = Method("traced", _by_traced_rays, _rays_suffice, previewed=True, most_nodes=lambda mask: MOST_TRACED)
HUYGENS = Method(
    "huygens", _by_huygens, _nothing_else_suffices, node_seconds=RAY_SECONDS, most_nodes=lambda mask: MOST_RAYS
)
GAUSSIAN = replace(HUYGENS, name="gaussian", psf=_by_gaussian, reason=None, pupil=False)
METHODS = (GAUSSIAN, SEIDEL, FITTED, TRACED, HUYGENS)
"""From the cheapest description to the reference."""
NAMES = tuple(method.name for method in METHODS)
REFERENCE = NAMES[-1]
