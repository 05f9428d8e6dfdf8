"""Dropped links and files on the window, and photos on the panel that shows them."""

from pathlib import Path

from PySide6.QtCore import QEvent, QMimeData, QObject, Signal
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QWidget

from p2sf.io.photo_files import READABLE
from p2sf.messages import Message
from p2sf_explorer.files.embedded_state import text_inside
from p2sf_explorer.files.opening import is_file
from p2sf_explorer.state.link import is_link

OTHER_PICTURES = (".jpg", ".jpeg", ".gif", ".bmp", ".webp", ".heic", ".avif", ".raw", ".dng", ".cr2", ".nef", ".arw")


class PhotoDrop(QObject):
    """Watches a widget for dropped pictures: ``photo`` carries the path to open, ``refused`` a message why not.

    Other files are left to the window, which opens lenses and states.
    """

    photo = Signal(str)
    refused = Signal(object)

    def __init__(self, widget: QWidget):
        super().__init__(widget)
        widget.setAcceptDrops(True)
        widget.installEventFilter(self)

    def eventFilter(self, _widget: QObject, event: QEvent) -> bool:
        """Take pictures."""
        if not isinstance(event, QDragEnterEvent | QDropEvent):
            return False
        path = dropped_picture(event.mimeData())
        if path is None:
            event.ignore()
            return True
        event.acceptProposedAction()
        if event.type() == QEvent.Type.Drop:
            self.take(Path(path))
        return True

    def take(self, path: Path) -> None:
        """Take a picture as if it had been dropped here."""
        if path.suffix.lower() in READABLE:
            self.photo.emit(str(path))
        else:
            why = "{file} is no PNG or TIFF; save the photo as one of these and drop that"
            self.refused.emit(Message(why, file=path.name))


def is_photo(path: str) -> bool:
    """Return whether a file has the ending of a picture and, unlike a snapshot, no state in it."""
    return Path(path).suffix.lower() in (*READABLE, *OTHER_PICTURES) and text_inside(path) is None


def dropped_picture(data: QMimeData) -> str | None:
    """Return the path of the first dropped file with the ending of a picture; None where there is none."""
    paths = (url.toLocalFile() for url in data.urls())
    return next((path for path in paths if Path(path).suffix.lower() in (*READABLE, *OTHER_PICTURES)), None)


def dropped(data: QMimeData) -> str | None:
    """Return a dropped link, or the path of a file, whose content decides when it is opened; None for anything else."""
    if is_link(data.text()):
        return data.text()
    return next((path for path in (url.toLocalFile() for url in data.urls()) if is_file(path)), None)
