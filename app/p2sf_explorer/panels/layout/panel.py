"""The lens to scale, its rays, pupils and cardinal points; source, sensor, stop and glass can be dragged."""

from dataclasses import replace
from math import ceil

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QToolTip

from p2sf_explorer.charts.chart import Chart, Curve
from p2sf_explorer.charts.painting import polygon
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.glass_outlines import Section
from p2sf_explorer.compute.layout import Drawing, GlassOutline, Layout, LayoutRays, sensor_half
from p2sf_explorer.compute.quantities import visible_colour
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.panels.layout.drag import CURSORS, LayoutDrag
from p2sf_explorer.panels.layout.marks import ROW_PX, paint_marks
from p2sf_explorer.panels.layout.object_space import END_PX, SHARE, STRIP_PX
from p2sf_explorer.panels.layout.source_point import TIP as TIP_OF_SOURCE
from p2sf_explorer.panels.layout.source_point import DrawnSetup, SourceHandle, space_of
from p2sf_explorer.panels.layout.surface_highlight import SurfaceHighlight
from p2sf_explorer.state.scales import nice, with_sign
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser, select_or_add
from p2sf_explorer.widgets.thumbnail import glass

TIP = (
    "The lens to scale. The stop limits the cone of light; the lens images it into the pupils EnP and ExP. With Clip "
    "at rims, a ray ends with a bar at the rim that stops it. Drag the source, the sensor or the stop; click glass, "
    "then drag it, its edges or its vertices."
)
WIDTHS = (1, 1.1, 1.25, 1.4, 1.6, 1.8, 2, 2.25, 2.5, 2.8, 3.2, 3.6, 4, 4.5, 5, 5.6, 6.3, 7.1, 8, 9)  # times 10ᵏ mm
LEAN_PX = 0.5  # of a bar that is painted upright all the same
END_BAR_PX = 11  # of the bar at the end of a clipped ray
STEP = 0.02  # of the width, by which the picture moves
KINDS = {"marginal": ("marginal", 2), "rim": ("chief", 1), "chief": ("chief", 2)}
SHORT = {"marginal": "marginal", "chief": "chief", "rim": "rim rays"}  # in the legend
WORDS = {"marginal": "marginal rays, axial point", "chief": "chief ray", "rim": "rim rays of the field point"}
OTHER_FIELDS = ("marginal", "third", "warning", "muted")  # colours of the fans whose source is not at the ring
COLOURED = (("kind", "by kind"), ("field", "by field"), ("wavelength", "by wavelength"))
COLOURED_TIP = "Rays coloured by kind, or from every field or at every wavelength of the lens"
LARGER = (10, 30, 100)
LARGER_WORDS = {
    False: "tilts and decentres ×{factor}, rays as they are",
    True: "tilts and decentres of Misalign ×{factor}, rays and those of the file as they are",
}
LARGER_TIP = "Factor by which the drawing enlarges the tilts and decentres of the Misalign panel"
COUNTS = (3, 5, 7, 11, 21)
COUNT_TIP = "How many rays come from each point"
TIPS = {
    "source": TIP_OF_SOURCE,
    "sensor": "The sensor: drag it along the axis to shift it.",
    "rim": "The stop's rim: drag it up or down to change the f-number.",
    "stop": "The stop: drag it along the axis within its air gap; the f-number stays.",
    "edge": "The surface's edge: drag it sideways to change the radius.",
    "vertex": "The vertex: drag it along the axis to change the thickness before it; what follows moves with it.",
    "bend": "The selected element: drag it sideways to bend it, its thin-lens power stays; up or down to decentre it. "
    "A click selects its group.",
    "glass": "The selection: drag it along the axis, or up or down to decentre it. A click no longer selects glass.",
    "held": "The selected piece. A click selects its group; its sliders are in the Misalign panel.",
    "other": "Click to select this element, then drag it, its edges and its vertices.",
}


