"""Accuracy of the picture against the reference at the same point, in one window for all methods. No Qt.

The reference is the Huygens sum, or that of spherical waves where plane ones would miss it (`reference_pupil`).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import prod
from statistics import median

from p2sf.errors import SamplingError
from p2sf.figures.compare import r_squared, relative_l2
from p2sf.psf.methods import METHODS, PsfOptions, method_of, reference_pupil, render
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.result import Psf
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.rays import RayPupil
from p2sf.pupil.watch import Watch
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.method import PIXELS, window_um
from p2sf_explorer.compute.warnings import remedy
from p2sf_explorer.state.what_if import NO_REFERENCE

REFERENCE_TOLERANCE = 1e-3  # relative L2: R² is then known to 1e-6 or better
MOST_NODES = 250_000  # of its first pass: with the next one some ten seconds in the background
REPEATS = 3  # of each method, for a median time


@dataclass(frozen=True)
class MethodResult:
    """One method at this point: R² and relative L2 against the reference, median time, numbers and rays used."""

    method: str
    r_squared: float
    relative_l2: float
    milliseconds: float
    numbers: int
    rays: int


@dataclass(frozen=True)
class Accuracy:
    """The answer measured: its ``picture`` beside the ``reference``, its R², and ``results`` of every method if wanted.

    All of them use the window that the rays of the point ask for, so that a method has one R² at a point, whatever is
    on screen.
    """

    live: Live
    picture: Psf
    reference: Psf
    r_squared: float
    results: tuple[MethodResult, ...] = ()


def measure(
    live: Live, every_method: bool, cancelled: Callable[[], bool], progress: Callable[[float], None]
) -> Accuracy:
    """Return the accuracy of an answer, or of ``every_method`` beside it. Raises P2SFError, Cancelled among them."""
    if live.setup.altered:
        raise SamplingError(NO_REFERENCE)
    window = PIXELS["settled"], window_um(live.setup, live.state.optics.clip) / PIXELS["settled"]
    if live.psf.method == "geometric" or reference_nodes(live, window) > MOST_NODES:
        raise SamplingError("the blur is too large for a reference here; {remedy}", remedy=remedy(live.setup))
    share = 0.5 if every_method else 1.0
    pupil = reference_pupil(live.setup.lens, live.setup.source, live.state.optics.clip)
    watch = Watch(lambda part: progress(share * part), cancelled)
    reference = psf_of_pupil(pupil, window, "settled", REFERENCE_TOLERANCE, watch)
    shown = in_window(live, reference)
    results: tuple[MethodResult, ...] = ()
    if every_method:
        results = tuple(method_results(live, reference, cancelled, lambda part: progress(0.5 + part / 2)))
    return Accuracy(live, shown, reference, r_squared(shown.values, reference.values), results)


def reference_nodes(live: Live, window: tuple[int, float]) -> int:
    """Return how many nodes the first pass of the reference has. Raises as `RayPupil.counts` does."""
    pupil = RayPupil(live.setup.lens, live.setup.source, live.state.optics.clip)
    return prod(pupil.counts(window_reach_um(*window))) // 2


def in_window(live: Live, reference: Psf) -> Psf:
    """Return the picture if it stands in the reference's window, else the same method's PSF there."""
    psf = live.psf
    if (psf.values.shape, psf.pixel_um) == (reference.values.shape, reference.pixel_um):
        return psf
    return psf_by(psf.method, live, reference)


def method_results(
    live: Live, reference: Psf, cancelled: Callable[[], bool], progress: Callable[[float], None]
) -> Iterator[MethodResult]:
    """Yield every method's error and time at this point, until cancelled."""
    for number, method in enumerate(METHODS):
        if cancelled():
            return
        psfs = [psf_by(method.name, live, reference) for _ in range(REPEATS if method.whole else 1)]
        psf, milliseconds = psfs[-1], 1e3 * median(p.seconds for p in psfs)
        error = relative_l2(psf.values, reference.values)
        if method.name == reference.method:
            error = reference.error or error
        yield MethodResult(
            method.name, r_squared(psf.values, reference.values), error, milliseconds, psf.numbers, psf.rays
        )
        progress((number + 1) / len(METHODS))


def psf_by(method: str, live: Live, reference: Psf) -> Psf:
    """Return this point's PSF by one method, in the reference's window."""
    if method == reference.method:
        return reference
    derived = method_of(method).of_reference
    if derived:
        return derived(reference)
    pixels, pitch = reference.values.shape[-1], reference.pixel_um
    setup, state = live.setup, live.state
    options = PsfOptions(min_r2=state.optics.tolerance, clip=state.optics.clip)
    return render(setup.lens, setup.source, method, pixels, pitch, options)
