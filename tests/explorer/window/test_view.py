"""How the window is looked at: size of type on small and large screens, presenting, and the keyboard's way through."""

from types import SimpleNamespace

import pytest
from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QTabBar,
    QTableView,
    QWidget,
)

from p2sf_explorer.charts import painting
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import change
from p2sf_explorer.state.workspaces import WORKSPACES, with_workspace
from p2sf_explorer.window.presentation import LARGER, LARGER_BESIDE
from p2sf_explorer.window.view import PERCENTS, next_stop, stops
from p2sf_explorer.window.window import MainWindow
from tests.explorer.conftest import FIRST
from tests.explorer.window.test_stage import where

CONTROL = Qt.KeyboardModifier.ControlModifier
WRITTEN = QLabel, QAbstractButton, QComboBox, QHeaderView, QLineEdit, QTabBar, QTableView


def on_screen(monkeypatch, window, width: int, height: int) -> None:
    """Have the window believe that it stands on a screen of this size."""
    monkeypatch.setattr(MainWindow, "screen", lambda window: SimpleNamespace(size=lambda: QSize(width, height)))
    window.refresh(window.store.state)
    window.resize(width, height)
    QApplication.processEvents()


@pytest.fixture
def large(window, monkeypatch):
    """Return the window; afterwards it is on its own screen again."""
    yield window
    monkeypatch.undo()
    window.store.replace(FIRST)
    window.refresh(window.store.state)
    window.resize(1440, 900)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "least"), [((2560, 1440), 14), ((3840, 2160), 20)])
def test_on_a_large_screen_no_type_is_too_small_to_read(large, monkeypatch, size, least):
    """Of every widget that has words, and of everything that charts and readouts write, over all panels."""
    window, painted = large, set()
    own = painting.small_font
    monkeypatch.setattr(painting, "small_font", lambda size=11: (painted.add(size), own(size))[1])
    on_screen(monkeypatch, window, *size)
    window.store.update(playback_slider="field_deg")
    for entry in REGISTRY:
        if entry.key != "solid":  # which needs a renderer
            window.take_stage(entry.key)
            window.grab()
            small = {
                f"{entry.key}: {type(part).__name__} {part.objectName()} {part.fontInfo().pixelSize()}"
                for part in window.findChildren(QWidget)
                if isinstance(part, WRITTEN) and part.isVisible() and part.fontInfo().pixelSize() < least
            }
            assert not small
    assert painted and min(painted) >= least


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "de"])
def test_every_workspace_fits_a_screen_of_1280_by_720(qapp, language):
    set_language(language)
    made = MainWindow(change(FIRST, language=language), measured=False)
    try:
        made.show()
        for name, workspace in WORKSPACES.items():
            made.store.replace(with_workspace(FIRST, name, workspace))
            QApplication.processEvents()
            least = made.minimumSizeHint()
            assert least.width() <= 1280 and least.height() <= 680, (
                name
            )  # forty for the frame and a panel of the desktop
    finally:
        set_language("en")
        made.close()
        made.deleteLater()


@pytest.mark.parametrize(("size", "wanted"), [((1280, 720), (1280, 680)), ((3840, 2160), (2880, 1800))])
def test_the_first_start_fits_the_screen(large, monkeypatch, size, wanted):
    room = SimpleNamespace(size=lambda: QSize(*size), availableSize=lambda: QSize(*size))
    monkeypatch.setattr(MainWindow, "screen", lambda window: room)
    large.refresh(large.store.state)
    large.fit_screen()
    QApplication.processEvents()
    assert (large.width(), large.height()) == wanted


@pytest.mark.slow
def test_the_keys_make_type_larger_smaller_and_fit_for_the_screen(large, qtbot):
    window = large
    plain = window.controls.focus_button.fontInfo().pixelSize()
    qtbot.keyClick(window, Qt.Key.Key_Plus, CONTROL)
    assert window.store.state.display.scale_percent == 110
    assert window.controls.focus_button.fontInfo().pixelSize() == round(1.1 * plain)
    for _ in PERCENTS:
        qtbot.keyClick(window, Qt.Key.Key_Equal, CONTROL)
    assert window.store.state.display.scale_percent == 300
    QApplication.processEvents()
    for _ in PERCENTS:
        qtbot.keyClick(window, Qt.Key.Key_Minus, CONTROL)
    assert window.store.state.display.scale_percent == 50
    qtbot.keyClick(window, Qt.Key.Key_0, CONTROL)
    assert window.store.state.display.scale_percent is None
    assert window.controls.focus_button.fontInfo().pixelSize() == plain


@pytest.mark.parametrize("percent", [50.0, 200.0, 300.0])
def test_strokes_margins_and_the_column_follow_the_type(large, qtbot, percent):
    window = large
    wide = window.left.width()
    window.store.update(scale_percent=percent)
    QApplication.processEvents()
    part = percent / 100
    assert window.left.width() == round(part * wide)
    slider = window.controls.rows["field_deg"].slider
    qtbot.waitUntil(lambda: slider.height() == slider.sizeHint().height())
    assert slider.handle_x() < slider.width() and slider.height() == slider.sizeHint().height()
    assert window.panels["psf"].map.chart.theme.scale == part
    assert window.controls.facts.height() == round(17 * part * len(window.controls.facts.rows))


