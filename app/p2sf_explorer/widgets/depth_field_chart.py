"""Charts over depth and field on which the source can be set: a map with its nodes, an atlas of PSFs."""

from math import ceil, inf

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from p2sf_explorer.charts.chart import Chart, image_of
from p2sf_explorer.charts.cursor import Cursor, paint_cursor
from p2sf_explorer.charts.plots import as_indices, lookup, small_font
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.results.database import Atlas, closest, nearest
from p2sf_explorer.state.scales import short_distance

PER_METRE = 1000.0
ATLAS_MAP = "inferno"
LABEL_PX = 54.0  # the width of a depth's label, with a margin


Ends = tuple[tuple[float, float], tuple[float, float]]


class DepthFieldMap(Chart):
    """A map over 1/depth and field with its nodes and the present point; ``picked(depth_mm, field_deg)`` by a drag."""

    picked = Signal(float, float)
    taken = Signal()
    released = Signal()

    def __init__(self) -> None:
        super().__init__("1/depth, 1/m (0 is ∞)", "field, °")
        self.point: tuple[float, float] | None = None
        self.nodes: tuple[np.ndarray, np.ndarray] = (np.array([]), np.array([]))
        self.choice = Cursor()
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Map over depth and field"))
        self.ends: Ends = ((0.0, 1.0), (0.0, 1.0))

    def show_map(self, indices: np.ndarray, name: str, ends: Ends, nodes: tuple[np.ndarray, np.ndarray]) -> None:
        """Show colour indices, rows +field, between ``ends`` of 1/depth in 1/m and of field in degrees."""
        self.ends, self.nodes = ends, nodes
        (left, right), (low, high) = ends
        rows, columns = indices.shape
        wide, tall = (right - left) / (columns - 1), (high - low) / (rows - 1)
        table = lookup(name).copy()
        table[255] = QColor(self.theme.faint).rgb()
        self.set_range((left - wide, right + wide), (low - tall, high + tall))
        self.show_pixels(table[indices], (left - wide / 2, low - tall / 2, columns * wide, rows * tall))

    def show_point(self, depth_mm: float, field_deg: float) -> None:
        """Mark the present source; the keys choose from there on."""
        point = (PER_METRE / depth_mm, abs(field_deg))
        if point != self.point:
            self.point = point
            self.choice.forget()
            self.update()

    def paint_over(self, painter: QPainter) -> None:
        """Paint the nodes as dots and the present point as a ring."""
        painter.setPen(QPen(QColor(0, 0, 0, 90), 1.5))
        x, y = self.to_pixels(*self.nodes)
        painter.drawPoints([QPointF(a, b) for b in y.tolist() for a in x.tolist()])
        if self.point:
            centre = QPointF(*(float(v) for v in self.to_pixels(*self.point)))
            for colour, width in (("#ffffff", 4.0), ("#000000", 1.6)):
                painter.setPen(QPen(QColor(colour), width))
                painter.drawEllipse(centre, 5.0, 5.0)
        if self.hasFocus() and self.choice.number is not None:
            self._paint_cursor(painter, self.choice.number)

    def _paint_cursor(self, painter: QPainter, number: int) -> None:
        places = self._places()
        if number < len(places):
            x, y = places[number]
            paint_cursor(painter, QRectF(x - 7, y - 7, 14, 14))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the source."""
        self.taken.emit()
        self._pick(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Carry it along."""
        if event.buttons():
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


