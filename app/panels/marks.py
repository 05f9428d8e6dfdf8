"""Pupils, principal and focal points and the image point on the layout, with names that do not collide."""

import numpy as np
import pyqtgraph as pg

from app.layout import Layout, Mark
from app.plots import small_font
from app.theme import Tokens

LABEL_PX = 26.0  # how wide a name is, with air
LINE_PX = 13.0


class Marks:
    """One text per mark, ticks on the axis, dashed bars for the pupils; made once, moved ever after."""

    def __init__(self, plot: pg.PlotWidget):
        self._plot = plot
        self.ticks, self.pupils = pg.PlotCurveItem(connect="finite"), pg.PlotCurveItem(connect="finite")
        self.image = pg.ScatterPlotItem(size=8)
        for item in (self.ticks, self.pupils, self.image):
            plot.addItem(item)
        self._texts: dict[str, pg.TextItem] = {}
        self._theme: Tokens | None = None

    def show(self, layout: Layout, view: pg.ViewBox) -> None:
        """Move every mark to its place."""
        pixel = view.viewPixelSize()[1]
        points = [mark for mark in layout.marks if not mark.radius]
        bars = [mark for mark in layout.marks if mark.radius]
        self.ticks.setData(*_strokes([(m.z, -4 * pixel, 4 * pixel) for m in points]))
        self.pupils.setData(*_strokes([(m.z, -m.radius, m.radius) for m in bars]))
        self.image.setData(*([[v] for v in layout.image] if layout.image else ([], [])))
        names = {mark.name for mark in layout.marks}
        for name, text in self._texts.items():
            text.setVisible(name in names)
        self._place(points, 6 * pixel, -1, pixel)
        self._place(bars, None, 1, pixel)

    def _place(self, marks: list[Mark], offset: float | None, side: int, pixel: float) -> None:
        """Write names beside their marks; one that would touch its left neighbour goes a line further out."""
        last, line = -np.inf, 0
        for mark in sorted(marks, key=lambda m: m.z):
            line = line + 1 if mark.z - last < LABEL_PX * pixel else 0
            last = mark.z
            reach = mark.radius if offset is None else offset
            self._text(mark.name, side).setPos(mark.z, side * (reach + (line % 3) * LINE_PX * pixel))

    def _text(self, name: str, side: int) -> pg.TextItem:
        if name not in self._texts:
            text = pg.TextItem(name, color=self._theme.mark, anchor=(0.5, 1.0 if side > 0 else 0.0))
            text.setFont(small_font())
            text.textItem.setCacheMode(text.textItem.CacheMode.DeviceCoordinateCache)
            self._plot.addItem(text, ignoreBounds=True)
            self._texts[name] = text
        return self._texts[name]

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.ticks.setPen(pg.mkPen(theme.mark, width=1.5))
        self.pupils.setPen(pg.mkPen(theme.mark, width=1))
        self.image.setBrush(pg.mkBrush(theme.chief))
        self.image.setPen(pg.mkPen(theme.card, width=1))
        for text in self._texts.values():
            text.setColor(theme.mark)


def _strokes(strokes: list[tuple[float, float, float]]) -> tuple[np.ndarray, np.ndarray]:
    """Return upright strokes (z, from, to) as one broken polyline."""
    z = [value for stroke in strokes for value in (stroke[0], stroke[0], np.nan)]
    y = [value for stroke in strokes for value in (stroke[1], stroke[2], np.nan)]
    return np.array(z), np.array(y)
