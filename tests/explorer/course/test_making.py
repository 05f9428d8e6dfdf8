"""Questions by a form become tasks of a lesson, and *Test my lesson* finds what is wrong with one."""

import pytest
from PySide6.QtWidgets import QTableWidgetItem

from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.course.lectures import find_lectures
from p2sf_explorer.lessons.lesson import parse_lesson, read_lesson, shipped_lessons
from p2sf_explorer.lessons.making.lesson_checks import findings
from p2sf_explorer.lessons.making.lesson_test_window import names_on_screen
from p2sf_explorer.lessons.making.questions import CHOICE, GOAL, NUMBER, OPEN, ORDER, Question
from p2sf_explorer.lessons.making.recording import RecordedStep, save_lesson
from p2sf_explorer.lessons.task import ChoiceAnswer, GoalAnswer, NumericAnswer, OrderAnswer
from p2sf_explorer.state.state import change
from tests.explorer.course.test_tasks import LECTURE, LESSON
from tests.support.windows.events import choose

START = change(default_state("achromat_f6"), field_deg=0.0, sensor_shift_um=200.0)
QUESTIONS = (
    Question(OPEN, "Why?", "So."),
    Question(
        NUMBER, "How large?", "So.", "measure airy_radius_um ± 3 %", (("9 ± 0.3", "The diameter."),), ("One.", "Two.")
    ),
    Question(CHOICE, "Where?", "There.", "", (("right", ""), ("left", "Not left."), ("up", "Not up."))),
    Question(ORDER, "Order.", "a, b.", "a; b", (("2 1", "From the largest."),)),
    Question(
        GOAL, "Focus.", "So.", "wd_waves within ± 0.2", (("wd_waves above 1", "Too far."),), (), "sensor_shift_um 0"
    ),
)


def test_what_the_form_holds_is_what_the_lesson_asks(tmp_path):
    steps = [RecordedStep(START, f"Step {n}", "Words.", "", question) for n, question in enumerate(QUESTIONS)]
    lesson = read_lesson(save_lesson("My questions", "", steps, tmp_path))
    assert [step.question for step in lesson.steps] == [question.words for question in QUESTIONS]
    assert [step.answer for step in lesson.steps] == [question.solution for question in QUESTIONS]
    kinds = [type(step.task.answer) if step.task else None for step in lesson.steps]
    assert kinds == [None, NumericAnswer, ChoiceAnswer, OrderAnswer, GoalAnswer]
    names = [step.task.name for step in lesson.steps if step.task]
    assert len(set(names)) == 4 and lesson.steps[1].task.hints == ("One.", "Two.")
    choice = lesson.steps[2].task.answer
    assert (choice.options, choice.right, choice.hints[1:]) == (("right", "left", "up"), 0, ("Not left.", "Not up."))
    assert not findings(lesson, names_on_screen())


def test_a_text_that_would_part_an_answer_is_refused(tmp_path):
    for bad in ("a | b", "a :: b"):
        rows = (("right", ""), (bad, "Hint."))
        with pytest.raises(ValueError):
            save_lesson("T", "", [RecordedStep(START, "S", "", "", Question(CHOICE, "?", "!", "", rows))], tmp_path)
    assert not list(tmp_path.iterdir())


def test_the_lesson_of_these_tests_and_a_shipped_one_are_without_fault():
    names = names_on_screen()
    assert not findings(LESSON, names)
    assert not findings(shipped_lessons()[1], names)


@pytest.mark.slow
def test_nothing_is_wrong_with_any_lesson_or_lecture():
    names, (lectures, _) = names_on_screen(), find_lectures()
    assert not [
        (one.name, *found) for one in (*lectures.values(), *shipped_lessons()) for found in findings(one, names)
    ]


@pytest.mark.parametrize(
    ("old", "new", "count"),
    [
        ("## Radius\n", "## Radius\nclaim: airy_radius_um is 5 ± 0.1\n", 1),
        ("## Radius\n", "## Radius\nMove *Shutter*, **not** *Field*.\n", 1),
        ("wrong: 13.4 ± 0.4", "wrong: 6.8 ± 0.4", 1),
        ("wrong: 0.0034 ± 0.0001 mm", "wrong: 13.5 ± 1", 1),
        (" :: Not left.", "", 1),
        ("wrong: 3 2 1", "wrong: 1 2 3", 1),
        ("solve: sensor_shift_um 0, field_deg 1", "solve: sensor_shift_um 0", 1),
        ("wd_waves within ± 0.2, field_deg is 1", "field_deg is 0", 2),
        ("task: measured", "task: radius", 1),
    ],
)
def test_a_fault_is_found_and_named(old, new, count):
    assert old in LECTURE
    found = findings(parse_lesson(LECTURE.replace(old, new, 1), "x", "x.md"), names_on_screen())
    assert len(found) == count, [str(message) for _, message in found]


@pytest.fixture
def maker(window, teaching, tmp_path, monkeypatch):
    monkeypatch.setattr("p2sf_explorer.lessons.lesson.own_folder", lambda: tmp_path)
    window.store.replace(START)
    teaching.make()
    yield teaching.maker
    teaching.maker.tester.close()
    teaching.maker.deleteLater()
    teaching.maker = None
    teaching._lessons = {}


def test_a_goal_by_the_form_is_solved_by_the_sliders_and_tested(window, qtbot, teaching, maker):
    maker.name.setText("Focus it")
    form = maker.form
    choose(form.kind, GOAL)
    form.asked.setText("Focus.")
    form.answer.setText("So.")
    choose(form.figures, "wd_waves")
    assert form.subject.text().startswith("wd_waves is ")
    form.subject.setText("wd_waves within ± 0.2")
    form.rows.setItem(0, 0, QTableWidgetItem("wd_waves above 1"))
    form.rows.setItem(0, 1, QTableWidgetItem("Too far."))
    form.edited.emit()
    maker.test_lesson()
    qtbot.waitUntil(lambda: not maker.tester.busy)
    assert maker.tester.found, "nothing solves it yet"
    window.store.update(sensor_shift_um=0.0)
    form.solve.click()
    maker.test_lesson()
    qtbot.waitUntil(lambda: not maker.tester.busy)
    assert not maker.tester.found
    maker.save.click()
    task = teaching.panel.task
    assert window.store.state.lesson.name == "90_focus_it" and window.store.state.optics.sensor_shift_um == 200.0
    task.check.click()
    assert "✗" in task.verdict.text()
    window.store.update(sensor_shift_um=0.0)
    task.check.click()
    assert "✓" in task.verdict.text()


def test_each_step_keeps_its_own_question(window, maker):
    maker.form.show_question(QUESTIONS[2])
    maker.form.edited.emit()
    window.store.update(field_deg=3.0)
    maker.add_present()
    assert maker.form.question() == Question()
    maker.list.setCurrentRow(0)
    assert maker.form.question() == QUESTIONS[2]


def test_the_lesson_under_way_can_be_tested(window, qtbot, teaching):
    said = []
    window.store.said.connect(said.append)
    teaching.leave()
    teaching.test()
    window.store.said.disconnect(said.append)
    assert said and teaching.tester is None
    teaching.begin("lecture_1")
    teaching.test()
    qtbot.waitUntil(lambda: not teaching.tester.busy)
    assert not teaching.tester.found
    teaching.tester.close()
