"""Events that QTest cannot send: letters of any alphabet, repeats of a held key, turns of the wheel."""

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QKeyEvent, QWheelEvent
from PySide6.QtWidgets import QApplication


def type_text(edit, text: str) -> None:
    """Type any characters; QTest's own typing ends the process at the first that is not ASCII."""
    for letter in text:
        for kind in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
            QApplication.sendEvent(edit, QKeyEvent(kind, 0, Qt.KeyboardModifier.NoModifier, letter))


def send_key(widget, key, repeated: bool) -> None:
    """Send one press of a key, or one repeat of a held one."""
    none = Qt.KeyboardModifier.NoModifier
    QApplication.sendEvent(widget, QKeyEvent(QEvent.Type.KeyPress, key, none, "", repeated))


def choose(box, value) -> None:
    """Choose an item of a combo box as a person does: Qt then says that it was activated."""
    box.setCurrentIndex(box.findData(value))
    box.activated.emit(box.currentIndex())


def turn_wheel(widget, place: QPoint, angle: int) -> None:
    at, none = QPointF(place), Qt.KeyboardModifier.NoModifier
    phase = Qt.ScrollPhase.NoScrollPhase
    screen, turned = QPointF(widget.mapToGlobal(place)), QPoint(0, angle)
    turn = QWheelEvent(at, screen, QPoint(), turned, Qt.MouseButton.NoButton, none, phase, False)
    QApplication.sendEvent(widget, turn)
