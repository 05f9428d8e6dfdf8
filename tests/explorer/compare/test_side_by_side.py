"""A and B side by side on the stage: one range, one zoom, one crosshair, one scale of colours, and no B put into A."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtWidgets import QApplication

from p2sf_explorer.charts.colour_scale import ScaleLock
from p2sf_explorer.charts.linked import common_ends, union
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.pinning import pin
from p2sf_explorer.state.state import change


@pytest.fixture
def both(window):
    """Return the window with A at f/8 and B at f/4 beside each other."""
    window.store.update(f_number=4.0)
    window.store.replace(change(pin(window.store.state), f_number=8.0, shown="both"))
    return window


def charts(window, key: str = "psf"):
    return window.panels[key].map.chart, window.second.panel.map.chart


def test_one_click_shows_both_and_another_one_side_again(both, qtbot):
    bar = both.compare
    assert both.second.panel.widget.isVisible() and both._answers.beside.state.optics.f_number == 4.0
    assert (both.live.side, both.live.state.optics.f_number) == ("A", 8.0)
    assert "f/8" in bar.words.text() and "f/4" in bar.words.text(), "the bar names the differences"
    qtbot.mouseClick(bar.sides["a"], Qt.MouseButton.LeftButton)
    assert both.second.panel is None
    qtbot.mouseClick(bar.sides["both"], Qt.MouseButton.LeftButton)
    assert both.second.panel.widget.isVisible()


def test_one_key_pins_and_shows_both(window):
    window.compare.turn_both()
    assert window.second.panel and window.store.state.compare.pinned
    window.compare.turn_both()
    assert window.second.panel is None and window.store.state.compare.shown == "a"


def test_both_have_one_range_and_one_scale_of_colours(both):
    a, b = charts(both)
    assert a.x_axis.home == b.x_axis.home == union(a.x_axis.automatic, b.x_axis.automatic)
    first, second = both.panels["psf"].map, both.second.panel.map
    peaks = [side.psf.values.max() / side.psf.pixel_um**2 for side in (both.live, both._answers.beside)]
    assert first.bar.shared == second.bar.shared
    assert first.bar.shared.high == pytest.approx(max(peaks), rel=0.01), "summed anew for the panel: other samples"
    dimmer = (first, second)[int(np.argmin(peaks))]
    assert dimmer.indices.max() / 254 == pytest.approx(np.sqrt(min(peaks) / max(peaks)), abs=0.01), "root of the light"


def test_zoom_and_crosshair_go_together(both):
    a, b = charts(both)
    for one, other in ((a, b), (b, a)):
        one.zoom(one.area.center(), 0.5)
        assert other.x_axis.moved == one.x_axis.moved and other.y_axis.moved == one.y_axis.moved
        place = one.area.center() + QPointF(12, -7)
        one.hand.point(place)
        assert other.from_pixels(other.hand.at) == pytest.approx(one.from_pixels(place), abs=1e-9)
        one.hand.point(None)
        assert other.hand.at is None
    a.go_home()
    assert b.x_axis.moved is None


def test_alone_again_a_has_its_own_range_and_colours(both):
    chart = both.panels["psf"].map.chart
    both.store.update(shown="a")
    assert chart.x_axis.shared is None and both.panels["psf"].map.bar.shared is None
    chart.zoom(chart.area.center(), 0.5)  # what it was linked to is gone
    QApplication.processEvents()
    chart.go_home()


def test_nothing_of_b_is_put_into_a(both):
    both.store.update(stage="layout")
    before = both.store.state
    both.second.panel._store.update(field_deg=3.0)
    assert both.store.state == before and both.banner.isVisible()


def test_every_panel_takes_the_stage_with_both(both):
    for entry in REGISTRY:
        if entry.has_two_sides:
            both.take_stage(entry.key)
            assert type(both.second.panel) is type(both.panels[entry.key]), entry.key
            assert both.second.panel.widget.title.text().endswith("· B")
    both.take_stage("matrix")
    assert both.second.panel is None


def test_scales_of_different_measures_stay_apart():
    assert common_ends(ScaleLock("waves", -1.0, 1.0), ScaleLock("light", 0.0, 2.0)) is None
    assert common_ends(ScaleLock("waves", -1.0, 1.0), ScaleLock("waves", -3.0, 3.0)) == ScaleLock("waves", -3.0, 3.0)
