"""What a least R² means in other measures, and which method keeps a time. No Qt in here.

With p the picture, q the reference and ‖·‖ the root of the sum of squares over the window, R² ≥ 1 − ε gives
‖p − q‖² ≤ ε·Σ(q − mean)² ≤ ε·‖q‖². All bounds below follow from that.
"""

from dataclasses import dataclass
from math import inf, pi, sqrt

import numpy as np

from p2sf.errors import P2SFError
from p2sf.psf.cost import nodes_beyond
from p2sf.psf.methods import METHODS, psf_of
from p2sf.psf.result import Psf
from p2sf_explorer.compute.deferred_sums import psf_request, slow
from p2sf_explorer.compute.method import ALONE, NO_REASON, Task
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.state import State, change

NAMES = tuple(method.name for method in METHODS if method.pupil)  # from fast to exact
EXACTEST, COARSEST = 1e-5, 0.3  # 1 − R² at the ends of the slider
REPEATS = 3
ENERGY = 0.8


def mtf_error(one_less_r2: float) -> float:
    """Return the RMS error of the MTF over all frequencies, relative to its own RMS, that a least R² allows.

    By Parseval's theorem ‖ΔOTF‖/‖OTF‖ = ‖p − q‖/‖q‖ ≤ √ε, and the moduli differ by no more than the values.
    """
    return sqrt(one_less_r2)


def r2_for_mtf(error: float) -> float:
    """Return the least R² that keeps an RMS error of the MTF."""
    return 1 - error**2


def r80_sensitivity(psf: Psf) -> float:
    """Return c of |ΔR80|/R80 ≤ c·√ε for a PSF about its centroid; inf where its window holds no R80.

    |ΔE(R)| ≤ √(pixels within R)·‖p − q‖ (Cauchy and Schwarz), and ΔR80 = ΔE/(dE/dR) for small ones.
    """
    light = psf.values / psf.values.sum(dtype=float)
    rows, columns = np.indices(light.shape)
    row, column = float((light * rows).sum()), float((light * columns).sum())
    distance = np.hypot(rows - row, columns - column).ravel()
    order = np.argsort(distance)
    energy = np.cumsum(light.ravel()[order])
    at = int(np.searchsorted(energy, ENERGY))
    radius = float(distance[order][min(at, distance.size - 1)])
    low, high = (float(np.interp(radius * k, distance[order], energy)) for k in (0.9, 1.1))
    if radius <= 0 or high <= low:
        return inf
    steepness = (high - low) / 0.2  # dE/d(ln R)
    return sqrt(pi * radius**2) * float(np.linalg.norm(light)) / steepness


@dataclass(frozen=True)
class PredictedCost:
    """One method at this point: its time, inf where a frame cannot wait for it, and its predicted 1 − R²."""

    method: str
    milliseconds: float
    error: float


def costs(state: State) -> tuple[PredictedCost, ...]:
    """Return what each method costs at a state's point, in the window that it shows, fast ones first."""
    return tuple(_cost(change(state, method=method)) for method in NAMES)


def _cost(state: State) -> PredictedCost:
    method = state.optics.method
    try:
        setup = paraxial_setup(state)
        task = Task(state, setup, method, NO_REASON, ALONE, None)
        request = psf_request(state, setup, method, task.window("settled"))
        fitted = task.fitted if task.exact else None
        if nodes_beyond(request, fitted) or slow(request, fitted):
            return PredictedCost(method, inf, inf)
        psfs = [psf_of(request) for _ in range(REPEATS)]
    except P2SFError:  # this method has no picture here
        return PredictedCost(method, inf, inf)
    error = psfs[-1].predicted_error
    return PredictedCost(method, 1e3 * min(psf.seconds for psf in psfs), inf if error is None else float(error))


def within(found: tuple[PredictedCost, ...], milliseconds: float) -> PredictedCost:
    """Return the most exact method that keeps a time, or the fastest where none does."""
    kept = [cost for cost in found if cost.milliseconds <= milliseconds]
    return min(kept, key=lambda cost: cost.error) if kept else min(found, key=lambda cost: cost.milliseconds)
