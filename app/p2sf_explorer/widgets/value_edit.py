"""A number with its unit to type into, and a list of them."""

import re
from collections.abc import Callable, Sequence

from PySide6.QtCore import QEvent, QLocale, QSize, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QKeySequence, QMouseEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QLabel, QLineEdit, QSizePolicy, QWidget

from p2sf.errors import P2SFError
from p2sf_explorer.i18n.tr import decimal_separator, local, tr
from p2sf_explorer.state.scales import read_number, significant
from p2sf_explorer.state.state import entry
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Chooser
from p2sf_explorer.widgets.scrub import Scrub, claimed, notches
from p2sf_explorer.widgets.typed import typed

STANDARD = QKeySequence.StandardKey
EDITING = (STANDARD.Copy, STANDARD.Cut, STANDARD.Paste, STANDARD.SelectAll)


class ShortField(QLineEdit):
    """A field for a few letters, which leaves the window its shortcuts.

    On X11 a line edit takes Ctrl+E and Ctrl+K, as Emacs has them, which here are the snapshot and the palette. On every
    system it takes undo and redo, even where there is nothing to undo in it.
    """

    def event(self, event: QEvent) -> bool:
        """Claim no key with Ctrl but those of copying and pasting, and those of undoing what is being typed."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            if event.modifiers() & Qt.KeyboardModifier.ControlModifier and not self._claims(event):
                event.ignore()
                return True
        return super().event(event)

    def _claims(self, event: QKeyEvent) -> bool:
        undo = self.isUndoAvailable() and event.matches(STANDARD.Undo)
        redo = self.isRedoAvailable() and event.matches(STANDARD.Redo)
        return undo or redo or any(map(event.matches, EDITING))


class NumberBox(QDoubleSpinBox):
    """A number with arrow keys, its decimal separator that of the language, told when it is complete."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        edit = ShortField(self)
        edit.setObjectName("qt_spinbox_lineedit")  # as Qt's own, which is no part of its own to a screen reader
        self.setLineEdit(edit)
        self.setKeyboardTracking(False)
        language = QLocale(QLocale.Language.German if decimal_separator() == "," else QLocale.Language.C)
        language.setNumberOptions(QLocale.NumberOption.RejectGroupSeparator | QLocale.NumberOption.OmitGroupSeparator)
        self.setLocale(language)


class ValueEdit(ShortField):
    """A number with its unit; Return commits, Escape goes back, double-click asks for the reset.

    With a ``scrub`` (`let_scrub`) a drag on it, the wheel and ↑ ↓ move the value; a click starts typing.
    """

    committed = Signal(str)
    reset = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("value")
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.last = ""
        self.scrub: Scrub | None = None
        self.fine_arrows = True  # Alt and an arrow move the value, rather than a lesson
        self._typing = False
        self.editingFinished.connect(self._commit)

    def let_scrub(self) -> Scrub:
        """Have the value follow hand, wheel and arrow keys; return the signals of these moves."""
        self.scrub = Scrub(self)
        self.setCursor(Qt.CursorShape.SizeHorCursor)
        return self.scrub

    def set_text(self, text: str) -> None:
        """Show a value, unless another is being typed."""
        self.last = text = local(text)
        if not (self.hasFocus() and self.isModified()) and self.text() != text:
            whole = self.hasSelectedText() and self.selectedText() == self.text()
            self.setText(text)
            if whole:
                self.selectAll()  # what is typed next still replaces the number

    def _commit(self) -> None:
        self._type(False)
        if self.isModified():
            text = self.text()
            self.setModified(False)
            if text != self.last:
                self.committed.emit(text)
            self.setText(self.last)  # in the standard form, also where the number has stayed the same

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Get ready to be dragged, unless a number is being typed."""
        if self.scrub and not self._typing and event.button() == Qt.MouseButton.LeftButton:
            self.scrub.press(event.position().x())
        else:
            super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the value, or select what is typed."""
        if self.scrub and self.scrub.pressed:
            self.scrub.drag(event.position().x(), event.modifiers())
        elif not (self.scrub and not self._typing):
            super().mouseMoveEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End the move; a click without one starts typing."""
        if not (self.scrub and self.scrub.pressed):
            super().mouseReleaseEvent(event)
        elif not self.scrub.end():
            self._type(True)
            self.selectAll()

    def _type(self, typing: bool) -> None:
        self._typing = typing
        if self.scrub:
            self.setCursor(Qt.CursorShape.IBeamCursor if typing else Qt.CursorShape.SizeHorCursor)

    def event(self, event: QEvent) -> bool:
        """Keep the keys that move the value from the window's shortcuts."""
        scrub = self.scrub
        return bool(scrub and claimed(event, UP_DOWN, scrub.active, self.fine_arrows)) or super().event(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Move the value by the wheel."""
        if self.scrub and self.isEnabled() and not self.isModified():
            self.scrub.step(notches(event), event.modifiers())
            event.accept()
        else:
            super().wheelEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take back with Escape what was typed or moved; move the value by ↑ and ↓."""
        if event.key() == Qt.Key.Key_Escape:
            if not (self.scrub and self.scrub.cancel()):
                self.setModified(False)
                self.setText(self.last)
        elif self.scrub and event.key() in UP_DOWN:
            self.setModified(False)
            self.scrub.step(UP_DOWN[event.key()], event.modifiers())
        else:
            super().keyPressEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Begin to type where the focus comes by a key."""
        super().focusInEvent(event)
        if event.reason() != Qt.FocusReason.MouseFocusReason:
            self._type(True)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """End moves and typing."""
        self._type(False)
        if self.scrub:
            self.scrub.end()
        super().focusOutEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask for the reset, and select the number, so that typing replaces it; Qt then sees a third click too."""
        super().mouseDoubleClickEvent(event)
        self.setModified(False)
        self.selectAll()
        self.reset.emit()


UP_DOWN: dict[int, int] = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1}
DECADES = 4.0  # of a length, over all of a scrub's travel
MICRONS = {"": 1.0, "µm": 1.0, "um": 1.0, "mm": 1e3}


