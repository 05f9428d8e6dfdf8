"""What methods cost and promise at a point, and the choice by time."""

from math import inf

import pytest

from p2sf.psf.prediction import TRACED_ERROR
from p2sf_explorer.compute.method_bounds import (
    NAMES,
    PredictedCost,
    costs,
    within,
)
from p2sf_explorer.state.state import new_state

STATE = new_state(f_number=8.0, field_deg=7.0, theme="light")


def test_every_method_has_its_cost_here_and_the_exact_ones_promise_more():
    found = costs(STATE)
    assert tuple(cost.method for cost in found) == NAMES
    seidel, fitted, traced = found[:3]
    assert 0 < seidel.milliseconds < inf and 0 < fitted.milliseconds < inf
    assert fitted.error < seidel.error
    assert TRACED_ERROR <= traced.error < 1.1 * TRACED_ERROR  # times the flatness of a window that shows the whole PSF


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
