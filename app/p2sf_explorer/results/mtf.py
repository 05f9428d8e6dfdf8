"""Contrast against spatial frequency."""

from dataclasses import dataclass

import numpy as np

from p2sf.metrics.perfect import diffraction_mtf
from p2sf.metrics.window import mtf
from p2sf_explorer.compute.live import Live

INTERVALS = 512  # eight between two frequencies that 128 samples resolve, so that lobes are drawn smoothly


@dataclass(frozen=True)
class Contrast:
    """Cycles per mm on the sensor; contrast of patterns along y and along x, and of a perfect lens."""

    frequency_per_mm: np.ndarray
    tangential: np.ndarray
    sagittal: np.ndarray
    perfect: np.ndarray


def contrast(live: Live) -> Contrast:
    """Return the MTF of the PSF on screen up to its pitch's Nyquist frequency or the lens's cut-off."""
    c, wavelength = live.setup.coefficients, live.setup.source.wavelength_um
    nyquist, cut_off = 500 / live.psf.pixel_um, 2000 * float(c.na) / wavelength
    found = mtf(live.psf, np.linspace(0, min(nyquist, cut_off), INTERVALS + 1))
    perfect = diffraction_mtf(found.frequency_per_mm, float(c.na), wavelength)
    return Contrast(found.frequency_per_mm, found.tangential, found.sagittal, perfect)
