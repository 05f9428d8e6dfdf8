"""Bars of what each surface adds to a coefficient: one coefficient, or all of them stacked."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF
from PySide6.QtGui import QColor, QMouseEvent, QPainter

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
# Okabe and Ito (2008): colour-blind people tell them apart, on light and dark.
HUES = {"w40": "#0072b2", "w31": "#d55e00", "w22": "#009e73", "w20": "#cc79a7", "w11": "#e69f00"}
WIDTH = 0.62  # of a bar, of the distance to the next


@dataclass(frozen=True)
class Bar:
    """A bar of a term at ``x``, from ``base`` up by ``height``; ``surface`` 0 is the sum."""

    surface: int
    x: float
    base: float
    height: float
    term: str


class SeidelPanel:
    """Bars per surface of the chosen coefficient, or of all, and their sum at the right."""

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
        view: PerSurface = live.views["seidel"]
        chosen = self.term.currentData()
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
    """The bars; the store is told the surface under the pointer, and the surface that it tells is shaded."""

    def __init__(self, store: Store):
        super().__init__("surface", "waves")
        self._store = store
        self.zero = self.add_curve("line")
        self.bars: tuple[Bar, ...] = ()
        self.stacked, self.highlighted = False, 0
        self.setMouseTracking(True)
        store.pointed.connect(self._highlight)

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
        ticks = (*names, (last, tr("sum")))
        if ticks != self.bottom_ticks:
            self.bottom_ticks = ticks
            self.forget_background()
        self.update()

    def rows_of_data(self) -> list[list[str]]:
        """Return the bars as rows: coefficient, surface, waves."""
        rows = [[f"W{bar.term[1:]}", str(bar.surface or "sum"), f"{bar.height:.9g}"] for bar in self.bars]
        return [["coefficient", "surface", "waves"], *rows] if rows else []

    def room(self, bar: Bar) -> QRectF:
        """Return the rectangle of a bar in pixels."""
        (left, right), (low, high) = self.to_pixels(
            np.array([bar.x - WIDTH / 2, bar.x + WIDTH / 2]), np.array([bar.base, bar.base + bar.height])
        )
        return QRectF(QPointF(float(left), float(low)), QPointF(float(right), float(high))).normalized()

    def paint_over(self, painter: QPainter) -> None:
        """Paint the shade of the highlighted surface, then the bars."""
        if self.highlighted:
            left, right = (float(self.to_pixels(self.highlighted + side, 0.0)[0]) for side in (-0.5, 0.5))
            painter.fillRect(QRectF(left, self.area.top(), right - left, self.area.height()), QColor(self.theme.faint))
        for bar in self.bars:
            plain = self.theme.positive if bar.height >= 0 else self.theme.negative
            painter.fillRect(self.room(bar), QColor(HUES[bar.term] if self.stacked else plain))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Tell the store the surface under the pointer."""
        place = round(self.from_pixels(event.position())[0])
        most = max((bar.surface for bar in self.bars), default=0)
        self._store.point_at(place if self.area.contains(event.position()) and 1 <= place <= most else 0)

    def leaveEvent(self, event: QEvent) -> None:
        """Tell the store that the pointer has gone."""
        self._store.point_at(0)

    def _highlight(self, surface: int) -> None:
        self.highlighted = surface
        self.update()


def bars_of(view: PerSurface, terms: tuple[str, ...]) -> tuple[Bar, ...]:
    """Return the bars of the terms, positive ones stacked upwards and negative ones downwards; the sums last."""
    count = len(view.waves[terms[0]])
    columns = {term: np.append(view.waves[term], view.waves[term].sum()) for term in terms}
    ends = np.zeros((2, count + 1))
    bars: list[Bar] = []
    for term, heights in columns.items():
        for k, height in enumerate(heights.tolist()):
            side = int(height < 0)
            place = k + 1 if k < count else count + 1.5
            bars.append(Bar(0 if k == count else k + 1, place, float(ends[side, k]), height, term))
            ends[side, k] += height
    return tuple(bars)
