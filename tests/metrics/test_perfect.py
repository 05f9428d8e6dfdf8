"""The perfect lens against the Bessel functions of its formulas."""

import numpy as np
import pytest
from scipy.special import j0, j1

from p2sf.metrics.perfect import airy_curves


def test_the_airy_pattern_and_its_energy_are_bessels():
    position, pattern, energy = airy_curves(201, 30.0, 2.0)
    v = 3.8317059702 * np.abs(position) / 2.0
    safe = np.where(v > 0, v, 1.0)
    assert pattern == pytest.approx(np.where(v > 0, (2 * j1(safe) / safe) ** 2, 1.0), abs=1e-12)
    assert energy == pytest.approx(1 - j0(v) ** 2 - j1(v) ** 2, abs=1e-12)
