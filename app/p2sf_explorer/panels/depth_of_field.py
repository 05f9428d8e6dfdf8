"""Depth of field: the blur at every depth, and the depths that are sharp for a tolerated blur."""

from math import inf

from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QPainter

from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.depth_of_field import DepthOfField, highest
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import told_apart, written_distance
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import NotedChart, legend
from p2sf_explorer.widgets.value_edit import MicronEdit

TIP = (
    "Depth of field: the depths whose blur is no wider than the tolerated one. Paraxial: diameter of the cone from "
    "the axial point on the sensor, linear in 1/distance. Exact rays: twice the RMS radius of the spot at the "
    "present field."
)
BLUR_TIP = "Largest blur diameter on the sensor that is still called sharp."
LOOKS = {"paraxial, axis": "marginal", "exact rays, this field": "chief"}
TICKS = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)


class DepthChart(NotedChart):
    """Blur over 1/depth, written as depths; the sharp depths shaded."""

    def __init__(self) -> None:
        super().__init__("depth, even in 1/depth", "blur, µm")
        self.sharp: tuple[float, float] | None = None
        self.bottom_tick_maker, self.write_bottom = depth_ticks, written_depth

    def paint_over(self, painter: QPainter) -> None:
        """Paint the shade, then lines and text."""
        if self.sharp:
            left, right = (float(self.to_pixels(near, 0.0)[0]) for near in self.sharp)
            colour = QColor(self.theme.positive)
            colour.setAlpha(40)
            box = QRectF(left, self.area.top(), max(2.0, right - left), self.area.height())
            painter.fillRect(box.intersected(self.area), colour)
        super().paint_over(painter)


class DepthOfFieldPanel:
    """Two curves of blur, the tolerated one, and the sentence that says what is sharp."""

    def __init__(self, store: Store):
        self.widget = Card("Depth of field", TIP)
        self.blur = MicronEdit(store, "blur_um", "Tolerated blur", BLUR_TIP, self.widget)
        self.widget.add_tool(self.blur)
        self.chart = DepthChart()
        self.tolerated = self.chart.add_curve("muted")
        self.curves = {name: self.chart.add_curve(token, 2) for name, token in LOOKS.items()}
        for name, curve in self.curves.items():
            curve.name = tr(name)
        self.chart.columns = "1/depth, 1/mm", "blur, µm"
        self.widget.set_body(self.chart)
        self._theme = LIGHT

    def show(self, live: Live) -> None:
        """Paint the curves and what is sharp."""
        view: DepthOfField = live.views["depth_of_field"].found
        self.blur.show_value(view.tolerated_um)
        edges = float(view.near[0]), float(view.near[-1])
        for curve, blur in zip(self.curves.values(), (view.paraxial, view.real), strict=True):
            curve.set_data(view.near, blur)
        self.tolerated.set_data(edges, (view.tolerated_um,) * 2)
        self._frame(view, edges)
        self.chart.sharp = sharp_range(view, edges[1])
        self.chart.show_notes((), ((1 / live.state.optics.depth_mm, "chief"),))
        self.widget.set_readout(f"{legend(LOOKS, self._theme)} &nbsp; {sentence(view)}")

    def _frame(self, view: DepthOfField, edges: tuple[float, float]) -> None:
        """Show the ranges."""
        self.chart.set_range(edges, (0.0, highest(view)), steady="y")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.chart.restyle(theme)


def depth_ticks(low: float, high: float, most: float) -> list[tuple[float, str]]:
    """Return five steps along an axis of 1/depth in 1/mm, written as depths."""
    places = [low + part * (high - low) for part in TICKS]
    return list(zip(places, told_apart([depth_of(near) for near in places]), strict=True))


def depth_of(near: float) -> float:
    """Return the depth in mm of 1/depth; infinity at zero."""
    return 1 / near if near else inf


def written_depth(near: float) -> str:
    """Return a place on an axis of 1/depth, 1/mm, as a depth."""
    return f"{tr('depth')} {written_distance(depth_of(near))}"


def sharp_range(view: DepthOfField, highest_near: float) -> tuple[float, float] | None:
    """Return the ends of what is sharp in 1/depth, 1/mm; None where nothing is."""
    if not view.sharp_mm:
        return None
    near, far = (1 / mm if mm else highest_near for mm in view.sharp_mm)
    return far, near


def sentence(view: DepthOfField) -> str:
    """Return in words which depths are sharp."""
    if not view.sharp_mm:
        return tr("no depth in front of the lens is sharp")
    near, far = (written_distance(mm) if mm else tr("the lens itself") for mm in view.sharp_mm)
    focus = written_distance(view.hyperfocal_mm)
    return tr("sharp from {near} to {far} · hyperfocal distance {focus}", near=near, far=far, focus=focus)
