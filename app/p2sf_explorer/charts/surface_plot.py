"""The wavefront as a surface that the mouse and the arrow keys turn."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QImage, QPainter, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf_explorer.charts.painting import pen, polygon, write
from p2sf_explorer.charts.plots import EMPTY, as_indices, lookup
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.camera import Camera, turned

HEIGHT = 0.6  # pupil radii that stand for the colour bar's end
HALF = 1.2  # pupil radii from the middle of the picture to its edge
MESH, LINE = 0.25, 0.012  # pupil radii between two lines of the net, and half a line's thickness
LIT, SLOPE, DARKEST = 0.82, 0.35, 0.45  # brightness of level ground, what a slope of one adds, the least
UNDER, NET = 0.72, 0.62  # brightness of the under side and of the net, of what would be there otherwise


@dataclass(frozen=True)
class Viewpoint:
    """Where the eye stands, degrees (0 and 90 see ξ to the right and η up), and the picture's pixels across."""

    turn_deg: float
    tilt_deg: float
    count: int


@dataclass(frozen=True)
class SurfacePicture:
    """What the pixels of a picture show, (count, count), rows upwards: W in waves, NaN for nothing; brightness to 1."""

    waves: np.ndarray
    light: np.ndarray


@dataclass(frozen=True)
class SurfaceGrid:
    """The slices from the front, (slices, columns): four map samples and weights for each place (4, …), the net.

    ``nearest``: a place's slice where W is known, else the last one before it, else the first; ``met``: the columns
    with any; ``depth``: how far behind the pupil's middle, in pupil radii.
    """

    samples: np.ndarray
    weights: np.ndarray
    net: np.ndarray
    nearest: np.ndarray
    met: np.ndarray
    depth: np.ndarray


def surface_picture(waves: np.ndarray, limit: float, view: Viewpoint) -> SurfacePicture:
    """Return the picture of W over the pupil, (n, n), NaN where there is none; ``limit`` waves stand `HEIGHT` high."""
    known, tilt = np.isfinite(waves), np.deg2rad(view.tilt_deg)
    grid = placed(known.tobytes(), len(waves), view)
    height = (grid.weights * np.where(known, waves, 0.0).ravel()[grid.samples]).sum(axis=0)
    level = grid.depth * np.sin(tilt) + height * (HEIGHT / limit * np.cos(tilt))
    slices, under = first_seen(np.take_along_axis(level, grid.nearest, 0), view.count)
    seen = (slices < len(level)) & grid.met[:, None]
    place = np.take_along_axis(grid.nearest, np.minimum(slices, len(level) - 1).T, 0), np.arange(view.count)
    light = np.where(under.T, UNDER, 1.0) * lighted(height * (HEIGHT / limit), grid)[place]
    return SurfacePicture(np.where(seen.T, height[place], np.nan), light)


