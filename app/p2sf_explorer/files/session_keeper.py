"""Keeps the window for the next start: its state, its place, how its room is shared."""

from PySide6.QtCore import QByteArray, QEvent, QObject, QTimer

from p2sf_explorer.files.session import keep_session

OWN = "own "  # before a panel's key: the window it stands in
LATER_MS = 1500  # after the last change, so that a crash costs no more than that


class SessionKeeper(QObject):
    """Writes the session a moment after every change, and when the window closes."""

    def __init__(self, window, geometry: dict[str, str]):
        super().__init__(window)
        self._window = window
        window.restoreGeometry(unpacked(geometry.get("window", "")))
        window.stack.restoreState(unpacked(geometry.get("stack", "")))
        for key, own in window.floating.open.items():
            own.restoreGeometry(unpacked(geometry.get(OWN + key, "")))
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.keep)
        window.store.changed.connect(lambda state: self._timer.start(LATER_MS))
        window.installEventFilter(self)

    def eventFilter(self, watched, event) -> bool:
        """Write the session when the window closes."""
        if event.type() == QEvent.Type.Close:
            self.keep()
        return False

    def keep(self) -> None:
        """Write the session now."""
        self._timer.stop()
        places = {"window": self._window.saveGeometry(), "stack": self._window.stack.saveState()}
        places |= {OWN + key: place for key, place in self._window.floating.present_places().items()}
        keep_session(self._window.store.state, {name: packed(place) for name, place in places.items()})


def packed(place: QByteArray) -> str:
    """Return Qt's bytes as text."""
    return bytes(place.toBase64()).decode("ascii")


def unpacked(text: str) -> QByteArray:
    """Return the bytes of `packed`; of any other text some that Qt refuses in silence."""
    return QByteArray.fromBase64(text.encode("ascii", "ignore"))
