"""How good the picture is: the Huygens reference, the difference, and every method's time against its error."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.charts.brightness import stretched
from p2sf_explorer.charts.painting import small_font
from p2sf_explorer.charts.plots import HeatMap, plot_widget, restyle_plot
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.reference import Accuracy, MethodResult
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.panels.psf import PSF_MAP
from p2sf_explorer.state.scales import nice, significant, written_r_squared
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.readout import Readout

TIP = "Accuracy: R² = 1 − Σ(reference − PSF)²/Σ(reference − mean)² against a converged sum of traced rays (Huygens)."
DIFFERENCE_MAP = "CET-D1A"
EMPTY = (
    "When the sliders rest, the picture is compared with a converged sum of exact rays (Huygens): the reference, the "
    "difference, and what every method costs in time and error appear here."
)
SMALLEST_ERROR = 1e-9
Anchor = tuple[float, float]
MARGIN_PX = 14  # between the outer dots and the edge of their plot
LETTERS = QMarginsF(4, 4, 4, 4)  # px around the letters of a label, as of every text document of Qt
LEVELS = tuple(k / 8 for k in range(-4, 13))  # of a label's height, from its top to its dot
SLANT_COST = 20.0  # px² of covered label that a label would rather have than stand a label's height higher or lower
ASIDE = 0.04  # of a label's width, between it and its dot


class AccuracyPanel:
    """Reference and difference maps at the left, the methods at the right; filled by the background worker."""

    def __init__(self, store: Store):
        self.widget = Card("Accuracy", TIP)
        self.reference = HeatMap("reference, µm", "y, µm", self.widget)
        self.difference = HeatMap("picture − reference, µm", "y, µm", self.widget)
        self.reference.set_map(PSF_MAP)
        self.difference.set_map(DIFFERENCE_MAP)
        self.methods = plot_widget("time of one PSF, ms", "relative L2 error")
        self.methods.getPlotItem().setLogMode(True, True)
        self.methods.getPlotItem().getViewBox().setDefaultPadding(0.15)
        self.points = pg.ScatterPlotItem(size=9)
        self.methods.addItem(self.points)
        self.labels: list[pg.TextItem] = []
        self.message = Readout(self.widget, pill=True, colour="text")
        self.body = QWidget(self.widget)
        self.body.setVisible(False)
        self.empty = QLabel(tr(EMPTY), self.widget)
        self.empty.setObjectName("muted")
        self.empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.empty.setWordWrap(True)
        row = QHBoxLayout(self.body)
        row.setContentsMargins(0, 0, 0, 0)
        for part, share in ((self.reference, 4), (self.difference, 4), (self.methods, 6)):
            row.addWidget(part, share)
        self.widget.set_body(self.body)
        self.widget.set_body(self.empty)
        self.widget.add_footer(self.message)
        self.message.set_text(tr("the reference is summed when the sliders rest"), "muted")
        self._theme, self._figure = LIGHT, ""
        self._places: list[tuple[float, float]] = []  # of the methods' dots, in decades of ms and of error
        self.methods.getPlotItem().getViewBox().sigResized.connect(self._place_labels)

    def show(self, live: Live) -> None:
        """Mark what is shown as belonging to an earlier picture until the worker answers."""
        if self._figure:
            self._show_figure(stale=True)

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
        for label in self.labels:
            label.setVisible(not stale)

    def show_accuracy(self, accuracy: Accuracy, stale: bool) -> None:
        """Paint reference, difference and methods."""
        self.body.setVisible(True)
        self.empty.setVisible(False)
        psf, reference = accuracy.picture, accuracy.reference
        count, step = reference.values.shape[-1], reference.pixel_um
        start = -(count // 2 + 0.5) * step
        rect, peak = (start, start, count * step, count * step), float(reference.values.max())
        scale = accuracy.live.state.display.psf_scale
        self.reference.show_values(stretched(reference.values / peak, scale), (0.0, 1.0), rect)
        self.reference.means(reference.values / peak, "PSF, peak = 1")
        self.reference.bar.show_scale(PSF_MAP, "% of peak", ((0.0, "0"), (1.0, "100")))
        delta = (psf.values - reference.values) / peak
        limit = common_limit(delta)
        self.difference.show_values(delta, (-limit, limit), rect)
        self.difference.means(delta, "difference, share of the reference's peak")
        labels = ((0.0, f"−{100 * limit:g}"), (0.5, "0"), (1.0, f"+{100 * limit:g}"))
        self.difference.bar.show_scale(DIFFERENCE_MAP, "% of peak", labels)
        for chart in (self.reference, self.difference):
            chart.set_extent(count * step / 2)
        self._show_methods(accuracy.results, psf.method)
        r2 = written_r_squared(accuracy.r_squared)
        wide, seconds = significant(count * step, 3), f"{reference.seconds:.2f}"
        first = tr("{method} vs Huygens: R² {r} in {wide} µm", method=psf.method, r=r2, wide=wide)
        second = tr("reference from {count} rays, {seconds} s", count=reference.rays, seconds=seconds)
        self._figure = f"{first} · {second}"
        self._show_figure(stale)

    def _show_methods(self, results: tuple[MethodResult, ...], shown: str) -> None:
        """Paint a dot and a label for each method."""
        for label in self.labels:
            self.methods.removeItem(label)
        self.labels = []
        brushes = [pg.mkBrush(self._theme.chief if r.method == shown else self._theme.marginal) for r in results]
        self._places = [
            (np.log10(max(r.milliseconds, 1e-3)), np.log10(max(r.relative_l2, SMALLEST_ERROR))) for r in results
        ]
        self.points.setData(  # in decades
            [x for x, _ in self._places], [y for _, y in self._places], brush=brushes, pen=None
        )
        for method in results:
            label = pg.TextItem(local(method_words(method)), self._theme.muted)
            label.setFont(small_font())
            self.methods.addItem(label, ignoreBounds=True)
            self.labels.append(label)
        self._place_labels()

    def _place_labels(self) -> None:
        """Show all dots, and put each label where it is clear of dots and other labels in the present size."""
        if not self._places:
            return
        view = self.methods.getPlotItem().getViewBox()
        size = max(80.0, view.width()), max(60.0, view.height())
        spans = [with_margin([place[k] for place in self._places], size[k]) for k in (0, 1)]
        self.methods.setRange(xRange=spans[0], yRange=spans[1], padding=0)
        (left, right), (low, high) = spans
        dots = [((x - left) / (right - left) * size[0], (high - y) / (high - low) * size[1]) for x, y in self._places]
        sizes = [label.boundingRect().size() for label in self.labels]
        for label, place, anchor in zip(self.labels, self._places, anchors(sizes, dots, size), strict=True):
            label.setAnchor(anchor)
            label.setPos(*place)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        for part in (self.reference, self.difference, self.message):
            part.restyle(theme)
        restyle_plot(self.methods, theme)
        for label in self.labels:
            label.setColor(theme.muted)


def common_limit(delta: np.ndarray) -> float:
    """Return the power of ten that holds all differences: few scales, so that methods and fields can be compared."""
    return nice(max(1e-6, float(np.abs(delta).max())), (1,))


def method_words(method: MethodResult) -> str:
    """Return a method's name and R²; the reference has no R² against itself."""
    return method.method if method.method == "huygens" else f"{method.method}  R² {written_r_squared(method.r_squared)}"


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
            (across, down): QRectF(QPointF(x - across * label.width(), y - down * label.height()), label) - LETTERS
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
