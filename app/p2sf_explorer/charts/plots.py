"""Plots in the look of the window: axes, heat maps, colour bars."""

from dataclasses import replace
from functools import lru_cache
from importlib.util import find_spec
from math import ceil
from pathlib import Path

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QHelpEvent, QLinearGradient, QMouseEvent, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QToolTip, QWidget

from p2sf_explorer.charts.axes import LOCK_PX, paint_lock
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.colour_scale import ColourScale, ScaleLock
from p2sf_explorer.charts.painting import width_of, write
from p2sf_explorer.charts.reading import Samples
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.charts.view import Span, keep_or_grow
from p2sf_explorer.i18n.tr import tr

BRIGHTNESS = "brightness"  # stands for the colour map that the theme has for brightness
NARROW_PX = 245  # below this width, as beside a lesson, a heat map has no colour bar and no name at the left
Rect = tuple[float, float, float, float]
"""x, y, width, height in the data."""
EMPTY = 255  # the index of a colour table that is kept for "no value"


@lru_cache(maxsize=8)
def lookup(name: str) -> np.ndarray:
    """Return a colour table (256,) of 0xffRRGGBB whose last entry is for samples without a value."""
    colours = _colour_map(name)
    wanted = np.linspace(0, len(colours) - 1, EMPTY)
    red, green, blue = (np.interp(wanted, np.arange(len(colours)), one).astype(np.uint32) for one in colours.T)
    table = np.full(256, 0xFFFFFFFF, dtype=np.uint32)
    table[:EMPTY] = 0xFF000000 | red << 16 | green << 8 | blue
    return table


def _colour_map(name: str) -> np.ndarray:
    """Return the colours of a map of pyqtgraph, (n, 3) from 0 to 255.

    Read from its file, since all of pyqtgraph, which an import loads, takes a quarter of a second.
    """
    found = find_spec("pyqtgraph")
    (folder,) = found.submodule_search_locations if found and found.submodule_search_locations else ("",)
    table = np.loadtxt(Path(folder) / "colors" / "maps" / f"{name}.csv", delimiter=",", comments=";")
    return np.floor(255 * table + 0.5)


def colour_map_name(name: str, theme: Tokens) -> str:
    """Return the colour map that a name stands for: the theme's own for `BRIGHTNESS`."""
    return theme.brightness if name == BRIGHTNESS else name


def as_indices(values: np.ndarray, low: float, high: float) -> np.ndarray:
    """Return values as indices 0 to 254 of a colour table, EMPTY where one is NaN."""
    scaled = (values - low) * (254.0 / (high - low) if high > low else 0.0)
    np.clip(scaled, 0, 254, out=scaled)
    scaled[np.isnan(scaled)] = EMPTY
    return scaled.astype(np.uint8)


