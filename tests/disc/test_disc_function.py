"""Functions by their values at nodes: polynomials are met exactly anywhere, and smooth functions geometrically."""

import numpy as np
import pytest

from p2sf.disc import disc_function
from p2sf.disc.basis import PupilBasis
from p2sf.disc.disc_function import BY_ANGLE, BY_RADIUS, DiscFunction
from p2sf.disc.domain import HALF, WHOLE
from p2sf.pupil.fit import Level

RHO, THETA = np.array([0.0, 0.2, 0.71, 1.0]), np.linspace(0, np.pi, 7)
COUNTS = 4, 16  # radii enough for ρ⁷, angles enough for seven harmonics


def even(xi, eta):
    return 1 + xi**2 * eta - 3 * eta**7 + xi**6 * eta - 0.3 * eta**2


def odd(xi, eta):
    return xi * (0.5 + eta**6 - xi**2 * eta**4)


def neither(xi, eta):
    return even(xi, eta) + odd(xi, eta)


def of(domain, *functions, counts=COUNTS):
    """Return functions by their values at the nodes of a domain; those of HALF are even but for `odd`."""
    nodes = domain.nodes(counts)
    values = np.stack([function(nodes.xi, nodes.eta) for function in functions])
    return DiscFunction(values, counts, tuple(function is odd for function in functions), domain)


CASES = [(HALF, (even, odd)), (WHOLE, (neither, odd, even))]


@pytest.mark.parametrize(("domain", "functions"), CASES)
def test_polynomials_within_its_degree_are_met_on_circles(domain, functions):
    found = of(domain, *functions).on_polar(RHO, THETA)
    xi, eta = (np.outer(RHO, wave(THETA)).ravel() for wave in (np.sin, np.cos))
    xi, eta = domain.points(xi, eta)
    np.testing.assert_allclose(found, [function(xi, eta) for function in functions], atol=3e-14)


@pytest.mark.parametrize(("domain", "functions"), CASES)
def test_and_at_any_point_of_either_side(domain, functions):
    xi, eta = np.random.default_rng(3).uniform(-0.7, 0.7, (2, 40))
    xi[:2], eta[:3] = 0.0, 0.0  # the middle and the axes among them
    found = of(domain, *functions).at(xi, eta)
    np.testing.assert_allclose(found, [function(xi, eta) for function in functions], atol=3e-14)


@pytest.mark.parametrize(("domain", "functions"), CASES)
def test_and_on_a_grid_of_them(domain, functions):
    xi, eta = np.linspace(-0.7, 0.6, 5), np.linspace(-0.5, 0.7, 4)
    expected = [function(*np.meshgrid(xi, eta)) for function in functions]
    np.testing.assert_allclose(of(domain, *functions).on_grid(xi, eta), expected, atol=3e-14)


def test_many_points_are_taken_in_blocks(monkeypatch):
    xi, eta = np.random.default_rng(4).uniform(-0.7, 0.7, (2, 25))
    whole = of(WHOLE, neither, odd).at(xi, eta)
    monkeypatch.setattr(disc_function, "BLOCK", 10)
    np.testing.assert_array_equal(of(WHOLE, neither, odd).at(xi, eta), whole)


@pytest.mark.parametrize("domain", [HALF, WHOLE])
@pytest.mark.parametrize("order", [1, 6, 24])
def test_polynomials_of_zernike_are_met_by_the_nodes_that_determine_them(order, domain):
    """By three-term recurrence and by powers, which reach 1e8 at degree 24 and cancel: 1e-16 of that."""
    level, rng = Level(PupilBasis(order, order, domain), 2, 2), np.random.default_rng(1)
    forms = level.basis.phase, level.basis.fx, level.basis.fy, level.basis.fy
    given = [rng.normal(size=(3, form.count)) / (1 + form.indices[0]) ** 4 for form in forms]
    found, nodes = level.function(*given), domain.nodes((9, 20))
    wanted = np.stack([some @ form.values(nodes.xi, nodes.eta) for some, form in zip(given, forms, strict=True)], 1)
    np.testing.assert_allclose(found.at(nodes.xi, nodes.eta), wanted, atol=1e-7 if order == 24 else 1e-13)
    np.testing.assert_allclose(found.on((9, 20)), wanted, atol=1e-12)
    for one, other in zip(level.coefficients(found), given, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-13)


