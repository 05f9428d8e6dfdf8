"""The perfect lens in closed form: a uniform circular pupil without aberration."""

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM
from p2sf.psf.seidel import AIRY_RADIUS


def airy_radius_um(wavelength_um: ArrayLike, na: float | np.ndarray) -> np.ndarray:
    """Return the radius of the first dark ring, 0.6098 λ/NA (first zero of J1 over 2π; Airy 1835)."""
    radius: np.ndarray = AIRY_RADIUS * np.asarray(wavelength_um) / na
    return radius


def diffraction_mtf(frequency_per_mm: ArrayLike, na: ArrayLike, wavelength_um: float | np.ndarray) -> np.ndarray:
    """Return the contrast of a perfect circular pupil at frequencies in cycles per mm; the cut-off is 2 NA/λ."""
    return circle_contrast(np.asarray(frequency_per_mm) / UM_PER_MM * wavelength_um / (2 * np.asarray(na)))


def circle_contrast(nu: ArrayLike) -> np.ndarray:
    """Return (2/π)(acos ν − ν√(1−ν²)), 0 beyond ν = 1: the autocorrelation of a disc (Goodman 2005, eq. 6-31)."""
    nu = np.clip(nu, 0.0, 1.0)
    contrast: np.ndarray = 2 / np.pi * (np.arccos(nu) - nu * np.sqrt(1 - nu * nu))
    return contrast
