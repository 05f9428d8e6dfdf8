"""The wavefront as a surface that the mouse and the arrow keys turn."""

from dataclasses import dataclass
from functools import lru_cache
from math import floor, isfinite, nan
from typing import Any

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QAccessible, QColor, QImage, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf_explorer.charts.chart import image_of
from p2sf_explorer.charts.painting import pen, polygon, width_of, write
from p2sf_explorer.charts.plots import EMPTY, as_indices, lookup
from p2sf_explorer.charts.reading import format_number
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.camera import SceneCamera, turn_camera

HEIGHT = 0.6  # pupil radii that the value at the colour bar's end rises
HALF = 1.2  # pupil radii from the middle of the picture to its edge
GRID, LINE = 0.25, 0.012  # pupil radii between two grid lines, and half a line's thickness
LIT, SLOPE, DARKEST = 0.82, 0.35, 0.45  # brightness of a level surface, what a slope of one adds, the least
UNDERSIDE, ON_LINE = 0.72, 0.62  # relative brightness of the underside and of the grid lines


@dataclass(frozen=True)
class Viewpoint:
    """Direction of view in degrees (0 and 90 show ξ to the right and η up), and the pixels across the picture."""

    turn_deg: float
    tilt_deg: float
    count: int


@dataclass(frozen=True)
class SurfacePicture:
    """What the pixels show, (count, count), rows upwards: W in waves, NaN for nothing; brightness 0 to 1."""

    waves: np.ndarray
    light: np.ndarray


@dataclass(frozen=True)
class SurfaceGrid:
    """Slices of the surface from front to back, (slices, columns), as the picture's columns cut it.

    ``samples``, ``weights``: the four map samples around each place and their weights, (4, …); ``lines``: whether a
    grid line is there; ``nearest``: the slice itself where W is known, else the last known one before it, else the
    first; ``met``: the columns with any W; ``depth``: distance behind the pupil's middle, in pupil radii.
    """

    samples: np.ndarray
    weights: np.ndarray
    lines: np.ndarray
    nearest: np.ndarray
    met: np.ndarray
    depth: np.ndarray


def surface_picture(waves: np.ndarray, limit: float, view: Viewpoint) -> SurfacePicture:
    """Return the picture of W over the pupil, (n, n), NaN where there is none; ``limit`` waves are `HEIGHT` high."""
    known, tilt = np.isfinite(waves), np.deg2rad(view.tilt_deg)
    grid = slice_map(known.tobytes(), len(waves), view)
    height = (grid.weights * np.where(known, waves, 0.0).ravel()[grid.samples]).sum(axis=0)
    level = grid.depth * np.sin(tilt) + height * (HEIGHT / limit * np.cos(tilt))
    slices, under = first_seen(np.take_along_axis(level, grid.nearest, 0), view.count)
    seen = (slices < len(level)) & grid.met[:, None]
    place = np.take_along_axis(grid.nearest, np.minimum(slices, len(level) - 1).T, 0), np.arange(view.count)
    light = np.where(under.T, UNDERSIDE, 1.0) * light_up(height * (HEIGHT / limit), grid)[place]
    return SurfacePicture(np.where(seen.T, height[place], np.nan), light)


