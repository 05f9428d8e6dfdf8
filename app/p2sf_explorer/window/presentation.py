"""Presenting: the stage alone on the full screen with larger type, a halo round the pointer, the sliders in reach."""

from collections.abc import Callable

from PySide6.QtCore import QByteArray, QObject, QPointF, QRect, Qt
from PySide6.QtGui import (
    QBrush,
    QCursor,
    QGuiApplication,
    QPainter,
    QPen,
    QPixmap,
    QPolygonF,
    QRadialGradient,
    QScreen,
    QShortcut,
)
from PySide6.QtWidgets import QApplication, QMainWindow, QVBoxLayout, QWidget

from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.widgets.command import Command

LARGER, LARGER_BESIDE = 2.0, 1.5  # type on the stage and beside it, against that of the window
HALO_PX = 96
GLOW = Qt.GlobalColor.yellow
ARROW = (0, 0), (0, 17), (4, 13), (7, 20), (10, 19), (7, 12), (12, 12)  # a pointer's outline, in pixels from its tip


class Presentation(QObject):
    """Begins and ends presenting; ``changed`` is called when the window has to arrange itself for it.

    Where there is a second screen the stage fills that one and the ``controls`` stay here in a window of their own.
    ``bars`` are the parts of the window that are out of the way meanwhile; ``home()`` puts the controls back.
    """

    def __init__(
        self,
        window: QMainWindow,
        controls: QWidget,
        bars: tuple[QWidget, ...],
        home: Callable[[], None],
        changed: Callable[[], None],
    ) -> None:
        super().__init__(window)
        self._window, self._controls, self._bars, self._home, self._changed = window, controls, bars, home, changed
        self.on = False
        self._before: tuple[QByteArray, Qt.WindowState] | None = None
        self._desk: QWidget | None = None
        self._escape = QShortcut("Esc", window)
        self._escape.setEnabled(False)
        self._escape.activated.connect(self.stop)

    @property
    def beside(self) -> QRect | None:
        """Return where there is room beside the controls on a screen of their own, None where they have none."""
        if self._desk is None:
            return None
        desk, screen = self._desk.frameGeometry(), self._desk.screen().availableGeometry()
        return QRect(desk.right() + 1, desk.top(), max(1, screen.right() - desk.right()), desk.height())

    def commands(self) -> tuple[Command, ...]:
        """Return the command that begins and ends presenting."""
        return (Command("Present: the stage on the full screen, or back (Esc)", self.toggle, ("F5",), "View"),)

    def toggle(self) -> None:
        """Begin presenting, or end it."""
        if self.on:
            self.stop()
        else:
            self.start()

    def start(self) -> None:
        """Put the stage on the full screen."""
        self.on, window = True, self._window
        self._before = window.saveGeometry(), window.windowState()
        self._escape.setEnabled(True)
        QApplication.setOverrideCursor(QCursor(halo(), HALO_PX // 2, HALO_PX // 2))
        for bar in self._bars:
            bar.hide()
        if other := other_screen(window):
            self._put_on_desk()
            window.setGeometry(other.geometry())
        window.showFullScreen()
        self._changed()

    def stop(self) -> None:
        """Put everything back."""
        if not self.on or self._before is None:
            return
        self.on, window = False, self._window
        self._escape.setEnabled(False)
        QApplication.restoreOverrideCursor()
        if self._desk:
            self._home()
            self._desk.deleteLater()
            self._desk = None
        for bar in self._bars:
            bar.show()
        geometry, state = self._before
        window.setWindowState(state)
        window.restoreGeometry(geometry)
        self._changed()

    def _put_on_desk(self) -> None:
        """Give the controls a window of their own where the main window was."""
        self._desk = desk = QWidget(self._window, Qt.WindowType.Window)
        desk.setObjectName("window")
        desk.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        desk.setWindowTitle(tr("Controls"))
        QVBoxLayout(desk).addWidget(self._controls)
        desk.setGeometry(self._window.geometry().adjusted(0, 0, self._controls.width() - self._window.width(), 0))
        desk.show()


def other_screen(window: QWidget) -> QScreen | None:
    """Return a screen on which the window is not, None where there is none."""
    return next((screen for screen in QGuiApplication.screens() if screen is not window.screen()), None)


def halo() -> QPixmap:
    """Return a pointer in a yellow glow that can be seen from the last row."""
    pixmap, middle = QPixmap(HALO_PX, HALO_PX), HALO_PX / 2
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    glow = QRadialGradient(QPointF(middle, middle), middle)
    for place, alpha in ((0.0, 150), (0.7, 110), (1.0, 0)):
        colour = QPen(GLOW).color()
        colour.setAlpha(alpha)
        glow.setColorAt(place, colour)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QBrush(glow))
    painter.drawEllipse(QPointF(middle, middle), middle, middle)
    painter.setPen(QPen(Qt.GlobalColor.white, 1.5))
    painter.setBrush(Qt.GlobalColor.black)
    painter.drawPolygon(QPolygonF([QPointF(middle + x, middle + y) for x, y in ARROW]))
    painter.end()
    return pixmap
