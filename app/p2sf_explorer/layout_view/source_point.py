"""The source point on the layout, which can be dragged."""

from math import atan2, degrees, inf, isfinite
from typing import Protocol

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import write
from p2sf_explorer.compute.layout import Layout
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.scales import written_distance
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store

EDGE_PX = 34.0  # from the panel's left edge to the ring of a source outside it
RADIUS_PX, NEAR_PX = 7.5, 13.0
TIP = "The source: drag it to change field and, at a finite distance, depth."


class DrawnSetup(Protocol):
    """What the layout needs of an answer; a set-up without a picture has it too."""

    @property
    def state(self) -> State:
        """The state."""

    @property
    def setup(self) -> ParaxialSetup:
        """What the state sets up."""

    @property
    def layout(self) -> Layout:
        """The drawing, rays and marks."""


class SourceHandle:
    """A ring at the source, or on the chief ray at the left edge when the source is farther out.

    Dragging up and down turns the field; dragging sideways moves a source at a finite distance.
    """

    def __init__(self, store: Store):
        self._store = store
        self._held = False

    def place(self, chart: Chart, shown: DrawnSetup) -> tuple[float, float]:
        """Return z and y of the ring in mm: of the source, or of the point where its chief ray leaves the picture."""
        (left, _), (low, high) = chart.ranges()
        pixel, layout = chart.per_pixel(), shown.layout
        edge = left + EDGE_PX * pixel
        z = max(layout.source[0], edge) if layout.source else edge
        z = max(z, _leaves(layout, low + 26 * pixel, high - 10 * pixel))
        return z, layout.slope * (z - layout.entrance_z)

    def pixel(self, chart: Chart, shown: DrawnSetup) -> QPointF:
        """Return the ring's place in pixels."""
        return QPointF(*(float(v) for v in chart.to_pixels(*self.place(chart, shown))))

    def paint(self, painter: QPainter, chart: Chart, shown: DrawnSetup) -> None:
        """Paint the ring and the source's distance."""
        at, theme = self.pixel(chart, shown), chart.theme
        painter.setPen(QPen(QColor(theme.chief), 2))
        painter.setBrush(QColor(theme.card))
        painter.drawEllipse(at, RADIUS_PX, RADIUS_PX)
        painter.setPen(QColor(theme.muted))
        rect = QRectF(at.x() - 40, at.y() + RADIUS_PX + 2, 80, 14)
        write(painter, rect, written_distance(shown.state.optics.depth_mm))

    def near(self, chart: Chart, shown: DrawnSetup, point: QPointF) -> bool:
        """Return whether a pixel is close enough to the ring to take hold of it."""
        apart = point - self.pixel(chart, shown)
        return apart.x() ** 2 + apart.y() ** 2 < NEAR_PX**2

    def press(self, chart: Chart, shown: DrawnSetup, point: QPointF) -> None:
        """Start dragging."""
        if self.near(chart, shown, point):
            self._held = True
            self._store.begin()

    def release(self) -> None:
        """Stop dragging."""
        if self._held:
            self._held = False
            self._store.end()

    def move(self, chart: Chart, shown: DrawnSetup, point: QPointF) -> None:
        """Follow the pointer while held."""
        if not self._held:
            return
        layout, state = shown.layout, shown.state
        at, y = chart.from_pixels(point)
        z = min(at, layout.drawing.left - 1e-3)
        distance, changes = layout.entrance_z - z, {}
        if distance > 0:
            changes["field_deg"] = max(-89.0, min(89.0, degrees(atan2(-y, distance))))
        if isfinite(state.optics.depth_mm) and at > chart.ranges()[0][0] + EDGE_PX * chart.per_pixel():
            changes["depth_mm"] = -z
        self._store.update(**changes)


def _leaves(layout: Layout, low: float, high: float) -> float:
    """Return z of the point where the chief ray, followed back, leaves the picture between two heights."""
    if layout.slope == 0:
        return -inf
    return layout.entrance_z + (low if layout.slope > 0 else high) / layout.slope
