"""What sums cost: estimated seconds on one core, medians on an ordinary computer of the 2020s (handbook 7.4)."""

from math import log2

import numpy as np

from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import steepest_chords

TABLE_SECONDS, RAY_SECONDS = 4e-7, 4e-6  # of a node from tables of polynomials, and of a ray through a dozen surfaces
LAST_PASS = 0.4  # share of all rays of a sum that is repeated with more of them, in its last pass
COLUMN_SECONDS, PAIR_SECONDS = 4e-7, 6e-8  # of a node in a column's sum of plane waves, and of a wavelet at a place
SAMPLE_SECONDS = 1.5e-7  # of a sample of a picture, by a Fourier transform
FIT_SECONDS = {"seidel": 1e-3, "fitted": 1.8e-3}  # rays, fit and change of variables, per wavelength and height
TERM_SECONDS = 3e-5  # additionally for each coefficient of the fit beyond 26
TRANSFORM_SECONDS = 5e-9  # per sample of a kernel's transform and binary digit of its side
PIXEL_SECONDS = 3.2e-9  # the same for the convolutions, forward and inverse


def sum_seconds(node_seconds: float, nodes: float, samples: int) -> float:
    """Return the seconds of a sum over nodes, and of a Fourier transform of its samples a side."""
    return node_seconds * nodes + SAMPLE_SECONDS * samples**2


def fit_seconds(method: str, numbers: int) -> float:
    """Return the seconds for one pupil by its own rays, by a method of FIT_SECONDS with so many coefficients."""
    return FIT_SECONDS[method] + TERM_SECONDS * max(0, numbers - 26)


def transform_seconds(side: float) -> float:
    """Return the seconds of the transform of a kernel of ``side``² samples."""
    return TRANSFORM_SECONDS * side**2 * log2(max(side, 2))


def convolution_seconds(area: float) -> float:
    """Return the seconds of a transform of so many pixels, forward and inverse."""
    return PIXEL_SECONDS * area * log2(area)


def separable_products(coefficients: Coefficients, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the estimated number of products of the settled sum of each PSF, over broadcast coefficients.

    R rows × C columns of the pupil, folded to a quarter, are summed at h = pixels/2 + 1 places each way, the real and
    the imaginary parts even and odd in y (`psf.seidel_sum`): R·C·h products along the rows, then 2R·h² across them.
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
