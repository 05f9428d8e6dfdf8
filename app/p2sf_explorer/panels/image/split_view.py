"""Two pictures of one scene with a split between them; beside them enlarged details and the PSF of a place."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt, QTimer, Signal
from PySide6.QtGui import QAccessible, QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf_explorer.charts.chart import image_of
from p2sf_explorer.charts.painting import set_text, write
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import tr

GAP = 8.0
PSF_SHARE, PSF_MOST = 0.42, 150.0  # of the height of a picture that the PSF lies on, and pixels at most
PAD = 6.0
LEAST_UNDER = 96.0  # px: the side of the squares under a picture
DETAIL_ROWS = 64  # of the picture, in an enlarged detail
NARROWEST = 0.7  # least width of a detail over its height


@dataclass(frozen=True)
class SplitPlaces:
    """Rectangles of the picture, the PSF, and, if there is room, the enlarged details before and after the lens."""

    picture: QRectF
    psf: QRectF
    details: tuple[QRectF, ...]


def places(width: float, height: float, rows: int, columns: int) -> SplitPlaces:
    """Return the places in a panel of this size: beside the picture a square for the PSF, and details in the rest.

    Where the picture takes the width, they lie under it, or where there is no room for that either the PSF on it.
    """
    scale = min(width / columns, height / rows)
    picture = QRectF(0, (height - scale * rows) / 2, scale * columns, scale * rows)
    side = picture.height()
    left = width - picture.width() - side - GAP
    if left < 0:
        under = min(height - picture.height() - GAP, (width - 2 * GAP) / 3)
        if under < LEAST_UNDER:
            picture.moveLeft((width - picture.width()) / 2)
            return SplitPlaces(picture, overlaid(picture), ())
        picture.moveTop((height - picture.height() - GAP - under) / 2)
        first, second, psf = (QRectF(k * (width - under) / 2, picture.bottom() + GAP, under, under) for k in range(3))
        return SplitPlaces(picture, psf, (first, second))
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
BLINK_MS = 700
TIP = (
    "Hover or use the arrow keys to look at a place: its PSF and an enlarged detail follow. Drag the split, or move "
    "it with Shift and the left or right arrow. Drop a photo here to photograph it through the lens."
)
BLACK = np.full((1, 1), 0xFF000000, np.uint32)


class SplitView(QWidget):
    """``before`` at the left of the split, ``after`` at its right; drag the split, hover or press arrows to look.

    ``moved`` carries the wanted place of the split, 0 to 1; ``looked`` the row and column under the pointer.
    """

    accessible_role = QAccessible.Role.Graphic
    moved = Signal(float)
    looked = Signal(float, float)
    taken = Signal()
    released = Signal()
    resized = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 100)
        self.setAccessibleName(
            tr("Picture before and after the lens; arrow keys move the place you look at, with Shift the split")
        )
        self.setToolTip(tr(TIP))
        self.before, self.after, self.psf = BLACK, BLACK, BLACK
        self.names, self.split, self.place = ("", ""), 0.5, (0.0, 0.0)
        self.look, self.blinked = "split", False
        self._reduced: dict[int, np.ndarray] = {}
        self._blink = QTimer(self, interval=BLINK_MS)
        self._blink.timeout.connect(self._turn)
        self._theme: Tokens = LIGHT

    def room(self) -> tuple[int, int]:
        """Return the rows and columns of pixels of the screen that there are."""
        ratio = self.devicePixelRatioF()
        return int(ratio * self.height()), int(ratio * self.width())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Tell of other room."""
        super().resizeEvent(event)
        self.resized.emit()

    def sizeHint(self) -> QSize:
        """Return a size that shows every pixel."""
        return QSize(330, 220)

    def show_pictures(self, before: np.ndarray, after: np.ndarray, names: tuple[str, str]) -> None:
        """Show two pictures of the same shape, 0xffRRGGBB, row 0 the top; ``names`` are shown as they are."""
        self.before, self.after, self.names = before, after, names
        self._reduced.clear()
        self.update()

    def show_look(self, look: str) -> None:
        """Put the two pictures on either side of a split, beside each other ("side"), or one after the other."""
        if look != self.look:
            self.look, self.blinked = look, False
            self._blink.start() if look == "blink" else self._blink.stop()
            self.update()

    def _turn(self) -> None:
        self.blinked = not self.blinked
        if self.isVisible():
            self.update()

    def _to_paint(self, pixels: np.ndarray, room: QRectF) -> np.ndarray:
        """Return a picture for a room, every n-th pixel of one that is far larger: its paint takes long."""
        times = int(pixels.shape[1] / max(1.0, 2 * room.width() * self.devicePixelRatioF()))
        if times < 2:
            return pixels
        key = id(pixels) * 64 + times
        if key not in self._reduced:
            self._reduced[key] = np.ascontiguousarray(pixels[::times, ::times])
        return self._reduced[key]

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
        """Return the place of the picture, as large as fits: at the left of its details, or in the middle."""
        return self.places().picture

    def halves(self) -> tuple[QRectF, QRectF]:
        """Return the places of the two pictures, beside or above each other, whichever shows them larger."""
        rows, columns = self.after.shape
        wide, tall = float(self.width()), float(self.height())
        beside = min((wide - GAP) / 2 / columns, tall / rows)
        above = min(wide / columns, (tall - GAP) / 2 / rows)
        size = QSizeF(columns, rows) * max(beside, above)
        step = QPointF(size.width() + GAP, 0) if beside >= above else QPointF(0, size.height() + GAP)
        corner = QPointF(wide - size.width() - step.x(), tall - size.height() - step.y()) / 2
        return QRectF(corner, size), QRectF(corner + step, size)

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
        if self.look == "side":
            self._paint_halves(painter)
            return
        area, x = self.area(), self.split_x()
        if self.look == "blink":
            x = area.left() if self.blinked else area.right()
        for pixels, left, right in ((self.before, area.left(), x), (self.after, x, area.right())):
            painter.setClipRect(QRectF(left, area.top(), right - left, area.height()))
            painter.drawImage(area, image_of(self._to_paint(pixels, area)))
        painter.setClipping(False)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self.look == "split":
            self._paint_split(painter, area, x)
        self._paint_names(painter, area, x)
        if self.psf is not BLACK:
            self._paint_place(painter, self.places())

    def _paint_halves(self, painter: QPainter) -> None:
        """Paint both pictures whole, with the place looked at in both, and its PSF on the second."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for room, pixels, name in zip(self.halves(), (self.before, self.after), self.names, strict=True):
            painter.drawImage(room, image_of(self._to_paint(pixels, room)))
            self._frame(painter, room, name)
            if self.psf is not BLACK:
                self._paint_ring(painter, room)
        if self.psf is not BLACK:
            place = overlaid(self.halves()[1])
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)
            painter.drawImage(place, image_of(self.psf))
            self._frame(painter, place, tr("PSF, √"))

    def _paint_ring(self, painter: QPainter, area: QRectF) -> None:
        """Paint a ring about the place looked at, which shows on bright and on dark."""
        scale, (row, column) = area.width() / self.after.shape[1], self.place
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for colour, width in (("#000000", 3.0), ("#ffffff", 1.4)):
            painter.setPen(QPen(QColor(colour), width * self._theme.scale))
            radius = 5.0 * self._theme.scale
            painter.drawEllipse(area.topLeft() + QPointF(column + 0.5, row + 0.5) * scale, radius, radius)

    def _paint_split(self, painter: QPainter, area: QRectF, x: float) -> None:
        for colour, width in (("#000000", 3.0), (self._theme.accent if self.hasFocus() else "#ffffff", 1.4)):
            painter.setPen(QPen(QColor(colour), width * self._theme.scale))
            painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
        painter.setBrush(QColor("#ffffff"))
        painter.setPen(QPen(QColor("#000000"), self._theme.scale))
        radius = HANDLE_PX * self._theme.scale
        painter.drawEllipse(QPointF(x, area.center().y()), radius, radius)

    def _paint_names(self, painter: QPainter, area: QRectF, x: float) -> None:
        px = self._theme.px
        for name, side in zip(self.names, (-1, 1), strict=True):
            wide = set_text(name, self._theme.tick).size().width() + 2 * PAD
            left = x - PAD - wide if side < 0 else x + PAD
            if not name or left < area.left() or left + wide > area.right():
                continue
            _label(painter, QRectF(left, area.bottom() - px(24), wide, px(18)), name, self._theme.tick)

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
            painter.setPen(QPen(QColor(colour), width * self._theme.scale))
            if places.details:
                box = QRectF(*(scale * v for v in (part.x(), part.y(), part.width(), part.height())))
                painter.drawRect(box.translated(area.topLeft()))
        self._paint_ring(painter, area)

    def _frame(self, painter: QPainter, room: QRectF, name: str) -> None:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(self._theme.line), self._theme.scale))
        painter.drawRect(room)
        wide = set_text(name, self._theme.tick).size().width() + 2 * PAD
        px = self._theme.px
        if name and wide < room.width():
            _label(painter, QRectF(room.left() + PAD, room.bottom() - px(24), wide, px(18)), name, self._theme.tick)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the split."""
        if self.look == "split":
            self.taken.emit()
            self._move(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Carry the split along, or look."""
        if event.buttons() and self.look == "split":
            self._move(event.position())
            return
        rooms = self.halves() if self.look == "side" else (self.area(),)
        area, (rows, columns) = next((r for r in rooms if r.contains(event.position())), rooms[0]), self.after.shape
        if area.contains(event.position()):
            column = (event.position().x() - area.left()) / area.width() * columns - 0.5
            row = (event.position().y() - area.top()) / area.height() * rows - 0.5
            self.looked.emit(min(rows - 1.0, max(0.0, row)), min(columns - 1.0, max(0.0, column)))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        if self.look == "split":
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


def _label(painter: QPainter, room: QRectF, name: str, size: int) -> None:
    """Write white text on a dark ground, which shows on every picture."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(0, 0, 0, 170))
    painter.drawRoundedRect(room, 4, 4)
    painter.setPen(QColor("#ffffff"))
    write(painter, room, name, 0, size)
