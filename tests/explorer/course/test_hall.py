"""In the hall: a remote's keys lead from picture to question, answer and next step; black screen, countdown, notes."""

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtWidgets import QApplication

from p2sf_explorer.lessons.hall_card import SECONDS, Phase, options_of
from tests.explorer.course.test_tasks import LESSON, STEP
from tests.support.windows.windows import at_rest

NAME = "lecture_1"
TO_ANSWER = (Qt.Key.Key_PageDown,) * 3  # the first vote, the second, what was to be predicted


@pytest.fixture
def hall(window, teaching, monkeypatch):
    """Return the hall while a lecture is presented, in a window that keeps its size."""
    monkeypatch.setattr(window, "showFullScreen", lambda: None)
    teaching._go(NAME, STEP["choice"])
    window.presentation.start()
    yield window.hall
    window.presentation.stop()


@pytest.fixture
def shipped_hall(window, monkeypatch):
    """Present the shipped lectures, in a window that keeps its size."""
    monkeypatch.setattr(window, "showFullScreen", lambda: None)
    window.presentation.start()
    yield window.hall
    window.presentation.stop()
    window.teaching.leave()


def press(qtbot, window, *keys) -> None:
    for key in keys:
        qtbot.keyClick(window, key)
    QApplication.processEvents()


def test_page_down_shows_question_second_vote_picture_answer_and_next_step(window, qtbot, hall, teaching):
    place = window.store.state.lesson
    for _ in range(2):
        press(qtbot, window, Qt.Key.Key_PageDown)
        assert hall.card.isVisible() and not hall.card.told and hall.card.countdown.left == SECONDS
        assert hall.card.question.text() == LESSON.steps[STEP["choice"]].question
        assert window.store.state.optics.field_deg != 2.0
    press(qtbot, window, Qt.Key.Key_PageDown)
    assert not hall.card.told and LESSON.steps[STEP["choice"]].answer not in hall.card.body.text()
    assert window.store.state.optics.field_deg == 2.0 and hall.card.because.isVisible()
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
    press(qtbot, window, *TO_ANSWER)
    step = teaching.shelf(NAME)[NAME].state(STEP["choice"])
    assert (window.store.state.optics.field_deg, window.store.state.optics.f_number) == (2.0, step.optics.f_number)
    window.store.undo()
    assert window.store.state.optics.f_number == 9.0


def test_sliders_moved_after_the_picture_stay_while_the_answer_is_told(window, qtbot, hall):
    press(qtbot, window, *TO_ANSWER)
    window.store.update(f_number=9.0)
    press(qtbot, window, Qt.Key.Key_PageDown)
    assert hall.card.told and window.store.state.optics.f_number == 9.0


def test_letters_count_two_votes_and_backspace_takes_the_last_back(window, qtbot, hall):
    """By hand: A B B C, C taken back, is 1 2 0; then C C A is 1 0 2. D is no option here, and B leaves the screen."""
    press(qtbot, window, Qt.Key.Key_PageDown)
    qtbot.keyClicks(window, "abbcd")
    press(qtbot, window, Qt.Key.Key_Backspace)
    assert hall.card.count.text().endswith(": 3") and not hall.black.isVisible()
    press(qtbot, window, Qt.Key.Key_PageDown)
    assert hall.card.count.text().endswith(": 0")
    qtbot.keyClicks(window, "cca")
    press(qtbot, window, Qt.Key.Key_PageDown)
    shown = hall.card.body.text().replace("<b>", "").replace("</b>&nbsp;", " ")
    assert "A 1 → 1 · B 2 → 0 · C 0 → 2" in shown
    qtbot.keyClicks(window, "a")
    assert hall.votes.of(0) == (1, 1), "the vote is over"
    press(qtbot, window, Qt.Key.Key_B)
    assert hall.black.isVisible()


