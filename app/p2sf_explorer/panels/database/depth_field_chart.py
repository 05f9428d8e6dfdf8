"""Charts over depth and field on which the source can be set: a map with its nodes, an atlas of PSFs."""

from dataclasses import replace
from math import ceil, inf

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPen

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.cursor import Cursor, paint_cursor
from p2sf_explorer.charts.plots import EMPTY, ColourBar, as_indices, lookup
from p2sf_explorer.charts.reading import Reading, Samples, worded_both
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.finer import smooth
from p2sf_explorer.compute.framing import crop
from p2sf_explorer.compute.views.database import Atlas, closest, nearest
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import short_distance

PER_METRE = 1000.0
ATLAS_MAP = "inferno"


Ends = tuple[tuple[float, float], tuple[float, float]]


class DepthFieldMap(Chart):
    """A map over 1/depth and field with its nodes and the present point; ``picked(depth_mm, field_deg)`` by a drag."""

    picked = Signal(float, float)
    taken = Signal()
    released = Signal()

    def __init__(self, bar: ColourBar) -> None:
        super().__init__("1/depth, 1/m (0 is ∞)", "field, °")
        self.takes_arrows = True
        self.bar = self.colours = bar
        self.point: tuple[float, float] | None = None
        self.nodes: tuple[np.ndarray, np.ndarray] = (np.array([]), np.array([]))
        self.choice = Cursor()
        self.setAccessibleName(tr("Map over depth and field"))
        self.ends: Ends = ((0.0, 1.0), (0.0, 1.0))
        self._shown: tuple[np.ndarray, ColourScale, Ends, tuple[np.ndarray, np.ndarray]] | None = None
        bar.turned.connect(self._again)

    def show_map(
        self, values: np.ndarray, scale: ColourScale, ends: Ends, nodes: tuple[np.ndarray, np.ndarray]
    ) -> None:
        """Show values, rows +field, between ``ends`` of 1/depth in 1/m and of field in degrees."""
        self._shown, self.ends, self.nodes = (values, scale, ends, nodes), ends, nodes
        (left, right), (low, high) = ends
        rows, columns = values.shape
        wide, tall = (right - left) / (columns - 1), (high - low) / (rows - 1)
        used, _ = self.colours.settled(scale)
        table = lookup(scale.name).copy()
        table[EMPTY] = QColor(self.theme.faint).rgb()
        self.set_range((left - wide, right + wide), (low - tall, high + tall))
        rect = (left - wide / 2, low - tall / 2, columns * wide, rows * tall)
        self.show_pixels(table[as_indices(used.parts(values), 0.0, 1.0)], rect, Samples(values, rect, scale.quantity))

    def _again(self) -> None:
        if self._shown:
            self.show_map(*self._shown)

    def takes(self, point: QPointF) -> bool:
        """Return whether a press sets the source."""
        return True

    def show_point(self, depth_mm: float, field_deg: float) -> None:
        """Mark the present source; the keys choose from there on."""
        point = (PER_METRE / depth_mm, abs(field_deg))
        if point != self.point:
            self.point = point
            self.choice.forget()
            self.update()

    def paint_over(self, painter: QPainter) -> None:
        """Paint the nodes as dots and the present point as a ring."""
        painter.setPen(QPen(QColor(0, 0, 0, 90), 1.5 * self.theme.scale))
        x, y = self.to_pixels(*self.nodes)
        painter.drawPoints([QPointF(a, b) for b in y.tolist() for a in x.tolist()])
        if self.point:
            centre = QPointF(*(float(v) for v in self.to_pixels(*self.point)))
            for colour, width in (("#ffffff", 4.0), ("#000000", 1.6)):
                painter.setPen(QPen(QColor(colour), width * self.theme.scale))
                painter.drawEllipse(centre, 5.0 * self.theme.scale, 5.0 * self.theme.scale)
        if self.hasFocus() and self.choice.number is not None:
            self._paint_cursor(painter, self.choice.number)

    def _paint_cursor(self, painter: QPainter, number: int) -> None:
        places = self._places()
        if number < len(places):
            x, y = places[number]
            paint_cursor(painter, QRectF(x - 7, y - 7, 14, 14))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the source."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.taken.emit()
            self._pick(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Carry it along."""
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._pick(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        self.released.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Choose a node with the arrow keys, and set the source there with Enter."""
        points = self._places()
        taken = self.choice.taken(event.key(), len(points))
        if taken is not None:
            self._pick(QPointF(*points[taken]))
        elif self.choice.moved(event.key(), points, self._nearest(points)):
            self.update()
        else:
            super().keyPressEvent(event)

    def _places(self) -> np.ndarray:
        x, y = self.to_pixels(*self.nodes)
        return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)

    def _nearest(self, points: np.ndarray) -> int:
        if self.point is None or not len(points):
            return 0
        return int(np.hypot(*(points - np.array(self.to_pixels(*self.point), float)).T).argmin())

    def _pick(self, place: QPointF) -> None:
        (left, right), (low, high) = self.ends
        near, angle = self.from_pixels(place)
        near, angle = min(right, max(left, near)), min(high, max(low, angle))
        self.picked.emit(PER_METRE / near if near > 1e-9 * right else inf, angle)


