"""The part of a lesson's page where its task is answered: field, verdict, hints step by step."""

from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QLineEdit, QPushButton, QVBoxLayout

from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr, unbroken
from p2sf_explorer.lessons.answer_fields import AnswerField, answer_field
from p2sf_explorer.lessons.offer import tool
from p2sf_explorer.lessons.task import ChoiceAnswer, Exercise, GoalAnswer, Judgement
from p2sf_explorer.lessons.task_record import LONGEST, TaskRecord

TO_MARK = {
    "ring": "First click on the picture where you expect the ring to pass.",
    "level": "First click on the picture at the height that you expect.",
}


@dataclass(frozen=True)
class TaskView:
    """A task as it stands: its record, the answers that are left (None: any number), and whether it tells if right."""

    task: Exercise
    record: TaskRecord
    remaining: int | None = None
    silent: bool = False

    @property
    def closed(self) -> bool:
        """Return whether no more answers are taken."""
        return self.record.right or self.record.told or self.remaining == 0


class TaskPanel(QFrame):
    """``answered``: an answer's text; ``hint_asked``; ``again_asked``: the state of the task is to be set once more.

    ``judged``: something is said of an answer; ``reasoned``: why it is so, in the student's own words.
    """

    answered = Signal(str)
    hint_asked = Signal()
    again_asked = Signal()
    judged = Signal()
    reasoned = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self._task: Exercise | None = None
        self.field: AnswerField = AnswerField()
        self.verdict, self.hints = QLabel(self), QLabel(self)
        for label in (self.verdict, self.hints):
            label.setWordWrap(True)
            label.setObjectName("task")
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.to_mark = QLabel(self)
        self.to_mark.setObjectName("muted")
        self.to_mark.setWordWrap(True)
        self.because = QLineEdit(self)
        self.because.setPlaceholderText(tr("Because …"))
        self.because.setAccessibleName(tr("Because"))
        self.because.setToolTip(tr("Say in one sentence why it is so; it is kept with your answers"))
        self.because.setMaxLength(LONGEST)
        self.because.editingFinished.connect(lambda: self.reasoned.emit(self.because.text()))
        self.check = QPushButton(tr("Check"), self)
        self.check.setToolTip(tr("Check the answer (Enter)"))
        self.hint = tool("", "Show the next hint; the file of results counts them")
        self.again = tool("Set up again", "Set lens and sliders as the task begins")
        self.check.clicked.connect(self._on_check)
        self.hint.clicked.connect(self.hint_asked)
        self.again.clicked.connect(self.again_asked)
        row, below = QHBoxLayout(), QHBoxLayout()
        row.addWidget(self.check, 1)
        row.addWidget(self.hint)
        below.addWidget(self.again)
        below.addStretch(1)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        for part in (self.to_mark, self.field, self.verdict, self.because, self.hints):
            self._column.addWidget(part)
        self._column.addLayout(row)
        self._column.addLayout(below)

    def _on_check(self) -> None:
        self.answered.emit(self.field.text())

    def show_task(self, view: TaskView, afresh: bool = False) -> None:
        """Show a task with what was answered before; ``afresh`` where the same one stands in another lesson."""
        task, record = view.task, view.record
        if afresh or task != self._task:
            self._task = task
            field = answer_field(task)
            field.entered.connect(self._on_check)
            self._column.replaceWidget(self.field, field)
            self.field.hide()
            self.field.deleteLater()
            self.field = field
            self.show_verdict(None)
            self.to_mark.setText(tr(TO_MARK[task.mark.form]) if task.mark else "")
            self.to_mark.setVisible(task.mark is not None)
            self.because.setText(record.because)
            if record.answers:
                field.show_answer(record.answers[-1])
                self._show_earlier(view)
        self.field.setEnabled(not view.closed)
        self.check.setVisible(not view.closed)
        self.again.setVisible(not view.closed and (isinstance(task.answer, GoalAnswer) or bool(task.see)))
        self.because.setVisible(bool(record.answers) and not view.silent and asks_why(task))
        self._show_hints(view)

    def _show_earlier(self, view: TaskView) -> None:
        if view.silent:
            self._say(tr("Your answer is noted."))
        elif view.record.right:
            self._say("✓ " + tr("Right, at attempt {number}.", number=view.record.attempts))

    def _show_hints(self, view: TaskView) -> None:
        hints, count = view.task.hints, view.record.hints
        shown = hints[:count]
        self.hints.setText(unbroken(local("\n".join(f"{number}  {hint}" for number, hint in enumerate(shown, 1)))))
        self.hints.setVisible(bool(shown))
        self.hint.setText(tr("Hint {number} of {count}", number=min(count + 1, len(hints)), count=len(hints)))
        self.hint.setVisible(count < len(hints) and not view.closed and view.remaining is None)

    def show_verdict(self, judgement: Judgement | None, marked: str = "") -> None:
        """Show what is said of the answer just given, None for nothing, and of what was marked on the picture."""
        if judgement is None:
            self._say("")
            return
        words = f"{'✓' if judgement.right else '✗'} {said(judgement.words)}"
        self._say(" ".join(filter(None, (words, local(judgement.hint), marked))))

    def show_noted(self) -> None:
        """Say only that the answer is noted."""
        self._say(tr("Your answer is noted."))

    def show_unreadable(self, words: str) -> None:
        """Say why an answer cannot be read; it costs no attempt."""
        self._say(words)

    def _say(self, words: str) -> None:
        self.verdict.setText(unbroken(words))
        self.verdict.setVisible(bool(words))
        if words:
            self.judged.emit()


def asks_why(task: Exercise) -> bool:
    """Return whether a reason is wanted in the student's own words: of a choice that offers none."""
    return isinstance(task.answer, ChoiceAnswer) and not task.answer.reasons
