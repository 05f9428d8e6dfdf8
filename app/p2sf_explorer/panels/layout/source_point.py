"""The source point on the layout, which can be dragged from near the lens to infinity."""

from math import isfinite
from typing import Protocol

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import pen, write
from p2sf_explorer.compute.layout import Layout
from p2sf_explorer.compute.setup import ParaxialSetup, ranges
from p2sf_explorer.i18n.tr import local
from p2sf_explorer.panels.layout.object_space import ObjectSpace, object_space
from p2sf_explorer.state.scales import written_distance
from p2sf_explorer.state.state import State

RADIUS_PX, NEAR_PX = 7.5, 13.0
SAME_DEG = 1e-6
STROKE_PX = 6.0  # half the height of the strokes that break the axis
TIP = "The source: drag it up and down to change the field, sideways to change the depth; ∞ is at the left."


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


def space_of(chart: Chart, shown: DrawnSetup) -> ObjectSpace:
    """Return where a chart draws sources at present."""
    (origin, axis), (right, _) = chart.to_pixels(0.0, 0.0), chart.to_pixels(1.0, 0.0)
    drawing, limits = shown.layout.drawing, ranges(shown.setup.prescription)
    return object_space(
        (float(origin), float(axis), float(right - origin)),
        (chart.width(), chart.height()),
        (drawing.left, drawing.half_height),
        shown.layout.entrance_z,
        limits.middle_mm,
        max(limits.field_deg, abs(shown.state.optics.field_deg)),
        chart.theme.scale,
    )


class SourceHandle:
    """A ring at the source; behind the break of the axis, pale lines lead from it to its rays."""

    def __init__(self, chart: Chart):
        self._chart = chart

    def pixel(self, shown: DrawnSetup) -> QPointF:
        """Return the ring's place in pixels."""
        return QPointF(*space_of(self._chart, shown).place(shown.state.optics.depth_mm, shown.layout.slope))

    def near(self, shown: DrawnSetup, point: QPointF) -> bool:
        """Return whether a pixel is close enough to the ring to take hold of it."""
        apart = point - self.pixel(shown)
        return apart.x() ** 2 + apart.y() ** 2 < (NEAR_PX * self._chart.theme.scale) ** 2

    def changes(self, shown: DrawnSetup, point: QPointF) -> dict[str, float]:
        """Return the entries of the state that put the source under a pixel."""
        depth, field = space_of(self._chart, shown).source(point.x(), point.y())
        return {"depth_mm": depth, "field_deg": field}

    def paint(self, painter: QPainter, shown: DrawnSetup) -> None:
        """Paint the ring, what leads to it, and the source's distance."""
        space, at, theme = space_of(self._chart, shown), self.pixel(shown), self._chart.theme
        paint_break(painter, self._chart, space)
        if isfinite(shown.state.optics.depth_mm):  # else the ring says so
            sign = QRectF(space.end - theme.px(10), space.axis - theme.px(18), 2 * theme.px(10), theme.px(14))
            write(painter, sign, "∞", 0, theme.tick)
        if at.x() < space.broken:
            self._paint_leads(painter, shown, space, at)
        radius = RADIUS_PX * theme.scale
        painter.setPen(QPen(QColor(theme.chief), 2 * theme.scale))
        painter.setBrush(QColor(theme.card))
        painter.drawEllipse(at, radius, radius)
        painter.setPen(QColor(theme.muted))
        rect = QRectF(at.x() - theme.px(40), at.y() + radius + theme.px(2), 2 * theme.px(40), theme.px(14))
        write(painter, rect, local(written_distance(shown.state.optics.depth_mm)), 0, theme.tick)

    def _paint_leads(self, painter: QPainter, shown: DrawnSetup, space: ObjectSpace, at: QPointF) -> None:
        """Lead from ring and axial point to where their rays come over the break."""
        axial = QPointF(at.x(), space.axis)
        for ray in shown.layout.rays:
            if len(ray.z) < 2:  # it meets no surface
                continue
            height = float(ray.y[0] + (space.break_z - ray.z[0]) * (ray.y[1] - ray.y[0]) / (ray.z[1] - ray.z[0]))
            colour, start = ("marginal", axial) if ray.kind == "marginal" else ("chief", at)
            groups = shown.layout.groups
            if groups and abs(groups[ray.group].field_deg - shown.state.optics.field_deg) > SAME_DEG:
                continue  # another field has a source of its own, which is not drawn
            crossing = QPointF(space.broken, space.axis - height * space.scale)
            if not 0 <= crossing.y() <= self._chart.height():
                continue
            painter.setPen(
                QPen(pen(getattr(self._chart.theme, colour), 110).color(), self._chart.theme.scale, Qt.PenStyle.DotLine)
            )
            painter.drawLine(QLineF(start, crossing))


def paint_break(painter: QPainter, chart: Chart, space: ObjectSpace) -> None:
    """Break the axis by two slanted strokes, and put a tick at infinity."""
    unit = chart.theme.scale
    gap = QRectF(space.broken - 4 * unit, space.axis - unit, 5 * unit, 3 * unit)
    painter.fillRect(gap, QColor(chart.theme.card))
    painter.setPen(QPen(QColor(chart.theme.muted), 1.2 * unit))
    tall, aside = STROKE_PX * unit, 2.5 * unit
    for x in (gap.left(), gap.right()):
        painter.drawLine(QPointF(x - aside, space.axis + tall), QPointF(x + aside, space.axis - tall))
    painter.drawLine(QPointF(space.end, space.axis - 3 * unit), QPointF(space.end, space.axis + 3 * unit))
