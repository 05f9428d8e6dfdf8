"""Keep the window for the next start: its state and its geometry."""

import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
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
    """A file that is there while an explorer runs: one that is found without its process was left by a crash."""

    def __init__(self) -> None:
        self._folder = session_path().parent
        self._own = QLockFile(str(self._folder / f"running-{os.getpid()}"))

    def begin(self) -> bool:
        """Set the mark; return whether a run before did not end as it should."""
        with suppress(OSError):  # a folder that cannot be made costs only the memory
            self._folder.mkdir(parents=True, exist_ok=True)
        crashed = [self._left_behind(path) for path in self._folder.glob("running*")]
        self._own.setStaleLockTime(0)
        self._own.tryLock(0)
        return any(crashed)

    def end(self) -> None:
        """Take the mark away: this run ends as it should."""
        self._own.unlock()

    def _left_behind(self, path: Path) -> bool:
        """Return whether a mark has lost its process, and take it away if so."""
        if path.name == f"running-{os.getpid()}":  # of a process that had this one's number
            path.unlink(missing_ok=True)
            return True
        mark = QLockFile(str(path))
        mark.setStaleLockTime(0)  # a mark gets stale by the end of its process, however long that runs
        stale = mark.tryLock(0)
        mark.unlock()
        return stale


def pack(place: QByteArray) -> str:
    """Return Qt's bytes as text."""
    return place.toBase64().toStdString()


def unpack(text: str) -> QByteArray:
    """Return the bytes of `pack`; for any other text, bytes that Qt ignores."""
    return QByteArray.fromBase64(text.encode("ascii", "ignore"))
