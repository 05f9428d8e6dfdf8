"""A chart painted directly: axes kept as a pixmap, an image, curves.

A frame of the live path has some milliseconds for all its panels; a graphics scene takes two to five for each. Here
the background (axes, labels, glass) is painted once, and a thick line is two thin ones, which the rasteriser draws
twenty times faster than an outline that it must fill.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPaintEvent, QPen, QPixmap, QRegion, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf_explorer.charts.painting import fitting, pen, polylines, width_of, write
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import ticks

THICK = ((-0.25, -0.45), (0.25, 0.45))  # offsets of the two thin lines
Grid = tuple[str, np.ndarray, np.ndarray, np.ndarray]
"""Head, x, y and (y, x) values of a map, as it is copied."""
Span = tuple[float, float]
TICK_EVERY_PX = {"bottom": 66, "left": 34}


class Curve:
    """A line through points, broken where one is NaN; ``token`` names its colour in the theme, or is a colour itself.

    ``name`` is the head of its columns where the chart's data are copied.
    """

    name = ""

    def __init__(self, token: str, width: float = 1.0, alpha: int = 255):
        self.token, self.width, self.alpha = token, width, alpha
        self.x, self.y = np.array([]), np.array([])

    def set_data(self, x: ArrayLike, y: ArrayLike) -> None:
        """Take new points; whoever calls asks the chart to repaint."""
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

    grids: tuple[Grid, ...] = ()  # copied in place of the curves
    columns: tuple[str, str] | None = None  # names of x and y where they are copied, if other than on the axes

    def __init__(
        self,
        bottom: str = "",
        left: str = "",
        aspect: bool = False,
        framed: bool = True,
        parent: QWidget | None = None,
    ):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(120, 90)
        self.theme: Tokens = LIGHT
        self.curves: list[Curve] = []
        self.bottom_ticks: tuple[tuple[float, str], ...] = ()  # in place of round numbers
        self.left_axis = self.left_name = True
        self._labels, self.round, self._framed = (tr(bottom), tr(left)), aspect, framed
        self._asked: tuple[Span, Span] = ((0.0, 1.0), (0.0, 1.0))
        self._scale: tuple[float, float, float, float] | None = None
        self._background: QPixmap | None = None
        self._image: tuple[np.ndarray, tuple[float, float, float, float]] | None = None

    @property
    def labels(self) -> tuple[str, str]:
        """Return the names of the bottom and the left axis."""
        return self._labels

    def name_axes(self, bottom: str, left: str) -> None:
        """Give the axes other names."""
        if (tr(bottom), tr(left)) != self._labels:
            self._labels = tr(bottom), tr(left)
            self.forget_background()

    def add_curve(self, token: str, width: float = 1.0, alpha: int = 255) -> Curve:
        """Return a new curve on top of the others."""
        self.curves.append(Curve(token, width, alpha))
        return self.curves[-1]

    def set_range(self, x: Span, y: Span) -> None:
        """Show these ranges; the background is painted again only when they change."""
        if (x, y) != self._asked:
            self._asked = (x, y)
            self.forget_background()

    def show_pixels(self, pixels: np.ndarray, rect: tuple[float, float, float, float]) -> None:
        """Show 0xffRRGGBB pixels, rows +y, over (x, y, width, height)."""
        self._image = np.ascontiguousarray(pixels[::-1]), rect
        self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.theme = theme
        self.forget_background()

    def forget_background(self) -> None:
        """Have the background painted again."""
        self._background = self._scale = None
        self.update()

    @property
    def area(self) -> QRectF:
        """Return the rectangle of the data, in pixels."""
        if not self._framed:
            return QRectF(self.rect())
        left = (44 if self.left_axis else 8) + (16 if self._labels[1] and self.left_name else 0)
        bottom = 20 + (16 if self._labels[0] else 0)
        return QRectF(left, 5, max(10, self.width() - left - 9), max(10, self.height() - bottom - 5))

    def ranges(self) -> tuple[Span, Span]:
        """Return the shown ranges: those set, one of them widened where circles must be round."""
        if not self.round:
            return self._asked
        area, ((left, right), (low, high)) = self.area, self._asked
        scale = max((right - left) / area.width(), (high - low) / area.height())
        x, y, across, up = (left + right) / 2, (low + high) / 2, scale * area.width(), scale * area.height()
        return (x - across / 2, x + across / 2), (y - up / 2, y + up / 2)

    def per_pixel(self) -> float:
        """Return the length of one pixel along x, in data."""
        (low, high), _ = self.ranges()
        return (high - low) / self.area.width()

    def to_pixels(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Return the pixels of data, numbers or arrays as they come."""
        if self._scale is None:
            area, ((left, right), (low, high)) = self.area, self.ranges()
            wide, tall = area.width() / (right - left), area.height() / (high - low)
            self._scale = area.left() - left * wide, wide, area.bottom() + low * tall, tall
        x0, wide, y0, tall = self._scale
        return x0 + x * wide, y0 - y * tall

    def from_pixels(self, point: QPointF) -> tuple[float, float]:
        """Return the data coordinates of a pixel."""
        area, ((left, right), (low, high)) = self.area, self.ranges()
        across, up = (point.x() - area.left()) / area.width(), (area.bottom() - point.y()) / area.height()
        return left + across * (right - left), low + up * (high - low)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Paint everything again in the new size."""
        self._background = self._scale = None
        super().resizeEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint background, image, curves, and what lies above."""
        if self._background is None or self._background.devicePixelRatio() != self.devicePixelRatioF():
            self._background = self._painted_background()
        painter, image = QPainter(self), self._image and self._image_rect(self._image[1])
        if image:  # the background need not be copied where the image covers it: that takes a quarter of a millisecond
            painter.setClipRegion(QRegion(self.rect()) - QRegion((image & self.area).toRect().adjusted(2, 2, -2, -2)))
        painter.drawPixmap(0, 0, self._background)
        painter.setClipRect(self.area)
        if image and self._image:
            painter.drawImage(image, image_of(self._image[0]))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for curve in self.curves:
            curve.paint(painter, self)
        self.paint_over(painter)

    def paint_background(self, painter: QPainter) -> None:
        """Paint what belongs to the background beside the axes; for subclasses."""

    def paint_over(self, painter: QPainter) -> None:
        """Paint what lies above the curves; for subclasses."""

    def _image_rect(self, rect: tuple[float, float, float, float]) -> QRectF:
        x, y, width, height = rect
        (left, bottom), (right, top) = self.to_pixels(x, y), self.to_pixels(x + width, y + height)
        return QRectF(left, top, right - left, bottom - top)

    def _painted_background(self) -> QPixmap:
        background = blank_pixmap(self, self.theme.card)
        painter = QPainter(background)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._framed:
            paint_axes(painter, self, self._labels)
        self.paint_background(painter)
        painter.end()
        return background