class AtlasView(Chart):
    """PSFs in a grid, depth to the right and field upwards; a click, a drag or the arrow keys choose a cell.

    A cell is one wide and one high in the chart's data, the first one from −½ to ½.
    """

    picked = Signal(float, float)
    taken = Signal()
    released = Signal()

    def __init__(self) -> None:
        super().__init__("depth", "", aspect=True)
        self.takes_arrows = True
        self.bottom_tick_maker, self.left_tick_maker = self._depth_ticks, self._field_ticks
        self.setAccessibleName(tr("Atlas of PSFs over depth and field"))
        self.setMinimumSize(150, 90)
        self.atlas: Atlas | None = None  # as much of each picture as is shown
        self._whole: Atlas | None = None
        self.cell: tuple[int, int] | None = None
        self._source = (inf, 0.0)

    def show_atlas(self, atlas: Atlas | None) -> None:
        """Show the light of an atlas, or an empty field."""
        self.atlas = self._whole = atlas
        if atlas:
            fields, depths, size, _ = atlas.psfs.shape
            shown = crop(atlas.psfs.reshape(-1, size, size))
            self.atlas = atlas = replace(atlas, psfs=atlas.psfs[..., shown, shown])
            mosaic, painted = mosaic_of(atlas.psfs), mosaic_of(smooth_cells(atlas.psfs))
            rect = (-0.5, -0.5, float(depths), float(fields))
            table = lookup(ATLAS_MAP).copy()
            table[EMPTY] = QColor(self.theme.faint).rgb()
            self.set_range((-0.5, depths - 0.5), (-0.5, fields - 0.5))
            samples = Samples(mosaic, rect, tr("PSF, peak = 1"))
            self.show_pixels(table[as_indices(np.sqrt(painted), 0.0, 1.0)], rect, samples)
        self.show_point(*self._source)
        self.forget_background()

    def show_point(self, depth_mm: float, field_deg: float) -> None:
        """Frame the cell nearest to the present source, none when it is off the atlas."""
        self._source = depth_mm, field_deg
        cell = nearest(self.atlas, depth_mm, abs(field_deg)) if self.atlas else None
        if cell != self.cell:
            self.cell = cell
            self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        super().restyle(theme)
        self.show_atlas(self._whole)

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the sample at a place, with its depth, its field and its place on the sensor."""
        found = super().read(x, y, snap)
        if found is None or self.atlas is None or self.samples is None:
            return None
        row, column = (
            round(v) for v in (found.y, found.x)
        )  # of the sample: the pointer may be on the edge of its cell
        size, pitch = self.atlas.psfs.shape[-1], self.atlas.pixel_um
        middle = pitch * (1 - size % 2) / 2  # sample N//2 is the chief ray's, half a sample beside the cell's middle
        inside = [round((v - cell) * size * pitch - middle, 9) for v, cell in ((found.x, column), (found.y, row))]
        depth, angle = short_distance(float(self.atlas.depths_mm[column])), f"{self.atlas.fields_deg[row]:.3g}°"
        place = worded_both(inside, ("x, µm", "y, µm"))
        return replace(found, head=f"{depth}, {angle}: {place}")

    def _depth_ticks(self, low: float, high: float, most: float) -> list[tuple[float, str]]:
        every = ceil((high - low) / max(1.0, most))
        depths = self.atlas.depths_mm[::every] if self.atlas else ()
        return [(float(k * every), short_distance(float(depth))) for k, depth in enumerate(depths)]

    def _field_ticks(self, low: float, high: float, most: float) -> list[tuple[float, str]]:
        return [(float(k), f"{angle:.3g}°") for k, angle in enumerate(self.atlas.fields_deg)] if self.atlas else []

    def _shape(self) -> tuple[int, int]:
        """Return the numbers of fields and of depths."""
        return (len(self.atlas.fields_deg), len(self.atlas.depths_mm)) if self.atlas else (1, 1)

    def cell_rect(self, row: int, column: int) -> QRectF:
        """Return the rectangle of the PSF of a field (row) and a depth (column)."""
        (left, top), (right, bottom) = self.to_pixels(column - 0.5, row + 0.5), self.to_pixels(column + 0.5, row - 0.5)
        return QRectF(left, top, right - left, bottom - top)

    def paint_over(self, painter: QPainter) -> None:
        """Paint the frame of the present cell."""
        if self.cell:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor("#ffffff"), 2 * self.theme.scale))
            painter.drawRect(self.cell_rect(*self.cell))

    def takes(self, point: QPointF) -> bool:
        """Return whether a press chooses a cell."""
        return self.area.contains(point)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Set the source to the cell under the pointer."""
        if event.button() == Qt.MouseButton.LeftButton and self.takes(event.position()):
            self.taken.emit()
            self._pick(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Follow the pointer from cell to cell."""
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._pick(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        self.released.emit()

    def _pick(self, place: QPointF) -> None:
        column, row = self.from_pixels(place)
        self._choose(round(row), round(column))

    def _choose(self, row: int, column: int) -> None:
        if self.atlas:
            fields, depths = self._shape()
            row, column = min(fields - 1, max(0, row)), min(depths - 1, max(0, column))
            self.picked.emit(float(self.atlas.depths_mm[column]), float(self.atlas.fields_deg[row]))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move to a neighbour of the source's cell, also where the source lies outside."""
        step = STEPS.get(event.key())
        if step and self.atlas:
            row, column = closest(self.atlas, self._source[0], abs(self._source[1]))
            self._choose(row + step[0], column + step[1])
        else:
            super().keyPressEvent(event)


STEPS: dict[int, tuple[int, int]] = {
    Qt.Key.Key_Up: (1, 0),
    Qt.Key.Key_Down: (-1, 0),
    Qt.Key.Key_Left: (0, -1),
    Qt.Key.Key_Right: (0, 1),
}


def mosaic_of(cells: np.ndarray) -> np.ndarray:
    """Return pictures, (rows, columns, n, n), side by side."""
    rows, columns, size, _ = cells.shape
    return cells.transpose(0, 2, 1, 3).reshape(rows * size, columns * size)


def smooth_cells(cells: np.ndarray) -> np.ndarray:
    """Return pictures, (rows, columns, n, n), on finer samples."""
    return np.array([[smooth(cell) for cell in row] for row in cells])
