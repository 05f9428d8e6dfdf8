"""Plots in the look of the window: axes, heat maps, colour bars."""

from collections.abc import Sequence
from functools import lru_cache
from math import ceil, floor

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QLinearGradient, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import small_font, width_of
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import local, tr

BRIGHTNESS = "brightness"  # stands for the colour map that the theme has for brightness
NARROW_PX = 245  # below this width, as beside a lesson, a heat map has no colour bar and no name at the left
EMPTY = 255  # the index of a colour table that is kept for "no value"


class PlotAxis(pg.AxisItem):
    """An axis that writes a true minus sign."""

    def tickStrings(self, values: Sequence[float], scale: float, spacing: float) -> list[str]:
        """Return the ticks' labels."""
        return [local(text.replace("-", "−")) for text in super().tickStrings(values, scale, spacing)]

    def tickValues(self, minVal: float, maxVal: float, size: float) -> list[tuple[float, list[float]]]:
        """Return the ticks' places; a logarithmic axis has only whole decades."""
        if not self.logMode:
            return super().tickValues(minVal, maxVal, size)
        step = max(1, ceil((maxVal - minVal) / 5))
        return [(float(step), [float(k) for k in range(ceil(minVal), floor(maxVal) + 1, step)])]

    def logTickStrings(self, values: Sequence[float], scale: float, spacing: float) -> list[str]:
        """Return decades as numbers near one, as powers of ten elsewhere."""
        return [local(f"{10.0**v:g}") if -2 <= v <= 3 else f"1e{v:.0f}".replace("-", "−") for v in values]


def plot_widget(bottom: str = "", left: str = "", aspect: bool = False) -> pg.PlotWidget:
    """Return a plot with labelled axes, without menus and panning."""
    plot = pg.PlotWidget(axisItems={side: PlotAxis(side) for side in ("bottom", "left")})
    item = plot.getPlotItem()
    item.setMenuEnabled(False)
    item.hideButtons()
    item.setMouseEnabled(False, False)
    view = item.getViewBox()
    view.setDefaultPadding(0.02)
    # Nothing is drawn outside its range, and antialiased lines cost three times as much under a clip.
    view.setFlag(view.GraphicsItemFlag.ItemClipsChildrenToShape, False)
    item.layout.setContentsMargins(0, 4, 8, 0)
    plot.setFrameShape(pg.QtWidgets.QFrame.Shape.NoFrame)
    plot.setMinimumSize(120, 90)
    plot.viewport().setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)  # spares the repaint of what lies behind
    if aspect:
        item.setAspectLocked(True)
    for side, text in (("bottom", bottom), ("left", left)):
        axis = item.getAxis(side)
        axis.setStyle(tickFont=small_font(), tickLength=-4, tickTextOffset=4)
        axis.enableAutoSIPrefix(False)
        axis.setCacheMode(axis.CacheMode.DeviceCoordinateCache)  # an axis changes far less often than what it frames
        if text:
            axis.setLabel(tr(text))
            axis.label.setFont(small_font())
    return plot


def restyle_plot(plot: pg.PlotWidget, theme: Tokens) -> None:
    """Give a plot the colours of a theme."""
    item = plot.getPlotItem()
    plot.setBackground(QColor(theme.card))
    for side in ("bottom", "left"):
        axis = item.getAxis(side)
        axis.setPen(pg.mkPen(theme.line))
        axis.setTextPen(pg.mkPen(theme.muted))


@lru_cache(maxsize=8)
def lookup(name: str) -> np.ndarray:
    """Return a colour table (256,) of 0xffRRGGBB whose last entry is for samples without a value."""
    red, green, blue = pg.colormap.get(name).getLookupTable(nPts=255)[:, :3].astype(np.uint32).T
    table = np.full(256, 0xFFFFFFFF, dtype=np.uint32)
    table[:EMPTY] = 0xFF000000 | red << 16 | green << 8 | blue
    return table


def named(name: str, theme: Tokens) -> str:
    """Return the colour map that a name stands for: the theme's own for `BRIGHTNESS`."""
    return theme.brightness if name == BRIGHTNESS else name


def as_indices(values: np.ndarray, low: float, high: float) -> np.ndarray:
    """Return values as indices 0 to 254 of a colour table, EMPTY where one is NaN."""
    scaled = (values - low) * (254.0 / (high - low) if high > low else 0.0)
    np.clip(scaled, 0, 254, out=scaled)
    scaled[np.isnan(scaled)] = EMPTY
    return scaled.astype(np.uint8)


