"""What a hand holds on the layout: it finds grips, moves them, and writes their value beside the pointer."""

from collections.abc import Iterator
from dataclasses import replace
from math import inf

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import width_of, write
from p2sf_explorer.compute.layout import nearly_straight
from p2sf_explorer.panels.layout.grips import (
    Grip,
    Span,
    can_bend,
    drag,
    glass_runs,
    group_of,
    placed_grips,
)
from p2sf_explorer.panels.layout.source_point import DrawnSetup, SourceHandle
from p2sf_explorer.panels.layout.values import value_of
from p2sf_explorer.store.store import Store

SOURCE = Grip("source", 0.0, 0.0)
NEAR_PX = 7.0
WEDGE_PX = 14.0  # of the stop's bar beyond its rim, which moves the stop along the axis
CLICK_PX = 4.0
DOT_PX = 4.0
FOLDED = Message("the axis is folded, so glass cannot be moved by hand here; use the sliders of Misalign")
FINE = 0.1  # of the pointer's way, with Alt
VALUE_PX = 13
CURSORS = {
    "source": Qt.CursorShape.SizeAllCursor,
    "sensor": Qt.CursorShape.SizeHorCursor,
    "rim": Qt.CursorShape.SizeVerCursor,
    "stop": Qt.CursorShape.SizeHorCursor,
    "edge": Qt.CursorShape.SizeHorCursor,
    "vertex": Qt.CursorShape.SizeHorCursor,
    "glass": Qt.CursorShape.SizeAllCursor,
    "other": Qt.CursorShape.PointingHandCursor,
}