def first_seen(level: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return for each pixel, (columns, rows), the first slice that passes its height, and whether in falling.

    ``level``: heights of the slices from the front, (slices, columns), in pupil radii. No slice: their number.
    """
    first = (count + 1) * np.arange(level.shape[1])
    passed = []
    for reach in (np.maximum, np.minimum):
        row = np.ceil((reach.accumulate(level, 0) + HALF) * (count / 2 / HALF) - 0.5)  # the lowest pixel not below
        place = np.clip(row, 0, count).astype(np.intp) + first
        counted = np.bincount(place.ravel(), minlength=first.size * (count + 1)).reshape(-1, count + 1)
        passed.append(np.cumsum(counted, axis=1)[:, :count])
    above = len(level) - passed[1]  # slices that have not yet fallen to this pixel
    return passed[0] + above, above > 0


def lighted(height: np.ndarray, grid: SurfaceGrid) -> np.ndarray:
    """Return how bright the surface is: more where it faces front and left, less on the net."""
    step, column = np.maximum(grid.depth[1] - grid.depth[0], 1e-6), 2 * HALF / height.shape[1]
    back = np.gradient(height, axis=0) / step
    right = (np.gradient(height, axis=1) - back * np.gradient(grid.depth, axis=1)) / column  # at the same depth
    light = np.clip(LIT + SLOPE * (back + right) / np.sqrt(1 + back**2 + right**2), DARKEST, 1.0)
    return np.where(grid.net, NET * light, light)


@lru_cache(maxsize=4)
def placed(known: bytes, count: int, view: Viewpoint) -> SurfaceGrid:
    """Return the slices' places over a map of ``count``² samples, of which those ``known`` have a value."""
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
    net = np.minimum(*(np.abs((v / MESH + 0.5) % 1 - 0.5) for v in (xi, eta))) * MESH < max(LINE, 1 / view.count)
    return SurfaceGrid(samples, weights, net, nearest, found.any(axis=0), depth)


def neighbours(xi: np.ndarray, eta: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the four samples around each place of a map of ``count``², and straight-line weights, (4, …) each."""
    places = [np.clip((v + 1) * count / 2 - 0.5, 0, count - 1.001) for v in (eta, xi)]
    (row, column), (up, right) = ([p.astype(int) for p in places], [p % 1 for p in places])
    both = [(j, i) for j in (0, 1) for i in (0, 1)]
    weights = [(up if j else 1 - up) * (right if i else 1 - right) for j, i in both]
    return np.array([(row + j) * count + column + i for j, i in both]), np.array(weights)


COUNTS = {"preview": 128, "settled": 256}
SHADES = 24
TURN_DEG = 5.0
KEYS = Qt.Key
TURNS = {
    KEYS.Key_Left: (-TURN_DEG, 0.0),
    KEYS.Key_Right: (TURN_DEG, 0.0),
    KEYS.Key_Up: (0.0, TURN_DEG),
    KEYS.Key_Down: (0.0, -TURN_DEG),
}
DEG_PER_PX = 0.5
FIRST = Camera(-30.0, 35.0)  # ξ to the right, η away from the eye
AWAY = 1.12  # pupil radii from the middle to an axis's name
AXES = (("ξ", (1.0, 0.0)), ("η", (0.0, 1.0)))


class SurfaceView(QWidget):
    """Drag or arrow keys turn the surface, a double-click or Home goes back; ``turned`` tells of where it is let go."""

    turned = Signal(float, float)
    taken, released = Signal(), Signal()

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(120, 90)
        self.setAccessibleName(tr("The wavefront as a surface; drag it or use the arrow keys to turn it"))
        self.setToolTip(tr("Drag or use the arrow keys to turn the surface; a double-click goes back"))
        self._theme, self._map, self.eye = LIGHT, "CET-D1A", FIRST
        self.pixels = np.zeros((1, 1), np.uint32)
        self._held: tuple[QPointF, Camera] | None = None

    def show_waves(self, waves: np.ndarray, limit: float, quality: str, eye: Camera) -> None:
        """Show W in waves over the pupil, ``limit`` waves as high as the colour bar's end."""
        self.eye = eye
        seen = surface_picture(waves, limit, Viewpoint(eye.turn, eye.tilt, COUNTS[quality]))
        shade = (seen.light * (SHADES - 1)).astype(np.intp)
        self.pixels = shaded(self._map)[shade, as_indices(seen.waves, -limit, limit)][::-1].copy()
        self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def to_pixels(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return where a place of the picture lies, pupil radii from its middle, in pixels of the widget."""
        side = min(self.width(), self.height()) / (2 * HALF)
        return self.width() / 2 + side * x, self.height() / 2 - side * y

    def paintEvent(self, event) -> None:
        """Paint the pupil's plane, the surface above and below it, and the focus."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_plane(painter)
        (left, right), (bottom, top) = self.to_pixels(np.array([-HALF, HALF]), np.array([-HALF, HALF]))
        rows, columns = self.pixels.shape
        image = QImage(self.pixels.data, columns, rows, 4 * columns, QImage.Format.Format_ARGB32)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(QRectF(left, top, right - left, bottom - top), image)
        self._paint_names(painter)
        if self.hasFocus():
            painter.setPen(QPen(QColor(self._theme.accent), 1))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))

    def _paint_plane(self, painter: QPainter) -> None:
        """Paint the rim at W = 0 and its two axes, which the surface may hide."""
        turn = np.linspace(0, 2 * np.pi, 73)
        painter.setPen(pen(self._theme.line))
        painter.drawPolyline(polygon(*self.to_pixels(*self._level(np.cos(turn), np.sin(turn)))))
        ends = np.array([-1.0, 1.0])
        for _, (xi, eta) in AXES:
            painter.drawPolyline(polygon(*self.to_pixels(*self._level(xi * ends, eta * ends))))

    def _paint_names(self, painter: QPainter) -> None:
        """Paint the axes' names at their ends, on top: a surface may stand before them."""
        painter.setPen(pen(self._theme.text))
        for name, (xi, eta) in AXES:
            x, y = self.to_pixels(*self._level(AWAY * xi, AWAY * eta))
            write(painter, QRectF(x - 20, y - 8, 40, 16), name)

    def _level(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return where points of the plane W = 0 are seen, pupil radii from the picture's middle."""
        turn, tilt = np.deg2rad(self.eye.turn), np.deg2rad(self.eye.tilt)
        return xi * np.cos(turn) + eta * np.sin(turn), np.sin(tilt) * (eta * np.cos(turn) - xi * np.sin(turn))

    def _turn(self, eye: Camera) -> None:
        self.turned.emit(eye.turn, max(0.0, eye.tilt))

    def mousePressEvent(self, event) -> None:
        """Take hold of the surface."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._held = event.position(), self.eye
            self.taken.emit()

    def mouseMoveEvent(self, event) -> None:
        """Turn it while held."""
        if self._held:
            start, eye = self._held
            moved = event.position() - start
            self._turn(turned(eye, -DEG_PER_PX * moved.x(), DEG_PER_PX * moved.y()))

    def mouseReleaseEvent(self, event) -> None:
        """Let go."""
        if self._held:
            self._held = None
            self.released.emit()

    def mouseDoubleClickEvent(self, event) -> None:
        """Go back to the first view."""
        self._turn(FIRST)

    def keyPressEvent(self, event) -> None:
        """Turn with the arrows, go back with Home."""
        if event.key() in TURNS:
            self._turn(turned(self.eye, *TURNS[event.key()]))
        elif event.key() == KEYS.Key_Home:
            self._turn(FIRST)
        else:
            super().keyPressEvent(event)


@lru_cache(maxsize=4)
def shaded(name: str) -> np.ndarray:
    """Return a colour map in `SHADES` brightnesses, (shade, index) of 0xAARRGGBB; no value is transparent."""
    colours = lookup(name)[None]
    light = np.arange(SHADES)[:, None] / (SHADES - 1)
    parts = [((colours >> shift & 255) * light).astype(np.uint32) << shift for shift in (0, 8, 16)]
    table = np.uint32(0xFF000000) | parts[0] | parts[1] | parts[2]
    table[:, EMPTY] = 0
    return table
