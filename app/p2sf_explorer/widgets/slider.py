"""A slider painted directly: travel 0 to 1, ticks, marks, and a gradient in the groove, such as the spectrum."""

from functools import partial

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QKeyEvent,
    QLinearGradient,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QWheelEvent,
)
from PySide6.QtWidgets import QAbstractSlider, QSizePolicy, QWidget

from p2sf_explorer.charts.chart import blank_pixmap
from p2sf_explorer.charts.painting import small_font
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.tr import local
from p2sf_explorer.widgets.scrub import REST_MS, claimed, notches, speed

STEPS = 1000
HANDLE = 7.0
MARGIN = 9.0
LABEL_GAP = 5.0  # pixels between the labels of ticks
MIDDLE = 11.0  # pixels from the top to the middle of groove and handle
KEYS = Qt.Key
MOVES = (
    *(KEYS.Key_Left, KEYS.Key_Right, KEYS.Key_Up, KEYS.Key_Down),
    *(KEYS.Key_PageUp, KEYS.Key_PageDown, KEYS.Key_Home, KEYS.Key_End),
)


ARROWS: dict[int, int] = {KEYS.Key_Left: -1, KEYS.Key_Down: -1, KEYS.Key_Right: 1, KEYS.Key_Up: 1}


class Slider(QAbstractSlider):
    """A horizontal slider over 0 to STEPS; a double-click asks for reset, Space for a sweep, Escape to give up a drag.

    Shift makes wheel and arrow keys ten times as coarse; with Alt they move by the smallest step.
    """

    reset, cancelled = Signal(), Signal()
    swept = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setRange(0, STEPS)
        self.setSingleStep(STEPS // 200)
        self.setPageStep(STEPS // 20)
        self.setOrientation(Qt.Orientation.Horizontal)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.fine_arrows = True  # Alt and an arrow move the handle, rather than a lesson
        self._theme = LIGHT
        self._ticks: tuple[tuple[float, str], ...] = ()
        self._marks: tuple[float, ...] = ()
        self._spectrum: tuple[tuple[float, str], ...] = ()
        self._background: QPixmap | None = None
        self._rest = QTimer(self, singleShot=True, interval=REST_MS)  # a turn of the wheel is one step of undo
        self._rest.timeout.connect(partial(self.setSliderDown, False))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours and the scale of a theme."""
        self._theme = theme
        self.updateGeometry()
        self._forget_background()

    def set_ticks(self, ticks: tuple[tuple[float, str], ...]) -> None:
        """Mark travels (0 to 1) with a label under the groove, unless it would touch the label of an earlier one."""
        self._ticks = ticks
        self.updateGeometry()
        self._forget_background()

    def set_marks(self, marks: tuple[float, ...]) -> None:
        """Point at these travels (0 to 1) from above the groove."""
        if marks != self._marks:
            self._marks = marks
            self._forget_background()

    def set_spectrum(self, colours: tuple[tuple[float, str], ...]) -> None:
        """Paint the groove as a gradient of (travel, colour)."""
        self._spectrum = colours
        self._forget_background()

    def sizeHint(self) -> QSize:
        """Return a height with room for the tick labels, if there are any."""
        return QSize(self._theme.px(160), self._theme.px(32 if self._ticks else 22))

    def minimumSizeHint(self) -> QSize:
        """Return the smallest useful size."""
        return QSize(self._theme.px(80), self.sizeHint().height())

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the handle, or bring it under the pointer."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.setSliderDown(True)
            self._follow(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Follow the pointer while held."""
        if self.isSliderDown():
            self._follow(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.setSliderDown(False)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Ask for a sweep on Space; a key that moves the handle holds it: kept down, it is one step of undo."""
        if event.key() == Qt.Key.Key_Space:
            self.swept.emit()
            return
        if event.key() == Qt.Key.Key_Escape and self.isSliderDown():
            self.cancelled.emit()
            self.setSliderDown(False)
            return
        if event.key() in MOVES and not self.isSliderDown():
            self.setSliderDown(True)
        if event.key() in ARROWS:
            self._step(ARROWS[event.key()], event.modifiers())
        else:
            super().keyPressEvent(event)

    def event(self, event: QEvent) -> bool:
        """Keep the keys that move the handle from the window's shortcuts."""
        return claimed(event, ARROWS, self.isSliderDown(), self.fine_arrows) or super().event(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Move the handle by the wheel."""
        self.setSliderDown(True)
        self._step(notches(event), event.modifiers())
        self._rest.start()
        event.accept()

    def _step(self, count: float, modifiers: Qt.KeyboardModifier) -> None:
        by = count * self.singleStep() * speed(modifiers)
        self.setValue(self.value() + (round(by) or (by > 0) - (by < 0)))

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Let go when the key is up, and not while it repeats."""
        if event.key() in MOVES and not event.isAutoRepeat():
            self.setSliderDown(False)
        super().keyReleaseEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Let go, since the release of a key will go to another widget."""
        self.setSliderDown(False)
        super().focusOutEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask for the reset."""
        self.setSliderDown(False)
        self.reset.emit()

    def handle_x(self) -> float:
        """Return the handle's place in pixels."""
        return self._x(self.value() / STEPS)

    def _x(self, travel: float) -> float:
        return self._margin + travel * (self.width() - 2 * self._margin)

    @property
    def _margin(self) -> float:
        return MARGIN * self._theme.scale

    @property
    def _middle(self) -> float:
        return MIDDLE * self._theme.scale

    def _follow(self, point: QPointF) -> None:
        travel = (point.x() - self._margin) / max(1.0, self.width() - 2 * self._margin)
        self.setValue(round(STEPS * travel))

    def _forget_background(self) -> None:
        self._background = None
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the background of groove and ticks, then the handle and the groove up to it."""
        if self._background is None or self._background.size() != self.size() * self.devicePixelRatioF():
            self._background = self._painted_background()
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._background)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if not self._spectrum:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(self._theme.accent if self.isEnabled() else self._theme.muted))
            half = 2 * self._theme.scale
            left, wide = self._margin, self.handle_x() - self._margin
            painter.drawRoundedRect(QRectF(left, self._middle - half, wide, 2 * half), half, half)
        self._paint_handle(painter, self._middle)

    def _painted_background(self) -> QPixmap:
        background = blank_pixmap(self, self._theme.card)
        painter = QPainter(background)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_groove(painter, self._middle)
        self._paint_ticks(painter, self._middle)
        self._paint_marks(painter, self._middle)
        painter.end()
        return background

    def _paint_groove(self, painter: QPainter, middle: float) -> None:
        half = (5.0 if self._spectrum else 2.0) * self._theme.scale
        groove = QRectF(self._margin, middle - half, self.width() - 2 * self._margin, 2 * half)
        painter.setPen(Qt.PenStyle.NoPen)
        if not self._spectrum:
            painter.setBrush(QColor(self._theme.line))
            painter.drawRoundedRect(groove, half, half)
            return
        gradient = QLinearGradient(groove.topLeft(), groove.topRight())
        for travel, colour in self._spectrum:
            gradient.setColorAt(travel, QColor(colour))
        painter.setBrush(gradient)
        painter.drawRoundedRect(groove, 2, 2)

    def _paint_ticks(self, painter: QPainter, middle: float) -> None:
        painter.setFont(small_font(self._theme.tick))
        scale, gap = self._theme.scale, LABEL_GAP * self._theme.scale
        taken: list[tuple[float, float]] = []
        for travel, english in self._ticks:
            x, label = self._x(travel), local(english)
            painter.setPen(QPen(QColor(self._theme.muted), scale))
            painter.drawLine(QPointF(x, middle + 6 * scale), QPointF(x, middle + 9 * scale))
            wide = painter.fontMetrics().horizontalAdvance(label)
            left = min(max(x - wide / 2, 1.0), self.width() - wide - 1.0)
            if all(left > end or left + wide < start for start, end in taken):
                taken.append((left - gap, left + wide + gap))
                painter.drawText(QPointF(left, middle + 19 * scale), label)

    def _paint_marks(self, painter: QPainter, middle: float) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(self._theme.muted))
        for travel in self._marks:
            x, half, tall = self._x(travel), 3.5 * self._theme.scale, 5 * self._theme.scale
            tip = middle - tall
            painter.drawPolygon(
                QPolygonF([QPointF(x - half, tip - tall), QPointF(x + half, tip - tall), QPointF(x, tip)])
            )

    def _paint_handle(self, painter: QPainter, middle: float) -> None:
        theme, centre, scale = self._theme, QPointF(self.handle_x(), middle), self._theme.scale
        if self.hasFocus():
            halo = QColor(theme.accent)
            halo.setAlpha(70)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(halo)
            painter.drawEllipse(centre, (HANDLE + 2.5) * scale, (HANDLE + 2.5) * scale)
        painter.setPen(QPen(QColor(theme.accent if self.isEnabled() else theme.muted), 2 * scale))
        painter.setBrush(QColor(theme.card))
        painter.drawEllipse(centre, (HANDLE - 1) * scale, (HANDLE - 1) * scale)
