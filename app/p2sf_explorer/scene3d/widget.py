"""The widget that shows what the stage renders, and turns it under the mouse and the keys."""

from dataclasses import replace

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf.files.writing import write_beside
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.state.camera import CAMERA, Camera, nearer, turned
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.copying import png_of

MOST_PIXELS = 640 * 480  # of a picture while something moves; the settled one has every pixel of the widget
WAVES_MAP = "CET-D1A"
TURN_DEG = 5.0
TURNS = {
    Qt.Key.Key_Left: (-TURN_DEG, 0.0),
    Qt.Key.Key_Right: (TURN_DEG, 0.0),
    Qt.Key.Key_Up: (0.0, TURN_DEG),
    Qt.Key.Key_Down: (0.0, -TURN_DEG),
}
ZOOMS = {Qt.Key.Key_Plus: 1.25, Qt.Key.Key_Equal: 1.25, Qt.Key.Key_Minus: 0.8}


class SceneView(QWidget):
    """Drag to turn, wheel or + and − to come nearer, double-click to go back; before there is a stage, a sentence."""

    def __init__(self, store: Store, parent=None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(160, 110)
        self._store, self._theme, self._stage = store, LIGHT, None
        self._live: Live | None = None
        self._message, self.message_is_final = "", False
        self._held, self._eye = None, CAMERA
        self.image: QImage | None = None

    def say(self, sentence: str, final: bool = False) -> None:
        """Show a sentence in place of the picture; ``final`` when no picture will follow."""
        self._message, self.message_is_final = sentence, final
        self.setAccessibleDescription(sentence)
        self.update()

    def set_renderer(self, stage) -> None:
        """Show what this stage renders from now on."""
        self._stage = stage
        self._forget()

    def show_live(self, live: Live) -> None:
        """Show an answer's scene."""
        self._live = live
        if not self._held:
            self._eye = Camera(live.state.eye_turn_deg, live.state.eye_tilt_deg, live.state.eye_near)
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
        picture = png_of(self.parentWidget())
        write_beside(path, lambda handle: handle.write(picture))

    def _moving(self) -> bool:
        return bool(self._held) or self._live is None or self._live.quality == "preview"

    def _forget(self) -> None:
        self.image = None
        self.update()

    def _render(self) -> None:
        stage, size = self._stage, self.pixels()
        stage.resize(size, smooth=not self._moving())
        stage.follow(self._live.views["solid"], self._theme, (WAVES_MAP, self._theme.brightness))
        stage.look(self._eye)
        picture = stage.picture()
        rows, columns, _ = picture.shape
        self.image = QImage(picture.data, columns, rows, 4 * columns, QImage.Format.Format_RGBX8888).copy()

    def paintEvent(self, event) -> None:
        """Paint the picture, or the sentence, and the focus."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        if self._stage and self._live:
            if self.image is None:
                self._render()
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(QRectF(self.rect()), self.image)
        elif self._message:
            painter.setPen(QColor(self._theme.muted))
            room = self.rect().adjusted(24, 8, -24, -8)
            painter.drawText(room, Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, self._message)
        if self.hasFocus():
            painter.setPen(QPen(QColor(self._theme.accent), 1))
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))

    def resizeEvent(self, event) -> None:
        """Render anew in a new size."""
        self._forget()
        super().resizeEvent(event)

    def _keep(self, eye: Camera) -> None:
        """Make this the eye of the state."""
        self._held = None
        self._store.update(eye_turn_deg=eye.turn, eye_tilt_deg=eye.tilt, eye_near=eye.near)
        self._forget()

    def mousePressEvent(self, event) -> None:
        """Take hold of the scene."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._held = event.position(), self._eye

    def mouseMoveEvent(self, event) -> None:
        """Turn the scene while held."""
        if self._held:
            start, eye = self._held
            moved = event.position() - start
            self._eye = turned(eye, -0.4 * moved.x(), 0.4 * moved.y())
            self._forget()

    def mouseReleaseEvent(self, event) -> None:
        """Let go; the state keeps where the eye is."""
        if self._held:
            self._keep(self._eye)

    def mouseDoubleClickEvent(self, event) -> None:
        """Go back to the first view."""
        self._keep(CAMERA)

    def wheelEvent(self, event) -> None:
        """Come nearer or go away."""
        self._keep(nearer(self._eye, 1.25 ** (event.angleDelta().y() / 120)))

    def keyPressEvent(self, event) -> None:
        """Turn with the arrows, come nearer with + and −, go back with Home."""
        if event.key() in TURNS:
            self._keep(turned(self._eye, *TURNS[event.key()]))
        elif event.key() in ZOOMS:
            self._keep(nearer(self._eye, ZOOMS[event.key()]))
        elif event.key() == Qt.Key.Key_Home:
            self._keep(replace(CAMERA))
        else:
            super().keyPressEvent(event)
