"""What the writers of files warn of, such as a hard link that was cut, in the banner of the window."""

import warnings
from collections.abc import Callable
from typing import TextIO

from PySide6.QtCore import QObject, Qt, Signal

from p2sf.errors import FileWarning
from p2sf.messages import Message


class FileWarnings(QObject):
    """Takes the warnings of files, in whichever thread; ``show`` is called with each, others go where they went."""

    _happened = Signal(object)  # a Message

    def __init__(self, show: Callable[[Message], object], parent: QObject) -> None:
        super().__init__(parent)
        self._before = warnings.showwarning
        # Queued, so that a thread that writes does not paint.
        self._happened.connect(show, Qt.ConnectionType.QueuedConnection)

    def install(self) -> None:
        """Take warnings from now on."""
        warnings.simplefilter("always", FileWarning)
        warnings.showwarning = self._take

    def _take(
        self,
        message: Warning | str,
        category: type[Warning],
        filename: str,
        lineno: int,
        file: TextIO | None = None,
        line: str | None = None,
    ) -> None:
        if isinstance(message, FileWarning):
            self._happened.emit(message.args[0])
        else:
            self._before(message, category, filename, lineno, file, line)
