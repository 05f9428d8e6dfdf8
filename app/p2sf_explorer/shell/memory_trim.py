"""Memory given back to the system: what a burst of frames has freed, the C library would keep to the end."""

import ctypes
import sys
from collections.abc import Callable
from threading import Thread

from PySide6.QtCore import QObject, QTimer

REST_MS = 2_000  # so long after the last change a hand is taken to rest
LATEST_MS = 20_000  # a hand that never rests waits for the allocator's lock this seldom, some ms at a time


class MemoryTrim(QObject):
    """Gives freed memory back when the window rests, off the GUI thread; ``touch`` it at every change."""

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._rest, self._latest = QTimer(self), QTimer(self)
        for timer, pause in ((self._rest, REST_MS), (self._latest, LATEST_MS)):
            timer.setSingleShot(True)
            timer.setInterval(pause)
            timer.timeout.connect(self._on_time)

    def touch(self) -> None:
        """Note that something was computed, and freed."""
        self._rest.start()
        if not self._latest.isActive():
            self._latest.start()

    def stop(self) -> None:
        """Give back nothing more."""
        self._rest.stop()
        self._latest.stop()

    def _on_time(self) -> None:
        self.stop()
        if trim := trimming():
            Thread(target=trim, args=(0,), daemon=True).start()


def trimming() -> Callable[[int], int] | None:
    """Return glibc's malloc_trim(3), which returns free pages in the middle of its heaps too; None without glibc."""
    return getattr(ctypes.CDLL(None), "malloc_trim", None) if sys.platform == "linux" else None
