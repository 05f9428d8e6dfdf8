"""The surface under the pointer, highlighted in the layout and told to the other panels."""

import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf.lens.lens import Lens
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import polylines
from p2sf_explorer.compute.glass_outlines import clear_rims, profile, sections, still
from p2sf_explorer.store.store import Store

NEAR_PX = 5.0


class SurfaceHighlight:
    """Finds the surface near a point of a drawing, tells the store, and paints the surface that any panel points at."""

    def __init__(self, store: Store, chart: Chart):
        self._store, self._chart = store, chart
        self.surface = 0
        store.pointed.connect(self._show)

    def point(self, lens: Lens, point: QPointF) -> None:
        """Tell the store which surface (from 1) is near a point, 0 for none."""
        self._store.point_at(nearest(lens, self._chart, point))

    def leave(self) -> None:
        """Tell the store that the pointer has gone."""
        self._store.point_at(0)

    def _show(self, surface: int) -> None:
        self.surface = surface
        self._chart.update()

    def paint(self, painter: QPainter, lens: Lens) -> None:
        """Paint the surface as a thick line."""
        if not 1 <= self.surface <= len(lens.surfaces):
            return
        painter.setPen(QPen(QColor(self._chart.theme.accent), 4 * self._chart.theme.scale))
        for part in polylines(*self._chart.to_pixels(*section(lens, self.surface))):
            painter.drawPolyline(part)


def section(lens: Lens, surface: int) -> tuple[np.ndarray, np.ndarray]:
    """Return z and y of a surface (from 1) from rim to rim, mm from the first vertex."""
    rim = clear_rims(still(lens))[surface - 1]
    return sections(lens)[surface - 1].placed(*profile(lens.surfaces[surface - 1], 0.0, rim))


def nearest(lens: Lens, chart: Chart, point: QPointF) -> int:
    """Return the surface within a few pixels of a point, 0 if none is."""
    found, near = {}, NEAR_PX * chart.theme.scale
    for surface in range(1, len(lens.surfaces) + 1):
        x, y = chart.to_pixels(*section(lens, surface))
        order = np.argsort(y)
        if y.min() - near <= point.y() <= y.max() + near:
            found[surface] = abs(float(np.interp(point.y(), y[order], x[order])) - point.x())
    close = min(found, key=found.__getitem__, default=0)
    return close if close and found[close] <= near else 0
