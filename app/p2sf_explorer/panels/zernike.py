"""The Zernike terms of the wavefront: bars, a table, and what is left."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter

from p2sf.messages import Message, Number
from p2sf.pupil.zernike_fit import ZernikeFit
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.reading import Reading, split_label, value_of
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.zernike import ZernikeView, csv_rows, rows
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import significant
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import chooser
from p2sf_explorer.widgets.chart_card import ChartsCard
from p2sf_explorer.widgets.readout import FactTable, in_scroll_area

TIP = (
    "Zernike terms of the wavefront that makes the picture, orthogonal over the part of the pupil that passes light; "
    "θ from +x. Percent: share of the variance without piston and tilt, which do not blur."
)
CHOICES = (("noll", "Noll, RMS waves"), ("fringe", "Fringe, peak waves"))
UNITS = {"noll": "RMS, waves", "fringe": "peak, waves"}
WIDTH = 0.7  # of a bar, of the distance to the next
BLURRING = 4  # the first term behind piston and tilt, in both orders
ROUND_OFF = 1e-12  # of the largest term
SMALLEST = 1e-3  # waves at the end of the axis


class ZernikePanel:
    """Bars of the terms that blur beside a table of all that can differ from zero; the chooser switches the order."""

    def __init__(self, store: Store):
        self.chart, self.table = TermsChart(), TermTable()
        area = in_scroll_area(self.table, at_foot=False)
        self.widget = ChartsCard("Zernike", TIP, (self.chart, area), (3, 2))
        self.order = chooser(CHOICES, "Which order of the terms", self.widget)
        self.widget.bind(store, zernike_order=self.order)
        self.widget.add_tool(self.order)

    def show(self, live: Live) -> None:
        """Paint the terms in the chosen order."""
        view: ZernikeView = live.views["zernike"].found
        fit = view.fits[live.state.choices.zernike_order]
        self.chart.show_fit(fit)
        self.table.show_rows(rows(fit))
        self.widget.set_readout(" · ".join(figures(fit, view.kind)))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
        self.table.restyle(theme)


def figures(fit: ZernikeFit, kind: str) -> tuple[str, ...]:
    """Return RMS without and with tilt, what is left, over which pupil, and of which wavefront."""
    blur, tilted, left = (Number(significant(value, 3)) for value in (fit.rms, fit.rms_with_tilt, fit.residual))
    over = Message("whole pupil")
    if fit.clear < 1:
        over = Message("Gram–Schmidt over {percent:.0f} % of the pupil", percent=100 * fit.clear)
    parts = Message("RMS {r} λ", r=blur), Message("{r} λ with tilt", r=tilted), Message("{r} λ left", r=left)
    return tuple(part.text(WINDOW) for part in (*parts, over, Message(kind)))


class TermTable(FactTable):
    """The terms by name; the chart gives the rows to copy, the terms that are zero included."""

    def rows_of_data(self) -> list[list[str]]:
        """Return nothing."""
        return []


class TermsChart(Chart):
    """Bars over the terms' numbers."""

    def __init__(self) -> None:
        super().__init__("term", UNITS["noll"])
        self.zero = self.add_curve("line")
        self.fit: ZernikeFit | None = None

    def show_fit(self, fit: ZernikeFit) -> None:
        """Show the bars of the terms that blur."""
        self.fit = fit
        self.name_axes("term", UNITS[fit.basis])
        limit = max(float(np.abs(fit.waves[BLURRING - 1 :]).max()), SMALLEST)
        ends = BLURRING - 0.7, len(fit.waves) + 0.7
        self.set_range(ends, (-limit, limit), steady="y")
        self.zero.set_data(ends, (0, 0))
        self.update()

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the term whose bar is nearest."""
        if self.fit is None:
            return None
        number = min(max(BLURRING, round(x)), len(self.fit.waves))
        waves = float(self.fit.waves[number - 1])
        waves = waves if abs(waves) > ROUND_OFF * float(np.abs(self.fit.waves).max()) else 0.0
        token = "positive" if waves >= 0 else "negative"
        name = split_label(self.labels[1])[0]
        value = value_of(name, waves, self.labels[1], token, mark=(float(number), waves))
        return Reading(float(number), waves, tr("term {number}", number=number), (value,), "")

    def bars(self) -> list[tuple[int, QRectF]]:
        """Return the number and the rectangle, in pixels, of each bar that is not zero."""
        found = []
        for number, waves in enumerate(self.fit.waves.tolist() if self.fit else [], 1):
            if number >= BLURRING and waves:
                left, low = self.to_pixels(number - WIDTH / 2, 0.0)
                right, high = self.to_pixels(number + WIDTH / 2, waves)
                found.append((number, QRectF(QPointF(left, low), QPointF(right, high)).normalized()))
        return found

    def paint_over(self, painter: QPainter) -> None:
        """Paint the bars."""
        for number, room in self.bars():
            positive = self.fit is not None and self.fit.waves[number - 1] > 0
            painter.fillRect(room, QColor(self.theme.positive if positive else self.theme.negative))

    def rows_of_data(self) -> list[list[str]]:
        """Return every term as a row."""
        return csv_rows(self.fit) if self.fit else []
