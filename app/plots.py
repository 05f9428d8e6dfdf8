"""The plots' common look: axes, heat maps, colour bars."""

from functools import lru_cache
from math import ceil, floor

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QLinearGradient, QPainter, QPen
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from app.theme import LIGHT, Tokens

TRANSPARENT = 255  # the one index of a colour table that is kept for "no value"


def small_font(size: int = 11) -> QFont:
    """Return the font of ticks and labels."""
    font = QFont()
    font.setPixelSize(size)
    return font


class Axis(pg.AxisItem):
    """An axis that writes a true minus sign."""

    def tickStrings(self, values, scale, spacing):
        """Return the ticks' labels."""
        return [text.replace("-", "−") for text in super().tickStrings(values, scale, spacing)]

    def tickValues(self, minVal, maxVal, size):
        """Return the ticks' places; a logarithmic axis has whole decades only."""
        if not self.logMode:
            return super().tickValues(minVal, maxVal, size)
        step = max(1, ceil((maxVal - minVal) / 5))
        return [(float(step), [float(k) for k in range(ceil(minVal), floor(maxVal) + 1, step)])]

    def logTickStrings(self, values, scale, spacing):
        """Return decades as numbers near one, as powers of ten elsewhere."""
        return [f"{10.0**v:g}" if -2 <= v <= 3 else f"1e{v:.0f}".replace("-", "−") for v in values]


def plot_widget(bottom: str = "", left: str = "", aspect: bool = False) -> pg.PlotWidget:
    """Return a still plot: labelled axes, no menus, no panning."""
    plot = pg.PlotWidget(axisItems={side: Axis(side) for side in ("bottom", "left")})
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
    plot.viewport().setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)  # spare the repaint of what lies behind
    if aspect:
        item.setAspectLocked(True)
    for side, text in (("bottom", bottom), ("left", left)):
        axis = item.getAxis(side)
        axis.setStyle(tickFont=small_font(), tickLength=-4, tickTextOffset=4)
        axis.enableAutoSIPrefix(False)
        axis.setCacheMode(axis.CacheMode.DeviceCoordinateCache)  # an axis changes far less often than what it frames
        if text:
            axis.setLabel(text)
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
    """Return a colour table (256, 4) of uint8; its last entry is transparent, for samples without a value."""
    table = np.full((256, 4), 255, dtype=np.uint8)
    table[:255, :3] = pg.colormap.get(name).getLookupTable(nPts=255)[:, :3]
    table[TRANSPARENT] = 0
    return table


def as_indices(values: np.ndarray, low: float, high: float) -> np.ndarray:
    """Return values as indices 0 to 254 of a colour table, TRANSPARENT where there is no value."""
    scaled = (values - low) * (254.0 / (high - low) if high > low else 0.0)
    known = np.isfinite(scaled)
    return np.where(known, np.clip(np.where(known, scaled, 0.0), 0, 254), TRANSPARENT).astype(np.uint8)


class ColourBar(QWidget):
    """A vertical colour bar with a few labelled values and a unit on top."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self._theme, self._name, self._unit = LIGHT, "CET-L4", ""
        self._labels: tuple[tuple[float, str], ...] = ()

    def sizeHint(self) -> QSize:
        """Return a width that holds bar and labels."""
        return QSize(62, 120)

    def show_scale(self, name: str, unit: str, labels: tuple[tuple[float, str], ...]) -> None:
        """Show a colour map with labels at parts (0 bottom to 1 top) of the bar."""
        if (name, unit, labels) != (self._name, self._unit, self._labels):
            self._name, self._unit, self._labels = name, unit, labels
            self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def paintEvent(self, event) -> None:
        """Paint the bar."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        painter.setFont(small_font())
        bar = QRectF(4, 22, 11, self.height() - 46)
        gradient = QLinearGradient(bar.bottomLeft(), bar.topLeft())
        table = lookup(self._name)
        for k in range(17):
            gradient.setColorAt(k / 16, QColor(*(int(c) for c in table[min(254, round(254 * k / 16))])))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(gradient)
        painter.drawRect(bar)
        painter.setPen(QPen(QColor(self._theme.muted)))
        painter.drawText(QPointF(3, 12), self._unit)
        for part, text in self._labels:
            y = bar.bottom() - part * bar.height()
            painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + 4, y))
            painter.drawText(QPointF(bar.right() + 7, y + 4), text)


class HeatMap(QWidget):
    """An image in physical coordinates with its colour bar."""

    def __init__(self, bottom: str, left: str, parent=None):
        super().__init__(parent)
        self.plot, self.bar = plot_widget(bottom, left, aspect=True), ColourBar(self)
        self.image = pg.ImageItem()
        self.plot.addItem(self.image)
        self._rect = None
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(self.plot, 1)
        row.addWidget(self.bar)

    def show_values(self, values: np.ndarray, levels: tuple[float, float], rect: tuple[float, float, float, float]):
        """Show rows +y of ``values`` over (x, y, width, height)."""
        self.image.setImage(as_indices(values, *levels), autoLevels=False)
        if rect != self._rect:
            self._rect = rect
            self.image.setRect(QRectF(*rect))

    def set_extent(self, half: float) -> None:
        """Show −half to half on both axes."""
        self.plot.setRange(xRange=(-half, half), yRange=(-half, half), padding=0.02)

    def set_map(self, name: str) -> None:
        """Use a colour map by name."""
        self.image.setLookupTable(lookup(name))
        self.image.setLevels(None)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        restyle_plot(self.plot, theme)
        self.bar.restyle(theme)
