"""The lens to scale, its rays, pupils and cardinal points, and the source, which can be dragged."""

from math import ceil

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QHelpEvent, QMouseEvent, QPainter, QPen, QPolygonF, QResizeEvent
from PySide6.QtWidgets import QToolTip

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import polygon
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.layout import Drawing, Outline
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.layout_view.marks import ROW_PX, paint_marks
from p2sf_explorer.layout_view.source_point import TIP as TIP_OF_SOURCE
from p2sf_explorer.layout_view.source_point import DrawnSetup, SourceHandle
from p2sf_explorer.layout_view.surface_highlight import SurfaceHighlight
from p2sf_explorer.state.scales import nice
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.thumbnail import glass

TIP = (
    "The lens to scale: the stop limits the cone of light; its images by the lens are the pupils EnP and ExP. With "
    "Clip at rims a ray ends, with a bar, at the rim that stops it."
)
WIDTHS = (1, 1.1, 1.25, 1.4, 1.6, 1.8, 2, 2.25, 2.5, 2.8, 3.2, 3.6, 4, 4.5, 5, 5.6, 6.3, 7.1, 8, 9)  # times 10ᵏ mm
END_PX = 11  # of the bar at the end of a clipped ray
STEP = 0.02  # of the width, by which the picture moves
KINDS = {"marginal": ("marginal", 2), "rim": ("chief", 1), "chief": ("chief", 2)}
WORDS = {"marginal": "marginal rays, axial point", "chief": "chief ray", "rim": "rim rays of the field point"}


class LayoutPanel:
    """The lens, whose glass and stop stay while the source moves, with rays and marks."""

    def __init__(self, store: Store):
        self.widget = Card("Layout", TIP)
        self.widget.setMinimumHeight(92)
        self.chart = LayoutChart(store)
        self.chart.setMinimumHeight(56)
        self.widget.set_body(self.chart)
        self.rays = self.chart.rays

    @property
    def handle(self) -> SourceHandle:
        """Return the source's handle."""
        return self.chart.handle

    def show(self, live: DrawnSetup) -> None:
        """Paint the lens if it has changed, rays and marks always."""
        self.chart.show_live(live)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
        self.widget.set_readout(legend(theme))