class LayoutPanel:
    """The lens, whose glass and stop stay while the source moves, with rays and marks."""

    def __init__(self, store: Store):
        self._store, self._lens = store, store.state.optics.lens
        self._theme: Tokens = LIGHT
        self._named: tuple[tuple[LayoutRays, ...], str] = ((), "")  # as the legend has it
        self.widget = Card("Layout", TIP)
        self.widget.setMinimumHeight(92)
        self.chart = LayoutChart(store)
        self.chart.setMinimumHeight(56)
        self.widget.set_body(self.chart)
        self.rays = self.chart.rays
        self.coloured = chooser(COLOURED, COLOURED_TIP, self.widget)
        self.count = chooser(tuple((str(n), tr("{count} rays", count=n)) for n in COUNTS), COUNT_TIP, self.widget)
        self.widget.bind(store, rays_coloured=self.coloured)
        self.count.activated.connect(lambda: store.update(rays_count=int(self.count.currentData())))
        factors = tuple((str(n), tr("tilts ×{factor}", factor=n)) for n in LARGER)
        self.larger = chooser((("1", "tilts as they are"), *factors), LARGER_TIP, self.widget)
        self.larger.activated.connect(lambda: store.update(exaggerated=int(self.larger.currentData())))
        self.larger.hide()
        self.widget.add_tool(self.larger)
        self.widget.add_tool(self.coloured)
        self.widget.add_tool(self.count)
        self.widget.quiet.add(self.larger, self.coloured, self.count)

    def show(self, live: DrawnSetup) -> None:
        """Paint the lens if it has changed, rays and marks always."""
        display = live.state.display
        factor, count = display.exaggerated, display.rays_count
        select_or_add(self.larger, str(factor), tr("tilts ×{factor}", factor=factor))
        self.larger.setVisible(bool(live.state.optics.errors))
        select_or_add(self.count, str(count), tr("{count} rays", count=count))
        if live.state.optics.lens != self._lens:
            self._lens = live.state.optics.lens
            self._store.select(None)
        self.chart.show_live(live)
        named = live.layout.groups, drawing_note(live.layout)
        if named != self._named:
            self._named = named
            self._write_legend()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.chart.restyle(theme)
        self._write_legend()

    def _write_legend(self) -> None:
        live = self.chart.live
        field = live.state.optics.field_deg if live else 0.0
        self.widget.set_readout(legend(self._theme, live.layout if live else None, field))


class RayCurve(Curve):
    """Rays of one colour, which are drawn up to the break of the axis; marks would look like handles here."""

    marked = False

    def paint(self, painter: QPainter, chart: Chart) -> None:
        """Paint the lines right of the break."""
        if isinstance(chart, LayoutChart) and chart.live:
            painter.save()
            painter.setClipRect(chart.area.adjusted(space_of(chart, chart.live).broken, 0, 0, 0))
            super().paint(painter, chart)
            painter.restore()


