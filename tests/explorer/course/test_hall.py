"""In the hall: a remote's keys lead from picture to question, answer and next step; black screen, countdown, notes."""

import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtWidgets import QApplication

from p2sf_explorer.lessons.hall_card import SECONDS, options_of
from tests.explorer.course.test_tasks import LESSON, STEP

NAME = "lecture_1"


@pytest.fixture
def hall(window, teaching, monkeypatch):
    """Return the hall while a lecture is presented, in a window that keeps its size."""
    monkeypatch.setattr(window, "showFullScreen", lambda: None)
    teaching._go(NAME, STEP["choice"])
    window.presentation.start()
    yield window.hall
    window.presentation.stop()


def press(qtbot, window, *keys) -> None:
    for key in keys:
        qtbot.keyClick(window, key)
    QApplication.processEvents()


def test_page_down_shows_question_answer_and_next_step(window, qtbot, hall, teaching):
    place = window.store.state.lesson
    press(qtbot, window, Qt.Key.Key_PageDown)
    assert hall.card.isVisible() and not hall.card.told and hall.card.countdown.left == SECONDS
    assert hall.card.question.text() == LESSON.steps[STEP["choice"]].question
    press(qtbot, window, Qt.Key.Key_PageDown)
    assert hall.card.told and LESSON.steps[STEP["choice"]].answer in hall.card.body.text()
    assert window.store.state.optics.field_deg == 2.0, "what was to be predicted is seen"
    assert window.store.state.lesson == place
    press(qtbot, window, Qt.Key.Key_PageDown)
    assert window.store.state.lesson.step == place.step + 1 and not hall.card.isVisible()
    press(qtbot, window, Qt.Key.Key_PageUp)
    assert window.store.state.lesson.step == place.step


def test_the_answer_is_seen_at_the_state_of_the_step_and_undo_brings_the_sliders_back(window, qtbot, hall, teaching):
    window.store.update(f_number=9.0)
    press(qtbot, window, Qt.Key.Key_PageDown, Qt.Key.Key_PageDown)
    step = teaching.shelf(NAME)[NAME].state(STEP["choice"])
    assert (window.store.state.optics.field_deg, window.store.state.optics.f_number) == (2.0, step.optics.f_number)
    window.store.undo()
    assert window.store.state.optics.f_number == 9.0


def test_page_up_puts_the_question_away_first(window, qtbot, hall):
    place = window.store.state.lesson
    press(qtbot, window, Qt.Key.Key_PageDown, Qt.Key.Key_PageUp)
    assert not hall.card.isVisible() and window.store.state.lesson == place


def test_nothing_that_is_shown_in_the_hall_is_noted_as_a_students_answer(window, qtbot, hall, teaching):
    press(qtbot, window, Qt.Key.Key_PageDown, Qt.Key.Key_PageDown)
    assert not teaching.desk.result().tasks


def test_the_screen_is_black_and_comes_back_where_it_was(window, qtbot, hall):
    place = window.store.state.lesson
    for key in (Qt.Key.Key_B, Qt.Key.Key_Period, Qt.Key.Key_PageDown):
        press(qtbot, window, Qt.Key.Key_B)
        assert hall.black.isVisible() and hall.black.size() == window.size()
        press(qtbot, window, key)
        assert not hall.black.isVisible() and window.store.state.lesson == place and not hall.card.isVisible()


def test_the_countdown_runs_stops_and_ends_at_nought(window, qtbot, hall):
    press(qtbot, window, Qt.Key.Key_PageDown)
    count = hall.card.countdown
    press(qtbot, window, Qt.Key.Key_T)
    assert not count._timer.isActive()
    press(qtbot, window, Qt.Key.Key_T)
    assert count._timer.isActive()
    for _ in range(SECONDS):
        count._tick()
    assert count.left == 0 and not count._timer.isActive()


def test_options_have_the_letters_of_the_page_and_only_the_right_one_stays(window, hall, teaching):
    step = LESSON.steps[STEP["choice"]]
    asked, told = options_of(step, False), options_of(step, True)
    letters = {button.text(): button.accessibleName() for button in teaching.panel.task.field.group.buttons()}
    assert len(asked) == len(letters) == 3 and len(told) == 1
    for line in asked:
        letter = line.split("<b>")[1][0]
        assert letters[letter].split(": ")[1] in line
    assert "right" in told[0]


@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080)])
def test_the_card_lies_within_the_stage_and_shows_all_of_its_text(window, qtbot, hall, size):
    window.resize(*size)
    press(qtbot, window, Qt.Key.Key_PageDown)
    card = hall.card
    assert window.room.stage.rect().contains(card.geometry())
    for label in (card.question, card.body):
        assert label.height() >= label.heightForWidth(label.width())


def test_the_keys_are_free_again_after_presenting(window, qtbot, hall):
    window.presentation.stop()
    place = window.store.state.lesson
    press(qtbot, window, Qt.Key.Key_PageDown, Qt.Key.Key_B, Qt.Key.Key_PageUp)
    assert window.store.state.lesson == place and not hall.black.isVisible() and not hall.card.isVisible()


def test_notes_follow_the_steps_in_a_window_of_their_own(window, qtbot, hall):
    hall.turn_notes()
    assert hall.notes.isVisible() and hall.notes.isWindow()
    window.teaching._go(NAME, STEP["radius"])
    assert "For who teaches." in hall.notes.text.text() and LESSON.steps[1].title in hall.notes.text.text()
    hall.turn_notes()
    assert not hall.notes.isVisible()


def test_notes_stand_beside_the_controls_where_there_is_a_second_screen(window, hall):
    hall.present(True, QRect(300, 40, 400, 500))
    assert hall.notes.isVisible() and hall.notes.pos() == QRect(300, 40, 1, 1).topLeft()
    assert hall.notes.width() <= 400 and LESSON.steps[STEP["choice"]].question in hall.notes.text.text()
    hall.present(False, None)
    assert not hall.notes.isVisible()
