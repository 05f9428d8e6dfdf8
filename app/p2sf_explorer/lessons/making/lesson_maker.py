"""The dialog that makes a lesson of what is on screen: its steps, and fields for their words."""

from collections.abc import Callable
from datetime import date
from pathlib import Path
from tempfile import TemporaryDirectory

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QPlainTextEdit,
    QPushButton,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from p2sf.errors import P2SFError
from p2sf.files.reasons import reason
from p2sf.messages import Message
from p2sf_explorer.compute.caption import field_text
from p2sf_explorer.compute.quantities import SOURCE_QUANTITIES
from p2sf_explorer.compute.setup import prescription, ranges, title
from p2sf_explorer.i18n.language import current_language
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.lessons.lesson import read_lesson
from p2sf_explorer.lessons.making.lesson_test_window import LessonTestWindow
from p2sf_explorer.lessons.making.question_form import QuestionForm
from p2sf_explorer.lessons.making.recording import RecordedStep, same_lens, save_lesson, written_changes
from p2sf_explorer.state.state import State, entry
from p2sf_explorer.store.store import Store

INTRO = (
    "Each step keeps what is on screen: go on in the window, and add the next step here. What you write is Markdown."
)
ADD_TIP = "Add a step that shows what is on screen now"
TEST_TIP = "Measure every claim, look for every control that is named, and solve every task"
UNDO_TIP = "Add a step for every step of undo of this lens, up to what is on screen"
SIZE = 860, 620


