"""From the plane waves of a pupil to its `Psf`: the samples in a window, the peak, the share of light."""

from collections.abc import Callable
from functools import partial

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.figures.psf_data import Later, PsfFigures
from p2sf.psf.peak import Peak, peak_of
from p2sf.psf.result import Psf
from p2sf.pupil.plane_waves import Waves

Window = tuple[int, float]
"""Pixels on a side, µm per pixel."""
Light = Callable[[], float | None]
"""Returns the integral of an intensity over the whole plane, µm², in units of the unaberrated peak; None if unknown."""


def psf_of_waves(
    waves: Waves,
    window: Window,
    wavelength_um: float,
    method: str,
    light: Light | None,
    reaching: Callable[[float], Waves | None],
    quality: str = "settled",
) -> Psf:
    """Return the PSF of plane waves in a window; a "preview" is summed in float32.

    ``light`` as `psf_of_intensity` has it, ``reaching`` as `peak_of`.
    """
    axis = centred_axis(*window)
    intensity = waves.intensity(axis, axis, np.float64 if quality == "settled" else np.float32)
    peak = partial(peak_of, intensity, window[1], waves, reaching, quality)
    return psf_of_intensity(intensity, window[1], wavelength_um, method, light, peak)


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
