"""The perfect lens in closed form: a uniform circular pupil without aberration."""

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM
from p2sf.psf.seidel import AIRY_RADIUS

FIRST_DARK = 3.8317059702  # the first zero of J₁
FAR, NODES, HANKEL_TERMS = 25.0, 32, 12  # two evaluations of Bessel functions meet at FAR, each exact to 1e-12


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
    zeroth, first = _bessel(v)
    pattern = np.where(v < 1e-9, 1.0, (2 * first / np.where(v < 1e-9, 1.0, v)) ** 2)
    return _both_sides(outward, -1), _both_sides(pattern), _both_sides(1 - zeroth**2 - first**2)


def _both_sides(half: np.ndarray, sign: int = 1) -> np.ndarray:
    """Return a curve on both sides of its first point, odd with the sign −1."""
    return np.append(sign * half[:0:-1], half)


def _bessel(v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return J₀ and J₁ of v ≥ 0 to 1e-12: near zero by their integrals, far out by Hankel's series.

    J₀ = (2/π)∫cos(v sin τ)dτ and J₁ = (2/π)∫sin(v sin τ) sin τ dτ over a quarter turn (DLMF 10.9.1, 10.9.2).
    """
    found, near = np.empty((2, v.size)), v <= FAR
    sine = np.sin((np.arange(NODES) + 0.5) * np.pi / (2 * NODES))
    phase = v[near, None] * sine
    found[:, near] = np.cos(phase).mean(axis=1), np.sin(phase) @ sine / NODES
    found[:, ~near] = _far_bessel(v[~near])
    return found[0], found[1]


def _far_bessel(v: np.ndarray) -> np.ndarray:
    """Return J₀ and J₁ of v by Hankel's series √(2/πv)·Re Σ iᵏaₖ/vᵏ·exp(iω), ω = v − nπ/2 − π/4 (DLMF 10.17.3)."""
    series = np.vander(1 / v, HANKEL_TERMS, increasing=True) @ _hankel_terms()
    turn = np.exp(1j * (v[:, None] - np.array([1, 3]) * np.pi / 4))
    found: np.ndarray = np.sqrt(2 / (np.pi * v)) * (series * turn).real.T
    return found


@lru_cache(maxsize=1)
def _hankel_terms() -> np.ndarray:
    """Return iᵏaₖ of J₀ and J₁, aₖ = Π (4n² − (2j − 1)²)/8j over j ≤ k (DLMF 10.17.1), (terms, 2)."""
    k, square = np.arange(1, HANKEL_TERMS)[:, None], np.array([0.0, 4.0])
    return np.cumprod(np.concatenate([np.ones((1, 2)), 1j * (square - (2 * k - 1) ** 2) / (8 * k)]), axis=0)
