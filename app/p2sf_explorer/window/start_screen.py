"""The first start: the picture moves once by itself, and three doors stand beside it, until the first touch."""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi

import numpy as np
from PySide6.QtCore import QEvent, QObject, QRectF, QSize, Qt, QTimer, QVariantAnimation, Signal
from PySide6.QtGui import QColor, QImage, QKeyEvent, QPainter, QPainterPath, QPaintEvent
from PySide6.QtWidgets import QApplication, QFrame, QLabel, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from p2sf.colour.colorimetry import srgb_from_linear
from p2sf.image.charts import draw_chart
from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.compute.setup import FIRST_LENS
from p2sf_explorer.files import recent
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.lesson import FOLDER, read_lesson
from p2sf_explorer.lessons.lesson_list import lesson_icon
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.thumbnail import paint_lens
from p2sf_explorer.window.foot import Foot
from p2sf_explorer.window.lens_cards import lens_card

STORY = "One star, as this lens shows it off its axis. Drag Field: at 0° the star is round."
WAIT_MS, MOVE_MS = 2500, 9000  # long enough to read the sentence; and of the slider's way there and back
LESSONS = "04_spherical_aberration", "05_coma", "06_astigmatism"
CHART, CHART_SHAPE = "landscape", (240, 480)
PICTURE_PX = 40  # the least height of a door's picture at scale 1
DOORS = (
    ("Learn", "Lessons with pictures, three minutes each"),
    ("A photo through a lens", "What a lens makes of a scene, near and far"),
    ("Open my lens", "Zemax, CODE V, OSLO, a table …"),
)
TOUCHES = (
    QEvent.Type.MouseButtonPress,
    QEvent.Type.Wheel,
    QEvent.Type.TouchBegin,
    QEvent.Type.KeyPress,
    QEvent.Type.Shortcut,
)
TO_A_DOOR = Qt.Key.Key_Tab, Qt.Key.Key_Backtab, Qt.Key.Key_Space, Qt.Key.Key_Return, Qt.Key.Key_Enter

Painting = Callable[[QPainter, QRectF, Tokens], None]
"""Paints a picture into a rectangle."""


@dataclass(frozen=True)
class Beginnings:
    """What the doors lead to, in the order of `DOORS`."""

    learn: Callable[[], object]
    photo: Callable[[], object]
    open: Callable[[], object]


