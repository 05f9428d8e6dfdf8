"""Choosing one of a chart's places by keys: the arrows move a frame from place to place, Enter takes what it is on."""

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

ARROWS = {
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
}
TAKES = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
ASIDE = 4.0  # how much farther a place is that lies aside of the arrow's way


class Cursor:
    """The ``number`` of the place chosen, None before the first key."""

    def __init__(self):
        self.number: int | None = None

    def forget(self) -> None:
        """Choose nothing: the next arrow starts from the present place, wherever a slider or the mouse has put that."""
        self.number = None

    def moved(self, key, points: np.ndarray, start: int) -> bool:
        """Move by an arrow among ``points``, (x, y) in pixels, from ``start`` at first; say whether it was an arrow."""
        step = ARROWS.get(key)
        if step is None or not len(points):
            return False
        known = self.number is not None and self.number < len(points)
        self.number = beside(points, self.number if known else start, step)
        return True

    def taken(self, key, count: int) -> int | None:
        """Return the number of the place that Enter takes out of so many; None for other keys and before any choice."""
        return self.number if key in TAKES and self.number is not None and self.number < count else None


def beside(points: np.ndarray, number: int, step: tuple[int, int]) -> int:
    """Return the place next to one on an arrow's way, (x, y) in pixels, y downwards; itself at the rim."""
    apart = points - points[number]
    along, aside = apart @ np.array(step), np.abs(apart @ np.array(step[::-1]))
    farness = np.where(along > 0.5, along + ASIDE * aside, np.inf)
    return int(farness.argmin()) if np.isfinite(farness).any() else number


def paint_cursor(painter: QPainter, room: QRectF) -> None:
    """Paint a frame that is seen on bright and on dark."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for colour, width in (("#000000", 4.0), ("#ffffff", 1.8)):
        painter.setPen(QPen(QColor(colour), width))
        painter.drawRect(room)
