"""Wheel, drags and keys of a chart: zoom, pan, home, crosshair, pinned markers, locks.

An event filter, so that a chart whose own drags do something else keeps its handlers: those see what is left here.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, Qt
from PySide6.QtGui import QHelpEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QMenu, QToolTip

from p2sf_explorer.charts.axes import lock_places
from p2sf_explorer.i18n.tr import tr

if TYPE_CHECKING:
    from p2sf_explorer.charts.chart import Chart

KEYS, BUTTONS, MODIFIERS = Qt.Key, Qt.MouseButton, Qt.KeyboardModifier
ZOOM = 1.25  # of one notch of a wheel, and of one press of + or −
NOTCH = 120.0  # of QWheelEvent.angleDelta
CLICK_PX = 4.0  # a press that moves less is a click
PAN = 0.1  # of the range on screen, by an arrow key
STEP_PX = 8.0  # of the crosshair, by an arrow key with Ctrl
ARROWS: dict[int, tuple[int, int]] = {
    KEYS.Key_Left: (-1, 0),
    KEYS.Key_Right: (1, 0),
    KEYS.Key_Up: (0, -1),
    KEYS.Key_Down: (0, 1),
}
ZOOMS: dict[int, float] = {
    **dict.fromkeys((KEYS.Key_Plus, KEYS.Key_Equal), 1 / ZOOM),
    **dict.fromkeys((KEYS.Key_Minus, KEYS.Key_Underscore), ZOOM),
}
LOCK_TIPS = {
    "x": "Lock the scale of this axis (L: all of this plot)",
    "y": "Lock the scale of this axis (L: all of this plot)",
    "xy": "Lock the scale of this plot (L)",
    "home": "The whole plot (Home, double-click)",
}


class Hand(QObject):
    """What the pointer and the keys do to a chart; ``at`` is the pixel of the crosshair, None for none.

    A drag pans, unless the chart `Chart.takes` it: there with Shift or the middle button. Arrows pan, unless it
    ``takes_arrows``: there with Shift.
    """

    def __init__(self, chart: "Chart"):
        super().__init__(chart)
        self._chart = chart
        self.at: QPointF | None = None
        self._panned: QPointF | None = None  # where the drag that pans was last
        self._pressed: QPointF | None = None  # where a press began that may be a click
        self._clicked = False  # by the press before: a second one is a double-click and takes the marker back
        chart.setMouseTracking(True)
        chart.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Handle an event; return whether that is all there is to do."""
        handler = HANDLERS.get(event.type())
        return handler(self, event) if handler else False

    def on_wheel(self, event: QWheelEvent) -> bool:
        """Zoom about the pointer: over an axis only along it."""
        notches = event.angleDelta().y() / NOTCH
        if not notches:
            return False
        self._chart.zoom(event.position(), ZOOM**-notches, self._axes_at(event.position()))
        event.accept()
        return True

    def _axes_at(self, point: QPointF) -> str:
        area = self._chart.area
        return "y" if point.x() < area.left() else "x" if point.y() > area.bottom() else "xy"

    def on_press(self, event: QMouseEvent) -> bool:
        """Turn a lock, or begin to pan."""
        button, shift = event.button(), bool(event.modifiers() & MODIFIERS.ShiftModifier)
        if button == BUTTONS.LeftButton and self._turn_lock(event.position()):
            return True
        if button == BUTTONS.MiddleButton or (
            button == BUTTONS.LeftButton and (shift or not self._chart.takes(event.position()))
        ):
            self._panned = event.position()
            self._pressed = event.position() if button == BUTTONS.LeftButton else None
            return True
        return False

    def _turn_lock(self, point: QPointF) -> bool:
        for name, room in lock_places(self._chart).items():
            if room.contains(point) and (name != "home" or self._chart.moved):
                self._chart.go_home() if name == "home" else self._chart.turn_lock(name)
                return True
        return False

    def on_move(self, event: QMouseEvent) -> bool:
        """Pan while held, and have the crosshair follow."""
        point = event.position()
        if self._panned is None:
            self.point(None if event.buttons() else point)
            return False
        if self._pressed and (point - self._pressed).manhattanLength() < CLICK_PX:
            return True
        self._pressed = None
        self._chart.pan(point - self._panned)
        self._panned = point
        self.point(point)
        return True

    def on_release(self, event: QMouseEvent) -> bool:
        """End a pan, or pin a marker by a click."""
        if self._panned is None:
            return False
        clicked, self._clicked = self._pressed is not None, False
        self._panned = self._pressed = None
        if clicked and self._chart.area.contains(event.position()):
            self._clicked = self._chart.pin(event.position())
        return True

    def on_double_click(self, event: QMouseEvent) -> bool:
        """Go back to the whole plot; the marker that the first click has pinned goes."""
        if event.button() not in (BUTTONS.LeftButton, BUTTONS.MiddleButton):
            return False
        if self._clicked:
            self._chart.unpin_last()
        self._clicked = False
        self._chart.go_home()
        return True

    def on_leave(self, event: QEvent) -> bool:
        """Take the crosshair away."""
        self.point(None)
        return False

    def point(self, at: QPointF | None) -> None:
        """Put the crosshair at a pixel, or take it away."""
        if at != self.at:
            self.at = at
            self._chart.pointed.emit(self._chart.from_pixels(at) if at else None)
            self._chart.update()

    def on_key(self, event: QKeyEvent) -> bool:
        """Zoom, pan, go home, pin, lock; move the crosshair with Ctrl and the arrows."""
        key, held = event.key(), event.modifiers() & ~MODIFIERS.KeypadModifier
        if key in ARROWS:
            return self._on_arrow(ARROWS[KEYS(key)], held)
        if held & ~MODIFIERS.ShiftModifier:
            return False
        if key in ZOOMS:
            self._chart.zoom(self._place(), ZOOMS[KEYS(key)], "xy")
            return True
        return KEYED[KEYS(key)](self) if key in KEYED else False

    def _on_arrow(self, step: tuple[int, int], held: Qt.KeyboardModifier) -> bool:
        shift, control, none = MODIFIERS.ShiftModifier, MODIFIERS.ControlModifier, MODIFIERS.NoModifier
        if held == control:
            self.point(self._place() + QPointF(*step) * STEP_PX)
        elif held == shift or (held == none and not self._chart.takes_arrows):
            area = self._chart.area
            self._chart.pan(QPointF(-step[0] * area.width(), -step[1] * area.height()) * PAN)
        else:
            return False
        return True

    def _place(self) -> QPointF:
        """Return the pixel of the crosshair, else the middle."""
        return self.at or self._chart.area.center()

    def home(self) -> bool:
        """Go back to the whole plot."""
        self._chart.go_home()
        return True

    def pin(self) -> bool:
        """Pin a marker at the crosshair."""
        self._chart.pin(self._place())
        return True

    def lock(self) -> bool:
        """Lock every scale of the plot, or let all change again."""
        self._chart.turn_lock("all")
        return True

    def unpin(self) -> bool:
        """Remove the last marker; other keys' owners have the key where there is none."""
        return self._chart.unpin_last()

    def unpin_all(self) -> bool:
        """Remove all markers."""
        return self._chart.unpin_all()

    def on_help(self, event: QHelpEvent) -> bool:
        """Say what the button under the pointer does."""
        for name, room in lock_places(self._chart).items():
            if room.contains(QPointF(event.pos())) and (name != "home" or self._chart.moved):
                QToolTip.showText(event.globalPos(), tr(LOCK_TIPS[name]), self._chart)
                return True
        return False

    def fill(self, menu: QMenu, point: QPoint) -> None:
        """Add what can be done to a plot to its context menu, asked for at a pixel."""
        chart = self._chart
        menu.addSeparator()
        menu.addAction(tr("Pin a marker here") + "\tP", lambda: chart.pin(QPointF(point)))
        menu.addAction(tr("Remove the markers") + "\tEsc", chart.unpin_all).setEnabled(bool(chart.pins))
        menu.addAction(tr("Zoom in") + "\t+", lambda: chart.zoom(QPointF(point), 1 / ZOOM**3, "xy"))
        menu.addAction(tr("Zoom out") + "\t−", lambda: chart.zoom(QPointF(point), ZOOM**3, "xy"))
        menu.addAction(tr("The whole plot") + "\tHome", chart.go_home).setEnabled(chart.moved)
        lock = menu.addAction(tr("Lock the scale") + "\tL", lambda: chart.turn_lock("all"))
        lock.setCheckable(True)
        lock.setChecked(chart.locked)


KEYED: dict[int, Callable[[Hand], bool]] = {
    KEYS.Key_Home: Hand.home,
    KEYS.Key_P: Hand.pin,
    KEYS.Key_L: Hand.lock,
    **dict.fromkeys((KEYS.Key_Delete, KEYS.Key_Backspace), Hand.unpin),
    KEYS.Key_Escape: Hand.unpin_all,
}
HANDLERS: dict[QEvent.Type, Callable[[Hand, Any], bool]] = {
    QEvent.Type.Wheel: Hand.on_wheel,
    QEvent.Type.MouseButtonPress: Hand.on_press,
    QEvent.Type.MouseMove: Hand.on_move,
    QEvent.Type.MouseButtonRelease: Hand.on_release,
    QEvent.Type.MouseButtonDblClick: Hand.on_double_click,
    QEvent.Type.Leave: Hand.on_leave,
    QEvent.Type.KeyPress: Hand.on_key,
    QEvent.Type.ToolTip: Hand.on_help,
}
