"""Estimated cost of the sum of a PSF (handbook 7.4)."""

import numpy as np

from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import steepest_chords


def products(coefficients: Coefficients, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the estimated number of products of the settled sum of each PSF, over broadcast coefficients.

    R rows × C columns of the pupil, folded to a quarter, are summed at h = pixels/2 + 1 places each way, the real and
    the imaginary parts even and odd in y (`psf._seidel_sum`): R·C·h products along the rows, then 2R·h² across them.
    """
    steepest_across, steepest_along = steepest_chords(coefficients)
    edge = np.abs(coefficients.na) / coefficients.wavelength_um * (pixel_um * (pixels // 2))
    rows, columns = _nodes(steepest_across + np.sqrt(2) * edge), _nodes(steepest_along + edge)
    half = pixels // 2 + 1
    found: np.ndarray = rows * half * (columns + 2 * half)
    return found


def _nodes(slope: np.ndarray) -> np.ndarray:
    """Return the nodes across the pupil that resolve a slope in waves: the number of `chords_for`, not rounded up."""
    z = 2 * np.pi * slope
    nodes: np.ndarray = (z + 7 * np.cbrt(z)) / 2 + 4
    return nodes
