"""The perfect lens and the pixels beside the picture."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.views.pixels import airy_share, beside, over_pixels, pixel_weights
from p2sf_explorer.state.state import change, new_state

FIRST = new_state(method="seidel", theme="light")


def test_without_aberrations_this_lens_is_the_perfect_one():
    view = beside(live(change(FIRST, free_pupil=True))).found
    assert view.real == pytest.approx(view.perfect, abs=2e-3)  # the settled sum keeps 1e-4 of the whole


def test_pixels_share_the_light_out_without_loss():
    answer = live(change(FIRST, f_number=8.0))
    for pixel in (1.0, 3.3, 50.0, 1000.0):
        assert over_pixels(answer.psf, pixel).sum() == pytest.approx(1, abs=1e-9)


def test_a_pixel_of_one_sample_is_the_sample_and_a_sensor_of_one_pixel_sees_all():
    answer = live(change(FIRST, f_number=8.0))
    same = over_pixels(answer.psf, answer.psf.pixel_um)
    n = answer.psf.values.shape[0]
    middle = same.shape[0] // 2
    assert same[middle : middle + 20, middle] == pytest.approx(answer.psf.values[n // 2 : n // 2 + 20, n // 2])
    assert over_pixels(answer.psf, 1e4).shape == (1, 1)


def test_weights_count_every_sample_once():
    position = (np.arange(16) - 8) * 0.7
    weights = pixel_weights(position, 0.7, 1.9)
    assert weights.sum(0) == pytest.approx(np.ones(16)) and weights.shape[0] % 2 == 1
    assert weights[0].any(), "the first pixel is not beyond the light"


def test_the_share_of_an_airy_pattern_in_a_square_lies_between_its_circles():
    """The inscribed and the circumscribed circle of the pixel bound it; 83.8 % lies inside the first ring."""
    assert airy_share(2.0, 400.0) == pytest.approx(1, abs=0.01)
    assert 0.838 < airy_share(2.0, 4.0) < 0.911  # circles of 1 and √2 times the first ring's radius
    assert airy_share(2.0, 0.02) == pytest.approx((3.8317 / 2) ** 2 / (4 * np.pi) * 0.02**2, rel=1e-3)  # peak × area


def test_the_panel_shows_the_pixel_that_is_typed(window, qtbot):
    window.store.update(tab="beside", free_pupil=True)
    panel = window.panels["beside"]
    panel.pixel.edit.setFocus()
    panel.pixel.edit.selectAll()
    qtbot.keyClicks(panel.pixel.edit, "2")
    qtbot.keyClick(panel.pixel.edit, Qt.Key.Key_Return)
    assert window.store.state.display.pixel_um == 2.0
    fine = panel.maps[2].indices.shape
    window.store.update(pixel_um=4.0)
    assert panel.maps[2].indices.shape[0] < fine[0]
    share = 100 * airy_share(window.live.airy_radius_um, 4.0)
    assert f"perfect lens's {share:.3g} %" in panel.widget.readout.text()
    held = float(panel.widget.readout.text().split("holds ")[1].split(" %")[0])
    assert held == pytest.approx(share, abs=1.5), "of a perfect pupil; a sample is a third of a pixel"


def test_all_three_show_the_same_lengths(window):
    window.store.update(tab="beside")
    ranges = {heat.chart.ranges() for heat in window.panels["beside"].maps}
    assert len({round(r[1][1], 6) for r in ranges}) == 1
