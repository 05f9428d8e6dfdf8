"""Values between nodes: polynomials are met exactly, and smooth functions geometrically."""

import numpy as np
import pytest

from p2sf.pupil.interpolation import interpolate
from p2sf.pupil.quadrature import disc_nodes

RHO, THETA = np.array([0.0, 0.2, 0.71, 1.0]), np.linspace(0, np.pi, 7)


def at_points(function):
    return function(*(np.outer(RHO, wave(THETA)).ravel() for wave in (np.sin, np.cos)))


@pytest.mark.parametrize("odd", [False, True])
def test_polynomials_within_its_degree_are_met(odd):
    """Of degree 7 in (ξ, η): radii enough for ρ⁷, angles enough for seven harmonics."""

    def function(xi, eta):
        even = 1 + xi**2 * eta - 3 * eta**7 + xi**6 * eta - 0.3 * eta**2
        return xi * (0.5 + eta**6 - xi**2 * eta**4) if odd else even

    nodes = disc_nodes(4, 16)
    found = interpolate(function(nodes.xi, nodes.eta), (4, 16), RHO, THETA, odd)
    np.testing.assert_allclose(found, at_points(function), atol=2e-14)


def test_errors_of_a_smooth_function_fall_geometrically():
    def function(xi, eta):
        return 1 / np.sqrt(1.8 - eta) + np.cos(3 * xi)

    errors = []
    for counts in ((6, 16), (10, 28), (14, 40)):
        nodes = disc_nodes(*counts)
        found = interpolate(function(nodes.xi, nodes.eta), counts, RHO, THETA)
        errors.append(np.abs(found - at_points(function)).max())
    assert errors[1] < 0.05 * errors[0] and errors[2] < 0.05 * errors[1]
