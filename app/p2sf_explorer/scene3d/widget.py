"""The widget that shows what the renderer renders, and turns it by the mouse and the keys."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import (
    QAccessible,
    QColor,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf.files.writing import write_beside
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.camera import CAMERA, SceneCamera, nearer, turn_camera
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.copying import png_of

if TYPE_CHECKING:
    from p2sf_explorer.scene3d.renderer import Renderer

MOST_PIXELS = 640 * 480  # of a picture while something moves; the settled one has all pixels of the widget
WAVES_MAP = "CET-D1A"
TURN_DEG = 5.0
TURNS: dict[int, tuple[float, float]] = {
    Qt.Key.Key_Left: (-TURN_DEG, 0.0),
    Qt.Key.Key_Right: (TURN_DEG, 0.0),
    Qt.Key.Key_Up: (0.0, TURN_DEG),
    Qt.Key.Key_Down: (0.0, -TURN_DEG),
}
ZOOMS: dict[int, float] = {Qt.Key.Key_Plus: 1.25, Qt.Key.Key_Equal: 1.25, Qt.Key.Key_Minus: 0.8}


class SceneView(QWidget):
    """Drag to turn, wheel or + and − to zoom, double-click to reset; a text until there is a renderer."""

    accessible_role = QAccessible.Role.Graphic

    def __init__(self, store: Store, card: QWidget):
        super().__init__(card)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(160, 110)
        self.setAccessibleName(tr("The lens in space; arrow keys turn it, + and − zoom"))
        self._store, self._theme = store, LIGHT
        self._renderer: Renderer | None = None
        self._live: Live | None = None
        self._message, self.message_is_final = "", False
        self._held: tuple[QPointF, SceneCamera] | None = None
        self._camera = CAMERA
        self.image: QImage | None = None

    def say(self, sentence: str, final: bool = False) -> None:
        """Show a text, as it is, in place of the picture; ``final`` when no picture will follow."""
        self._message, self.message_is_final = sentence, final
        self.setAccessibleDescription(sentence)
        self.update()

    def set_renderer(self, renderer: "Renderer | None") -> None:
        """Show what this renderer renders from now on."""
        self._renderer = renderer
        self._forget()

    def show_live(self, live: Live) -> None:
        """Show an answer's scene."""
        self._live = live
        if not self._held:
            self._camera = SceneCamera(live.state.camera.turn_deg, live.state.camera.tilt_deg, live.state.camera.zoom)
        self._forget()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self._forget()

    def pixels(self) -> tuple[int, int]:
        """Return the size of the picture to render: fewer pixels while something moves."""
        ratio = self.devicePixelRatioF()
        if self._moving():
            ratio *= min(1.0, (MOST_PIXELS / max(1.0, ratio**2 * self.width() * self.height())) ** 0.5)
        return max(8, round(ratio * self.width())), max(8, round(ratio * self.height()))

    def save_picture(self, path: str) -> None:
        """Write what is shown as a picture, whole or not at all; P2SFError when it cannot be written."""
        picture = png_of(self.parentWidget() or self)
        write_beside(path, lambda handle: handle.write(picture))

    def _moving(self) -> bool:
        return bool(self._held) or self._live is None or self._live.quality == "preview"

    def _forget(self) -> None:
        self.image = None
        self.update()

    def _render(self, renderer: "Renderer", live: Live) -> QImage:
        renderer.resize(self.pixels(), smooth=not self._moving())
        renderer.follow(live.views["solid"].found, self._theme, (WAVES_MAP, self._theme.brightness))
        renderer.look(self._camera)
        picture = renderer.picture()
        rows, columns, _ = picture.shape
        return QImage(picture.data, columns, rows, 4 * columns, QImage.Format.Format_RGBX8888).copy()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the picture or the text, and the focus frame."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        if self._renderer and self._live:
            if self.image is None:
                self.image = self._render(self._renderer, self._live)
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(QRectF(self.rect()), self.image)
        elif self._message:
            painter.setPen(QColor(self._theme.muted))
            painter.drawText(
                self.rect().adjusted(24, 8, -24, -8),
                Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap,
                self._message,
            )
        if self.hasFocus():
            painter.setPen(QPen(QColor(self._theme.accent), 1))
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Render again in the new size."""
        self._forget()
        super().resizeEvent(event)

    def _keep(self, camera: SceneCamera) -> None:
        """Make this the camera of the state."""
        self._held = None
        self._store.update(camera_turn_deg=camera.turn, camera_tilt_deg=camera.tilt, camera_zoom=camera.near)
        self._forget()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Start dragging."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._held = event.position(), self._camera

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Turn the scene while held."""
        if self._held:
            start, camera = self._held
            moved = event.position() - start
            self._camera = turn_camera(camera, -0.4 * moved.x(), 0.4 * moved.y())
            self._forget()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Stop dragging; the state keeps the camera."""
        if self._held:
            self._keep(self._camera)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Go back to the first view."""
        self._keep(CAMERA)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom."""
        self._keep(nearer(self._camera, 1.25 ** (event.angleDelta().y() / 120)))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Turn with the arrows, zoom with + and −, reset with Home."""
        if event.key() in TURNS:
            self._keep(turn_camera(self._camera, *TURNS[event.key()]))
        elif event.key() in ZOOMS:
            self._keep(nearer(self._camera, ZOOMS[event.key()]))
        elif event.key() == Qt.Key.Key_Home:
            self._keep(CAMERA)
        else:
            super().keyPressEvent(event)
