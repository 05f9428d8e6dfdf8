"""Bars per surface, side by side or alone, and the light between them and the layout."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtWidgets import QApplication

from p2sf.paraxial.seidel import coefficients
from p2sf_explorer.panels.layout.surface_highlight import section
from tests.support.windows.events import choose


@pytest.fixture
def panel(window):
    window.open_panel("seidel")
    made = window.panels["seidel"]
    choose(made.term, "w40")
    made.chart.grab()
    yield made
    window.store.point_at(0)


def on_surface(window, surface):
    """Return a point of the layout on a surface, above the axis."""
    chart = window.panels["layout"].chart
    z, y = section(window.live.setup.lens, surface)
    x, row = chart.to_pixels(z[-4], y[-4])
    return chart, QPointF(float(x), float(row)).toPoint()


def test_bars_are_as_high_as_the_contributions_and_the_last_is_their_sum(window, panel):
    waves = window.live.views["seidel"].found.waves["w40"]
    zero = float(panel.chart.to_pixels(0.0, 0.0)[1])
    per_wave = zero - float(panel.chart.to_pixels(0.0, 1.0)[1])
    for bar in panel.chart.bars:
        height = waves.sum() if bar.surface == 0 else waves[bar.surface - 1]
        room = panel.chart.room(bar)
        assert room.height() == pytest.approx(abs(height) * per_wave, abs=1e-6)
        assert (room.center().y() < zero) == (height > 0) or abs(height) < 1e-9
    assert panel.chart.bars[-1].surface == 0


def test_all_sums_stand_side_by_side_and_add_up(window, panel):
    choose(panel.term, "all")
    waves = window.live.views["seidel"].found.waves
    count = len(waves["w40"])
    for surface in range(1, count + 1):
        mine = [bar for bar in panel.chart.bars if bar.surface == surface]
        assert [bar.term for bar in mine] == ["w40", "w31", "w22", "petzval", "w11", "c1", "c2"]
        assert [bar.height for bar in mine] == pytest.approx([waves[bar.term][surface - 1] for bar in mine])
        rooms = [panel.chart.room(bar) for bar in mine]
        assert all(a.right() <= b.left() + 1e-6 for a, b in pairwise(rooms))
        assert abs(mine[0].x - surface) < 0.5 and abs(mine[-1].x - surface) < 0.5
    for bar in panel.chart.bars[-7:]:
        assert bar.surface == 0 and bar.height == pytest.approx(waves[bar.term].sum())
    six = window.live.setup.coefficients
    for term in ("w40", "w31", "w22", "w20", "w11"):
        assert waves[term].sum() == pytest.approx(float(getattr(six, term)), rel=1e-9)
    assert "486.1 − 656.3 nm" in panel.widget.readout.text()


def test_the_chromatic_sums_are_the_change_of_focus_and_height_between_the_lens_s_wavelengths(window, panel):
    """To first order in the dispersion: the difference of the coefficients themselves, the sensor in the image."""
    window.store.update(focus_mm=float("inf"), field_deg=10.0)
    live = window.live
    setup, waves = live.setup, live.views["seidel"].found.waves
    ends = [
        coefficients(setup.lens, setup.source.depth_mm, setup.source.field_slope, nm / 1000, setup.stop)
        for nm in (486.1327, 656.2725)
    ]
    source_um = setup.source.wavelength_um
    focus = float(ends[0].wd) * 0.4861327 / source_um - float(ends[1].wd) * 0.6562725 / source_um
    height_um = 1000 * float(ends[0].image_height - ends[1].image_height)
    # Dispersion from F to C is some 2 % of n − 1: second order leaves that much of each surface's part.
    scale = np.abs(waves["c1"]).max(), np.abs(waves["c2"]).max()
    assert waves["c1"].sum() == pytest.approx(focus, abs=0.05 * scale[0])
    tilt = float(setup.coefficients.reduced_slope) * height_um / source_um
    assert waves["c2"].sum() == pytest.approx(tilt, abs=0.05 * scale[1])


def test_pointing_at_a_bar_lights_its_surface_in_the_layout(window, panel, qtbot):
    bar = next(bar for bar in panel.chart.bars if bar.surface == 7)
    layout = window.panels["layout"].chart
    before = layout.grab().toImage()
    qtbot.mouseMove(panel.chart, panel.chart.room(bar).center().toPoint())
    assert layout.highlight.surface == 7 and panel.chart.highlighted == 7
    chart, point = on_surface(window, 7)
    now = chart.grab().toImage()
    assert now.pixelColor(point) != before.pixelColor(point)
    assert now.pixelColor(point).name() == window._theme.accent
    qtbot.mouseMove(panel.chart, QPoint(2, 2))
    assert layout.highlight.surface == 0


@pytest.mark.parametrize("surface", [1, 5, 11])
def test_pointing_at_a_surface_of_the_layout_marks_its_bar(window, panel, qtbot, surface):
    chart, point = on_surface(window, surface)
    qtbot.mouseMove(chart, point)
    assert panel.chart.highlighted == surface
    column = panel.chart.grab().toImage()
    x = float(panel.chart.to_pixels(surface + 0.45, 0.0)[0])
    assert column.pixelColor(int(x), int(panel.chart.area.top()) + 4).name() == window._theme.faint
    qtbot.mouseMove(chart, QPoint(3, 3))
    assert panel.chart.highlighted == 0


def test_pointing_is_no_step_of_undo(window, panel, qtbot):
    before = window.store.state
    chart, point = on_surface(window, 3)
    qtbot.mouseMove(chart, point)
    assert window.store.state is before


def test_dragging_the_source_still_works_beside_the_light(window, panel, qtbot):
    chart = window.panels["layout"].chart
    place = chart.handle.pixel(chart.live).toPoint()
    field = window.store.state.optics.field_deg
    qtbot.mousePress(chart, Qt.MouseButton.LeftButton, pos=place)
    qtbot.mouseMove(chart, place + QPoint(0, 12))
    qtbot.mouseRelease(chart, Qt.MouseButton.LeftButton, pos=place + QPoint(0, 12))
    assert window.store.state.optics.field_deg != field


@pytest.mark.parametrize("way", ["leave", "hide"])
def test_no_surface_is_pointed_at_once_the_table_is_left_or_hidden(window, panel, way):
    window.open_panel("lens")
    view = window.panels["lens"].view
    view.entered.emit(view.model().index(2, 0))
    assert window.store.pointed_at == 3
    if way == "leave":
        QApplication.sendEvent(view, QEvent(QEvent.Type.Leave))
    else:
        window.open_panel("seidel")
    assert window.store.pointed_at == 0 and window.panels["layout"].chart.highlight.surface == 0
