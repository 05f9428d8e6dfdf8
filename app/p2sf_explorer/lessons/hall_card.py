"""The question of a step, large over the stage, with a countdown for each of two votes, and then its answer."""

from enum import Enum
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

from p2sf_explorer.i18n.tr import local, tr, unbroken
from p2sf_explorer.lessons.task_record import LONGEST
from p2sf_explorer.lessons.votes import Votes

if TYPE_CHECKING:
    from p2sf_explorer.lessons.lesson import Step

SECONDS = 60
LINES, FEWEST_PX = 22, 14  # lines of type on the height of a stage; the smallest type
WHOLE, FOOT = 0.94, 0.3  # of the stage's height that the card may take: all, and the foot below the picture it tells of
VOTE = "A letter counts a raised hand, Backspace takes it back · counted: {count}"
AGAIN = "Discuss it with a neighbour, then vote again · counted: {count}"
ROUND = 16  # the unit of Qt's angles, of a degree


class Countdown(QWidget):
    """Seconds in a ring that empties; a click stops it, or lets it go on."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.left = 0
        self._timer = QTimer(self, interval=1000)
        self._timer.timeout.connect(self._tick)
        self.setToolTip(tr("Click, or press T, to stop the countdown or let it go on"))

    def begin(self) -> None:
        """Count down from the start."""
        self._show(SECONDS)
        self._timer.start()

    def stop(self) -> None:
        """Stop counting."""
        self._timer.stop()

    def turn(self) -> None:
        """Stop, or go on."""
        if self._timer.isActive():
            self.stop()
        elif self.left:
            self._timer.start()

    def _tick(self) -> None:
        self._show(self.left - 1)
        if not self.left:
            self.stop()

    def _show(self, left: int) -> None:
        self.left = left
        self.setAccessibleName(tr("{count} seconds left", count=left))
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Stop, or go on."""
        self.turn()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the ring and the seconds in it."""
        painter, side = QPainter(self), min(self.width(), self.height())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        wide = side / 14
        ring = QRectF(wide, wide, side - 2 * wide, side - 2 * wide)
        for role, share in ((QPalette.ColorRole.Mid, 1.0), (QPalette.ColorRole.Highlight, self.left / SECONDS)):
            painter.setPen(QPen(self.palette().color(role), wide))
            painter.drawArc(ring, 90 * ROUND, -round(360 * ROUND * share))
        font = painter.font()
        font.setPixelSize(max(1, side // 3))
        painter.setFont(font)
        painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
        painter.drawText(ring, Qt.AlignmentFlag.AlignCenter, str(self.left))


class Phase(Enum):
    """What the card shows: the question for a first and a second vote, the right option, all of the answer."""

    FIRST = 1
    SECOND = 2
    SEEN = 3
    TOLD = 4


ASKED = Phase.FIRST, Phase.SECOND


def phases(step: "Step") -> tuple[Phase, ...]:
    """Return what is shown of a step's question in turn: without options there is no second vote."""
    return tuple(Phase) if options_of(step, False) else (Phase.FIRST, Phase.TOLD)