def test_a_lesson_is_presented_in_larger_type(window):
    window.teaching.toggle()
    QApplication.processEvents()
    words, before = window.teaching.panel, window.left.width()
    small = words.fontMetrics().height()
    window.presentation.start()
    try:
        QApplication.processEvents()
        assert words.fontMetrics().height() > 1.4 * small and window.left.width() == round(1.5 * before)
    finally:
        window.presentation.stop()
        QApplication.processEvents()
    assert words.fontMetrics().height() == small and window.left.width() == before
    window.teaching.leave()


def test_presenting_shows_the_stage_alone_with_larger_type_and_ends_as_it_was(large, qtbot):
    window = large
    before, type_px = where(window), window.panels["psf"].widget.title.fontInfo().pixelSize()
    size = window.size()
    qtbot.keyClick(window, Qt.Key.Key_F5)
    assert window.isFullScreen() and where(window) == ("psf",) and set(window.live.views) == {"psf"}
    assert window.panels["psf"].widget.title.fontInfo().pixelSize() == LARGER * type_px
    assert window.panels["psf"].map.chart.theme.scale == LARGER * window._theme.scale
    assert not window.top.isVisible() and not window.status.isVisible()
    assert window.controls.rows["field_deg"].isVisible() and not window.controls.figures.isVisible()
    QApplication.processEvents()
    rows = [row.geometry() for row in window.controls.rows.values() if row.isVisible()]
    assert rows[-1].bottom() < 520 * LARGER_BESIDE, "the sliders stay together at the top"
    assert QApplication.overrideCursor().pixmap().width() > 64
    window.store.update(field_deg=5.0)
    assert window.live.state.optics.field_deg == 5.0
    qtbot.keyClick(window, "2")
    assert where(window) == ("pupil",), "what is on the stage may change"
    qtbot.keyClick(window, "2")
    qtbot.keyClick(window, Qt.Key.Key_Escape)
    assert not window.isFullScreen() and QApplication.overrideCursor() is None
    assert where(window) == before and window.top.isVisible() and window.controls.figures.isVisible()
    assert window.panels["psf"].widget.title.fontInfo().pixelSize() == type_px
    window.resize(size)
    state = window.store.state
    qtbot.keyClick(window, Qt.Key.Key_Escape)
    assert window.store.state == state, "outside of presenting the key is free"


def test_presenting_leaves_the_state_alone(large, qtbot):
    window = large
    before = window.store.state
    qtbot.keyClick(window, Qt.Key.Key_F5)
    qtbot.keyClick(window, Qt.Key.Key_F5)
    assert window.store.state is before


def test_with_a_second_screen_the_controls_stay_at_the_desk(large, monkeypatch):
    window = large
    screen = window.windowHandle().screen()
    monkeypatch.setattr("p2sf_explorer.window.presentation.other_screen", lambda window: screen)
    window.presentation.start()
    desk = window.presentation._desk
    assert desk.isVisible() and window.controls.window() is desk and desk.isAncestorOf(window.left)
    reached = stops(window.room.stage)[:1]
    while (following := next_stop(window, window._parts(), reached[-1], 1)) is not reached[0]:
        reached.append(following)
    assert window.controls.rows["field_deg"].slider in reached, "Tab goes to the desk too"
    window.controls.rows["field_deg"].slider.setValue(300)
    assert window.live.state.optics.field_deg != 10.0
    window.presentation.stop()
    assert window.controls.window() is window and window.controls.isVisible()
    assert window.left.mapTo(window, window.left.rect().topLeft()).x() < 20, "at the left again"


def test_tab_goes_from_bar_to_controls_to_stage_to_rail(window, qtbot):
    """In this order, whatever has moved since, and from left to right along the bar."""
    for key in ("pupil", "mtf", "psf"):
        window.take_stage(key)
    window.top.lens.setFocus()
    met = []
    for _ in range(200):
        met.append(QApplication.focusWidget())
        qtbot.keyClick(met[-1], Qt.Key.Key_Tab)
        if QApplication.focusWidget() is met[0]:
            break
    assert len(set(met)) == len(met) > 50
    parts = [part for part in window._parts() if part.isVisible()]
    order = [next(k for k, part in enumerate(parts) if part.isAncestorOf(stop)) for stop in met]
    assert order == sorted(order) and set(order) == set(range(7))
    along = [stop.mapTo(window, stop.rect().topLeft()).x() for stop in met[: order.count(0)]]
    assert along == sorted(along)


def test_f6_goes_through_the_parts_and_back(window, qtbot):
    window.top.lens.setFocus()
    parts = [part for part in window._parts() if part.isVisible()]
    assert len(parts) == 7
    met = []
    for _ in parts:
        qtbot.keyClick(window, Qt.Key.Key_F6)
        met.append(next(part for part in parts if part.isAncestorOf(QApplication.focusWidget())))
    assert met == [*parts[1:], parts[0]]
    qtbot.keyClick(window, Qt.Key.Key_F6, Qt.KeyboardModifier.ShiftModifier)
    assert parts[-1].isAncestorOf(QApplication.focusWidget())


def test_controls_and_rail_are_hidden_by_keys(window, qtbot):
    qtbot.keyClick(window, Qt.Key.Key_F8)
    qtbot.keyClick(window, Qt.Key.Key_F9)
    QApplication.processEvents()
    assert not window.left.isVisible() and not window.room.rail.isVisible()
    assert window.room.stage.width() > 0.97 * window.width()
    qtbot.keyClick(window, Qt.Key.Key_F9, Qt.KeyboardModifier.ShiftModifier)
    assert window.room.rail.isVisible() and window.room.orientation() == Qt.Orientation.Vertical
    qtbot.keyClick(window, Qt.Key.Key_F8)
    assert window.left.isVisible()