class ColourBar(QWidget):
    """A vertical colour bar with a few labelled values and a unit on top; it widens for long labels and stays wide."""

    WIDTH, TICK = 62, 22  # px: the least, and from the left edge to a label

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self._theme, self._name, self._unit = LIGHT, "CET-L4", ""
        self._labels: tuple[tuple[float, str], ...] = ()
        self._wide = self.WIDTH

    def sizeHint(self) -> QSize:
        """Return a width with room for bar and labels."""
        return QSize(self._wide, 120)

    def show_scale(self, name: str, unit: str, labels: tuple[tuple[float, str], ...]) -> None:
        """Show a colour map with labels at parts (0 bottom to 1 top) of the bar; ``unit`` is translated here."""
        if (name, unit, labels) != (self._name, self._unit, self._labels):
            self._name, self._unit, self._labels = name, unit, labels
            self._widen()
            self.update()

    def _widen(self) -> None:
        """Take the room the labels need and keep it, or the map beside would change its size with every label."""
        need = ceil(self.TICK + max((width_of(text) for _, text in self._labels), default=0)) + 2
        if need > self._wide:
            self._wide = need
            self.updateGeometry()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the bar."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        painter.setFont(small_font())
        bar = QRectF(4, 22, 11, self.height() - 46)
        gradient = QLinearGradient(bar.bottomLeft(), bar.topLeft())
        table = lookup(named(self._name, self._theme))
        for k in range(17):
            gradient.setColorAt(k / 16, QColor.fromRgb(int(table[min(254, round(254 * k / 16))])))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(gradient)
        painter.drawRect(bar)
        painter.setPen(QPen(QColor(self._theme.muted)))
        painter.drawText(QPointF(3, 12), tr(self._unit))
        for part, text in self._labels:
            y = bar.bottom() - part * bar.height()
            painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + 4, y))
            painter.drawText(QPointF(self.TICK, y + 4), local(text))


class HeatMap(QWidget):
    """An image in physical coordinates with its colour bar; curves go on ``chart``."""

    resized = Signal()

    def __init__(self, bottom: str, left: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.chart, self.bar = Chart(bottom, left, aspect=True), ColourBar(self)
        self.indices = np.zeros((1, 1), np.uint8)
        self.values: np.ndarray | None = None
        self.quantity, self._name = "", "CET-L4"
        self._rect: tuple[float, float, float, float] | None = None
        self._mapped: tuple[str, Tokens] | None = None
        self._table = lookup(self._name)
        self.row = QHBoxLayout(self)
        self.row.setContentsMargins(0, 0, 0, 0)
        self.row.setSpacing(0)
        self.row.addWidget(self.chart, 1)
        self.row.addWidget(self.bar)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide the colour bar and the left axis's name where there is little room, so that the picture has it."""
        super().resizeEvent(event)
        wide = event.size().width() >= NARROW_PX
        if wide != self.chart.left_name:
            self.chart.left_name = wide
            self.bar.setVisible(wide)
            self.chart.forget_background()
        self.resized.emit()

    @property
    def device_pixels(self) -> float:
        """Return how many pixels of the screen the picture has along its shorter side."""
        area = self.chart.area
        return min(area.width(), area.height()) * self.devicePixelRatioF()

    def show_values(
        self, values: np.ndarray, levels: tuple[float, float], rect: tuple[float, float, float, float]
    ) -> None:
        """Show rows +y of ``values`` over (x, y, width, height)."""
        self.indices, self._rect = as_indices(values, *levels), rect
        self.means(values, "")
        self.chart.show_pixels(self._table[self.indices], rect)

    def means(self, values: np.ndarray, quantity: str) -> None:
        """Set what is copied: ``values`` before they were stretched, and their quantity with its unit, in English."""
        self.values, self.quantity = values, quantity

    @property
    def rect_shown(self) -> tuple[float, float, float, float] | None:
        """Return the rectangle of the values: x, y, width, height."""
        return self._rect

    def set_extent(self, half: float) -> None:
        """Show −half to half on both axes."""
        self.chart.set_range((-1.04 * half, 1.04 * half), (-1.04 * half, 1.04 * half))

    def set_map(self, name: str) -> None:
        """Use a colour map by name."""
        if (name, self.chart.theme) != self._mapped:
            self._mapped, self._name = (name, self.chart.theme), name
            self._table = lookup(named(name, self.chart.theme)).copy()
            self._table[EMPTY] = QColor(self.chart.theme.card).rgb()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
        self.bar.restyle(theme)
        self.set_map(self._name)
        if self._rect:
            self.chart.show_pixels(self._table[self.indices], self._rect)
