"""The form that adds a question to a step of a lesson."""

from collections.abc import Callable

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.claims import SLIDERS_BY_KEY
from p2sf_explorer.lessons.making.questions import CHOICE, GOAL, NONE, NUMBER, OPEN, ORDER, Question
from p2sf_explorer.lessons.measure_words import WORDS, measure_words
from p2sf_explorer.widgets.card import chooser, select

KINDS = (
    (NONE, "No question"),
    (OPEN, "Question without grade"),
    (NUMBER, "A number"),
    (CHOICE, "One of several answers"),
    (ORDER, "An order"),
    (GOAL, "Sliders to be set"),
)
SUBJECTS = {NUMBER: "6.7 ± 0.2 µm", ORDER: "small; larger; largest", GOAL: "w31_waves within ± 0.1, field_deg is 10"}
ROWS = 5


class QuestionForm(QWidget):
    """Edits one question; ``edited`` at every change. ``solution`` returns what leads from the step to the screen."""

    edited = Signal()

    def __init__(self, solution: Callable[[], str], parent: QWidget) -> None:
        super().__init__(parent)
        self._solution, self._solve = solution, ""
        self.kind = chooser(KINDS, "What the step asks for", self)
        self.asked, self.answer, self.subject = QLineEdit(self), QLineEdit(self), QLineEdit(self)
        self.figures = self._figure_chooser()
        self.rows = QTableWidget(ROWS, 2, self)
        self.rows.verticalHeader().hide()
        self.rows.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.rows.setTabKeyNavigation(False)
        self.hints = QPlainTextEdit(self)
        self.hints.setTabChangesFocus(True)
        self.hints.setPlaceholderText(tr("One hint a line, shown one at a time"))
        self.solve = QPushButton(tr("The sliders as they are now solve it"), self)
        self.solve.setToolTip(tr("Set the window so that the goal is reached, then press this"))
        self.solve.setAutoDefault(False)
        self.solved = QLabel(self)
        self.solved.setObjectName("muted")
        self.solved.setWordWrap(True)
        self._lay_out()
        self._connect()
        self._show_kind()

    def _figure_chooser(self) -> QComboBox:
        box = chooser((("", "Insert a figure of the program…"),), "A figure that the program measures", self)
        for name in (*WORDS, *SLIDERS_BY_KEY):
            box.addItem(said(measure_words(name)), name)
        return box

    def _lay_out(self) -> None:
        self._form = form = QFormLayout(self)
        form.setContentsMargins(0, 0, 0, 0)
        solve = QHBoxLayout()
        solve.addWidget(self.solve)
        solve.addWidget(self.solved, 1)
        self._solving = QWidget(self)
        self._solving.setLayout(solve)
        solve.setContentsMargins(0, 0, 0, 0)
        for words, widget in (
            ("Kind", self.kind),
            ("Question", self.asked),
            ("Right answer", self.subject),
            ("", self.figures),
            ("", self._solving),
            ("", self.rows),
            ("Hints", self.hints),
            ("Solution", self.answer),
        ):
            form.addRow(tr(words), widget)
            if words:
                widget.setAccessibleName(tr(words))
        self.rows.setFixedHeight(5 * self.rows.verticalHeader().defaultSectionSize())
        self.hints.setFixedHeight(3 * self.hints.fontMetrics().lineSpacing() + 8)

    def _connect(self) -> None:
        self.kind.activated.connect(self._on_kind)
        for edit in (self.asked, self.answer, self.subject):
            edit.textEdited.connect(self.edited)
        self.hints.textChanged.connect(self.edited)
        self.rows.itemChanged.connect(self.edited)
        self.figures.activated.connect(self._insert)
        self.solve.clicked.connect(self._keep_solution)

    def _on_kind(self) -> None:
        self._show_kind()
        self.edited.emit()

    def _show_kind(self) -> None:
        """Show the fields that a kind has."""
        kind = self.kind.currentData()
        graded = kind not in (NONE, OPEN)
        shown = (
            (self.asked, kind != NONE),
            (self.answer, kind != NONE),
            (self.subject, graded and kind != CHOICE),
            (self.figures, kind in (NUMBER, GOAL)),
            (self._solving, kind == GOAL),
            (self.rows, graded),
            (self.hints, graded),
        )
        for widget, visible in shown:
            self._form.setRowVisible(widget, visible)
        self.subject.setPlaceholderText(SUBJECTS.get(kind, ""))
        first = tr("Answers, the right one first") if kind == CHOICE else tr("Wrong answer")
        self.rows.setHorizontalHeaderLabels([first, tr("Hint for it")])

    def _insert(self) -> None:
        name = self.figures.currentData()
        if name:
            number = self.kind.currentData() == NUMBER
            self.subject.setText(f"measure {name} ± 3 %" if number else f"{name} is 0 ± 0.1")
            self.edited.emit()
        self.figures.setCurrentIndex(0)

    def _keep_solution(self) -> None:
        self._solve = self._solution()
        self.solved.setText(self._solve)
        self.edited.emit()

    def question(self) -> Question:
        """Return the question as it stands."""
        rows = ((self._cell(row, 0), self._cell(row, 1)) for row in range(self.rows.rowCount()))
        return Question(
            self.kind.currentData(),
            self.asked.text(),
            self.answer.text(),
            self.subject.text(),
            tuple(row for row in rows if any(row)),
            tuple(filter(None, self.hints.toPlainText().splitlines())),
            self._solve,
        )

    def _cell(self, row: int, column: int) -> str:
        item = self.rows.item(row, column)
        return item.text() if item else ""

    def show_question(self, question: Question) -> None:
        """Show a question, without a signal."""
        with QSignalBlocker(self):
            select(self.kind, question.kind)
            self.asked.setText(question.words)
            self.answer.setText(question.solution)
            self.subject.setText(question.subject)
            self.hints.setPlainText("\n".join(question.hints))
            self.rows.clearContents()
            for row, cells in enumerate(question.rows[:ROWS]):
                for column, text in enumerate(cells):
                    self.rows.setItem(row, column, QTableWidgetItem(text))
            self._solve = question.solve
            self.solved.setText(question.solve)
            self._show_kind()
