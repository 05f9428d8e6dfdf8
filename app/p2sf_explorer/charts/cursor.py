"""Choosing a place of a chart with the keys: arrows move a frame from place to place, Enter takes the framed one."""

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

ARROWS: dict[int, tuple[int, int]] = {
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
}
TAKES = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
ASIDE = 4.0  # distances across the arrow's direction count this much more


class Cursor:
    """The ``number`` of the place chosen, None before the first key."""

    def __init__(self) -> None:
        self.number: int | None = None

    def forget(self) -> None:
        """Choose nothing: the next arrow starts from the present place, wherever a slider or the mouse put it."""
        self.number = None

    def moved(self, key: int, points: np.ndarray, start: int) -> bool:
        """Move by an arrow among ``points``, (x, y) pixels, at first from ``start``; return whether it was an arrow."""
        step = ARROWS.get(key)
        if step is None or not len(points):
            return False
        number = start if self.number is None or self.number >= len(points) else self.number
        self.number = beside(points, number, step)
        return True

    def taken(self, key: int, count: int) -> int | None:
        """Return the number, below ``count``, that Enter takes; None for other keys and before any choice."""
        return self.number if key in TAKES and self.number is not None and self.number < count else None


def beside(points: np.ndarray, number: int, step: tuple[int, int]) -> int:
    """Return the next place in a direction, (x, y) in pixels with y downwards; the same one at the edge."""
    apart = points - points[number]
    along, aside = apart @ np.array(step), np.abs(apart @ np.array(step[::-1]))
    farness = np.where(along > 0.5, along + ASIDE * aside, np.inf)
    return int(farness.argmin()) if np.isfinite(farness).any() else number


def paint_cursor(painter: QPainter, room: QRectF) -> None:
    """Paint a frame that shows on bright and on dark ground."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for colour, width in (("#000000", 4.0), ("#ffffff", 1.8)):
        painter.setPen(QPen(QColor(colour), width))
        painter.drawRect(room)
