"""Returns freed memory to the system: the C library would keep what a burst of frames has freed."""

import ctypes
import sys
from collections.abc import Callable
from threading import Thread

from PySide6.QtCore import QObject, QTimer

REST_MS = 2_000  # after the last change
LATEST_MS = 20_000  # while changes go on: trimming holds the allocator's lock for some ms


class MemoryTrim(QObject):
    """Trims the heap, off the GUI thread, when nothing has changed for a while; call ``touch`` at every change."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._rest, self._latest = QTimer(self), QTimer(self)
        for timer, pause in ((self._rest, REST_MS), (self._latest, LATEST_MS)):
            timer.setSingleShot(True)
            timer.setInterval(pause)
            timer.timeout.connect(self._on_time)

    def touch(self) -> None:
        """Note that something was computed, and memory freed."""
        self._rest.start()
        if not self._latest.isActive():
            self._latest.start()

    def stop(self) -> None:
        """Trim no more until the next change."""
        self._rest.stop()
        self._latest.stop()

    def _on_time(self) -> None:
        self.stop()
        if trim := trimming():
            Thread(target=trim, args=(0,), daemon=True).start()


def trimming() -> Callable[[int], int] | None:
    """Return malloc_trim(3) of glibc, which also returns free pages in the middle of its heaps; None without glibc."""
    return getattr(ctypes.CDLL(None), "malloc_trim", None) if sys.platform == "linux" else None
