"""A number with its unit to type into, and the button that plays its slider."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLineEdit, QToolButton

from p2sf_explorer.i18n.tr import tr


class PlayButton(QToolButton):
    """A small ▶ beside a slider."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setObjectName("flat")
        self.setText("▶")
        self.setToolTip(tr("Play this slider (Space)"))
        self.setFixedSize(22, 22)


class ValueEdit(QLineEdit):
    """A number with its unit; Return commits, Escape goes back, double-click asks for the reset."""

    committed = Signal(str)
    reset = Signal()

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setObjectName("value")
        self.setFixedWidth(96)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.last = ""
        self.editingFinished.connect(self._commit)

    def set_text(self, text: str) -> None:
        """Show a value, unless a person is in the middle of typing another."""
        self.last = text
        if not (self.hasFocus() and self.isModified()) and self.text() != text:
            self.setText(text)

    def _commit(self) -> None:
        if self.isModified() and self.text() != self.last:
            self.setModified(False)
            self.committed.emit(self.text())
            self.setText(self.last)  # as written by now, also where the number typed is the one there was

    def keyPressEvent(self, event) -> None:
        """Let Escape take the typing back."""
        if event.key() == Qt.Key.Key_Escape:
            self.setModified(False)
            self.setText(self.last)
            return
        super().keyPressEvent(event)

    def mouseDoubleClickEvent(self, event) -> None:
        """Ask for the reset."""
        self.setModified(False)
        self.reset.emit()
