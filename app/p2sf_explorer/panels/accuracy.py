"""How good the picture is: the Huygens reference, the difference, and every method's time against its error."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QRectF, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.charts.brightness import stretched
from p2sf_explorer.charts.painting import set_text, small_font
from p2sf_explorer.charts.plots import HeatMap, plot_widget, restyle_plot
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.reference import Accuracy, MethodResult
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
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
METHODS_SHARE = 6 / 14  # of the card's width
ANCHORED = 0.06  # of a label's width, between it and its dot


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
        self.reference.bar.show_scale(PSF_MAP, "peak = 1", ((0.0, "0"), (1.0, "1")))
        delta = (psf.values - reference.values) / peak
        limit = nice(max(1e-6, float(np.abs(delta).max())))
        self.difference.show_values(delta, (-limit, limit), rect)
        self.difference.means(delta, "difference, share of the reference's peak")
        labels = ((0.0, f"−{limit:g}"), (0.5, "0"), (1.0, f"+{limit:g}"))
        self.difference.bar.show_scale(DIFFERENCE_MAP, "of peak", labels)
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
        for label in self.labels:
            self.methods.removeItem(label)
        self.labels = []
        brushes = [pg.mkBrush(self._theme.chief if r.method == shown else self._theme.marginal) for r in results]
        places = [(np.log10(max(r.milliseconds, 1e-3)), np.log10(max(r.relative_l2, SMALLEST_ERROR))) for r in results]
        self.points.setData([x for x, _ in places], [y for _, y in places], brush=brushes, pen=None)  # in decades
        if not places:
            return
        x, y = zip(*places, strict=True)
        left, right = min(x) - 0.3, max(x) + 0.3
        self.methods.setRange(xRange=(left, right), yRange=(min(y) - 0.5, max(y) + 0.5), padding=0)
        box = QRectF(left, min(y) - 0.5, right - left, max(y) - min(y) + 1)
        size = self.widget.width() * METHODS_SHARE - 70, max(60.0, self.widget.height() - 100.0)  # of its area, pixels
        dots = [((a - box.x()) / box.width() * size[0], (box.bottom() - b) / box.height() * size[1]) for a, b in places]
        words = [method_words(method) for method in results]
        for text, place, anchor in zip(words, places, anchors(words, dots, size), strict=True):
            label = pg.TextItem(text, self._theme.muted, anchor=anchor)
            label.setFont(small_font())
            label.setPos(*place)
            self.methods.addItem(label, ignoreBounds=True)
            self.labels.append(label)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        for part in (self.reference, self.difference, self.message):
            part.restyle(theme)
        restyle_plot(self.methods, theme)
        for label in self.labels:
            label.setColor(theme.muted)


def method_words(method: MethodResult) -> str:
    """Return a method's name and R²; the reference has no R² against itself."""
    return method.method if method.method == "huygens" else f"{method.method}  R² {written_r_squared(method.r_squared)}"


def anchors(words: list[str], dots: list[tuple[float, float]], size: tuple[float, float]) -> list[tuple[float, float]]:
    """Return the anchor of each label on its dot (pixels, y down): at a side, level, under or over, clear of others."""
    taken, chosen = [QRectF(x - 5, y - 5, 10, 10) for x, y in dots], []
    for text, (x, y) in zip(words, dots, strict=True):
        wide, tall = set_text(text).size().width() + 10, set_text(text).size().height()
        rects = {(over, down): QRectF(x + 5 - over * (wide + 5), y - down * tall, wide, tall) for over, down in SIDES}
        inside = [at for at, rect in rects.items() if QRectF(0, -4, size[0], size[1] + 8).contains(rect)]
        free = [at for at in inside if not any(rects[at].intersects(other) for other in taken)]
        over, down = (free or inside or list(SIDES))[0]
        taken.append(rects[over, down])
        chosen.append((over + (ANCHORED if over else -ANCHORED), down))
    return chosen


LEVELS = (0.5, 0.0, 1.0, -0.6, 1.6)  # level, under, over, and clear of a neighbour that is level
SIDES = tuple((over, down) for down in LEVELS for over in (0.0, 1.0))  # right or left
