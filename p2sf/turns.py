"""Cosine and sine of phases given in waves: the inner loop of every PSF.

Whole waves are taken off first, in the phase's own precision, so that float32 stays accurate behind it. numpy has fast
float32 functions; its float64 ones take twenty times as long, and here polynomials of a quarter of the angle, doubled
twice, take a third of that and are right to 2e-15.
"""

from math import factorial, pi

import numpy as np

TURN = 2 * pi
# Taylor series in the square of the phase (A&S 4.3.65, 4.3.66); a quarter of half a turn is π/4, so these reach 1e-16.
_COSINE = [(-1) ** k * (pi / 2) ** (2 * k) / factorial(2 * k) for k in range(9)]
_SINE = [(-1) ** k * (pi / 2) ** (2 * k + 1) / factorial(2 * k + 1) for k in range(9)]


def cosine_sine(waves: np.ndarray, dtype) -> tuple[np.ndarray, np.ndarray]:
    """Return cos 2πw and sin 2πw in ``dtype``, float32 or float64; the array of phases w in waves is used up."""
    waves -= np.rint(waves)
    if dtype == np.float64:
        return _by_series(waves.astype(dtype, copy=False))
    waves *= TURN
    radians = waves.astype(dtype, copy=False)
    return np.cos(radians), np.sin(radians, out=radians)


def _by_series(waves: np.ndarray):
    """Return cosine and sine of phases between −1/2 and 1/2: cos 2a = 1 − 2sin²a, sin 2a = 2 sin a cos a, twice."""
    square = waves * waves
    cosine, sine = _horner(_COSINE, square), _horner(_SINE, square)
    sine *= waves
    for _ in range(2):
        cosine *= sine
        cosine *= 2
        sine *= sine
        sine *= -2
        sine += 1
        cosine, sine = sine, cosine
    return cosine, sine


def _horner(series: list[float], square: np.ndarray) -> np.ndarray:
    value = square * series[-1]
    for term in series[-2:0:-1]:
        value += term
        value *= square
    value += series[0]
    return value
