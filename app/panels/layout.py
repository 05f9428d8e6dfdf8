"""The lens to scale, its rays, pupils and cardinal points, and the source to take hold of."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QPainterPath, QPolygonF
from PySide6.QtWidgets import QGraphicsPathItem

from app.card import Card
from app.compute import Live
from app.layout import Drawing
from app.panels.marks import Marks
from app.panels.source import SourceHandle
from app.plots import plot_widget, restyle_plot
from app.store import Store
from app.theme import LIGHT, Tokens

TIP = "The lens to scale: the stop limits the cone of light; its images by the lens are the pupils EnP and ExP."
KINDS = ("marginal", "rim", "chief")


class LayoutPanel:
    """Glass and stop stay while the source moves; rays and marks follow."""

    def __init__(self, store: Store):
        self.widget = Card("Layout", TIP)
        self.plot = plot_widget()
        for side in ("bottom", "left"):
            self.plot.getPlotItem().hideAxis(side)
        self.view = self.plot.getPlotItem().getViewBox()
        self.view.setAspectLocked(True)
        self.widget.set_body(self.plot)
        self._glass: list[QGraphicsPathItem] = []
        self.axis = self.plot.addLine(y=0)
        self.rays = {kind: pg.PlotCurveItem(connect="finite") for kind in KINDS}
        self.stop, self.sensor = pg.PlotCurveItem(connect="finite"), pg.PlotCurveItem()
        for item in (*self.rays.values(), self.stop, self.sensor):
            item.setSegmentedLineMode("on")
            self.plot.addItem(item)
        self.marks = Marks(self.plot)
        self.handle = SourceHandle(self.plot, store)
        self._drawing: Drawing | None = None
        self._theme = LIGHT
        self._live: Live | None = None
        self.view.sigResized.connect(self._on_resized)

    def show(self, live: Live) -> None:
        """Paint the lens when it has changed, rays and marks always."""
        self._live = live
        layout = live.layout
        if layout.drawing is not self._drawing:
            self._drawing = layout.drawing
            self._draw_glass()
            self._fit()
        for kind in KINDS:
            paths = [ray for ray in layout.rays if ray.kind == kind]
            self.rays[kind].setData(_joined([p.z for p in paths]), _joined([p.y for p in paths]))
        self.marks.show(layout, self.view)
        self.handle.show(live, self.view)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        restyle_plot(self.plot, theme)
        self.axis.setPen(pg.mkPen(theme.line, width=1))
        self.rays["marginal"].setPen(pg.mkPen(theme.marginal, width=1.5))
        self.rays["rim"].setPen(pg.mkPen(theme.chief, width=1))
        self.rays["chief"].setPen(pg.mkPen(theme.chief, width=2))
        self.stop.setPen(pg.mkPen(theme.text, width=3))
        self.sensor.setPen(pg.mkPen(theme.text, width=2))
        self.marks.restyle(theme)
        self.handle.restyle(theme)
        self.widget.set_readout(legend(theme))
        if self._drawing:
            self._draw_glass()

    def _on_resized(self) -> None:
        if self._live:
            self._fit()
            self.marks.show(self._live.layout, self.view)
            self.handle.show(self._live, self.view)

    def _draw_glass(self) -> None:
        for item in self._glass:
            self.plot.removeItem(item)
        self._glass = [self._element(outline) for outline in self._drawing.outlines]
        d = self._drawing
        wedge = 0.18 * d.half_height + 0.25 * d.stop_rim
        self.stop.setData(
            np.array([d.stop_z, d.stop_z, np.nan, d.stop_z, d.stop_z]),
            np.array([d.stop_rim, d.stop_rim + wedge, np.nan, -d.stop_rim, -d.stop_rim - wedge]),
        )
        self.sensor.setData(np.full(2, d.sensor_z), np.array([-d.half_height, d.half_height]))

    def _element(self, outline) -> QGraphicsPathItem:
        path = QPainterPath()
        path.addPolygon(QPolygonF([QPointF(z, y) for z, y in zip(outline.z, outline.y, strict=True)]))
        item = QGraphicsPathItem(path)
        fill = QColor(self._theme.glass)
        fill.setAlphaF(min(0.75, max(0.12, 0.9 * (outline.index - 1.2))))  # denser glass is drawn denser
        item.setBrush(fill)
        item.setPen(pg.mkPen(self._theme.glass_edge, width=1))
        item.setZValue(-10)
        item.setCacheMode(item.CacheMode.DeviceCoordinateCache)
        item.setToolTip(f"surfaces {outline.surfaces[0]} to {outline.surfaces[1]}, n = {outline.index:.4f}")
        self.plot.addItem(item)
        return item

    def _fit(self) -> None:
        """Fill the height or the width with the lens; the room that is left is to the left, where the source is."""
        d, box = self._drawing, self.view.boundingRect()
        if not box.width() or not box.height():
            return
        tall, length = 2.25 * d.half_height, d.right - d.left
        wide = max(1.5 * length, tall * box.width() / box.height())
        right = d.right + 0.06 * wide + 0.2 * max(0.0, wide - 1.7 * length)
        half = max(tall, wide * box.height() / box.width()) / 2
        self.view.setRange(xRange=(right - wide, right), yRange=(-half, half), padding=0)


def _joined(parts: list[np.ndarray]) -> np.ndarray:
    """Return polylines one behind the other, a NaN between each two."""
    return np.concatenate([np.append(part, np.nan) for part in parts]) if parts else np.array([])


def legend(theme: Tokens) -> str:
    """Return the lines' names in their colours."""
    names = (
        (theme.marginal, "━", "marginal rays, axial point"),
        (theme.chief, "━", "chief ray"),
        (theme.chief, "─", "rim rays of the field point"),
        (theme.text, "▮", "stop, sensor"),
    )
    return " &nbsp; ".join(f'<span style="color:{colour}">{sign}</span> {name}' for colour, sign, name in names)
