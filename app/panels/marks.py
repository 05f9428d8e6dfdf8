"""Pupils, principal and focal points and the image point on the layout, with names that do not collide."""

from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen

from app.chart import Chart
from app.ink import set_text, write
from app.layout import Layout

LINE_PX = 13.0
GAP_PX = 4.0
LINES = 6  # how far out a name may go for room of its own


def paint_marks(painter: QPainter, chart: Chart, layout: Layout) -> None:
    """Paint ticks for points, bars for pupils, a disc for the image, and a name for each."""
    painter.setPen(QPen(QColor(chart.theme.mark), 1))
    axis, taken = float(chart.to_pixels(0.0, 0.0)[1]), [sensor_room(chart, layout)]
    for mark in sorted(layout.marks, key=lambda mark: (mark.radius > 0, mark.z)):
        x, top = (float(v) for v in chart.to_pixels(mark.z, mark.radius))
        reach = max(axis - top, 4.0)
        if not -50 < x < chart.width() + 50:
            continue
        painter.drawLine(QPointF(x, axis - reach), QPointF(x, axis + reach))
        room = free_room(mark.name, x, axis - reach if mark.radius else axis + reach, -1 if mark.radius else 1, taken)
        taken.append(room)
        write(painter, room, mark.name)
    if layout.image:
        painter.setPen(QPen(QColor(chart.theme.card), 1))
        painter.setBrush(QColor(chart.theme.chief))
        painter.drawEllipse(QPointF(*(float(v) for v in chart.to_pixels(*layout.image))).toPoint(), 4, 4)


def sensor_room(chart: Chart, layout: Layout) -> QRectF:
    """Return the strip the sensor's line takes, in pixels."""
    x, top = (float(v) for v in chart.to_pixels(layout.drawing.sensor_z, layout.sensor_half))
    bottom = float(chart.to_pixels(0.0, -layout.sensor_half)[1])
    return QRectF(x - 1, top, 2, bottom - top)


def free_room(name: str, x: float, y: float, side: int, taken: list[QRectF]) -> QRectF:
    """Return a name's rectangle at (x, y), above (side −1) or below, moved out or aside until it touches no other."""
    wide = name_width(name)
    first = None
    for line in range(LINES):
        top = y + GAP_PX / 2 + line * LINE_PX if side > 0 else y - GAP_PX / 2 - (line + 1) * LINE_PX
        for shift in (0.0, wide / 2 + GAP_PX, -wide / 2 - GAP_PX):
            room = QRectF(x + shift - wide / 2, top, wide, LINE_PX)
            first = first or room
            if not any(room.intersects(other) for other in taken):
                return room
    return first


@lru_cache(maxsize=32)
def name_width(name: str) -> float:
    """Return how wide a name is, with air, in pixels."""
    return set_text(name).size().width() + GAP_PX
