"""Perceived similarity of two pictures: the structural similarity of Wang et al. 2004."""

import numpy as np

from p2sf.errors import RequestError

SIGMA, RADIUS = 1.5, 5  # of the Gaussian window, pixels: 11 on a side (Wang et al. 2004, section III-B)
K1, K2 = 0.01, 0.03


def ssim(one: np.ndarray, two: np.ndarray, white: float = 1.0) -> float:
    """Return the mean structural similarity of two pictures, (rows, columns[, channels]), 1 for equal ones.

    (2μ₁μ₂ + C₁)(2σ₁₂ + C₂)/((μ₁² + μ₂² + C₁)(σ₁² + σ₂² + C₂)) with C = (K·white)², its means weighted by a Gaussian
    window, over all windows inside the picture and all channels (Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli,
    "Image quality assessment: from error visibility to structural similarity", IEEE Trans. Image Process. 13, 2004,
    eq. 13). It applies to displayed levels, not to linear light. RequestError for shapes that differ or
    are smaller than the window.
    """
    one, two = (np.asarray(x, np.float32) for x in (one, two))
    if one.shape != two.shape or min(one.shape[:2]) <= 2 * RADIUS:
        raise RequestError(
            "pictures of {one} and {two}; compare two of one shape, at least {least} pixels a side",
            one=one.shape,
            two=two.shape,
            least=2 * RADIUS + 1,
        )
    planes = zip(*(np.moveaxis(np.atleast_3d(x), -1, 0) for x in (one, two)), strict=True)
    return float(np.mean([_of_plane(a, b, white) for a, b in planes]))


def _of_plane(one: np.ndarray, two: np.ndarray, white: float) -> float:
    c1, c2 = (K1 * white) ** 2, (K2 * white) ** 2
    mean1, mean2 = _window_means(one), _window_means(two)
    product, square1, square2 = mean1 * mean2, mean1 * mean1, mean2 * mean2
    variances = _window_means(one * one) - square1 + _window_means(two * two) - square2
    covariance = _window_means(one * two) - product
    found = (2 * product + c1) * (2 * covariance + c2) / ((square1 + square2 + c1) * (variances + c2))
    return float(found[RADIUS:-RADIUS, RADIUS:-RADIUS].mean(dtype=float))


def _window_means(values: np.ndarray) -> np.ndarray:
    from scipy.ndimage import gaussian_filter

    found: np.ndarray = gaussian_filter(values, SIGMA, radius=RADIUS)
    return found
