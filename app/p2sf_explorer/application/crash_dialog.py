"""The dialog of an unexpected error: what was lost, and a report to copy."""

import sys
import threading
from collections.abc import Callable
from traceback import TracebackException
from types import TracebackType

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QFontDatabase, QGuiApplication
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from p2sf_explorer.application.crash_report import place_lines, report
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.state import State

WHAT = "The explorer has made a mistake."
KEPT = "Nothing is lost: the window is saved as it is now, and the next start shows it again."
NOT_KEPT = "The window could not be saved because its folder is not writable; save what you need with Ctrl+E."
WHAT_NOW = (
    "You can go on. If something looks wrong, undo the last step (Ctrl+Z), or close the explorer and start it again."
)
HOW_TO_REPORT = (
    "To report it, copy the text below and send it to the authors. It names versions and places in the program, but "
    "none of your folders or files."
)
COPY, COPIED = "Copy the report", "Copied"
WIDE, TALL = 640, 460


class UnexpectedErrors(QObject):
    """Takes the errors that nobody caught, in whichever thread, and shows the dialog for the first of each kind.

    ``window()`` is the window, ``state()`` what it shows, ``keep()`` saves it and returns whether it could.
    """

    _happened = Signal(object)  # a TracebackException

    def __init__(
        self, window: Callable[[], QWidget], state: Callable[[], State], keep: Callable[[], bool], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._window, self._state, self._keep = window, state, keep
        self.dialog: CrashDialog | None = None
        self._known: set[str] = set()
        # Queued, since a dialog opened in the middle of a paint event would end the process.
        self._happened.connect(self._show, Qt.ConnectionType.QueuedConnection)

    def install(self) -> None:
        """Take errors from now on; they go to standard error as well."""
        sys.excepthook = self._hook
        threading.excepthook = lambda told: self._hook(
            told.exc_type, told.exc_value or told.exc_type(), told.exc_traceback
        )

    def _hook(self, kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        sys.__excepthook__(kind, error, trace)
        if issubclass(kind, Exception):
            self._happened.emit(TracebackException(kind, error, trace))

    def _show(self, error: TracebackException) -> None:
        place = "".join(place_lines(error.stack)[-1:])
        if place in self._known:
            return  # one that comes with every frame is told once
        self._known.add(place)
        text = report(error, self._state())
        if self.dialog and self.dialog.isVisible():
            self.dialog.add(text)
            return
        self.dialog = CrashDialog(text, self._keep(), self._window())
        self.dialog.open()


class CrashDialog(QDialog):
    """Says what was lost and shows the report, with buttons to copy it, to go on, and to close the window."""

    def __init__(self, text: str, kept: bool, window: QWidget) -> None:
        super().__init__(window)
        self.setObjectName("window")
        self.setWindowTitle(tr("Unexpected error"))
        self.text = QPlainTextEdit(text, self)
        self.text.setReadOnly(True)
        self.text.setAccessibleName(tr("Report"))
        self.text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.copy, go_on = QPushButton(tr(COPY), self), QPushButton(tr("Go on"), self)
        close = QPushButton(tr("Close the explorer"), self)
        self.copy.clicked.connect(self._copy)
        go_on.clicked.connect(self.accept)
        close.clicked.connect(self.reject)
        close.clicked.connect(window.close)
        go_on.setDefault(True)
        column, row = QVBoxLayout(self), QHBoxLayout()
        texts = tr(WHAT), tr(KEPT if kept else NOT_KEPT), tr(WHAT_NOW), tr(HOW_TO_REPORT)
        for number, words in enumerate(texts):
            label = QLabel(words, self)
            label.setWordWrap(True)
            label.setObjectName("" if number else "sentence")
            column.addWidget(label)
        column.addWidget(self.text, 1)
        row.addWidget(self.copy)
        row.addStretch(1)
        row.addWidget(close)
        row.addWidget(go_on)
        column.addLayout(row)
        self.resize(WIDE, TALL)

    def add(self, text: str) -> None:
        """Add the report of another error that came while the dialog is open."""
        self.text.appendPlainText(f"\n{text}")

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(self.text.toPlainText())
        self.copy.setText(tr(COPIED))
