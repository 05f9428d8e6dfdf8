"""The start screen: the ways to begin, skipped or taken, and never shown twice."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from p2sf_explorer.files import recent
from p2sf_explorer.window.lens_cards import FILTERS, lens_tags
from p2sf_explorer.window.start_screen import WAYS, first_start


@pytest.fixture
def screen(window):
    made = window.show_start()
    yield made
    QApplication.processEvents()


def test_it_comes_at_the_first_start_only(tmp_path, monkeypatch):
    monkeypatch.setattr(recent, "recent_path", lambda: tmp_path / "p2sf" / "recent.json")
    assert first_start() and not first_start()


def test_who_was_offered_a_lesson_before_does_not_see_it(tmp_path, monkeypatch):
    monkeypatch.setattr(recent, "recent_path", lambda: tmp_path / "recent.json")
    (tmp_path / "lesson_offered").touch()
    assert not first_start()


def test_it_stands_in_the_window_and_escape_skips_it(window, qtbot, screen):
    assert len(screen.buttons) == len(WAYS)
    assert window.rect().contains(screen.geometry()) and screen.isVisible()
    before = window.store.state
    qtbot.keyClick(screen, Qt.Key.Key_Escape)
    assert not screen.isVisible() and window.store.state == before


def test_measuring_a_photo_puts_its_panel_on_the_stage(window, qtbot, screen):
    qtbot.mouseClick(screen.buttons[4], Qt.MouseButton.LeftButton)
    assert window.store.state.display.stage == "measured" and not screen.isVisible()


def test_teaching_opens_the_lessons(window, qtbot, screen):
    qtbot.mouseClick(screen.buttons[2], Qt.MouseButton.LeftButton)
    assert window.teaching.list.isVisible()
    window.teaching.list.hide()


def test_looking_at_a_lens_opens_the_gallery_whose_filters_hide_the_others(window, qtbot, screen):
    qtbot.mouseClick(screen.buttons[0], Qt.MouseButton.LeftButton)
    gallery = window.top.lens.gallery
    assert gallery.isVisible() and set(gallery.filters) == set(FILTERS)
    gallery.filters["mirror"].click()
    model = gallery.list.model()
    names = [model.index(row, 0).data(Qt.ItemDataRole.UserRole) for row in range(model.rowCount())]
    shown = {name for row, name in enumerate(names) if not gallery.list.isRowHidden(row)}
    assert shown == {"cassegrain_f10", "hubble", "maksutov", "schmidt_camera"}
    gallery.filters["mirror"].click()
    assert not any(gallery.list.isRowHidden(row) for row in range(model.rowCount()))
    gallery.hide()


@pytest.mark.parametrize(
    ("name", "tag"), [("zoom_3x", "zoom"), ("telephoto", "telephoto"), ("phone_f28", "phone"), ("eye_navarro", "coma")]
)
def test_tags_say_what_a_lens_is(name, tag):
    assert tag in lens_tags(name)
    assert tag not in lens_tags("periskop")  # symmetric about its stop, without coma
