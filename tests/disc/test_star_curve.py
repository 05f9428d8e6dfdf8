"""Closed curves over the stop: a circle about another point than its middle, against its own formulas."""

from math import pi

import numpy as np
import pytest

from p2sf.disc.domain import HALF, WHOLE
from p2sf.disc.mask import Disc, PupilMask
from p2sf.disc.open_part import OpenPart, curve_within
from p2sf.disc.star_curve import StarCurve, curve_between

CIRCLE = Disc(0.45, -0.2, 0.4)


def circle_seen_from(xi: float, eta: float) -> StarCurve:
    def edge(theta):
        one = np.ones_like(theta)
        return CIRCLE.distance(xi * one, eta * one, np.sin(theta), np.cos(theta))

    return curve_between(edge, (xi, eta), WHOLE.between([]), WHOLE)


SEEN = circle_seen_from(0.35, -0.1)


def test_nodes_are_of_the_inside():
    nodes = SEEN.nodes((16, 64))
    assert nodes.share == pytest.approx(CIRCLE.radius**2, rel=1e-9)
    assert nodes.weight @ nodes.xi == pytest.approx(CIRCLE.xi, abs=1e-9)
    assert nodes.weight @ nodes.eta**2 == pytest.approx(CIRCLE.eta**2 + CIRCLE.radius**2 / 4, abs=1e-9)


def test_nodes_over_a_small_part_have_the_radii_of_the_whole():
    """Polynomials through values at nodes keep their order: 16 radii are exact to ρ³⁰ about the middle, here x²⁶.

    Its mean over a disc of radius R is R²⁶·2·(25!!/26!!)/28.
    """
    nodes = SEEN.nodes((16, 64))
    assert nodes.xi.size >= 16 * 64
    about = circle_seen_from(CIRCLE.xi, CIRCLE.eta).nodes((16, 64))
    mean = CIRCLE.radius**26 * 2 / 28 * np.prod(np.arange(1, 26, 2) / np.arange(2, 27, 2))
    assert about.weight @ (about.xi - CIRCLE.xi) ** 26 == pytest.approx(mean, rel=1e-9)


def test_corners_of_half_a_curve_are_known_on_both_sides():
    """Two circles of radius 0.8 about (0, ±0.3) meet at ξ = ±√(0.8² − 0.3²)."""
    overlap = curve_within([Disc(0.0, 0.3, 0.8), Disc(0.0, -0.3, 0.8)], HALF)
    xi, eta = overlap.corner_points(WHOLE)
    assert np.sort(xi) == pytest.approx([-(0.55**0.5), 0.55**0.5]) and eta == pytest.approx([0, 0], abs=1e-6)


def test_lines_are_cut_where_they_cross_the_circle():
    """Points lie inside of it where they do."""
    aside = np.linspace(-0.7, 0.3, 21)
    angle = 2.0
    xi, eta, (sine, cosine) = aside * np.cos(angle), -aside * np.sin(angle), (np.sin(angle), np.cos(angle))
    near, far = CIRCLE.chord(xi, eta, sine, cosine)
    first, last = SEEN.cuts(xi, eta, sine, cosine)
    some = np.isfinite(first)
    assert np.array_equal(some, far > near) and 5 < some.sum() < 18
    assert first[some] == pytest.approx(near[some], abs=1e-9) and last[some] == pytest.approx(far[some], abs=1e-9)
    xi, eta = np.meshgrid(np.linspace(-1, 1, 42), np.linspace(-1, 1, 44))
    assert np.array_equal(SEEN.depth(xi, eta) > 0, CIRCLE.depth(xi, eta) > 0)


def test_extremes_across_a_direction_are_those_of_the_circle():
    """By parabolas through three of a thousand points, which leave the fourth power of a step."""
    sine, cosine = np.sin(2.0), np.cos(2.0)
    middle = CIRCLE.xi * cosine - CIRCLE.eta * sine
    found = sorted(SEEN.breaks_across(sine, cosine))
    assert [found[0], found[-1]] == pytest.approx([middle - CIRCLE.radius, middle + CIRCLE.radius], abs=1e-8)


def test_vanes_may_meet_outside_a_rim():
    """Only one of three crosses it, in the middle or beside: the share lost is the area of a strip of a circle."""
    half = 0.03
    mask = PupilMask(vanes=3, vane_width=half, vane_angle_deg=np.rad2deg(np.arctan2(CIRCLE.xi, CIRCLE.eta)) + 8)
    part = OpenPart(SEEN, domain=WHOLE).behind(mask)
    angle = np.deg2rad(mask.vane_angle_deg)
    beside = CIRCLE.xi * np.cos(angle) - CIRCLE.eta * np.sin(angle)
    ends = np.clip((np.array([-half, half]) - beside) / CIRCLE.radius, -1, 1)
    low, high = ends * np.sqrt(1 - ends**2) + np.arcsin(ends)  # area from the middle to a line, over R²
    assert part.nodes((24, 64)).share == pytest.approx(CIRCLE.radius**2 * (1 - (high - low) / pi), abs=1e-10)


def test_overlapping_circles_meet_in_two_corners():
    other = Disc(0.1, 0.1, 0.35)
    lens = curve_within([SEEN, other], WHOLE)
    assert lens is not None and curve_within([SEEN, Disc(-0.5, 0.5, 0.1)], WHOLE) is None
    apart = np.hypot(CIRCLE.xi - other.xi, CIRCLE.eta - other.eta)
    corner = lens.corner_points(WHOLE)
    on_both = np.minimum(abs(CIRCLE.depth(*corner)) + abs(other.depth(*corner)), 1)
    assert (on_both < 1e-7).sum() == 2
    a, b = CIRCLE.radius, other.radius
    first = np.arccos((apart**2 + a**2 - b**2) / (2 * apart * a))
    second = np.arccos((apart**2 + b**2 - a**2) / (2 * apart * b))
    area = a**2 * (first - np.sin(2 * first) / 2) + b**2 * (second - np.sin(2 * second) / 2)
    assert lens.nodes((16, 64)).share == pytest.approx(area / pi, rel=1e-7)
