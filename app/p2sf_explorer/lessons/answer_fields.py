"""Where an answer is given: fields for numbers, options by letter, and a list that is put into order."""

from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QMouseEvent, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QButtonGroup,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.lessons.offer import tool
from p2sf_explorer.lessons.task import (
    SEPARATOR,
    SURE,
    ChoiceAnswer,
    Exercise,
    NumericAnswer,
    OrderAnswer,
    display_order,
    reason_order,
)
from p2sf_explorer.lessons.typed_numbers import SHOWN, prompt

NUMBER = Qt.ItemDataRole.UserRole
BESIDE = 2  # buttons with words that the narrow column takes
LETTERS, WIDEST = 28, 200  # letters on a line of an item, and of an answer at most


class AnswerField(QWidget):
    """Where one task is answered; this one, of a goal, is answered by the window. ``entered``: the answer is given."""

    entered = Signal()

    def text(self) -> str:
        """Return the answer as `Exercise.judge` reads it."""
        return ""

    def show_answer(self, text: str) -> None:
        """Show an answer that was given before."""


class NumberFields(AnswerField):
    """A line for each number of a task."""

    def __init__(self, answer: NumericAnswer) -> None:
        super().__init__()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        self.edits: list[QLineEdit] = []
        for part in answer.parts:
            edit, row = QLineEdit(self), QHBoxLayout()
            edit.setMaxLength(WIDEST // len(answer.parts))
            edit.setPlaceholderText(said(prompt(part.unit)))
            edit.setAccessibleName(part.label or tr("Answer"))
            edit.returnPressed.connect(self.entered)
            if part.label:
                row.addWidget(QLabel(local(part.label), self))
            row.addWidget(edit, 1)
            row.addWidget(QLabel(SHOWN.get(part.unit, part.unit), self))
            column.addLayout(row)
            self.edits.append(edit)

    def text(self) -> str:
        """Return the numbers, separated by semicolons."""
        return SEPARATOR.join(edit.text().replace(SEPARATOR, " ") for edit in self.edits)

    def show_answer(self, text: str) -> None:
        """Fill the lines."""
        for edit, part in zip(self.edits, text.split(SEPARATOR), strict=False):
            edit.setText(part.strip())


class OptionLabel(QLabel):
    """The text of an option, of as many lines as it takes; a click chooses it."""

    def __init__(self, text: str, button: QToolButton) -> None:
        super().__init__(local(text))
        self._button = button
        self.setWordWrap(True)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Choose the option."""
        if self.isEnabled():
            self._button.setChecked(True)


class OptionList(AnswerField):
    """Options by letters, in the order of the display; where they are asked for, reasons by numbers, and how sure."""

    def __init__(self, task: Exercise, answer: ChoiceAnswer) -> None:
        super().__init__()
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        order, why = display_order(task), reason_order(task)
        self.group = self._offer([(letter(k), answer.options[n], n) for k, n in enumerate(order)])
        self.groups = [self.group]
        if answer.reasons:
            column.addWidget(QLabel(tr("Because …"), self))
            self.groups.append(self._offer([(str(k), answer.reasons[n], n) for k, n in enumerate(why, 1)]))
            column.addWidget(QLabel(tr("How sure are you?"), self))
            self.groups.append(self._offer([("", tr(words), n) for n, words in enumerate(SURE)]))

    def _offer(self, offers: list[tuple[str, str, int]]) -> QButtonGroup:
        """Return buttons with their sign, text and number, one below the other; without signs in pairs."""
        group, line = QButtonGroup(self), QHBoxLayout()
        for sign, text, number in offers:
            button = tool("", "")
            button.setText(sign or text)
            button.setCheckable(True)
            button.setAccessibleName(f"{sign}: {text}" if sign else text)
            group.addButton(button, number)
            line.addWidget(button, 0, Qt.AlignmentFlag.AlignTop)
            if sign:
                line.addWidget(OptionLabel(text, button), 1)
            if sign or line.count() == BESIDE:
                self._column.addLayout(line)
                line = QHBoxLayout()
        return group

    def text(self) -> str:
        """Return the numbers of what is chosen, from 1 in the order of the file."""
        return " ".join(str(group.checkedId() + 1) for group in self.groups if group.checkedId() >= 0)

    def show_answer(self, text: str) -> None:
        """Choose what was chosen before."""
        for group, word in zip(self.groups, text.split(), strict=False):
            if word.isdecimal() and (button := group.button(int(word) - 1)):
                button.setChecked(True)


class OrderList(AnswerField):
    """Items that are dragged into order, or moved by two buttons."""

    def __init__(self, answer: OrderAnswer, order: tuple[int, ...]) -> None:
        super().__init__()
        self._items = answer.items
        self.list = QListWidget(self)
        self.list.setDragDropMode(QAbstractItemView.DragDropMode.InternalMove)
        self.list.setAccessibleName(tr("Items to be put in order"))
        self.list.setWordWrap(True)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.up, self.down = tool("▲", "Move the chosen item up"), tool("▼", "Move the chosen item down")
        for button, by, words in ((self.up, -1, "Up"), (self.down, 1, "Down")):
            button.clicked.connect(partial(self.move_item, by))
            button.setAccessibleName(tr(words))
        side = QVBoxLayout()
        side.addWidget(self.up)
        side.addWidget(self.down)
        side.addStretch(1)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.list, 1)
        row.addLayout(side)
        self._fill(order)

    def _fill(self, order: tuple[int, ...]) -> None:
        self.list.clear()
        for number in order:
            item = QListWidgetItem(local(self._items[number]), self.list)
            item.setData(NUMBER, number)
        self.list.setCurrentRow(0)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Be as high as the items, whatever the size of type."""
        super().resizeEvent(event)
        lines = sum(1 + len(item) // LETTERS for item in self._items)
        self.list.setFixedHeight(lines * (self.list.fontMetrics().height() + 2) + 8)

    def move_item(self, by: int) -> None:
        """Move the chosen item a place up, −1, or down."""
        row = self.list.currentRow()
        if 0 <= row + by < self.list.count():
            self.list.insertItem(row + by, self.list.takeItem(row))
            self.list.setCurrentRow(row + by)

    def text(self) -> str:
        """Return the numbers of the items in the file, from 1, as they stand."""
        return " ".join(str(self.list.item(row).data(NUMBER) + 1) for row in range(self.list.count()))

    def show_answer(self, text: str) -> None:
        """Put the items into an order that was given before."""
        order = tuple(int(word) - 1 for word in text.split() if word.isdecimal())
        if sorted(order) == list(range(len(self._items))):
            self._fill(order)


def letter(place: int) -> str:
    """Return the letter of an option by its place from 0."""
    return chr(ord("A") + place)


def answer_field(task: Exercise) -> AnswerField:
    """Return where a task is answered."""
    answer = task.answer
    if isinstance(answer, NumericAnswer):
        return NumberFields(answer)
    if isinstance(answer, ChoiceAnswer):
        return OptionList(task, answer)
    return OrderList(answer, display_order(task)) if isinstance(answer, OrderAnswer) else AnswerField()
