"""The perfect lens in closed form: a uniform circular pupil without aberration."""

from functools import lru_cache
from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM
from p2sf.raytrace.ray_field import AIRY_RADIUS

NEAR = 25.0  # up to which Bessel functions are integrals of few nodes; beyond, their expansion has few terms
EXPANDED = 20  # terms
FIRST_DARK = 2 * np.pi * AIRY_RADIUS  # the first zero of J₁


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


@lru_cache(maxsize=8)
def airy_curves(count: int, half_um: float, radius_um: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return positions from −half to half, the Airy pattern there, and its energy 1 − J₀²(v) − J₁²(v) (Rayleigh 1881).

    ``radius_um`` is the first dark ring's; ``count`` is odd, so that one half mirrors the other.
    """
    outward = np.linspace(0.0, half_um, count // 2 + 1)
    v = FIRST_DARK * outward / radius_um
    zeroth, first = bessel_0_and_1(v)
    pattern = np.where(v < 1e-9, 1.0, (2 * first / np.where(v < 1e-9, 1.0, v)) ** 2)
    return _both_sides(outward, -1), _both_sides(pattern), _both_sides(1 - zeroth**2 - first**2)


def bessel_0_and_1(v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return J₀ and J₁ to 1e-14, of large v to its rounding; the import of scipy.special alone takes 0.15 s."""
    near = v < NEAR
    found = np.empty((2, v.size))
    found[:, near] = _near_middle(v[near])
    found[:, ~near] = [_far_out(v[~near], order) for order in (0, 1)]
    return found[0], found[1]


def _near_middle(v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return J₀ and J₁ by Bessel's integrals (DLMF 10.9.1 and 10.9.2 with n = 1).

    The midpoint rule over a quarter of a turn errs by J of the order of its nodes per turn (Trefethen and Weideman
    2014, section 2): nothing beyond 1.2 v + 40.
    """
    count = ceil(0.3 * NEAR) + 10
    height = np.sin((np.arange(count) + 0.5) * (np.pi / 2 / count))
    phase = v[:, None] * height
    return np.cos(phase).mean(axis=1), (np.sin(phase) @ height) / count


def _far_out(v: np.ndarray, order: int) -> np.ndarray:
    """Return J of an order by Hankel's expansion, whose terms fall to 1e-16 from `NEAR` on (DLMF 10.17.3)."""
    k = np.arange(1, EXPANDED)
    terms = np.append(1.0, np.cumprod((4 * order**2 - (2 * k - 1) ** 2) / (8 * k)))  # a_k of DLMF 10.17.1
    signs = (-1.0) ** np.arange(EXPANDED // 2)
    square, phase = 1 / (v * v), v - (order / 2 + 1 / 4) * np.pi
    even, odd = (np.polynomial.polynomial.polyval(square, signs * part) for part in (terms[::2], terms[1::2]))
    found: np.ndarray = np.sqrt(2 / (np.pi * v)) * (np.cos(phase) * even - np.sin(phase) * odd / v)
    return found


def _both_sides(half: np.ndarray, sign: int = 1) -> np.ndarray:
    """Return a curve on both sides of its first point, odd with the sign −1."""
    return np.append(sign * half[:0:-1], half)
