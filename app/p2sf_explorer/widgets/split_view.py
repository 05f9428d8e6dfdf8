"""Two pictures of one scene with a split between them; beside them enlarged details and the PSF of a place."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf_explorer.charts.chart import image_of
from p2sf_explorer.charts.painting import set_text, write
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import tr

GAP = 8.0
PSF_SHARE, PSF_MOST = 0.42, 150.0  # of the height of a picture that the PSF lies on, and pixels at most
PAD = 6.0
DETAIL_ROWS = 64  # of the picture, in an enlarged detail
NARROWEST = 0.7  # least width of a detail over its height


@dataclass(frozen=True)
class SplitPlaces:
    """Rectangles of the picture, the PSF, and, if there is room, the enlarged details before and after the lens."""

    picture: QRectF
    psf: QRectF
    details: tuple[QRectF, ...]


def places(width: float, height: float, rows: int, columns: int) -> SplitPlaces:
    """Return the places in a panel of this size: beside the picture a square for the PSF, and details in the rest."""
    scale = min(width / columns, height / rows)
    picture = QRectF(0, (height - scale * rows) / 2, scale * columns, scale * rows)
    side = picture.height()
    left = width - picture.width() - side - GAP
    if left < 0:
        return SplitPlaces(picture, overlaid(picture), ())
    count = min(2, int(left // (NARROWEST * side + GAP)))
    wide = min(left / max(count, 1) - GAP, side * columns / DETAIL_ROWS)
    lefts = (picture.right() + GAP + k * (wide + GAP) for k in range(count))
    details = tuple(QRectF(at, picture.top(), wide, side) for at in lefts)
    return SplitPlaces(picture, QRectF((details or (picture,))[-1].right() + GAP, picture.top(), side, side), details)


def overlaid(picture: QRectF) -> QRectF:
    """Return the place of the PSF on a picture with no room beside it: its top right corner."""
    side = min(PSF_MOST, PSF_SHARE * picture.height())
    return QRectF(picture.right() - side - PAD, picture.top() + PAD, side, side)


def close_up(place: tuple[float, float], shape: tuple[int, ...], room: QRectF) -> QRectF:
    """Return the part of a picture about (row, column), in its pixels, that a detail shows: never beyond its edge."""
    tall = min(DETAIL_ROWS, shape[0])
    wide = min(tall * room.width() / room.height(), shape[1])
    top = min(max(place[0] + 0.5 - tall / 2, 0.0), shape[0] - tall)
    left = min(max(place[1] + 0.5 - wide / 2, 0.0), shape[1] - wide)
    return QRectF(left, top, wide, tall)


STEP = 0.05  # of the width, by an arrow key with Shift
LOOK_STEP = 8.0  # pixels of the picture, by an arrow key
LOOKS: dict[int, tuple[float, float]] = {
    Qt.Key.Key_Up: (-LOOK_STEP, 0.0),
    Qt.Key.Key_Down: (LOOK_STEP, 0.0),
    Qt.Key.Key_Left: (0.0, -LOOK_STEP),
    Qt.Key.Key_Right: (0.0, LOOK_STEP),
}
HANDLE_PX = 7.0
TIP = (
    "Hover or press the arrow keys to look at a place: its PSF and its detail follow. "
    "Drag the split, or move it with Shift and the left or right arrow. Drop a PNG or TIFF to photograph it."
)
BLACK = np.full((1, 1), 0xFF000000, np.uint32)


class SplitView(QWidget):
    """``before`` at the left of the split, ``after`` at its right; drag the split, hover or press arrows to look.

    ``moved`` carries the wanted place of the split, 0 to 1; ``looked`` the row and column under the pointer.
    """

    moved = Signal(float)
    looked = Signal(float, float)
    taken = Signal()
    released = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 100)
        self.setAccessibleName(
            tr("Picture before and after the lens; arrows move the place looked at, Shift the split")
        )
        self.setToolTip(tr(TIP))
        self.before, self.after, self.psf = BLACK, BLACK, BLACK
        self.names, self.split, self.place = ("", ""), 0.5, (0.0, 0.0)
        self._theme: Tokens = LIGHT

    def sizeHint(self) -> QSize:
        """Return a size that shows every pixel."""
        return QSize(330, 220)

    def show_pictures(self, before: np.ndarray, after: np.ndarray, names: tuple[str, str]) -> None:
        """Show two pictures of the same shape, 0xffRRGGBB, row 0 the top; ``names`` are shown as they are."""
        self.before, self.after, self.names = before, after, names
        self.update()

    def show_split(self, part: float) -> None:
        """Put the split at this part of the width."""
        if part != self.split:
            self.split = part
            self.update()

    def show_psf(self, pixels: np.ndarray, place: tuple[float, float]) -> None:
        """Show the PSF of a place (row, column)."""
        self.psf, self.place = pixels, place
        self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def places(self) -> SplitPlaces:
        """Return the places in the present size."""
        return places(self.width(), self.height(), *self.after.shape)

    def area(self) -> QRectF:
        """Return the place of the picture: at the left, as large as fits."""
        return self.places().picture

    def split_x(self) -> float:
        """Return the place of the split in pixels."""
        return self.area().left() + self.split * self.area().width()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint both parts, the split, the names, the details and the PSF."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        if self.after is BLACK:
            return
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        area, x = self.area(), self.split_x()
        for pixels, left, right in ((self.before, area.left(), x), (self.after, x, area.right())):
            painter.setClipRect(QRectF(left, area.top(), right - left, area.height()))
            painter.drawImage(area, image_of(pixels))
        painter.setClipping(False)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_split(painter, area, x)
        self._paint_names(painter, area, x)
        if self.psf is not BLACK:
            self._paint_place(painter, self.places())

    def _paint_split(self, painter: QPainter, area: QRectF, x: float) -> None:
        for colour, width in (("#000000", 3.0), (self._theme.accent if self.hasFocus() else "#ffffff", 1.4)):
            painter.setPen(QPen(QColor(colour), width))
            painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
        painter.setBrush(QColor("#ffffff"))
        painter.setPen(QPen(QColor("#000000"), 1))
        painter.drawEllipse(QPointF(x, area.center().y()), HANDLE_PX, HANDLE_PX)

    def _paint_names(self, painter: QPainter, area: QRectF, x: float) -> None:
        for name, side in zip(self.names, (-1, 1), strict=True):
            wide = set_text(name).size().width() + 2 * PAD
            left = x - PAD - wide if side < 0 else x + PAD
            if not name or left < area.left() or left + wide > area.right():
                continue
            _label(painter, QRectF(left, area.bottom() - 24, wide, 18), name)

    def _paint_place(self, painter: QPainter, places: SplitPlaces) -> None:
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)  # a sensor's pixels are squares
        part = close_up(self.place, self.after.shape, (places.details or (places.psf,))[0])
        shown = ((self.before, self.names[0]), (self.after, self.names[1]))[2 - len(places.details) :]
        for room, (pixels, name) in zip(places.details, shown, strict=False):
            painter.drawImage(room, image_of(pixels), part)
            self._frame(painter, room, name)
        painter.drawImage(places.psf, image_of(self.psf))
        self._frame(painter, places.psf, tr("PSF, √"))
        area = places.picture
        scale = area.width() / self.after.shape[1]
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for colour, width in (("#000000", 3.0), ("#ffffff", 1.4)):  # shows on bright and on dark
            painter.setPen(QPen(QColor(colour), width))
            if places.details:
                box = QRectF(*(scale * v for v in (part.x(), part.y(), part.width(), part.height())))
                painter.drawRect(box.translated(area.topLeft()))
            row, column = self.place
            painter.drawEllipse(area.topLeft() + QPointF(column + 0.5, row + 0.5) * scale, 5.0, 5.0)

    def _frame(self, painter: QPainter, room: QRectF, name: str) -> None:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(self._theme.line), 1.0))
        painter.drawRect(room)
        wide = set_text(name).size().width() + 2 * PAD
        if name and wide < room.width():
            _label(painter, QRectF(room.left() + PAD, room.bottom() - 24, wide, 18), name)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the split."""
        self.taken.emit()
        self._move(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Carry the split along, or look."""
        if event.buttons():
            self._move(event.position())
            return
        area, (rows, columns) = self.area(), self.after.shape
        if area.contains(event.position()):
            column = (event.position().x() - area.left()) / area.width() * columns - 0.5
            row = (event.position().y() - area.top()) / area.height() * rows - 0.5
            self.looked.emit(min(rows - 1.0, max(0.0, row)), min(columns - 1.0, max(0.0, column)))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        self.released.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the place looked at with the arrows, and with Shift the split."""
        step = LOOKS.get(event.key())
        if step is None:
            super().keyPressEvent(event)
        elif event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self.moved.emit(min(1.0, max(0.0, self.split + STEP * (step[1] > 0) - STEP * (step[1] < 0))))
        else:
            ends = zip(self.place, step, self.after.shape, strict=True)
            self.looked.emit(*(min(count - 1.0, max(0.0, at + by)) for at, by, count in ends))

    def _move(self, place: QPointF) -> None:
        area = self.area()
        self.moved.emit(min(1.0, max(0.0, (place.x() - area.left()) / area.width())))


def _label(painter: QPainter, room: QRectF, name: str) -> None:
    """Write white text on a dark ground, which shows on every picture."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(0, 0, 0, 170))
    painter.drawRoundedRect(room, 4, 4)
    painter.setPen(QColor("#ffffff"))
    write(painter, room, name)
