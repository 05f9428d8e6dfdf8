"""Lessons in the window: begun, gone through, answered and left by keyboard and mouse; the first start's offer."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QLabel

from p2sf_explorer.charts.theme import LIGHT, SPACE
from p2sf_explorer.lessons.controller import NOTHING_BEFORE, SLIDER_SHARE, LessonController
from p2sf_explorer.lessons.lesson import shipped_lessons
from p2sf_explorer.lessons.lesson_panel import rich
from p2sf_explorer.state.state import change
from tests.support.windows.events import choose

FIRST, SECOND = shipped_lessons()[:2]
ALT = Qt.KeyboardModifier.AltModifier


@pytest.fixture
def teaching(window):
    yield window.teaching
    if window.store.state.lesson.name:
        window.teaching.leave()


@pytest.fixture
def panel(teaching, qtbot, window):
    qtbot.keyClick(window, Qt.Key.Key_F3)
    return teaching.panel


def said(text: str) -> str:
    return text.split(".")[0]


def shown(label: QLabel) -> str:
    return label.text() if label.isVisible() else ""


def test_f2_begins_the_first_lesson_and_ends_it_as_it_was(window, qtbot, teaching):
    window.store.update(field_deg=3.5, wavelength_nm=486.0, tab="mtf")
    before = window.store.state
    qtbot.keyClick(window, Qt.Key.Key_F3)
    assert window.store.state == FIRST.state(0, before)
    assert teaching.panel.isVisible() and shown(teaching.panel.title) == FIRST.steps[0].title
    window.store.update(field_deg=1.0)
    qtbot.keyClick(window, Qt.Key.Key_F3)
    assert window.store.state == before and not teaching.panel.isVisible()


def test_leaving_once_more_after_undo_still_puts_back_what_was_before(window, qtbot, teaching):
    window.store.update(field_deg=3.5, wavelength_nm=486.0)
    before = window.store.state
    teaching.toggle()
    window.teaching.move(1)
    teaching.leave()
    window.store.undo()
    assert window.store.state.lesson.name == FIRST.name
    teaching.leave()
    assert window.store.state == before


def test_where_nothing_was_before_the_lesson_stays_and_says_so(window, teaching):
    teaching.toggle()
    kept, window.store._states, window.store._at = window.store.state, [window.store.state], 0
    told = []
    window.store.said.connect(told.append)
    teaching.leave()
    window.store.said.disconnect(told.append)
    assert window.store.state == change(kept, lesson_name="") and told == [NOTHING_BEFORE]


def test_next_and_back_set_the_window_and_keys_do_the_same(window, qtbot, panel):
    qtbot.mouseClick(panel.next, Qt.MouseButton.LeftButton)
    assert window.store.state == FIRST.state(1, window.store.state) and window.live.state.optics.field_deg == 10
    assert shown(panel.count) == f"step 2 of {len(FIRST.steps)}"
    window.store.update(field_deg=12.0)
    qtbot.keyClick(window, Qt.Key.Key_Right, ALT)
    qtbot.keyClick(window, Qt.Key.Key_Left, ALT)
    assert window.store.state.optics.field_deg == 10  # a step is what its file says, whatever was dragged before
    qtbot.mouseClick(panel.back, Qt.MouseButton.LeftButton)
    assert window.store.state.lesson.step == 0 and not panel.back.isEnabled()
    window.teaching.move(-1)
    assert window.store.state.lesson.step == 0


def test_the_answer_is_hidden_until_asked_for(window, qtbot, panel):
    qtbot.keyClick(window, Qt.Key.Key_Right, ALT)
    assert shown(panel.question) == FIRST.steps[1].question and shown(panel.answer) == ""
    qtbot.mouseClick(panel.reveal, Qt.MouseButton.LeftButton)
    assert said(FIRST.steps[1].answer) in shown(panel.answer) and not panel.reveal.isVisible()
    qtbot.keyClick(window, Qt.Key.Key_Right, ALT)
    assert shown(panel.answer) == ""
    window.store.undo()
    assert said(FIRST.steps[1].answer) in shown(panel.answer)  # undo goes through lessons as through all else


@pytest.mark.slow
@pytest.mark.parametrize("lesson", shipped_lessons()[:6], ids=lambda lesson: lesson.name)
def test_an_answer_that_is_shown_can_be_read(window, qtbot, teaching, lesson):
    """In a window of 1280 × 800 it began below the lower edge of its area."""
    window.resize(1280, 800)
    teaching.begin(lesson.name)
    for number, step in enumerate(lesson.steps):
        QApplication.processEvents()
        panel, area = teaching.panel, teaching.panel.area
        if step.question:
            assert window.store.state.lesson.step == number
            qtbot.mouseClick(panel.reveal, Qt.MouseButton.LeftButton)
            QApplication.processEvents()
            top, low = (area.verticalScrollBar().value() + at for at in (0, area.viewport().height()))
            room = panel.answer.geometry()
            assert low >= room.bottom() + 1 or top >= panel.question.y() - 1, (
                "all of it, or as much as there is room for"
            )
            assert top <= room.top() < low
        teaching.move(1)


def test_the_slider_of_the_step_is_pointed_to(window, qtbot, panel):
    rows = window.controls.rows
    assert not any(row.property("pointed") for row in rows.values())
    qtbot.keyClick(window, Qt.Key.Key_Right, ALT)
    assert [key for key, row in rows.items() if row.property("pointed")] == ["field_deg"]
    window.teaching.leave()
    assert not any(row.property("pointed") for row in rows.values())


def test_after_the_last_step_comes_the_next_lesson_and_the_list_leads_to_any(window, qtbot, panel, teaching):
    for _ in FIRST.steps:
        teaching.move(1)
    assert window.store.state.lesson.name == SECOND.name and window.store.state.optics.lens == SECOND.lens
    last = shipped_lessons()[-1]
    choose(panel.choice, last.name)
    panel.choice.setFocus()
    qtbot.keyClick(panel.choice, "2")
    assert window.store.state.lesson.name == last.name, "digits put panels on the stage, here as everywhere"
    before = window.store.latest(lambda state: not state.lesson.name)
    for _ in last.steps:
        teaching.move(1)
    assert window.store.state == before


@pytest.mark.slow
@pytest.mark.parametrize("lesson", shipped_lessons(), ids=lambda lesson: lesson.name)
def test_every_step_of_every_lesson_is_painted(window, teaching, lesson):
    teaching.begin(lesson.name)
    for number, step in enumerate(lesson.steps):
        assert window.live.state == lesson.state(number, window.store.state)
        assert not window.banner.isVisible()
        assert shown(teaching.panel.title) == step.title
        assert window.tabs.current() == window.store.state.display.tab
        teaching.move(1)


def test_paragraphs_stand_apart_and_emphasis_is_seen(qapp):
    made = rich("One *two*.\n\nThree **four**.")
    assert made.count("<p ") == 2 and "margin-top:8px" in made and "font-weight:700" in made and "*" not in made


def test_a_state_that_names_an_unknown_lesson_opens_without_one(window, teaching):
    window.store.update(lesson_name="99_gone", lesson_step=5)
    assert teaching.panel is None or not teaching.panel.isVisible()
    teaching.move(1)
    window.store.update(lesson_name=FIRST.name, lesson_step=50)
    assert shown(teaching.panel.title) == FIRST.steps[-1].title


def test_a_bad_lesson_is_one_sentence_in_the_banner_and_the_others_stay(window, qtbot, monkeypatch, tmp_path):
    (tmp_path / "99_bad.md").write_text("no lesson", encoding="utf-8")
    monkeypatch.setattr("p2sf_explorer.lessons.lesson.own_folder", lambda: tmp_path)
    made = LessonController(window.store, window, window.lesson_room, lambda: LIGHT)
    assert len(made.lessons()) == len(shipped_lessons())
    qtbot.waitUntil(lambda: "99_bad.md, line 1" in window.banner.text.text())
    window.store.changed.disconnect(made.follow)
    window.banner.hide()


def test_the_bar_has_a_part_for_each_step_and_is_filled_up_to_the_present_one(window, panel):
    count = len(FIRST.steps)
    assert (panel.progress.number, panel.progress.count) == (0, count)
    window.teaching.move(1)
    assert (panel.progress.number, panel.progress.count) == (1, count)
    picture = panel.progress.grab().toImage()
    middles = [round((k + 0.5) * picture.width() / count) for k in range(count)]
    colours = [picture.pixelColor(x, picture.height() // 2).name() for x in middles]
    assert len(set(colours[:2])) == 1 and len(set(colours[2:])) == 1 and colours[0] != colours[-1]


@pytest.mark.parametrize(
    ("before", "percent", "size"),
    [(300.0, 100.0, (1280, 800)), (300.0, 100.0, (1920, 1080)), (200.0, 200.0, (3840, 2160))],
)
def test_a_lesson_leaves_the_sliders_the_height_that_its_page_does_not_need(window, qtbot, before, percent, size):
    window.resize(*size)
    for scale, unfolded in ((before, True), (percent, False)):  # rows that were shown and are hidden count no more
        window.store.update(scale_percent=scale, show_pupil_shape=unfolded, show_field_x=unfolded)
        QApplication.processEvents()
    window.teaching.toggle()
    rows, line = window.controls.rows.values(), window.teaching.panel.fontMetrics().lineSpacing()

    def shared():
        page, sliders = window.left_parts.sizes()
        needed = max(row.geometry().bottom() for row in rows if row.isVisible())
        assert (needed <= sliders) == (size[1] > 800), "a small window has no room for all"
        if percent == 100:
            assert sliders <= max(needed + 2 * SPACE, SLIDER_SHARE * (page + sliders) + 1), "and none keeps more"
        assert page >= 0.55 * (page + sliders) if size[1] == 800 else page >= 29 * line

    qtbot.waitUntil(shared)
    window.teaching.leave()
