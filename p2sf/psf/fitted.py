"""The `fitted` method: a PSF from some tens of numbers, fitted to some tens of rays (handbook 5.3)."""

from dataclasses import replace
from time import perf_counter

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.picture import psf_of_pupil, sampling_of, sum_once
from p2sf.psf.result import Psf
from p2sf.pupil.fit import FittedPencil, fit
from p2sf.pupil.plane_waves import Counts
from p2sf.threads import one_blas_thread

__all__ = ["FittedPencil", "fit", "fitted_intensity", "fitted_psf", "sum_fit"]


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
    psf = psf_of_pupil(fit(lens, source, numbers), (pixels, pixel_um), quality)
    return replace(psf, seconds=perf_counter() - started)


def sum_fit(found: FittedPencil, pixels: int, pixel_um: float, quality: str = "settled") -> tuple[np.ndarray, Message]:
    """Return the intensity of a fit, (pixels, pixels), in units of the unaberrated peak, and the nodes it took."""
    made, intensity = sum_once(found, (pixels, pixel_um), quality)
    return intensity, sampling_of(found, made, Message(intensity.dtype.name))


def fitted_intensity(
    found: FittedPencil, counts: Counts, pixels: int, pixel_um: float, dtype: type = np.float64
) -> np.ndarray:
    """Return |Σ weight·exp(2πi(w + f·x))|² of a fit over its open pupil, (pixels, pixels)."""
    axis = centred_axis(pixels, pixel_um)
    return found.sample(counts).waves.intensity(axis, axis, dtype)
