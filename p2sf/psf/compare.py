"""How far one window of a PSF is from another (handbook 6.1)."""

import numpy as np


def r_squared(values: np.ndarray, reference: np.ndarray) -> float:
    """Return R² of two windows (y, x) after both are given unit sum."""
    found, wanted = _unit_sum(values), _unit_sum(reference)
    return float(1 - np.square(wanted - found).sum() / np.square(wanted - wanted.mean()).sum())


def relative_l2(values: np.ndarray, reference: np.ndarray) -> float:
    """Return the relative L2 distance of two windows (y, x) after both are given unit sum."""
    found, wanted = _unit_sum(values), _unit_sum(reference)
    return float(np.sqrt(np.square(wanted - found).sum() / np.square(wanted).sum()))


def _unit_sum(values: np.ndarray) -> np.ndarray:
    unit: np.ndarray = np.asarray(values, dtype=float)
    return unit / float(unit.sum())
