"""What lies over a panel while there is no answer: the picture before shines through faintly, a sentence says so."""

from PySide6.QtCore import QEvent, QRectF, Qt
from PySide6.QtGui import QPainter, QPalette
from PySide6.QtWidgets import QWidget

from p2sf_explorer.i18n.tr import tr, unbroken

COVER = 0.9  # of the light: so little is left of an earlier picture that nobody reads figures off it
MARGIN = 12


class Overlay(QWidget):
    """Covers its parent but for the title line; what is beneath still takes the mouse, for it may be the remedy."""

    def __init__(self, parent: QWidget):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.text = ""
        parent.installEventFilter(self)
        self.hide()

    def say(self, sentence: str, top: int) -> None:
        """Cover the parent from ``top`` pixels on with a sentence, or uncover it for an empty one."""
        self.text, self._top = unbroken(tr(sentence)), top
        self.setVisible(bool(sentence))
        self._cover()

    def eventFilter(self, parent, event) -> bool:
        """Grow with the parent."""
        if event.type() == QEvent.Type.Resize and self.text:
            self._cover()
        return False

    def _cover(self) -> None:
        self.setGeometry(self.parentWidget().rect().adjusted(1, self._top, -1, -1))
        self.raise_()
        self.update()

    def paintEvent(self, event) -> None:
        """Paint the veil and its sentence."""
        painter, ground = QPainter(self), self.palette().color(QPalette.ColorRole.Base)
        ground.setAlphaF(COVER)
        painter.fillRect(self.rect(), ground)
        painter.setPen(self.palette().color(QPalette.ColorRole.Text))
        room = QRectF(self.rect()).adjusted(MARGIN, 0, -MARGIN, 0)
        painter.drawText(room, Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, self.text)
