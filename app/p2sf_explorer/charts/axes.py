"""The axes of a chart: lines, ticks, names, and the locks beside them."""

from collections.abc import Callable, Sequence
from math import ceil, floor
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf_explorer.charts.painting import fitting, width_of, write
from p2sf_explorer.charts.reading import RAISED
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.state.scales import ticks

if TYPE_CHECKING:
    from p2sf_explorer.charts.chart import Chart

Ticks = Sequence[tuple[float, str]]
TickMaker = Callable[[float, float, float], Ticks]
"""From the ends of an axis and about how many there may be, ticks and their labels."""
TICK_EVERY_PX, MOST_TICKS = {"bottom": 66, "left": 34}, 10  # at least so far apart at scale 1, and about so many
AXIS_PX = {"bottom": 20, "left": 44, "name": 16, "top": 5, "right": 9, "bare": 8}  # margins at scale 1
LOCK_PX = 15


def decades(low: float, high: float, most: float) -> list[tuple[float, str]]:
    """Return whole decades with their values: numbers near one, powers of ten elsewhere."""
    step = max(1, ceil((high - low) / max(1.0, most)))
    shown = range(ceil(low), floor(high) + 1, step)
    return [(float(k), f"{10.0**k:g}" if -2 <= k <= 3 else "10" + str(k).translate(RAISED)) for k in shown]


def area_of(chart: "Chart", labels: tuple[str, str]) -> QRectF:
    """Return the rectangle of the data within the axes, in pixels."""
    px = {name: chart.theme.px(length) for name, length in AXIS_PX.items()}
    left = (px["left"] if chart.left_axis else px["bare"]) + (px["name"] if labels[1] and chart.left_name else 0)
    bottom = px["bottom"] + (px["name"] if labels[0] else 0)
    wide, tall = chart.width() - left - px["right"], chart.height() - bottom - px["top"]
    return QRectF(left, px["top"], max(10, wide), max(10, tall))


def paint_axes(painter: QPainter, chart: "Chart", labels: tuple[str, str]) -> None:
    """Paint two axes, their ticks and labels."""
    area, theme, small = area_of(chart, labels), chart.axes_theme, chart.theme.tick
    painter.setPen(QPen(QColor(theme.line), theme.scale))
    painter.drawLine(area.bottomLeft(), area.bottomRight())
    for value, text in bottom_ticks(chart):
        x = float(chart.to_pixels(value, 0.0)[0])
        if not area.left() - 1 <= x <= area.right() + 1:
            continue
        _tick(painter, theme, QPointF(x, area.bottom()), QPointF(x, area.bottom() - theme.px(4)))
        wide = width_of(text, small)
        middle = min(x, chart.width() - wide / 2)  # so that the last one is not cut off
        write(painter, QRectF(middle - wide, area.bottom() + theme.px(3), 2 * wide, theme.px(15)), text, 0, small)
    row, lock = QRectF(area.left(), area.bottom() + theme.px(18), area.width(), theme.px(16)), theme.px(LOCK_PX)
    write(painter, row, fitting(labels[0], area.width() - 2 * lock, theme.label), 0, theme.label)
    if chart.left_axis:
        _paint_left(painter, chart, labels[1], area.bottom())


def left_ticks(chart: "Chart") -> Ticks:
    """Return the left axis's ticks and their labels."""
    return (chart.left_tick_maker or ticks)(*chart.ranges()[1], _room_for(chart.area.height(), chart, "left"))


def bottom_ticks(chart: "Chart") -> Ticks:
    """Return the bottom axis's ticks and their labels; where circles are round as close as those of the left axis."""
    most = _room_for(chart.area.width(), chart, "bottom")
    if chart.round:
        widest = max((width_of(text, chart.theme.tick) for _, text in left_ticks(chart)), default=0.0)
        most = min(MOST_TICKS, chart.area.width() / (widest + chart.theme.px(14)))
    return chart.bottom_ticks or (chart.bottom_tick_maker or ticks)(*chart.ranges()[0], most)


def _room_for(length: float, chart: "Chart", side: str) -> float:
    """Return how many ticks there may be along an axis."""
    return min(MOST_TICKS, length / chart.theme.px(TICK_EVERY_PX[side]))


def _paint_left(painter: QPainter, chart: "Chart", label: str, bottom: float) -> None:
    area, theme, small = area_of(chart, ("", label)), chart.axes_theme, chart.theme.tick
    area.setBottom(bottom)
    painter.setPen(QPen(QColor(theme.line), theme.scale))
    painter.drawLine(area.bottomLeft(), area.topLeft())
    for value, text in left_ticks(chart):
        y = float(chart.to_pixels(0.0, value)[1])
        if not area.top() - 1 <= y <= area.bottom() + 1:
            continue
        _tick(painter, theme, QPointF(area.left(), y), QPointF(area.left() + theme.px(4), y))
        room = QRectF(area.left() - theme.px(60), y - theme.px(8), theme.px(55), theme.px(16))
        write(painter, room, text, 1, small)
    if not chart.left_name:
        return
    painter.setPen(QColor(theme.muted))
    painter.rotate(-90)
    room = QRectF(-area.bottom() - 40, 0, area.height() + 80, theme.px(16))
    write(painter, room, fitting(label, area.height() - 2 * theme.px(LOCK_PX), theme.label), 0, theme.label)
    painter.rotate(90)


def _tick(painter: QPainter, theme: Tokens, start: QPointF, end: QPointF) -> None:
    painter.setPen(QPen(QColor(theme.line), theme.scale))
    painter.drawLine(start, end)
    painter.setPen(QColor(theme.muted))


def lock_places(chart: "Chart") -> dict[str, QRectF]:
    """Return the rectangles of the buttons: locks of "x", "y", or of both, "xy", and "home" beside the first."""
    side, area = chart.theme.px(LOCK_PX), chart.area
    right, bottom = chart.width() - side - 1, chart.height() - side - 1
    first = "xy" if chart.round or not chart.framed else "x"
    found = {first: QRectF(right, bottom, side, side), "home": QRectF(right - side - 2, bottom, side, side)}
    if first == "x" and chart.left_axis:
        found["y"] = QRectF(0, area.top() - chart.theme.px(AXIS_PX["top"]), side, side)
    return found


def paint_lock(painter: QPainter, room: QRectF, colour: QColor, closed: bool) -> None:
    """Paint a padlock."""
    unit = room.width() / 15
    painter.setPen(QPen(colour, 1.4 * unit))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    left, top = room.left() + 4.5 * unit, room.top() + 2 * unit
    aside = 0.0 if closed else 4.2 * unit  # an open shackle stands beside the body
    painter.drawArc(QRectF(left + aside, top, 6 * unit, 8 * unit), 0, 180 * 16)
    if closed:
        painter.drawLine(QPointF(left + 6 * unit, top + 4 * unit), QPointF(left + 6 * unit, top + 5 * unit))
    painter.drawLine(QPointF(left + aside, top + 4 * unit), QPointF(left + aside, top + 5 * unit))
    painter.fillRect(QRectF(room.left() + 3 * unit, top + 5 * unit, 9 * unit, 6.5 * unit), colour)


def paint_home(painter: QPainter, room: QRectF, colour: QColor) -> None:
    """Paint a house: back to the whole plot."""
    unit = room.width() / 15
    at = [QPointF(room.left() + x * unit, room.top() + y * unit) for x, y in HOUSE]
    painter.setPen(QPen(colour, 1.4 * unit))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawPolyline(at)


HOUSE = ((2, 8), (7.5, 2.5), (13, 8), (11, 6), (11, 12.5), (4, 12.5), (4, 6))
