"""A chart painted directly: axes kept as a pixmap, an image, curves.

A frame of the live path has some milliseconds for all its panels; a graphics scene takes two to five for each. Here
the background (axes, labels, glass) is painted once, and a thick line is several thin ones, which the rasteriser draws
twenty times faster than an outline that it must fill.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import hypot
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QPointF, QRect, QRectF, Qt, Signal
from PySide6.QtGui import QAccessible, QColor, QFocusEvent, QImage, QPainter, QPaintEvent, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf_explorer.charts.axes import TickMaker, area_of, lock_places, paint_axes, paint_home, paint_lock
from p2sf_explorer.charts.crosshair import paint_box, paint_crosshair, paint_expected, paint_marks, paint_pin, place_box
from p2sf_explorer.charts.hand import Hand
from p2sf_explorer.charts.painting import MARKS, paint_line_marks, pen, polylines
from p2sf_explorer.charts.reading import Reading, Samples, curves_at, map_at, place_at, vertex_at
from p2sf_explorer.charts.theme import DARK, LIGHT, Tokens
from p2sf_explorer.charts.view import AxisView, Span, pan, width, zoom
from p2sf_explorer.i18n.tr import tr

THICK = (0.5, 0.9)  # px between the thin lines of a thick one
Grid = tuple[str, np.ndarray, np.ndarray, np.ndarray]
"""Head, x, y and (y, x) values of a map, as it is copied."""
FINEST = 1e-6  # of an axis: finer digits of a curve's value are not read
VEIL = 170  # opacity of the dark bands behind axes over a picture: its brightest yellow leaves text at 7:1
TICK_PX = 4  # within the area
NEAR_PX = 9.0  # of a pinned marker, within which another press of its key or a click takes it away


@dataclass(frozen=True)
class Pin:
    """A pinned marker: a place of the data, whose value is read again whenever the data change."""

    x: float
    y: float


class Curve:
    """A line through points, broken where one is NaN; ``token`` names its colour in the theme, or is a colour itself.

    ``name`` is the head of its columns where the chart's data are copied.
    """

    name = ""
    marked = True  # where its colour has a mark and it has a name

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
            count = max(1, round(self.width * chart.theme.scale))
            for number in range(count):
                apart = number - (count - 1) / 2
                painter.drawPolyline(part.translated(apart * THICK[0], apart * THICK[1]) if apart else part)
        if self.name and self.marked and self.token in MARKS:
            paint_line_marks(painter, *chart.to_pixels(self.x, self.y), MARKS[self.token], chart.theme)


class Lockable(Protocol):
    """A colour bar whose scale can be locked."""

    @property
    def locked(self) -> bool:
        """Whether it is."""

    def turn_lock(self, on: bool) -> None:
        """Lock it, or let it go."""


class Chart(QWidget):
    """Labelled axes over a range, an optional image, and curves; ``aspect`` keeps circles round.

    The wheel zooms, a drag pans, a double-click goes home, a click pins a marker (`charts/hand.py`); where a chart
    `takes` a drag or ``takes_arrows`` for something else, Shift or the middle button pan. ``viewed``: the range has
    changed by hand, or since two plots share it; ``zoomed``: with the ranges moved to by hand; ``let_go``: a lock was
    opened by hand; ``pointed``: the crosshair is at another place of the data, None for none.
    """

    accessible_role = QAccessible.Role.Chart
    viewed = Signal()
    zoomed = Signal(object)
    let_go = Signal()
    pointed = Signal(object)
    takes_arrows = False
    kept_clear: tuple[float, float, float] | None = None  # middle and half side of a square that boxes do not cover
    bleeds = False  # whether the picture runs under the axes
    smooth = False  # whether the image's pixels are samples of a smooth picture, and not squares
    over = "bottom"  # the axis that the curves are functions of
    grids: tuple[Grid, ...] = ()  # copied in place of the curves
    columns: tuple[str, str] | None = None  # names of x and y where they are copied, if other than on the axes
    left_tick_maker: TickMaker | None = None  # in place of round numbers
    bottom_tick_maker: TickMaker | None = None
    write_bottom: Callable[[float], str] | None = None  # the words of a place on the bottom axis

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
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(120, 90)
        self.theme: Tokens = LIGHT
        self.curves: list[Curve] = []
        self.bottom_ticks: tuple[tuple[float, str], ...] = ()  # in place of round numbers
        self.left_axis = self.left_name = True
        self._labels, self.round, self.framed = (tr(bottom), tr(left)), aspect, framed
        self.x_axis, self.y_axis = AxisView(), AxisView()
        self._scale_held: tuple[str, float | None] = "", None
        self.samples: Samples | None = None
        self.bar: Lockable | None = None  # of the image's colours
        self.ground: int | None = None  # 0xffRRGGBB beyond the image
        self.pins: tuple[Pin, ...] = ()
        self.expects = ""  # "ring" or "level", which the last marker then stands for
        self._scale: tuple[float, float, float, float] | None = None
        self._area: tuple[tuple[int, int], QRectF] | None = None  # by the size that it is of
        self._background: QPixmap | None = None
        self._over: QPixmap | None = None  # the axes, where they stand over the picture
        self._image: tuple[np.ndarray, tuple[float, float, float, float]] | None = None
        self.hand = Hand(self)
        self._name_for_readers()

    @property
    def labels(self) -> tuple[str, str]:
        """Return the names of the bottom and the left axis."""
        return self._labels

    def name_axes(self, bottom: str, left: str) -> None:
        """Give the axes other names."""
        if (tr(bottom), tr(left)) != self._labels:
            self._labels = tr(bottom), tr(left)
            self._name_for_readers()
            self.forget_background()

    def _name_for_readers(self) -> None:
        bottom, left = self._labels
        self.setAccessibleName(tr("Plot: {left} over {bottom}", left=left, bottom=bottom) if left else tr("Plot"))

    def add_curve(self, token: str, width: float = 1.0, alpha: int = 255, name: str = "") -> Curve:
        """Return a new curve on top of the others; its English ``name`` stands in readings and in copied data."""
        self.curves.append(Curve(token, width, alpha))
        self.curves[-1].name = tr(name) if name else ""
        return self.curves[-1]

    def set_range(self, x: Span, y: Span, steady: str = "") -> None:
        """Show these ranges where no hand and no lock has set another, those of ``steady`` ("x", "y", "xy") in steps.

        The background is painted again only when they change.
        """
        before = self.x_axis.shown, self.y_axis.shown
        self.x_axis, self.y_axis = self.x_axis.fitted(x, "x" in steady), self.y_axis.fitted(y, "y" in steady)
        if before != (self.x_axis.shown, self.y_axis.shown):
            self.forget_background()

    def set_view(self, middle: tuple[float, float], half: float) -> None:
        """Show a square about ``middle`` whole, to ``half`` on either side."""
        x, y = middle
        self.set_range((x - half, x + half), (y - half, y + half))

    def hold(self, axes: str, end: float | None) -> None:
        """Lock these axes from −end to end, or open them for None; a lock turned by hand since stays as it is."""
        if (axes, end) != self._scale_held:
            self._scale_held = axes, end
            locked = None if end is None else (-end, end)
            x, y = (replace(axis, locked=locked, moved=None) for axis in (self.x_axis, self.y_axis))
            self._see(x if "x" in axes else self.x_axis, y if "y" in axes else self.y_axis)

    def share(self, x: Span | None, y: Span | None) -> None:
        """Show these ranges in place of the automatic ones, None for those."""
        self._see(replace(self.x_axis, shared=x), replace(self.y_axis, shared=y))

    def zoom_to(self, spans: tuple[Span | None, Span | None]) -> None:
        """Show these ranges as if moved there by hand, None for the whole plot."""
        x, y = spans
        self._see(replace(self.x_axis, moved=x), replace(self.y_axis, moved=y))

    def point_at(self, place: tuple[float, float] | None) -> None:
        """Put the crosshair at a place of the data, or take it away; nobody is told."""
        self.hand.at = QPointF(*(float(v) for v in self.to_pixels(*place))) if place else None
        self.update()

    @property
    def moved(self) -> bool:
        """Return whether zoom or pan has left the whole plot."""
        return bool(self.x_axis.moved or self.y_axis.moved)

    @property
    def locked(self) -> bool:
        """Return whether a scale is locked."""
        return bool(self.x_axis.locked or self.y_axis.locked or (self.bar and self.bar.locked))

    def takes(self, point: QPointF) -> bool:
        """Return whether a press at a pixel is the chart's own, and does not pan or pin; for subclasses."""
        return False

    def zoom(self, about: QPointF, factor: float, axes: str = "xy") -> None:
        """Show ``factor`` times as much about a pixel, along one axis or both; circles stay round."""
        (x, y), at = self.ranges(), self.from_pixels(about)
        axes = "xy" if self.round else axes
        self._move(
            *(zoom(span, v, factor) if name in axes else None for name, span, v in zip("xy", (x, y), at, strict=True))
        )

    def pan(self, by: QPointF) -> None:
        """Move the picture by some pixels."""
        area, (x, y) = self.area, self.ranges()
        self._move(pan(x, -by.x() / area.width() * width(x)), pan(y, by.y() / area.height() * width(y)))

    def _move(self, x: Span | None, y: Span | None) -> None:
        axes = (self.x_axis.moved_to(x) if x else self.x_axis), (self.y_axis.moved_to(y) if y else self.y_axis)
        stuck = (bool(x) and axes[0] is self.x_axis) or (bool(y) and axes[1] is self.y_axis)
        if not stuck:  # both or neither, or circles would not stay round
            self._see(*axes)

    def go_home(self) -> None:
        """Show the whole plot, or what is locked."""
        self._see(self.x_axis.at_home(), self.y_axis.at_home())

    def turn_lock(self, axes: str) -> None:
        """Lock the scale of "x", "y", "xy" or "all", colours too, as it is, or let it follow the data again."""
        x, y = self.x_axis, self.y_axis
        on = not {"x": x.locked, "y": y.locked, "xy": x.locked or y.locked}.get(axes, self.locked)
        if axes == "all" and self.bar:
            self.bar.turn_lock(on)
        self._see(x if axes == "y" else x.with_lock(on), y if axes == "x" else y.with_lock(on))
        if not on:
            self.let_go.emit()

    def _see(self, x: AxisView, y: AxisView) -> None:
        if (x, y) != (self.x_axis, self.y_axis):
            self.x_axis, self.y_axis = x, y
            self.forget_background()
            self.viewed.emit()
            self.zoomed.emit((x.moved, y.moved))

    def pin(self, point: QPointF) -> bool:
        """Pin a marker at a pixel, or take away the one that is there; return whether one was pinned."""
        for pin, reading in self.pinned():
            if (self._pixel(reading.place) - point).manhattanLength() < NEAR_PX:
                self._keep_pins(tuple(other for other in self.pins if other != pin))
                return False
        found = self.read(*self.from_pixels(point))
        if found:
            self._keep_pins((*self.pins, Pin(*found.place)))
        return found is not None

    def unpin_last(self) -> bool:
        """Remove the last marker; return whether there was one."""
        return self._keep_pins(self.pins[:-1])

    def unpin_all(self) -> bool:
        """Remove all markers; return whether there were any."""
        return self._keep_pins(())

    def expect(self, form: str) -> None:
        """Let the next marker stand for what is expected: a "ring" about the origin, a "level", or nothing."""
        self.expects = form
        self.unpin_all()

    @property
    def expected(self) -> float | None:
        """Return the radius or the height that was marked, None without a marker."""
        if not (self.expects and self.pins):
            return None
        pin = self.pins[-1]
        return hypot(pin.x, pin.y) if self.expects == "ring" else pin.y

    def _keep_pins(self, pins: tuple[Pin, ...]) -> bool:
        changed, self.pins = pins != self.pins, pins
        if changed:
            self.update()
        return changed

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return what the plot says at a place of its data; curves at their own samples if it may ``snap`` to those."""
        if self.samples is not None:
            return map_at(self.samples, x, y, self.reading_labels)
        labels, curves = self.reading_labels, self.readable()
        if self.over == "path":
            return vertex_at(curves, x, y, self.pixel_size(), labels)
        flat = self.over == "bottom"
        least = FINEST * width((self.y_axis if flat else self.x_axis).home)
        found = curves_at(curves, labels, x if flat else y, self.over, snap, self.write_bottom, least)
        return found or place_at(x, y, labels)

    @property
    def reading_labels(self) -> tuple[str, str]:
        """Return the names of x and y as they are read, with their units."""
        return (tr(self.columns[0]), tr(self.columns[1])) if self.columns else self.labels

    def readable(self) -> list[Curve]:
        """Return the curves that are read: those with names, else all but lines of the ground."""
        shown = [curve for curve in self.curves if curve.x.size and curve.token not in ("line", "card")]
        return [curve for curve in shown if curve.name] or shown

    def pinned(self) -> list[tuple[Pin, Reading]]:
        """Return the markers with what they read at present."""
        found = ((pin, self.read(pin.x, pin.y, snap=False)) for pin in self.pins)
        return [(pin, reading) for pin, reading in found if reading]

    def crosshair(self) -> Reading | None:
        """Return what stands under the pointer."""
        at = self.hand.at
        return self.read(*self.from_pixels(at)) if at and self.area.contains(at) else None

    def bleed(self, on: bool) -> None:
        """Have the picture run under the axes, to the edges of the chart, or within them."""
        if on != self.bleeds:
            self.bleeds = on
            self.forget_background()
            self.viewed.emit()

    @property
    def axes_theme(self) -> Tokens:
        """Return the colours of the axes: over a picture those that stand out from its dark ground."""
        return replace(DARK, scale=self.theme.scale, muted=DARK.text) if self.bleeds else self.theme

    def show_pixels(
        self, pixels: np.ndarray, rect: tuple[float, float, float, float], samples: Samples | None = None
    ) -> None:
        """Show 0xffRRGGBB pixels, rows +y, over (x, y, width, height), and what is read in their place."""
        self._image, self.samples = (np.ascontiguousarray(pixels[::-1]), rect), samples
        self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.theme = theme
        self.forget_background()

    def forget_background(self) -> None:
        """Have the background painted again."""
        self._background = self._over = self._scale = self._area = None
        self.update()

    @property
    def area(self) -> QRectF:
        """Return the rectangle of the data, in pixels."""
        size = self.width(), self.height()
        if self._area is None or self._area[0] != size:  # asked for a dozen times in a frame
            framed = self.framed and not self.bleeds
            self._area = size, area_of(self, self._labels) if framed else QRectF(self.rect())
        return QRectF(self._area[1])

    def ranges(self) -> tuple[Span, Span]:
        """Return the shown ranges: those set, one of them widened where circles must be round."""
        return self._round(self.x_axis.shown, self.y_axis.shown)

    def _round(self, across: Span, up: Span) -> tuple[Span, Span]:
        if not self.round:
            return across, up
        area = self.area
        scale = max(width(across) / area.width(), width(up) / area.height())
        half = scale * area.width() / 2, scale * area.height() / 2
        x, y = (across[0] + across[1]) / 2, (up[0] + up[1]) / 2
        return (x - half[0], x + half[0]), (y - half[1], y + half[1])

    def magnification(self) -> tuple[float, float]:
        """Return how many times larger than the whole plot the picture is along x and y."""
        home, shown = self._round(self.x_axis.home, self.y_axis.home), self.ranges()
        return width(home[0]) / width(shown[0]), width(home[1]) / width(shown[1])

    def per_pixel(self) -> float:
        """Return the length of one pixel along x, in data."""
        return width(self.ranges()[0]) / self.area.width()

    def to_pixels(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Return the pixels of data, numbers or arrays as they come."""
        if self._scale is None:
            area, ((left, right), (low, high)) = self.area, self.ranges()
            wide, tall = area.width() / (right - left), area.height() / (high - low)
            self._scale = area.left() - left * wide, wide, area.bottom() + low * tall, tall
        x0, wide, y0, tall = self._scale
        return x0 + x * wide, y0 - y * tall

    def _pixel(self, place: tuple[float, float]) -> QPointF:
        return QPointF(*(float(v) for v in self.to_pixels(*place)))

    def pixel_size(self) -> tuple[float, float]:
        """Return the size of one pixel in data."""
        area, (x, y) = self.area, self.ranges()
        return width(x) / area.width(), width(y) / area.height()

    def from_pixels(self, point: QPointF) -> tuple[float, float]:
        """Return the data coordinates of a pixel."""
        area, ((left, right), (low, high)) = self.area, self.ranges()
        across, up = (point.x() - area.left()) / area.width(), (area.bottom() - point.y()) / area.height()
        return left + across * (right - left), low + up * (high - low)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Paint everything again in the new size."""
        self._background = self._over = self._scale = None
        super().resizeEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show the focus."""
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Show that the focus has gone."""
        super().focusOutEvent(event)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint background, image, curves, and what lies above."""
        if self._background is None or self._background.devicePixelRatio() != self.devicePixelRatioF():
            self._background = self._painted_background()
        painter, image = QPainter(self), self._image and self._image_rect(self._image[1])
        self._paint_ground(painter, image or QRectF())
        painter.setClipRect(self.area)
        if image and self._image:
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, self.smooth)
            painter.drawImage(image, image_of(self._image[0]))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for curve in self.curves:
            curve.paint(painter, self)
        self.paint_over(painter)
        painter.setClipping(False)
        if self.bleeds:
            self._paint_axes_over(painter)
        self._paint_readings(painter)
        self._paint_buttons(painter)

    def _paint_axes_over(self, painter: QPainter) -> None:
        """Paint the axes on dark bands over the picture, kept as a pixmap."""
        if self._over is None or self._over.size() != self.size() * self.devicePixelRatioF():
            self._over = blank_pixmap(self, "#00000000")
            frame, veil = area_of(self, self._labels), QColor(0, 0, 0, VEIL)
            on_it = QPainter(self._over)
            on_it.setRenderHint(QPainter.RenderHint.Antialiasing)
            on_it.fillRect(QRectF(0, 0, frame.left(), self.height()), veil)
            on_it.fillRect(QRectF(frame.left(), frame.bottom(), self.width(), self.height()), veil)
            paint_axes(on_it, self, self._labels)
            on_it.end()
        painter.drawPixmap(0, 0, self._over)

    def _paint_ground(self, painter: QPainter, image: QRectF) -> None:
        """Paint axes and ground, each pixel once: copying the background takes longer than filling with a colour.

        By rectangles: a clip of several would be painted line by line.
        """
        area, whole = self.area.toRect(), self.rect()
        covered = (image & self.area).toRect().adjusted(2, 2, -2, -2) if image.isValid() else QRect()
        edge = self.theme.px(TICK_PX) + 1 if self.framed and not self.bleeds else 0
        plain, colour = covered, self.theme.card
        if image.isValid() and self.ground is not None and not image.contains(self.area):
            plain, colour = area, QColor.fromRgb(self.ground).name()
        elif type(self).paint_background is Chart.paint_background:
            plain = area.adjusted(edge, 2, -2, -edge) | covered
        if self._background:
            ratio = self._background.devicePixelRatio()
            for room in strips(whole, plain):
                source = QRectF(room.x() * ratio, room.y() * ratio, room.width() * ratio, room.height() * ratio)
                painter.drawPixmap(QRectF(room), self._background, source)
        for room in strips(plain, covered):
            painter.fillRect(room, QColor(colour))

    def paint_background(self, painter: QPainter) -> None:
        """Paint what belongs to the background beside the axes; for subclasses."""

    def paint_over(self, painter: QPainter) -> None:
        """Paint what lies above the curves; for subclasses."""

    def _paint_readings(self, painter: QPainter) -> None:
        """Paint the pinned markers that are on screen, and the crosshair."""
        if not self.pins and not self.hand.at:
            return
        boxes = [self._square(*self.kept_clear)] if self.kept_clear else []
        if self.expects and self.pins:
            painter.setClipRect(self.area)
            paint_expected(painter, self, (self.pins[-1].x, self.pins[-1].y))
            painter.setClipping(False)
        for number, (_, read) in enumerate(self.pinned(), 1):
            reading = replace(read, head=f"{number}  {read.head}")
            if self.area.contains(self._pixel(reading.place)):
                shown, box = place_box(reading, self, boxes)
                boxes.append(box)
                paint_marks(painter, self, reading)
                paint_pin(painter, self, reading.place)
                paint_box(painter, self, shown, box, pinned=True)
        if found := self.crosshair():
            paint_crosshair(painter, self, found)
            paint_marks(painter, self, found)
            paint_box(painter, self, *place_box(found, self, boxes))

    def _paint_buttons(self, painter: QPainter) -> None:
        """Paint the locks that are closed, and all buttons while the pointer or the focus is here; and the focus."""
        here = self.hand.at is not None or self.hasFocus()
        if not here and not self.locked:
            return
        closed = {"x": self.x_axis.locked, "y": self.y_axis.locked, "xy": self.x_axis.locked or self.y_axis.locked}
        for name, room in lock_places(self).items():
            if name == "home" and self.moved and here:
                paint_home(painter, room, QColor(self.theme.muted))
            elif name != "home" and (here or closed[name]):
                colour = self.theme.accent if closed[name] else self.theme.muted
                paint_lock(painter, room, QColor(colour), bool(closed[name]))
        if self.hasFocus():
            painter.setPen(QPen(QColor(self.theme.accent), self.theme.scale))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5))

    def _square(self, x: float, y: float, half: float) -> QRectF:
        """Return the pixels of a square of the data."""
        return self._image_rect((x - half, y - half, 2 * half, 2 * half))

    def _image_rect(self, rect: tuple[float, float, float, float]) -> QRectF:
        x, y, width, height = rect
        (left, bottom), (right, top) = self.to_pixels(x, y), self.to_pixels(x + width, y + height)
        return QRectF(left, top, right - left, bottom - top)

    def _painted_background(self) -> QPixmap:
        background = blank_pixmap(self, self.theme.card)
        painter = QPainter(background)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self.framed and not self.bleeds:
            paint_axes(painter, self, self._labels)
        self.paint_background(painter)
        painter.end()
        return background


def strips(outer: QRect, inner: QRect) -> list[QRect]:
    """Return the parts of a rectangle around another within it: above, below, left and right; all of it for none."""
    if inner.isEmpty():
        return [outer] if not outer.isEmpty() else []
    high, low = inner.top() - outer.top(), outer.bottom() - inner.bottom()
    found = [
        QRect(outer.left(), outer.top(), outer.width(), high),
        QRect(outer.left(), inner.bottom() + 1, outer.width(), low),
        QRect(outer.left(), inner.top(), inner.left() - outer.left(), inner.height()),
        QRect(inner.right() + 1, inner.top(), outer.right() - inner.right(), inner.height()),
    ]
    return [room for room in found if not room.isEmpty()]


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