def first_seen(level: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return for each pixel, (columns, rows), the first slice that crosses its height, and whether downwards.

    ``level``: heights of the slices from the front, (slices, columns), in pupil radii. Where none crosses, the number
    of slices.
    """
    first = (count + 1) * np.arange(level.shape[1])
    passed = []
    for extreme in (np.maximum, np.minimum):
        row = np.ceil((extreme.accumulate(level, 0) + HALF) * (count / 2 / HALF) - 0.5)  # the lowest pixel not below
        place = np.clip(row, 0, count).astype(np.intp) + first
        counted = np.bincount(place.ravel(), minlength=first.size * (count + 1)).reshape(-1, count + 1)
        passed.append(np.cumsum(counted, axis=1)[:, :count])
    above = len(level) - passed[1]  # slices that have not yet fallen to this pixel
    return passed[0] + above, above > 0


def light_up(height: np.ndarray, grid: SurfaceGrid) -> np.ndarray:
    """Return the brightness of the surface: more where it faces front and left, less on the grid lines."""
    step, column = np.maximum(grid.depth[1] - grid.depth[0], 1e-6), 2 * HALF / height.shape[1]
    back = np.gradient(height, axis=0) / step
    right = (np.gradient(height, axis=1) - back * np.gradient(grid.depth, axis=1)) / column  # at the same depth
    light = np.clip(LIT + SLOPE * (back + right) / np.sqrt(1 + back**2 + right**2), DARKEST, 1.0)
    return np.where(grid.lines, ON_LINE * light, light)


@lru_cache(maxsize=4)
def slice_map(known: bytes, count: int, view: Viewpoint) -> SurfaceGrid:
    """Return the slices over a map of ``count``² samples; ``known``: the bytes of which of them have a value."""
    across = (np.arange(view.count) + 0.5) * 2 * HALF / view.count - HALF
    rim, turn = np.sqrt(np.maximum(0.0, 1 - across**2)), np.deg2rad(view.turn_deg)
    depth = np.linspace(-1, 1, view.count // 2 + 1)[:, None] * rim  # each column from rim to rim
    xi = across * np.cos(turn) - depth * np.sin(turn)
    eta = across * np.sin(turn) + depth * np.cos(turn)
    samples, weights = neighbours(xi, eta, count)
    weights = weights * np.frombuffer(known, bool)[samples]
    total = weights.sum(axis=0)
    at_rim = (xi**2 + eta**2 > (1 - 2 / count) ** 2) & (total > 0)  # beyond the rim no neighbour is known
    found = (at_rim | (total > 0.5)) & (rim > 0)
    weights = np.divide(weights, total, out=np.zeros_like(weights), where=found)
    number = np.arange(len(depth))[:, None]
    nearest = np.maximum(np.maximum.accumulate(np.where(found, number, -1), axis=0), found.argmax(axis=0))
    off_line = np.minimum(*(np.abs((v / GRID + 0.5) % 1 - 0.5) for v in (xi, eta))) * GRID
    lines = off_line < max(LINE, 1 / view.count)
    return SurfaceGrid(samples, weights, lines, nearest, found.any(axis=0), depth)


def neighbours(xi: np.ndarray, eta: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the four samples around each place of a map of ``count``², and bilinear weights, (4, …) each."""
    places = [np.clip((v + 1) * count / 2 - 0.5, 0, count - 1.001) for v in (eta, xi)]
    (row, column), (up, right) = ([p.astype(int) for p in places], [p % 1 for p in places])
    both = [(j, i) for j in (0, 1) for i in (0, 1)]
    weights = [(up if j else 1 - up) * (right if i else 1 - right) for j, i in both]
    return np.array([(row + j) * count + column + i for j, i in both]), np.array(weights)


COUNTS = {"preview": 128, "settled": 256}
SHADES = 24
TURN_DEG = 5.0
KEYS = Qt.Key
TURNS: dict[int, tuple[float, float]] = {
    KEYS.Key_Left: (-TURN_DEG, 0.0),
    KEYS.Key_Right: (TURN_DEG, 0.0),
    KEYS.Key_Up: (0.0, TURN_DEG),
    KEYS.Key_Down: (0.0, -TURN_DEG),
}
DEG_PER_PX = 0.5
ZOOM, MOST_ZOOM = 1.25, 8.0
FIRST = SceneCamera(-30.0, 35.0)  # ξ to the right, η away from the camera
AWAY = 1.12  # pupil radii from the middle to an axis's name
AXES = (("ξ", (1.0, 0.0)), ("η", (0.0, 1.0)))


class SurfaceView(QWidget):
    """Drag or arrow keys turn the surface, a double-click or Home turns it back; ``turned(turn, tilt)`` in degrees."""

    accessible_role = QAccessible.Role.Graphic
    turned = Signal(float, float)
    taken, released = Signal(), Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(120, 90)
        self.setAccessibleName(tr("The wavefront as a surface; drag it or use the arrow keys to turn it"))
        self.setToolTip(tr("Drag or use the arrow keys to turn the surface; a double-click goes back"))
        self._theme, self._map, self.camera = LIGHT, "CET-D1A", FIRST
        self.pixels = np.zeros((1, 1), np.uint32)
        self._held: tuple[QPointF, SceneCamera] | None = None
        self.waves = np.full((1, 1), np.nan)  # of the pixels, rows upwards
        self.zoom = 1.0
        self.at: QPointF | None = None  # the pointer
        self.setMouseTracking(True)

    def show_waves(self, waves: np.ndarray, limit: float, quality: str, camera: SceneCamera) -> None:
        """Show W in waves over the pupil; ``limit`` waves are the colour bar's end."""
        self.camera = camera
        seen = surface_picture(waves, limit, Viewpoint(camera.turn, camera.tilt, COUNTS[quality]))
        self.waves = seen.waves
        shade = (seen.light * (SHADES - 1)).astype(np.intp)
        self.pixels = shade_map(self._map)[shade, as_indices(seen.waves, -limit, limit)][::-1].copy()
        self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def to_pixels(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Return the widget's pixels of places in the picture, in pupil radii from its middle."""
        side = self.zoom * min(self.width(), self.height()) / (2 * HALF)
        return self.width() / 2 + side * x, self.height() / 2 - side * y

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the pupil's plane, the surface above and below it, and the focus frame."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_plane(painter)
        (left, right), (bottom, top) = self.to_pixels(np.array([-HALF, HALF]), np.array([-HALF, HALF]))
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        image = image_of(self.pixels, QImage.Format.Format_ARGB32)
        painter.drawImage(QRectF(left, top, right - left, bottom - top), image)
        self._paint_names(painter)
        self._paint_value(painter)
        if self.hasFocus():
            painter.setPen(QPen(QColor(self._theme.accent), 1))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))

    def _paint_plane(self, painter: QPainter) -> None:
        """Paint the pupil's rim at W = 0 and the two axes, which the surface may hide."""
        turn = np.linspace(0, 2 * np.pi, 73)
        painter.setPen(pen(self._theme.line))
        painter.drawPolyline(polygon(*self.to_pixels(*self._level(np.cos(turn), np.sin(turn)))))
        ends = np.array([-1.0, 1.0])
        for _, (xi, eta) in AXES:
            painter.drawPolyline(polygon(*self.to_pixels(*self._level(xi * ends, eta * ends))))

    def _paint_names(self, painter: QPainter) -> None:
        """Paint the axes' names at their ends, over the surface, which might hide them."""
        painter.setPen(pen(self._theme.text))
        for name, (xi, eta) in AXES:
            x, y = self.to_pixels(*self._level(AWAY * xi, AWAY * eta))
            px = self._theme.px
            write(painter, QRectF(x - px(20), y - px(8), 2 * px(20), px(16)), name, 0, self._theme.tick)

    def value_at(self, point: QPointF) -> float:
        """Return W in waves of the surface under a pixel; NaN where there is none."""
        middle, side = QPointF(self.width() / 2, self.height() / 2), self.to_pixels(1.0, 0.0)[0] - self.width() / 2
        across, up = (point.x() - middle.x()) / side, (middle.y() - point.y()) / side
        rows = len(self.waves)
        row, column = (floor((v / (2 * HALF) + 0.5) * rows) for v in (up, across))
        return float(self.waves[row, column]) if 0 <= row < rows and 0 <= column < rows else nan

    def _paint_value(self, painter: QPainter) -> None:
        """Paint the value of the surface under the pointer, above it."""
        if self.at is None or not isfinite(value := self.value_at(self.at)):
            return
        words, theme = f"W {format_number(value)} λ", self._theme
        wide, tall = width_of(words, theme.label) + theme.px(10), float(theme.px(20))
        left = min(max(0.0, self.at.x() - wide / 2), self.width() - wide)
        above = self.at.y() - tall - 12
        room = QRectF(left, above if above > 0 else self.at.y() + 12, wide, tall)
        painter.fillRect(room, QColor(theme.raised))
        painter.setPen(QColor(theme.text))
        write(painter, room, words, 0, theme.label)
        painter.drawEllipse(self.at, 3, 3)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Enlarge the picture, or show more of it."""
        self.zoom = min(MOST_ZOOM, max(1.0, self.zoom * ZOOM ** (event.angleDelta().y() / 120)))
        event.accept()
        self.update()

    def leaveEvent(self, event: QEvent) -> None:
        """Read nothing any more."""
        self.at = None
        self.update()

    def _level(self, xi: Any, eta: Any) -> tuple[Any, Any]:
        """Return the projection of points of the plane W = 0, in pupil radii from the picture's middle."""
        turn, tilt = np.deg2rad(self.camera.turn), np.deg2rad(self.camera.tilt)
        return xi * np.cos(turn) + eta * np.sin(turn), np.sin(tilt) * (eta * np.cos(turn) - xi * np.sin(turn))

    def _turn(self, camera: SceneCamera) -> None:
        self.turned.emit(camera.turn, max(0.0, camera.tilt))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Start dragging."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._held = event.position(), self.camera
            self.taken.emit()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Turn it while held; say the value under the pointer."""
        self.at = None if self._held else event.position()
        self.update()
        if self._held:
            start, camera = self._held
            moved = event.position() - start
            self._turn(turn_camera(camera, -DEG_PER_PX * moved.x(), DEG_PER_PX * moved.y()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Stop dragging."""
        if self._held:
            self._held = None
            self.released.emit()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Turn back to the first view."""
        self.zoom = 1.0
        self._turn(FIRST)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Turn with the arrows, turn back with Home."""
        if event.key() in TURNS:
            self._turn(turn_camera(self.camera, *TURNS[event.key()]))
        elif event.key() == KEYS.Key_Home:
            self.zoom = 1.0
            self._turn(FIRST)
        elif event.key() in (KEYS.Key_Plus, KEYS.Key_Equal, KEYS.Key_Minus):
            self.zoom = min(MOST_ZOOM, max(1.0, self.zoom * (1 / ZOOM if event.key() == KEYS.Key_Minus else ZOOM)))
            self.update()
        else:
            super().keyPressEvent(event)


@lru_cache(maxsize=4)
def shade_map(name: str) -> np.ndarray:
    """Return a colour map in `SHADES` brightnesses, (shade, index) of 0xAARRGGBB; no value is transparent."""
    colours = lookup(name)[None]
    light = np.arange(SHADES)[:, None] / (SHADES - 1)
    parts = [((colours >> shift & 255) * light).astype(np.uint32) << shift for shift in (0, 8, 16)]
    table = np.uint32(0xFF000000) | parts[0] | parts[1] | parts[2]
    table[:, EMPTY] = 0
    return table
