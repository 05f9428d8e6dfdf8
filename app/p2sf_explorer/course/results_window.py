"""The results of a class: students by tasks, how many got each right, and the files that could not be read."""

from collections.abc import Callable
from html import escape
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.course.results_table import ResultTable, concept_gain, item_gains, sure_but_wrong, write_table
from p2sf_explorer.files.asking import ask_path
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.task_record import JOINT, CourseResult, TaskRecord
from p2sf_explorer.widgets.plain_table import PlainTable

SIZE = 900, 520
KEY = "✓ first time · ✓ 3 third attempt · ✗ 2 not in two · ◌ solution shown · under a task: share right"
FIRST = 3  # columns before the tasks
ITEM_HEADS = ("Item", "Students", "Right before", "Right after", "Gain", "Sure and wrong")


class ResultsWindow(QDialog):
    """A table with a row a student; ``done`` is told what was written."""

    def __init__(
        self, table: ResultTable, version: str, done: Callable[[Message | P2SFError], object], parent: QWidget
    ):
        super().__init__(parent)
        self._table, self._done = table, done
        self.setWindowTitle(tr("Results of a class"))
        self.table = PlainTable(("Name", "Tasks right", "Course", *("",) * len(table.tasks)), "Results of a class")
        self.table.setRowCount(len(table.rows))
        for row, (path, result) in enumerate(table.rows):
            self._fill(row, path, result, version)
        self._head()
        key, self.faults = QLabel(tr(KEY), self), QLabel(self)
        key.setObjectName("muted")
        self.faults.setObjectName("warning")
        for label in (key, self.faults):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
        self.faults.setText("\n".join(f"⚠ {fault.message.text(WINDOW)}" for fault in table.faults))
        self.faults.setVisible(bool(table.faults))
        self.save, close = QPushButton(tr("Save as CSV…"), self), QPushButton(tr("Close"), self)
        self.save.setToolTip(
            tr("Write the table for a spreadsheet: attempts, hints, time and last answer of each task")
        )
        self.save.clicked.connect(self.ask_save)
        close.clicked.connect(self.close)
        foot = QHBoxLayout()
        self.count = QLabel(count_words(table), self)
        self.count.setWordWrap(True)
        self.count.setToolTip(tr("Gain: the share of what was wrong before that is right after (Hake 1998)"))
        foot.addWidget(self.count, 1)
        foot.addWidget(self.save)
        foot.addWidget(close)
        column = QVBoxLayout(self)
        for part in (key, self.table, self.faults):
            column.addWidget(part)
        self.items = self._item_table()
        self.items.setVisible(bool(self.items.rowCount()))
        column.addWidget(self.items)
        column.addLayout(foot)

    def _item_table(self) -> PlainTable:
        """Return the items of the concept check with what was gained in each."""
        gains = item_gains(self._table)
        made = PlainTable(ITEM_HEADS, "Gain in each item of the concept check")
        made.setRowCount(len(gains))
        for row, (name, gain) in enumerate(gains.items()):
            sure = " → ".join(map(str, sure_but_wrong(self._table, name)))
            shares = (f"{100 * share:.0f} %" for share in (gain.before, gain.after))
            made.put(row, 0, name)
            for column, text in enumerate((str(gain.count), *shares, _signed(gain.share_gained), sure), 1):
                made.put(row, column, text, right=True)
        return made

    def restyle(self, theme: Tokens) -> None:
        """Take the scale of a theme."""
        self.table.restyle(theme)
        self.items.restyle(theme)
        self.resize(*(theme.px(side) for side in SIZE))

    def _head(self) -> None:
        """Name every task with the share that got it right, and in its tip the commonest wrong answers."""
        for column, task in enumerate(self._table.tasks, FIRST):
            found = self._table.summary(task)
            lecture, _, name = task.partition(JOINT)
            item = QTableWidgetItem(f"{lecture}\n{name}\n{100 * found.share_right:.0f} %")
            wrong = ", ".join(f"{answer} ({count})" for answer, count in found.wrong)
            tip = tr("{count} tried it; wrong at first: {wrong}", count=found.count, wrong=wrong or "–")
            item.setToolTip(literal_tip(f"{task}\n{tip}"))
            self.table.setHorizontalHeaderItem(column, item)

    def _fill(self, row: int, path: Path, result: CourseResult, version: str) -> None:
        right = sum(record.right for record in result.tasks.values())
        self.table.put(row, 0, result.name or path.stem).setToolTip(literal_tip(path.name))
        self.table.put(row, 1, str(right), right=True)
        other = result.course != version
        self.table.put(row, 2, f"⚠ {result.course}" if other else result.course).setToolTip(
            tr("Another version of the course: its tasks may differ") if other else ""
        )
        for column, task in enumerate(self._table.tasks, FIRST):
            record = result.tasks.get(task)
            cell = self.table.put(row, column, sign(record) if record else "")
            if record:
                cell.setToolTip(literal_tip(", ".join(record.answers)))

    def ask_save(self) -> None:
        """Ask for a name and write the table as CSV."""
        if path := ask_path(self, tr("Save as CSV…"), "results.csv", "CSV (*.csv)"):
            self.write(Path(path))

    def write(self, path: Path) -> None:
        """Write the table as CSV."""
        try:
            write_table(self._table, path)
        except P2SFError as error:
            self._done(error)
            return
        self._done(Message("Saved {name}", name=path.name))


def literal_tip(text: str) -> str:
    """Return a tooltip that shows what a student's file says as it is, and never as HTML."""
    return f"<qt>{escape(text)}</qt>".replace("\n", "<br>")


def count_words(table: ResultTable) -> str:
    """Return how many students there are, and what they gained between the concept checks."""
    words, gain = tr("{count} students", count=len(table.rows)), concept_gain(table)
    if gain is None:
        return words
    both = tr(
        "Concept check of {count}: {before} right before, {after} after, gain {gain}",
        count=gain.count,
        before=f"{100 * gain.before:.0f} %",
        after=f"{100 * gain.after:.0f} %",
        gain=_signed(gain.share_gained),
    )
    return f"{words} · {both}"


def _signed(gain: float) -> str:
    return f"{gain:.2f}".replace("-", "−")


def sign(record: TaskRecord) -> str:
    """Return a cell: right or not, and the attempts it took where these were not one."""
    count = f" {record.attempts}" if record.attempts > 1 else ""
    if record.right:
        return f"✓{count}"
    return f"◌{count}" if record.told else f"✗{count}" if record.answers else ""
