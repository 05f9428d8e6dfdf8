"""Every plot of every panel under a person's hands: it zooms, pans, says what is under the pointer, locks, resets."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QApplication

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.crosshair import lines_of, marks_of, place_box
from p2sf_explorer.charts.plots import ColourBar
from p2sf_explorer.compute.reference import measure
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.pinning import pin
from p2sf_explorer.widgets.card import chart_at
from p2sf_explorer.widgets.copying import copy_menu, data_of, picture_of
from tests.support.windows.windows import at_rest

# Tables, sliders, photos, a 3D scene; nothing until a picture is measured.
WITHOUT = {"coefficients", "lens", "misalign", "first_order", "solid", "import", "image", "measured", "performance"}
KEYS = [entry.key for entry in REGISTRY if entry.key not in WITHOUT]
LEFT, SHIFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.NoModifier


@pytest.fixture
def charts(window, qtbot, request):
    """Return the charts of a panel with their pictures, unlocked and whole; afterwards so again."""
    key = request.param
    window.store.update(f_number=8.0, field_deg=5.0, method="seidel")
    if key == "tolerances":  # in a low tab it has room for its table alone
        window.store.update(lens="achromat_f6", stage=key)
    window.open_panel(key)
    panel = window.panels[key]
    if key == "accuracy":
        panel.show_accuracy(measure(window.live, True, lambda: False, lambda part: None), stale=False)
    at_rest(window, qtbot)
    QApplication.processEvents()
    found = [chart for chart in panel.widget.findChildren(Chart) if chart.isVisible()]
    assert found, "a panel with plots shows one"
    yield found
    if key == "accuracy":
        show_no_accuracy(panel)
    for chart in found:
        chart.unpin_all()
        if chart.locked:
            chart.turn_lock("all")
        chart.go_home()
        chart.hand.point(None)


def show_no_accuracy(panel) -> None:
    """Have the panel of a window that measures nothing say again what will be there."""
    panel.body.setVisible(False)
    panel.empty.setVisible(True)


every_panel = pytest.mark.parametrize("charts", KEYS, indirect=True)


def point(chart: Chart, across: float, up: float) -> QPointF:
    """Return the whole pixel at parts of the plot's area."""
    area = chart.area
    return QPointF(QPointF(area.left() + across * area.width(), area.bottom() - up * area.height()).toPoint())


def lit(chart: Chart) -> QPointF:
    """Return a pixel near the middle where there is something to read."""
    places = ((0.5, 0.5), (0.52, 0.6), (0.45, 0.4), (0.3, 0.5), (0.7, 0.55), (0.55, 0.75), (0.35, 0.3), (0.62, 0.2))
    return next(p for p in (point(chart, *place) for place in places) if chart.read(*chart.from_pixels(p)))


def wheel(chart: Chart, at: QPointF, notches: int) -> None:
    turned, apart = QPoint(0, 120 * notches), chart.mapToGlobal(at)
    event = QWheelEvent(at, apart, QPoint(), turned, Qt.MouseButton.NoButton, NONE, Qt.ScrollPhase.NoScrollPhase, False)
    QApplication.sendEvent(chart, event)


def widths(chart: Chart) -> np.ndarray:
    return np.diff(np.array(chart.ranges()))[:, 0]


@pytest.mark.slow
@every_panel
def test_the_wheel_zooms_about_the_pointer_and_home_is_the_whole_plot(charts, qtbot):
    for chart in charts:
        whole, at = chart.ranges(), point(chart, 0.3, 0.7)
        before = chart.from_pixels(at)
        wheel(chart, at, 3)
        assert widths(chart) == pytest.approx(np.diff(np.array(whole))[:, 0] / 1.25**3)
        assert chart.from_pixels(at) == pytest.approx(before, abs=1e-9 * max(map(abs, np.ravel(whole))))
        qtbot.mouseDClick(chart, LEFT, pos=at.toPoint())
        assert chart.ranges() == whole
        wheel(chart, at, -1)
        qtbot.keyClick(chart, Qt.Key.Key_Home)
        assert chart.ranges() == whole and not chart.pins


@pytest.mark.slow
@every_panel
def test_a_drag_carries_the_picture_along(charts, qtbot, window):
    for chart in charts:
        start, by = point(chart, 0.4, 0.5), QPoint(23, -17)
        state, before = window.store.state, chart.from_pixels(start)
        held = SHIFT if chart.takes(start) else NONE
        qtbot.mousePress(chart, LEFT, held, pos=start.toPoint())
        for k in (0.3, 0.7, 1.0):
            QApplication.sendEvent(chart, moved(chart, start + k * QPointF(by), held))
        qtbot.mouseRelease(chart, LEFT, held, pos=start.toPoint() + by)
        assert chart.from_pixels(start + QPointF(by)) == pytest.approx(before, abs=1e-6 * widths(chart).max())
        assert window.store.state == state and not chart.pins, "nothing but the view has changed"
        chart.go_home()
        chart.setFocus()
        qtbot.keyClick(chart, Qt.Key.Key_Right, SHIFT)
        assert chart.moved and widths(chart) == pytest.approx(np.diff(np.array(chart.ranges()))[:, 0])


