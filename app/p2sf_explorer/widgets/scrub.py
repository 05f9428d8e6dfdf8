"""Changing a number by hand without typing: a horizontal drag, the wheel, or keys, in one step of undo.

Shift makes every move ten times as coarse, Alt ten times as fine.
"""

from collections.abc import Container

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QWheelEvent

COARSE, FINE = 10.0, 0.1
TRAVEL_PER_PX = 1 / 400
TRAVEL_PER_NOTCH = 1 / 200  # of the wheel, and for an arrow key
NOTCH = 120  # Qt's angle of one
HOLD_PX = 4  # a shorter move of the hand is a click
REST_MS = 500  # after a notch or a key, until the move counts as ended


def speed(modifiers: Qt.KeyboardModifier) -> float:
    """Return how much faster than usual a hand moves a value."""
    if modifiers & Qt.KeyboardModifier.AltModifier:
        return FINE
    return COARSE if modifiers & Qt.KeyboardModifier.ShiftModifier else 1.0


def notches(event: QWheelEvent) -> float:
    """Return how far a wheel has been turned; with Alt, Qt turns it sideways."""
    turned = event.angleDelta()
    return (turned.y() or turned.x()) / NOTCH


def claimed(event: QEvent, arrows: Container[int], moving: bool, fine: bool) -> bool:
    """Claim a key from the window's shortcuts: Escape while a value is moving, and with ``fine`` Alt and an arrow.

    Without ``fine``, Alt and an arrow turn the pages of a lesson.
    """
    if not isinstance(event, QKeyEvent) or event.type() != QEvent.Type.ShortcutOverride:
        return False
    by_alt = fine and event.key() in arrows and bool(event.modifiers() & Qt.KeyboardModifier.AltModifier)
    if by_alt or (moving and event.key() == Qt.Key.Key_Escape):
        event.accept()
        return True
    return False


class Scrub(QObject):
    """One move at a time: ``begun``, ``moved`` with the whole travel since then, then ``ended`` or ``cancelled``."""

    begun, ended, cancelled = Signal(), Signal(), Signal()
    moved = Signal(float)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.active = False
        self._x: float | None = None
        self._travel = 0.0
        self._rest = QTimer(self, singleShot=True, interval=REST_MS)
        self._rest.timeout.connect(self.end)

    def press(self, x: float) -> None:
        """Get ready for a drag from a pixel."""
        self.end()
        self._x = x

    @property
    def pressed(self) -> bool:
        """Return whether a button is held, be it moved or not."""
        return self._x is not None

    def drag(self, x: float, modifiers: Qt.KeyboardModifier) -> None:
        """Follow the pointer, once it has moved far enough to be no click."""
        if self._x is None or (not self.active and abs(x - self._x) < HOLD_PX):
            return
        self._go((x - self._x) * TRAVEL_PER_PX * speed(modifiers))
        self._x = x

    def step(self, count: float, modifiers: Qt.KeyboardModifier) -> None:
        """Move by notches of the wheel or presses of an arrow key."""
        self._go(count * TRAVEL_PER_NOTCH * speed(modifiers))
        self._rest.start()

    def _go(self, travel: float) -> None:
        if not self.active:
            self.active, self._travel = True, 0.0
            self.begun.emit()
        self._travel += travel
        self.moved.emit(self._travel)

    def end(self) -> bool:
        """End the move; return whether there was one."""
        was, self.active, self._x = self.active, False, None
        self._rest.stop()
        if was:
            self.ended.emit()
        return was

    def cancel(self) -> bool:
        """Give up the move; return whether there was one."""
        was, self.active, self._x = self.active, False, None
        self._rest.stop()
        if was:
            self.cancelled.emit()
        return was
