"""Dots of representations over decades of a cost and of an error, with bars to the error of most PSFs."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf_explorer.charts.axes import decades
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import write
from p2sf_explorer.charts.reading import Reading, closest, value_of
from p2sf_explorer.i18n.tr import tr

DOT_PX = 4.0  # radius
AIR = 0.08  # of the decades that are shown, about the outermost dots


@dataclass(frozen=True)
class TradeDot:
    """One representation: its cost, its error and the error that 95 % keep, its colour, name, and how it was made."""

    cost: float
    error: float
    most: float
    token: str
    name: str
    settings: str = ""
    labelled: bool = False


class TradeChart(Chart):
    """Dots, a line through those on the front, and lines at what is asked."""

    def __init__(self, bottom: str, left: str) -> None:
        super().__init__(bottom, left)
        self.bottom_tick_maker = self.left_tick_maker = decades
        self.dots: tuple[TradeDot, ...] = ()
        self.front: tuple[TradeDot, ...] = ()
        self.asked: tuple[float | None, float | None] = None, None

    def show_dots(self, dots: tuple[TradeDot, ...], front: tuple[TradeDot, ...] = ()) -> None:
        """Show dots, and a line through some of them."""
        self.dots, self.front = dots, front
        if dots:
            x = np.log10([dot.cost for dot in dots])
            y = np.log10([value for dot in dots for value in (dot.error, dot.most)])
            wide, tall = (with_air(float(v.min()), float(v.max())) for v in (x, y))
            self.set_range(wide, tall)
        self.update()

    def ask(self, cost: float | None, error: float | None) -> None:
        """Mark a cost and an error that are asked for."""
        self.asked = cost, error
        self.update()

    def place(self, dot: TradeDot) -> tuple[float, float]:
        """Return where a dot stands, in decades."""
        return float(np.log10(dot.cost)), float(np.log10(dot.error))

    def rows_of_data(self) -> list[list[str]]:
        """Return the dots as rows: name, how it was made, cost, error, error of 95 %."""
        rows = [[d.name, d.settings, f"{d.cost:.9g}", f"{d.error:.9g}", f"{d.most:.9g}"] for d in self.dots]
        return [["", "", *self.labels, "95 %"], *rows] if rows else []

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the representation whose dot is nearest."""
        places = np.array([self.place(dot) for dot in self.dots]).reshape(-1, 2)
        number = closest(places, np.array([x, y]), self.pixel_size())
        if number is None:
            return None
        dot, place = self.dots[number], self.place(self.dots[number])
        cost = value_of(self.labels[0], dot.cost, self.labels[0], dot.token, mark=place)
        half = value_of(self.labels[1], dot.error, "", dot.token)
        most = value_of("95 %", dot.most, "", dot.token)
        return Reading(*place, f"{dot.name}: {dot.settings}" if dot.settings else dot.name, (cost, half, most), "")

    def paint_over(self, painter: QPainter) -> None:
        """Paint what is asked, the front, bars, dots, and the names of those that are labelled."""
        self._paint_asked(painter)
        painter.setPen(QPen(QColor(self.theme.muted), self.theme.scale))
        painter.drawPolyline([self._point(*self.place(dot)) for dot in self.front])
        for dot in self.dots:
            colour = QColor(getattr(self.theme, dot.token, dot.token))
            x, y = self.place(dot)
            painter.setPen(QPen(colour, self.theme.scale))
            painter.drawLine(self._point(x, y), self._point(x, float(np.log10(dot.most))))
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(colour)
            painter.drawEllipse(self._point(x, y), DOT_PX * self.theme.scale, DOT_PX * self.theme.scale)
        self._paint_names(painter)

    def _paint_asked(self, painter: QPainter) -> None:
        cost, error = self.asked
        painter.setPen(QPen(QColor(self.theme.accent), self.theme.scale, Qt.PenStyle.DashLine))
        (left, right), (low, high) = self.ranges()
        if cost:
            painter.drawLine(self._point(float(np.log10(cost)), low), self._point(float(np.log10(cost)), high))
        if error:
            painter.drawLine(self._point(left, float(np.log10(error))), self._point(right, float(np.log10(error))))

    def _paint_names(self, painter: QPainter) -> None:
        painter.setPen(QColor(self.theme.text))
        wide, tall = self.theme.px(110), self.theme.px(16)
        for dot in (dot for dot in self.dots if dot.labelled):
            at = self._point(*self.place(dot))
            right = at.x() < self.area.center().x()
            gap = 2 * DOT_PX * self.theme.scale
            corner = at.x() + gap if right else at.x() - gap - wide
            write(
                painter,
                QRectF(corner, at.y() - tall / 2, wide, tall),
                tr(dot.name),
                -1 if right else 1,
                self.theme.tick,
            )

    def _point(self, x: float, y: float) -> QPointF:
        return QPointF(*(float(v) for v in self.to_pixels(x, y)))


def with_air(low: float, high: float) -> tuple[float, float]:
    """Return a range of decades, one at least, with AIR at both ends."""
    air = AIR * max(1.0, high - low)
    return low - air, high + air
