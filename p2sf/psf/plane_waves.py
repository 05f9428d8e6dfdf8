"""From traced or fitted rays to a PSF: one plane wave per node, summed on the sensor."""

from dataclasses import dataclass
from math import sqrt
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from p2sf.messages import Message
from p2sf.psf.result import Psf
from p2sf.pupil.phasors import cosine_sine
from p2sf.pupil.quadrature import nodes_for
from p2sf.raytrace.ray_field import Steepness


@dataclass(frozen=True)
class Origin:
    """How a PSF was made, for its labels; ``started`` is a `perf_counter` reading."""

    method: str
    numbers: int
    rays: int
    sampling: Message
    started: float
    tolerance: float | None = None
    predicted_error: float | None = None


def pupil_amplitude(weight: np.ndarray, phase_waves: ArrayLike, dtype: DTypeLike = np.float64) -> np.ndarray:
    """Return weight·exp(2πi·phase), complex; whole waves are subtracted first, so that float32 stays accurate."""
    cosine, sine = cosine_sine(np.array(phase_waves, dtype=float), dtype)
    amplitude, weight = np.empty(cosine.shape, np.result_type(dtype, np.complex64)), weight.astype(dtype)
    np.multiply(cosine, weight, out=amplitude.real)
    np.multiply(sine, weight, out=amplitude.imag)
    return amplitude


def window_reach(spread: float, pixels: int, pixel_um: float) -> float:
    """Return waves per unit pupil radius of the plane waves at the window's corner."""
    return spread * pixel_um * (pixels // 2) * sqrt(2)


def counts_for(steepness: Steepness, pixels: int, pixel_um: float) -> tuple[int, int]:
    """Return (radial, angular) node counts that carry this phase over this window."""
    reach = window_reach(steepness.spread, pixels, pixel_um)
    return nodes_for(steepness.radial, reach, steepness.angular)


def disc_words(counts: tuple[int, int]) -> Message:
    """Return (radial, angular) node counts in words."""
    return Message("{radii} radii × {directions} directions", radii=counts[0], directions=counts[1])


def psf_from_intensity(
    intensity: np.ndarray, pixel_um: float, wavelength_um: float, blur_um2: float | None, made: Origin
) -> Psf:
    """Return the PSF of an intensity in units of the unaberrated peak.

    ``blur_um2`` is the integral of that intensity over the whole plane, None if unknown. A sum of samples is an
    integral only while the pitch is below half the period of the finest fringe; else the caller passes None.
    """
    total = float(intensity.sum(dtype=float))
    return Psf(
        values=intensity / total,
        pixel_um=pixel_um,
        wavelength_um=float(wavelength_um),
        method=made.method,
        strehl=float(intensity.max()),
        energy=None if blur_um2 is None else total * pixel_um**2 / blur_um2,
        numbers=made.numbers,
        rays=made.rays,
        sampling=made.sampling,
        seconds=perf_counter() - made.started,
        tolerance=made.tolerance,
        predicted_error=made.predicted_error,
    )


def resolved(spread: float, pixel_um: float) -> bool:
    """Return whether samples this far apart follow the finest fringes, 2·spread cycles per µm."""
    return 2 * spread * pixel_um <= 1
