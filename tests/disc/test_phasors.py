"""Cosine and sine of phases in waves: right to the last digits, whole waves and half waves included."""

import numpy as np
import pytest

from p2sf.disc.phasors import cosine_sine

WAVES = np.concatenate([np.linspace(-0.5, 0.5, 4001), np.random.default_rng(1).uniform(-300, 300, 4000)])


@pytest.mark.parametrize(("dtype", "error"), [(np.float64, 2e-15), (np.float32, 2.5e-7)])
def test_they_are_the_library_s(dtype, error):
    left = WAVES - np.rint(WAVES)  # exact, so that the library's own reduction plays no part
    cosine, sine = cosine_sine(WAVES.copy(), dtype)
    assert cosine.dtype == sine.dtype == dtype
    # float64: 2e-16 of two polynomials, doubled twice; float32: a rounding of up to π, and one of each result.
    np.testing.assert_allclose(cosine, np.cos(2 * np.pi * left), atol=error, rtol=0)
    np.testing.assert_allclose(sine, np.sin(2 * np.pi * left), atol=error, rtol=0)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_quarter_turns_whatever_the_whole_ones(dtype):
    cosine, sine = cosine_sine(np.array([[0.0, 0.25], [1e6 + 0.5, -(2.0**40) - 0.25]]), dtype)
    np.testing.assert_allclose(cosine, [[1, 0], [-1, 0]], atol=1e-7 if dtype == np.float32 else 1e-15)
    np.testing.assert_allclose(sine, [[0, 1], [0, -1]], atol=1e-7 if dtype == np.float32 else 1e-15)
    assert np.isnan(cosine_sine(np.array([np.nan]), dtype)).all()
