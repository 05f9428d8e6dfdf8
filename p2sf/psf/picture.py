"""From a pupil to its `Psf`: the samples in a window, the peak, the share of light."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from time import perf_counter

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.figures.compare import r_squared
from p2sf.figures.psf_data import Later, PsfFigures
from p2sf.messages import Message
from p2sf.psf.peak import Peak, peak_of
from p2sf.psf.prediction import CAUTION, EDGE_ERROR, TRACED_ERROR, predicted_error
from p2sf.psf.result import Psf
from p2sf.pupil.plane_waves import Counts, Waves, disc_words, window_reach_um
from p2sf.pupil.pupil import Pupil, PupilWaves
from p2sf.pupil.spherical_waves import SphericalWaves
from p2sf.pupil.watch import Watch
from p2sf.threads import one_blas_thread

GROWTH = 1.3  # of node counts, until two sums agree
OF_FIELD = 3.0  # times what is left of a field, of its intensity: twice that, and more where the pivots of QR are rough
FRINGES_OF_SPHERES = 1.05  # finer than those of rays are beyond a focus; so near their end contrast is next to none

Window = tuple[int, float]
"""Pixels on a side, µm per pixel."""
Light = Callable[[], float | None]
"""Returns the integral of an intensity over the whole plane, µm², in units of the unaberrated peak; None if unknown."""


@one_blas_thread
def psf_of_pupil(
    pupil: Pupil, window: Window, quality: str = "settled", rtol: float | None = None, watch: Watch | None = None
) -> Psf:
    """Return the PSF of a pupil in a window: of one sum, or with ``rtol`` of more and more nodes until two sums agree.

    A "preview" is summed in float32. Of two sums the agreement reached, relative L2 in the window, is the PSF's
    ``error``, also where more nodes than are allowed would be needed; ``sampling`` says so. Threads (`p2sf.threads`)
    share the rays, and the sum does not depend on their number. Raises GeometryError where the chief ray or every ray
    fails, SamplingError for a window that needs too many nodes, `Cancelled` where the watch says so.
    """
    started, watch, settled = perf_counter(), watch or Watch(), quality == "settled"
    if rtol is None:
        found, intensity = sum_once(pupil, window, quality, watch)
        own, reached, rays = SETTLED_TOLERANCE if settled and pupil.resolved else None, None, found.traced
        remark: Message | None = Message(intensity.dtype.name)
    else:
        found, intensity, reached, rays = _until_two_agree(pupil, window, rtol, watch)
        own = reached
        remark = None if reached <= rtol else Message("not converged: agrees to {reached:.1e} only", reached=reached)
    own, error = _with_waves_error(own, _predicted_error(pupil, reached), found.waves, intensity, centred_axis(*window))
    finest = found.waves.spread / (FRINGES_OF_SPHERES if isinstance(found.waves, SphericalWaves) else 1)
    light = pupil.light_um2 if resolved(finest, window[1]) else None
    peak = partial(peak_of, intensity, window[1], found.waves, pupil.waves_reaching, quality)
    psf = psf_of_intensity(intensity, window[1], pupil.wavelength_um, pupil.method, light, peak)
    return replace(
        psf,
        figures=replace(psf.figures, predicted_error=error),
        numbers=pupil.numbers,
        rays=rays,
        sampling=sampling_of(pupil, found, remark),
        error=own,
        seconds=perf_counter() - started,
    )


def sum_once(
    pupil: Pupil, window: Window, quality: str = "settled", watch: Watch | None = None
) -> tuple[PupilWaves, np.ndarray]:
    """Return as many waves as blur and window need, and their intensity in units of the unaberrated peak, (y, x)."""
    axis, reach = centred_axis(*window), window_reach_um(*window)
    found = pupil.sample(pupil.counts(reach, quality), reach, watch)
    if watch:
        watch.look()
    return found, found.waves.intensity(axis, axis, np.float64 if quality == "settled" else np.float32)


def _until_two_agree(
    pupil: Pupil, window: Window, rtol: float, watch: Watch
) -> tuple[PupilWaves, np.ndarray, float, int]:
    """Return (waves, their intensity, agreement, rays traced) once two successive node counts agree."""
    axis, reach = centred_axis(*window), window_reach_um(*window)
    counts = _affordable(pupil.counts(reach), watch.most)
    watch.expect(_nodes(counts) + _nodes(_raise_counts(counts)))
    found = pupil.sample(counts, reach, watch)
    before, rays = found.waves.intensity(axis, axis), found.traced
    while True:
        counts = _raise_counts(counts)
        found = pupil.sample(counts, reach, watch)
        after = found.waves.intensity(axis, axis)
        rays += found.traced
        reached = float(np.linalg.norm(after - before) / np.linalg.norm(after))
        if reached <= rtol or _nodes(_raise_counts(counts)) > watch.most:
            watch.finish()
            return found, after, reached, rays
        before = after
        watch.expect(_nodes(_raise_counts(counts)))


def _affordable(counts: Counts, most: int) -> Counts:
    """Return node counts of which those to compare with are not more than ``most``."""
    least = 2, 4
    while _nodes(_raise_counts(counts)) > most and counts > least:
        counts = 2 * max(1, round(counts[0] / GROWTH / 2)), 2 * max(2, round(counts[1] / GROWTH / 2))
    return counts


def _raise_counts(counts: Counts) -> Counts:
    radial, angular = (2 * round(GROWTH * count / 2) for count in counts)
    return radial, angular


def _nodes(counts: Counts) -> int:
    return counts[0] * counts[1] // 2


def _predicted_error(pupil: Pupil, reached: float | None) -> float:
    """Return the predicted 1 − R² of a pupil, of one sum or of two that have ``reached`` an agreement.

    Two sums that agree as a settled one promises leave nothing else: of exact rays at their nodes, or next to none.
    """
    own = predicted_error(pupil.error_waves, "fitted") + EDGE_ERROR * pupil.edges
    own += TRACED_ERROR * (pupil.interpolated and not pupil.edges)
    if reached is None:
        return max(own, SETTLED_TOLERANCE**2)
    return reached**2 if reached <= SETTLED_TOLERANCE else max(own, reached**2)


def _with_waves_error(
    own: float | None, error: float, waves: Waves, intensity: np.ndarray, axis: np.ndarray
) -> tuple[float | None, float]:
    """Return relative L2 and 1 − R² of a sum with what spherical waves left out of it, and scalar waves leave open.

    Kirchhoff's integral with and without its obliquity, the cosine of the angle to the chief ray, differ by more than
    other errors where the window is as wide as the pupil is far.
    """
    if not isinstance(waves, SphericalWaves):
        return own, error
    missed = OF_FIELD * (waves.skeleton(axis, axis, intensity.dtype).missed or 0.0)
    other = intensity * waves.obliquity(axis, axis) ** 2
    oblique = max(0.0, *(1 - r_squared(*pair) for pair in ((intensity, other), (other, intensity))))
    if own is not None:
        own = float(np.hypot(own, missed + np.sqrt(oblique) * (oblique > CAUTION)))
    return own, error + missed**2 + oblique


def sampling_of(pupil: Pupil, found: PupilWaves, remark: Message | None) -> Message:
    """Return the nodes of a sum in words, and what is to be said of it."""
    lost = (Message("{lost} rays lost", lost=found.lost),) if found.lost else ()
    parts = disc_words(found.counts), *pupil.remarks, *lost, *((remark,) if remark else ())
    return Message("{parts}", parts=parts)


def psf_of_intensity(
    intensity: np.ndarray,
    pixel_um: float,
    wavelength_um: float,
    method: str,
    light: Light | None,
    peak: Callable[[], Peak],
) -> Psf:
    """Return the PSF of an intensity in units of the unaberrated peak; what it does not state is the caller's.

    ``light``: None where samples are too far apart for their sum to be an integral (`resolved`). ``peak`` returns that
    of the continuous intensity.
    """
    total = float(intensity.sum(dtype=float))
    highest = Later(peak)

    def energy() -> float | None:
        all_light = None if light is None else light()
        return None if all_light is None else total * pixel_um**2 / all_light

    figures = PsfFigures(
        strehl=lambda: highest().value,
        peak_um=lambda: (highest().x_um, highest().y_um),
        other_peaks=lambda: highest().other_peaks,
        energy=None if light is None else energy,
    )
    return Psf(intensity / total, pixel_um, float(wavelength_um), method, figures, sum_over_peak=total)


def resolved(spread: float, pixel_um: float) -> bool:
    """Return whether samples at this distance resolve the finest fringes, 2·spread cycles per µm."""
    return 2 * spread * pixel_um <= 1
