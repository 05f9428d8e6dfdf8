"""Groups of tabs, and panels in windows of their own, by mouse and keyboard."""

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton
from shiboken6 import isValid

from p2sf.errors import P2SFError
from p2sf.paraxial.balance import best_focus_um
from p2sf_explorer.compute.autofocus import best_shift_um
from p2sf_explorer.compute.setup import default_state, paraxial_setup
from p2sf_explorer.files.session import last_session
from p2sf_explorer.files.session_keeper import SessionKeeper
from p2sf_explorer.panels import build, end_work
from p2sf_explorer.state.panels import GROUPS, REGISTRY
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.state.state_files import state_from_json, state_to_json
from p2sf_explorer.window.tabs import beside
from p2sf_explorer.window.window import MainWindow

ELSEWHERE = {"psf", "layout", "pupil", "coefficients"}  # on the stage and in the rail of the test's window


def shown(window) -> set[str]:
    """Return the panels whose tab can be clicked."""
    tabs = window.tabs
    return {tabs.widget(k).objectName() for k in range(tabs.count()) if tabs.isTabVisible(k)}


@pytest.mark.parametrize("group", GROUPS)
def test_a_group_shows_its_own_tabs_and_no_other(window, qtbot, group):
    qtbot.mouseClick(window.tabs.buttons.named[group], Qt.MouseButton.LeftButton)
    assert shown(window) == {entry.key for entry in REGISTRY if entry.group == group} - ELSEWHERE
    assert window.store.state.display.tab in shown(window)
    assert window.tabs.current() == window.store.state.display.tab


def test_alt_and_a_number_opens_a_group(window, qtbot):
    qtbot.waitUntil(window.isActiveWindow)
    QTest.keyClick(window, Qt.Key.Key_4, Qt.KeyboardModifier.AltModifier)
    own = {entry.key for entry in REGISTRY if entry.group == GROUPS[3]}
    qtbot.waitUntil(lambda: window.store.state.display.tab in own)  # a shortcut holds its button down for a moment


def test_a_group_remembers_its_panel(window, qtbot):
    window.open_panel("ray_fan")
    window.open_panel("seidel")
    qtbot.mouseClick(window.tabs.buttons.named["Rays"], Qt.MouseButton.LeftButton)
    assert window.store.state.display.tab == "ray_fan"


def test_the_menu_reaches_every_panel(window):
    for entry, action in zip(REGISTRY, [a for a in window.tabs.menu.actions() if not a.isSeparator()], strict=True):
        assert action.text() in {each.title for each in REGISTRY}, entry
    window.tabs.menu.actions()[-1].trigger()
    assert window.store.state.display.tab == window.tabs.current()


def test_the_tabs_of_each_group_fit_a_small_window(window):
    window.resize(1280, 800)
    window.store.update(rail_side="bottom", rail=(), stage="psf")
    QApplication.processEvents()
    assert window.tabs.buttons.named["PSF"].isVisible()
    room = window.tabs.width() - window.tabs.buttons.width()
    for group in GROUPS:
        window.tabs.open_group(group)
        bar = window.tabs.tabBar()
        assert sum(bar.tabSizeHint(k).width() for k in range(bar.count()) if bar.isTabVisible(k)) <= max(room, 1)
    window.resize(1440, 900)


def press(card, tip: str, qtbot) -> None:
    button = next(button for button in card.findChildren(QToolButton) if button.toolTip().startswith(tip))
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_its_button_gives_a_panel_its_own_window_and_closing_gives_it_back(window, qtbot):
    window.open_panel("mtf")
    press(window.panels["mtf"].widget, "Open this panel in its own window", qtbot)
    assert window.store.state.display.windows == ("mtf",)
    own = window.floating.open["mtf"]
    assert window.tabs.pages()["mtf"].note.isVisible()
    window.open_panel("profiles")
    before = window.panels["mtf"].curves["tangential"].data()[1].copy()
    window.store.update(field_deg=3.0)
    assert own.isVisible() and window.panels["mtf"].widget.window() is own
    assert (window.panels["mtf"].curves["tangential"].data()[1] != before).any(), "it goes on following the sliders"
    own.close()
    assert window.store.state.display.windows == () and not window.panels["mtf"].widget.isVisible(), "behind its tab"
    window.open_panel("mtf")
    assert window.panels["mtf"].widget.isVisible() and window.panels["mtf"].widget.window() is window
    window.store.undo()
    window.store.undo()
    assert "mtf" in window.floating.open, "an undone close opens it again"
    press(window.panels["mtf"].widget, "Open this panel in its own window", qtbot)
    assert not window.store.state.display.windows


