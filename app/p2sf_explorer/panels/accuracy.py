"""How good the picture is: the Huygens reference, the difference, and every method's time against its error."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QPainter, QResizeEvent
from PySide6.QtWidgets import QLabel

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf.psf.methods import REFERENCE
from p2sf.studies.complete_trade import Row
from p2sf.studies.trade_fronts import batch_us, error, front, group_of, nbytes
from p2sf_explorer.charts.axes import decades
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.painting import set_text, write
from p2sf_explorer.charts.plots import HeatMap
from p2sf_explorer.charts.reading import Reading, closest, value_of
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.finer import smooth
from p2sf_explorer.compute.framing import frame_of, light_circle
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.reference import Accuracy, MethodResult
from p2sf_explorer.compute.trade import trade_of
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels.psf import PSF_MAP
from p2sf_explorer.state.scales import nice, significant, written_r_squared
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser
from p2sf_explorer.widgets.chart_card import TurningRow
from p2sf_explorer.widgets.readout import Readout
from p2sf_explorer.widgets.trade_chart import TradeChart, TradeDot

TIP = "Accuracy: R² = 1 − Σ(reference − PSF)²/Σ(reference − mean)² against a converged sum of traced rays (Huygens)."
DIFFERENCE_MAP = "CET-D1A"
EMPTY = (
    "When the sliders rest, the picture is compared with a converged sum of exact rays (Huygens): the reference, the "
    "difference, and what every method costs in time and error appear here."
)
SMALLEST_ERROR = 1e-9
SHOWN = {"here": "methods here", "bytes": "all PSFs, by bytes", "time": "all PSFs, by time"}
SHOWN_TIP = (
    "Whether the plot at the right shows every method at this point, or every representation of all PSFs of the lens"
)
COSTS = {"bytes": ("bytes of all PSFs of the lens", nbytes), "time": ("time of a PSF among many, µs", batch_us)}
GROUP_COLOURS = {
    "six coefficients": "marginal",
    "fitted numbers": "chief",
    "Zernike grid": "#009e73",
    "PSF grid": "#cc79a7",
    "PCA": "#9a7bd0",
    "neural": "#c8a000",
    "Gaussian, Moffat": "muted",
    "traced": "text",
    "huygens": "#d64545",
}
NOT_TRADED = "The complete trade has been measured for shipped lenses only"
Anchor = tuple[float, float]
MARGIN_PX = 14  # between the outer dots and the edge of their plot
DOT_PX = 4.5  # radius
LEVELS = tuple(k / 8 for k in range(-4, 13))  # of a label's height, from its top to its dot
SLANT_COST = 20.0  # px² of covered label that a label would rather have than stand a label's height higher or lower
ASIDE = 0.04  # of a label's width, between it and its dot


class AccuracyPanel:
    """Reference and difference maps at the left, the methods at the right; filled by the background worker."""

    def __init__(self, store: Store):
        self.widget = Card("Accuracy", TIP)
        self.reference = HeatMap("reference, µm", "y, µm", self.widget)
        self.difference = HeatMap("picture − reference, µm", "y, µm", self.widget)
        self.reference.chart.smooth = self.difference.chart.smooth = True
        self.reference.set_map(PSF_MAP)
        self.difference.set_map(DIFFERENCE_MAP)
        self.methods = MethodsChart()
        self.trade = TradeChart("bytes of all PSFs of the lens", "L2 error")
        self.trade.setVisible(False)
        self.shown = chooser(tuple(SHOWN.items()), SHOWN_TIP, self.widget)
        self.widget.add_tool(self.shown)
        self.widget.bind(store, accuracy_plot=self.shown)
        self._traded: tuple[str, str] | None = None
        self._state = store.state
        self._legend = ""
        self.message = Readout(self.widget, pill=True, colour="text")
        charts = self.reference, self.difference, self.methods, self.trade
        self.body = TurningRow(charts, (4, 4, 6, 6), self.widget)
        self.body.setVisible(False)
        self.empty = QLabel(tr(EMPTY), self.widget)
        self.empty.setObjectName("muted")
        self.empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.empty.setWordWrap(True)
        self.widget.set_body(self.body)
        self.widget.set_body(self.empty)
        self.widget.add_footer(self.message)
        self.message.set_text(tr("the reference is summed when the sliders rest"), "muted")
        self._figure = ""
        for heat in (self.reference, self.difference):
            heat.chart.columns = "x, µm", "y, µm"

    def show(self, live: Live) -> None:
        """Mark what is shown as belonging to an earlier picture until the worker answers."""
        self._state = live.state
        self._show_plot()
        if self._figure:
            self._show_figure(stale=True)

    def _show_plot(self) -> None:
        """Show the methods at this point, or what the complete trade has measured of this lens."""
        cost = self._state.choices.accuracy_plot
        trade = trade_of(self._state) if cost in COSTS else None
        for part in (self.reference, self.difference, self.methods):
            part.setVisible(trade is None)
        self.trade.setVisible(trade is not None)
        self.shown.setToolTip(tr(SHOWN_TIP) if trade or cost == "here" else tr(NOT_TRADED))
        self.widget.set_readout(self._legend if trade else "")
        if trade is None or self._traded == (trade.lens, cost):
            return
        self._traded = trade.lens, cost
        label, of = COSTS[cost]
        self.trade.name_axes(label, "L2 error")
        best = front(trade.rows, of)
        dots = {id(row): dot_of(row, of(row)) for row in trade.rows}
        self.trade.show_dots(tuple(dots.values()), tuple(dots[id(row)] for row in best))

    def show_progress(self, part: float) -> None:
        """Show how far the sum of the reference is."""
        self._figure = ""
        self.message.set_text(tr("summing the reference: {part} %", part=f"{100 * part:.0f}"), "muted")

    def show_failure(self, why: Message | P2SFError) -> None:
        """Say why there is no reference."""
        self._figure = ""
        self.message.set_text(said(why), "warning")

    def _show_figure(self, stale: bool) -> None:
        """Say what was measured, and nothing of an earlier picture but that it is one."""
        self.message.set_text(tr("earlier picture") if stale else self._figure, "muted" if stale else "text")
        self.methods.show_labels(not stale)

    def show_accuracy(self, accuracy: Accuracy, stale: bool) -> None:
        """Paint reference, difference and methods."""
        self.body.setVisible(True)
        self.empty.setVisible(False)
        psf, reference = accuracy.picture, accuracy.reference
        count, step = reference.values.shape[-1], reference.pixel_um
        start = -(count // 2 + 0.5) * step
        rect, peak = (start, start, count * step, count * step), float(reference.values.max())
        scale = accuracy.live.state.display.psf_scale
        brightness = ColourScale(
            PSF_MAP, 0.0, 100.0, "% of peak", "PSF, % of the peak", scale, measure="peak", grounded=True
        )
        values = 100 * reference.values / peak
        self.reference.show_map(values, rect, brightness, smooth(values))
        delta = 100 * (psf.values - reference.values) / peak
        limit = common_limit(delta)
        about = ColourScale(
            DIFFERENCE_MAP, -limit, limit, "% of peak", "difference, % of the peak", measure="difference", grounded=True
        )
        self.difference.show_map(delta, rect, about, smooth(delta))
        frame = frame_of(light_circle(reference.values, step, accuracy.live.airy_radius_um))
        for heat in (self.reference, self.difference):
            heat.chart.set_view((frame.x_um, frame.y_um), frame.half_um)
        self.methods.show_methods(accuracy.results, psf.method)
        r2 = written_r_squared(accuracy.r_squared)
        wide, seconds = significant(count * step, 3), f"{reference.seconds:.2f}"
        if reference.method == REFERENCE:
            first = tr("{method} vs Huygens: R² {r} in {wide} µm", method=psf.method, r=r2, wide=wide)
        else:
            first = tr("{method} vs spherical waves: R² {r} in {wide} µm", method=psf.method, r=r2, wide=wide)
        second = tr("reference from {count} rays, {seconds} s", count=reference.rays, seconds=seconds)
        self._figure = f"{first} · {second}"
        self._show_figure(stale)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        for part in (self.reference, self.difference, self.methods, self.trade, self.message):
            part.restyle(theme)
        colours = {group: getattr(theme, token, token) for group, token in GROUP_COLOURS.items()}
        marks = (f'<span style="color:{colour}">●</span> {tr(group)}' for group, colour in colours.items())
        self._legend = " &nbsp; ".join(marks)
        self._show_plot()


def dot_of(row: Row, cost: float) -> TradeDot:
    """Return a representation of the complete trade as a dot; its error is the median relative L2."""
    group, most = group_of(row), max(row.relative_l2.most, error(row))
    return TradeDot(cost, error(row), most, GROUP_COLOURS[group], group, row.settings)


class MethodsChart(Chart):
    """A dot and a label for each method, over decades of milliseconds and of error."""

    def __init__(self) -> None:
        super().__init__("time of one PSF, ms", "relative L2 error")
        self.bottom_tick_maker = self.left_tick_maker = decades
        self.results: tuple[MethodResult, ...] = ()
        self.places: list[tuple[float, float]] = []  # of the dots, in decades of ms and of error
        self.rects: list[QRectF] = []  # of the labels, px
        self.shown, self.labelled = "", True

    def show_methods(self, results: tuple[MethodResult, ...], shown: str) -> None:
        """Show methods, that of the picture on screen in a colour of its own."""
        self.results, self.shown = results, shown
        self.places = [
            (float(np.log10(max(r.milliseconds, 1e-3))), float(np.log10(max(r.relative_l2, SMALLEST_ERROR))))
            for r in results
        ]
        self._fit()
        self.update()

    def show_labels(self, on: bool) -> None:
        """Show the labels, or only the dots."""
        self.labelled = on
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the margins about the dots."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        if self.places:
            size = self.area.width(), self.area.height()
            x, y = (with_margin([place[k] for place in self.places], size[k]) for k in (0, 1))
            self.set_range(x, y)

    def rows_of_data(self) -> list[list[str]]:
        """Return the methods as rows: name, milliseconds, relative error, R²."""
        rows = [[r.method, f"{r.milliseconds:.9g}", f"{r.relative_l2:.9g}", f"{r.r_squared:.9g}"] for r in self.results]
        return [["", *self.labels, "R²"], *rows] if rows else []

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the method whose dot is nearest."""
        number = closest(np.array(self.places).reshape(-1, 2), np.array([x, y]), self.pixel_size())
        if number is None:
            return None
        method, place = self.results[number], self.places[number]
        token = "chief" if method.method == self.shown else "marginal"
        time = value_of(tr("time"), method.milliseconds, self.labels[0], token, mark=place)
        return Reading(*place, method.method, (time, value_of(self.labels[1], method.relative_l2, "", token)), "")

    def paint_over(self, painter: QPainter) -> None:
        """Paint the dots, and the labels where they are clear of dots and of each other."""
        dots = [tuple(float(v) for v in self.to_pixels(*place)) for place in self.places]
        painter.setPen(Qt.PenStyle.NoPen)
        for method, (x, y) in zip(self.results, dots, strict=True):
            painter.setBrush(QColor(self.theme.chief if method.method == self.shown else self.theme.marginal))
            painter.drawEllipse(QPointF(x, y), DOT_PX * self.theme.scale, DOT_PX * self.theme.scale)
        self.rects = self._label_rects([(x - self.area.left(), y - self.area.top()) for x, y in dots])
        painter.setPen(QColor(self.theme.muted))
        for method, rect in zip(self.results if self.labelled else (), self.rects, strict=False):
            write(painter, rect, method_words(method), -1, self.theme.tick)

    def _label_rects(self, dots: list[tuple[float, float]]) -> list[QRectF]:
        sizes = [set_text(method_words(method), self.theme.tick).size() for method in self.results]
        found = anchors(sizes, dots, (self.area.width(), self.area.height()))
        corners = [
            QPointF(x - across * size.width(), y - down * size.height()) + self.area.topLeft()
            for (across, down), size, (x, y) in zip(found, sizes, dots, strict=True)
        ]
        return [QRectF(corner, size) for corner, size in zip(corners, sizes, strict=True)]