@pytest.mark.parametrize(("domain", "functions"), CASES)
def test_its_gradient_is_that_of_the_polynomial(domain, functions):
    by_xi = {even: lambda x, y: 2 * x * y + 6 * x**5 * y, odd: lambda x, y: 0.5 + y**6 - 3 * x**2 * y**4}
    by_eta = {
        even: lambda x, y: x**2 - 21 * y**6 + x**6 - 0.6 * y,
        odd: lambda x, y: x * (6 * y**5 - 4 * x**2 * y**3),
    }
    disc, counts = of(domain, *functions), (6, 22)
    here, there = domain.nodes(COUNTS), domain.nodes(counts)
    places = (disc.gradient(), here), (disc.gradient(counts), there), (disc.slopes_at(there.xi, there.eta), there)
    for gradient, nodes in places:
        for found, slopes in zip(gradient, (by_xi, by_eta), strict=True):
            slopes[neither] = lambda x, y, of_parts=slopes: of_parts[even](x, y) + of_parts[odd](x, y)
            wanted = [slopes[function](nodes.xi, nodes.eta) for function in functions]
            np.testing.assert_allclose(found, wanted, atol=2e-12)


def test_its_slopes_along_circles_and_rays_are_those_of_the_polynomial():
    """Of η³ = ρ³cos³θ on the rim too, on either side: 3ρ²cos³θ and −3ρ³cos²θ·sinθ, θ towards that side."""
    cube = of(WHOLE, lambda xi, eta: eta**3)
    radius, theta = (part.ravel() for part in np.meshgrid(RHO, THETA, indexing="ij"))
    by_radius, by_angle = 3 * radius**2 * np.cos(theta) ** 3, -3 * radius**3 * np.cos(theta) ** 2 * np.sin(theta)
    np.testing.assert_allclose(cube.on_polar(RHO, THETA, BY_RADIUS)[0], np.tile(by_radius, 2), atol=1e-13)
    np.testing.assert_allclose(cube.on_polar(RHO, THETA, BY_ANGLE)[0], np.tile(by_angle, 2), atol=1e-13)


def test_a_stack_is_its_functions_one_by_one_and_sums_are_those_of_the_functions():
    one, other = of(HALF, even, odd), of(HALF, lambda xi, eta: eta**2 + 0 * xi, odd)
    stack = DiscFunction(np.stack([one.values, other.values]), COUNTS, one.odd)
    xi, eta = np.array([0.3, -0.4]), np.array([0.1, 0.5])
    np.testing.assert_allclose(stack.at(xi, eta)[1], other.at(xi, eta), atol=1e-14)
    np.testing.assert_array_equal(stack.on((6, 20))[0], one.on((6, 20)))
    total = one - other - other
    np.testing.assert_allclose(total.at(xi, eta), one.at(xi, eta) - 2 * other.at(xi, eta), atol=1e-14)
    np.testing.assert_array_equal(one.channels(slice(1, 2)).at(xi, eta), one.at(xi, eta)[1:])


def test_errors_of_a_smooth_function_fall_geometrically():
    def smooth(xi, eta):
        return 1 / np.sqrt(1.8 - eta) + np.cos(3 * xi)

    xi, eta = (np.outer(RHO, wave(THETA)).ravel() for wave in (np.sin, np.cos))
    errors = [
        np.abs(of(HALF, smooth, counts=counts).at(xi, eta)[0] - smooth(xi, eta)).max()
        for counts in ((6, 16), (10, 28), (14, 40))
    ]
    assert errors[1] < 0.05 * errors[0] and errors[2] < 0.05 * errors[1]
