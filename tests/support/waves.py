"""Coefficients made of plain numbers, for tests of what follows from a wavefront alone."""

import numpy as np

from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import shape_coefficients

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
    """Return 1 − Σ(ref − p)²/Σ(ref − mean)² of the two, each normalised to unit sum."""
    p, ref = psf / psf.sum(), reference / reference.sum()
    return float(1 - ((ref - p) ** 2).sum() / ((ref - ref.mean()) ** 2).sum())


def mirrored(values: np.ndarray) -> np.ndarray:
    """Return an even-sized PSF turned upside down about the chief ray's sample: what a wrong sign gives."""
    return np.roll(values[..., ::-1, :], 1, axis=-2)


def rms(coefficients: Coefficients, tilt_removed: bool = True) -> np.ndarray:
    """Return the RMS of W about its mean over the disc, waves, exact; W11 left out.

    ``tilt_removed`` also takes out the tilt in coma, which moves the peak and does not lower it: (2πσ)² is then the
    Strehl ratio's loss by a small aberration (Maréchal). The variances of the orthogonal parts
    (Born & Wolf 1999, §9.2.1) add: spherical aberration with focus, coma, astigmatism.
    """
    w40, w31, w22, focus, _ = shape_coefficients(coefficients)
    mean_focus = focus + w22 / 2
    axial = 4 / 45 * w40**2 + w40 * mean_focus / 6 + mean_focus**2 / 12
    return np.sqrt(axial + w31**2 / (72 if tilt_removed else 8) + w22**2 / 24)


def rms_about_plane(waves: np.ndarray, xi: np.ndarray, eta: np.ndarray, share: np.ndarray | float = 1.0) -> float:
    """Return the RMS of a wavefront at points of these shares about the plane of least squares through it."""
    root = np.sqrt(np.broadcast_to(share, waves.shape))
    plane = np.stack([np.ones_like(waves), xi, eta], axis=1) * root[:, None]
    rest = waves * root - plane @ np.linalg.lstsq(plane, waves * root, rcond=None)[0]
    return float(np.sqrt(rest @ rest / (root @ root)))
