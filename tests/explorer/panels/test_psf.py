"""The PSF panel: as many samples as pixels once it rests, a badge that promises no more than is known."""

import numpy as np
import pytest

from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.panels.psf import badge_words, tip_words, top_value, unit_of
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.window.bars import shorten

BLURRED = change(default_state("double_gauss_28"), depth_mm=10.0, method="auto")


def test_the_picture_is_summed_for_the_pixels_it_is_shown_on(window, qtbot):
    """In the panel, in a window of its own, and in a larger one; not while a slider moves."""
    panel = window.panels["psf"]
    window.store.update(windows=("psf",), method="fitted", f_number=8.0, field_deg=5.0)
    own = window.floating.open["psf"]
    for side in (500, 800):
        own.resize(side, side)
        qtbot.waitUntil(lambda least=side / 2: len(panel.map.indices) >= panel.map.device_pixels > least)
        assert window.live.psf.values.shape == (128, 128), "figures are of the picture, however large it is shown"
    with window.store.drag():
        window.store.update(field_deg=3.0)
        assert panel.map.indices.shape == (64, 64)
    qtbot.waitUntil(lambda: len(panel.map.indices) >= panel.map.device_pixels)
    assert panel._finer[0].source == window.live.setup.source


def test_a_finer_picture_that_comes_late_is_not_shown(window, qtbot):
    panel = window.panels["psf"]
    window.store.update(method="fitted", f_number=8.0, field_deg=4.0)
    wanted = panel._finer_request(window.live)
    window.store.update(field_deg=5.0)
    before = panel.map.indices
    panel._take(wanted, live(new_state()).psf)
    assert wanted and panel.map.indices is before


@pytest.mark.parametrize(
    ("method", "field_deg", "words", "colour"),
    [("seidel", 10.0, "no R² predicted", "warning"), ("traced", 5.0, "predicted R² ≥ 0.9999", "text")],
)
def test_the_badge_predicts_what_is_not_measured(window, method, field_deg, words, colour):
    """Above 1e-3 a predicted 1 − R² is a caution."""
    window.store.update(method=method, field_deg=field_deg, f_number=3.0 if method == "seidel" else 11.0)
    badge = window.panels["psf"].badge
    assert words in badge.text() and badge._colour == colour
    assert words in badge.toolTip()


def test_a_measured_figure_takes_the_place_of_the_prediction():
    shown = live(new_state(method="seidel", field_deg=2.0, f_number=8.0))
    whole, short = badge_words(shown, {"settled": "1.0"}, 0.998)
    assert "R² 0.9980 vs Huygens" in whole and "predicted" not in whole + short


def test_the_tool_tip_says_how_rays_fill_the_pupil():
    for aim, words in (("stop", "the real stop"), ("paraxial", "the paraxial entrance pupil")):
        assert words in tip_words(live(new_state(method="seidel", aim=aim)))[-1]


def test_ray_density_is_shown_over_its_peak_where_a_strehl_ratio_is_asked_for():
    shown = live(change(BLURRED, psf_units="strehl"))
    assert shown.psf.method == "geometric"
    assert (unit_of(shown.state, shown.psf), top_value(shown.state, shown.psf, 0.1)) == ("peak", 1.0)
    assert "R²" not in badge_words(shown, {"settled": "1.0"}, None)[0]
    assert np.isnan(np.asarray(shown.psf.strehl, float))


def test_warnings_lose_their_remedies_only_as_far_as_there_is_no_room():
    first, second, third = "Too wide; stop down.", "One ray is lost.", "Too steep; go near; now."
    assert shorten((first, second, third)) == (
        "⚠ Too wide; stop down.   ⚠ One ray is lost.   ⚠ Too steep …",
        "⚠ Too wide …   ⚠ One ray is lost.   ⚠ Too steep …",
    )
