"""Workspaces: chosen, left and found again, saved under a name of one's own, after a restart, from a link or a file."""

import json

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QInputDialog

from p2sf_explorer.files import recent
from p2sf_explorer.files.opening import open_file
from p2sf_explorer.files.session import last_session
from p2sf_explorer.files.session_keeper import SessionKeeper
from p2sf_explorer.files.snapshot import write_state
from p2sf_explorer.files.workspaces import kept_workspaces, workspaces_path
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.workspaces import WORKSPACES, Workspace, arrangement, with_workspace
from p2sf_explorer.window.window import MainWindow
from tests.explorer.conftest import FIRST
from tests.explorer.window.test_stage import where


@pytest.fixture
def bar(window, monkeypatch, tmp_path):
    """Return the bar of the window with no memory of other workspaces."""
    monkeypatch.setattr(recent, "recent_path", lambda: tmp_path / "recent.json")
    window.workspaces._left = {}
    window.workspaces.changed.emit()
    yield window.top.workspaces
    window.workspaces._left = {}
    window.workspaces.changed.emit()
    if window.store.state.lesson.name:
        window.teaching.leave()


def press(bar, name: str, qtbot) -> None:
    qtbot.mouseClick(bar.buttons[name], Qt.MouseButton.LeftButton)


@pytest.mark.parametrize("name", [name for name in WORKSPACES if name not in ("teach", "explore")])
def test_a_button_arranges_the_window(window, bar, qtbot, name):
    press(bar, name, qtbot)
    wanted = WORKSPACES[name]
    assert where(window) == (wanted.stage, *wanted.rail, wanted.tab)
    assert arrangement(window.store.state.display) == wanted
    assert [key for key, button in bar.buttons.items() if button.isChecked()] == [name]
    window.store.undo()
    assert arrangement(window.store.state.display) == arrangement(FIRST.display) and bar.buttons["explore"].isChecked()


def test_a_workspace_is_found_as_it_was_left_and_again_as_it_comes(window, bar, qtbot):
    press(bar, "lens", qtbot)
    window.take_stage("spot")
    left = arrangement(window.store.state.display)
    press(bar, "inspect", qtbot)
    press(bar, "lens", qtbot)
    assert arrangement(window.store.state.display) == left
    assert kept_workspaces()["lens"] == left, "also at the next start"
    press(bar, "lens", qtbot)
    assert arrangement(window.store.state.display) == WORKSPACES["lens"]


def test_teach_begins_a_lesson_and_comes_back_to_its_step(window, bar, qtbot):
    press(bar, "teach", qtbot)
    lesson = window.store.state
    assert lesson.lesson.name.startswith("01") and where(window) == ("psf",)
    assert not window.room.rail.isVisible() and bar.buttons["teach"].isChecked()
    press(bar, "lens", qtbot)
    assert window.teaching.panel.isVisible() and window.store.state.display.stage == "layout"
    press(bar, "teach", qtbot)
    assert window.store.state == lesson


def test_the_keys_choose_workspaces(window, bar, qtbot):
    qtbot.keyClick(window, Qt.Key.Key_3, Qt.KeyboardModifier.ControlModifier)
    assert window.store.state.display.workspace == "lens"
    qtbot.keyClick(window, Qt.Key.Key_1, Qt.KeyboardModifier.ControlModifier)
    assert window.store.state.display.workspace == "explore"


def test_ones_own_is_saved_found_and_deleted(window, bar, qtbot, monkeypatch):
    window.take_stage("mtf")
    monkeypatch.setattr(QInputDialog, "getText", lambda *_: ("  In  the hall ", True))
    window.workspaces.ask_save()
    assert window.store.state.display.workspace == "In the hall" and bar.buttons["In the hall"].isChecked()
    mine = arrangement(window.store.state.display)
    press(bar, "explore", qtbot)
    press(bar, "In the hall", qtbot)
    assert arrangement(window.store.state.display) == mine and kept_workspaces()["In the hall"] == mine
    window.workspaces.delete()
    assert "In the hall" not in bar.buttons and "In the hall" not in kept_workspaces()
    assert where(window)[0] == "mtf", "the window stays as it is"
    monkeypatch.setattr(QInputDialog, "getText", lambda *_: ("never", False))
    window.workspaces.ask_save()
    window.workspaces.save("  ")
    window.workspaces.save("lens")
    assert not window.workspaces.own()


@pytest.mark.slow
@pytest.mark.parametrize("name", [*WORKSPACES, "mine"])
def test_each_survives_restart_link_and_snapshot(window, bar, tmp_path, name):
    own = Workspace("spot", ("mtf", "layout"), "seidel", 0.63, (0.2, 0.5, 0.3), "bottom", show_controls=False)
    state = with_workspace(change(window.store.state, field_deg=4.0), name, WORKSPACES.get(name, own))
    window.store.replace(state)
    keeper = SessionKeeper(window, window.store, lambda: window.floating.open, {})
    keeper.keep()
    keeper.stop()  # or its thread would write what the next test changes
    window.removeEventFilter(keeper)
    again = MainWindow(last_session()[0], measured=False)
    try:
        again.resize(window.size())
        again.show()
        assert again.store.state == state and where(again) == where(window)
        assert again.workspaces.own() == (("mine",) if name == "mine" else ())
    finally:
        again.close()
        again.deleteLater()
    assert state_of_link(link(state)) == state
    write_state(state, tmp_path / "state.json")
    assert open_file(State(), str(tmp_path / "state.json")) == state


def test_a_link_brings_a_workspace_of_its_own_name(window, bar):
    theirs = with_workspace(FIRST, "Optics 101", Workspace("pupil", ("psf",), "spot", 0.7))
    window.sharing.open(link(theirs))
    assert "Optics 101" in bar.buttons and kept_workspaces()["Optics 101"].stage == "pupil"


@pytest.mark.parametrize("text", ["", "[]", "{", '{"a": 3, "b": {"stage": 3}, "c": {"stage": "psf"}}'])
def test_a_damaged_file_costs_only_the_memory(window, bar, text):
    workspaces_path().write_text(text)
    assert kept_workspaces() == {}


def test_of_a_damaged_list_the_sound_ones_stay(window, bar):
    sound = {"stage": "psf", "rail": ["mtf"], "tab": "spot", "stage_share": 0.5, "rail_shares": [0.4, 0.6]}
    workspaces_path().write_text(json.dumps({"mine": sound, "bad": {**sound, "rail_side": "left"}}))
    assert kept_workspaces() == {"mine": Workspace("psf", ("mtf",), "spot", 0.5, (0.4, 0.6))}


@pytest.mark.parametrize(("width", "buttons"), [(1440, True), (1280, True), (960, False), (800, False)])
def test_the_bar_never_needs_more_room_than_there_is(window, bar, width, buttons):
    window.resize(width, 700)
    QApplication.processEvents()
    try:
        assert window.width() == width, "nothing else insists on more"
        assert bar.buttons["teach"].isVisible() == buttons and bar.menu.isVisible()
        for part in (window.top.lens, bar.menu, window.top.more):
            assert window.top.rect().contains(part.geometry() if part is not bar.menu else bar.geometry())
    finally:
        window.resize(1440, 900)
        QApplication.processEvents()
