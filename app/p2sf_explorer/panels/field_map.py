"""The field map: PSFs over the picture."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPen, QResizeEvent

from p2sf.conventions import degrees_from_slope
from p2sf_explorer.charts.cursor import Cursor, paint_cursor
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.framing import crop
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.field_map import FieldMapRequest, answer, place_of
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.tiles import TilesChart, tile

TIP = (
    "Field map: PSFs all over a 3:2 picture, upright where the panel is, whose corner is the edge of the field, each "
    "relative to its own peak and turned with its field. Click a picture, or choose it with the arrow keys and Enter, "
    "to go to its field; a frame marks the present one. If the lens is not symmetric, every picture has a field of its "
    "own, and you can drag the ring to any field."
)
RING_PX = 7  # radius of the ring at the present field, at scale 1

SAME_DEG = 1e-3  # fields that differ by less are equally far from the axis


class MapChart(TilesChart):
    """Pictures in rows and columns; a click on one goes to its field."""

    resized = Signal()

    def __init__(self, store: Store):
        super().__init__(framed=False)
        self._store = store
        self.fields_deg, self.places = np.zeros((0, 2)), np.zeros((0, 2))
        self.asked: FieldMapRequest | None = None
        self.present_at = (0.0, 0.0)
        self.choice = Cursor()
        self._taken, self._held = 0, False
        self.takes_arrows = True
        self.setAccessibleName(tr("Field map"))

    @property
    def free(self) -> bool:
        """Return whether each point of the map has a field of its own, and a press goes there."""
        return self.asked is not None and not self.asked.domain.symmetric

    def takes(self, point: QPointF) -> bool:
        """Return whether a press chooses a picture, or a field."""
        return self.free or self.tile_at(point) is not None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Go to the field of the picture under the pointer; without symmetry to that of the point itself."""
        if event.button() != Qt.MouseButton.LeftButton:
            return
        if self.free and self.tiles:
            self._held = True
            self._store.begin()
            self._follow(event.position())
        elif (number := self.tile_at(event.position())) is not None:
            self._take(number)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Follow the pointer with the field while the ring is held."""
        if self._held:
            self._follow(event.position())
        else:
            super().mouseMoveEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let the ring go."""
        if self._held and event.button() == Qt.MouseButton.LeftButton:
            self._held = False
            self._store.end()
        else:
            super().mouseReleaseEvent(event)

    def _follow(self, point: QPointF) -> None:
        assert self.asked  # there is nothing to press before
        self._go(np.clip(self.from_pixels(point), -self.asked.edge, self.asked.edge))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Tell of another size."""
        super().resizeEvent(event)
        self.resized.emit()

    def _go(self, place: np.ndarray) -> None:
        assert self.asked  # there is nothing to press before
        x, y = self.asked.field_of(place)
        self._store.update(field_deg=round(y, 4), field_x_deg=round(x, 4))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Choose a picture with the arrow keys, starting at the present field, and go to its field with Enter."""
        points = np.array([(room.center().x(), room.center().y()) for room in map(self.room, self.tiles)])
        taken = self.choice.taken(event.key(), len(points))
        if event.key() == Qt.Key.Key_Escape and self._held:
            self._held = False
            self._store.cancel()
        elif taken is not None:
            self._take(taken)
        elif self.choice.moved(event.key(), points, self.present() if self.tiles else 0):
            self.update()
        else:
            super().keyPressEvent(event)

    def show_place(self, place: tuple[float, float]) -> None:
        """Mark the present field, from whose picture the keys choose."""
        if place != self.present_at:
            self.present_at = place
            self.choice.forget()
            self.update()

    def present(self) -> int:
        """Return the picture of the present field: of those equally far out the last taken, else the first."""
        assert self.asked  # whose pictures these are
        apart = np.hypot(*(self.fields_deg - self.asked.field_of(np.array(self.present_at))).T)
        least = apart.min() + SAME_DEG
        return self._taken if self._taken < len(apart) and apart[self._taken] < least else int(apart.argmin())

    def _take(self, number: int) -> None:
        self._taken = number
        self.choice.forget()
        self.update()
        self._go(self.places[number])

    def _paint_nodes(self, painter: QPainter) -> None:
        """Paint where coma (×) and astigmatism (+) vanish."""
        half = self.theme.px(NODE_PX)
        for name, *place in self.asked.nodes if self.asked else ():
            if self.asked and (np.abs(place) > self.asked.edge).any():
                continue
            x, y = (float(v) for v in self.to_pixels(*place))
            painter.setPen(QPen(QColor(getattr(self.theme, NODE_COLOURS[name])), 2.5 * self.theme.scale))
            for dx, dy in ((half, half), (half, -half)) if name == "coma" else ((half, 0), (0, half)):
                painter.drawLine(QPointF(x - dx, y - dy), QPointF(x + dx, y + dy))
        painter.setPen(QPen(QColor(self.theme.accent), 2 * self.theme.scale))

    def paint_over(self, painter: QPainter) -> None:
        """Paint the pictures, with frames around the present one and the one chosen by keys."""
        super().paint_over(painter)
        if self.tiles:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(self.theme.accent), 2 * self.theme.scale))
            self._paint_nodes(painter)
            if self.free:
                ring = self.theme.px(RING_PX)
                painter.drawEllipse(QPointF(*map(float, self.to_pixels(*self.present_at))), ring, ring)
            else:
                painter.drawRect(self.room(self.tiles[self.present()]))
        number = self.choice.number
        if self.hasFocus() and number is not None and number < len(self.tiles):
            paint_cursor(painter, self.room(self.tiles[number]))


