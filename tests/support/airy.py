"""The energy of a perfect lens in closed form."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import j0, j1


def circle_energy(radius: ArrayLike) -> np.ndarray:
    """Return 1 − J₀²(v) − J₁²(v), v = 2π·radius, the energy within radii in units of λ/NA (Rayleigh 1881)."""
    v = 2 * np.pi * np.asarray(radius, dtype=float)
    within: np.ndarray = 1 - j0(v) ** 2 - j1(v) ** 2
    return within