def test_only_what_is_on_show_is_styled_and_the_rest_when_it_comes_up(window):
    """A switch of the theme works out every widget within the window: the panels behind their tabs wait outside."""
    window.open_panel("mtf")
    window.open_panel("profiles")
    styled = []
    for key in ("mtf", "profiles"):
        window.panels[key].restyle = lambda theme, key=key, own=window.panels[key].restyle: (
            styled.append(key),
            own(theme),
        )
    window.store.update(theme="dark")
    assert styled == ["profiles"] and not window.isAncestorOf(window.panels["mtf"].widget)
    window.open_panel("mtf")
    assert styled == ["profiles", "mtf"] and not window.isAncestorOf(window.panels["profiles"].widget)
    colours = {key: window.panels[key].widget.palette().windowText().color().name() for key in ("mtf", "psf")}
    assert len(set(colours.values())) == 1, "as the panel that was always there"
    for key in ("mtf", "profiles"):
        del window.panels[key].restyle


def test_keys_go_on_to_the_panel_that_comes_to_the_front_by_itself(window):
    """As undo and a lesson bring it; they went to the choice of the lens while panels waited outside."""
    for first, then in (("seidel", "profiles"), ("database", "lens")):
        window.open_panel(then)
        window.open_panel(first)
        window.panels[first].term.setFocus()
        window.store.undo()
        page = window.tabs.pages()[then]
        assert QApplication.focusWidget() is page or page.isAncestorOf(QApplication.focusWidget()), then


def test_a_panel_behind_its_tab_goes_with_its_window(qapp):
    made = MainWindow(new_state(method="seidel", theme="light", tab="mtf"), measured=False)
    made.open_panel("profiles")
    behind = made.panels["mtf"].widget
    made.close()
    made.deleteLater()
    for _ in range(2):  # the window, and then what has to go with it
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert not isValid(behind)