class Picture(QWidget):
    """A picture with round corners; ``paint`` paints it, None leaves it empty."""

    def __init__(self, theme: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.paint: Painting | None = None
        self._theme = theme
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setMinimumHeight(theme.px(PICTURE_PX))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the picture within its corners."""
        painter, outline = QPainter(self), QPainterPath()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        outline.addRoundedRect(QRectF(self.rect()), self._theme.px(4), self._theme.px(4))
        painter.setClipPath(outline)
        if self.paint:
            self.paint(painter, QRectF(self.rect()), self._theme)


class Door(QPushButton):
    """A large button with a picture, a title and a line about what is behind it."""

    def __init__(self, title: str, about: str, theme: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAccessibleName(tr(title))
        self.setAccessibleDescription(tr(about))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.picture = Picture(theme, self)
        heading, line = QLabel(tr(title), self), QLabel(tr(about), self)
        heading.setStyleSheet(f"font-size: {theme.px(16)}px; font-weight: 600;")
        line.setObjectName("muted")
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(*(theme.px(side) for side in (10, 10, 10, 10)))
        column.setSpacing(theme.px(SPACE // 2))
        column.addWidget(self.picture, 1)
        for label in (heading, line):
            label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            column.addWidget(label)

    def sizeHint(self) -> QSize:
        """Return the least size of what stands in it: the doors share what room there is."""
        return self._column.minimumSize()


class StartScreen(QFrame):
    """The doors, over the ``rail`` beside the picture, and the way of the field's slider there and back.

    The PSF's scale is held meanwhile at ``half_um``, so that its growth is seen. Every press, key or turn of the wheel
    outside the doors ends it, where the slider then is; ``still`` leaves the slider at rest. ``left`` is sent when it
    ends.
    """

    left = Signal()

    def __init__(
        self,
        beginnings: Beginnings,
        store: Store,
        foot: Foot,
        theme: Tokens,
        rail: QWidget,
        half_um: float,
        still: bool,
    ) -> None:
        super().__init__(rail)
        self.setObjectName("window")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._store, self._foot, self._rail = store, foot, rail
        self.doors = [Door(*words, theme, self) for words in DOORS]
        paints = paint_lessons, paint_scene, paint_first_lens
        self._unpainted = list(zip(self.doors, paints, strict=True))
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(theme.px(SPACE))
        for door, run in zip(self.doors, (beginnings.learn, beginnings.photo, beginnings.open), strict=True):
            door.clicked.connect(lambda _=False, run=run: self._begin(run))
            column.addWidget(door, 1)
        self._field_deg, self._held = store.state.optics.field_deg, (("psf", half_um),)
        self.motion = QVariantAnimation(self, startValue=0.0, endValue=1.0, duration=MOVE_MS)
        self.motion.valueChanged.connect(self._move)
        self.motion.finished.connect(store.cancel)  # the field is where it was, and no step of undo is left
        self._wait = QTimer(self, singleShot=True, interval=WAIT_MS)
        if not still:
            self._wait.timeout.connect(self.motion.start)
        self._draw = QTimer(self, singleShot=True, interval=0)
        self._draw.timeout.connect(self._draw_next)

    def begin(self) -> None:
        """Show the doors and the sentence, and wait for a touch."""
        self._foot.tell(tr(STORY))
        self.resize(self._rail.size())
        self.show()
        self.raise_()
        self.doors[0].setFocus()
        self._wait.start()
        self._draw.start()
        self._rail.installEventFilter(self)
        if application := QApplication.instance():
            application.installEventFilter(self)

    def leave(self) -> None:
        """Put doors and sentence away for good, and leave the slider where it is."""
        if application := QApplication.instance():
            application.removeEventFilter(self)
        self._rail.removeEventFilter(self)
        self._wait.stop()
        if self.motion.state() == QVariantAnimation.State.Running:
            self.motion.stop()
            self._store.update(held_scales=())
            self._store.end()
        self._draw.stop()
        self._foot.tell("")
        self.hide()
        self.deleteLater()
        self.left.emit()

    def _begin(self, run: Callable[[], object]) -> None:
        self.leave()
        run()

    def _move(self, part: float) -> None:
        """Put the field at a part of its way to the axis and back."""
        self._store.begin()
        way = self._field_deg * (1 + cos(2 * pi * part)) / 2
        self._store.update(field_deg=round(way, 2), held_scales=self._held)

    def _draw_next(self) -> None:
        """Draw one picture, so that the window answers between two."""
        door, paint = self._unpainted.pop(0)
        door.picture.paint = paint
        door.picture.update()
        if self._unpainted:
            self._draw.start()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Be as large as the rail, and leave at a touch of anything but the doors."""
        if watched is self._rail and event.type() == QEvent.Type.Resize:
            self.resize(self._rail.size())
        if event.type() in TOUCHES and self._is_touch(watched, event):
            self.leave()
        return False

    def _is_touch(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QKeyEvent) and event.key() in TO_A_DOOR:
            return False
        if event.type() == QEvent.Type.Shortcut:
            return True
        return isinstance(watched, QWidget) and not (watched is self or self.isAncestorOf(watched))


def paint_lessons(painter: QPainter, rect: QRectF, theme: Tokens) -> None:
    """Paint the PSFs of three lessons side by side."""
    painter.fillRect(rect, Qt.GlobalColor.black)
    each = rect.width() / len(LESSONS)
    for number, name in enumerate(LESSONS):
        if icon := lesson_icon(read_lesson(FOLDER / f"{name}.md"), theme):
            side = min(each, rect.height())
            place = QRectF(rect.left() + (number + 0.5) * each - side / 2, rect.center().y() - side / 2, side, side)
            painter.drawPixmap(place.toRect(), icon.pixmap(icon.availableSizes()[0]))  # an icon is never enlarged


def paint_scene(painter: QPainter, rect: QRectF, theme: Tokens) -> None:
    """Paint the scene that the image panel begins with, as large as fills the rectangle."""
    light = srgb_from_linear(np.clip(draw_chart(CHART, *CHART_SHAPE), 0, 1))
    pixels = np.ascontiguousarray(np.round(255 * light).astype(np.uint8))
    rows, columns, _ = pixels.shape
    image = QImage(pixels.data, columns, rows, 3 * columns, QImage.Format.Format_RGB888)
    scale = min(columns / rect.width(), rows / rect.height())
    part = QRectF(0, 0, scale * rect.width(), scale * rect.height())
    part.moveCenter(QRectF(image.rect()).center())
    painter.drawImage(rect, image, part)


def paint_first_lens(painter: QPainter, rect: QRectF, theme: Tokens) -> None:
    """Paint the lens of the first start."""
    painter.fillRect(rect, QColor(theme.window))
    if drawn := lens_card(FIRST_LENS).drawing:
        air = rect.height() / 8
        paint_lens(painter, drawn, rect.adjusted(air, air, -air, -air), theme)


def first_start() -> bool:
    """Return whether this person has never seen the start screen, and remember that it has been shown."""
    path = recent.recent_path().with_name("start_shown")
    if path.exists() or path.with_name("lesson_offered").exists():  # which versions up to 0.2 left
        return False
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    except OSError:
        return False
    return True
