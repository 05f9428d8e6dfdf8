"""The source point on the layout, to be taken hold of."""

from math import atan2, degrees, inf, isfinite

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import write
from p2sf_explorer.state.scales import written_distance
from p2sf_explorer.store.store import Store

EDGE_PX = 34.0  # how far from the panel's left edge a source outside it is shown
RADIUS_PX, NEAR_PX = 7.5, 13.0
TIP = "The source: drag it to change field and, at a finite distance, depth."


class SourceHandle:
    """A ring at the source, or at the left edge on the chief ray when the source is further out.

    Dragging up and down turns the field; dragging sideways moves a source at a finite distance.
    """

    def __init__(self, store: Store):
        self._store = store
        self._held = False

    def place(self, chart: Chart) -> tuple[float, float]:
        """Return z and y of the ring in mm: where the source is, or where its chief ray leaves the picture."""
        (left, _), (low, high) = chart.ranges()
        pixel, layout = chart.per_pixel(), chart.live.layout
        edge = left + EDGE_PX * pixel
        z = max(layout.source[0], edge) if layout.source else edge
        z = max(z, _leaves(layout, low + 26 * pixel, high - 10 * pixel))
        return z, layout.slope * (z - layout.entrance_z)

    def pixel(self, chart: Chart) -> QPointF:
        """Return where the ring stands, in pixels."""
        return QPointF(*(float(v) for v in chart.to_pixels(*self.place(chart))))

    def paint(self, painter: QPainter, chart: Chart) -> None:
        """Paint the ring and the source's distance."""
        at, theme = self.pixel(chart), chart.theme
        painter.setPen(QPen(QColor(theme.chief), 2))
        painter.setBrush(QColor(theme.card))
        painter.drawEllipse(at, RADIUS_PX, RADIUS_PX)
        painter.setPen(QColor(theme.muted))
        room = QRectF(at.x() - 40, at.y() + RADIUS_PX + 2, 80, 14)
        write(painter, room, written_distance(chart.live.state.depth_mm))

    def near(self, chart: Chart, point: QPointF) -> bool:
        """Return whether a pixel is close enough to take hold of the ring."""
        apart = point - self.pixel(chart)
        return apart.x() ** 2 + apart.y() ** 2 < NEAR_PX**2

    def tip(self, chart: Chart, point: QPointF) -> str:
        """Return what to say about the ring, if the pointer is on it."""
        return TIP if self.near(chart, point) else ""

    def press(self, chart: Chart, point: QPointF) -> None:
        """Take hold."""
        if self.near(chart, point):
            self._held = True
            self._store.begin()

    def release(self) -> None:
        """Let go."""
        if self._held:
            self._held = False
            self._store.end()

    def move(self, chart: Chart, point: QPointF) -> None:
        """Follow the pointer while held."""
        if not self._held:
            return
        layout, state = chart.live.layout, chart.live.state
        at, y = chart.from_pixels(point)
        z = min(at, layout.drawing.left - 1e-3)
        reach, changes = layout.entrance_z - z, {}
        if reach > 0:
            changes["field_deg"] = max(-89.0, min(89.0, degrees(atan2(-y, reach))))
        if isfinite(state.depth_mm) and at > chart.ranges()[0][0] + EDGE_PX * chart.per_pixel():
            changes["depth_mm"] = -z
        self._store.update(**changes)


def _leaves(layout, low: float, high: float) -> float:
    """Return z where the chief ray, followed back, leaves the picture between two heights."""
    if layout.slope == 0:
        return -inf
    return layout.entrance_z + (low if layout.slope > 0 else high) / layout.slope
