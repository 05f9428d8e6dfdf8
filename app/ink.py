"""Words and lines on a QPainter, prepared once where they can be."""

from functools import lru_cache

import numpy as np
from pyqtgraph.functions import create_qpolygonf, ndarray_from_qpolygonf
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QPainter, QPolygonF, QStaticText, QTransform

from app.words import tr

FARTHEST_PX = 1e5  # a line that leaves the window need not be drawn to its end


@lru_cache(maxsize=8)
def small_font(size: int = 11) -> QFont:
    """Return the font of ticks and labels; one for everybody, so it is not to be changed."""
    font = QFont()
    font.setPixelSize(size)
    return font


@lru_cache(maxsize=1024)
def set_text(words: str, size: int = 11) -> QStaticText:
    """Return words laid out once: most of them stand on every frame, and laying out is two thirds of painting."""
    text = QStaticText(tr(words))
    text.setTextFormat(Qt.TextFormat.PlainText)
    text.prepare(QTransform(), small_font(size))
    return text


def write(painter: QPainter, room: QRectF, words: str, side: int = 0, size: int = 11) -> None:
    """Paint words in the middle of a room's height, at its left (side −1), middle (0) or right end (1)."""
    text = set_text(words, size)
    taken = text.size()
    left = room.left() + (side + 1) / 2 * (room.width() - taken.width())
    painter.setFont(small_font(size))
    painter.drawStaticText(QPointF(left, room.center().y() - taken.height() / 2), text)


def polylines(x: np.ndarray, y: np.ndarray):
    """Yield the unbroken parts of a line in pixels."""
    points = np.clip(np.stack([x, y], axis=-1), -FARTHEST_PX, FARTHEST_PX)
    broken = np.flatnonzero(np.isnan(points).any(axis=1))
    for part in np.split(points, broken) if broken.size else (points,):
        part = part[1:] if part.size and np.isnan(part[0]).any() else part
        if len(part):
            yield polygon(part)


def polygon(points: np.ndarray) -> QPolygonF:
    """Return (points, 2) as Qt wants them, copied as one block: point by point takes ten times as long."""
    made = create_qpolygonf(len(points))
    ndarray_from_qpolygonf(made)[:] = points
    return made