class LayoutChart(Chart):
    """The picture: glass in the background, rays as curves, stop, sensor, names and the source's handle above."""

    def __init__(self, store: Store):
        super().__init__(aspect=True, framed=False)
        self.rays = {kind: self.add_curve(*look) for kind, look in KINDS.items()}
        self.columns = "z, mm", "y, mm"
        for kind, curve in self.rays.items():
            curve.name = tr(WORDS[kind])
        self.handle = SourceHandle(store)
        self.highlight = SurfaceHighlight(store, self)
        self.live: DrawnSetup | None = None
        self._drawn: tuple[Drawing, float] | None = None  # and half the height of the sensor, mm
        self.setMouseTracking(True)

    def show_live(self, live: DrawnSetup) -> None:
        """Show an answer."""
        self.live, layout = live, live.layout
        before, self._drawn = self._drawn, (layout.drawing, layout.sensor_half)
        if before is None or not same_glass(before[0], layout.drawing):
            self.forget_background()
        self._fit(*self._drawn)
        for kind, curve in self.rays.items():
            paths = [ray for ray in layout.rays if ray.kind == kind]
            curve.set_data(_joined([p.z for p in paths]), _joined([p.y for p in paths]))
        self.update()

    def takes(self, point: QPointF) -> bool:
        """Return whether a press takes hold of the source."""
        return self.live is not None and self.handle.near(self, self.live, point)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the lens to the new size."""
        super().resizeEvent(event)
        if self._drawn:
            self._fit(*self._drawn)

    def _fit(self, d: Drawing, half: float) -> None:
        """Fill the height or the width with lens and sensor; the rest is free at the left, where the source is."""
        box, length = self.area, d.right - d.left
        rows = max(0.1, 1 - 2 * ROW_PX / box.height())  # the names' rows above and under the glass
        tall = max(2 * d.half_height / rows, 2.25 * max(d.half_height, half))
        wide = nice(max(1.5 * length, tall * box.width() / box.height()), WIDTHS)
        right = d.right + 0.06 * wide + 0.2 * max(0.0, wide - 1.7 * length)
        right = STEP * wide * ceil(right / (STEP * wide))  # in steps, so that the glass stays while the sensor moves
        half = wide * box.height() / box.width() / 2
        self.set_range((right - wide, right), (-half, half))

    def paint_background(self, painter: QPainter) -> None:
        """Paint axis and glass."""
        if not self._drawn:
            return
        painter.setPen(QPen(QColor(self.theme.line), 1))
        axis = float(self.to_pixels(0.0, 0.0)[1])
        painter.drawLine(QPointF(0, axis), QPointF(self.width(), axis))
        for outline in self._drawn[0].outlines:
            painter.setBrush(glass(outline.index, self.theme))
            painter.setPen(QPen(QColor(self.theme.glass_edge), 1))
            painter.drawPolygon(self._polygon(outline))

    def _paint_bars(self, painter: QPainter, d: Drawing, half: float) -> None:
        """Paint stop and sensor."""
        wedge = 0.18 * d.half_height + 0.25 * d.stop_rim
        for side in (-1, 1):
            self._bar(painter, 3, d.stop_z, side * d.stop_rim, side * (d.stop_rim + wedge))
        self._bar(painter, 2, d.sensor_z, -half, half)

    def _paint_ends(self, painter: QPainter) -> None:
        """Paint a bar where a rim stops a ray."""
        for ray in self.live.layout.rays if self.live else ():
            if ray.clipped:
                x, y = (float(v) for v in self.to_pixels(ray.z[-1], ray.y[-1]))
                painter.fillRect(QRectF(x - 1, y - END_PX / 2, 2, END_PX), QColor(self.theme.text))

    def _bar(self, painter: QPainter, width: float, z: float, start: float, end: float) -> None:
        (x, top), (_, bottom) = self.to_pixels(z, max(start, end)), self.to_pixels(z, min(start, end))
        painter.fillRect(QRectF(x - width / 2, top, width, bottom - top), QColor(self.theme.text))

    def _polygon(self, outline: Outline) -> QPolygonF:
        return polygon(*self.to_pixels(outline.z, outline.y))

    def paint_over(self, painter: QPainter) -> None:
        """Paint marks, names and the source."""
        if self.live and self._drawn:
            self.highlight.paint(painter, self.live.setup.lens)
            self._paint_bars(painter, *self._drawn)
            self._paint_ends(painter)
            paint_marks(painter, self, self.live.layout)
            self.handle.paint(painter, self, self.live)

    def event(self, event: QEvent) -> bool:
        """Name the glass or the source under the pointer."""
        if isinstance(event, QHelpEvent) and self.live and self._drawn:
            point = QPointF(event.pos())
            on_source = self.handle.near(self, self.live, point)
            text = tr(TIP_OF_SOURCE) if on_source else self._glass_tip(self._drawn[0], point)
            QToolTip.showText(event.globalPos(), text, self)
            return True
        return super().event(event)

    def _glass_tip(self, drawing: Drawing, point: QPointF) -> str:
        for outline in drawing.outlines:
            if self._polygon(outline).containsPoint(point, Qt.FillRule.OddEvenFill):
                first, last = outline.surfaces
                return tr(
                    "surfaces {first} to {last}, n = {index}", first=first, last=last, index=f"{outline.index:.4f}"
                )
        return ""

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Start dragging the source."""
        if event.button() == Qt.MouseButton.LeftButton and self.live:
            self.handle.press(self, self.live, event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the source while held; show that it can be held."""
        if self.live is None:
            return
        self.handle.move(self, self.live, event.position())
        self.highlight.point(self.live.setup.lens, event.position())
        over = self.handle.near(self, self.live, event.position())
        self.setCursor(Qt.CursorShape.SizeAllCursor if over else Qt.CursorShape.ArrowCursor)

    def leaveEvent(self, event: QEvent) -> None:
        """Highlight no surface any more."""
        self.highlight.leave()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Stop dragging the source."""
        self.handle.release()


def same_glass(before: Drawing, now: Drawing) -> bool:
    """Return whether the outlines are the same: the elements, and a medium up to the sensor."""
    filled = len(now.outlines) > len(now.glass.outlines)
    return before.glass is now.glass and not (filled and before.sensor_z != now.sensor_z)


def _joined(parts: list[np.ndarray]) -> np.ndarray:
    """Return polylines one after the other, with a NaN between them."""
    return np.concatenate([np.append(part, np.nan) for part in parts]) if parts else np.array([])


def legend(theme: Tokens) -> str:
    """Return the lines' names in their colours."""
    names = (
        (theme.marginal, "━", WORDS["marginal"]),
        (theme.chief, "━", WORDS["chief"]),
        (theme.chief, "─", WORDS["rim"]),
        (theme.text, "▮", "stop, sensor"),
    )
    return " &nbsp; ".join(f'<span style="color:{colour}">{sign}</span> {tr(name)}' for colour, sign, name in names)
