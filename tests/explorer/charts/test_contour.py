"""Contours of the wavefront: where the lines lie for wavefronts whose contours are known."""

import numpy as np
import pytest

from p2sf.pupil.wavefront_map import disc
from p2sf_explorer.charts.contour import contours, finer, interval


def sampled(function, count=96):
    xi, eta, inside = disc(count)
    return np.where(inside, function(xi, eta), np.nan)


def test_the_lines_of_defocus_are_circles_at_the_roots_of_whole_steps():
    waves = sampled(lambda x, y: 3 * (x * x + y * y))
    shown = contours(waves, 1.0)
    count = len(shown)
    axis = (np.arange(count) + 0.5) * 2 / count - 1
    x, y = np.meshgrid(axis, axis)
    lines = np.isnan(shown) & (np.hypot(x, y) < 0.97)
    radius = np.hypot(x, y)[lines]
    nearest = np.abs(radius[:, None] - np.sqrt([1 / 3, 2 / 3])).min(axis=1)
    assert lines.any() and nearest.max() < 2.5 * (axis[1] - axis[0])


def test_the_bands_of_a_tilt_are_stripes_at_half_steps():
    shown = contours(sampled(lambda x, y: 2 * y), 1.0)
    bands = np.unique(shown[np.isfinite(shown)])
    assert bands == pytest.approx([-1.5, -0.5, 0.5, 1.5])
    middle = shown[:, shown.shape[1] // 2]
    assert (np.diff(middle[np.isfinite(middle)]) >= 0).all()


def test_finer_samples_keep_a_plane_and_stay_inside():
    fine = finer(sampled(lambda x, y: x - 2 * y))
    count = len(fine)
    axis = (np.arange(count) + 0.5) * 2 / count - 1
    inner = np.hypot(axis, axis[:, None]) < 0.9
    assert fine[inner] == pytest.approx((axis - 2 * axis[:, None])[inner])
    assert np.isnan(fine[0, 0])


@pytest.mark.parametrize(("height", "step"), [(10.3, 1.0), (15.0, 2.0), (0.05, 0.01), (0.0, 0.01)])
def test_steps_are_round(height, step):
    assert interval(height) == pytest.approx(step)


def test_the_panel_shows_contours_and_says_their_step(window):
    window.store.update(phase="contour")
    panel = window.panels["pupil"]
    assert "line every" in panel.numbers.text()
    assert panel.map.indices.shape == (384, 384)
    with window.store.drag():
        window.store.update(field_deg=8.0)
        assert panel.map.indices.shape == (3 * 128, 3 * 128)
