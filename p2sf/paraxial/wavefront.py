"""The wavefront W(ξ, η) of six coefficients and how steep it is (handbook 3.1).

In waves over the entrance-pupil disc ξ² + η² ≤ 1, η towards the field. W11 moves the image without blurring it, so it
is omitted unless ``tilt=True``.
"""

from functools import lru_cache

import numpy as np

from p2sf.conventions import FloatOrArray, is_number
from p2sf.paraxial.seidel import Coefficients

# Polar samples that find the extremes of these low-order polynomials to 1 % for random coefficients (tested).
SLOPE_RADII, SLOPE_ANGLES = 12, 25
# |4aρ³ + 2bρ| is at most |2b| or |4a + 2b|, whatever the signs; b is the focus across and along, and coma adds 3|W31|.
_BOUND = np.array([(a, c, b, 2) for a in (0, 4) for b in (0, 2) for c in (-3, 3)], dtype=float).T
CHORD_MARGIN = 1.04  # along chords the extremes are narrower: samples underestimate them by up to 4 %


def wavefront(coefficients: Coefficients, xi: FloatOrArray, eta: FloatOrArray, tilt: bool = False) -> np.ndarray:
    """Return W in waves at pupil points, shape (…coefficients, …points).

    W = W40ρ⁴ + W31ρ²η + W22η² + (W20 + Wd)ρ² [+ W11η], Pieroni et al. 2015; Welford 1986, §7.5.
    """
    xi, eta = np.asarray(xi), np.asarray(eta)
    square = xi * xi + eta * eta
    w40, w31, w22, focus, w11 = (_before(x, square.ndim) for x in shape_coefficients(coefficients, tilt))
    blur: np.ndarray = square * (w40 * square + w31 * eta + focus) + w22 * (eta * eta)
    return blur + w11 * eta if tilt else blur


