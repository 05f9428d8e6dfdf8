"""A small drawing of a lens: glass, stop and sensor."""

from typing import SupportsFloat

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.layout import Drawing


def paint_lens(painter: QPainter, drawn: Drawing, rect: QRectF, theme: Tokens) -> None:
    """Paint a lens to scale in the middle of a rectangle."""
    tall, length = 2 * max(drawn.half_height, drawn.stop_rim), drawn.right - drawn.left
    scale = min(rect.width() / length, rect.height() / tall)
    zero = QPointF(rect.center().x() - scale * (drawn.left + drawn.right) / 2, rect.center().y())

    def at(z: SupportsFloat, y: SupportsFloat) -> QPointF:
        return QPointF(zero.x() + scale * float(z), zero.y() - scale * float(y))

    painter.setPen(QPen(QColor(theme.line), 1))
    painter.drawLine(QLineF(at(drawn.left, 0), at(drawn.right, 0)))
    painter.setPen(QPen(QColor(theme.glass_edge), 1))
    for outline in drawn.outlines:
        painter.setBrush(glass(outline.index, theme))
        painter.drawPolygon(QPolygonF([at(z, y) for z, y in zip(outline.z, outline.y, strict=True)]))
    painter.setPen(QPen(QColor(theme.glass_edge), 2))
    for mirror in drawn.glass.mirrors:
        painter.drawPolyline(QPolygonF([at(z, y) for z, y in zip(mirror.z, mirror.y, strict=True)]))
    painter.setPen(QPen(QColor(theme.text), 2, c=Qt.PenCapStyle.FlatCap))
    wedge = 0.2 * drawn.half_height
    for side in (-1, 1):
        rim = side * drawn.stop_rim
        painter.drawLine(QLineF(at(*drawn.stop.placed(0.0, rim)), at(*drawn.stop.placed(0.0, rim + side * wedge))))
    painter.setPen(QPen(QColor(theme.text), 1))
    half = drawn.half_height / 2
    painter.drawLine(QLineF(at(*drawn.sensor.placed(0.0, -half)), at(*drawn.sensor.placed(0.0, half))))


def glass(index: float, theme: Tokens) -> QColor:
    """Return the fill of a glass, less transparent for a higher index."""
    fill = QColor(theme.glass)
    fill.setAlphaF(min(0.75, max(0.12, 0.9 * (index - 1.2))))
    return fill
