"""Keep the window for the next start: its state and its geometry."""

from collections.abc import Callable, Mapping

from PySide6.QtCore import QByteArray, QEvent, QObject, QTimer
from PySide6.QtWidgets import QWidget

from p2sf_explorer.files.session import keep_session
from p2sf_explorer.store.store import Store

OWN = "own "  # before a panel's key: the window it stands in
LATER_MS = 1500  # after the last change, so that a crash costs no more than that


class SessionKeeper(QObject):
    """Writes the session a moment after every change, and when the window closes.

    ``open_windows()`` are the panels' own windows by their keys; ``geometry`` is as `last_session` returned it.
    """

    def __init__(
        self,
        window: QWidget,
        store: Store,
        open_windows: Callable[[], Mapping[str, QWidget]],
        geometry: dict[str, str],
    ) -> None:
        super().__init__(window)
        self._window, self._store, self._open_windows = window, store, open_windows
        window.restoreGeometry(unpacked(geometry.get("window", "")))
        for key, own in open_windows().items():
            own.restoreGeometry(unpacked(geometry.get(OWN + key, "")))
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.keep)
        store.changed.connect(lambda state: self._timer.start(LATER_MS))
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Write the session when the window closes."""
        if event.type() == QEvent.Type.Close:
            self.keep()
        return False

    def keep(self) -> None:
        """Write the session now."""
        self._timer.stop()
        places = {"window": self._window.saveGeometry()}
        places |= {OWN + key: own.saveGeometry() for key, own in self._open_windows().items()}
        keep_session(self._store.state, {name: packed(place) for name, place in places.items()})


def packed(place: QByteArray) -> str:
    """Return Qt's bytes as text."""
    return place.toBase64().toStdString()


def unpacked(text: str) -> QByteArray:
    """Return the bytes of `packed`; for any other text, bytes that Qt ignores."""
    return QByteArray.fromBase64(text.encode("ascii", "ignore"))
