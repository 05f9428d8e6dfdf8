"""The perfect lens against the Bessel functions of its formulas."""

import numpy as np
import pytest
from scipy.special import j0, j1

from p2sf.figures.perfect import airy_curves, bessel_0_and_1


def bessel(order: int, v: np.ndarray) -> np.ndarray:
    """Return Jₙ(v) by its integral over half a turn, the mean of cos(nτ − v·sin τ) (DLMF 10.9.2)."""
    tau = (np.arange(400) + 0.5) * np.pi / 400
    return np.cos(order * tau - v[:, None] * np.sin(tau)).mean(1)


def test_the_airy_pattern_and_its_energy_are_bessels():
    """The mean of a periodic function converges faster than any power: 400 points are exact for v below 60."""
    position, pattern, energy = airy_curves(201, 30.0, 2.0)
    v = 3.8317059702075123 * np.abs(position) / 2.0
    safe = np.where(v > 0, v, 1.0)
    assert pattern == pytest.approx(np.where(v > 0, (2 * bessel(1, safe) / safe) ** 2, 1.0), abs=1e-12)
    assert energy == pytest.approx(1 - bessel(0, v) ** 2 - bessel(1, v) ** 2, abs=1e-12)


@pytest.mark.parametrize("top", [0.0, 1.0, 40.0, 700.0])
def test_bessels_integrals_are_the_functions_of_scipy(top):
    v = np.linspace(0, top, 301)
    zeroth, first = bessel_0_and_1(v)
    np.testing.assert_allclose(zeroth, j0(v), atol=1e-14)
    np.testing.assert_allclose(first, j1(v), atol=1e-14)
