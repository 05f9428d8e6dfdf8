"""The PSF panel: as many samples as pixels once it rests, a badge that promises no more than is known."""

from dataclasses import replace
from itertools import pairwise
from threading import Event

import numpy as np
import pytest

from p2sf.errors import Cancelled
from p2sf.figures.enlarge import LARGEST
from p2sf_explorer.compute.finer import fade
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import default_state, load, shipped_names
from p2sf_explorer.panels.psf import badge_words, tip_words, top_value, unit_of
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.window.bars import shorten

BLURRED = change(default_state("double_gauss_28"), depth_mm=10.0, method="auto")


def test_the_picture_is_smooth_and_fills_the_view(window, qtbot):
    """In a window of its own, wide and tall, at rest; while a slider moves, it is enlarged from what is there."""
    panel = window.panels["psf"]
    window.store.update(windows=("psf",), method="fitted", f_number=8.0, field_deg=5.0)
    own = window.floating.open["psf"]
    for size in ((500, 500), (1400, 500)):
        own.resize(*size)
        qtbot.waitUntil(lambda: panel.map.rect_shown[0] <= -panel.map.reach)
        assert window.live.psf.values.shape == (128, 128), "figures are of the picture, however large it is shown"
    with window.store.drag():
        window.store.update(field_deg=3.0)
        assert window.live.psf.values.shape == (64, 64) and panel.map.indices.shape == (256, 256)
        assert panel.map.values.shape == (64, 64), "what is read are samples"


def circle_over_stage(window) -> float:
    """Return the diameter of the circle of 90 % of the light over the stage's shorter side, by a sum of its own."""
    live, chart = window.live, window.panels["psf"].map.chart
    x, y, light = live.psf.x_um, live.psf.y_um, live.psf.values
    away = np.hypot(x - (light * x).sum() / light.sum(), (y - (light * y[:, None]).sum() / light.sum())[:, None])
    order = np.argsort(away.ravel())
    radius = away.ravel()[order][np.searchsorted(np.cumsum(light.ravel()[order]), 0.9 * light.sum())]
    return 2 * max(radius, 1.5 * live.airy_radius_um) / min(end - start for start, end in chart.ranges())


@pytest.mark.parametrize("state", [{"f_number": 8.0}, {"field_deg": 14.0}, {"depth_mm": 9000.0}, {"field_deg": 9.0}])
def test_the_light_fills_the_stage(window, qtbot, state):
    """The circle of 90 % of the light, at least 3 Airy radii across."""
    window.store.update(method="fitted", **state)
    assert 0.62 <= circle_over_stage(window) <= 0.95


def test_the_frame_moves_in_calm_steps(window):
    chart, frames = window.panels["psf"].map.chart, []
    with window.store.drag():
        for field in np.linspace(4.0, 8.0, 41):
            window.store.update(method="fitted", field_deg=float(field))
            frames.append(chart.ranges())
    assert len(set(frames)) <= 10
    halves = [high - low for _, (low, high) in frames]
    assert all(0.8 < b / a < 1.25 for a, b in pairwise(halves))


def test_no_edge_of_the_computed_square_is_painted():
    picture = fade(np.ones((64, 64), np.float32))
    assert picture[0].max() == picture[:, -1].max() == 0.0 and picture[8:-8, 8:-8].min() == 1.0


def test_a_finer_picture_that_comes_late_is_kept_but_not_shown(window, qtbot):
    panel = window.panels["psf"]
    window.store.update(method="fitted", f_number=8.0, field_deg=4.0)
    wanted = panel._finer_request(window.live)
    window.store.update(field_deg=5.0)
    before = panel.map.indices
    late = live(new_state()).psf
    panel._take(wanted, late)
    assert wanted and panel.map.indices is before
    assert panel._finer.get(wanted) is late, "it may have been asked last, and is not asked again"


def test_a_sum_for_an_earlier_picture_ends_when_another_is_wanted(window, qtbot, monkeypatch):
    """As of a lens that is no longer open, which kept the panel busy for up to a minute."""
    panel, ended = window.panels["psf"], Event()

    def until_cancelled(cancelled, tell):
        if cancelled.wait(20):
            ended.set()
        raise Cancelled("no longer wanted")

    qtbot.waitUntil(lambda: not panel.late.busy)
    panel.late.submit("an earlier picture", until_cancelled)
    monkeypatch.setattr(panel, "_finer_request", lambda live: "another picture")
    monkeypatch.setattr(panel.late, "ask", lambda question: None)
    panel.show(window.live)
    qtbot.waitUntil(ended.is_set, timeout=2000)


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
    whole, short = badge_words(shown, 0.998)
    assert "R² 0.9980 vs Huygens" in whole and "predicted" not in whole + short


def test_the_tool_tip_says_how_rays_fill_the_pupil():
    for aim, words in (("stop", "the real stop"), ("paraxial", "the paraxial entrance pupil")):
        assert words in tip_words(live(new_state(method="seidel", aim=aim)))[-1]


def test_ray_density_is_shown_over_its_peak_where_a_strehl_ratio_is_asked_for():
    shown = live(change(BLURRED, psf_units="strehl"))
    assert shown.psf.method == "geometric"
    assert (unit_of(shown.state, shown.psf), top_value(shown.state, shown.psf, 0.1)) == ("peak", 1.0)
    assert "R²" not in badge_words(shown, None)[0]
    assert np.isnan(np.asarray(shown.psf.strehl, float))


def test_warnings_lose_their_remedies_only_as_far_as_there_is_no_room():
    first, second, third = "Too wide; stop down.", "One ray is lost.", "Too steep; go near; now."
    assert shorten((first, second, third)) == (
        "⚠ Too wide; stop down.   ⚠ One ray is lost.   ⚠ Too steep …",
        "⚠ Too wide …   ⚠ One ray is lost.   ⚠ Too steep …",
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", shipped_names())
def test_the_light_of_every_lens_fills_the_stage_at_every_field(window, qtbot, name):
    """Of near objects up to the field that opens, since the file's field is that of another distance."""
    opens = default_state(name)
    largest = max(map(abs, load(name).fields_deg)) if np.isinf(opens.optics.depth_mm) else opens.optics.field_deg
    for share in (0.0, 0.7, 1.0):
        window.store.replace(change(opens, field_deg=share * largest, method="auto"))
        qtbot.waitUntil(lambda: not window.late_sums.busy)
        assert 0.6 <= circle_over_stage(window) <= 0.95, share


def test_a_picture_that_is_fine_enough_is_read_as_it_is(window):
    """Its samples are painted themselves, and were divided by their peak twice: a marker read 24 000 (peak = 1)."""
    window.store.update(method="seidel", f_number=8.0, field_deg=4.0)
    panel = window.panels["psf"]
    axis = np.linspace(-3, 3, 2 * LARGEST)
    light = np.exp(-(axis**2) - axis[:, None] ** 2).astype(np.float32)
    light /= light.sum()
    kept = light.copy()
    panel._paint(window.live, replace(window.live.psf, values=light))
    assert np.array_equal(light, kept) and panel.map.values.max() == pytest.approx(1.0)