def common_limit(delta: np.ndarray) -> float:
    """Return the power of ten that holds all differences: few scales, so that methods and fields can be compared."""
    return nice(max(1e-4, float(np.abs(delta).max())), (1,))


def method_words(method: MethodResult) -> str:
    """Return a method's name and R²; the reference has no R² against itself."""
    return method.method if method.method == REFERENCE else f"{method.method}  R² {written_r_squared(method.r_squared)}"


def with_margin(values: list[float], length_px: float) -> tuple[float, float]:
    """Return a range of at least a decade that holds the values with `MARGIN_PX` to spare at both ends."""
    low, high = min(values), max(values)
    spare = max(0.0, 1.0 - (high - low)) / 2
    low, high = low - spare, high + spare
    margin = (high - low) * MARGIN_PX / max(1.0, length_px - 2 * MARGIN_PX)
    return low - margin, high + margin


def anchors(labels: list[QSizeF], dots: list[tuple[float, float]], size: tuple[float, float]) -> list[Anchor]:
    """Return the anchor of each label, from its size, on its dot; all in pixels, y down.

    A label stands at the right or left of its dot, where it covers least of dots and other labels, as level as can be.
    """
    taken, chosen = [QRectF(x - 5, y - 5, 10, 10) for x, y in dots], []
    area = QRectF(0, 0, *size)
    for label, (x, y) in zip(labels, dots, strict=True):

        def cost(at: Anchor, rect: QRectF) -> float:
            hidden = surface(rect) - surface(rect & area) + sum(surface(rect & other) for other in taken)
            return round(hidden + SLANT_COST * abs(at[1] - 0.5), 6)  # so that right is before left where both are free

        rects = {
            (across, down): QRectF(QPointF(x - across * label.width(), y - down * label.height()), label)
            for down in LEVELS
            for across in (-ASIDE, 1 + ASIDE)  # right or left
        }
        at, room = min(rects.items(), key=lambda item: cost(*item))
        taken.append(room)
        chosen.append(at)
    return chosen


def surface(rect: QRectF) -> float:
    """Return the area of a rectangle, px²."""
    return rect.width() * rect.height()
