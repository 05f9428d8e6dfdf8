"""The laws of a pupil's basis, symmetric or not: both are the same polynomials, one has more of them."""

import numpy as np
import pytest

from p2sf.disc.basis import PupilBasis
from p2sf.disc.domain import HALF, WHOLE
from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import mask_nodes

XI, ETA = np.array([0.3, -0.5, 0.1, 0.0]), np.array([0.2, 0.6, -0.7, 0.9])
BOTH = pytest.mark.parametrize("domain", [HALF, WHOLE])


def forms(domain, orders=(6, 3)):
    """Return the terms of phase, fx and fy, and some coefficients of each."""
    basis, rng = PupilBasis(*orders, domain), np.random.default_rng(3)
    return [(terms, rng.normal(size=terms.count)) for terms in (basis.phase, basis.fx, basis.fy)]


def test_a_symmetric_basis_is_even_and_its_fx_odd():
    for (terms, c), sign in zip(forms(HALF), (1, -1, 1), strict=True):
        assert c @ terms.values(-XI, ETA) == pytest.approx(sign * (c @ terms.values(XI, ETA)), abs=1e-14)


def test_a_whole_basis_begins_with_the_terms_of_the_symmetric_one():
    half, whole = (PupilBasis(6, 3, domain).values(XI, ETA) for domain in (HALF, WHOLE))
    for few, every in zip(half, whole, strict=True):
        assert len(every) > len(few) and (every[: len(few)] == few).all()


def test_a_whole_basis_has_as_many_terms_as_there_are_powers():
    """ξᵃηᵇ, a + b ≤ n: (n + 1)(n + 2)/2 of them, linearly independent."""
    for terms, _ in forms(WHOLE):
        nodes = WHOLE.nodes((12, 24))
        rows = terms.values(nodes.xi, nodes.eta)
        assert terms.count == (terms.order + 1) * (terms.order + 2) // 2
        assert (rows * nodes.weight) @ rows.T == pytest.approx(np.eye(terms.count), abs=1e-13)


@BOTH
def test_terms_of_several_orders_are_the_same_values(domain):
    for many, each in zip(PupilBasis(6, 3, domain).values(XI, ETA), forms(domain), strict=True):
        assert (many == each[0].values(XI, ETA)).all()


@BOTH
def test_slopes_are_differences(domain, step=1e-6):
    """Of second order: some order³·step² = 2e-10, and rounding of 1e-16/step."""
    basis = PupilBasis(6, 3, domain)
    pairs = zip(basis.map_slopes(XI, ETA), (basis.fx, basis.fy), strict=True)
    for (across, along), terms in (*pairs, (basis.phase.gradient(XI, ETA), basis.phase)):
        right, left = terms.values(XI + step, ETA), terms.values(XI - step, ETA)
        up, down = terms.values(XI, ETA + step), terms.values(XI, ETA - step)
        assert across == pytest.approx((right - left) / (2 * step), abs=2e-8)
        assert along == pytest.approx((up - down) / (2 * step), abs=2e-8)


@BOTH
def test_turned_coefficients_are_those_of_the_turned_function(domain, angle=0.7):
    """A function turned from +η towards +ξ has at a point what it had at the point turned back."""
    sine, cosine = np.sin(angle), np.cos(angle)
    back = XI * cosine - ETA * sine, XI * sine + ETA * cosine
    for terms, c in forms(domain):
        whole = PupilBasis(terms.order, terms.order, WHOLE).phase
        turned = np.concatenate(terms.turned(c, np.array(angle)))
        assert turned @ whole.values(XI, ETA) == pytest.approx(c @ terms.values(*back), abs=1e-13)


@BOTH
def test_wider_coefficients_are_the_same_function(domain):
    for (terms, c), (wider, _) in zip(forms(domain), forms(domain, (9, 8)), strict=True):
        assert terms.widened(c, wider.order) @ wider.values(XI, ETA) == pytest.approx(c @ terms.values(XI, ETA))


@BOTH
def test_nodes_of_a_domain_integrate_what_is_known_there(domain):
    """The mean of the square of fx and of the phase: over half the disc that of an even or odd function is the same."""
    nodes = domain.nodes((12, 24))
    for terms, c in forms(domain):
        assert nodes.weight @ (c @ terms.values(nodes.xi, nodes.eta)) ** 2 == pytest.approx(c @ c)
    assert nodes.xi.size == len(domain.halves) * 12 * 24 // 2 and len(domain.halves) * len(domain.images) == 2


def test_nodes_behind_a_mask_without_symmetry_are_whole_in_both_domains():
    nodes = mask_nodes(PupilMask(obscuration=0.2, obscuration_x=0.3), 8, 16)
    assert HALF.over(nodes) is nodes is WHOLE.over(nodes)
    even = mask_nodes(PupilMask(obscuration=0.2), 8, 16)
    assert HALF.over(even) is even and (WHOLE.over(even).xi < 0).any()


def test_fx_has_a_constant_only_without_symmetry():
    assert PupilBasis(2, 2).fy.constant and not PupilBasis(2, 2).fx.constant and PupilBasis(2, 2, WHOLE).fx.constant