def test_a_key_puts_the_panel_into_its_own_window_and_back(window, qtbot):
    qtbot.waitUntil(window.isActiveWindow)
    window.panels["pupil"].widget.tools[0].setFocus()
    QTest.keyClick(window, Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    assert window.store.state.display.windows == ("pupil",)
    window.floating.toggle("pupil")
    assert window.store.state.display.windows == () and window.panels["pupil"].widget.window() is window


def test_windows_go_into_the_state_file_and_back():
    state = new_state(windows=("mtf", "spot"))
    assert state_from_json(state_to_json(state)) == state
    with pytest.raises(P2SFError, match="windows must be a list"):
        new_state(windows=(3,))


@pytest.mark.parametrize("key", ["layout", "pupil", "psf", "coefficients"])
def test_a_panel_of_stage_or_rail_leaves_its_place_and_comes_back_to_it(window, qtbot, key):
    card = window.panels[key].widget
    places = [window.room.stage, *window.room.satellites]
    home, grid = card.parentWidget(), [place.geometry() for place in places]
    card.apart_asked.emit()
    assert window.store.state.display.windows == (key,) and card.window() is window.floating.open[key]
    assert home in places and home.note.isVisible()
    window.store.update(field_deg=4.0)
    assert window.live.state.optics.field_deg == 4.0
    own = window.floating.open[key]
    own.activateWindow()
    qtbot.waitUntil(own.isActiveWindow)
    qtbot.keyClick(own, Qt.Key.Key_W, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: window.store.state.display.windows == ())
    assert card.window() is window and card.isVisible() and card.parentWidget() is home and not home.note.isVisible()
    assert [place.geometry() for place in places] == grid


def test_a_tab_dragged_off_the_bar_has_its_own_window(window):
    bar = window.tabs.tabBar()
    place = next(k for k in range(window.tabs.count()) if window.tabs.widget(k).objectName() == "mtf")
    start = bar.tabRect(place).center()
    QTest.mousePress(bar, Qt.MouseButton.LeftButton, pos=start)
    assert window.store.state.display.tab == "mtf"
    for down in (20, 60, 90):  # the first is still on the bar, the last one drag
        move = QMouseEvent(
            QEvent.Type.MouseMove,
            QPointF(start) + QPointF(0, down),
            bar.mapToGlobal(QPointF(start)),
            Qt.MouseButton.NoButton,
            Qt.MouseButton.LeftButton,
            Qt.KeyboardModifier.NoModifier,
        )
        QApplication.sendEvent(bar, move)
        assert window.store.state.display.windows == (() if down == 20 else ("mtf",))
    QTest.mouseRelease(bar, Qt.MouseButton.LeftButton, pos=start)
    window.floating.open["mtf"].close()


def test_own_windows_stand_where_they_stood_when_opened_again_and_at_the_next_start(window, monkeypatch, tmp_path):
    monkeypatch.setattr("p2sf_explorer.files.recent.recent_path", lambda: tmp_path / "recent.json")
    window.store.update(windows=("mtf",))
    window.floating.open["mtf"].resize(433, 377)
    window.store.update(windows=())
    window.store.update(windows=("mtf",))
    assert window.floating.open["mtf"].size() == QSize(433, 377)
    keeping = SessionKeeper(window, window.store, lambda: window.floating.open, {})
    keeping.keep()
    window.floating.open["mtf"].resize(800, 600)
    state, geometry = last_session()
    assert state.display.windows == ("mtf",)
    again = SessionKeeper(window, window.store, lambda: window.floating.open, geometry)
    assert window.floating.open["mtf"].size() == QSize(433, 377)
    for keeper in (keeping, again):
        window.removeEventFilter(keeper)
        keeper.stop()  # or its thread would write what the next test changes


SCREENS = {"wide": QRect(0, 0, 3840, 2160), "laptop": QRect(0, 25, 1440, 860), "small": QRect(0, 0, 800, 600)}


@pytest.mark.parametrize("screen", SCREENS)
@pytest.mark.parametrize("left", [0, 1500, 2500])
def test_a_panel_pops_out_onto_the_screen_and_clear_of_the_controls(screen, left):
    room = SCREENS[screen]
    window = QRect(left, room.top(), 1280, 800)
    controls = QRect(window.left() + 8, window.top() + 60, 292, 700)
    place = beside(QSize(820, 620), window, controls, room)
    assert room.contains(place) and not place.intersects(controls)
    if room.width() == 3840:
        assert place.size() == QSize(820, 620) and not place.intersects(window), "there is room beside the window"


def test_the_window_of_a_panel_opens_clear_of_the_controls(window):
    window.floating.places.pop("mtf", None)
    window.store.update(windows=("mtf",))
    own = window.floating.open["mtf"]
    controls = QRect(window.controls.mapToGlobal(QPoint()), window.controls.size())
    assert not own.geometry().intersects(controls)


@pytest.mark.parametrize("entry", [e for e in REGISTRY if e.key not in ("solid", "image", "measured", "database")])
def test_a_panel_has_one_name(window, entry):
    """Its card is called as its tab, its entry in the menu, and its heading in the handbook."""
    made = window.panels.get(entry.key) or build(entry, window.store)
    assert made.widget.accessibleName() == entry.title
    if entry.key not in window.panels:
        end_work(made)
        made.widget.deleteLater()


def test_the_best_focus_is_where_the_six_coefficients_leave_least_variance():
    """For a singlet at a small aperture third order is all there is: autofocus by exact rays finds the same place."""
    state = change(default_state("singlet_f6"), field_deg=0.0, f_number=16.0, sensor_shift_um=300.0)
    found = best_focus_um(paraxial_setup(state).coefficients)
    assert found == pytest.approx(abs(best_shift_um(state) - 300.0), rel=5e-3)