def moved(chart, at, held):
    return QMouseEvent(QEvent.Type.MouseMove, at, chart.mapToGlobal(at), Qt.MouseButton.NoButton, LEFT, held)


@pytest.mark.slow
@every_panel
def test_what_is_under_the_pointer_is_said_beside_it(charts, qtbot):
    for chart in charts:
        chart.clearFocus()
        at, bare = lit(chart), picture_of(chart).toImage()
        qtbot.mouseMove(chart, at.toPoint() + QPoint(2, 2))
        qtbot.mouseMove(chart, at.toPoint())  # no move is told from where the pointer is already
        reading = chart.crosshair()
        assert reading is not None and lines_of(reading) and all(text for *_, text, _ in lines_of(reading))
        assert not reading.values or any(character.isdigit() for character in reading.values[0].text)
        box = place_box(reading, chart)[1]
        assert not any(box.contains(mark) for mark in marks_of(reading, chart)), "the box covers what it reads"
        assert chart.rect().contains(box.toAlignedRect().adjusted(1, 1, -1, -1))
        assert chart.grab().toImage() != bare, "and it is painted"
        QApplication.sendEvent(chart, leaving())
        assert chart.grab().toImage() == bare


def leaving():
    return QEvent(QEvent.Type.Leave)


@pytest.mark.slow
@every_panel
def test_a_locked_scale_stays_and_an_unlocked_one_follows(charts, qtbot):
    for chart in charts:
        before = chart.ranges()
        (left, right), (low, high) = chart.x_axis.automatic, chart.y_axis.automatic
        for key, locked in ((Qt.Key.Key_L, True), (Qt.Key.Key_L, False)):
            qtbot.keyClick(chart, key)
            assert chart.locked is locked and (chart.bar is None or chart.bar.locked is locked)
            chart.set_range((left, right + (right - left)), (low, high + (high - low)))
            assert (chart.ranges() == before) is locked
        chart.set_range((left, right), (low, high))


@pytest.mark.slow
@every_panel
def test_a_marker_is_pinned_copied_and_removed(charts, qtbot, window):
    for chart in charts:
        chart.hand.point(lit(chart))
        bare, card = picture_of(chart).toImage(), window.panels[shown_key(window, chart)].widget
        rows = data_of(card).count("\r\n")
        chart.hand.point(lit(chart))
        qtbot.keyClick(chart, Qt.Key.Key_P)
        assert len(chart.pins) == 1
        assert picture_of(chart).toImage() != bare, "it is in pictures"
        assert data_of(card).count("\r\n") >= rows + 2, "and in data"
        qtbot.keyClick(chart, Qt.Key.Key_Escape)
        assert not chart.pins and picture_of(chart).toImage() == bare


def shown_key(window, chart) -> str:
    return next(key for key, panel in window.panels.items() if panel.widget.isAncestorOf(chart))


def test_a_click_pins_and_a_double_click_does_not(window, qtbot):
    chart = window.panels["psf"].map.chart
    at = point(chart, 0.4, 0.5).toPoint()
    qtbot.mouseClick(chart, LEFT, pos=at)
    assert len(chart.pins) == 1
    qtbot.mouseClick(chart, LEFT, pos=at)
    assert not chart.pins, "a click on a marker takes it away"
    qtbot.mouseClick(chart, LEFT, pos=at)
    qtbot.mouseDClick(chart, LEFT, pos=at)
    assert not chart.pins


def test_a_marker_stays_where_it_is_and_is_read_again_as_sliders_move(window):
    window.store.update(tab="mtf", f_number=8.0)
    chart = window.panels["mtf"].chart
    chart.pin(QPointF(*(float(v) for v in chart.to_pixels(50.0, 0.5))))
    (_, first), at = chart.pinned()[0], chart.pins[0]
    window.store.update(f_number=5.6)
    (kept, later) = chart.pinned()[0]
    assert kept == at and later.x == first.x == at.x
    assert [value.number for value in later.values] != [value.number for value in first.values]
    chart.unpin_all()


def test_the_menu_of_a_plot_offers_what_keys_do(window):
    card, chart = window.panels["psf"].widget, window.panels["psf"].map.chart
    assert chart_at(card, chart.mapTo(card, chart.rect().center())) is chart
    menu = copy_menu(card)
    chart.hand.fill(menu, point(chart, 0.4, 0.5).toPoint())
    named = {action.text().split("\t")[0]: action for action in menu.actions()}
    named["Pin a marker here"].trigger()
    named["Zoom in"].trigger()
    named["Lock the scale"].trigger()
    assert chart.pins and chart.moved is False and chart.locked, "a lock takes what is on screen as the whole"
    assert widths(chart)[0] < np.diff(chart.x_axis.automatic)[0]
    chart.unpin_all()
    chart.turn_lock("all")
    menu.deleteLater()


