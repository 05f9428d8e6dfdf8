"""Groups of tabs, and panels in windows of their own, by mouse and keyboard."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.panels import GROUPS, REGISTRY
from app.state import State, state_from_json, state_to_json
from p2sf.errors import P2SFError

TABS = [entry for entry in REGISTRY if entry.place != "main"]


def shown(window) -> set[str]:
    """Return the panels whose tab can be clicked."""
    tabs = window.tabs
    return {tabs.widget(k).objectName() for k in range(tabs.count()) if tabs.isTabVisible(k)}


@pytest.mark.parametrize("group", GROUPS)
def test_a_group_shows_its_own_tabs_and_no_other(window, qtbot, group):
    qtbot.mouseClick(window.tabs.buttons.named[group], Qt.MouseButton.LeftButton)
    assert shown(window) == {entry.key for entry in TABS if entry.group == group}
    assert window.store.state.tab in shown(window)
    assert window.tabs.current() == window.store.state.tab


def test_alt_and_a_number_opens_a_group(window, qtbot):
    qtbot.waitUntil(window.isActiveWindow)
    QTest.keyClick(window, Qt.Key.Key_4, Qt.KeyboardModifier.AltModifier)
    own = {entry.key for entry in TABS if entry.group == GROUPS[3]}
    qtbot.waitUntil(lambda: window.store.state.tab in own)  # a shortcut holds its button down for a moment


def test_a_group_remembers_its_panel(window, qtbot):
    window.open_panel("ray_fan")
    window.open_panel("seidel")
    qtbot.mouseClick(window.tabs.buttons.named["Rays"], Qt.MouseButton.LeftButton)
    assert window.store.state.tab == "ray_fan"


def test_the_menu_reaches_every_panel(window):
    for entry, action in zip(TABS, [a for a in window.tabs.menu.actions() if not a.isSeparator()], strict=True):
        assert action.text() in {each.title for each in TABS}, entry
    window.tabs.menu.actions()[-1].trigger()
    assert window.store.state.tab == window.tabs.current()


def test_the_tabs_of_each_group_fit_a_small_window(window):
    window.resize(1280, 800)
    room = window.tabs.width() - window.tabs.buttons.width() - window.tabs.cornerWidget().width()
    for group in GROUPS:
        window.tabs.open_group(group)
        bar = window.tabs.tabBar()
        assert sum(bar.tabSizeHint(k).width() for k in range(bar.count()) if bar.isTabVisible(k)) <= max(room, 1)
    window.resize(1440, 900)


def test_a_double_click_gives_a_tab_its_own_window_and_closing_gives_it_back(window, qtbot):
    bar = window.tabs.tabBar()
    place = next(k for k in range(window.tabs.count()) if window.tabs.widget(k).objectName() == "mtf")
    bar.tabBarDoubleClicked.emit(place)  # QTest's double click on a tab does not reach it offscreen
    assert window.store.state.windows == ("mtf",)
    own = window.floating.open["mtf"]
    window.open_panel("profiles")
    before = window.panels["mtf"].curves["tangential"].data()[1].copy()
    window.store.update(field_deg=3.0)
    assert own.isVisible() and window.panels["mtf"].widget.window() is own
    assert (window.panels["mtf"].curves["tangential"].data()[1] != before).any(), "it goes on following the sliders"
    own.close()
    assert window.store.state.windows == () and window.panels["mtf"].widget.window() is window
    window.store.undo()
    assert "mtf" in window.floating.open, "an undone close opens it again"


def test_a_key_puts_the_panel_into_its_own_window_and_back(window, qtbot):
    qtbot.waitUntil(window.isActiveWindow)
    QTest.keyClick(window, Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    assert window.store.state.windows == ("profiles",)
    window.floating.toggle("profiles")
    assert window.store.state.windows == () and window.panels["profiles"].widget.window() is window


def test_a_tab_behind_is_not_computed(window):
    window.open_panel("seidel")
    assert set(window.live.views) == {"seidel"}


def test_windows_go_into_the_state_file_and_back():
    state = State(windows=("mtf", "spot"))
    assert state_from_json(state_to_json(state)) == state
    with pytest.raises(P2SFError, match="windows must be a list"):
        State(windows=(3,))
