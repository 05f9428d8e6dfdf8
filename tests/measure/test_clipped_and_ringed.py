"""Flat tops that nobody stated, a blur with a dark ring, and faint points whose first minimum is not the deepest."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

import p2sf
from p2sf.errors import RequestError
from p2sf.measure.frame import Frame, FrameGeometry, Noise
from p2sf.measure.points import find_points, window_half
from tests.support.tiers import in_tiers

NA, WAVE_UM, PIXEL_UM = 0.125, 0.55, 2.2


def light(waves, side=40, middle=20.0):
    """Return the light on pixels of a point with W40, W31, W22, W20 of ``waves``, peak 1: a plain sum over the disc."""
    point, weight = leggauss(48)
    rho, theta = np.sqrt((point + 1) / 2), 2 * np.pi * np.arange(144) / 144
    xi, eta = np.outer(rho, np.sin(theta)).ravel(), np.outer(rho, np.cos(theta)).ravel()
    square = xi**2 + eta**2
    w40, w31, w22, w20 = waves
    wave = np.repeat(weight, 144) * np.exp(
        2j * np.pi * (w40 * square**2 + w31 * square * eta + w22 * eta**2 + w20 * square)
    )
    within, share = leggauss(4)
    axis = ((np.arange(side) - middle)[:, None] + within / 2).ravel() * PIXEL_UM * 2 * np.pi * NA / WAVE_UM
    field = (np.exp(1j * np.outer(axis, eta)) * wave) @ np.exp(1j * np.outer(xi, axis))
    summed = np.einsum("ypxq,p,q->yx", (np.abs(field) ** 2).reshape(side, 4, side, 4), share, share)
    return summed / summed.max()


def fitted(values, **known):
    return p2sf.fit_psf(values, NA, 1000 * WAVE_UM, PIXEL_UM, **known)


def off(found, waves):
    """Return by how many of its own standard deviations the nearest solution misses the truth at most."""
    return min(float(np.abs((numbers - waves) / found.errors).max()) for numbers in (found.numbers, *found.others))


def with_noise(values, noise, seed):
    return values + np.random.default_rng(seed).normal(0, noise, values.shape)


def test_clipped_pixels_are_noticed_and_do_not_count():
    waves = np.array([0.812, 0.3, -0.2, -1.9])
    whole = with_noise(light(waves), 0.005, 1)
    clipped = np.minimum(whole, np.sort(whole.ravel())[-12])
    found = fitted(clipped, noise=0.005)
    assert off(found, waves) < 5 and any("clipped" in str(each) for each in found.warnings)
    whole_fit = fitted(whole, noise=0.005)
    assert off(whole_fit, waves) < 5 and len(whole_fit.warnings) == 1  # that the sign is open


@pytest.mark.parametrize(
    "waves", [(0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), (0.8, 0.0, 0.0, -0.4), (0.5, 0.7, 0.3, -0.2)]
)
def test_tops_that_no_one_clipped_are_not_flat(waves):
    """Not those of symmetric pictures without noise, nor those of 8 bits."""
    geometry = FrameGeometry(40, 40, PIXEL_UM)
    for values in (light(waves), np.round(255 * light(waves)), np.round(200 * with_noise(light(waves), 0.01, 3))):
        assert Frame(values, geometry).clipped is None


@pytest.mark.parametrize("waves", [(0.0, 0.0, 0.0, 1.0), (0.812, 0.3, -0.2, -1.9)])
def test_a_wide_top_of_nine_clipped_pixels_is_flat(waves):
    geometry = FrameGeometry(40, 40, PIXEL_UM)
    for values in (light(waves), np.round(255 * light(waves)), np.round(200 * with_noise(light(waves), 0.01, 3))):
        level = np.sort(values.ravel())[-9]
        assert level > 0.3 * values.max(), "a wide top"
        assert Frame(np.minimum(values, level), geometry).clipped is not None


@pytest.mark.parametrize("waves", [(0.0, 0.0, 0.0, 0.0), (0.2, 0.0, 0.0, -0.2)])
def test_four_equal_tops_of_a_point_between_pixels_are_not_clipped_and_four_clipped_ones_are(waves):
    geometry = FrameGeometry(40, 40, PIXEL_UM)
    between = light(waves, middle=19.5)
    tops = between >= between.max() * (1 - 1e-12)
    assert tops.sum() == 4, "the middle of the point lies between four pixels"
    between[tops] = between.max()  # to the last bit, as counts are
    assert Frame(between, geometry).clipped is None
    beside = light(waves, middle=19.6)
    level = np.sort(beside.ravel())[-4]
    assert Frame(np.minimum(beside, level), geometry).clipped is not None


def test_a_frame_whose_every_point_is_clipped_gives_no_numbers():
    values = np.tile(light((0.3, 0.2, 0.0, 0.4)), (2, 3))
    frame = Frame(np.minimum(with_noise(1000 * values, 5.0, 2), 400.0), FrameGeometry(80, 120, PIXEL_UM))
    with pytest.raises(RequestError, match="saturated"):
        window_half(find_points(frame))
    stated = Frame(frame.values, frame.geometry, Noise(full_scale=400.0))
    assert stated.clipped is None  # it says nothing new


def test_one_blur_with_a_dark_ring_is_one_point():
    """A bright middle within a ring that is farther from it than parts of one point are usually apart."""
    across = np.arange(80) - 40
    radius = np.hypot(across, across[:, None])
    values = np.where(radius < 3, 1000.0, np.where(np.abs(radius - 17) < 3, 300.0, 0.0))
    frame = Frame(with_noise(values, 5.0, 4), FrameGeometry(80, 80, PIXEL_UM))
    (point,) = find_points(frame)
    assert point.good and (point.row, point.column) == pytest.approx((40, 40), abs=0.5)


@pytest.mark.parametrize(("noise", "seed"), in_tiers([(0.05, 11), (0.05, 12), (0.1, 13)], [(0.05, 12)]))
def test_a_faint_point_gets_its_deepest_minimum(noise, seed):
    rng = np.random.default_rng(seed)
    waves = rng.uniform(-1.5, 1.5, 4)
    found = fitted(with_noise(light(waves), noise, seed))
    assert off(found, waves) < 5
    assert any("may hide" in str(each) for each in found.warnings) == (found.r2[0] < 0.8)