def test_colours_that_are_locked_show_a_growing_blur_grow_dim(window):
    """The peak falls as the PSF spreads; over its own peak every picture is as bright."""
    window.store.update(free_pupil=True, psf_scale="linear")
    heat = window.panels["psf"].map
    heat.bar.turn_lock(True)
    first = float(heat.values.max())
    window.store.update(added_waves=(0.0, 0.0, 0.0, 0.0, 1.5, 0.0))
    psf = window.live.psf
    assert first == pytest.approx(1.0)
    assert float(heat.values.max()) == pytest.approx(float(psf.strehl), rel=0.02)  # the same light, a perfect pupil
    assert heat.indices.max() < 100
    heat.bar.turn_lock(False)
    assert float(heat.values.max()) == pytest.approx(1.0)
    assert heat.indices.max() >= 252  # painted between the samples, so up to half a cell beside the peak


@pytest.mark.parametrize("units", ["sum", "strehl"])
def test_locked_colours_hold_in_every_unit_and_through_a_drag(window, units):
    """A preview has larger pixels than a settled picture; its light per µm² is about the same."""
    window.store.update(free_pupil=True, psf_units=units, psf_scale="linear")
    heat = window.panels["psf"].map
    heat.bar.turn_lock(True)
    settled = int(heat.indices.max())
    with window.store.drag():
        window.store.update(added_waves=(0.0, 0.0, 0.0, 0.0, 0.01, 0.0))
        assert abs(int(heat.indices.max()) - settled) < 60
    heat.bar.turn_lock(False)


def test_a_lock_is_given_up_for_other_quantities(window):
    heat = window.panels["psf"].map
    heat.bar.turn_lock(True)
    window.store.replace(pin(window.store.state))
    window.store.update(f_number=8.0, shown="difference")
    assert not heat.bar.locked


def test_the_lock_below_a_bar_is_turned_by_a_click(window, qtbot):
    bar: ColourBar = window.panels["psf"].map.bar
    for locked in (True, False):
        qtbot.mouseClick(bar, LEFT, pos=bar.lock_place().center().toPoint())
        assert bar.locked is locked


def test_scales_stay_in_a_drag_that_changes_little_and_jump_by_steps_in_one_that_changes_much(window):
    window.store.update(tab="ray_fan", free_pupil=False, f_number=4.0)
    chart, seen = window.panels["ray_fan"].chart, []
    with window.store.drag():
        for shift in np.linspace(0.0, 400.0, 60):
            window.store.update(sensor_shift_um=float(shift))
            seen += [chart.y_axis.shown] if chart.y_axis.shown not in seen[-1:] else []
    window.store.update(sensor_shift_um=0.0)
    assert 2 <= len(seen) <= 5
    for low, high in seen:
        digit = f"{high:e}"[0]
        assert low == -high and digit in "12357"


def test_space_for_a_drag_of_the_charts_own(window, qtbot):
    """On the strip a drag moves the sensor; with Shift, or the middle button, it pans."""
    window.store.update(tab="through_focus")
    chart = window.panels["through_focus"].chart
    at_rest(window, qtbot)
    at = point(chart, 0.3, 0.5)
    before = window.store.state.optics.sensor_shift_um
    qtbot.mousePress(chart, Qt.MouseButton.MiddleButton, pos=at.toPoint())
    QApplication.sendEvent(chart, moved(chart, at + QPointF(40, 0), NONE))
    qtbot.mouseRelease(chart, Qt.MouseButton.MiddleButton, pos=at.toPoint())
    assert chart.moved and window.store.state.optics.sensor_shift_um == before
    chart.go_home()
    qtbot.mouseClick(chart, LEFT, pos=at.toPoint())
    assert window.store.state.optics.sensor_shift_um != before and not chart.pins


def test_the_mixers_scale_changes_in_steps_and_can_be_locked(window, qtbot):
    bars = window.panels["coefficients"].bars
    window.store.update(free_pupil=True, added_waves=(0.0, 0.0, 1.9, 0.0, 0.0, 0.0))
    seen = {bars.limit}
    window.store.update(added_waves=(0.0, 0.0, 0.9, 0.0, 0.0, 0.0))
    seen.add(bars.limit)
    assert len(seen) == 1, "a bar that shrinks to half is seen to shrink"
    qtbot.mouseClick(bars, LEFT, pos=bars.places.lock().center().toPoint())
    window.store.update(added_waves=(0.0, 0.0, 40.0, 0.0, 0.0, 0.0))
    assert bars.locked and {bars.limit} == seen
    qtbot.keyClick(bars, Qt.Key.Key_L)
    window.store.update(added_waves=(0.0, 0.0, 41.0, 0.0, 0.0, 0.0))
    assert bars.limit == 50.0
