"""From the plane waves of a pupil to its `Psf`: the samples in a window, the peak, the share of light."""

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.messages import Message
from p2sf.psf.peak import Peak, peak_on_demand
from p2sf.psf.result import Psf
from p2sf.psf.sums.plane_waves import Waves

Window = tuple[int, float]
"""Pixels on a side, µm per pixel."""


@dataclass(frozen=True)
class Origin:
    """How a PSF was computed, for its labels; ``started`` is a `perf_counter` reading."""

    method: str
    numbers: int
    rays: int
    sampling: Message
    started: float
    error: float | None = None
    predicted_error: float | None = None


def psf_of_waves(
    waves: Waves,
    window: Window,
    wavelength_um: float,
    blur_um2: float | None,
    made: Origin,
    reaching: Callable[[float], Waves | None],
    quality: str = "settled",
) -> Psf:
    """Return the PSF of plane waves in a window; a "preview" is summed in float32. ``reaching`` as `peak_of` has it."""
    axis = centred_axis(*window)
    intensity = waves.intensity(axis, axis, np.float64 if quality == "settled" else np.float32)
    peak = peak_on_demand(intensity, window[1], waves, reaching, quality)
    return psf_from_intensity(intensity, window[1], wavelength_um, blur_um2, made, peak)


def psf_from_intensity(
    intensity: np.ndarray,
    pixel_um: float,
    wavelength_um: float,
    blur_um2: float | None,
    made: Origin,
    peak: Callable[[], Peak],
) -> Psf:
    """Return the PSF of an intensity in units of the unaberrated peak.

    ``blur_um2`` is the integral of that intensity over the whole plane, None if unknown. A sum of samples is an
    integral only if the pitch is below half the period of the finest fringe; otherwise the caller passes None. ``peak``
    returns that of the continuous intensity.
    """
    total = float(intensity.sum(dtype=float))
    return Psf(
        values=intensity / total,
        pixel_um=pixel_um,
        wavelength_um=float(wavelength_um),
        method=made.method,
        strehl=lambda: peak().value,
        energy=None if blur_um2 is None else total * pixel_um**2 / blur_um2,
        numbers=made.numbers,
        rays=made.rays,
        sampling=made.sampling,
        seconds=perf_counter() - made.started,
        error=made.error,
        predicted_error=made.predicted_error,
        peak_um=lambda: (peak().x_um, peak().y_um),
        sum_over_peak=total,
    )


def resolved(spread: float, pixel_um: float) -> bool:
    """Return whether samples at this distance resolve the finest fringes, 2·spread cycles per µm."""
    return 2 * spread * pixel_um <= 1