class LayoutChart(Chart):
    """The picture: glass in the background, rays as curves, stop, sensor, names and what can be held above."""

    def __init__(self, store: Store):
        super().__init__(aspect=True, framed=False)
        self.rays: dict[str, Curve] = {kind: RayCurve(*look) for kind, look in KINDS.items()}
        self.fans: list[RayCurve] = []
        self.curves = list(self.rays.values())
        self.columns = "z, mm", "y, mm"
        for kind, curve in self.rays.items():
            curve.name = tr(WORDS[kind])
        self.handle = SourceHandle(self)
        self.drag = LayoutDrag(store, self, self.handle)
        self.highlight = SurfaceHighlight(store, self)
        self.live: DrawnSetup | None = None
        self._store = store
        self._drawn: tuple[Drawing, float] | None = None  # and half the height of the sensor for stated fields, mm
        store.selected.connect(lambda surfaces: self.update())

    def show_live(self, live: DrawnSetup) -> None:
        """Show an answer; while something is held, in the same scale."""
        self.live, layout = live, live.layout
        before, self._drawn = self._drawn, (layout.drawing, sensor_half(live.setup.lens, ()))
        if before is None or not same_glass(before[0], layout.drawing):
            self.forget_background()
        if before is None or not self.drag.active:
            self._fit(*self._drawn)
        for kind, curve in self.rays.items():
            paths = [] if layout.groups else [ray for ray in layout.rays if ray.kind == kind]
            curve.set_data(_join([p.z for p in paths]), _join([p.y for p in paths]))
        self._show_fans(layout, live.state.optics.field_deg)
        self.update()

    def _show_fans(self, layout: Layout, field_deg: float) -> None:
        """Show each fan as a curve of its colour."""
        self.fans = []
        for number, colour in enumerate(fan_colours(layout.groups, field_deg)):
            fan, paths = RayCurve(colour, 1), [ray for ray in layout.rays if ray.group == number]
            fan.name = fan_name(layout.groups, number)
            fan.set_data(_join([p.z for p in paths]), _join([p.y for p in paths]))
            self.fans.append(fan)
        self.curves = [*self.rays.values(), *self.fans]

    def takes(self, point: QPointF) -> bool:
        """Return whether a press takes hold of something."""
        return self.live is not None and self.drag.find(self.live, point) is not None

    def unpin_all(self) -> bool:
        """Give up a drag with Escape; without one, remove all markers."""
        return self.drag.cancel() if self.drag.active else super().unpin_all()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the lens to the new size."""
        super().resizeEvent(event)
        if self._drawn:
            self._fit(*self._drawn)

    def _fit(self, d: Drawing, half: float) -> None:
        """Fill the height or the width with lens and sensor; the empty object space is cropped to a strip."""
        box, length = self.area, d.right - d.left
        rows = max(0.1, 1 - 2 * ROW_PX * self.theme.scale / box.height())  # the names' rows above and under the glass
        tall = max(2 * d.half_height / rows, 2.25 * max(d.half_height, half))
        strip = min((END_PX + STRIP_PX) * self.theme.scale, SHARE * box.width())
        long = ROOM * length / (1 - strip / box.width())
        wide = nice(max(long, tall * box.width() / box.height()), WIDTHS)
        right = d.right + 0.06 * wide + ASIDE * max(0.0, wide - 1.06 * long)
        right = STEP * wide * ceil(right / (STEP * wide))  # in steps, so that the glass stays while the sensor moves
        half = wide * box.height() / box.width() / 2
        self.set_range((right - wide, right), (-half, half))

    def paint_background(self, painter: QPainter) -> None:
        """Paint axis and glass."""
        if not self._drawn:
            return
        painter.setPen(QPen(QColor(self.theme.line), self.theme.scale))
        axis = float(self.to_pixels(0.0, 0.0)[1])
        painter.drawLine(QPointF(0, axis), QPointF(self.width(), axis))
        for outline in self._drawn[0].outlines:
            painter.setBrush(glass(outline.index, self.theme))
            painter.setPen(QPen(QColor(self.theme.glass_edge), self.theme.scale))
            painter.drawPolygon(self._polygon(outline))
        for mirror in self._drawn[0].glass.mirrors:
            paint_mirror(painter, polygon(*self.to_pixels(mirror.z, mirror.y)), mirror.behind, self.theme)
        for lens in self._drawn[0].glass.ideal:
            line = polygon(*self.to_pixels(np.full(2, lens.z), np.array([-lens.half, lens.half])))
            paint_ideal_lens(painter, line, lens.gathers, self.theme)

    def _paint_bars(self, painter: QPainter, d: Drawing, half: float) -> None:
        """Paint stop and sensor."""
        wedge = 0.18 * d.half_height + 0.25 * d.stop_rim
        for side in (-1, 1):
            self._bar(painter, 3, d.stop, side * d.stop_rim, side * (d.stop_rim + wedge))
        for low, high in d.dark:
            self._bar(painter, 3, d.stop, low, high)
        if d.sensor_surface.flat:
            self._bar(painter, 2, d.sensor, -half, half)
            return
        painter.setPen(QPen(QColor(self.theme.text), 2 * self.theme.scale, c=Qt.PenCapStyle.FlatCap))
        painter.drawPolyline(polygon(*self.to_pixels(*d.sensor_line(half))))

    def _paint_ends(self, painter: QPainter) -> None:
        """Paint a bar where a rim stops a ray."""
        for ray in self.live.layout.rays if self.live else ():
            if ray.clipped:
                x, y = (float(v) for v in self.to_pixels(ray.z[-1], ray.y[-1]))
                wide, tall = self.theme.px(2), self.theme.px(END_BAR_PX)
                painter.fillRect(QRectF(x - wide / 2, y - tall / 2, wide, tall), QColor(self.theme.text))

    def _bar(self, painter: QPainter, width: float, place: Section, start: float, end: float) -> None:
        """Paint a thick line between two heights of a plane that stands upright or not."""
        low, high = min(start, end), max(start, end)
        (x, top), (foot, bottom) = (self.to_pixels(*place.placed(0.0, y)) for y in (high, low))
        wide = width * self.theme.scale
        if abs(x - foot) < LEAN_PX:
            painter.fillRect(QRectF(x - wide / 2, top, wide, bottom - top), QColor(self.theme.text))
            return
        painter.setPen(QPen(QColor(self.theme.text), wide, c=Qt.PenCapStyle.FlatCap))
        painter.drawLine(QPointF(x, top), QPointF(foot, bottom))

    def _polygon(self, outline: GlassOutline) -> QPolygonF:
        return polygon(*self.to_pixels(outline.z, outline.y))

    def paint_over(self, painter: QPainter) -> None:
        """Paint marks, names, the source and what can be held."""
        if self.live and self._drawn:
            self._paint_selection(painter, self.live)
            self.highlight.paint(painter, self.live.setup.lens)
            self._paint_bars(painter, self._drawn[0], self.live.layout.sensor_half)
            self._paint_ends(painter)
            start = space_of(self, self.live).break_z  # left of it nothing is to scale
            right = tuple(mark for mark in self.live.layout.marks if mark.z >= start)
            paint_marks(painter, self, replace(self.live.layout, marks=right))
            self.handle.paint(painter, self.live)
            self.drag.paint(painter, self.live)

    def _paint_selection(self, painter: QPainter, live: DrawnSetup) -> None:
        """Frame the selected glass."""
        selected, lens = self._store.selection, live.setup.lens
        if not selected or selected[1] > len(lens.surfaces):
            return
        painter.setPen(QPen(QColor(self.theme.accent), 2 * self.theme.scale))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for outline in live.layout.drawing.glass.outlines:
            if selected[0] <= outline.surfaces[0] and outline.surfaces[1] <= selected[1]:
                painter.drawPolygon(self._polygon(outline))

    def event(self, event: QEvent) -> bool:
        """Say what is under the pointer and what a hand can do with it; keep Escape while something is held."""
        if isinstance(event, QHelpEvent) and self.live and self._drawn:
            point = QPointF(event.pos())
            tip, named = self.drag.tip(self.live, point), self._glass_tip(self._drawn[0], point)
            QToolTip.showText(event.globalPos(), "\n".join(filter(None, (named, tip and tr(TIPS[tip])))), self)
            return True
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            if event.key() == Qt.Key.Key_Escape and self.drag.active:
                event.accept()
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
        """Take hold of what is under the pointer."""
        if event.button() == Qt.MouseButton.LeftButton and self.live:
            self.drag.press(self.live, event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move what is held; show what can be."""
        if self.live is None:
            return
        self.drag.move(self.live, event.position(), event.modifiers())
        if not self.drag.active:
            self.highlight.point(self.live.setup.lens, event.position())
            over = self.drag.hover
            self.setCursor(CURSORS[over.kind] if over else Qt.CursorShape.ArrowCursor)

    def leaveEvent(self, event: QEvent) -> None:
        """Highlight nothing any more."""
        self.highlight.leave()
        self.drag.leave()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go, and fit the picture to what has become of it."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.drag.release(self.live)
            self._fit_again()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Give up a drag, or a selection, with Escape."""
        if event.key() != Qt.Key.Key_Escape or not self.drag.cancel():
            super().keyPressEvent(event)
        self._fit_again()

    def _fit_again(self) -> None:
        if self._drawn and not self.drag.active:
            self._fit(*self._drawn)


def paint_mirror(painter: QPainter, line: QPolygonF, behind: int, theme: Tokens) -> None:
    """Paint a mirror: a thick line, hatched on its back, which lies to the right where ``behind`` is 1."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.glass_edge), theme.px(2)))
    painter.drawPolyline(line)
    painter.setPen(QPen(QColor(theme.glass_edge), theme.scale))
    across = np.array([line.at(k).toTuple() for k in range(line.size())])
    travelled = np.append(0.0, np.cumsum(np.hypot(*np.diff(across, axis=0).T)))
    step = max(theme.px(HATCH_PX), travelled[-1] / MOST_HATCHES)
    places = np.arange(step / 2, travelled[-1], step)
    length = theme.px(HATCH_PX) * 0.7
    for x, y in zip(*(np.interp(places, travelled, column) for column in across.T), strict=True):
        painter.drawLine(QPointF(x, y), QPointF(x + behind * length, y + length))


