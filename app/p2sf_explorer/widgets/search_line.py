"""A line to search with, beside the list of what is found."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit, QListWidget, QWidget

STEPS = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)


class SearchLine(QLineEdit):
    """A line whose keys up and down choose in the list ``found``."""

    def __init__(self, found: QListWidget, parent: QWidget) -> None:
        super().__init__(parent)
        self._found = found

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Hand the keys that choose on to the list."""
        if event.key() in STEPS:
            self._found.event(event)
        else:
            super().keyPressEvent(event)
