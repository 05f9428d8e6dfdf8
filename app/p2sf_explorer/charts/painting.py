"""Text and lines on a QPainter, prepared once where they can be.

Text is painted as it comes, already translated, its numbers as the window's language writes them.
"""

import re
from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen, QPolygonF, QStaticText, QTransform
from shiboken6 import VoidPtr

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.i18n.tr import local

# On named curves, by the colour's token: what tells them apart without colour.
MARKS = {"chief": "●", "negative": "●", "third": "◆", "#cc79a7": "▲", "#a6761d": "■"}
CORNERS = {
    "◆": ((1.3, 0.0), (0.0, 1.3), (-1.3, 0.0), (0.0, -1.3)),
    "▲": ((0.0, -1.3), (1.2, 0.9), (-1.2, 0.9)),
    "■": ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)),
}
MARK_EVERY_PX, MARK_PX = 80.0, 3.2  # along the curve, and half the size of a mark
FARTHEST_PX = 1e5  # a line that leaves the window need not be drawn to its end
SHORT, LONG = 5, 24  # letters
DIGIT = re.compile(r"\d")


@lru_cache(maxsize=8)
def small_font(size: int = 11) -> QFont:
    """Return the font of ticks and labels. Shared; do not modify."""
    font = QFont()
    font.setPixelSize(size)
    return font


@lru_cache(maxsize=8)
def metrics(size: int = 11) -> QFontMetricsF:
    """Return the measures of `small_font`."""
    return QFontMetricsF(small_font(size))


@lru_cache(maxsize=256)
def pen(colour: str, alpha: int = 255, width: float = 1.0) -> QPen:
    """Return a pen of a colour such as #3366cc; one for everybody, so it is not to be changed."""
    painted = QColor(colour)
    painted.setAlpha(alpha)
    return QPen(painted, width)


def paint_line_marks(painter: QPainter, x: np.ndarray, y: np.ndarray, mark: str, theme: Tokens) -> None:
    """Paint marks in the colour of the pen along a line through points in pixels, none where one is NaN."""
    seen = np.isfinite(x) & np.isfinite(y) & (np.abs(x) < FARTHEST_PX) & (np.abs(y) < FARTHEST_PX)
    half, steps = MARK_PX * theme.scale, np.hypot(np.diff(x), np.diff(y))
    way = np.concatenate(([0.0], np.cumsum(np.where(seen[1:] & seen[:-1], steps, 0.0))))  # no way across a gap
    x, y, way = x[seen], y[seen], way[seen]
    if x.size < 2:
        return
    at = np.arange(0.5 * MARK_EVERY_PX * theme.scale, min(way[-1], FARTHEST_PX), MARK_EVERY_PX * theme.scale)
    painter.setBrush(painter.pen().color())
    for place in map(QPointF, np.interp(at, way, x).tolist(), np.interp(at, way, y).tolist()):
        if mark == "●":
            painter.drawEllipse(place, half, half)
        else:
            painter.drawPolygon(QPolygonF([place + QPointF(*corner) * half for corner in CORNERS[mark]]))
    painter.setBrush(Qt.BrushStyle.NoBrush)


def set_text(words: str, size: int = 11) -> QStaticText:
    """Return words laid out once: most of them stand on every frame, and laying out is two thirds of painting."""
    return _laid_out(local(words), size)


@lru_cache(maxsize=1024)
def _laid_out(words: str, size: int) -> QStaticText:
    text = QStaticText(words)
    text.setTextFormat(Qt.TextFormat.PlainText)
    text.prepare(QTransform(), small_font(size))
    return text


@lru_cache(maxsize=1024)
def is_passing(words: str) -> bool:
    """Return whether a text is likely to change with the next frame: it has a number, and is longer than a tick's."""
    return len(words) > SHORT and DIGIT.search(words) is not None


def width_of(words: str, size: int = 11) -> float:
    """Return the width of a text in pixels."""
    return number_width(words, size) if is_passing(words) else set_text(words, size).size().width()


@lru_cache(maxsize=1024)
def number_width(words: str, size: int) -> float:
    """Return the width of a text that changes with every frame: the sum of its letters, each measured once.

    From `LONG` on Qt measures faster.
    """
    if len(words) > LONG:
        return metrics(size).horizontalAdvance(words)
    return sum([letter_width(letter, size) for letter in words])


@lru_cache(maxsize=512)
def letter_width(letter: str, size: int) -> float:
    """Return the width of one letter in pixels."""
    return metrics(size).horizontalAdvance(letter)


def elide(words: str, room: float, size: int = 11) -> str:
    """Return a text whole if it fits, else cut at its end."""
    if width_of(words, size) <= room:
        return words
    return metrics(size).elidedText(words, Qt.TextElideMode.ElideRight, room)


def fitting(words: str, room: float, size: int = 11) -> str:
    """Return a text as far as it fits: whole, without brackets, its first word and unit, the shorter, elided."""
    bare = words.partition(" (")[0]
    name, comma, unit = bare.partition(", ")
    first = name.partition(" ")[0]
    for text in (words, bare, first + comma + unit, min(first, unit or first, key=len)):
        if width_of(text, size) <= room:
            return text
    return metrics(size).elidedText(text, Qt.TextElideMode.ElideRight, room)


def write(painter: QPainter, room: QRectF, words: str, side: int = 0, size: int = 11) -> None:
    """Paint a text half-way up a rectangle, at its left (side −1), middle (0) or right end (1).

    A number changes with the next frame: to lay it out and keep it takes twice as long as to paint it.
    """
    words = local(words)
    left = room.left() + (side + 1) / 2 * (room.width() - width_of(words, size)) if side >= 0 else room.left()
    painter.setFont(small_font(size))
    painter.setLayoutDirection(Qt.LayoutDirection.LayoutDirectionAuto)  # or a mirrored window would write "mm 100"
    if is_passing(words):
        measures = metrics(size)
        base = room.center().y() - measures.height() / 2 + measures.ascent()
        painter.drawText(QPointF(left, base), words)
    else:
        text = set_text(words, size)
        painter.drawStaticText(QPointF(left, room.center().y() - text.size().height() / 2), text)


def polylines(x: np.ndarray, y: np.ndarray) -> Iterator[QPolygonF]:
    """Yield the parts of a line in pixels between its NaN."""
    if all(np.abs(part).max(initial=0.0) <= FARTHEST_PX for part in (x, y)):  # false where there is a NaN
        yield polygon(x, y)
        return
    x, y = np.clip(x, -FARTHEST_PX, FARTHEST_PX), np.clip(y, -FARTHEST_PX, FARTHEST_PX)
    start = 0
    for end in (*np.flatnonzero(np.isnan(x + y)).tolist(), len(x)):
        if end > start:
            yield polygon(x[start:end], y[start:end])
        start = end + 1


def polygon(x: np.ndarray, y: np.ndarray) -> QPolygonF:
    """Return points as a QPolygonF, copied in one block: point by point takes ten times as long."""
    if not len(x):  # of no points, the block is no memory to write to
        return QPolygonF()
    copied = QPolygonF()
    copied.resize(len(x))
    block = VoidPtr(copied.data(), 16 * len(x), True)  # type: ignore[call-arg, arg-type]  # which its stub lacks
    points = np.frombuffer(block, dtype=float).reshape(-1, 2)  # type: ignore[call-overload]  # it has a buffer
    points[:, 0], points[:, 1] = x, y
    return copied
