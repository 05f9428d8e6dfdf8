"""What a least R² means for MTF and R80, against errors that were made; and the choice by time."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.psf.compare import r_squared
from p2sf.psf.prediction import TRACED_ERROR
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.method_bounds import (
    NAMES,
    PredictedCost,
    costs,
    mtf_error,
    r2_for_mtf,
    r80_sensitivity,
    within,
)
from p2sf_explorer.state.state import change, new_state

STATE = new_state(f_number=8.0, field_deg=7.0, theme="light")


def picture(method: str):
    return live(change(STATE, method=method)).psf


def r80(values: np.ndarray) -> float:
    """Return the radius of 80 % of the light about its centroid, pixels, by sorting."""
    light = values / values.sum()
    rows, columns = np.indices(light.shape)
    distance = np.hypot(rows - (light * rows).sum(), columns - (light * columns).sum()).ravel()
    order = np.argsort(distance)
    return float(np.interp(0.8, np.cumsum(light.ravel()[order]), distance[order]))


@pytest.mark.parametrize("method", ["seidel", "fitted"])
def test_the_mtf_errs_by_no_more_than_r2_allows(method):
    """A bound: FFTs of the two pictures, all frequencies, on the window both share."""
    exact, rough = picture("traced"), picture(method)
    assert exact.values.shape == rough.values.shape
    q, p = (psf.values / psf.values.sum() for psf in (exact, rough))
    mtfs = [np.abs(np.fft.fft2(x)) for x in (q, p)]
    made = np.linalg.norm(mtfs[1] - mtfs[0]) / np.linalg.norm(mtfs[0])
    assert made <= mtf_error(1 - r_squared(p, q)) * (1 + 1e-6)


@pytest.mark.parametrize("scale", [0.9, 0.97, 1.03, 1.1])
def test_r80_errs_by_no_more_than_r2_allows(scale):
    """A Gaussian beside a slightly wider one, whose R80 are their σ times √(2 ln 5); the bound is of first order."""
    x = np.arange(-64, 65)
    square = x**2 + x[:, None] ** 2
    q, p = (np.exp(-square / (2 * sigma**2)) for sigma in (9.0, 9.0 * scale))
    psf = replace(picture("seidel"), values=q / q.sum())
    made = abs(r80(p) / r80(q) - 1)
    allowed = r80_sensitivity(psf) * mtf_error(1 - r_squared(p / p.sum(), q / q.sum()))
    assert made == pytest.approx(abs(scale - 1), abs=0.006), "to a sixteenth of a pixel"
    assert made <= allowed <= 10 * made, "a bound, and not an empty one"


def test_an_mtf_error_and_its_r2_are_one_another_s_inverse():
    assert r2_for_mtf(mtf_error(0.01)) == pytest.approx(0.99)


def test_every_method_has_its_cost_here_and_the_exact_ones_promise_more():
    found = costs(STATE)
    assert tuple(cost.method for cost in found) == NAMES
    seidel, fitted, traced, _ = found
    assert 0 < seidel.milliseconds < inf and 0 < fitted.milliseconds < inf
    assert fitted.error < seidel.error and traced.error == TRACED_ERROR


FOUND = (
    PredictedCost("seidel", 1.0, 0.2),
    PredictedCost("fitted", 5.0, 1e-3),
    PredictedCost("traced", 40.0, 5e-5),
    PredictedCost("huygens", inf, inf),
)


@pytest.mark.parametrize(
    ("milliseconds", "method"), [(0.5, "seidel"), (2.0, "seidel"), (5.0, "fitted"), (30.0, "fitted"), (1e3, "traced")]
)
def test_a_time_takes_the_most_exact_method_that_keeps_it(milliseconds, method):
    assert within(FOUND, milliseconds).method == method
