"""W against its definition, and its slopes against brute force."""

import numpy as np
import pytest

from p2sf.disc.quadrature import disc_nodes
from p2sf.paraxial.wavefront import (
    bound_of,
    shape_coefficients,
    steepest_chords,
    steepest_polar,
    steepest_slope,
    wavefront,
)
from tests.support.waves import rms, waves

RANDOM = waves(*np.random.default_rng(1).normal(size=(6, 200)))


def test_w_is_the_sum_of_the_papers_terms():
    rho, theta = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 6, 7))
    c = waves(1.0, 2, 3, 4, 5, 6)
    cosine = np.cos(theta)
    expected = rho**4 + 2 * rho**3 * cosine + 3 * (rho * cosine) ** 2 + 10 * rho**2
    grid = rho * np.sin(theta), rho * cosine
    np.testing.assert_allclose(wavefront(c, *grid), expected, atol=1e-13)
    np.testing.assert_allclose(wavefront(c, *grid, tilt=True), expected + 5 * rho * cosine, atol=1e-13)


def test_coefficients_broadcast_before_the_pupil():
    c = waves(w40=np.ones((3, 1, 2)), wd=np.ones((3, 4, 1)))
    assert wavefront(c, np.zeros((6, 5)), np.zeros((6, 1))).shape == (3, 4, 2, 6, 5)
    assert steepest_slope(c).shape == (3, 4, 2)
    assert bound_of(np.ones((3, 1, 2, 4))).shape == (3, 1, 2)


def test_the_tilt_stays_out_of_the_shape_unless_asked_for():
    c = waves(1.0, 2, 3, 4, 5, 6)
    assert shape_coefficients(c) == (1, 2, 3, 10, 0) and shape_coefficients(c, tilt=True) == (1, 2, 3, 10, 5)


def brute_slopes(c, rho, theta, h=1e-5):
    def w(r, t):
        return wavefront(c, r * np.sin(t), r * np.cos(t))

    radial = (w(rho + h, theta) - w(rho - h, theta)) / (2 * h)
    angular = (w(rho, theta + h) - w(rho, theta - h)) / (2 * h)
    return radial, angular


def test_steepest_slopes_are_within_one_percent_of_a_dense_search():
    rho, theta = (x.ravel() for x in np.meshgrid(np.linspace(0.01, 1, 60), np.linspace(0, np.pi, 121)))
    radial, angular = brute_slopes(RANDOM, rho, theta)
    steepest = np.hypot(radial, angular / rho).max(-1)
    for ours, dense in (
        (steepest_slope(RANDOM), steepest),
        (steepest_polar(RANDOM)[0], np.abs(radial).max(-1)),
        (steepest_polar(RANDOM)[1], np.abs(angular).max(-1)),
    ):
        np.testing.assert_allclose(ours, dense, rtol=0.01)


def test_one_term_has_the_slope_calculus_gives():
    terms = {"w40": 4, "w31": 3, "w22": 2, "w20": 2, "wd": 2}
    for name, slope in terms.items():
        assert float(steepest_slope(waves(**{name: -1.5}))) == pytest.approx(1.5 * slope, rel=1e-12)
    assert float(steepest_slope(waves(w11=2.0), tilt=True)) == pytest.approx(2.0)
    assert float(steepest_slope(waves(w11=2.0))) == 0
    for tilt, slope in (
        (1.0, 4),
        (-1.0, 2),
    ):  # W31ρ²η rises by 3 towards the field at the rim: with the tilt, or against
        assert float(steepest_slope(waves(w31=1.0, w11=tilt), tilt=True)) == pytest.approx(slope, rel=1e-12)


def test_rms_is_the_variance_over_the_disc():
    nodes = disc_nodes(8, 24)
    w = wavefront(RANDOM, nodes.xi, nodes.eta)
    w = w - (w * nodes.weight).sum(-1, keepdims=True)
    np.testing.assert_allclose(rms(RANDOM, tilt_removed=False) ** 2, (w**2 * nodes.weight).sum(-1), atol=1e-13)
    tilt = 4 * (w * nodes.eta * nodes.weight).sum(-1)
    w = w - tilt[:, None] * nodes.eta
    np.testing.assert_allclose(rms(RANDOM) ** 2, (w**2 * nodes.weight).sum(-1), atol=1e-13)


def test_the_quick_bound_is_above_every_slope_and_exact_for_single_terms():
    shape = np.stack([RANDOM.w40, RANDOM.w31, RANDOM.w22, RANDOM.w20 + RANDOM.wd], -1)
    assert (bound_of(shape) >= steepest_slope(RANDOM) * (1 - 1e-15)).all()  # a rounding where all terms add up
    np.testing.assert_allclose(bound_of(-np.eye(4)), [4, 3, 2, 2], rtol=1e-15)


def test_chord_slopes_are_never_below_those_of_a_dense_search():
    t, s = (x.ravel() for x in np.meshgrid(np.linspace(0.01, np.pi - 0.01, 90), np.linspace(0, np.pi / 2, 90)))

    def w(t, s):
        return wavefront(RANDOM, np.sin(s) * np.sin(t), np.cos(t))

    h = 1e-5
    dense = (w(t + h, s) - w(t - h, s)) / (2 * h), (w(t, s + h) - w(t, s - h)) / (2 * h)
    for ours, slopes in zip(steepest_chords(RANDOM), dense, strict=True):
        ratio = ours / np.abs(slopes).max(-1)
        assert ratio.min() > 0.998 and ratio.max() < 1.05
