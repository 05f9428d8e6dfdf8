"""Bounds on other measures for a given smallest R².

With p the picture, q the reference and ‖·‖ the root of the sum of squares over the window, R² ≥ 1 − ε gives
‖p − q‖² ≤ ε·Σ(q − mean)² ≤ ε·‖q‖². All bounds below follow from that.
"""

from math import inf, pi, sqrt

import numpy as np

from p2sf.figures.psf_data import PsfData

ENERGY = 0.8


def mtf_error(one_less_r2: float) -> float:
    """Return the RMS error of the MTF over all frequencies, relative to its own RMS, that a least R² allows.

    By Parseval's theorem ‖ΔOTF‖/‖OTF‖ = ‖p − q‖/‖q‖ ≤ √ε, and the moduli differ by no more than the values.
    """
    return sqrt(one_less_r2)


def r80_sensitivity(psf: PsfData) -> float:
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