class ColourBar(QWidget):
    """A vertical colour bar with a few labelled values, a unit on top and a lock below, which keeps its ends.

    It widens for long labels and stays wide. ``turned``: the lock was closed or opened.
    """

    turned = Signal()
    WIDTH, TICK = 62, 22  # px at scale 1: the least, and from the left edge to a label

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)  # under the pointer it shows its lock
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self._theme, self._name, self._unit = LIGHT, "CET-L4", ""
        self._labels: tuple[tuple[float, str], ...] = ()
        self._wide = self.WIDTH
        self._scale: ColourScale | None = None
        self._lock: ScaleLock | None = None
        self.shared: ScaleLock | None = None  # the ends of two plots side by side
        self.own_ends: ScaleLock | None = None  # of the picture alone
        self._automatic: Span = (0.0, 1.0)

    def sizeHint(self) -> QSize:
        """Return a width with room for bar and labels."""
        return QSize(self._wide, 120)

    @property
    def locked(self) -> bool:
        """Return whether pictures to come keep the ends of the bar."""
        return self._lock is not None

    @property
    def top(self) -> float:
        """Return the value at the upper end."""
        return self._scale.high if self._scale else 1.0

    def turn_lock(self, on: bool) -> None:
        """Keep the ends as they are, or have them follow the pictures again."""
        if on != self.locked:
            self._lock = ScaleLock.of(self._scale) if on and self._scale else None
            self.update()
            self.turned.emit()

    def settled(self, scale: ColourScale) -> tuple[ColourScale, float]:
        """Show the scale for a picture and return it, locked or in coarse steps, with the factor of the values."""
        self.own_ends = ScaleLock.of(scale)
        kept = self._lock or self.shared
        found = kept.apply_to(scale) if kept else None
        if found is None:
            self._lock = None
            if scale.steady:
                self._automatic = keep_or_grow(self._automatic, (scale.low, scale.high))
                scale = replace(scale, low=self._automatic[0], high=self._automatic[1])
            found = scale, 1.0
        self._scale = found[0]
        of_whom = "locked peak" if self.locked else "higher peak"
        unit = of_whom if found[0].relative and kept else found[0].unit
        self.show_scale(found[0].name, unit, found[0].labels())
        return found

    def show_scale(self, name: str, unit: str, labels: tuple[tuple[float, str], ...]) -> None:
        """Show a colour map with labels at parts (0 bottom to 1 top) of the bar; ``unit`` is translated here."""
        if (name, unit, labels) != (self._name, self._unit, self._labels):
            self._name, self._unit, self._labels = name, unit, labels
            self._widen()
            self.update()

    def _widen(self) -> None:
        """Take the room the labels need and keep it, or the map beside would change its size with every label."""
        size, px = self._theme.tick, self._theme.px
        widest = max((width_of(text, size) for _, text in self._labels), default=0)
        need = max(px(self.WIDTH), ceil(px(self.TICK) + widest) + 2, ceil(width_of(tr(self._unit), size)) + px(5))
        if need > self._wide:
            self._wide = need
            self.updateGeometry()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        if theme.scale != self._theme.scale:
            self._wide = 0
        self._theme = theme
        self._widen()
        self.update()

    def lock_place(self) -> QRectF:
        """Return the rectangle of the lock."""
        side = self._theme.px(LOCK_PX)
        return QRectF(self._theme.px(9.5) - side / 2, self.height() - side - 2, side, side)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Turn the lock."""
        if event.button() == Qt.MouseButton.LeftButton and self._scale and self.lock_place().contains(event.position()):
            self.turn_lock(not self.locked)
        else:
            super().mousePressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the bar."""
        painter, theme, size = QPainter(self), self._theme, self._theme.tick
        painter.fillRect(self.rect(), QColor(theme.card))
        bar = QRectF(theme.px(4), theme.px(22), theme.px(11), self.height() - theme.px(46))
        gradient = QLinearGradient(bar.bottomLeft(), bar.topLeft())
        table = lookup(colour_map_name(self._name, theme))
        for k in range(17):
            gradient.setColorAt(k / 16, QColor.fromRgb(int(table[min(254, round(254 * k / 16))])))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(gradient)
        painter.drawRect(bar)
        painter.setPen(QPen(QColor(theme.muted), theme.scale))
        write(painter, QRectF(theme.px(3), 0, self.width(), theme.px(16)), tr(self._unit), -1, size)
        for part, text in self._labels:
            y = bar.bottom() - part * bar.height()
            painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + theme.px(4), y))
            room = QRectF(theme.px(self.TICK), y - theme.px(8), self.width(), theme.px(16))
            write(painter, room, text, -1, size)
        if self._scale and (self.locked or self.underMouse()):
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            colour = QColor(theme.accent if self.locked else theme.muted)
            paint_lock(painter, self.lock_place(), colour, self.locked)

    def event(self, event: QEvent) -> bool:
        """Say what the lock does."""
        if isinstance(event, QHelpEvent) and self._scale and self.lock_place().contains(QPointF(event.pos())):
            QToolTip.showText(event.globalPos(), tr("Lock the colours: other pictures keep the ends of the bar"), self)
            return True
        return super().event(event)


