"""How far one window of a PSF is from another (handbook 6.1)."""

import numpy as np

FLATTEST = 1e6  # `flatness_of`: of a flatter window the reference, exact to 1e-8, keeps no R² of 0.99


def r_squared(values: np.ndarray, reference: np.ndarray) -> float:
    """Return R² of two windows (y, x) after both are given unit sum; 1 of the same ones, single samples too."""
    found, wanted = _unit_sum(values), _unit_sum(reference)
    missed = float(np.square(wanted - found).sum())
    return float(1 - missed / np.square(wanted - wanted.mean()).sum()) if missed else 1.0


def relative_l2(values: np.ndarray, reference: np.ndarray) -> float:
    """Return the relative L2 distance of two windows (y, x) after both are given unit sum."""
    found, wanted = _unit_sum(values), _unit_sum(reference)
    return float(np.sqrt(np.square(wanted - found).sum() / np.square(wanted).sum()))


def flatness_of(values: np.ndarray) -> float:
    """Return Σp²/Σ(p − mean)² of a picture: 1 of a PSF on a dark ground, more where a window shows a part of it.

    R² compares errors with what the picture varies, so that of the same relative L2 error 1 − R² is this times as much.
    """
    values = values.astype(float, copy=False)
    apart = values - values.mean()
    varying = float(np.vdot(apart, apart))
    return min(float(np.vdot(values, values)) / varying, FLATTEST) if varying else 1.0


def _unit_sum(values: np.ndarray) -> np.ndarray:
    unit: np.ndarray = np.asarray(values, dtype=float)
    return unit / float(unit.sum())
