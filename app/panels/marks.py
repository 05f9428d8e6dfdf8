"""Pupils, principal and focal points and the image point on the layout, with names that do not collide.

The names of the pupils stand on one row above the glass, those of the points on one row under it, each tied to its
mark by a fine line; a name that finds no room of its own is left out.
"""

from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen

from app.chart import Chart
from app.ink import set_text, write
from app.layout import Layout, Mark

LINE_PX = 13.0
GAP_PX = 4.0
ROW_PX = LINE_PX + GAP_PX  # what a row of names takes above or under the glass
SHIFTS = (0.0, 0.5, -0.5, 1.0, -1.0)  # of a name's width, aside from its mark


def paint_marks(painter: QPainter, chart: Chart, layout: Layout) -> None:
    """Paint ticks for points, bars for pupils, a disc for the image, and a name for each that has room."""
    tints = QColor(chart.theme.mark), QColor(chart.theme.mark)
    tints[1].setAlpha(90)
    taken = [sensor_room(chart, layout)]
    for mark in sorted(layout.marks, key=lambda mark: (mark.radius > 0, mark.z)):
        x, top = (float(v) for v in chart.to_pixels(mark.z, mark.radius))
        if not -50 < x < chart.width() + 50:
            continue
        axis = float(chart.to_pixels(0.0, 0.0)[1])
        reach = max(axis - top, 4.0)
        painter.setPen(QPen(tints[0], 1))
        painter.drawLine(QPointF(x, axis - reach), QPointF(x, axis + reach))
        room = free_room(mark.name, x, row_of(mark, chart, layout), taken, chart.width())
        if room:
            taken.append(room)
            painter.setPen(QPen(tints[1], 1))
            painter.drawLine(*leader(x, axis - reach, axis + reach, room))
            paint_name(painter, chart, room, mark.name)
    if layout.image:
        painter.setPen(QPen(QColor(chart.theme.card), 1))
        painter.setBrush(QColor(chart.theme.chief))
        painter.drawEllipse(QPointF(*(float(v) for v in chart.to_pixels(*layout.image))).toPoint(), 4, 4)


def paint_name(painter: QPainter, chart: Chart, room: QRectF, name: str) -> None:
    """Paint a name on a ground of its own, which keeps rays from striking it through."""
    ground = QColor(chart.theme.card)
    ground.setAlpha(225)
    painter.fillRect(room, ground)
    painter.setPen(QColor(chart.theme.mark))
    write(painter, room, name)


def row_of(mark: Mark, chart: Chart, layout: Layout) -> float:
    """Return the top of a name's row in pixels: of pupils above glass and stop, of points under them."""
    half = layout.drawing.half_height
    if mark.radius:
        return max(0.0, float(chart.to_pixels(0.0, half)[1]) - LINE_PX - GAP_PX / 2)
    return min(chart.height() - LINE_PX, float(chart.to_pixels(0.0, -half)[1]) + GAP_PX / 2)


def leader(x: float, top: float, bottom: float, room: QRectF) -> tuple[QPointF, QPointF]:
    """Return the line from the near end of a mark to its name."""
    foot = min(max(x, room.left() + GAP_PX), room.right() - GAP_PX)
    if room.center().y() < top:
        return QPointF(x, top), QPointF(foot, room.bottom())
    return QPointF(x, min(bottom, room.top())), QPointF(foot, room.top())


def sensor_room(chart: Chart, layout: Layout) -> QRectF:
    """Return the strip the sensor's line takes, in pixels."""
    x, top = (float(v) for v in chart.to_pixels(layout.drawing.sensor_z, layout.sensor_half))
    bottom = float(chart.to_pixels(0.0, -layout.sensor_half)[1])
    return QRectF(x - 1, top, 2, bottom - top)


def free_room(name: str, x: float, top: float, taken: list[QRectF], width: float) -> QRectF | None:
    """Return a name's rectangle near x on its row, aside if need be; None where it would touch another or the edge."""
    wide = name_width(name)
    for shift in SHIFTS:
        aside = shift * (wide + GAP_PX)
        room = QRectF(x + aside - wide / 2, top, wide, LINE_PX)
        inside = room.left() >= 0 and room.right() <= width
        if inside and not any(room.intersects(other) for other in taken):
            return room
    return None


@lru_cache(maxsize=32)
def name_width(name: str) -> float:
    """Return how wide a name is, with air, in pixels."""
    return set_text(name).size().width() + GAP_PX