class HeatMap(QWidget):
    """An image in physical coordinates with its colour bar; curves go on ``chart``.

    ``resized``: the picture has other pixels than before, by its size or by zooming.
    """

    resized = Signal()

    def __init__(self, bottom: str, left: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.chart, self.bar = Chart(bottom, left, aspect=True), ColourBar(self)
        self.chart.bar = self.bar
        self.indices = np.zeros((1, 1), np.uint8)
        self.values: np.ndarray | None = None
        self.quantity, self._name = "", "CET-L4"
        self._rect: Rect | None = None
        self._shown: tuple[np.ndarray, Rect, ColourScale, np.ndarray | None] | None = None
        self._mapped: tuple[str, Tokens] | None = None
        self._table = lookup(self._name)
        self.row = QHBoxLayout(self)
        self.row.setContentsMargins(0, 0, 0, 0)
        self.row.setSpacing(0)
        self.row.addWidget(self.chart, 1)
        self.row.addWidget(self.bar)
        self.bar.turned.connect(self._again)
        self.chart.viewed.connect(self.resized)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide the colour bar and the left axis's name where there is little room, so that the picture has it."""
        super().resizeEvent(event)
        wide = event.size().width() >= self.chart.theme.px(NARROW_PX)
        if wide != self.chart.left_name:
            self.chart.left_name = wide
            self.bar.setVisible(wide)
            self.chart.forget_background()
        self.resized.emit()

    @property
    def reach(self) -> float:
        """Return how far from zero the picture shows its data along x or y."""
        return max(abs(end) for span in self.chart.ranges() for end in span)

    @property
    def device_pixel(self) -> float:
        """Return the width of a pixel of the screen, in data."""
        return self.chart.per_pixel() / self.devicePixelRatioF()

    def show_map(self, values: np.ndarray, rect: Rect, scale: ColourScale, painted: np.ndarray | None = None) -> None:
        """Show rows +y of ``values`` over (x, y, width, height) in a scale's colours, or ``painted`` in their place.

        Values are read and copied as they are here; where colours are locked, in the locked unit.
        """
        self._shown = values, rect, scale, painted
        used, factor = self.bar.settled(scale)
        self.set_map(scale.name)
        looked = values if painted is None else painted
        self.indices = as_indices(used.parts(looked * factor if factor != 1 else looked), 0.0, 1.0)
        self._rect = rect
        self.chart.ground = int(self._table[127 if used.signed else 0]) if scale.grounded else None
        self.chart.show_pixels(self._table[self.indices], rect)
        self.means(values * factor if factor != 1 else values, scale.quantity)

    def share_colours(self, ends: ScaleLock | None) -> None:
        """Show colours between these ends, None for those of the picture."""
        if ends != self.bar.shared:
            self.bar.shared = ends
            self._again()

    def _again(self) -> None:
        if self._shown:
            self.show_map(*self._shown)

    def show_values(self, values: np.ndarray, levels: tuple[float, float], rect: Rect) -> None:
        """Show rows +y of ``values`` over (x, y, width, height)."""
        self.indices, self._rect = as_indices(values, *levels), rect
        self.chart.show_pixels(self._table[self.indices], rect)
        self.means(values, "")

    def means(self, values: np.ndarray, quantity: str) -> None:
        """Set what is read and copied: ``values`` before they were stretched, their quantity and unit in English."""
        self.values, self.quantity = values, quantity
        if self._rect:
            self.chart.samples = Samples(values, self._rect, tr(quantity) if quantity else "")

    @property
    def rect_shown(self) -> Rect | None:
        """Return the rectangle of the values: x, y, width, height."""
        return self._rect

    def set_map(self, name: str) -> None:
        """Use a colour map by name."""
        if (name, self.chart.theme) != self._mapped:
            self._mapped, self._name = (name, self.chart.theme), name
            self._table = lookup(colour_map_name(name, self.chart.theme)).copy()
            self._table[EMPTY] = QColor(self.chart.theme.card).rgb()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
        self.bar.restyle(theme)
        self.set_map(self._name)
        if self._shown:
            self._again()
        elif self._rect:
            self.chart.show_pixels(self._table[self.indices], self._rect, self.chart.samples)