class LayoutDrag:
    """One drag at a time, one step of undo; Alt makes it ten times as fine, Escape gives it up.

    Glass that is not selected is ``other`` glass: a click selects its element, the next one its group, then nothing.
    """

    def __init__(self, store: Store, chart: Chart, source: SourceHandle):
        self._store, self._chart, self._source = store, chart, source
        self.grip: Grip | None = None  # which is held
        self.hover: Grip | None = None
        self._at = self._last = self._press = QPointF()
        self._start = store.state
        self._moved = False

    @property
    def active(self) -> bool:
        """Return whether something is held, so that the scale of the picture must not change."""
        return self.grip is not None

    def find(self, shown: DrawnSetup, point: QPointF) -> Grip | None:
        """Return what can be held at a pixel."""
        if self._source.near(shown, point):
            return SOURCE
        near = [(self._distance(grip, shown, point), k, grip) for k, grip in enumerate(self.grips(shown))]
        enough = NEAR_PX * self._chart.theme.scale
        distance, _, best = min(near, default=(enough, 0, None), key=lambda found: found[:2])
        return best if distance < enough else self._glass(shown, point)

    def grips(self, shown: DrawnSetup) -> Iterator[Grip]:
        """Yield everything to hold but the source and the glass; behind a fold nothing."""
        yield from placed_grips(shown.setup, shown.layout, self._store.selection)

    def _distance(self, grip: Grip, shown: DrawnSetup, point: QPointF) -> float:
        """Return how far a pixel is from a grip: a point, the sensor's line, or the stop's bars."""
        at = self.pixel(grip)
        across = abs(point.x() - at.x())
        if grip.kind == "sensor":
            half = shown.layout.sensor_half * self._scale()
            return max(across, abs(point.y() - at.y()) - half)
        if grip.kind == "stop":
            axis = self._chart.to_pixels(0.0, 0.0)[1]
            beyond = (abs(point.y() - axis) - abs(at.y() - axis)) / self._chart.theme.scale
            return across if NEAR_PX / 2 < beyond < NEAR_PX / 2 + WEDGE_PX else inf
        return max(across, abs(point.y() - at.y()))

    def _scale(self) -> float:
        return 1 / self._chart.per_pixel()

    def pixel(self, grip: Grip) -> QPointF:
        """Return the place of a grip in pixels."""
        return QPointF(*(float(v) for v in self._chart.to_pixels(*grip.place)))

    def _glass(self, shown: DrawnSetup, point: QPointF) -> Grip | None:
        """Return the element under a pixel: the one selected, or another that a click selects."""
        z, y = self._chart.from_pixels(point)
        selected = self._store.selection
        for outline in shown.layout.drawing.glass.outlines:
            if inside(outline.z, outline.y, z, y):
                run = next((run for run in self.runs(shown) if run[0] <= outline.surfaces[0] < run[1]), None)
                if run is None:
                    return None
                held = selected is not None and selected[0] <= run[0] and run[1] <= selected[1]
                return Grip("glass", z, y, selected) if held and selected else Grip("other", z, y, run)
        return None

    def runs(self, shown: DrawnSetup) -> tuple[Span, ...]:
        """Return the elements."""
        return glass_runs(shown.layout.drawing.glass.outlines)

    def press(self, shown: DrawnSetup, point: QPointF) -> None:
        """Take hold of what is at a pixel; select other glass."""
        found = self.find(shown, point)
        if found is None:
            return
        if found.kind == "other":
            self._store.select(found.surfaces)
            self._chart.update()
            return
        self.grip, self._start, self._moved = found, self._store.state, False
        self._press = self._last = point
        self._at = self._source.pixel(shown) if found.kind == "source" else self.pixel(found)

    def move(self, shown: DrawnSetup, point: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        """Follow the pointer while held, else say what could be."""
        if self.grip is None:
            self._hover_over(self.find(shown, point))
            return
        if not self._moved:
            if self.grip.kind == "glass" and not self._take(self.grip, shown, point - self._press):
                return
            self._moved = True
            self._store.begin()
        fine = FINE if modifiers & Qt.KeyboardModifier.AltModifier else 1.0
        self._at, self._last = self._at + (point - self._last) * fine, point
        if self.grip.kind == "source":
            self._store.update(**self._source.changes(shown, self._at))
            return
        try:
            self._store.replace(drag(self.grip, self._start, *self._chart.from_pixels(self._at)))
        except P2SFError as error:
            self._store.refused.emit(error)

    def _take(self, grip: Grip, shown: DrawnSetup, way: QPointF) -> bool:
        """Begin to move glass: across the axis it is decentred. Return whether it can be moved, and no click is meant.

        Behind a fold it cannot, which is said once.
        """
        if way.manhattanLength() < CLICK_PX:
            return False
        if not nearly_straight(shown.setup.lens):
            self.grip = None
            self._store.refused.emit(FOLDED)
            return False
        if abs(way.y()) > abs(way.x()):
            self.grip = replace(grip, kind="decentre")
        return True

    def leave(self) -> None:
        """Mark nothing any more that could be held."""
        self._hover_over(None)

    def _hover_over(self, found: Grip | None) -> None:
        if found != self.hover:
            self.hover = found
            self._chart.update()

    def release(self, shown: DrawnSetup | None) -> None:
        """Let go; a click on selected glass selects its group, a click on that nothing."""
        grip, self.grip = self.grip, None
        if grip and self._moved:
            self._store.end()
        elif grip and grip.kind == "glass" and shown:
            run = next(run for run in self.runs(shown) if grip.surfaces[0] <= run[0])
            group = group_of(shown.setup.lens, self.runs(shown), run)
            self._store.select(None if grip.surfaces == group else group)
        self._chart.update()

    def cancel(self) -> bool:
        """Give the drag up, or what is selected; return whether there was anything."""
        if self.grip:
            self.grip = None
            self._store.cancel()
        elif self._store.selection:
            self._store.select(None)
        else:
            return False
        self._chart.update()
        return True

    def paint(self, painter: QPainter, shown: DrawnSetup) -> None:
        """Paint the grips of what is selected, the one under the pointer, and the value beside a hand that moves."""
        held = self.grip or self.hover
        painter.setPen(QPen(QColor(self._chart.theme.accent), 1.5 * self._chart.theme.scale))
        for grip in self.grips(shown):
            lit = held is not None and (grip.kind, grip.surfaces) == (held.kind, held.surfaces)
            if grip.kind not in ("edge", "vertex") and not lit:
                continue
            if grip.kind in ("edge", "vertex", "rim"):
                self._paint_dot(painter, self.pixel(grip), lit, square=grip.kind == "edge")
        if self.grip and self._moved:
            paint_value(painter, self._chart, self._last, value_of(self.grip, shown))

    def _paint_dot(self, painter: QPainter, at: QPointF, lit: bool, square: bool) -> None:
        theme = self._chart.theme
        painter.setBrush(QColor(theme.accent if lit else theme.card))
        half = DOT_PX * theme.scale
        room = QRectF(at.x() - half, at.y() - half, 2 * half, 2 * half)
        (painter.drawRect if square else painter.drawEllipse)(room)

    def tip(self, shown: DrawnSetup, point: QPointF) -> str:
        """Return the English key of what can be done at a pixel, "" for nothing."""
        found = self.find(shown, point)
        if found is None:
            return ""
        if found.kind == "glass" and not nearly_straight(shown.setup.lens):
            return "held"
        bends = found.kind == "glass" and can_bend(shown.setup.prescription, found.surfaces)
        return "bend" if bends else found.kind


def inside(px: np.ndarray, py: np.ndarray, x: float, y: float) -> bool:
    """Return whether a point lies in a polygon, by the even-odd rule."""
    qx, qy = np.roll(px, -1), np.roll(py, -1)
    crosses = (py > y) != (qy > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = px + (y - py) / (qy - py) * (qx - px)
    return bool((crosses & (at > x)).sum() % 2)


def paint_value(painter: QPainter, chart: Chart, at: QPointF, words: str) -> None:
    """Write a value on a ground of its own beside the pointer, inside the picture."""
    theme, size, gap = chart.theme, chart.theme.px(VALUE_PX), chart.theme.px(14)
    wide = width_of(words, size) + gap
    left = at.x() + gap if at.x() + gap + wide < chart.width() else at.x() - gap - wide
    top = min(max(2.0, at.y() - theme.px(30)), float(chart.height() - theme.px(24)))
    room = QRectF(max(2.0, left), top, wide, theme.px(21))
    painter.setPen(QPen(QColor(theme.accent), theme.scale))
    painter.setBrush(QColor(theme.card))
    painter.drawRoundedRect(room, theme.px(5), theme.px(5))
    painter.setPen(QColor(theme.text))
    write(painter, room, words, 0, size)
