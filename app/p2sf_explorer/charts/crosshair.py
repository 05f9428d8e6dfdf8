"""The crosshair and the pinned markers of a chart, with boxes that say what is read and never cover it."""

from collections.abc import Iterable
from dataclasses import replace
from math import hypot, isfinite
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf_explorer.charts.painting import fitting, width_of, write
from p2sf_explorer.charts.reading import Reading

if TYPE_CHECKING:
    from p2sf_explorer.charts.chart import Chart

CLEAR, PAD = 10.0, 5.0  # px at scale 1: from the place that is read to the box, and within the box
MARK = 3.5  # px, radius of a mark
GROUND = 235  # opacity of a box
BRIGHT, DARK = "#ffffff", "#000000"


def lines_of(reading: Reading) -> list[tuple[str, str, str]]:
    """Return the lines of a box: name, number, colour token."""
    head = [("", reading.head, "muted")] if reading.head else []
    return [*head, *((value.name, value.text, value.token) for value in reading.values)]


def place_box(reading: Reading, chart: "Chart", taken: Iterable[QRectF] = ()) -> tuple[Reading, QRectF]:
    """Return a reading with the place of its box, in pixels; in a small chart as many values as have room.

    The first ones are left out first: curves are read in the order they are painted, the most important last.
    """
    marks, room, clear = marks_of(reading, chart), QRectF(chart.rect()), CLEAR * chart.theme.scale
    for count in range(max(1, len(reading.values))):
        shorter = replace(reading, values=reading.values[count:])
        box = box_place(marks, size_of(shorter, chart), room, clear, taken)
        if box.height() <= room.height() and not any(box.contains(mark) for mark in marks):
            break
    return shorter, box


def size_of(reading: Reading, chart: "Chart") -> QSizeF:
    """Return the size of a reading's box in pixels."""
    theme = chart.theme
    rows = [width_of(f"{name}  {text}" if name else text, theme.label) for name, text, _ in lines_of(reading)]
    wide = min(max(rows) + 2 * theme.px(PAD) + 2, float(chart.width()))
    return QSizeF(wide, len(rows) * theme.px(17) + theme.px(PAD))


def marks_of(reading: Reading, chart: "Chart") -> list[QPointF]:
    """Return the pixels that are read: the marks of the values, else the place itself."""
    marks = [value.mark for value in reading.values if value.mark] or [reading.place]
    pixels = [QPointF(*(float(part) for part in chart.to_pixels(*mark))) for mark in marks]
    middle = chart.area.center()  # where one coordinate is no place: a curve has no value there
    return [
        QPointF(*(a if isfinite(a) else b for a, b in zip(p.toTuple(), middle.toTuple(), strict=True))) for p in pixels
    ]


def box_place(marks: list[QPointF], size: QSizeF, room: QRectF, clear: float, taken: Iterable[QRectF] = ()) -> QRectF:
    """Return where a box of a size stands: beside all ``marks`` and within ``room``, off what is ``taken`` if it can.

    A chart too small for that has it in the corner from which the least is covered.
    """
    left, right = min(p.x() for p in marks) - clear, max(p.x() for p in marks) + clear
    top, bottom = min(p.y() for p in marks) - clear, max(p.y() for p in marks) + clear
    wide, tall = size.width(), size.height()
    level = min(max(top - tall / 2, room.top()), room.bottom() - tall)
    across = min(max(left, room.left()), room.right() - wide)
    beside = [QPointF(right, level), QPointF(left - wide, level), QPointF(across, top - tall), QPointF(across, bottom)]
    steps = [QPointF(x.x(), y) for x in beside[:2] for y in (room.top(), room.bottom() - tall)]
    corners = [QPointF(x, y) for x in (room.left(), room.right() - wide) for y in (room.top(), room.bottom() - tall)]
    places = [QRectF(at, size) for at in (*beside, *steps, *corners)]
    free = [place for place in places if room.contains(place) and not any(place.contains(mark) for mark in marks)]
    unlike = [place for place in free if not any(place.intersects(other) for other in taken)]
    return (unlike or free or [max(places[-4:], key=lambda place: _apart(place, marks))])[0]


