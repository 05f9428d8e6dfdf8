"""The surface under the pointer, lit in the layout and named to whoever else shows surfaces."""

import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf.lens.lens import Lens
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import polylines
from p2sf_explorer.compute.glass_outlines import clear_rims, profile, still, vertices
from p2sf_explorer.store.store import Store

NEAR_PX = 5.0


class SurfaceLight:
    """Finds the surface near a point of a drawing, tells the store, and paints the one that anybody points at."""

    def __init__(self, store: Store, chart: Chart):
        self._store, self._chart = store, chart
        self.lit = 0
        store.pointed.connect(self._light)

    def point(self, lens: Lens, point: QPointF) -> None:
        """Tell of the surface (from 1) near a point, 0 for none."""
        self._store.point_at(nearest(lens, self._chart, point))

    def leave(self) -> None:
        """Tell that the pointer has gone."""
        self._store.point_at(0)

    def _light(self, surface: int) -> None:
        self.lit = surface
        self._chart.update()

    def paint(self, painter: QPainter, lens: Lens) -> None:
        """Paint the lit surface as a thick line."""
        if not 1 <= self.lit <= len(lens.surfaces):
            return
        painter.setPen(QPen(QColor(self._chart.theme.accent), 4))
        for part in polylines(*self._chart.to_pixels(*section(lens, self.lit))):
            painter.drawPolyline(part)


def section(lens: Lens, surface: int) -> tuple[np.ndarray, np.ndarray]:
    """Return z and y of a surface (from 1) from rim to rim, mm from the first vertex."""
    rim = clear_rims(still(lens))[surface - 1]
    return profile(lens.surfaces[surface - 1], vertices(lens)[surface - 1], rim)


def nearest(lens: Lens, chart: Chart, point: QPointF) -> int:
    """Return the surface within a few pixels of a point, 0 if none is."""
    found = {}
    for surface in range(1, len(lens.surfaces) + 1):
        x, y = chart.to_pixels(*section(lens, surface))
        order = np.argsort(y)
        if y.min() - NEAR_PX <= point.y() <= y.max() + NEAR_PX:
            found[surface] = abs(float(np.interp(point.y(), y[order], x[order])) - point.x())
    close = min(found, key=found.__getitem__, default=0)
    return close if close and found[close] <= NEAR_PX else 0