@pytest.mark.parametrize("key", [Qt.Key.Key_A, Qt.Key.Key_B, Qt.Key.Key_C])
def test_a_letter_opens_the_vote_and_counts(window, qtbot, hall, key):
    count = window.teaching.panel.count
    assert count.isVisible() and count.text().endswith("Page Down: vote")
    press(qtbot, window, key)
    assert hall.card.phase is Phase.FIRST and hall.card.count.text().endswith(": 1")
    assert hall.votes.of(key - Qt.Key.Key_A) == (1, 0) and not hall.black.isVisible()


def test_next_on_the_page_leads_through_the_vote_only_while_presenting(window, hall, teaching):
    place = window.store.state.lesson
    teaching.panel.next.click()
    assert hall.card.isVisible() and window.store.state.lesson == place
    window.presentation.stop()
    teaching.panel.next.click()
    assert window.store.state.lesson.step == place.step + 1


def test_figures_stay_untold_until_the_hall_has_voted(window, qtbot, hall):
    assert "RMS" not in window.caption.text
    press(qtbot, window, *TO_ANSWER)
    assert "RMS" in window.caption.text


def test_another_question_begins_without_votes(window, qtbot, hall):
    press(qtbot, window, Qt.Key.Key_PageDown, Qt.Key.Key_A, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)
    assert hall.card.count.text().endswith(": 0")


def test_one_reason_is_typed_after_the_picture(window, qtbot, hall):
    press(qtbot, window, *TO_ANSWER, Qt.Key.Key_Return)
    qtbot.keyClicks(QApplication.focusWidget(), "but. because")  # letters that are keys of the hall elsewhere
    assert hall.card.because.text() == "but. because" and not hall.black.isVisible()
    press(qtbot, window, Qt.Key.Key_PageDown)
    assert hall.card.told and hall.card.because.text() == "but. because"


@pytest.mark.parametrize("name", [f"lecture_{number}" for number in range(1, 7)])
@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080)])
def test_question_answers_check_and_the_slider_are_in_view(window, qtbot, shipped_hall, size, name):
    window.resize(*size)
    teaching = window.teaching
    for number, step in enumerate(teaching.lectures()[name].steps):
        teaching._go(name, number)
        at_rest(window, qtbot)
        for _ in range(3):  # timers of no length: shares, places, where to scroll
            qtbot.wait(1)
        panel, task = teaching.panel, teaching.panel.task
        options = getattr(getattr(task.field, "group", None), "buttons", list)() if step.task else []
        asked = [panel.question] if step.question else []
        for part in (*asked, *options, *([task.check] if step.task else [])):
            assert in_view(part, panel.area.viewport()), (number, part)
        if step.move:
            assert in_view(window.controls.rows[step.move], window.controls.area.viewport()), (number, step.move)


def in_view(part, port) -> bool:
    """Return whether all of a widget is within a viewport and on show."""
    return part.isVisible() and port.rect().contains(QRect(part.mapTo(port, QPoint()), part.size()))


def test_page_up_puts_the_question_away_first(window, qtbot, hall):
    place = window.store.state.lesson
    press(qtbot, window, Qt.Key.Key_PageDown, Qt.Key.Key_PageUp)
    assert not hall.card.isVisible() and window.store.state.lesson == place


def test_nothing_that_is_shown_in_the_hall_is_noted_as_a_students_answer(window, qtbot, hall, teaching):
    press(qtbot, window, *TO_ANSWER, Qt.Key.Key_PageDown)
    assert not teaching.desk.result().tasks


def test_the_screen_is_black_and_comes_back_where_it_was(window, qtbot, hall):
    place = window.store.state.lesson
    for key in (Qt.Key.Key_Period, Qt.Key.Key_PageDown):
        press(qtbot, window, Qt.Key.Key_Period)
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
    card = hall.card
    for _ in range(4):
        press(qtbot, window, Qt.Key.Key_PageDown)
        assert window.room.stage.rect().contains(card.geometry())
        for label in (label for label in (card.question, card.body, card.count) if label.isVisible()):
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
