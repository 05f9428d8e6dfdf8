"""A chart painted by hand: axes kept as a picture, an image, curves.

A frame of the live path has some milliseconds for all its panels; a graphics scene takes two to five for each. Here
what stands still (axes, labels, glass) is painted once, and a thick line is two fine ones, which the
rasteriser draws twenty times faster than an outline it must fill.
"""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen, QPixmap, QRegion
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf_explorer.charts.painting import fitting, pen, polylines, width_of, write
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import ticks

THICK = ((-0.25, -0.45), (0.25, 0.45))  # two fine lines side by side
TICK_EVERY_PX = {"bottom": 66, "left": 34}


class Curve:
    """A line through points, broken where one is NaN; ``token`` names its colour in the theme.

    ``name`` is the head of its columns where the chart's data are copied.
    """

    name = ""

    def __init__(self, token: str, width: float = 1.0, alpha: int = 255):
        self.token, self.width, self.alpha = token, width, alpha
        self.x, self.y = np.array([]), np.array([])

    def set_data(self, x, y) -> None:
        """Take new points; the chart is told by whoever calls."""
        self.x, self.y = np.asarray(x, float), np.asarray(y, float)

    def data(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the points."""
        return self.x, self.y

    def paint(self, painter: QPainter, chart: "Chart") -> None:
        """Paint the line."""
        if not self.x.size:
            return
        painter.setPen(pen(getattr(chart.theme, self.token, self.token), self.alpha))
        for part in polylines(*chart.to_pixels(self.x, self.y)):
            if self.width <= 1:
                painter.drawPolyline(part)
                continue
            for offset in THICK:
                painter.drawPolyline(part.translated(*offset))


class Chart(QWidget):
    """Labelled axes over a fixed range, an optional image, and curves; ``aspect`` keeps circles round."""

    grids: tuple = ()  # (head, x, y, (y, x) values) to copy in place of the curves
    columns: tuple[str, str] | None = None  # what x and y are called where they are copied, if not as on the axes

    def __init__(self, bottom: str = "", left: str = "", aspect: bool = False, framed: bool = True, parent=None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(120, 90)
        self.theme: Tokens = LIGHT
        self.curves: list[Curve] = []
        self.bottom_ticks: tuple[tuple[float, str], ...] = ()  # in place of round numbers
        self.left_axis = self.left_name = True
        self._labels, self.round, self._framed = (tr(bottom), tr(left)), aspect, framed
        self._asked = ((0.0, 1.0), (0.0, 1.0))
        self._scale: tuple[float, float, float, float] | None = None
        self._ground: QPixmap | None = None
        self._image: tuple[np.ndarray, tuple[float, float, float, float]] | None = None

    @property
    def labels(self) -> tuple[str, str]:
        """Return what the bottom and the left axis show."""
        return self._labels

    def name_axes(self, bottom: str, left: str) -> None:
        """Give the axes other names."""
        if (tr(bottom), tr(left)) != self._labels:
            self._labels = tr(bottom), tr(left)
            self.forget_ground()

    def add_curve(self, token: str, width: float = 1.0, alpha: int = 255) -> Curve:
        """Return a new curve on top of the others."""
        self.curves.append(Curve(token, width, alpha))
        return self.curves[-1]

    def set_range(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Show these ranges; nothing is painted anew while they stay."""
        if (x, y) != self._asked:
            self._asked = (x, y)
            self.forget_ground()

    def show_pixels(self, pixels: np.ndarray, rect: tuple[float, float, float, float]) -> None:
        """Show 0xffRRGGBB pixels, rows +y, over (x, y, width, height)."""
        self._image = np.ascontiguousarray(pixels[::-1]), rect
        self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.theme = theme
        self.forget_ground()

    def forget_ground(self) -> None:
        """Have what stands still painted anew."""
        self._ground = self._scale = None
        self.update()

    @property
    def area(self) -> QRectF:
        """Return where data are shown, in pixels."""
        if not self._framed:
            return QRectF(self.rect())
        left = (44 if self.left_axis else 8) + (16 if self._labels[1] and self.left_name else 0)
        bottom = 20 + (16 if self._labels[0] else 0)
        return QRectF(left, 5, max(10, self.width() - left - 9), max(10, self.height() - bottom - 5))

    def ranges(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the shown ranges: those asked for, one of them widened where circles must be round."""
        if not self.round:
            return self._asked
        area, spans = self.area, [high - low for low, high in self._asked]
        scale = max(spans[0] / area.width(), spans[1] / area.height())
        room = scale * area.width(), scale * area.height()
        middles = [(low + high) / 2 for low, high in self._asked]
        return tuple((m - r / 2, m + r / 2) for m, r in zip(middles, room, strict=True))

    def per_pixel(self) -> float:
        """Return the length of one pixel along x, in data."""
        (low, high), _ = self.ranges()
        return (high - low) / self.area.width()

    def to_pixels(self, x, y):
        """Return where data lie, in pixels."""
        if self._scale is None:
            area, ((left, right), (low, high)) = self.area, self.ranges()
            wide, tall = area.width() / (right - left), area.height() / (high - low)
            self._scale = area.left() - left * wide, wide, area.bottom() + low * tall, tall
        x0, wide, y0, tall = self._scale
        return x0 + x * wide, y0 - y * tall

    def from_pixels(self, point: QPointF) -> tuple[float, float]:
        """Return the data at a pixel."""
        area, ((left, right), (low, high)) = self.area, self.ranges()
        across, up = (point.x() - area.left()) / area.width(), (area.bottom() - point.y()) / area.height()
        return left + across * (right - left), low + up * (high - low)

    def resizeEvent(self, event) -> None:
        """Paint everything anew in a new size."""
        self._ground = self._scale = None
        super().resizeEvent(event)

    def paintEvent(self, event) -> None:
        """Paint what stands still, then image, curves, and what lies above."""
        if self._ground is None or self._ground.devicePixelRatio() != self.devicePixelRatioF():
            self._ground = self._painted_ground()
        painter, image = QPainter(self), self._image and self._image_room()
        if image:  # what it covers need not be copied: a picture of this size takes a quarter of a millisecond
            painter.setClipRegion(QRegion(self.rect()) - QRegion((image & self.area).toRect().adjusted(2, 2, -2, -2)))
        painter.drawPixmap(0, 0, self._ground)
        painter.setClipRect(self.area)
        if image:
            self._paint_image(painter, image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for curve in self.curves:
            curve.paint(painter, self)
        self.paint_over(painter)

    def paint_ground(self, painter: QPainter) -> None:
        """Paint what stands still beside the axes; a kind of chart says what."""

    def paint_over(self, painter: QPainter) -> None:
        """Paint what lies above the curves; a kind of chart says what."""

    def _image_room(self) -> QRectF:
        x, y, width, height = self._image[1]
        (left, bottom), (right, top) = self.to_pixels(x, y), self.to_pixels(x + width, y + height)
        return QRectF(left, top, right - left, bottom - top)

    def _paint_image(self, painter: QPainter, room: QRectF) -> None:
        pixels = self._image[0]
        rows, columns = pixels.shape
        painter.drawImage(room, QImage(pixels.data, columns, rows, 4 * columns, QImage.Format.Format_RGB32))

    def _painted_ground(self) -> QPixmap:
        ratio = self.devicePixelRatioF()
        ground = QPixmap(self.size() * ratio)
        ground.setDevicePixelRatio(ratio)
        ground.fill(QColor(self.theme.card))
        painter = QPainter(ground)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._framed:
            paint_axes(painter, self, self._labels)
        self.paint_ground(painter)
        painter.end()
        return ground


def paint_axes(painter: QPainter, chart: Chart, labels: tuple[str, str]) -> None:
    """Paint two axes, their ticks and labels."""
    area, theme = chart.area, chart.theme
    painter.setPen(QPen(QColor(theme.line), 1))
    painter.drawLine(area.bottomLeft(), area.bottomRight())
    for value, text in bottom_marks(chart):
        x = float(chart.to_pixels(value, 0.0)[0])
        _tick(painter, theme, QPointF(x, area.bottom()), QPointF(x, area.bottom() - 4))
        middle = min(x, chart.width() - width_of(text) / 2)  # the last one stays whole
        write(painter, QRectF(middle - 40, area.bottom() + 3, 80, 15), text)
    write(painter, QRectF(area.left(), area.bottom() + 18, area.width(), 16), fitting(labels[0], area.width() + 18))
    if chart.left_axis:
        _paint_left(painter, chart, labels[1])


def left_marks(chart: Chart):
    """Return the left axis's places and their words."""
    return ticks(*chart.ranges()[1], chart.area.height() / TICK_EVERY_PX["left"])


def bottom_marks(chart: Chart):
    """Return the bottom axis's places and their words; of a round picture those of the left axis, where they fit."""
    every = TICK_EVERY_PX["bottom"]
    if chart.round:
        every = max(width_of(text) for _, text in left_marks(chart)) + 14
    return chart.bottom_ticks or ticks(*chart.ranges()[0], chart.area.width() / every)


def _paint_left(painter: QPainter, chart: Chart, label: str) -> None:
    area, theme = chart.area, chart.theme
    painter.setPen(QPen(QColor(theme.line), 1))
    painter.drawLine(area.bottomLeft(), area.topLeft())
    for value, text in left_marks(chart):
        y = float(chart.to_pixels(0.0, value)[1])
        _tick(painter, theme, QPointF(area.left(), y), QPointF(area.left() + 4, y))
        write(painter, QRectF(area.left() - 60, y - 8, 55, 16), text, side=1)
    if not chart.left_name:
        return
    painter.setPen(QColor(theme.muted))
    painter.rotate(-90)
    write(painter, QRectF(-area.bottom() - 40, 0, area.height() + 80, 16), fitting(label, area.height() + 10))
    painter.rotate(90)


def _tick(painter: QPainter, theme: Tokens, start: QPointF, end: QPointF) -> None:
    painter.setPen(QPen(QColor(theme.line), 1))
    painter.drawLine(start, end)
    painter.setPen(QColor(theme.muted))