class LessonMaker(QDialog):
    """Stays beside the window while steps are added. ``made``: the path of the lesson that was written."""

    made = Signal(str)

    def __init__(self, store: Store, folder: Callable[[], Path], parent: QWidget) -> None:
        super().__init__(parent)
        self._store, self._folder = store, folder
        self.steps: list[RecordedStep] = []
        self.setWindowTitle(tr("Make a lesson of this"))
        self.name, self.about = QLineEdit(self), QLineEdit(self)
        self.list = QListWidget(self)
        self.list.setAccessibleName(tr("Steps of the lesson"))
        self.heading, self.attempt, self.text = QLineEdit(self), QLineEdit(self), QPlainTextEdit(self)
        self.text.setTabChangesFocus(True)
        self.form = QuestionForm(self._solution, self)
        self.tester = LessonTestWindow(self)
        self.why = QLabel(self)
        self.why.setWordWrap(True)
        self.add = self._button("Add what is on screen", ADD_TIP, self.add_present)
        self.undo = self._button("Add the steps of undo", UNDO_TIP, self.add_history)
        self.remove = self._button("Remove the step", "Remove the chosen step", self._remove)
        self.test = self._button("Test my lesson", TEST_TIP, self.test_lesson)
        self.save = self._button("Save and open", "Write the lesson, and begin it in the window", self._save)
        self.save.setDefault(True)
        self._lay_out()
        self.list.currentRowChanged.connect(self._show_step)
        for edit in (self.heading, self.attempt):
            edit.textEdited.connect(self._keep)
        self.text.textChanged.connect(self._keep)
        self.form.edited.connect(self._keep)
        self.resize(*SIZE)

    def _button(self, words: str, tip: str, action: Callable[[], object]) -> QPushButton:
        button = QPushButton(tr(words), self)
        button.setToolTip(tr(tip))
        button.setAutoDefault(False)
        button.clicked.connect(action)
        return button

    def _lay_out(self) -> None:
        top = QFormLayout()
        step = QFormLayout()
        rows = (
            (top, "Title", self.name),
            (top, "In one sentence", self.about),
            (step, "Heading", self.heading),
            (step, "Text", self.text),
            (step, "Try", self.attempt),
        )
        for form, words, widget in rows:
            form.addRow(tr(words), widget)
            widget.setAccessibleName(tr(words))
        intro = QLabel(tr(INTRO), self)
        intro.setWordWrap(True)
        intro.setObjectName("muted")
        left = QVBoxLayout()
        left.addWidget(self.list, 1)
        for button in (self.add, self.undo, self.remove):
            left.addWidget(button)
        middle = QHBoxLayout()
        middle.addLayout(left, 2)
        telling, question = QWidget(self), QWidget(self)
        telling.setLayout(step)
        lines = QVBoxLayout(question)
        lines.addWidget(self.form)
        lines.addStretch(1)
        self.pages = QTabWidget(self)
        self.pages.addTab(telling, tr("Text"))
        self.pages.addTab(question, tr("Question"))
        middle.addWidget(self.pages, 3)
        foot = QHBoxLayout()
        foot.addWidget(self.why, 1)
        foot.addWidget(self.test)
        foot.addWidget(self.save)
        column = QVBoxLayout(self)
        column.addLayout(top)
        column.addWidget(intro)
        column.addLayout(middle, 1)
        column.addLayout(foot)

    def begin(self) -> None:
        """Start a lesson with what is on screen as its first step, unless one is being made."""
        if not self.steps:
            state = self._store.state
            self.name.setText(tr(title(state.optics.lens)).partition(",")[0])
            self.about.setText(tr("Made on {date}", date=date.today().isoformat()))
            self._put([state])
        self.why.clear()
        self.show()
        self.raise_()
        self.name.setFocus()
        self.name.selectAll()

    def add_present(self) -> None:
        """Add what is on screen as a step."""
        self._put([self._store.state])

    def add_history(self) -> None:
        """Add the steps of undo of the present lens; steps that have words are kept."""
        history = same_lens(self._store.history)
        kept = {step.state: step for step in self.steps}
        self.steps = [step for step in self.steps if step.state not in history and has_words(step)]
        self._put(history, kept)

    def _put(self, states: list[State], kept: dict[State, RecordedStep] | None = None) -> None:
        for state in states:
            heading = step_heading(self.steps[-1].state if self.steps else None, state)
            self.steps.append((kept or {}).get(state) or RecordedStep(state, heading))
        self._list(len(self.steps) - 1)

    def _list(self, chosen: int) -> None:
        with QSignalBlocker(self.list):
            self.list.clear()
            self.list.addItems([f"{number}  {step.title}" for number, step in enumerate(self.steps, 1)])
            self.list.setCurrentRow(chosen)
        self.remove.setEnabled(len(self.steps) > 1)
        self._show_step(chosen)

    def _show_step(self, number: int) -> None:
        if not 0 <= number < len(self.steps):
            return
        step = self.steps[number]
        with QSignalBlocker(self.text):
            self.heading.setText(step.title)
            self.attempt.setText(step.attempt)
            self.text.setPlainText(step.text)
        self.form.show_question(step.question)

    def _keep(self) -> None:
        """Take over what is typed."""
        number = self.list.currentRow()
        if not 0 <= number < len(self.steps):
            return
        words = self.heading.text(), self.text.toPlainText(), self.attempt.text()
        self.steps[number] = RecordedStep(self.steps[number].state, *words, self.form.question())
        self.list.item(number).setText(f"{number + 1}  {self.heading.text()}")

    def _remove(self) -> None:
        number = self.list.currentRow()
        if len(self.steps) > 1 and number >= 0:
            del self.steps[number]
            self._list(max(0, number - 1))

    def _solution(self) -> str:
        """Return what leads from the chosen step to what is on screen."""
        number = self.list.currentRow()
        return written_changes(self.steps[number].state, self._store.state) if 0 <= number < len(self.steps) else ""

    def test_lesson(self) -> None:
        """Write the lesson into a folder that goes again, and check all that it says."""
        self._trial = TemporaryDirectory(prefix="p2sf-lesson-", ignore_cleanup_errors=True)
        try:
            path = save_lesson(self.name.text(), self.about.text(), self.steps, Path(self._trial.name))
            self.tester.begin(read_lesson(path))
        except P2SFError as error:
            self.tester.show_failure(said(error))

    def _save(self) -> None:
        try:
            path = save_lesson(self.name.text(), self.about.text(), self.steps, self._folder(), current_language())
        except P2SFError as error:
            self.why.setText(said(error))
            return
        except OSError as error:
            why = Message("{path} cannot be written ({why})", path=str(error.filename), why=reason(error))
            self.why.setText(said(why))
            return
        self.steps = []
        self.hide()
        self.made.emit(str(path))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Keep the steps for when the dialog is opened again."""
        self.hide()
        event.ignore()


def step_heading(before: State | None, state: State) -> str:
    """Return what a step is about: the sliders that have moved since the step before, else the field."""
    limits = ranges(prescription(state))
    moved = (q for q in SOURCE_QUANTITIES if before and entry(before, q.key) != entry(state, q.key))
    words = [f"{tr(q.title)} {local(q.write(q.shown(state, limits)))}" for q in moved]
    return ", ".join(words) or tr("Field {field}", field=field_text(state))


def has_words(step: RecordedStep) -> bool:
    """Return whether a person has written anything for a step."""
    return bool(step.text or step.attempt or step.question.kind)
