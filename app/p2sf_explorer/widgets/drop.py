"""What is dropped: links and files on the window, and photos on a panel, which takes those it reads."""

from pathlib import Path

from PySide6.QtCore import QEvent, QObject, Signal
from PySide6.QtWidgets import QWidget

from p2sf.io.photo_files import READABLE
from p2sf_explorer.files.embedded_state import text_inside
from p2sf_explorer.files.opening import is_file
from p2sf_explorer.state.link import is_link

OTHER_PICTURES = (".jpg", ".jpeg", ".gif", ".bmp", ".webp", ".heic", ".avif", ".raw", ".dng", ".cr2", ".nef", ".arw")


class PhotoDrop(QObject):
    """Watches a widget for dropped files: ``photo`` tells a path to open, ``refused`` why a picture is not opened.

    Files that are no pictures go on to the window, which opens lenses and states.
    """

    photo = Signal(str)
    refused = Signal(str)

    def __init__(self, widget: QWidget):
        super().__init__(widget)
        widget.setAcceptDrops(True)
        widget.installEventFilter(self)

    def eventFilter(self, _widget, event) -> bool:
        """Take pictures."""
        if event.type() not in (QEvent.Type.DragEnter, QEvent.Type.Drop):
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
        """Tell of a picture as if it had been dropped here."""
        if path.suffix.lower() in READABLE:
            self.photo.emit(str(path))
        else:
            self.refused.emit(f"{path.name} is no PNG or TIFF; save the photo as one of these and drop that")


def is_photo(path: str) -> bool:
    """Return whether a file's name ends as a picture's does and no state lies in it, as in a snapshot."""
    return Path(path).suffix.lower() in (*READABLE, *OTHER_PICTURES) and text_inside(path) is None


def dropped_picture(data) -> str | None:
    """Return the path of the first dropped file, should its name end as a picture's does; None for anything else."""
    paths = (url.toLocalFile() for url in data.urls())
    return next((path for path in paths if Path(path).suffix.lower() in (*READABLE, *OTHER_PICTURES)), None)


def dropped(data) -> str | None:
    """Return a dropped link, or the path of a file, told by its content when opened; None for anything else."""
    if is_link(data.text()):
        return data.text()
    return next((path for path in (url.toLocalFile() for url in data.urls()) if is_file(path)), None)
