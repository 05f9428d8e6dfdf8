"""A chart of small pictures at places in its data."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter

from p2sf.conventions import centred_axis
from p2sf_explorer.charts.chart import image_of
from p2sf_explorer.charts.plots import BRIGHTNESS, as_indices, colour_map_name, lookup
from p2sf_explorer.charts.reading import Reading, Samples, split_label, value_of, worded_both
from p2sf_explorer.compute.brightness import stretch
from p2sf_explorer.compute.finer import smooth
from p2sf_explorer.widgets.chart_card import NotedChart

LOCAL = ("x, µm", "y, µm")


@dataclass(frozen=True)
class Tile:
    """Indices of the PSF's colour map, rows downwards, centred at (x, y) of the data."""

    indices: np.ndarray
    x: float
    y: float


def tile(values: np.ndarray, x: float, y: float, scale: str, low: float = 0.0) -> Tile | None:
    """Return light ``low`` to 1, rows +y, on a brightness scale as a smooth tile; None where some is NaN.

    Where ``low`` is negative, differences are shown about zero.
    """
    if np.isnan(values).any():
        return None
    light = smooth(values)
    bright = stretch(light, scale) if low == 0 else np.sign(light) * stretch(np.abs(light), scale)
    return Tile(as_indices(bright, low, 1.0)[::-1], x, y)


class TilesChart(NotedChart):
    """Square pictures, ``side`` data units wide or, where that is less, as wide as the height has room for."""

    def __init__(self, bottom: str = "", left: str = "", framed: bool = True):
        super().__init__(bottom, left, framed=framed)
        self.tiles: tuple[Tile, ...] = ()
        self.side, self.rows = 1.0, 1.0
        self.colours = BRIGHTNESS

    def show_tiles(self, tiles: Iterable[Tile | None], side: float, rows: float = 1) -> None:
        """Show tiles, None where there is no light; each has ``side`` of the width and 1/``rows`` of the height."""
        self.tiles, self.side, self.rows = tuple(each for each in tiles if each), side, rows
        self.update()

    def means(self, pictures: Iterable[tuple[str, np.ndarray]], pixel_um: float) -> None:
        """Set what is copied: (head, (y, x) values) of each picture, and the width of a pixel, µm."""
        lit = ((head, values) for head, values in pictures if np.isfinite(values).any())
        axes = ((head, centred_axis(len(values), pixel_um), values) for head, values in lit)
        self.grids = tuple((f"{head}: y, µm \\ x, µm", at, at, values) for head, at, values in axes)

    def side_px(self) -> float:
        """Return the side of a picture in pixels."""
        tall = self.magnification()[1] * self.area.height() / self.rows - 3
        return float(max(4.0, min(0.94 * self.side / self.per_pixel(), tall)))

    def room(self, each: Tile) -> QRectF:
        """Return the rectangle of a tile in pixels."""
        x, y = (float(v) for v in self.to_pixels(each.x, each.y))
        side = self.side_px()
        return QRectF(x - side / 2, y - side / 2, side, side)

    def tile_at(self, point: QPointF) -> int | None:
        """Return the number of the tile under a point."""
        return next((k for k, each in enumerate(self.tiles) if self.room(each).contains(point)), None)

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the sample of the picture at a place, with its place within the picture."""
        point = QPointF(*(float(v) for v in self.to_pixels(x, y)))
        number = self.tile_at(point)
        if number is None or number >= len(self.grids):
            return None
        (head, at, _, values), room = self.grids[number], self.room(self.tiles[number])
        title, _, quantity = head.partition(": y, µm")[0].rpartition(": ")
        count = len(values)
        inside = Samples(values, (room.left(), room.bottom(), room.width(), -room.height()), quantity)
        row, column = inside.nearest(point.x(), point.y()) or (count // 2, count // 2)
        place = self.from_pixels(QPointF(*inside.centre(row, column)))
        local = worded_both((float(at[column]), float(at[row])), LOCAL)
        value = value_of(split_label(quantity)[0], float(values[row, column]), quantity, mark=place)
        return Reading(*place, f"{title}: {local}", (value,), "")

    def paint_over(self, painter: QPainter) -> None:
        """Paint the pictures, then lines and text."""
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.setPen(Qt.PenStyle.NoPen)
        table = lookup(colour_map_name(self.colours, self.theme))
        for each in self.tiles:
            pixels = np.ascontiguousarray(table[each.indices])
            painter.drawImage(self.room(each), image_of(pixels))
        super().paint_over(painter)