class MicronEdit(QWidget):
    """A length in µm of the state; what cannot be is refused with a message."""

    def __init__(self, store: Store, key: str, label: str, tip: str, parent: QWidget | None = None):
        super().__init__(parent)
        self._store, self._key, self._label = store, key, label
        self.edit = ValueEdit(self)
        self.edit.setProperty("short", True)
        self.edit.setAccessibleName(tr(label))
        self.setToolTip(tr(tip))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)  # label and number stay together
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(QLabel(tr(label), self))
        row.addWidget(self.edit)
        self.edit.committed.connect(self._commit)
        self._before = 0.0
        scrub = self.edit.let_scrub()
        scrub.begun.connect(self._grasp)
        scrub.moved.connect(lambda by: store.update(**{key: self._before * 10 ** (DECADES * by)}))
        scrub.ended.connect(store.end)
        scrub.cancelled.connect(store.cancel)

    def _grasp(self) -> None:
        self._store.begin()
        self._before = entry(self._store.state, self._key)

    def show_value(self, value: float) -> None:
        """Show the state's value."""
        self.edit.set_text(f"{significant(value, 3)} µm")

    def _commit(self, text: str) -> None:
        try:
            self._store.update(**{self._key: read_number(typed(text), self._label.lower(), MICRONS)})
        except P2SFError as error:
            self._store.refused.emit(error)
        self.show_value(entry(self._store.state, self._key))


BETWEEN = re.compile(r"(?<!\s)\s*+;\s*|,\s+")  # a comma without a space is a decimal comma
SPACE_PX = 4  # pixels between the parts of a list
COUNT_TIP = "How many, evenly spread; this replaces typed values"
LIST_TIP = "Values separated by semicolons; empty: evenly spread automatically"


def read_list(text: str, read: Callable[[str], float]) -> tuple[float, ...]:
    """Return the values of a list that a person typed; none for an empty one. Raises P2SFError as ``read`` does."""
    return tuple(read(item) for item in BETWEEN.split(text.strip()) if item)


class ValueList(QWidget):
    """A name, a number of values where ``counts`` are offered, and the values themselves.

    The name gives way where it would leave the values too little room.
    ``counted`` tells a chosen number, ``listed`` values that were typed, ``refused`` why a text is no list of values.
    """

    counted = Signal(int)
    listed = Signal(tuple)
    refused = Signal(object)

    def __init__(self, counts: Sequence[int] = (), parent: QWidget | None = None):
        super().__init__(parent)
        self._read: Callable[[str], float] = float
        self.label, self.count, self.edit = QLabel(self), Chooser(self), ValueEdit(self)
        self.label.setObjectName("muted")
        self.count.setObjectName("small")
        self.count.setToolTip(tr(COUNT_TIP))
        for number in counts:
            self.count.addItem(str(number), number)
        self.count.setVisible(bool(counts))
        self.edit.setProperty("list", True)
        self.edit.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignLeft)
        self.edit.setToolTip(tr(LIST_TIP))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(SPACE_PX)
        for part in (self.label, self.count, self.edit):
            row.addWidget(part, int(part is self.edit))
        self.count.activated.connect(lambda: self.counted.emit(self.count.currentData()))
        self.edit.committed.connect(self._commit)
        self.edit.reset.connect(lambda: self.listed.emit(()))

    def name(self, words: str, read: Callable[[str], float]) -> None:
        """Give the list a name, as it is, and the reader of one value."""
        self._read = read
        if words != self.label.text():
            self.label.setText(words)
            self.edit.setAccessibleName(words)
            self.count.setAccessibleName(f"{words}: {tr(COUNT_TIP)}")

    def sizeHint(self) -> QSize:
        """Return the size in which all values can be read."""
        parts = (self.label, self.count) if self.count.isVisibleTo(self) else (self.label,)
        words = self.edit.fontMetrics().horizontalAdvance(self.edit.text() + "MM")  # and the paddings
        return QSize(words + sum(part.sizeHint().width() + SPACE_PX for part in parts), super().sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave the name out where the values would be cut."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        self.label.setVisible(self.width() >= self.sizeHint().width())

    def show_values(self, texts: Sequence[str]) -> None:
        """Show values as they are written."""
        before = self.edit.text()
        self.edit.set_text("; ".join(texts))
        if self.edit.text() != before:
            self.updateGeometry()
            self._fit()
        self.edit.setCursorPosition(0) if not self.edit.hasFocus() else None
        place = self.count.findData(len(texts))
        if place != self.count.currentIndex():
            self.count.setCurrentIndex(place)

    def _commit(self, text: str) -> None:
        try:
            self.listed.emit(read_list(text, lambda item: self._read(typed(item))))
        except P2SFError as error:
            self.refused.emit(error)
