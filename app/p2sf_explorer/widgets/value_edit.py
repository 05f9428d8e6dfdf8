"""A number with its unit to type into, and the button that plays its slider."""

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QMouseEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QToolButton, QWidget

from p2sf.errors import P2SFError
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.state.scales import read_number, significant
from p2sf_explorer.state.state import entry
from p2sf_explorer.store.store import Store


class PlayButton(QToolButton):
    """A small ▶ beside a slider."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("flat")
        self.setText("▶")
        self.setToolTip(tr("Play this slider (Space)"))
        self.setFixedSize(22, 22)


STANDARD = QKeySequence.StandardKey
EDITING = (STANDARD.Copy, STANDARD.Cut, STANDARD.Paste, STANDARD.SelectAll, STANDARD.Undo, STANDARD.Redo)


class ShortField(QLineEdit):
    """A field for a few letters, which leaves the window its shortcuts.

    On X11 a line edit takes Ctrl+E and Ctrl+K, as Emacs has them, which here are the snapshot and the palette.
    """

    def event(self, event: QEvent) -> bool:
        """Claim no key with Ctrl but those of copying, pasting and undoing."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            if event.modifiers() & Qt.KeyboardModifier.ControlModifier and not any(map(event.matches, EDITING)):
                event.ignore()
                return True
        return super().event(event)


class ValueEdit(ShortField):
    """A number with its unit; Return commits, Escape goes back, double-click asks for the reset."""

    committed = Signal(str)
    reset = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("value")
        self.setFixedWidth(96)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.last = ""
        self.editingFinished.connect(self._commit)

    def set_text(self, text: str) -> None:
        """Show a value, unless another is being typed."""
        self.last = text = local(text)
        if not (self.hasFocus() and self.isModified()) and self.text() != text:
            self.setText(text)

    def _commit(self) -> None:
        if self.isModified() and self.text() != self.last:
            self.setModified(False)
            self.committed.emit(self.text())
            self.setText(self.last)  # in the standard form, also where the number has stayed the same

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take back with Escape what was typed."""
        if event.key() == Qt.Key.Key_Escape:
            self.setModified(False)
            self.setText(self.last)
            return
        super().keyPressEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask for the reset."""
        self.setModified(False)
        self.reset.emit()


MICRONS = {"": 1.0, "µm": 1.0, "um": 1.0, "mm": 1e3}


class MicronEdit(QWidget):
    """A length in µm of the state; what cannot be is refused with a message."""

    def __init__(self, store: Store, key: str, label: str, tip: str, parent: QWidget | None = None):
        super().__init__(parent)
        self._store, self._key, self._label = store, key, label
        self.edit = ValueEdit(self)
        self.edit.setFixedWidth(78)
        self.edit.setAccessibleName(tr(label))
        self.setToolTip(tr(tip))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(QLabel(tr(label), self))
        row.addWidget(self.edit)
        self.edit.committed.connect(self._commit)

    def show_value(self, value: float) -> None:
        """Show the state's value."""
        self.edit.set_text(f"{significant(value, 3)} µm")

    def _commit(self, text: str) -> None:
        try:
            self._store.update(**{self._key: read_number(text, self._label.lower(), MICRONS)})
        except P2SFError as error:
            self._store.refused.emit(error)
        self.show_value(entry(self._store.state, self._key))
