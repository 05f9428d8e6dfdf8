"""The histogram of builds."""

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QPainter

from p2sf.tolerance.criteria import LARGE_IS_GOOD
from p2sf_explorer.compute.views.tolerances import Figures
from p2sf_explorer.widgets.chart_card import NotedChart


class Histogram(NotedChart):
    """How many builds have which value; those that keep the limit in another colour than those that do not."""

    def __init__(self) -> None:
        super().__init__("", "builds")
        self._view: Figures | None = None

    def show_counts(self, view: Figures) -> None:
        """Show a histogram."""
        self._view = view
        self.update()

    def rows_of_data(self) -> list[list[str]]:
        """Return the bars as rows."""
        view = self._view
        if view is None:
            return []
        rows = zip(view.edges[:-1], view.edges[1:], view.counts, strict=True)
        return [["from", "to", "builds"], *([f"{low:.9g}", f"{high:.9g}", str(count)] for low, high, count in rows)]

    def paint_over(self, painter: QPainter) -> None:
        """Paint the bars, then lines and text."""
        if self._view is not None:
            edges, _ = self.to_pixels(self._view.edges, np.zeros(1))
            _, tops = self.to_pixels(np.zeros(1), np.asarray(self._view.counts, float))
            floor = self.area.bottom()
            good = self._view.criterion in LARGE_IS_GOOD
            for left, right, top, start in zip(edges[:-1], edges[1:], tops, self._view.edges, strict=False):
                kept = (start >= self._view.limit) == good
                colour = QColor(self.theme.positive if kept else self.theme.negative)
                painter.fillRect(QRectF(float(left), float(top), float(right - left), floor - float(top)), colour)
        super().paint_over(painter)
