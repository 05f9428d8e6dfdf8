"""Files and links that a desktop hands to the running explorer, as macOS does."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QFileOpenEvent

from p2sf_explorer.state.link import PREFIX


class OpenEvents(QObject):
    """Opens what arrives: ``open_path`` a file, ``open_link`` a ``p2sf:`` link."""

    def __init__(self, open_path: Callable[[str], object], open_link: Callable[[str], object], parent: QObject) -> None:
        super().__init__(parent)
        self._open_path, self._open_link = open_path, open_link
        parent.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Open the file or link of the event."""
        if not isinstance(event, QFileOpenEvent):
            return False
        link = event.url().toString()
        self._open_link(link) if link.startswith(PREFIX) else self._open_path(event.file())
        return True
