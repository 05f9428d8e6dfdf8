"""What a panel shows before it has anything to show: what to drop there, and buttons that begin."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from p2sf_explorer.charts.theme import SPACE

DASHES = 4.0, 4.0  # pens long
ROUND, AIR = 10.0, 1.5  # pixels: of the corners, and outside of the frame
WIDEST = 420  # pixels of a line of words


class EmptyState(QWidget):
    """Words and buttons in the middle of a dashed frame, into which a file may be dropped; texts are translated."""

    def __init__(self, title: str, words: str, buttons: tuple[QWidget, ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        head = QLabel(title, self)
        text = self.words = QLabel(words, self)
        head.setObjectName("sentence")
        text.setObjectName("muted")
        for label in (head, text):
            label.setWordWrap(True)
            label.setAlignment(Qt.AlignmentFlag.AlignCenter)
            label.setMaximumWidth(WIDEST)
        column, row = QVBoxLayout(self), QHBoxLayout()
        column.setContentsMargins(2 * SPACE, SPACE, 2 * SPACE, SPACE)
        row.addStretch(1)
        for button in buttons:
            row.addWidget(button)
        row.addStretch(1)
        column.addStretch(1)
        for label in (head, text):
            line = QHBoxLayout()
            line.addWidget(label)
            column.addLayout(line)
        column.addLayout(row)
        column.addStretch(1)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the frame."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(QColor(self.palette().color(QPalette.ColorRole.PlaceholderText)), 1.0)
        pen.setDashPattern(list(DASHES))
        painter.setPen(pen)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(AIR, AIR, -AIR, -AIR), ROUND, ROUND)
