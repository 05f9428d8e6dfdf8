"""The source point on the layout, to be taken hold of."""

from math import atan2, degrees, inf, isfinite

import pyqtgraph as pg

from app.compute import Live
from app.plots import small_font
from app.scales import written_distance
from app.store import Store
from app.theme import Tokens

EDGE_PX = 34.0  # how far from the panel's left edge a source outside it is shown


class SourceHandle:
    """A ring at the source, or at the left edge on the chief ray when the source is further out.

    Dragging up and down turns the field; dragging sideways moves a source at a finite distance.
    """

    def __init__(self, plot: pg.PlotWidget, store: Store):
        self._store = store
        self.target = pg.TargetItem(size=15, symbol="o", movable=True)
        self.target.setToolTip("The source: drag it to change field and, at a finite distance, depth.")
        self.label = pg.TextItem(anchor=(0.5, 0.0))
        self.label.setFont(small_font())
        plot.addItem(self.target, ignoreBounds=True)
        plot.addItem(self.label, ignoreBounds=True)
        self.target.sigPositionChanged.connect(self._on_moved)
        self.target.sigPositionChangeFinished.connect(lambda: store.end())
        self._live: Live | None = None
        self._left = 0.0

    def show(self, live: Live, view: pg.ViewBox) -> None:
        """Stand where the source is, or on its chief ray at the left edge."""
        self._live = live
        (left, _), (low, high) = view.viewRange()
        pixel = view.viewPixelSize()[0]
        self._left = left + EDGE_PX * pixel
        layout = live.layout
        z = max(layout.source[0], self._left) if layout.source else self._left
        z = max(z, self._leaves(layout, low + 26 * pixel, high - 10 * pixel))
        y = layout.slope * (z - layout.entrance_z)
        self.target.blockSignals(True)
        self.target.setPos(z, y)
        self.target.blockSignals(False)
        self.label.setText(written_distance(live.state.depth_mm))
        self.label.setPos(z, y - 8 * pixel)

    @staticmethod
    def _leaves(layout, low: float, high: float) -> float:
        """Return z where the chief ray, followed back, leaves the picture between two heights."""
        if layout.slope == 0:
            return -inf
        return layout.entrance_z + (low if layout.slope > 0 else high) / layout.slope

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.target.setPen(pg.mkPen(theme.chief, width=2))
        self.target.setBrush(pg.mkBrush(theme.card))
        self.target.setHoverPen(pg.mkPen(theme.text, width=2))
        self.label.setColor(theme.muted)

    def _on_moved(self) -> None:
        self._store.begin()
        position, layout, state = self.target.pos(), self._live.layout, self._live.state
        z = min(position.x(), layout.drawing.left - 1e-3)
        reach = layout.entrance_z - z
        changes = {}
        if reach > 0:
            changes["field_deg"] = max(-89.0, min(89.0, degrees(atan2(-position.y(), reach))))
        if isfinite(state.depth_mm) and z > self._left:
            changes["depth_mm"] = -z
        self._store.update(**changes)
