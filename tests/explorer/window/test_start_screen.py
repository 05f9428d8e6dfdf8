"""The first start: a picture that moves once, doors beside it, gone at the first touch."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QImage, QPainter, QWheelEvent, qGray
from PySide6.QtWidgets import QApplication

import p2sf_explorer.handbook
from p2sf_explorer.charts.theme import LIGHT
from p2sf_explorer.compute.setup import FIRST_LENS, first_state, title, with_lens
from p2sf_explorer.files import recent
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import unbroken
from p2sf_explorer.site.handbook_pictures import WINDOWS
from p2sf_explorer.site.pictures import FIRST
from p2sf_explorer.state.state import change
from p2sf_explorer.window import reduced_motion
from p2sf_explorer.window.commands.actions import BEGIN
from p2sf_explorer.window.lens_cards import FILTERS, lens_tags
from p2sf_explorer.window.start_screen import DOORS, first_start, paint_lessons

PAGES = Path(p2sf_explorer.handbook.__file__).parent


@pytest.fixture
def screen(window):
    window.store.replace(change(window.store.state, field_deg=14.0))
    made = window.show_start()
    yield made
    if window._start:
        window._start.leave()
    QApplication.processEvents()


def test_it_comes_at_the_first_start_only(tmp_path, monkeypatch):
    monkeypatch.setattr(recent, "recent_path", lambda: tmp_path / "p2sf" / "recent.json")
    assert first_start() and not first_start()


def test_who_was_offered_a_lesson_before_does_not_see_it(tmp_path, monkeypatch):
    monkeypatch.setattr(recent, "recent_path", lambda: tmp_path / "recent.json")
    (tmp_path / "lesson_offered").touch()
    assert not first_start()


def test_the_doors_stand_beside_the_picture_and_escape_leaves_no_trace(window, qtbot, screen):
    assert len(screen.doors) == len(DOORS) and screen.isVisible() and window.foot.sentence.text().startswith("One star")
    doors, stage = (part.mapToGlobal(part.rect().topLeft()).x() for part in (screen, window.room.stage))
    assert doors >= stage + window.room.stage.width()
    before = window.store.state
    qtbot.keyClick(window, Qt.Key.Key_Escape)
    assert not screen.isVisible() and window.store.state == before
    assert window.foot.sentence.text() == unbroken(said(window.live.dominant))


def test_the_sentence_names_no_angle_that_the_moving_field_contradicts(window, screen):
    assert re.findall(r"\d+", window.foot.sentence.text()) == ["0"], "only where the star is round"


@pytest.mark.parametrize("high", [90, 600])
def test_the_stars_of_the_lessons_fill_the_height_of_their_door_on_every_screen(qapp, high):
    picture = QImage(3 * high, high, QImage.Format.Format_RGB32)
    painter = QPainter(picture)
    paint_lessons(painter, QRectF(picture.rect()), LIGHT)
    painter.end()
    rows = [y for y in range(high) if any(qGray(picture.pixel(x, y)) > 2 for x in range(0, 3 * high, 3))]
    assert rows[-1] - rows[0] > 0.5 * high


def test_the_field_goes_to_the_axis_and_back_and_leaves_no_step_of_undo(window, qtbot, screen):
    before, steps, half = window.store.state, len(window.store.history), window.panels["psf"].half_um
    screen.motion.start()
    screen.motion.setCurrentTime(screen.motion.duration() // 2)
    assert window.store.state.optics.field_deg == 0 and window.store.moving
    low, high = window.panels["psf"].map.chart.y_axis.home
    assert (low, high) == (-half, half), "the scale is that of the first picture"
    screen.motion.setCurrentTime(screen.motion.duration())
    assert window.store.state == before and len(window.store.history) == steps and not window.store.moving


@pytest.mark.parametrize("touch", ["press", "key", "wheel", "shortcut"])
def test_the_first_touch_ends_it_where_the_slider_is(window, qtbot, screen, touch):
    start = window.store.state.optics.field_deg
    screen.motion.start()
    screen.motion.setCurrentTime(screen.motion.duration() // 4)
    slider = window.controls.rows["f_number"].slider
    if touch == "press":
        qtbot.mouseClick(window.panels["psf"].map.chart, Qt.MouseButton.LeftButton)
    elif touch == "key":
        qtbot.keyClick(slider, Qt.Key.Key_Right)
    elif touch == "wheel":
        wheel_event(window.top)
    else:
        qtbot.keyClick(window, Qt.Key.Key_F9)
    assert not screen.isVisible() and not window.store.moving
    assert 0 < window.store.state.optics.field_deg < start and not window.store.state.display.held_scales


def wheel_event(widget) -> None:
    """Turn the wheel over a widget by one notch."""
    middle = QPointF(widget.rect().center())
    turned, buttons = QPoint(0, 120), Qt.MouseButton.NoButton
    phase, none = Qt.ScrollPhase.NoScrollPhase, Qt.KeyboardModifier.NoModifier
    place = QPointF(widget.mapToGlobal(widget.rect().center()))
    QApplication.sendEvent(widget, QWheelEvent(middle, place, QPoint(), turned, buttons, none, phase, False))


def test_who_wants_less_motion_gets_none(window, qtbot, monkeypatch):
    monkeypatch.setattr(reduced_motion, "reduced_motion", lambda: True)
    screen = window.show_start()
    assert not screen._wait.receivers("2timeout()")
    screen.leave()


@pytest.mark.parametrize(("printed", "reduced"), [("false\n", True), ("true\n", False), ("", False)])
def test_the_system_says_whether_motion_is_welcome(monkeypatch, printed, reduced):
    monkeypatch.setattr(reduced_motion.sys, "platform", "linux")
    done = subprocess.CompletedProcess((), 0, printed)
    monkeypatch.setattr(reduced_motion.subprocess, "run", lambda *_, **__: done)
    assert reduced_motion.reduced_motion() == reduced


def test_a_system_without_the_setting_moves(monkeypatch):
    monkeypatch.setattr(reduced_motion, "ASKED", {sys.platform: (("no-such-program",), "")})
    assert not reduced_motion.reduced_motion()


def test_a_photo_leads_to_the_image(window, qtbot, screen):
    qtbot.mouseClick(screen.doors[1], Qt.MouseButton.LeftButton)
    assert window.store.state.display.stage == "image" and not screen.isVisible()


def test_learning_opens_the_lessons_by_key(window, qtbot, screen):
    qtbot.keyClick(screen.doors[0], Qt.Key.Key_Space)
    assert window.teaching.list.isVisible() and not screen.isVisible()
    window.teaching.list.hide()


def test_it_comes_back_from_the_menu_with_the_first_lens_and_undo_leads_away(window, qtbot):
    window.store.replace(change(with_lens(window.store.state, "petzval"), stage="matrix"))
    before = window.store.state
    [again] = [action for action in window.top.more.menu().actions() if action.text() == BEGIN]
    again.trigger()
    screen = window._start
    assert screen.isVisible() and window.store.state.optics == first_state().optics
    assert window.store.state.display.stage == "psf" and window.store.state.display.theme == before.display.theme
    screen.leave()
    window.store.undo()
    assert window.store.state == before


def test_one_lens_is_that_of_the_first_start_the_tutorial_and_the_picture_of_the_readme():
    assert first_state().optics.lens == FIRST.optics.lens == WINDOWS["window.png"].optics.lens == FIRST_LENS
    name = title(FIRST_LENS).split(",")[0]
    assert f"This lens is a {name}" in (PAGES / "tutorial.md").read_text()


def test_a_gallery_s_filters_hide_the_others(window, qtbot):
    window.top.lens.open_gallery()
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
