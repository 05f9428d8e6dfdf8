"""Structural similarity against its definition and its laws."""

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.image.charts import draw_chart
from p2sf.image.similarity import ssim

RANDOM = np.random.default_rng(3)
ONE = RANDOM.random((24, 30)).astype(np.float32)
TWO = (0.7 * ONE + 0.3 * RANDOM.random((24, 30))).astype(np.float32)


def by_definition(one: np.ndarray, two: np.ndarray) -> float:
    """Return Wang et al.'s eq. 13 window by window, the means summed over 11 × 11 weights, in double precision."""
    x = np.arange(-5, 6)
    weights = np.exp(-(x**2 + x[:, None] ** 2) / (2 * 1.5**2))
    weights /= weights.sum()
    found = []
    for row in range(5, one.shape[0] - 5):
        for column in range(5, one.shape[1] - 5):
            a, b = (p[row - 5 : row + 6, column - 5 : column + 6].astype(float) for p in (one, two))
            mean_a, mean_b = (weights * a).sum(), (weights * b).sum()
            variance_a, variance_b = (weights * (a - mean_a) ** 2).sum(), (weights * (b - mean_b) ** 2).sum()
            covariance = (weights * (a - mean_a) * (b - mean_b)).sum()
            light = (2 * mean_a * mean_b + 1e-4) / (mean_a**2 + mean_b**2 + 1e-4)
            found.append(light * (2 * covariance + 9e-4) / (variance_a + variance_b + 9e-4))
    return float(np.mean(found))


def test_it_is_its_definition():
    """float32 squares leave 1e-6 of a variance of 0.08."""
    assert ssim(ONE, TWO) == pytest.approx(by_definition(ONE, TWO), abs=1e-4)


def test_equal_pictures_are_one_and_order_does_not_matter():
    assert ssim(ONE, ONE) == pytest.approx(1.0, abs=1e-6)
    assert ssim(ONE, TWO) == pytest.approx(ssim(TWO, ONE), abs=1e-6)
    assert ssim(ONE, 1 - ONE) < 0, "a negative is the opposite"


def test_even_pictures_differ_by_their_light_alone():
    """(2ab + C₁)/(a² + b² + C₁), since nothing varies: for 0.4 and 0.8 that is 0.6401/0.8001."""
    even = np.full((16, 16), 0.4), np.full((16, 16), 0.8)
    assert ssim(*even) == pytest.approx(0.6401 / 0.8001, abs=1e-4)


def test_the_scale_of_levels_drops_out_with_their_white():
    assert ssim(255 * ONE, 255 * TWO, white=255.0) == pytest.approx(ssim(ONE, TWO), abs=1e-5)


def test_more_noise_is_less_alike_and_channels_are_averaged():
    picture = draw_chart("landscape", 64, 96)
    noises = [np.clip(picture + RANDOM.normal(0, sigma, picture.shape), 0, 1) for sigma in (0.01, 0.05, 0.2)]
    found = [ssim(picture, noisy) for noisy in noises]
    assert found == sorted(found, reverse=True) and found[0] > 0.9 > found[-1]
    planes = [ssim(picture[..., k], noises[1][..., k]) for k in range(3)]
    assert found[1] == pytest.approx(np.mean(planes), abs=1e-6)


@pytest.mark.parametrize("shapes", [((20, 20), (20, 21)), ((10, 30), (10, 30))])
def test_pictures_that_cannot_be_compared_are_refused(shapes):
    with pytest.raises(RequestError, match="at least 11"):
        ssim(*(np.zeros(shape) for shape in shapes))
