"""Sample points of the unit disc that integrate a smooth pupil to any accuracy.

A square grid with a yes/no edge converges slowly; Gauss–Legendre in ρ² times uniform angles has no
edge at all, and converges faster than any power once it resolves the phase.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, pi

import numpy as np

from p2sf.errors import SamplingError

# The settled picture's promise: relative L2 error of the PSF in its window.
SETTLED_TOLERANCE = 1e-4
NEWTON_STEPS = 8


@dataclass(frozen=True)
class DiscNodes:
    """Nodes on the half disc ξ ≥ 0, shape (nodes,); the weights count the mirror half too and sum to 1."""

    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray

    def astype(self, dtype) -> "DiscNodes":
        """Return the same nodes in another precision."""
        return DiscNodes(*(x.astype(dtype) for x in (self.xi, self.eta, self.weight)))


@lru_cache(maxsize=64)
def disc_nodes(radial: int, angular: int) -> DiscNodes:
    """Return the half-disc nodes of Gauss–Legendre in ρ² times ``angular`` directions around the whole circle.

    ``angular`` is even, and the directions lie midway between multiples of 2π/angular: none falls on the
    fold ξ = 0, so each node's mirror image is a direction of the full rule too and the fold is exact for
    whatever is even in ξ. Shape (radial·angular/2,). Weights are an area mean. Raises SamplingError.
    """
    if radial < 1 or angular < 2 or angular % 2:
        raise SamplingError(f"{radial} radii × {angular} directions; give at least 1 radius and an even count ≥ 2")
    square, weight = gauss_legendre(radial)
    rho = np.sqrt((1 + square) / 2)
    theta = (np.arange(angular // 2) + 0.5) * (2 * pi / angular)
    xi, eta = np.outer(rho, np.sin(theta)), np.outer(rho, np.cos(theta))
    share = np.repeat(weight / angular, angular // 2)
    return DiscNodes(_frozen(xi.ravel()), _frozen(eta.ravel()), _frozen(share))


@lru_cache(maxsize=256)
def gauss_legendre(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return nodes in (−1, 1), ascending, and weights (sum 2) of the rule exact to degree 2·count − 1.

    Newton's method from Tricomi's guess (Abramowitz & Stegun 1964, 22.16.6 and 25.4.29): thousands of nodes
    cost milliseconds, where the eigenvalue method takes minutes.
    """
    x = np.cos(pi * (np.arange(count, 0, -1) - 0.25) / (count + 0.5))
    for _ in range(NEWTON_STEPS):
        value, slope = _legendre(count, x)
        x = x - value / slope
    _, slope = _legendre(count, x)
    return _frozen(x), _frozen(2 / ((1 - x**2) * slope**2))


def _legendre(order: int, x: np.ndarray):
    """Return P_n and its derivative by the three-term recurrence (A&S 22.7.10, 22.8.5)."""
    before, value = np.ones_like(x), x
    for n in range(1, order):
        before, value = value, ((2 * n + 1) * x * value - n * before) / (n + 1)
    return value, order * (before - x * value) / (1 - x**2)


def _frozen(values: np.ndarray) -> np.ndarray:
    """Return the array write-protected, since the cache hands out the same one to everybody."""
    values.setflags(write=False)
    return values


def nodes_for(slope: float, reach: float, twist: float | None = None) -> tuple[int, int]:
    """Return (radial, angular) counts that carry a phase, so that the PSF settles to SETTLED_TOLERANCE.

    ``slope``: steepest |∂W/∂ρ|, ``twist``: steepest |∂W/∂θ| (``slope`` bounds it if not given), both in
    waves; ``reach``: waves per unit radius of the kernel at the window's farthest corner. The integrand's
    harmonics end near its highest local frequency, like those of exp(iz·cosθ), J_m(z), near m = z + 2z^⅓.
    """
    radial = harmonics(slope + reach) / 4
    angular = harmonics((slope if twist is None else twist) + reach)
    return _stepped(radial + 4), 2 * _stepped(angular / 2 + 2)


def harmonics(slope: float) -> float:
    """Return how many harmonics a phase of steepest slope ``slope`` waves per radian has: z + 2z^⅓, z = 2π·slope."""
    z = 2 * pi * abs(slope)
    return z + 2 * np.cbrt(z)


def _stepped(count: float) -> int:
    """Return the next count with three significant bits, so that a dragged slider meets the cache."""
    step = 2 ** max(0, int(count).bit_length() - 3)
    return step * ceil(count / step)
