"""The `fitted` method: a PSF from some tens of numbers, fitted to some tens of rays (handbook 5.3)."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from time import perf_counter

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.disc.domain import ClearNodes
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.errors import SamplingError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.picture import Window, psf_of_waves, resolved
from p2sf.psf.prediction import EDGE_ERROR, predicted_error
from p2sf.psf.result import Psf
from p2sf.pupil.fit import FittedPencil, fit
from p2sf.pupil.plane_waves import Counts, Waves, counts_for, disc_words, pupil_amplitude, window_reach_um
from p2sf.pupil.vignetting import masked_blur
from p2sf.threads import one_blas_thread

__all__ = ["FittedPencil", "fit", "fitted_intensity", "fitted_psf", "fitted_waves", "psf_of_fit", "sum_fit"]

NodesOf = Callable[[Counts], ClearNodes]
MOST_NODES = 2**24  # radii × directions: some seconds of work
MOST_FOR_PEAK = 2**18  # of them for the peak alone, which is otherwise sought only in the window
PREVIEW = 0.9  # of the settled counts: 1 − R² against the settled sum is below 1e-5


@one_blas_thread
def fitted_psf(
    lens: Lens,
    source: Source,
    pixels: int,
    pixel_um: float,
    numbers: int | None = None,
    quality: str = "settled",
) -> Psf:
    """Return the PSF of the `fitted` method, with ``numbers`` coefficients or as many as the residual requires.

    "settled" sums the fit in float64 to a relative L2 error of 1e-4; "preview" sums fewer nodes in float32. Raises
    GeometryError if rays do not reach the sensor, SamplingError for a window that needs too many nodes.
    """
    started = perf_counter()
    return psf_of_fit(fit(lens, source, numbers), source.wavelength_um, (pixels, pixel_um), quality, started)


def psf_of_fit(
    found: FittedPencil,
    wavelength_um: float,
    window: Window,
    quality: str,
    started: float,
    nodes_of: NodesOf | None = None,
) -> Psf:
    """Return the PSF of a fit in a window; ``started`` is a `perf_counter` reading.

    ``nodes_of``: the nodes of (radial, angular) counts where rims end the pupil, which no polynomial knows.
    """
    counts = counts_of(found, window_reach_um(*window), quality)
    waves = fitted_waves(found, counts, window_reach_um(*window), nodes_of=nodes_of)
    light = partial(masked_blur, found, nodes_of) if resolved(found.steepness.spread, window[1]) else None
    reaching = partial(waves_reaching, found, nodes_of=nodes_of)
    psf = psf_of_waves(waves, window, wavelength_um, "fitted", light, reaching, quality)
    error = predicted_error(found.error_waves, "fitted") + EDGE_ERROR * (nodes_of is not None)
    return replace(
        psf.with_figures(predicted_error=error),
        numbers=found.numbers,
        rays=found.rays,
        sampling=nodes_in_words(counts, quality),
        error=SETTLED_TOLERANCE if quality == "settled" else None,
        seconds=perf_counter() - started,
    )


def counts_of(found: FittedPencil, reach_um: float, quality: str = "settled") -> Counts:
    """Return the node counts that resolve a fit up to a distance from the chief ray; SamplingError for too many."""
    counts = counts_for(found.steepness, reach_um, 1.0 if quality == "settled" else PREVIEW)
    if counts[0] * counts[1] > MOST_NODES:
        raise SamplingError(
            "this blur over a window {width:.3g} µm wide needs {radii} × {directions} pupil samples; bring the sensor "
            "nearer to the image, stop down, or show a smaller window",
            width=reach_um * np.sqrt(2),
            radii=counts[0],
            directions=counts[1],
        )
    return counts


def nodes_in_words(counts: Counts, quality: str) -> Message:
    """Return a description of the sum."""
    precision = "float64" if quality == "settled" else "float32"
    return Message("{nodes}, {precision}", nodes=disc_words(counts), precision=precision)


def waves_reaching(found: FittedPencil, reach_um: float, nodes_of: NodesOf | None = None) -> Waves | None:
    """Return plane waves that resolve a fit up to a distance from the chief ray; None if they are too many."""
    counts = counts_for(found.steepness, reach_um)
    return fitted_waves(found, counts, reach_um, nodes_of=nodes_of) if counts[0] * counts[1] <= MOST_FOR_PEAK else None


def fitted_waves(
    found: FittedPencil,
    counts: Counts,
    reach_um: float = np.inf,
    passed: np.ndarray | None = None,
    nodes_of: NodesOf | None = None,
) -> Waves:
    """Return the plane waves of a fit over the open part of its mask, with amplitudes of unit sum.

    ``passed``: which of these nodes transmit light, (nodes,); by default all. ``nodes_of``: as `psf_of_fit` has it.
    """
    nodes = nodes_of(counts) if nodes_of else found.level.basis.domain.over(mask_nodes(found.mask, *counts))
    whole = found.mask.clear and not nodes_of
    phase, fx, fy, amplitude = found.function.on(counts) if whole else found.function.at(nodes.xi, nodes.eta)
    if found.mask.phased:
        phase = phase + nodes.path_um / found.wavelength_um
    weight = nodes.weight * nodes.amplitude * amplitude
    if passed is not None:
        weight = np.where(passed, weight, 0.0)
    weight /= weight.sum()
    blur = found.steepness.radial / found.steepness.spread
    return Waves(pupil_amplitude(weight, phase), fx, fy, nodes.domain, blur, reach_um)


def sum_fit(found: FittedPencil, pixels: int, pixel_um: float, quality: str = "settled") -> tuple[np.ndarray, Message]:
    """Return the intensity of a fit, (pixels, pixels), in units of the unaberrated peak, and the nodes it took."""
    counts = counts_of(found, window_reach_um(pixels, pixel_um), quality)
    dtype = np.float64 if quality == "settled" else np.float32
    return fitted_intensity(found, counts, pixels, pixel_um, dtype), nodes_in_words(counts, quality)


def fitted_intensity(
    found: FittedPencil, counts: Counts, pixels: int, pixel_um: float, dtype: type = np.float64
) -> np.ndarray:
    """Return |Σ weight·exp(2πi(w + f·x))|² of a fit over its open pupil, (pixels, pixels)."""
    axis = centred_axis(pixels, pixel_um)
    return fitted_waves(found, counts).intensity(axis, axis, dtype)
