"""Pupils, principal and focal points and the image point on the layout, with names that do not overlap.

The names of the pupils are on a row above the glass, those of the points on a row below it, each with a thin line to
its mark; a name without room of its own is left out.
"""

from dataclasses import dataclass
from functools import lru_cache

from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QColor, QPainter

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import pen, set_text, write
from p2sf_explorer.charts.theme import TICK_PX
from p2sf_explorer.compute.layout import Layout, Mark
from p2sf_explorer.i18n.tr import cached_per_language, tr

LINE_PX = 13.0
GAP_PX = 4.0
ROW_PX = LINE_PX + GAP_PX  # height of a row of names
SHIFTS = (0.0, 0.5, -0.5, 1.0, -1.0)  # sideways from the mark, in widths of the name


@dataclass(frozen=True)
class Placed:
    """The place of a mark and of its name, in pixels; ``room`` and ``leader`` are None where the name is left out."""

    bar: QLineF
    name: str
    room: QRectF | None = None
    leader: QLineF | None = None


def paint_marks(painter: QPainter, chart: Chart, layout: Layout) -> None:
    """Paint ticks for points, bars for pupils, a disc for the image, and the names that have room."""
    placed = places(layout.marks, MarkFrame.of(chart, layout))
    painter.setPen(pen(chart.theme.mark, 255, chart.theme.scale))
    painter.drawLines([mark.bar for mark in placed])
    painter.setPen(pen(chart.theme.mark, 90, chart.theme.scale))
    painter.drawLines([mark.leader for mark in placed if mark.leader])
    for mark in placed:
        if mark.room:
            paint_name(painter, chart, mark.room, mark.name)
    if layout.image:
        painter.setPen(pen(chart.theme.card))
        painter.setBrush(QColor(chart.theme.chief))
        painter.drawEllipse(
            QPointF(*(float(v) for v in chart.to_pixels(*layout.image))).toPoint(), chart.theme.px(4), chart.theme.px(4)
        )


@dataclass(frozen=True)
class MarkFrame:
    """What places depend on, in pixels: axis, pixels per mm, size of the picture, rim of the glass, sensor, type."""

    left: float
    axis: float
    scale: float
    width: float
    height: float
    rim: float
    sensor: tuple[float, float]
    type_scale: float = 1.0

    @classmethod
    def of(cls, chart: Chart, layout: Layout) -> "MarkFrame":
        """Return the frame of a chart that shows this layout."""
        drawing = layout.drawing
        (left, axis), (right, rim) = chart.to_pixels(0.0, 0.0), chart.to_pixels(1.0, drawing.half_height)
        sensor = drawing.sensor_z * (right - left) + left, layout.sensor_half * (right - left)
        size = float(chart.width()), float(chart.height())
        return cls(left, axis, right - left, *size, axis - rim, sensor, chart.theme.scale)


@cached_per_language(4)
def places(marks: tuple[Mark, ...], frame: MarkFrame) -> tuple[Placed, ...]:
    """Return the places of marks and names; most sliders do not move them."""
    x, half = frame.sensor
    placed: list[Placed] = []
    taken = [QRectF(x - 1, frame.axis - half, 2, 2 * half)]
    for mark in sorted(marks, key=lambda mark: (mark.radius > 0, mark.z)):
        x, height = frame.left + mark.z * frame.scale, max(mark.radius * frame.scale, 4.0 * frame.type_scale)
        if not -50 < x < frame.width + 50:
            continue
        bar, name = QLineF(x, frame.axis - height, x, frame.axis + height), tr(mark.name)
        room = free_room(name, x, row_of(mark, frame), taken, frame.width, frame.type_scale)
        placed.append(Placed(bar, name, room, leader(bar, room) if room else None))
        taken += [room] if room else []
    return tuple(placed)


def paint_name(painter: QPainter, chart: Chart, room: QRectF, name: str) -> None:
    """Paint a name on a ground of its own, which rays behind do not cross."""
    ground = QColor(chart.theme.card)
    ground.setAlpha(225)
    painter.fillRect(room, ground)
    painter.setPen(QColor(chart.theme.mark))
    write(painter, room, name, 0, chart.theme.tick)


def row_of(mark: Mark, frame: MarkFrame) -> float:
    """Return the top of a name's row in pixels: above glass and stop for pupils, below for points."""
    line = LINE_PX * frame.type_scale
    if mark.radius:
        return max(0.0, frame.axis - frame.rim - line - GAP_PX / 2)
    return min(frame.height - line, frame.axis + frame.rim + GAP_PX / 2)


def leader(bar: QLineF, room: QRectF) -> QLineF:
    """Return the line from the near end of a mark to its name."""
    x, top, bottom = bar.x1(), bar.y1(), bar.y2()
    foot = min(max(x, room.left() + GAP_PX), room.right() - GAP_PX)
    if room.center().y() < top:
        return QLineF(x, top, foot, room.bottom())
    return QLineF(x, min(bottom, room.top()), foot, room.top())


def free_room(name: str, x: float, top: float, taken: list[QRectF], width: float, scale: float = 1.0) -> QRectF | None:
    """Return a name's rectangle near x on its row; None where it would touch another or the edge everywhere."""
    wide = name_width(name, round(TICK_PX * scale))
    for shift in SHIFTS:
        aside = shift * (wide + GAP_PX)
        room = QRectF(x + aside - wide / 2, top, wide, LINE_PX * scale)
        inside = room.left() >= 0 and room.right() <= width
        if inside and not any(room.intersects(other) for other in taken):
            return room
    return None


@lru_cache(maxsize=32)
def name_width(name: str, size: int) -> float:
    """Return the width of a name with a margin, in pixels, in type of a size."""
    return set_text(name, size).size().width() + GAP_PX
