"""Takes answers to the tasks of lessons, judges them, and keeps how far a person has got."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QElapsedTimer, QObject, Signal

from p2sf.errors import ExportError, P2SFError
from p2sf_explorer.i18n.language import current_language
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.typed import typed

if TYPE_CHECKING:
    from p2sf_explorer.lessons.lesson import Lesson
    from p2sf_explorer.lessons.task import Exercise
    from p2sf_explorer.lessons.task_panel import TaskPanel, TaskView
    from p2sf_explorer.lessons.task_record import CourseResult, TaskRecord

LONGEST_S = 1800.0  # that counts between two answers: who goes away for lunch does not work


class TaskDesk(QObject):
    """``answered``: a record has changed. The file at ``path()`` holds the records; undo does not touch them.

    ``marked()`` is what was marked on the picture, None for nothing.
    """

    answered = Signal()

    def __init__(
        self, store: Store, path: Callable[[], Path], marked: Callable[[], float | None], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._marked = marked
        self._store, self._path = store, path
        self._panel: TaskPanel | None = None
        self._lesson: Lesson | None = None
        self._number = 0
        self._clock = QElapsedTimer()
        self._read: tuple[int, CourseResult] | None = None  # with the time of the file

    def serve(self, panel: "TaskPanel") -> None:
        """Take the answers of a panel."""
        self._panel = panel
        panel.answered.connect(self.answer)
        panel.hint_asked.connect(self.give_hint)
        panel.again_asked.connect(self.set_up)
        panel.reasoned.connect(self.note_reason)

    def result(self) -> "CourseResult":
        """Return all records so far; a damaged file is put aside and told of."""
        from p2sf.version import program_version
        from p2sf_explorer.lessons.task_record import CourseResult

        path = self._path()
        time = path.stat().st_mtime_ns if path.is_file() else 0
        if self._read is None or self._read[0] != time:  # another window writes it too
            self._read = time, self._load(path) if time else CourseResult()
        return replace(self._read[1], program=program_version(), language=current_language())

    def _load(self, path: Path) -> "CourseResult":
        from p2sf_explorer.lessons.task_record import CourseResult, read_result

        try:
            return read_result(path)
        except ExportError as error:
            self._store.said.emit(error)
            path.replace(path.with_suffix(".damaged"))
            return CourseResult()

    def view(self, lesson: "Lesson", task: "Exercise") -> "TaskView":
        """Return how far a task of a lesson is."""
        from p2sf_explorer.lessons.task_panel import TaskView

        record = self.result().record(lesson.name, task.name)
        left = max(0, lesson.attempts - record.attempts) if lesson.attempts else None
        return TaskView(task, record, left, lesson.silent)

    def show(self, lesson: "Lesson", number: int) -> None:
        """Show the task of a step in the panel, hidden where it has none."""
        another = (lesson, number) != (self._lesson, self._number)
        if another:
            self._lesson, self._number = lesson, number
            self._clock.start()
        if self._panel:
            task = lesson.steps[number].task
            self._panel.setVisible(task is not None)
            if task:
                self._panel.show_task(self.view(lesson, task), another)

    def answer(self, text: str) -> None:
        """Judge an answer to the task on show, note it, and show what it predicted."""
        from p2sf_explorer.lessons.changes import apply_changes
        from p2sf_explorer.lessons.task import SEPARATOR, NumericAnswer

        lesson, task = self._lesson, self._task()
        if not (lesson and task and self._panel):
            return
        set_up = lesson.state(self._number, self._store.state)
        try:
            for number in text.split(SEPARATOR) if isinstance(task.answer, NumericAnswer) else ():
                typed(number)
            judgement = task.judge(text, set_up, self._store.state)
        except P2SFError as error:
            self._panel.show_unreadable(said(error))
            return
        record = self._record(lesson, task).with_answer(text.strip(), judgement.right)
        self._keep(lesson, task, record)
        if lesson.silent:
            self._panel.show_noted()
        else:
            self._panel.show_verdict(judgement, self.mark_words(lesson, self._number))
            if task.see and record.attempts == 1:
                self._store.replace(apply_changes(set_up, task.see))
        self.answered.emit()

    def mark_words(self, lesson: "Lesson", number: int) -> str:
        """Return what was marked on the picture of a step beside what is true, "" where nothing was."""
        from p2sf_explorer.lessons.changes import apply_changes

        task, marked = lesson.steps[number].task, self._marked()
        if not (task and task.mark and marked is not None):
            return ""
        try:
            return said(task.mark.words(marked, apply_changes(lesson.state(number), task.see)))
        except P2SFError as error:
            return said(error)

    def give_hint(self) -> None:
        """Show one more hint of the task on show."""
        lesson, task = self._lesson, self._task()
        if lesson and task:
            record = self._record(lesson, task)
            self._keep(lesson, task, replace(record, hints=min(record.hints + 1, len(task.hints))))
            self.show(lesson, self._number)

    def note_reason(self, text: str) -> None:
        """Keep why the answer on show is right, as the student says it."""
        lesson, task = self._lesson, self._task()
        if lesson and task and text.strip() != (record := self.result().record(lesson.name, task.name)).because:
            self._keep(lesson, task, replace(record, because=text.strip()))

    def set_up(self) -> None:
        """Set the window as the task begins."""
        if self._lesson:
            self._store.replace(self._lesson.state(self._number, self._store.state))

    def note_told(self, lesson: "Lesson", number: int) -> None:
        """Note that the solution of a step's task has been shown before it was right."""
        task = lesson.steps[number].task
        if task and not (record := self.result().record(lesson.name, task.name)).right and not record.told:
            if not lesson.attempts:
                self._keep(lesson, task, replace(record, told=True))

    def _task(self) -> "Exercise | None":
        return self._lesson.steps[self._number].task if self._lesson else None

    def _record(self, lesson: "Lesson", task: "Exercise") -> "TaskRecord":
        """Return the record of a task with the time since it was last looked at."""
        seconds = min(LONGEST_S, self._clock.restart() / 1000)
        record = self.result().record(lesson.name, task.name)
        return replace(record, seconds=round(record.seconds + seconds, 1))

    def _keep(self, lesson: "Lesson", task: "Exercise", record: "TaskRecord") -> None:
        from p2sf_explorer.lessons.task_record import write_result

        path = self._path()
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_result(path, self.result().with_record(lesson.name, task.name, record))
            self._read = None  # some file systems give two writings the same time
        except OSError as error:
            self._store.said.emit(ExportError("{path} cannot be written", path=str(error.filename)))
        except ExportError as error:
            self._store.said.emit(error)
