"""The question of a step, large over the stage, with a countdown, and then its answer."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from p2sf_explorer.i18n.tr import local, tr, unbroken

if TYPE_CHECKING:
    from p2sf_explorer.lessons.lesson import Step

SECONDS = 60
LINES, FEWEST_PX = 22, 14  # lines of type on the height of a stage; the smallest type
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


class HallCard(QFrame):
    """Lies over the ``stage``; type as large as the stage and the text allow."""

    def __init__(self, stage: QWidget) -> None:
        super().__init__(stage)
        self.setObjectName("card")
        self._stage = stage
        self.question, self.body = QLabel(self), QLabel(self)
        for label in (self.question, self.body):
            label.setWordWrap(True)
        self.question.setTextFormat(Qt.TextFormat.PlainText)
        self.countdown = Countdown(self)
        self._head = head = QHBoxLayout()
        head.addWidget(self.question, 1)
        head.addWidget(self.countdown, 0, Qt.AlignmentFlag.AlignTop)
        self._column = QVBoxLayout(self)
        self._column.addLayout(head)
        self._column.addWidget(self.body)
        self._told = False
        stage.installEventFilter(self)
        self.hide()

    def ask(self, step: "Step") -> None:
        """Show the question of a step, with its options by their letters, and start the countdown."""
        self._fill(step, False)
        self.countdown.begin()

    def tell(self, step: "Step") -> None:
        """Show the answer under the question, and of the options the right one."""
        self.countdown.stop()
        self._fill(step, True)

    def put_away(self) -> None:
        """Show the stage again."""
        self.countdown.stop()
        self.hide()

    @property
    def told(self) -> bool:
        """Return whether the answer is on show."""
        return self.isVisible() and self._told

    def _fill(self, step: "Step", told: bool) -> None:
        from p2sf_explorer.lessons.lesson_panel import rich

        self._told = told
        self.question.setText(unbroken(local(step.question)))
        parts = options_of(step, told)
        if told:
            parts.append(rich(local(step.answer)))
        self.body.setText("".join(parts))
        self.body.setVisible(bool(parts))
        self.countdown.setVisible(not told)
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
        wide, most = round(0.94 * room.width()), round(0.94 * room.height())
        for pixels in range(max(FEWEST_PX, room.height() // LINES), FEWEST_PX - 1, -1):
            style = f"font-size: {pixels}px;"
            self.question.setStyleSheet(f"{style} font-weight: 600;")
            self.body.setStyleSheet(style)
            self._column.setContentsMargins(pixels, pixels, pixels, pixels)
            self.countdown.setFixedSize(4 * pixels, 4 * pixels)
            for label in (self.question, self.body):
                label.ensurePolished()  # its type is known only then
            self._head.invalidate()
            self._column.invalidate()
            high = self._column.totalHeightForWidth(wide)
            if high <= most:
                break
        high = min(high, most)
        top = room.height() - high - round(0.03 * room.height()) if self._told else (room.height() - high) // 2
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
