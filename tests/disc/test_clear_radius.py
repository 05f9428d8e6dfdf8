"""Where rays end along directions: against roots by formula, with kinks, steps and stretches of unknown room."""

import numpy as np
import pytest

from p2sf.disc.clear_radius import BISECTIONS, clear_radius

CLOSE = 2.0**-BISECTIONS  # of the outer radius: what the function promises
ROOTS = np.array([0.03, 0.2, 1 / 3, 0.5, 0.77, 1 - 1e-9])


def smooth(radius, root):
    return 1 - (radius / root) ** 2


def kinked(radius, root):
    """Another rim takes over 0.002 beyond the edge."""
    return np.minimum(root - radius, 2 * (root - radius) + 0.002)


def kinked_at_the_edge(radius, root):
    return np.minimum(root - radius, 6 * (root - radius))


def unknown_outside(radius, root):
    return np.where(radius > root, np.nan, smooth(radius, root))


def unknown(radius, root):
    return np.full(radius.shape, np.nan)


@pytest.mark.parametrize(
    ("room_of", "most"),
    [
        (smooth, 14),
        (kinked, 20),
        (kinked_at_the_edge, 2 * BISECTIONS),
        (unknown_outside, BISECTIONS + 2),
        (unknown, BISECTIONS + 2),
    ],
)
def test_it_ends_where_the_formula_says(room_of, most):
    """``most``: calls; a root by interpolation takes few, one without any room a bisection."""
    calls = []

    def clearance(radius, some):
        calls.append(some.size)
        passed = radius <= ROOTS[some]
        return passed, room_of(radius, ROOTS[some]), np.where(passed, 0, some + 5)

    radius, ended = clear_radius(clearance, np.ones(ROOTS.size))
    assert (radius <= ROOTS).all() and (ROOTS - radius <= CLOSE).all()
    assert ended.tolist() == [5, 6, 7, 8, 9, 10] and len(calls) <= most


@pytest.mark.parametrize(("off", "most"), [(1e-5, 6), (-1e-5, 6), (0.1, 14), (-0.1, 14)])
def test_a_good_guess_saves_calls_and_a_bad_one_costs_none(off, most):
    calls = []

    def clearance(radius, some):
        calls.append(some.size)
        passed = radius <= ROOTS[some]
        return passed, smooth(radius, ROOTS[some]), np.where(passed, 0, np.where(radius < 1, 3, 4))

    radius, ended = clear_radius(clearance, np.ones(ROOTS.size), ROOTS + off)
    assert (radius <= ROOTS).all() and (ROOTS - radius <= CLOSE).all() and len(calls) <= most
    assert (ended[:-1] == 3).all()  # what ends rays next to the edge, not those at the outer radius


def test_directions_that_nothing_ends_keep_the_outer_radius():
    outer = np.array([0.4, 0.9, 1.3])

    def clearance(radius, some):
        return radius <= 0.8, 0.8 - radius, np.full(radius.shape, 7)

    radius, ended = clear_radius(clearance, outer)
    assert radius == pytest.approx([0.4, 0.8, 0.8], abs=2 * CLOSE) and radius[0] == 0.4
    assert ended.tolist() == [0, 7, 7]
