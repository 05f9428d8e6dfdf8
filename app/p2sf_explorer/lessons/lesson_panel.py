"""The page of a lesson beside the panels: text, what to try, a question and its answer, Back and Next."""

from dataclasses import dataclass
from html import escape

from PySide6.QtCore import QEvent, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QTextDocument
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QScrollArea, QVBoxLayout, QWidget

from p2sf_explorer.charts.theme import SPACE
from p2sf_explorer.i18n.tr import local, tr, unbroken
from p2sf_explorer.lessons.lesson import Lesson
from p2sf_explorer.lessons.lesson_list import lecture_heading
from p2sf_explorer.lessons.offer import tool
from p2sf_explorer.lessons.task_panel import TaskPanel
from p2sf_explorer.widgets.card import chooser, select

LINE_PX = 15.0  # height of a line of text at scale 1


@dataclass(frozen=True)
class StepFrame:
    """What goes with a step: whether its answer is ``told``, or may be asked for, and where *Next* at the end leads.

    ``blocks`` are names and titles of the lessons that a lecture plays; ``key`` says which key leads on.
    """

    told: bool
    may_ask: bool = True
    end: str = ""
    blocks: tuple[tuple[str, str], ...] = ()
    key: str = ""


class LessonPanel(QFrame):
    """Shows one step; tells what was pressed: ``chosen`` a lesson's name, ``moved`` −1 or +1, ``asked``, ``left``."""

    chosen = Signal(str)
    moved = Signal(int)
    asked = Signal()
    left = Signal()

    def __init__(self, lessons: tuple[Lesson, ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._column, self.progress = QVBoxLayout(self), StepBar()
        self.setObjectName("card")
        self.setAccessibleName(tr("Lesson"))
        self.choice = chooser((), "Choose a lesson", self)
        self.list_lessons(lessons)
        self.choice.setSizeAdjustPolicy(self.choice.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.exit = tool("Exit", "End the lesson and restore everything as it was before (F3)")
        self.title, self.count = wrapped_label("title"), wrapped_label("muted")
        self.about, self.text, self.attempt = (
            wrapped_label("muted"),
            wrapped_label("", Qt.TextFormat.RichText),
            wrapped_label("task", Qt.TextFormat.RichText),
        )
        self.question, self.answer = wrapped_label("sentence"), wrapped_label("task", Qt.TextFormat.RichText)
        self.blocks = wrapped_label("muted", Qt.TextFormat.RichText)
        for label in (self.blocks, self.text):
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
            label.linkActivated.connect(self.chosen)
        self.task = TaskPanel()
        self.task.hide()
        self.reveal = QPushButton(tr("Show the answer"))
        self.reveal.setToolTip(tr("Show the answer (Alt+Down)"))
        self.back, self.next = QPushButton(tr("Back")), QPushButton(tr("Next"))
        self.back.setToolTip(tr("The step before (Alt+Left)"))
        self.next.setToolTip(tr("The next step (Alt+Right)"))
        self._shown: tuple[Lesson, int, StepFrame] | None = None
        self._to_answer = False
        self.presenting = False  # the question stays in view, and the text above it scrolls away
        self._lay_out()
        self._connect()
        self.hide()

    def list_lessons(self, lessons: tuple[Lesson, ...], numbered: bool = True) -> None:
        """Offer these lessons, with their numbers, or lectures, which have their own."""
        self.choice.clear()
        for number, lesson in enumerate(lessons, 1):
            self.choice.addItem(f"{number}  {lesson.title}" if numbered else lecture_heading(lesson), lesson.name)

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.addWidget(self.count, 1)
        head.addWidget(self.exit)
        page = QWidget()
        page.setObjectName("page")
        self._inner = inner = QVBoxLayout(page)
        inner.setContentsMargins(0, 0, SPACE, 0)
        inner.setSpacing(10)
        first = self.about, self.blocks, self.title, self.text, self.attempt
        for part in (*first, self.question, self.task, self.reveal, self.answer):
            inner.addWidget(part)
        inner.addStretch(1)
        self.area = QScrollArea()
        self.area.setAccessibleName(tr("Text of the lesson"))
        self.area.setWidgetResizable(True)
        self.area.setFrameShape(QScrollArea.Shape.NoFrame)
        self.area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.area.setWidget(page)
        for behind in (self.area.viewport(), page):
            behind.setAutoFillBackground(False)
        foot = QHBoxLayout()
        foot.addWidget(self.back)
        foot.addStretch(1)
        foot.addWidget(self.next)
        column = self._column
        self._fit_type()
        column.addLayout(head)
        column.addWidget(self.progress)
        column.addWidget(self.choice)
        column.addWidget(self.area, 1)
        column.addLayout(foot)

    def _fit_type(self) -> None:
        """Let margins follow the type."""
        unit = self.fontMetrics().height() / LINE_PX
        self._column.setContentsMargins(*(round(unit * margin) for margin in (12, 10, 8, 12)))
        self._column.setSpacing(round(unit * 10))
        self.progress.setFixedHeight(round(unit * StepBar.HEIGHT))

    def changeEvent(self, event: QEvent) -> None:
        """Follow the size of the type."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.StyleChange, QEvent.Type.FontChange):
            self._fit_type()

    def _connect(self) -> None:
        self.choice.activated.connect(lambda: self.chosen.emit(self.choice.currentData()))
        self.exit.clicked.connect(self.left)
        self.reveal.clicked.connect(self.asked)
        self.back.clicked.connect(lambda: self.moved.emit(-1))
        self.next.clicked.connect(lambda: self.moved.emit(1))
        self.area.verticalScrollBar().rangeChanged.connect(self._on_range)
        self.task.judged.connect(lambda: QTimer.singleShot(0, lambda: self.area.ensureWidgetVisible(self.task.check)))

    def show_step(self, lesson: Lesson, number: int, frame: StepFrame) -> None:
        """Show a step of a lesson, with its answer when it was told."""
        if (lesson, number, frame) == self._shown:
            return
        new, told = self._shown is None or (lesson, number) != self._shown[:2], frame.told
        self._shown = lesson, number, frame
        step, last = lesson.steps[number], len(lesson.steps) - 1
        select(self.choice, lesson.name)
        self.choice.setToolTip(lesson.title)  # the longest one is wider than the page
        links = (f'<a href="{escape(name)}">{escape(title)}</a>' for name, title in frame.blocks)
        texts = (
            (self.about, lesson.about if number == 0 else ""),
            (self.blocks, tr("Lessons of this lecture: {links}", links=" · ".join(links)) if frame.blocks else ""),
            (self.title, step.title),
            (self.text, rich(local(step.text))),
            (self.attempt, rich(local(f"**{tr('Try')}** {step.attempt}") if step.attempt else "")),
            (self.question, local(step.question)),
            (self.answer, rich(local(step.answer) if told else "")),
        )
        for label, text in texts:
            label.setText(unbroken(text))
            label.setVisible(bool(text))
        self.reveal.setText(tr("Show the solution") if step.task else tr("Show the answer"))
        self.reveal.setVisible(bool(step.question) and not told and frame.may_ask)
        self.count.setText(" · ".join(filter(None, (tr("step {k} of {n}", k=number + 1, n=last + 1), frame.key))))
        self.progress.show_step(number, last + 1)
        self.back.setEnabled(number > 0)
        self.next.setText(tr("Next") if number < last else frame.end)
        self._to_answer = told and not new
        if new:
            self.area.verticalScrollBar().setValue(0)

    def _on_range(self) -> None:
        """Bring an answer into view that has just been shown, its question above it where there is room for both."""
        if self._to_answer:
            QTimer.singleShot(0, self._stop_following)  # lines that wrap anew change the range more than once
            bar, foot = self.area.verticalScrollBar(), self.answer.geometry().bottom() + 1
            bar.setValue(max(bar.value(), min(self.question.y(), foot - self.area.viewport().height())))
        elif self.presenting:
            self.show_question()

    @property
    def whole_height(self) -> int:
        """Return the height at which all of the page is in view."""
        port = self.area.viewport()
        return self.height() - port.height() + self._inner.totalHeightForWidth(port.width())

    def show_question(self) -> None:
        """Scroll so far that the question is in view with its answers and *Check*."""
        last = self.task if self.task.isVisible() else self.question
        foot = last.geometry().bottom() + 1
        if last is self.task and self.task.check.isVisible():
            foot = self.task.y() + self.task.check.geometry().bottom() + 1
        wanted = min(self.question.y(), foot - self.area.viewport().height()) if self.question.isVisible() else 0
        self.area.verticalScrollBar().setValue(max(0, wanted))

    def _stop_following(self) -> None:
        self._to_answer = False


class StepBar(QWidget):
    """A bar of as many parts as the lesson has steps, filled up to the present one."""

    HEIGHT, GAP = 5, 4

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.number, self.count = 0, 1
        self.setFixedHeight(self.HEIGHT)

    def show_step(self, number: int, count: int) -> None:
        """Show that step ``number`` (from 0) of ``count`` is on."""
        self.number, self.count = number, count
        self.setAccessibleName(tr("step {k} of {n}", k=number + 1, n=count))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the parts, those to come in the colour of lines."""
        painter, colours = QPainter(self), self.palette()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        wide = (self.width() - self.GAP * (self.count - 1)) / self.count
        for k in range(self.count):
            role = QPalette.ColorRole.Highlight if k <= self.number else QPalette.ColorRole.Mid
            painter.setBrush(colours.color(role))
            painter.drawRoundedRect(QRectF(k * (wide + self.GAP), 0, wide, self.height()), 2, 2)


def rich(text: str) -> str:
    """Return Markdown as the HTML of a label with space between paragraphs, which a label's own Markdown lacks."""
    if not text:
        return ""
    document = QTextDocument()
    document.setMarkdown(text)
    body = document.toHtml().partition("<body")[2].partition(">")[2].partition("</body>")[0].strip()
    return body.replace("margin-top:6px; margin-bottom:6px", "margin-top:0px; margin-bottom:0px", 1).replace(
        "margin-top:6px; margin-bottom:6px", "margin-top:8px; margin-bottom:0px"
    )


def wrapped_label(name: str, form: Qt.TextFormat = Qt.TextFormat.PlainText) -> QLabel:
    """Return a label of several lines whose text a mouse can select."""
    made = QLabel()
    made.setObjectName(name)
    made.setWordWrap(True)
    made.setTextFormat(form)
    made.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return made