NODE_PX, NODE_COLOURS = 6, {"coma": "chief", "astigmatism": "positive"}  # half a cross; a token of each


class FieldMapPanel:
    """A grid of PSFs that a worker fills from the axis outwards."""

    def __init__(self, store: Store):
        self.widget = Card("Field map", TIP)
        self.chart = MapChart(store)
        self.widget.set_body(self.chart)
        self.late = LateAnswers(self.widget, answer, self._paint, self.widget.set_readout)
        self.chart.resized.connect(self._ask)
        self.found: tuple[FieldMapRequest, np.ndarray] | None = None
        self._wanted: FieldMapRequest | None = None
        self._scale = "sqrt"

    def show(self, live: Live) -> None:
        """Mark the present field, and ask for the map when more than the field has changed."""
        self._wanted = live.views["field_map"].question
        self.chart.show_place(place_of(live.state, self._wanted.corner_slope))
        changed, self._scale = live.state.display.psf_scale != self._scale, live.state.display.psf_scale
        self._ask()
        if changed:
            self.late.again()

    def _ask(self) -> None:
        """Ask for the map as the room of the panel lies or stands."""
        if self._wanted:
            self.late.ask(replace(self._wanted, upright=self.chart.height() > self.chart.width()))

    def _paint(self, asked: FieldMapRequest, found: np.ndarray) -> str:
        self.found = asked, found
        where = asked.places
        (rows, columns), spacing = where.shape[:2], float(where[0, 1, 0] - where[0, 0, 0])
        edge = float(where[0, -1, 0]) + 0.55 * spacing
        top = float(where[0, 0, 1]) * rows / (rows - 1)
        self.chart.set_range((-edge, edge), (-top, top))
        at = [(row, column) for row in range(rows) for column in range(columns)]
        kept = [place for place in at if np.isfinite(found[place]).any()]
        self.chart.places = np.array([where[place] for place in kept]).reshape(-1, 2)
        self.chart.asked = asked
        self.chart.fields_deg = np.array([asked.field_of(where[place]) for place in kept]).reshape(-1, 2)
        shown = crop(found.reshape(-1, *found.shape[-2:]))
        tiles = (
            tile(found[place][shown, shown], float(where[place][0]), float(where[place][1]), self._scale)
            for place in kept
        )
        self.chart.show_tiles(tiles, spacing, rows)
        heads = (
            tr("at ({x}, {y}) of the corner: share of the peak", x=f"{x:.3g}", y=f"{y:.3g}")
            for x, y in (where[place] for place in kept)
        )
        self.chart.means(zip(heads, (found[place][shown, shown] for place in kept), strict=True), asked.window[1])
        corner, wide = float(degrees_from_slope(asked.corner_slope)), (shown.stop - shown.start) * asked.window[1]
        first = tr("corner {field}", field=f"{corner:.3g}°")
        marks = {"coma": tr("× no coma"), "astigmatism": tr("+ no astigmatism (third order)")}
        first = " · ".join([first, *(marks[name] for name in marks if name in {node[0] for node in asked.nodes})])
        return f"{first} · {tr('pictures {wide} µm wide, each over its own peak', wide=f'{wide:.3g}')}"

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