class HallCard(QFrame):
    """Lies over the ``stage``; type as large as the stage and the text allow."""

    def __init__(self, stage: QWidget) -> None:
        super().__init__(stage)
        self.setObjectName("card")
        self._stage = stage
        self.question, self.body, self.count = QLabel(self), QLabel(self), QLabel(self)
        self.count.setObjectName("muted")
        for label in (self.question, self.body, self.count):
            label.setWordWrap(True)
        self.question.setTextFormat(Qt.TextFormat.PlainText)
        self.because = QLineEdit(self)
        self.because.setPlaceholderText(tr("Because … (Enter to type)"))
        self.because.setAccessibleName(tr("Because"))
        self.because.setMaxLength(LONGEST)
        self.countdown = Countdown(self)
        self._head = head = QHBoxLayout()
        head.addWidget(self.question, 1)
        head.addWidget(self.countdown, 0, Qt.AlignmentFlag.AlignTop)
        self._column = QVBoxLayout(self)
        self._column.addLayout(head)
        for part in (self.body, self.because, self.count):
            self._column.addWidget(part)
        self.phase, self._votes, self._marked = Phase.FIRST, Votes(), ""
        self._step: Step | None = None
        stage.installEventFilter(self)
        self.hide()

    @property
    def voting(self) -> int:
        """Return how many options may be voted for now."""
        step = self._step if self.isVisible() and self.phase in ASKED else None
        return len(options_of(step, False)) if step else 0

    def show_phase(self, step: "Step", phase: Phase, votes: Votes, marked: str = "") -> None:
        """Show a step's question for a vote and start the countdown, or the right option, or the answer.

        ``marked`` says what was marked on the picture beside what is true.
        """
        if phase is Phase.FIRST:
            self.because.clear()
        self.because.clearFocus()
        self.phase, self._step, self._marked = phase, step, marked
        if phase in ASKED:
            self.countdown.begin()
        else:
            self.countdown.stop()
        self.show_votes(votes)

    def show_votes(self, votes: Votes) -> None:
        """Show the card with how many votes were counted, and after both votes how many each option got."""
        self._votes = votes
        self._fill()

    def put_away(self) -> None:
        """Show the stage again."""
        self.countdown.stop()
        self.hide()

    @property
    def told(self) -> bool:
        """Return whether the answer is on show."""
        return self.isVisible() and self.phase is Phase.TOLD

    def _fill(self) -> None:
        from p2sf_explorer.lessons.lesson_panel import rich

        if self._step is None:
            return
        step, asked = self._step, self.phase in ASKED
        options = options_of(step, not asked)
        parts = options if asked else [*options, *votes_of(step, self._votes)]
        parts += [f"<p>{self._marked}</p>"] if self._marked else []
        if self.phase is Phase.TOLD:
            parts.append(rich(local(step.answer)))
        self.question.setText(unbroken(local(step.question)))
        self.question.setVisible(asked or not options)  # the picture that answers it needs the room
        self.body.setText("".join(parts))
        self.body.setVisible(bool(parts))
        self.because.setVisible(bool(options) and not asked)
        self.count.setText(tr(VOTE if self.phase is Phase.FIRST else AGAIN, count=len(self._votes.counted)))
        self.count.setVisible(bool(options) and asked)
        self.countdown.setVisible(asked)
        self.show()
        self.raise_()
        self._place()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the stage."""
        if event.type() == QEvent.Type.Resize and self.isVisible():
            self._place()
        return False

    def _place(self) -> None:
        """Take the largest type with which the text fits: in the middle of the stage, an answer at its foot."""
        room = self._stage.size()
        told = self.phase not in ASKED
        sees = bool(self._step and self._step.task and self._step.task.see)
        wide, most = round(WHOLE * room.width()), round((FOOT if told and sees else WHOLE) * room.height())
        for pixels in range(max(FEWEST_PX, room.height() // LINES), FEWEST_PX - 1, -1):
            style = f"font-size: {pixels}px;"
            self.question.setStyleSheet(f"{style} font-weight: 600;")
            for part in (self.body, self.because):
                part.setStyleSheet(style)
            self._column.setContentsMargins(pixels, pixels, pixels, pixels)
            self.countdown.setFixedSize(4 * pixels, 4 * pixels)
            for label in (self.question, self.body, self.because):
                label.ensurePolished()  # its type is known only then
            self._head.invalidate()
            self._column.invalidate()
            high = self._column.totalHeightForWidth(wide)
            if high <= most:
                break
        high = min(high, most)
        top = room.height() - high - round(0.03 * room.height()) if told else (room.height() - high) // 2
        self.setGeometry((room.width() - wide) // 2, top, wide, high)


def options_of(step: "Step", told: bool) -> list[str]:
    """Return the options of a choice as lines of HTML; only the right one once it is ``told``."""
    from p2sf_explorer.lessons.answer_fields import letter
    from p2sf_explorer.lessons.lesson_panel import rich
    from p2sf_explorer.lessons.task import ChoiceAnswer, display_order

    task = step.task
    if task is None or not isinstance(task.answer, ChoiceAnswer):
        return []
    lines = []
    for place, number in enumerate(display_order(task)):
        words = rich(local(task.answer.options[number])).replace("<p ", "<span ").replace("</p>", "</span>")
        if not told or number == task.answer.right:
            lines.append(f"<p>{'✓ ' if told else ''}<b>{letter(place)}</b>&nbsp; {words}</p>")
    return lines


def votes_of(step: "Step", votes: Votes) -> list[str]:
    """Return a line of HTML with the votes for each option, at first and after the discussion; none without votes."""
    from p2sf_explorer.lessons.answer_fields import letter

    if not (votes.first or votes.second):
        return []
    places = range(len(options_of(step, False)))
    counts = (f"<b>{letter(place)}</b>&nbsp;{' → '.join(map(str, votes.of(place)))}" for place in places)
    return [f"<p>{tr('Votes: {counts}', counts=' · '.join(counts))}</p>"]
