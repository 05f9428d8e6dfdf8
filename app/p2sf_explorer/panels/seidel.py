"""What each surface adds to each coefficient, as bars: one coefficient, or all of them on one another."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.results.seidel import PerSurface
from p2sf_explorer.state.scales import nice, signed
from p2sf_explorer.state.terms import WORDS
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser

TIP = (
    "Seidel contributions: what each surface adds to a coefficient, in waves; large ones of opposite sign cancel. "
    "Point at a bar: its surface is lit in the layout, and the other way round."
)
TERMS = ("w40", "w31", "w22", "w20", "w11")
ALL = "all"
# Okabe and Ito (2008): told apart by colour-blind eyes, on light and dark.
HUES = {"w40": "#0072b2", "w31": "#d55e00", "w22": "#009e73", "w20": "#cc79a7", "w11": "#e69f00"}
WIDE = 0.62


@dataclass(frozen=True)
class Bar:
    """A bar of a term over a place of the axis, from ``base`` up by ``height``; ``surface`` 0 is the sum."""

    surface: int
    x: float
    base: float
    height: float
    term: str


class SeidelPanel:
    """Bars per surface for the chosen coefficient or for all, and their sum at the right."""

    def __init__(self, store: Store):
        self.widget = Card("Seidel per surface", TIP)
        choices = (*((t, f"W{t[1:]} {WORDS[t]}") for t in TERMS), (ALL, "all, stacked"))
        self.term = chooser(choices, "Which coefficient", self.widget)
        self.term.activated.connect(self._again)
        self.widget.add_tool(self.term)
        self.chart = BarsChart(store)
        self.widget.set_body(self.chart)
        self._live: Live | None = None

    def show(self, live: Live) -> None:
        """Paint the bars of the chosen coefficient."""
        self._live = live
        view, chosen = live.views["seidel"], self.term.currentData()
        bars = bars_of(view, TERMS if chosen == ALL else (chosen,))
        self.chart.show_bars(bars, view, chosen == ALL)
        if chosen == ALL:
            marks = (f'<span style="color:{HUES[t]}">■</span> W{t[1:]}' for t in TERMS)
            self.widget.set_readout(" &nbsp; ".join(marks))
        else:
            self.widget.set_readout(tr("sum {sum} λ", sum=signed(float(view.waves[chosen].sum()), 3)))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)

    def _again(self) -> None:
        if self._live:
            self.show(self._live)


class BarsChart(Chart):
    """The bars; the one under the pointer is told to the store, the one that is told is shaded."""

    def __init__(self, store: Store):
        super().__init__("surface", "waves")
        self._store = store
        self.zero = self.add_curve("line")
        self.bars: tuple[Bar, ...] = ()
        self.stacked, self.lit = False, 0
        self.setMouseTracking(True)
        store.pointed.connect(self._light)

    def show_bars(self, bars: tuple[Bar, ...], view: PerSurface, stacked: bool) -> None:
        """Show bars over the surfaces' names."""
        self.bars, self.stacked = bars, stacked
        last = bars[-1].x
        ends = [0.1, *(abs(end) for bar in bars for end in (bar.base, bar.base + bar.height))]
        limit = nice(max(ends), (1, 1.5, 2, 3, 5, 7))
        self.set_range((0.3, last + 0.7), (-limit, limit))
        self.zero.set_data((0.3, last + 0.7), (0, 0))
        count = len(view.waves["w40"])
        names = tuple((k, f"{k} {tr('stop')}" if k == view.stop_surface else str(k)) for k in range(1, count + 1))
        if (*names, (last, tr("sum"))) != self.bottom_ticks:
            self.bottom_ticks = (*names, (last, tr("sum")))
            self.forget_ground()
        self.update()

    def rows_of_data(self) -> list[list]:
        """Return the bars as rows: coefficient, surface, waves."""
        rows = [[f"W{bar.term[1:]}", bar.surface or "sum", f"{bar.height:.9g}"] for bar in self.bars]
        return [["coefficient", "surface", "waves"], *rows] if rows else []

    def room(self, bar: Bar) -> QRectF:
        """Return where a bar is painted, in pixels."""
        (left, right), (low, high) = self.to_pixels(
            np.array([bar.x - WIDE / 2, bar.x + WIDE / 2]), np.array([bar.base, bar.base + bar.height])
        )
        return QRectF(QPointF(float(left), float(low)), QPointF(float(right), float(high))).normalized()

    def paint_over(self, painter: QPainter) -> None:
        """Paint the shade of the surface in question, then the bars."""
        if self.lit:
            left, right = (float(self.to_pixels(self.lit + side, 0.0)[0]) for side in (-0.5, 0.5))
            painter.fillRect(QRectF(left, self.area.top(), right - left, self.area.height()), QColor(self.theme.faint))
        for bar in self.bars:
            plain = self.theme.positive if bar.height >= 0 else self.theme.negative
            painter.fillRect(self.room(bar), QColor(HUES[bar.term] if self.stacked else plain))

    def mouseMoveEvent(self, event) -> None:
        """Tell which surface's column is under the pointer."""
        place = round(self.from_pixels(event.position())[0])
        most = max((bar.surface for bar in self.bars), default=0)
        self._store.point_at(place if self.area.contains(event.position()) and 1 <= place <= most else 0)

    def leaveEvent(self, event) -> None:
        """Tell that the pointer has gone."""
        self._store.point_at(0)

    def _light(self, surface: int) -> None:
        self.lit = surface
        self.update()


def bars_of(view: PerSurface, terms: tuple[str, ...]) -> tuple[Bar, ...]:
    """Return the bars of the terms, positive ones on one another upwards and negative ones downwards; sums last."""
    count = len(view.waves[terms[0]])
    columns = {term: np.append(view.waves[term], view.waves[term].sum()) for term in terms}
    tops, found = np.zeros((2, count + 1)), []
    for term, heights in columns.items():
        for k, height in enumerate(heights.tolist()):
            side = int(height < 0)
            place = k + 1 if k < count else count + 1.5
            found.append(Bar(0 if k == count else k + 1, place, float(tops[side, k]), height, term))
            tops[side, k] += height
    return tuple(found)
