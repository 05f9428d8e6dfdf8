"""Dropped links and files on the window, and photos on the panel that shows them."""

from pathlib import Path

from PySide6.QtCore import QEvent, QMimeData, QObject, QRectF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDropEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QPen,
)
from PySide6.QtWidgets import QWidget

from p2sf.messages import Message
from p2sf_explorer.compute.lens_files import is_file
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.link import is_link

OTHER_PICTURES = (".gif", ".bmp", ".webp", ".avif", ".raw", ".dng", ".cr2", ".nef", ".arw")


class DropFrame(QWidget):
    """A frame over a widget that takes what is dragged over it, with what letting go will do."""

    WIDTH, AIR = 3, 14  # px: of the frame, and around the words

    def __init__(self, parent: QWidget):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.words = ""
        self.hide()

    def show_for(self, found: str) -> None:
        """Frame the parent for a path or a link that is dragged over it."""
        self.words = tr("Drop to open the link") if is_link(found) else tr("Drop to open {file}", file=Path(found).name)
        parent = self.parentWidget()
        if parent:
            self.setGeometry(parent.rect())
        self.raise_()
        self.show()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the frame, and the words on a ground in its middle."""
        painter, colours = QPainter(self), self.palette()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        accent = colours.color(QPalette.ColorRole.Highlight)
        half = self.WIDTH / 2
        veil = QColor(accent)
        veil.setAlphaF(0.08)
        painter.setPen(QPen(accent, self.WIDTH))
        painter.setBrush(veil)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(half, half, -half, -half), 6, 6)
        room = QRectF(painter.fontMetrics().boundingRect(self.words)).adjusted(-self.AIR, -self.AIR, self.AIR, self.AIR)
        room.moveCenter(QRectF(self.rect()).center())
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(accent)
        painter.drawRoundedRect(room, 6, 6)
        painter.setPen(colours.color(QPalette.ColorRole.HighlightedText))
        painter.drawText(room, Qt.AlignmentFlag.AlignCenter, self.words)


class PhotoDrop(QObject):
    """Watches a widget for dropped pictures: ``photo`` carries the path to open, ``refused`` a message why not.

    Other files are left to the window, which opens lenses and states.
    """

    photo = Signal(str)
    refused = Signal(object)
    why = "{file} is not a PNG, TIFF, OpenEXR, JPEG or HEIF; save the photo as one of these and drop that"

    def __init__(self, widget: QWidget):
        super().__init__(widget)
        widget.setAcceptDrops(True)
        widget.installEventFilter(self)
        self.frame = DropFrame(widget)

    @property
    def endings(self) -> tuple[str, ...]:
        """Return those of files that are taken."""
        from p2sf.io.photo_files import READABLE

        return READABLE

    def eventFilter(self, _widget: QObject, event: QEvent) -> bool:
        """Take pictures."""
        if isinstance(event, QDragLeaveEvent | QDropEvent):
            self.frame.hide()
        if not isinstance(event, QDragEnterEvent | QDropEvent):
            return False
        path = dropped_picture(event.mimeData(), self.endings)
        if path is None:
            event.ignore()
            return True
        event.acceptProposedAction()
        if event.type() == QEvent.Type.Drop:
            self.take(Path(path))
        else:
            self.frame.show_for(path)
        return True

    def take(self, path: Path) -> None:
        """Take a picture as if it had been dropped here."""
        if path.suffix.lower() in self.endings:
            self.photo.emit(str(path))
        else:
            self.refused.emit(Message(self.why, file=path.name))


class MeasuredDrop(PhotoDrop):
    """The same for pictures to be measured, which have more formats."""

    why = "{file} is not a PNG, TIFF, FITS, npy, npz or listing; save the picture as one of these and drop that"

    @property
    def endings(self) -> tuple[str, ...]:
        """Return those of files that are taken."""
        from p2sf.measure.reading import ENDINGS

        return ENDINGS


def is_photo(path: str) -> bool:
    """Return whether a file has the ending of a picture and, unlike a snapshot, no state in it."""
    from p2sf.io.photo_files import READABLE
    from p2sf_explorer.files.embedded_state import text_inside

    return Path(path).suffix.lower() in (*READABLE, *OTHER_PICTURES) and text_inside(path) is None


def dropped_picture(data: QMimeData, endings: tuple[str, ...]) -> str | None:
    """Return the path of the first dropped file with the ending of a picture; None where there is none."""
    paths = (url.toLocalFile() for url in data.urls())
    return next((path for path in paths if Path(path).suffix.lower() in (*endings, *OTHER_PICTURES)), None)


def dropped_path(data: QMimeData) -> str | None:
    """Return a dropped link, or the path of a file, whose content decides when it is opened; None for anything else."""
    if is_link(data.text()):
        return data.text()
    return next((path for path in (url.toLocalFile() for url in data.urls()) if is_file(path)), None)
