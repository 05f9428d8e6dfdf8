"""Keep the window for the next start: its state and its geometry."""

from collections.abc import Callable, Mapping
from threading import Condition, Lock, Thread
from time import sleep

from PySide6.QtCore import QByteArray, QEvent, QLockFile, QObject
from PySide6.QtWidgets import QWidget

from p2sf_explorer.files.session import Session, keep_session, session_path
from p2sf_explorer.store.store import Store

OWN = "own "  # before a panel's key: the window it stands in
EVERY_S = 0.25  # between two writings while changes go on: a crash costs less than a second


class SessionKeeper(QObject):
    """Writes the session after every change, while changes go on a few times a second, and when the window closes.

    A thread of its own writes, so that neither a disk holds up the window nor a long frame the writing.
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
        window.restoreGeometry(unpack(geometry.get("window", "")))
        for key, own in open_windows().items():
            own.restoreGeometry(unpack(geometry.get(OWN + key, "")))
        self._waiting: Session | None = None
        self._closed = False
        self._changed, self._writing = Condition(), Lock()
        Thread(target=self._write_on, name="session", daemon=True).start()
        store.changed.connect(self._on_change)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Write the session when the window closes."""
        if event.type() == QEvent.Type.Close:
            self.keep()
            self.stop()
        return False

    def keep(self) -> bool:
        """Write the session now; return whether that was possible."""
        with self._writing:
            self._take()
            return keep_session(*self._session())

    def stop(self) -> None:
        """Write no more."""
        with self._changed:
            self._closed = True
            self._changed.notify()

    def _session(self) -> Session:
        places = {"window": self._window.saveGeometry()}
        places |= {OWN + key: own.saveGeometry() for key, own in self._open_windows().items()}
        return self._store.state, {name: pack(place) for name, place in places.items()}

    def _on_change(self) -> None:
        with self._changed:
            self._waiting = self._session()
            self._changed.notify()

    def _take(self) -> Session | None:
        with self._changed:
            found, self._waiting = self._waiting, None
        return found

    def _write_on(self) -> None:
        """Write what waits, the latest of it, until the end."""
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._waiting)
                if self._closed:
                    return
            with self._writing:  # taken within, so that nothing older is written after `keep`
                if session := self._take():
                    keep_session(*session)
            sleep(EVERY_S)


class RunMark:
    """A file that is there while the explorer runs: one that is found at the start was left by a crash.

    A second explorer beside the first has no mark of its own.
    """

    def __init__(self) -> None:
        path = session_path().with_name("running")
        self._lock, self._found = QLockFile(str(path)), path.exists()
        self._lock.setStaleLockTime(0)  # a mark gets stale by the end of its process, however long that runs

    def begin(self) -> bool:
        """Set the mark; return whether the last run did not end as it should."""
        return self._lock.tryLock(0) and self._found

    def end(self) -> None:
        """Take the mark away: this run ends as it should."""
        self._lock.unlock()


def pack(place: QByteArray) -> str:
    """Return Qt's bytes as text."""
    return place.toBase64().toStdString()


def unpack(text: str) -> QByteArray:
    """Return the bytes of `pack`; for any other text, bytes that Qt ignores."""
    return QByteArray.fromBase64(text.encode("ascii", "ignore"))
