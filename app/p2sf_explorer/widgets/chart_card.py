"""A card of several charts, charts with notes, and legends."""

from collections.abc import Iterable
from math import isfinite

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QPainter, QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QWidget

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import MARKS, width_of, write
from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.widgets.card import Card


class TurningRow(QWidget):
    """Charts in a row, or one above the other where there is more height than width; ``shares`` divide the length."""

    def __init__(self, charts: tuple[QWidget, ...], shares: tuple[int, ...], parent: QWidget | None = None):
        super().__init__(parent)
        self._row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(2 * SPACE)
        for chart, share in zip(charts, shares, strict=True):
            self._row.addWidget(chart, share)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Turn the charts to where they are nearer to squares."""
        super().resizeEvent(event)
        tall = self.height() > self.width()
        self._row.setDirection(QBoxLayout.Direction.TopToBottom if tall else QBoxLayout.Direction.LeftToRight)


class ChartsCard(Card):
    """A card with charts in a `TurningRow`."""

    def __init__(self, title: str, tip: str, charts: tuple[QWidget, ...], shares: tuple[int, ...]):
        super().__init__(title, tip)
        self.set_body(TurningRow(charts, shares, self))


def legend(looks: dict[str, str], theme: Tokens) -> str:
    """Return names, translated, behind the signs of their curves."""
    return " &nbsp; ".join(f"{curve_sign(token, theme)} {tr(name)}" for name, token in looks.items())


def curve_sign(token: str, theme: Tokens) -> str:
    """Return the sign of a curve in a legend: a line in its colour, with the mark that is on the curve."""
    line = f"━{MARKS[token]}━" if token in MARKS else "━"
    return f'<span style="color:{getattr(theme, token, token)}">{line}</span>'


Note = tuple[float, float, str, str, int]
"""Place x, y (infinite for the upper edge, where notes go below those in their way), text as it is, token, and side: −1
left end (right, where it would not fit), 0 middle, 1 right end."""
NOTE_PX = 16  # the height of a note's line at scale 1


class NotedChart(Chart):
    """A chart with text at places in its data, in the colours of tokens, and vertical lines across it."""

    def __init__(self, bottom: str = "", left: str = "", aspect: bool = False, framed: bool = True):
        super().__init__(bottom, left, aspect, framed)
        self.notes: tuple[Note, ...] = ()
        self.uprights: tuple[tuple[float, str], ...] = ()

    def show_notes(self, notes: Iterable[Note] = (), uprights: Iterable[tuple[float, str]] = ()) -> None:
        """Show notes and vertical lines at (x, token); ask for a repaint."""
        self.notes, self.uprights = tuple(notes), tuple(uprights)
        self.update()

    def paint_over(self, painter: QPainter) -> None:
        """Paint lines and text above the curves."""
        for x, token in self.uprights:
            at = float(self.to_pixels(x, 0.0)[0])
            wide = self.theme.scale
            painter.fillRect(QRectF(at - wide / 2, self.area.top(), wide, self.area.height()), self._colour(token))
        for (_, _, words, token, _), room in zip(self.notes, self.note_rooms(), strict=True):
            if room.width() > self.area.width():
                continue  # of a small chart the line alone tells
            if room.top() > self.area.top():  # below others, perhaps over a picture
                painter.fillRect(room, self._colour("card"))
            painter.setPen(self._colour(token))
            write(painter, room, words, -1, self.theme.tick)

    def note_rooms(self) -> list[QRectF]:
        """Return the rectangles of the notes, in pixels."""
        rooms: list[QRectF] = []
        tall = self.theme.px(NOTE_PX)
        for x, y, words, _, side in self.notes:
            left, middle = (float(v) for v in self.to_pixels(x, y if isfinite(y) else 0.0))
            wide = width_of(words, self.theme.tick)
            top = middle - tall / 2 if isfinite(y) else self.area.top()
            if side < 0 and left + wide > self.area.right():
                side = 1
            room = QRectF(left - (side + 1) / 2 * wide, top, wide, tall)
            while not isfinite(y) and any(room.intersects(other) for other in rooms):
                room.translate(0, tall)
            rooms.append(room)
        return rooms

    def _colour(self, token: str) -> QColor:
        return QColor(getattr(self.theme, token))


def reach(*parts: np.ndarray, least: float) -> tuple[float, float]:
    """Return the ends of all finite numbers, zero included unless it is far away; ``least`` is the smallest span."""
    both = np.concatenate([np.ravel(part) for part in parts])
    both = both[np.isfinite(both)]
    low, high = (float(both.min()), float(both.max())) if both.size else (0.0, 0.0)
    wide = max(high - low, least)
    if low - 2 * wide < 0 < high + 2 * wide:
        low, high = min(low, 0.0), max(high, 0.0)
    air = max(0.0, least - (high - low)) / 2 + AIR * wide
    return low - air, high + air


AIR = 0.04  # of the span, beyond either end