def blank_pixmap(widget: QWidget, colour: str) -> QPixmap:
    """Return a pixmap of a widget's size and pixel ratio, filled with a colour."""
    ratio = widget.devicePixelRatioF()
    pixmap = QPixmap(widget.size() * ratio)
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(QColor(colour))
    return pixmap


def image_of(pixels: np.ndarray, form: QImage.Format = QImage.Format.Format_RGB32) -> QImage:
    """Return an image over the memory of (rows, columns) 0xAARRGGBB pixels, which must outlive it."""
    rows, columns = pixels.shape
    return QImage(pixels.data, columns, rows, 4 * columns, form)


def paint_axes(painter: QPainter, chart: Chart, labels: tuple[str, str]) -> None:
    """Paint two axes, their ticks and labels."""
    area, theme = chart.area, chart.theme
    painter.setPen(QPen(QColor(theme.line), 1))
    painter.drawLine(area.bottomLeft(), area.bottomRight())
    for value, text in bottom_ticks(chart):
        x = float(chart.to_pixels(value, 0.0)[0])
        _tick(painter, theme, QPointF(x, area.bottom()), QPointF(x, area.bottom() - 4))
        middle = min(x, chart.width() - width_of(text) / 2)  # so that the last one is not cut off
        write(painter, QRectF(middle - 40, area.bottom() + 3, 80, 15), text)
    write(painter, QRectF(area.left(), area.bottom() + 18, area.width(), 16), fitting(labels[0], area.width() + 18))
    if chart.left_axis:
        _paint_left(painter, chart, labels[1])


def left_ticks(chart: Chart) -> Sequence[tuple[float, str]]:
    """Return the left axis's ticks and their labels."""
    return ticks(*chart.ranges()[1], chart.area.height() / TICK_EVERY_PX["left"])


def bottom_ticks(chart: Chart) -> Sequence[tuple[float, str]]:
    """Return the bottom axis's ticks and their labels; where circles are round as close as those of the left axis."""
    every: float = TICK_EVERY_PX["bottom"]
    if chart.round:
        every = max(width_of(text) for _, text in left_ticks(chart)) + 14
    return chart.bottom_ticks or ticks(*chart.ranges()[0], chart.area.width() / every)


def _paint_left(painter: QPainter, chart: Chart, label: str) -> None:
    area, theme = chart.area, chart.theme
    painter.setPen(QPen(QColor(theme.line), 1))
    painter.drawLine(area.bottomLeft(), area.topLeft())
    for value, text in left_ticks(chart):
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