def shapes(xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return the polynomials of W40, W31, W22 and W20 + Wd at pupil points, (4, points)."""
    square = xi * xi + eta * eta
    return np.stack([square**2, square * eta, eta**2, square])


def shape_coefficients(
    coefficients: Coefficients, tilt: bool = False
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, FloatOrArray]:
    """Return W40, W31, W22, W20 + Wd and (0 unless ``tilt``) W11, each an array of the coefficients' shape."""
    c = coefficients
    return c.w40, c.w31, c.w22, c.w20 + c.wd, c.w11 if tilt else 0.0


def spread(*columns: FloatOrArray) -> np.ndarray:
    """Return broadcast numbers or arrays as one array with a last axis, (…, columns)."""
    if all([is_number(x) for x in columns]):  # several times faster for a single PSF
        return np.array(columns, dtype=float)
    return np.stack(np.broadcast_arrays(*columns), axis=-1)


def _before(values: FloatOrArray, grid_ndim: int) -> np.ndarray:
    """Return values with axes of length one appended for the pupil grid."""
    values = np.asarray(values)
    return values.reshape(*values.shape, *[1] * grid_ndim)


def steepest_slope(coefficients: Coefficients, tilt: bool = False) -> np.ndarray:
    """Return the largest |∇W| over the disc, waves per unit radius, within 1 %; shape of the coefficients.

    λ/NA times this is the largest distance of a ray of this wavefront from the chief ray on the sensor.
    """
    return steepest_of(spread(*shape_coefficients(coefficients, tilt)))


def steepest_of(shape: np.ndarray) -> np.ndarray:
    """Return `steepest_slope` of W40, W31, W22, W20 + Wd and, if there is one, W11 in the last axis."""
    squares = _slopes(shape, _gradient_basis())
    steepest: np.ndarray = np.sqrt((squares[..., 0, :] + squares[..., 1, :]).max(-1))
    return steepest


def steepest_polar(coefficients: Coefficients) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest |∂W/∂ρ| and |∂W/∂θ|, waves, within 1 %, which radial and angular sampling must resolve."""
    steepest = polar_of(spread(*shape_coefficients(coefficients)[:4]))
    return steepest[..., 0], steepest[..., 1]


def polar_of(shape: np.ndarray) -> np.ndarray:
    """Return `steepest_polar`, (…, 2), of W40, W31, W22, W20 + Wd in the last axis."""
    steepest: np.ndarray = np.sqrt(_slopes(shape, _polar_basis()).max(-1))
    return steepest


def steepest_chords(coefficients: Coefficients) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest |∂W/∂t| and |∂W/∂s|, waves, to be resolved by rows and columns of `quadrature.chord_rows`.

    With η = cos t and ξ = sin s·sin t, a slope near the rim, where nodes are dense, counts little, and one inside the
    disc fully. Never too small, at most 4 % too large.
    """
    steepest = chords_of(spread(*shape_coefficients(coefficients)[:4]))
    return steepest[..., 0], steepest[..., 1]


def chords_of(shape: np.ndarray) -> np.ndarray:
    """Return `steepest_chords`, (…, 2), of W40, W31, W22, W20 + Wd in the last axis."""
    steepest: np.ndarray = CHORD_MARGIN * np.sqrt(_slopes(shape, _chord_basis()).max(-1))
    return steepest


def bound_of(shape: np.ndarray) -> np.ndarray:
    """Return a quick upper bound of |∇W| for W40, W31, W22, W20 + Wd in the last axis, with coma up to twice |∇W|."""
    bound: np.ndarray = np.abs(shape @ _BOUND).max(-1)
    return bound


def _slopes(shape: np.ndarray, basis: np.ndarray) -> np.ndarray:
    """Return the squares of Σ coefficient·basis over the shapes of the last axis, (…, 2, points)."""
    slopes: np.ndarray = (shape @ basis[: shape.shape[-1]]).reshape(*shape.shape[:-1], 2, -1)
    np.square(slopes, out=slopes)
    return slopes


@lru_cache(maxsize=1)
def _slope_points() -> tuple[np.ndarray, ...]:
    """Return ρ, sin θ and cos θ of a polar grid over the half disc, each (points,)."""
    rho = np.arange(1, SLOPE_RADII + 1)[:, None] / SLOPE_RADII
    theta = np.linspace(0, np.pi, SLOPE_ANGLES)
    return tuple(x.ravel() for x in np.broadcast_arrays(rho, np.sin(theta), np.cos(theta)))


@lru_cache(maxsize=1)
def _gradient_basis() -> np.ndarray:
    """Return ∂W/∂ξ, then ∂W/∂η of the five shapes at the slope points, (5, 2·points)."""
    rho, sine, cosine = _slope_points()
    xi, eta, none = rho * sine, rho * cosine, np.zeros_like(rho)
    across = [4 * rho**2 * xi, 2 * xi * eta, none, 2 * xi, none]
    along = [4 * rho**2 * eta, rho**2 + 2 * eta**2, 2 * eta, 2 * eta, none + 1]
    return np.concatenate([across, along], axis=1)


@lru_cache(maxsize=1)
def _chord_basis() -> np.ndarray:
    """Return ∂W/∂t = W_ξ·sin s·cos t − W_η·sin t, then ∂W/∂s = W_ξ·cos s·sin t of the five shapes, (5, 2·points)."""
    rho, sine, cosine = _slope_points()
    across, along = np.split(_gradient_basis(), 2, axis=1)
    chord = np.sqrt(1 - (rho * cosine) ** 2)
    place = np.divide(rho * sine, chord, out=np.zeros_like(rho), where=chord > 0)
    return np.concatenate([across * (place * rho * cosine) - along * chord, across * np.sqrt(1 - rho**2)], axis=1)


@lru_cache(maxsize=1)
def _polar_basis() -> np.ndarray:
    """Return ∂W/∂ρ, then ∂W/∂θ of the five shapes at the slope points, (5, 2·points)."""
    rho, sine, cosine = _slope_points()
    none = np.zeros_like(rho)
    radial = [4 * rho**3, 3 * rho**2 * cosine, 2 * rho * cosine**2, 2 * rho, cosine]
    angular = [none, -(rho**3) * sine, -2 * rho**2 * sine * cosine, none, -rho * sine]
    return np.concatenate([radial, angular], axis=1)
