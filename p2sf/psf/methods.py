"""All methods behind one function; `choosing` says which of them "auto" takes."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import hypot, inf
from time import perf_counter

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.disc.mask import PupilMask
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.errors import P2SFError, RequestError, SamplingError
from p2sf.figures.compare import flatness_of
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Alternatives, Message
from p2sf.parameters import check_samples
from p2sf.paraxial.seidel import Coefficients, check_seidel, coefficients
from p2sf.psf.choosing import AUTO_SECONDS, Choice, check_min_r2, choose
from p2sf.psf.gaussian_fit import gaussian_psf
from p2sf.psf.over_frequency import fit_over_frequency, six_over_frequency, spheres_over_frequency
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.prediction import EDGE_ERROR, residual_for, seidel_error
from p2sf.psf.result import Psf
from p2sf.psf.seidel import WINDOW_AIRY_RADII, check_focus, check_image, check_quality, seidel_psf, suitable_pixel_um
from p2sf.psf.seidel_stack import LARGEST_NODES, as_fit
from p2sf.psf.spherical import (
    fresnel_number,
    plane_wave_error,
    spherical_pupil,
    worth_spherical,
)
from p2sf.psf.traced import rtol_of_rays, traced_pupil
from p2sf.pupil.cost import RAY_SECONDS, TABLE_SECONDS, sum_seconds
from p2sf.pupil.fit import MOST_NODES as MOST_FITTED
from p2sf.pupil.fit import FittedPencil, fit
from p2sf.pupil.frequency_pupil import FrequencyPupil, pupil_of_rays
from p2sf.pupil.pupil import Pupil
from p2sf.pupil.rays import MOST_INTERPOLATED, RayPupil
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.pupil.watch import MOST_RAYS, Watch
from p2sf.raytrace.field_geometry import cone
from p2sf.raytrace.pencil import pencil, to_the_rim
from p2sf.raytrace.ray_field import AIRY_RADIUS
from p2sf.threads import one_blas_thread

AUTO = "auto"
PITCH_RINGS = 8  # of rays, to estimate the extent of the light
FIELD_SHARE = 0.01  # of the root of the 1 − R² allowed, that a sum of spherical waves may leave of the field
ROOM = 1.05  # times the flatness of a first picture, since a better one differs from it


Cancelled = Callable[[], bool]


@dataclass(frozen=True)
class PsfOptions:
    """How a PSF is made whatever it is of: "settled" or a "preview", its least R² by ``auto``, and within rims or not.

    A fit takes as many numbers as ``min_r2`` asks for, 26 at least. ``clip`` applies the clear semi-diameters: exact
    rays tell where rims are, whatever describes the pupil within them. ``sampling``: of six coefficients, as
    `seidel_psf` has it.
    """

    quality: str = "settled"
    min_r2: float = 0.99
    clip: bool = False
    sampling: str = "mdft"


USUAL = PsfOptions()


@dataclass(frozen=True)
class PsfRequest:
    """What a method is asked for: everything a PSF depends on; ``window`` is (samples a side, µm between samples).

    ``numbers``: of a fit, as many as ``min_r2`` asks for where None. ``converged``: whether the reference adds rays
    until two sums agree, or sums once. ``most_seconds``: estimated ones, of a sum whose cost is not known before.
    ``choice``: why `auto` takes the method. ``six``: coefficients in place of the lens's own, which ``by_hand`` are
    altered so that no ray checks them. ``fit``: of the method that fits, where it is known already.
    """

    lens: Lens
    source: Source
    method: str
    window: tuple[int, float]
    options: PsfOptions = USUAL
    numbers: int | None = None
    converged: bool = True
    most_seconds: float = inf
    choice: Choice | None = None
    six: Coefficients | None = None
    by_hand: bool = False
    fit: FittedPencil | None = None


def _most_by_six(mask: PupilMask) -> float:
    """Return the largest number of nodes for six coefficients: in rows over a quarter of the pupil if it is clear."""
    return 2 * LARGEST_NODES if mask.clear else MOST_FITTED / 2


@dataclass(frozen=True)
class Method:
    """A maker of the pupil of a lens for a source, and what its PSF takes.

    ``words``: its name and description in the window. ``pupil``: makes the pupil. ``over_frequency``: makes that over
    spatial frequencies of a lens, a source, ``clip`` and a turn in degrees, for figures of the pupil; None of a method
    without. ``psf``: returns the PSF, and may poll whether it is cancelled. ``settles``: whether nodes are added until
    two sums agree. ``six``: whether six coefficients describe the pupil, and no rays. ``previewed``: whether it has a
    "preview" that costs less. ``whole``: whether few numbers describe the whole pupil, of which rims leave a part.
    ``node_seconds``: of a node of a settled sum on one core, the peak included, and ``most_nodes``: behind a mask, the
    mirror half of a pupil not counted. ``nodes``: how many a sum has whatever the rays do, of a method with a grid of
    its own; None where that follows from blur and window. ``of_reference``: makes the PSF from that of the reference,
    where it takes no other way.
    """

    name: str
    words: Message
    pupil: Callable[[PsfRequest], Pupil]
    over_frequency: Callable[[Lens, Source, bool, float], FrequencyPupil] | None
    psf: Callable[[PsfRequest, Cancelled | None], Psf] = lambda asked, cancelled: _sum_pupil(asked, cancelled)
    settles: bool = False
    six: bool = False
    previewed: bool = False
    whole: bool = False
    node_seconds: float = TABLE_SECONDS
    most_nodes: Callable[[PupilMask], float] = lambda mask: MOST_FITTED / 2
    nodes: Callable[[PsfRequest], float] | None = None
    of_reference: Callable[[Psf], Psf] | None = None

    def seconds(self, nodes: float, samples: int) -> float:
        """Return the estimated seconds of a settled sum over nodes, for samples a side, on one core."""
        return sum_seconds(self.node_seconds, nodes, samples)


@one_blas_thread
def render(
    lens: Lens,
    source: Source,
    method: str = "auto",
    pixels: int = 64,
    pixel_um: float | None = None,
    options: PsfOptions = USUAL,
) -> Psf:
    """Return the PSF of one source by one method, or by the cheapest one that holds R² ≥ ``min_r2`` ("auto").

    Without ``pixel_um`` the pitch is that at which the six coefficients show the whole PSF. Raises P2SFError: for an
    unknown method, without image or rays, and for impossible samples, quality or ``min_r2``.
    """
    check_samples(pixels, pixel_um)
    check_quality(options.quality)
    check_min_r2(options.min_r2)
    if pixel_um is None:
        pixel_um = whole_pixel_um(lens, source, pixels, method)
    asked = PsfRequest(lens, source, method, (pixels, pixel_um), options)
    if method != AUTO:
        return psf_of(asked)
    psf = psf_of(chosen(asked))
    error, allowed = psf.predicted_error, 1 - options.min_r2
    if error is None or error <= allowed or error > allowed * (flatness := flatness_of(psf.values)):
        return psf
    return psf_of(chosen(asked, ROOM * flatness))


def chosen(asked: PsfRequest, flatness: float = 1.0) -> PsfRequest:
    """Return a request for a method in place of "auto", which is to take AUTO_SECONDS at most."""
    choice = choose(asked.lens, asked.source, asked.options.min_r2, asked.options.clip, asked.window, flatness)
    once = choice.method == SPHERICAL.name and choice.predicted_error > flatness * SETTLED_TOLERANCE**2
    asked = replace(asked, method=choice.method, numbers=choice.numbers, fit=choice.fit, choice=choice)
    return replace(asked, most_seconds=AUTO_SECONDS, converged=not once)


def whole_pixel_um(lens: Lens, source: Source, pixels: int, method: str = AUTO) -> float:
    """Return the pitch at which the window shows the whole PSF, µm.

    It is by six coefficients or, where there are none or a misaligned lens is not shown by them, by rays.
    """
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    if np.isfinite(c.w40) and (by_six(method) or not lens.misaligned):
        return float(suitable_pixel_um(c, pixels))
    na = cone(lens, source).na
    check_focus(na)
    rays = pencil(lens, source, *to_the_rim(PITCH_RINGS))
    reach = float(np.nanmax(np.hypot(rays.dx, rays.dy), initial=0.0)) * UM_PER_MM
    return 2 * (reach + WINDOW_AIRY_RADII * AIRY_RADIUS * source.wavelength_um / na) / max(1, pixels)


def method_of(name: str) -> Method:
    """Return the method of this name. Raises RequestError."""
    found = next((method for method in METHODS if method.name == name), None)
    if found is None:
        raise RequestError(
            'method "{method}" is unknown; choose {methods}', method=name, methods=Alternatives((AUTO, *NAMES))
        )
    return found


def by_six(name: str) -> bool:
    """Return whether a method of this name computes the PSF from six coefficients; False for ``auto``."""
    return any(method.six for method in METHODS if method.name == name)


def psf_of(asked: PsfRequest, cancelled: Cancelled | None = None) -> Psf:
    """Return the PSF of a request. ``cancelled`` is polled between blocks of rays and ends the work with `Cancelled`.

    Raises subclasses of P2SFError.
    """
    started = perf_counter()
    psf = method_of(asked.method).psf(asked, cancelled)
    seconds = perf_counter() - started
    if asked.by_hand:
        return replace(psf, seconds=seconds)
    psf = psf.with_figures(predicted_error=partial(_error_in_window, psf))
    if asked.choice is not None:
        psf = _with_promise(psf, asked.choice, 1 - asked.options.min_r2)
    number, error = (partial(_or_none, figure, asked) for figure in (_fresnel_number, _plane_wave_error))
    figures = replace(psf.figures, fresnel_number=number, plane_wave_error=error)
    return replace(psf, figures=figures, seconds=seconds)


def _error_in_window(psf: Psf) -> float | None:
    """Return the predicted 1 − R² of a picture: a method predicts that of the whole PSF, of unit flatness."""
    error = psf.predicted_error
    return None if error is None else error * flatness_of(psf.values)


def _with_promise(psf: Psf, choice: Choice, asked_error: float) -> Psf:
    """Return what `auto` made with the 1 − R² that was asked for, and with what it may miss of it in this window."""
    flatness, error = flatness_of(psf.values), psf.predicted_error
    if error is not None and choice.method != SPHERICAL.name and choice.plane_wave_error is not None:
        error += choice.plane_wave_error * (1.0 if choice.compared else max(1.0, flatness / choice.flatness))
    if error is None or psf.error is None or error <= asked_error:
        return replace(psf.with_figures(predicted_error=error), asked_error=asked_error)
    # Where the promise is not kept, the error of the sum is the smaller part of what the picture misses.
    own = hypot(psf.error, (error / flatness) ** 0.5)
    return replace(psf.with_figures(predicted_error=error), error=own, asked_error=asked_error)


def _or_none(figure: Callable[[PsfRequest], float], asked: PsfRequest) -> float | None:
    """Return a figure of the exit pupil; None where rays tell none."""
    try:
        return figure(asked)
    except P2SFError:
        return None


def _fresnel_number(asked: PsfRequest) -> float:
    return fresnel_number(asked.lens, asked.source)


def _plane_wave_error(asked: PsfRequest) -> float:
    return plane_wave_error(asked.lens, asked.source, asked.options.clip)


def _sum_pupil(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    """Return the PSF of the pupil that the method of a request makes, of one sum or until two agree."""
    left = 0.0 if asked.choice is None else FIELD_SHARE * float(np.sqrt(asked.choice.allowed_error))
    watch = Watch(cancelled=cancelled, most_seconds=asked.most_seconds, allowed=left)
    pupil = method_of(asked.method).pupil(asked)
    return psf_of_pupil(pupil, asked.window, asked.options.quality, _rtol(asked, pupil, watch), watch)


def _rtol(asked: PsfRequest, pupil: Pupil, watch: Watch) -> float | None:
    """Return the agreement that two sums need; None where one is enough, as in a preview."""
    if asked.options.quality != "settled":
        return None
    if method_of(asked.method).settles and asked.converged:
        return SETTLED_TOLERANCE
    return rtol_of_rays(pupil, asked.window, watch)


def _six_of(asked: PsfRequest) -> Coefficients:
    """Return the six coefficients of a request, or those of its lens."""
    if asked.six is not None:
        return asked.six
    check_seidel(asked.lens)
    source = asked.source
    return coefficients(asked.lens, source.depth_mm, source.field_slope, source.wavelength_um)


def _within_rims(found: FittedPencil, asked: PsfRequest) -> FittedPencil:
    """Return a pupil that is described whole with an end at the rims, where these clip."""
    if not asked.options.clip:
        return found
    return replace(found, nodes_of=partial(pupil_nodes, asked.lens, asked.source, clip=True))


def _make_six(asked: PsfRequest) -> FittedPencil:
    six = _six_of(asked)
    check_image(six)
    return _within_rims(as_fit(six, mask_seen(asked.lens, asked.source)), asked)


def _by_six(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    """Return the PSF of six coefficients: of a whole pupil by a separable sum, 5.5 times as fast as that of waves."""
    lens, options = asked.lens, asked.options
    if options.clip and options.sampling == "fft":
        raise SamplingError(
            "an FFT of square samples shows no edges of rims; use mdft, or leave {parameter} off", parameter="clip"
        )
    if options.clip:
        psf = replace(_sum_pupil(asked, cancelled), numbers=6)
    else:
        mask = mask_seen(lens, asked.source)
        psf = seidel_psf(_six_of(asked), *asked.window, options.quality, options.sampling, mask=mask)
    if asked.by_hand:
        return psf
    psf = psf.with_figures(predicted_error=partial(_error_of_six, asked))
    straight = Message(
        "{sampling}; the aligned lens, without its tilts, decentres and irregularities", sampling=psf.sampling
    )
    return replace(psf, sampling=straight) if lens.misaligned else psf


def _error_of_six(asked: PsfRequest) -> float:
    """Return the predicted 1 − R² of six coefficients, which `choose` may have found already."""
    known = None if asked.choice is None else asked.choice.seidel_error
    found = seidel_error(asked.lens, asked.source, _six_of(asked)) if known is None else known
    return found + EDGE_ERROR * asked.options.clip


def _make_fit(asked: PsfRequest) -> FittedPencil:
    found = asked.fit
    if found is None:
        found = fit(asked.lens, asked.source, asked.numbers, residual_waves=residual_for(asked.options.min_r2))
    return _within_rims(found, asked)


def _by_fit(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    psf = _sum_pupil(asked, cancelled)
    if asked.options.quality == "preview" or psf.figures.energy is None:
        return psf
    return psf.with_figures(energy=partial(_share_of_rays, psf, asked))


def _share_of_rays(psf: Psf, asked: PsfRequest) -> float | None:
    """Return the light in the window of a fit as a share of that of exact rays, whose map it follows only roughly.

    None where samples do not resolve it.
    """
    if psf.energy is None or psf.sum_over_peak is None:
        return None
    all_light = RayPupil(asked.lens, asked.source, asked.options.clip).light_um2()
    return None if all_light is None else float(psf.sum_over_peak) * psf.pixel_um**2 / all_light


def _make_traced(asked: PsfRequest) -> RayPupil:
    return traced_pupil(asked.lens, asked.source, asked.options.clip)


def _make_rays(asked: PsfRequest) -> RayPupil:
    return RayPupil(asked.lens, asked.source, asked.options.clip)


def _make_spheres(asked: PsfRequest) -> RayPupil:
    return spherical_pupil(asked.lens, asked.source, asked.options.clip)


def _by_gaussian(asked: PsfRequest, cancelled: Cancelled | None) -> Psf:
    return gaussian_psf(_sum_pupil(asked, cancelled))


SEIDEL = Method(
    "seidel",
    Message("seidel: six coefficients"),
    _make_six,
    six_over_frequency,
    _by_six,
    six=True,
    previewed=True,
    whole=True,
    most_nodes=_most_by_six,
)
FITTED = Method(
    "fitted",
    Message("fitted: polynomial from real rays"),
    _make_fit,
    fit_over_frequency,
    _by_fit,
    previewed=True,
    whole=True,
)
TRACED = Method(
    "traced",
    Message("traced: exact wavefront"),
    _make_traced,
    pupil_of_rays,
    previewed=True,
    most_nodes=lambda mask: MOST_INTERPOLATED,
)
HUYGENS = Method(
    "huygens",
    Message("huygens: the reference sum"),
    _make_rays,
    pupil_of_rays,
    settles=True,
    node_seconds=RAY_SECONDS,
    most_nodes=lambda mask: MOST_RAYS,
)
GAUSSIAN = replace(
    HUYGENS,
    name="gaussian",
    words=Message("gaussian: fitted to the reference"),
    over_frequency=None,
    psf=_by_gaussian,
    of_reference=gaussian_psf,
)
SPHERICAL = replace(
    HUYGENS,
    name="spherical",
    words=Message("spherical: waves from the exit pupil"),
    pupil=_make_spheres,
    over_frequency=spheres_over_frequency,
    node_seconds=2 * RAY_SECONDS,
)
METHODS = (GAUSSIAN, SEIDEL, FITTED, TRACED, HUYGENS, SPHERICAL)
"""From the cheapest description to the reference, and to what that is referred to where it leaves too much."""
NAMES = tuple(method.name for method in METHODS)
REFERENCE = HUYGENS.name


def reference_pupil(lens: Lens, source: Source, clip: bool = False) -> RayPupil:
    """Return the rays whose sum R² refers to: spherical waves where plane ones are predicted to miss by CAUTION."""
    if worth_spherical(lens, source, clip):
        return spherical_pupil(lens, source, clip)
    return RayPupil(lens, source, clip)