class AtlasView(QWidget):
    """PSFs in a grid, depth to the right and field upwards; a click, a drag or the arrow keys choose a cell."""

    picked = Signal(float, float)
    taken = Signal()
    released = Signal()
    LEFT, BOTTOM = 42.0, 17.0  # pixels for the labels

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Atlas of PSFs over depth and field"))
        self.setMinimumSize(150, 90)
        self.atlas: Atlas | None = None
        self.cell: tuple[int, int] | None = None
        self._theme, self._source = LIGHT, (inf, 0.0)
        self._indices = np.zeros((1, 1), np.uint8)
        self._colour()

    def sizeHint(self) -> QSize:
        """Return a size that shows the PSFs."""
        return QSize(340, 150)

    def show_atlas(self, atlas: Atlas | None) -> None:
        """Show an atlas, or an empty field."""
        self.atlas = atlas
        if atlas:
            fields, depths, size, _ = atlas.psfs.shape
            mosaic = atlas.psfs[::-1, :, ::-1].transpose(0, 2, 1, 3).reshape(fields * size, depths * size)
            self._indices = as_indices(np.sqrt(mosaic), 0.0, 1.0)
            self._colour()
        self.show_point(*self._source)
        self.update()

    def show_point(self, depth_mm: float, field_deg: float) -> None:
        """Frame the cell nearest to the present source, none when it is off the atlas."""
        self._source = depth_mm, field_deg
        cell = nearest(self.atlas, depth_mm, abs(field_deg)) if self.atlas else None
        if cell != self.cell:
            self.cell = cell
            self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self._colour()
        self.update()

    def _colour(self) -> None:
        table = lookup(ATLAS_MAP).copy()
        table[255] = QColor(self._theme.faint).rgb()
        self._pixels = np.ascontiguousarray(table[self._indices])

    def area(self) -> QRectF:
        """Return the rectangle of the cells: square ones, as large as fit."""
        fields, depths = self._shape()
        side = min((self.width() - self.LEFT - 4) / depths, (self.height() - self.BOTTOM - 2) / fields)
        return QRectF(self.LEFT, 1, side * depths, side * fields)

    def _shape(self) -> tuple[int, int]:
        """Return the numbers of fields and of depths."""
        return (len(self.atlas.fields_deg), len(self.atlas.depths_mm)) if self.atlas else (1, 1)

    def cell_rect(self, row: int, column: int) -> QRectF:
        """Return the rectangle of the PSF of a field (row) and a depth (column)."""
        area, (fields, depths) = self.area(), self._shape()
        side = area.width() / depths
        return QRectF(area.left() + column * side, area.top() + (fields - 1 - row) * side, side, side)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint PSFs, labels and the frame of the present cell."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        if not self.atlas:
            return
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(self.area(), image_of(self._pixels))
        self._paint_labels(painter, self.atlas)
        if self.cell:
            painter.setPen(QPen(QColor("#ffffff"), 2))
            painter.drawRect(self.cell_rect(*self.cell))

    def _paint_labels(self, painter: QPainter, atlas: Atlas) -> None:
        painter.setFont(small_font())
        painter.setPen(QColor(self._theme.muted))
        centre, right = Qt.AlignmentFlag.AlignHCenter, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for row, angle in enumerate(atlas.fields_deg):
            cell = self.cell_rect(row, 0)
            painter.drawText(QRectF(0, cell.top(), self.LEFT - 5, cell.height()), right, local(f"{angle:.3g}°"))
        every = ceil(LABEL_PX / max(1.0, self.cell_rect(0, 0).width()))
        for column in range(0, len(atlas.depths_mm), every):
            cell = self.cell_rect(0, column).adjusted(-30, 0, 30, 0)
            words = short_distance(float(atlas.depths_mm[column]))
            painter.drawText(QRectF(cell.left(), cell.bottom() + 2, cell.width(), 15), centre, local(words))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Set the source to the cell under the pointer."""
        self.taken.emit()
        self._pick(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Follow the pointer from cell to cell."""
        if event.buttons():
            self._pick(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        self.released.emit()

    def _pick(self, place: QPointF) -> None:
        if self.atlas:
            area, (fields, depths) = self.area(), self._shape()
            column = int((place.x() - area.left()) / area.width() * depths)
            row = fields - 1 - int((place.y() - area.top()) / area.height() * fields)
            self._choose(row, column)

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
