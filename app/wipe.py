"""Two pictures of one scene with a split between them, and a loupe for what is under the pointer."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QImage, QPainter, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.ink import set_text, write
from app.theme import LIGHT, Tokens
from app.words import tr

STEP = 0.05  # of the width, for an arrow key
HANDLE_PX = 7.0
LOUPE_SHARE, LOUPE_MOST = 0.42, 150.0  # of the picture's height, and pixels at most
PAD = 6.0
SHAPE = 2, 3  # rows to columns of every picture
BLACK = np.full((1, 1), 0xFF000000, np.uint32)


class Wipe(QWidget):
    """``before`` at the left of the split, ``after`` at its right; drag the split, hover for the loupe.

    ``moved`` tells where the split is wanted, 0 to 1; ``looked`` the row and column under the pointer.
    """

    moved = Signal(float)
    looked = Signal(float, float)
    taken = Signal()
    released = Signal()

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 100)
        self.setAccessibleName(tr("Picture before and after the lens; left and right arrows move the split"))
        self.before, self.after, self.loupe = BLACK, BLACK, BLACK
        self.names, self.split, self.place = ("", ""), 0.5, (0.0, 0.0)
        self._theme: Tokens = LIGHT

    def sizeHint(self) -> QSize:
        """Return a size that shows every pixel."""
        return QSize(330, 220)

    def show_pictures(self, before: np.ndarray, after: np.ndarray, names: tuple[str, str]) -> None:
        """Show two pictures of the same shape, 0xffRRGGBB, row 0 the top."""
        self.before, self.after, self.names = before, after, names
        self.update()

    def show_split(self, part: float) -> None:
        """Put the split at this part of the width."""
        if part != self.split:
            self.split = part
            self.update()

    def show_loupe(self, pixels: np.ndarray, place: tuple[float, float]) -> None:
        """Show the PSF of a place (row, column)."""
        self.loupe, self.place = pixels, place
        self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def area(self) -> QRectF:
        """Return where the picture is: at the left, as large as fits."""
        rows, columns = self.after.shape
        scale = min(self.width() / columns, self.height() / rows)
        wide, tall = scale * columns, scale * rows
        return QRectF(0, (self.height() - tall) / 2, wide, tall)

    def split_x(self) -> float:
        """Return where the split is, in pixels."""
        return self.area().left() + self.split * self.area().width()

    def loupe_rect(self) -> QRectF:
        """Return where the loupe is: at the top right of the picture."""
        area = self.area()
        side = min(LOUPE_MOST, LOUPE_SHARE * area.height())
        return QRectF(area.right() - side - PAD, area.top() + PAD, side, side)

    def resizeEvent(self, event) -> None:
        """Take no more width than the picture needs at this height."""
        rows, columns = SHAPE
        self.setMaximumWidth(max(self.minimumWidth(), round(event.size().height() * columns / rows)))
        super().resizeEvent(event)

    def paintEvent(self, event) -> None:
        """Paint both parts, the split, the names and the loupe."""
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
        if self.loupe is not BLACK:
            self._paint_loupe(painter, area)

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
            room = QRectF(left, area.bottom() - 24, wide, 18)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(0, 0, 0, 170))
            painter.drawRoundedRect(room, 4, 4)
            painter.setPen(QColor("#ffffff"))
            write(painter, room, name)

    def _paint_loupe(self, painter: QPainter, area: QRectF) -> None:
        scale, frame = area.width() / self.after.shape[1], self.loupe_rect()
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)  # a sensor's pixels are squares
        painter.drawImage(frame, image_of(self.loupe))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor("#ffffff"), 1.4))
        painter.drawRect(frame)
        write(painter, QRectF(frame.left(), frame.bottom() - 17, frame.width(), 15), "PSF, √")
        centre = QPointF(area.left() + (self.place[1] + 0.5) * scale, area.top() + (self.place[0] + 0.5) * scale)
        painter.drawEllipse(centre, 5.0, 5.0)

    def mousePressEvent(self, event) -> None:
        """Take hold of the split."""
        self.taken.emit()
        self._move(event.position())

    def mouseMoveEvent(self, event) -> None:
        """Carry the split along, or look."""
        if event.buttons():
            self._move(event.position())
            return
        area, (rows, columns) = self.area(), self.after.shape
        if area.contains(event.position()):
            column = (event.position().x() - area.left()) / area.width() * columns - 0.5
            row = (event.position().y() - area.top()) / area.height() * rows - 0.5
            self.looked.emit(min(rows - 1.0, max(0.0, row)), min(columns - 1.0, max(0.0, column)))

    def mouseReleaseEvent(self, event) -> None:
        """Let go."""
        self.released.emit()

    def keyPressEvent(self, event) -> None:
        """Move the split with the arrows."""
        step = {Qt.Key.Key_Left: -STEP, Qt.Key.Key_Right: STEP}.get(event.key())
        if step is None:
            super().keyPressEvent(event)
        else:
            self.moved.emit(min(1.0, max(0.0, self.split + step)))

    def _move(self, place: QPointF) -> None:
        area = self.area()
        self.moved.emit(min(1.0, max(0.0, (place.x() - area.left()) / area.width())))


def image_of(pixels: np.ndarray) -> QImage:
    """Return an image that looks at these pixels; they must outlive it."""
    rows, columns = pixels.shape
    return QImage(pixels.data, columns, rows, 4 * columns, QImage.Format.Format_RGB32)
