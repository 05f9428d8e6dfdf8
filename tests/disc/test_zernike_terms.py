"""Zernike terms by number: against the polynomials as Noll and the University of Arizona print them."""

import numpy as np
import pytest

from p2sf.disc.quadrature import gauss_legendre
from p2sf.disc.zernike_terms import MOST_TERMS, family, zernike_terms, zernike_values
from p2sf.errors import RequestError

POINTS = np.random.default_rng(3).uniform(-0.7, 0.7, (2, 40))
# Noll 1976, table I, and Wyant & Creath 1992, table III, as functions of ρ and θ from the ξ axis.
NOLL = {
    1: lambda r, t: 1 + 0 * r,
    2: lambda r, t: 2 * r * np.cos(t),
    3: lambda r, t: 2 * r * np.sin(t),
    4: lambda r, t: np.sqrt(3) * (2 * r**2 - 1),
    5: lambda r, t: np.sqrt(6) * r**2 * np.sin(2 * t),
    6: lambda r, t: np.sqrt(6) * r**2 * np.cos(2 * t),
    7: lambda r, t: np.sqrt(8) * (3 * r**3 - 2 * r) * np.sin(t),
    8: lambda r, t: np.sqrt(8) * (3 * r**3 - 2 * r) * np.cos(t),
    9: lambda r, t: np.sqrt(8) * r**3 * np.sin(3 * t),
    10: lambda r, t: np.sqrt(8) * r**3 * np.cos(3 * t),
    11: lambda r, t: np.sqrt(5) * (6 * r**4 - 6 * r**2 + 1),
    12: lambda r, t: np.sqrt(10) * (4 * r**4 - 3 * r**2) * np.cos(2 * t),
    13: lambda r, t: np.sqrt(10) * (4 * r**4 - 3 * r**2) * np.sin(2 * t),
    14: lambda r, t: np.sqrt(10) * r**4 * np.cos(4 * t),
    15: lambda r, t: np.sqrt(10) * r**4 * np.sin(4 * t),
    16: lambda r, t: np.sqrt(12) * (10 * r**5 - 12 * r**3 + 3 * r) * np.cos(t),
    22: lambda r, t: np.sqrt(7) * (20 * r**6 - 30 * r**4 + 12 * r**2 - 1),
}
FRINGE = {
    2: lambda r, t: r * np.cos(t),
    3: lambda r, t: r * np.sin(t),
    4: lambda r, t: 2 * r**2 - 1,
    5: lambda r, t: r**2 * np.cos(2 * t),
    6: lambda r, t: r**2 * np.sin(2 * t),
    7: lambda r, t: (3 * r**2 - 2) * r * np.cos(t),
    9: lambda r, t: 6 * r**4 - 6 * r**2 + 1,
    11: lambda r, t: r**3 * np.sin(3 * t),
    12: lambda r, t: (4 * r**2 - 3) * r**2 * np.cos(2 * t),
    15: lambda r, t: (10 * r**4 - 12 * r**2 + 3) * r * np.sin(t),
    16: lambda r, t: 20 * r**6 - 30 * r**4 + 12 * r**2 - 1,
    17: lambda r, t: r**4 * np.cos(4 * t),
    25: lambda r, t: 70 * r**8 - 140 * r**6 + 90 * r**4 - 20 * r**2 + 1,
    26: lambda r, t: r**5 * np.cos(5 * t),
    31: lambda r, t: (21 * r**4 - 30 * r**2 + 10) * r**3 * np.sin(3 * t),
    36: lambda r, t: 252 * r**10 - 630 * r**8 + 560 * r**6 - 210 * r**4 + 30 * r**2 - 1,
    37: lambda r, t: 924 * r**12 - 2772 * r**10 + 3150 * r**8 - 1680 * r**6 + 420 * r**4 - 42 * r**2 + 1,
}


@pytest.mark.parametrize(("order", "printed"), [("noll", NOLL), ("fringe", FRINGE)])
def test_the_terms_are_those_that_are_printed(order, printed):
    terms = zernike_terms(order, 37)
    values = zernike_values(terms, *POINTS)
    r, t = np.hypot(*POINTS), np.arctan2(POINTS[1], POINTS[0])
    for number, formula in printed.items():
        term = terms[number - 1]
        ours = values[number - 1] / (term.norm if order == "fringe" else 1.0)
        assert np.allclose(ours, formula(r, t), rtol=0, atol=1e-12), (
            number
        )  # coefficients up to 3150, and a few roundings


@pytest.mark.parametrize("order", ["noll", "fringe"])
def test_the_terms_are_orthonormal_over_the_whole_disc(order):
    square, weight = gauss_legendre(24)  # exact to degree 94 in ρ
    rho, theta = np.sqrt((1 + square) / 2)[:, None], np.arange(60) * 2 * np.pi / 60
    share = np.broadcast_to(weight[:, None] / 2 / 60, (24, 60)).ravel()
    values = zernike_values(
        zernike_terms(order, MOST_TERMS[order]), (rho * np.cos(theta)).ravel(), (rho * np.sin(theta)).ravel()
    )
    assert np.allclose((values * share) @ values.T, np.eye(len(values)), rtol=0, atol=1e-12)


def test_even_terms_do_not_change_when_the_pupil_is_mirrored():
    terms = zernike_terms("noll", 66)
    here, there = zernike_values(terms, *POINTS), zernike_values(terms, -POINTS[0], POINTS[1])
    signs = np.array([1 if term.even else -1 for term in terms])[:, None]
    assert np.allclose(here, signs * there, rtol=0, atol=1e-12)


def test_every_pair_of_degree_and_order_has_one_number():
    for order, count in MOST_TERMS.items():
        assert len({(term.n, term.m) for term in zernike_terms(order, count)}) == count


@pytest.mark.parametrize(
    ("n", "m", "name"),
    [
        (2, 2, "astigmatism"),
        (4, 2, "secondary astigmatism"),
        (4, 0, "spherical aberration"),
        (6, 0, "secondary spherical aberration"),
        (3, 1, "coma"),
        (7, 1, "tertiary coma"),
        (3, 3, "trefoil"),
        (7, 7, "n = 7, m = 7"),
    ],
)
def test_terms_have_the_names_of_the_textbooks(n, m, name):
    assert family(n, m) == name


@pytest.mark.parametrize(("order", "count"), [("noll", 0), ("noll", 232), ("fringe", 38), ("standard", 5)])
def test_orders_and_counts_that_do_not_exist_are_refused(order, count):
    with pytest.raises(RequestError):
        zernike_terms(order, count)
