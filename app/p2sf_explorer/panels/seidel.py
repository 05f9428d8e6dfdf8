"""Bars of what each surface adds to a Seidel coefficient or a chromatic sum: one of them, or all side by side."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF
from PySide6.QtGui import QColor, QMouseEvent, QPainter

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.reading import Reading, value_of
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.seidel import PerSurface
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser

TIP = (
    "Seidel and chromatic sums: what each surface adds, in waves at the rim of the pupil; large ones of opposite "
    "sign cancel. C I and C II: defocus and tilt of the lens's shortest wavelength minus those of its longest. Point "
    "at a bar to highlight its surface in the layout, or at a surface to highlight its bar."
)
TERMS = ("w40", "w31", "w22", "petzval", "w11", "c1", "c2")  # side by side
NAMES = {
    **{"w40": "W40", "w31": "W31", "w22": "W22", "petzval": "Petzval", "w20": "W20", "w11": "W11"},
    **{"c1": "C I", "c2": "C II"},
}
CHOICES = (
    ("all", "all sums"),
    ("w40", "W40 spherical aberration"),
    ("w31", "W31 coma"),
    ("w22", "W22 astigmatism"),
    ("petzval", "Petzval sum"),
    ("w20", "W20 field curvature"),
    ("w11", "W11 distortion"),
    ("c1", "C I axial colour"),
    ("c2", "C II lateral colour"),
)
ALL = "all"
MOVING = ("w11", "c2")  # which move the image and do not blur it: the axis of all sums does not grow for them
# Okabe and Ito (2008): colour-blind people tell them apart, on light and dark.
HUES = {"w40": "#0072b2", "w31": "#d55e00", "w22": "#009e73", "petzval": "#cc79a7", "w11": "#e69f00"} | {
    "c1": "#56b4e9",
    "c2": "#8c8c8c",
}
SMALLEST = 0.1  # waves at the end of the axis
CUT_PX = 6  # from the end of the axis to the cut in a bar that goes on
WIDTH, GROUP = 0.62, 0.84  # of a bar alone, and of a group of them, of the distance to the next


@dataclass(frozen=True)
class Bar:
    """A bar of a term about ``x``, ``width`` wide and ``height`` high; ``surface`` 0 is the sum."""

    surface: int
    x: float
    width: float
    height: float
    term: str


class SeidelPanel:
    """Bars per surface of the chosen sum, or of all, and the whole at the right."""

    def __init__(self, store: Store):
        self.widget = Card("Seidel per surface", TIP)
        self.term = chooser(CHOICES, "Which sum", self.widget)
        self.widget.bind(store, seidel_sum=self.term)
        self.widget.add_tool(self.term)
        self.chart = BarsChart(store)
        self.widget.set_body(self.chart)

    def show(self, live: Live) -> None:
        """Paint the bars of the chosen sum."""
        view: PerSurface = live.views["seidel"].found
        chosen = live.state.choices.seidel_sum
        bars = bars_of(view, TERMS if chosen == ALL else (chosen,))
        self.chart.show_bars(bars, view, chosen == ALL)
        if chosen == ALL:
            marks = (f'<span style="color:{HUES[t]}">■</span> {NAMES[t]}' for t in TERMS)
            self.widget.set_readout(" &nbsp; ".join((*marks, colours(view))))
        else:
            whole = tr("sum {sum} λ", sum=with_sign(float(view.waves[chosen].sum()), 3))
            self.widget.set_readout(f"{whole} · {colours(view)}" if chosen in ("c1", "c2") else whole)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)


class BarsChart(Chart):
    """The bars; the store is told the surface under the pointer, and the surface that it tells is shaded."""

    def __init__(self, store: Store):
        super().__init__("surface", "coefficient, waves")
        self._store = store
        self.zero = self.add_curve("line")
        self.bars: tuple[Bar, ...] = ()
        self.grouped, self.highlighted = False, 0
        self.setMouseTracking(True)
        store.pointed.connect(self._highlight)

    def show_bars(self, bars: tuple[Bar, ...], view: PerSurface, grouped: bool) -> None:
        """Show bars over the surfaces' names."""
        self.bars, self.grouped = bars, grouped
        count = len(view.waves["w40"])
        last = count + 1.5
        heights = [abs(bar.height) for bar in bars if not (grouped and bar.term in MOVING)]
        limit = max(SMALLEST, *heights)
        self.set_range((0.3, last + 0.7), (-limit, limit), steady="y")
        self.zero.set_data((0.3, last + 0.7), (0, 0))
        names = tuple((k, f"{k} {tr('stop')}" if k == view.stop_surface else str(k)) for k in range(1, count + 1))
        ticks = (*names, (last, tr("sum")))
        if ticks != self.bottom_ticks:
            self.bottom_ticks = ticks
            self.forget_background()
        self.update()

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the bar whose place is nearest."""
        bar = min(self.bars, key=lambda bar: abs(bar.x - x), default=None)
        if bar is None:
            return None
        head = tr("surface {number}", number=bar.surface) if bar.surface else tr("sum")
        token = HUES[bar.term] if self.grouped else "positive" if bar.height >= 0 else "negative"
        value = value_of(NAMES[bar.term], bar.height, self.labels[1], token, mark=(bar.x, bar.height))
        return Reading(bar.x, bar.height, head, (value,), "")

    def rows_of_data(self) -> list[list[str]]:
        """Return the bars as rows: coefficient, surface, waves."""
        rows = [[NAMES[bar.term], str(bar.surface or "sum"), f"{bar.height:.9g}"] for bar in self.bars]
        return [["sum", "surface", "waves"], *rows] if rows else []

    def room(self, bar: Bar) -> QRectF:
        """Return the rectangle of a bar in pixels."""
        (left, right), (low, high) = self.to_pixels(
            np.array([bar.x - bar.width / 2, bar.x + bar.width / 2]), np.array([0.0, bar.height])
        )
        return QRectF(QPointF(float(left), float(low)), QPointF(float(right), float(high))).normalized()

    def paint_over(self, painter: QPainter) -> None:
        """Paint the shade of the highlighted surface, then the bars."""
        if self.highlighted:
            left, right = (float(self.to_pixels(self.highlighted + side, 0.0)[0]) for side in (-0.5, 0.5))
            painter.fillRect(QRectF(left, self.area.top(), right - left, self.area.height()), QColor(self.theme.faint))
        for bar in self.bars:
            plain = self.theme.positive if bar.height >= 0 else self.theme.negative
            room = self.room(bar)
            painter.fillRect(room, QColor(HUES[bar.term] if self.grouped else plain))
            if room.top() < self.area.top() - 1 or room.bottom() > self.area.bottom() + 1:
                self._cut(painter, room)

    def _cut(self, painter: QPainter, room: QRectF) -> None:
        """Cut a bar that goes on beyond the axis near its visible end."""
        end = self.area.top() + CUT_PX if room.top() < self.area.top() else self.area.bottom() - CUT_PX
        painter.fillRect(QRectF(room.left() - 1, end, room.width() + 2, 2), QColor(self.theme.card))

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
    """Return the bars of the terms, side by side where there are several, surface by surface; the sums last."""
    count, width = len(view.waves[terms[0]]), (GROUP if len(terms) > 1 else WIDTH) / len(terms)
    bars: list[Bar] = []
    for k in range(count + 1):
        place = k + 1 if k < count else count + 1.5
        for number, term in enumerate(terms):
            height = float(view.waves[term][k] if k < count else view.waves[term].sum())
            aside = (number - (len(terms) - 1) / 2) * width
            bars.append(Bar(k + 1 if k < count else 0, place + aside, width, height, term))
    return tuple(bars)


def colours(view: PerSurface) -> str:
    """Return between which wavelengths the chromatic sums are."""
    short, long = (f"{value:.4g}" for value in view.colours_nm)
    return (
        tr("one wavelength, no colour") if short == long else tr("colour {short} − {long} nm", short=short, long=long)
    )
