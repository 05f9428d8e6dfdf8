"""Orthonormal polynomials of the unit disc that are even, or odd, in ξ: what a field along η leaves of Zernike's.

Z = N·P_k(2ρ² − 1)·H_m with k = (n − m)/2, P_k the Jacobi polynomial of weights (0, m), H_m = Re or Im of
(η + iξ)^m = ρ^m cos mθ or ρ^m sin mθ with θ from the +η axis: polynomials in ξ and η throughout, without an
angle and hence smooth at the centre (Born & Wolf 1999, §9.2.1; Abramowitz & Stegun 1964, 22.7.1, 22.8).
"""

from functools import lru_cache

import numpy as np


@lru_cache(maxsize=64)
def terms(order: int, odd: bool = False) -> tuple[tuple[int, int], ...]:
    """Return (n, m) of the polynomials up to degree ``order``, by degree; ``odd`` in ξ has no m = 0."""
    return tuple((n, m) for n in range(order + 1) for m in range(n % 2, n + 1, 2) if m or not odd)


def jacobi(degree: int, alpha: float, beta: float, s: np.ndarray) -> np.ndarray:
    """Return P_degree^(α, β)(s) by the three-term recurrence (A&S 22.7.1)."""
    before, value = np.ones_like(s), (alpha + 1) + (alpha + beta + 2) * (s - 1) / 2
    if degree == 0:
        return before
    for n in range(1, degree):
        c = 2 * n + alpha + beta
        low, step = 2 * (n + alpha) * (n + beta) * (c + 2), (c + 1) * (alpha**2 - beta**2)
        value, before = (
            ((step + c * (c + 1) * (c + 2) * s) * value - low * before) / (2 * (n + 1) * (c - n + 1) * c),
            value,
        )
    return value


def basis(order: int, xi, eta, odd: bool = False) -> np.ndarray:
    """Return every polynomial up to ``order`` at pupil points, shape (terms, points); unit mean square on the disc."""
    xi, eta = np.asarray(xi, float), np.asarray(eta, float)
    s = 2 * (xi * xi + eta * eta) - 1
    harmonics = [(np.imag if odd else np.real)((eta + 1j * xi) ** m) for m in range(order + 1)]
    return np.stack([_norm(n, m) * jacobi((n - m) // 2, 0, m, s) * harmonics[m] for n, m in terms(order, odd)])


def gradient(order: int, xi, eta, odd: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return ∂/∂ξ and ∂/∂η of every polynomial at pupil points, each (terms, points)."""
    xi, eta = np.asarray(xi, float), np.asarray(eta, float)
    rows = [_slopes(n, m, xi, eta, odd) for n, m in terms(order, odd)]
    return np.stack([row[0] for row in rows]), np.stack([row[1] for row in rows])


def _slopes(n: int, m: int, xi, eta, odd: bool):
    """Return the gradient of one term by the product rule, d P_k^(0,m)/ds = (k + m + 1)/2 · P_{k−1}^(1,m+1)."""
    k, s, z = (n - m) // 2, 2 * (xi * xi + eta * eta) - 1, eta + 1j * xi
    part = np.imag if odd else np.real
    radial = jacobi(k, 0, m, s)
    slope = (k + m + 1) / 2 * jacobi(k - 1, 1, m + 1, s) if k else np.zeros_like(s)
    turn = m * z ** (m - 1) if m else np.zeros_like(z)
    harmonic = part(z**m)
    across = 4 * xi * slope * harmonic + radial * part(1j * turn)
    along = 4 * eta * slope * harmonic + radial * part(turn)
    return _norm(n, m) * across, _norm(n, m) * along


def _norm(n: int, m: int) -> float:
    """Return what gives a term unit mean square over the disc (Noll 1976, eq. 1)."""
    return float(np.sqrt((n + 1) * (2 if m else 1)))