def _apart(place: QRectF, marks: list[QPointF]) -> float:
    return min((mark - place.center()).manhattanLength() for mark in marks)


def paint_crosshair(painter: QPainter, chart: "Chart", reading: Reading) -> None:
    """Paint the lines through the place that is read."""
    area, (x, y) = chart.area, (float(part) for part in chart.to_pixels(reading.x, reading.y))
    colour = QColor(chart.theme.text)
    for width, tone in ((1.0, colour),) if chart.samples is None else ((2.6, QColor(0, 0, 0, 110)), (1.0, BRIGHT)):
        painter.setPen(QPen(QColor(tone), width * chart.theme.scale))
        if "x" in reading.lines and area.left() <= x <= area.right():
            painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
        if "y" in reading.lines and area.top() <= y <= area.bottom():
            painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))


def paint_marks(painter: QPainter, chart: "Chart", reading: Reading) -> None:
    """Paint a ring at each value that is read."""
    for value in reading.values:
        if value.mark:
            at = QPointF(*(float(part) for part in chart.to_pixels(*value.mark)))
            painter.setPen(QPen(QColor(chart.theme.card), 1))
            painter.setBrush(QColor(getattr(chart.theme, value.token, value.token)))
            painter.drawEllipse(at, MARK * chart.theme.scale, MARK * chart.theme.scale)


def paint_box(painter: QPainter, chart: "Chart", reading: Reading, box: QRectF, pinned: bool = False) -> None:
    """Paint the box of a reading, framed as that of a pinned marker."""
    theme, pad = chart.theme, chart.theme.px(PAD)
    ground = QColor(theme.raised)
    ground.setAlpha(GROUND)
    painter.setPen(QPen(QColor(theme.accent if pinned else theme.line), theme.scale))
    painter.setBrush(ground)
    painter.drawRoundedRect(box, 4, 4)
    for k, (name, text, token) in enumerate(lines_of(reading)):
        row = QRectF(box.left() + pad, box.top() + pad / 2 + k * theme.px(17), box.width() - 2 * pad, theme.px(17))
        painter.setPen(QColor(getattr(theme, token, token)))
        room = row.width() - (width_of(text, theme.label) if name else 0.0)
        write(painter, row, fitting(name or text, room, theme.label), -1, theme.label)
        if name:
            painter.setPen(QColor(theme.text))
            write(painter, row, text, 1, theme.label)


def paint_expected(painter: QPainter, chart: "Chart", at: tuple[float, float]) -> None:
    """Paint what a person expects, through a pinned marker: a ring about the origin, or a level line."""
    area, (x, y), (x0, y0) = chart.area, chart.to_pixels(*at), chart.to_pixels(0.0, 0.0)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for colour, width, line in ((DARK, 3.0, Qt.PenStyle.SolidLine), (BRIGHT, 1.6, Qt.PenStyle.DashLine)):
        painter.setPen(QPen(QColor(colour), width * chart.theme.scale, line))
        if chart.expects == "ring":
            radius = hypot(x - x0, y - y0)
            painter.drawEllipse(QPointF(x0, y0), radius, radius)
        else:
            painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))


def paint_pin(painter: QPainter, chart: "Chart", at: tuple[float, float]) -> None:
    """Paint the sign of a pinned marker: a diamond that shows on bright and on dark."""
    x, y = (float(part) for part in chart.to_pixels(*at))
    side = 5.0 * chart.theme.scale
    painter.setBrush(Qt.BrushStyle.NoBrush)
    points = [QPointF(x - side, y), QPointF(x, y - side), QPointF(x + side, y), QPointF(x, y + side)]
    for colour, width in ((DARK, 3.0), (BRIGHT, 1.4)):
        painter.setPen(QPen(QColor(colour), width * chart.theme.scale))
        painter.drawPolygon(points)