def paint_ideal_lens(painter: QPainter, line: QPolygonF, gathers: bool, theme: Tokens) -> None:
    """Paint a thin lens as a line with arrowheads, which point outwards where it gathers light, else inwards."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.glass_edge), theme.px(2)))
    painter.drawPolyline(line)
    barb = theme.px(ARROW_PX)
    for tip, inwards in ((line.at(0), -1), (line.at(1), 1)):
        back = inwards * (barb if gathers else -barb)
        for side in (-barb, barb):
            painter.drawLine(tip, tip + QPointF(side, back))


ARROW_PX = 6  # an ideal lens's arrowhead along and across, at scale 1
HATCH_PX = 8  # from one line of a mirror's hatching to the next, at scale 1
MOST_HATCHES = 2000  # of one mirror, which may be 10¹² pixels long in a view of a far smaller lens
ROOM = 1.22  # of the lens's length with the sensor, right of the break of the axis
ASIDE = 0.3  # of the room that is left over, behind the sensor


def same_glass(before: Drawing, now: Drawing) -> bool:
    """Return whether the outlines are the same: the elements, and a medium up to the sensor."""
    filled = len(now.outlines) > len(now.glass.outlines)
    return before.glass is now.glass and not (filled and before.sensor_z != now.sensor_z)


def _join(parts: list[np.ndarray]) -> np.ndarray:
    """Return polylines one after the other, with a NaN between them."""
    return np.concatenate([np.append(part, np.nan) for part in parts]) if parts else np.array([])


def fan_colours(groups: tuple[LayoutRays, ...], field_deg: float) -> tuple[str, ...]:
    """Return the colour of each fan: that of its light, or that of the ring for the field of the source."""
    if len({fan.wavelength_nm for fan in groups}) > 1:
        return tuple(visible_colour(fan.wavelength_nm) for fan in groups)
    others = iter(OTHER_FIELDS * len(groups))
    return tuple("chief" if abs(fan.field_deg - field_deg) < SAME_DEG else next(others) for fan in groups)


SAME_DEG = 1e-6


def fan_name(groups: tuple[LayoutRays, ...], number: int) -> str:
    """Return what tells a fan from the others: its wavelength, or its field."""
    fan = groups[number]
    if len({other.wavelength_nm for other in groups}) > 1:
        return local(f"{fan.wavelength_nm:.0f} nm")
    return local(f"{with_sign(fan.field_deg, 1)}°")


def drawing_note(layout: Layout) -> str:
    """Return that the drawing is no section of symmetry, and by what it exaggerates; "" where neither is so."""
    notes = [layout.note.text(WINDOW)] if layout.note else []
    if layout.exaggerated > 1:
        notes.append(tr(LARGER_WORDS[layout.file_tilted], factor=layout.exaggerated))
    return ", ".join(notes)


def legend(theme: Tokens, layout: Layout | None = None, field_deg: float = 0.0) -> str:
    """Return the lines' names in their colours."""
    note = drawing_note(layout) if layout else ""
    names = [
        (theme.marginal, "━", tr(SHORT["marginal"])),
        (theme.chief, "━", tr(SHORT["chief"])),
        (theme.chief, "─", tr(SHORT["rim"])),
    ]
    if layout and layout.groups:
        colours = fan_colours(layout.groups, field_deg)
        names = [
            (getattr(theme, colour, colour), "━", fan_name(layout.groups, number))
            for number, colour in enumerate(colours)
        ]
    if note:
        names = [(theme.warning, "▲", note), *names]
    return " &nbsp; ".join(f'<span style="color:{colour}">{sign}</span> {name}' for colour, sign, name in names)
