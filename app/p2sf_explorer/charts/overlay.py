"""A message over a dimmed panel that has no current result."""

from PySide6.QtCore import QEvent, QObject, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QWidget

from p2sf_explorer.i18n.tr import unbroken

COVER = 0.9  # opacity: so little is left of an earlier picture that nobody reads figures off it
MARGIN = 12


class Overlay(QWidget):
    """Does not block the mouse: the controls beneath may fix the problem."""

    def __init__(self, parent: QWidget):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.text = ""
        self._top = 0
        parent.installEventFilter(self)
        self.hide()

    def say(self, sentence: str, top: int) -> None:
        """Cover the parent from ``top`` pixels down with a sentence, as it is; uncover it for an empty one."""
        self.text, self._top = unbroken(sentence), top
        self.setVisible(bool(sentence))
        self._cover()

    def eventFilter(self, parent: QObject, event: QEvent) -> bool:
        """Follow the parent's size."""
        if event.type() == QEvent.Type.Resize and self.text:
            self._cover()
        return False

    def _cover(self) -> None:
        if parent := self.parentWidget():
            self.setGeometry(parent.rect().adjusted(1, self._top, -1, -1))
        self.raise_()
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the ground and the sentence."""
        painter, ground = QPainter(self), self.palette().color(QPalette.ColorRole.Base)
        ground.setAlphaF(COVER)
        painter.fillRect(self.rect(), ground)
        painter.setPen(self.palette().color(QPalette.ColorRole.Text))
        room = QRectF(self.rect()).adjusted(MARGIN, 0, -MARGIN, 0)
        painter.drawText(room, Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, self.text)
