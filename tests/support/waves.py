"""Coefficients made of plain numbers, for tests of what follows from a wavefront alone."""

import numpy as np

from p2sf.paraxial.seidel import Coefficients

NA, WAVELENGTH_UM = 0.1, 0.5


def waves(w40=0.0, w31=0.0, w22=0.0, w20=0.0, w11=0.0, wd=0.0, na=NA, wavelength_um=WAVELENGTH_UM, sign=-1):
    """Return coefficients of these waves; a real image has a negative slope (``sign``)."""
    six = (np.asarray(x, dtype=float) for x in (w40, w31, w22, w20, w11, wd))
    slope, one = np.asarray(sign * na), np.asarray(1.0)
    return Coefficients(*six, slope, one, one, 0 * one, np.asarray(wavelength_um))


def relative_l2(values, reference) -> float:
    """Return the root of Σ(values − reference)² over Σreference²."""
    return float(np.linalg.norm(values - reference) / np.linalg.norm(reference))


def r_squared(psf, reference) -> float:
    """Return 1 − Σ(ref − p)²/Σ(ref − mean)² of the two, unit sum each (DESIGN: how accuracy is stated)."""
    p, ref = psf / psf.sum(), reference / reference.sum()
    return float(1 - ((ref - p) ** 2).sum() / ((ref - ref.mean()) ** 2).sum())
