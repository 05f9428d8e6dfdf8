"""Every task of the course in the window, as a student works on it: values are typed, options clicked, items moved."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton

from p2sf_explorer.course.lectures import find_lectures
from p2sf_explorer.lessons import controller
from p2sf_explorer.lessons.changes import read_changes
from p2sf_explorer.lessons.task import ChoiceAnswer, GoalAnswer, NumericAnswer, OrderAnswer
from p2sf_explorer.lessons.task_record import TaskRecord
from p2sf_explorer.lessons.typed_numbers import written_value
from tests.explorer.course.test_lectures import FORESEEN, MISTAKES

LECTURES, _ = find_lectures()
TASKS = [
    (lesson, number, step.task)
    for lesson in LECTURES.values()
    for number, step in enumerate(lesson.steps)
    if step.task and not lesson.attempts
]
KEYS = str.maketrans({"λ": "wave", "µ": "u", "−": "-", "⁻": "-", "¹": "1"})  # which a keyboard has
ONE_OF_EACH = {type(task.answer): (lesson, number, task) for lesson, number, task in reversed(TASKS)}


@pytest.fixture
def teaching(window, tmp_path, monkeypatch):
    monkeypatch.setattr(controller.recent, "recent_path", lambda: tmp_path / "recent.json")
    yield window.teaching
    window.teaching.leave()


class Student:
    """Works in the window with mouse and keyboard."""

    def __init__(self, window, qtbot, teaching) -> None:
        self.window, self.qtbot, self.teaching = window, qtbot, teaching

    @property
    def panel(self):
        return self.teaching.panel.task

    def set_slider(self, key: str, value: float | None) -> None:
        """Type a value into the field of a slider, or press *file*."""
        row = self.window.controls.rows[key]
        if value is None:
            button = next(b for b in row.findChildren(QAbstractButton) if b.text() == "file")
            self.qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
            return
        row.edit.setFocus()
        row.edit.selectAll()
        self.qtbot.keyClicks(row.edit, f"{value:g}")
        self.qtbot.keyClick(row.edit, Qt.Key.Key_Return)

    def answer_number(self, *numbers: str) -> None:
        for edit, number in zip(self.panel.field.edits, numbers, strict=True):
            edit.selectAll()
            self.qtbot.keyClicks(edit, number.translate(KEYS))
        self.qtbot.keyClick(self.panel.field.edits[0], Qt.Key.Key_Return)

    def choose(self, number: int) -> None:
        self.qtbot.mouseClick(self.panel.field.group.button(number), Qt.MouseButton.LeftButton)
        self.check()

    def put_in_order(self, order: tuple[int, ...]) -> None:
        """Move items up until they stand in an order of numbers from 0."""
        field = self.panel.field
        for place, wanted in enumerate(order):
            row = field.text().split().index(str(wanted + 1))
            field.list.setCurrentRow(row)
            for _ in range(row - place):
                self.qtbot.mouseClick(field.up, Qt.MouseButton.LeftButton)
        self.check()

    def set_sliders(self, changes) -> None:
        for key, value in changes:
            self.set_slider(key, value)
        self.check()

    def check(self) -> None:
        self.qtbot.mouseClick(self.panel.check, Qt.MouseButton.LeftButton)


def wrong_answers(student: Student, state, task):
    """Yield a function that gives each foreseen wrong answer, and its hint."""
    answer = task.answer
    if isinstance(answer, NumericAnswer):
        for part, hint in answer.wrong:
            yield lambda part=part: student.answer_number(written_value(part.target(state), part.unit, 6)), hint
    elif isinstance(answer, ChoiceAnswer):
        for number, hint in enumerate(answer.hints):
            if number != answer.right:
                yield lambda number=number: student.choose(number), hint
    elif isinstance(answer, OrderAnswer):
        for order, hint in answer.wrong:
            yield lambda order=order: student.put_in_order(order), hint
    elif isinstance(answer, GoalAnswer):
        for moves, (_, hint) in zip(MISTAKES[task.name], answer.wrong, strict=True):
            changes = read_changes(moves, 1, "a mistake")
            yield lambda changes=changes: (student.panel.again.click(), student.set_sliders(changes)), hint


def solve(student: Student, state, task) -> None:
    answer = task.answer
    if isinstance(answer, NumericAnswer):
        student.answer_number(*(written_value(part.target(state), part.unit, 4) for part in answer.parts))
    elif isinstance(answer, ChoiceAnswer):
        student.choose(answer.right)
    elif isinstance(answer, OrderAnswer):
        student.put_in_order(tuple(range(len(answer.items))))
    elif isinstance(answer, GoalAnswer):
        student.panel.again.click()
        student.set_sliders(answer.solution)


def work_through(window, qtbot, teaching, lesson, number, task) -> list[str]:
    """Give every foreseen wrong answer and then the right one; return the hints that were shown."""
    student, shown = Student(window, qtbot, teaching), []
    teaching._go(lesson.name, number)
    state = lesson.state(number)
    for give, hint in wrong_answers(student, state, task):
        before = teaching.desk.result().record(lesson.name, task.name).attempts
        give()
        record = teaching.desk.result().record(lesson.name, task.name)
        assert record.attempts == before + 1 and not record.right, hint
        assert hint in student.panel.verdict.text().replace("\u00a0", " ")
        shown.append(hint)
    solve(student, state, task)
    record: TaskRecord = teaching.desk.result().record(lesson.name, task.name)
    assert record.right and record.attempts == len(shown) + 1, student.panel.verdict.text()
    return shown


@pytest.mark.parametrize("kind", ONE_OF_EACH, ids=lambda kind: kind.__name__)
def test_a_task_of_each_kind_is_solved_with_the_controls(window, qtbot, teaching, kind):
    assert work_through(window, qtbot, teaching, *ONE_OF_EACH[kind])


@pytest.mark.slow
def test_every_task_is_solved_and_forty_wrong_answers_get_their_own_hints(window, qtbot, teaching):
    shown = [work_through(window, qtbot, teaching, *task) for task in TASKS]
    assert all(len(set(hints)) == len(hints) for hints in shown)
    assert len({hint for hints in shown for hint in hints}) >= FORESEEN
    print(len(TASKS), "tasks solved,", sum(map(len, shown)), "wrong answers")
