"""Films a sweep: the window goes through its frames one by one, a worker writes them."""

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget

from app.film import Frame, Reel, check_film, write_film
from app.sweep import Sweep, changes, sweep
from app.words import tr
from app.worker import LatestWins
from p2sf.errors import P2SFError

FRAMES_PER_S = 12


class Filming(QObject):
    """``start`` films the state's sweep once, from its first value to its last; ``cancel`` leaves no file.

    ``progressed`` tells the part done, ``ended`` a sentence: what was written, or why not. The state stays as it is.
    """

    progressed, ended = Signal(float), Signal(str)

    def __init__(self, window):
        super().__init__(window)
        self._window, self._worker = window, LatestWins(self)
        self._worker.finished.connect(lambda key, paths: self._end(self._written(paths)))
        self._worker.failed.connect(lambda key, sentence: self._end(sentence))
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._next)
        self._reel, self._number, self._count = Reel(), 0, 0
        self._sweep: Sweep | None = None
        self._subject: QWidget = window

    @property
    def busy(self) -> bool:
        """Return whether a film is being made."""
        return self._worker.busy

    def start(self, path: str, subject: QWidget | None = None) -> bool:
        """Film to a .gif or numbered .png files, of the window or one of its parts; return whether it began."""
        state = self._window.store.state
        try:
            check_film(path)
        except P2SFError as error:
            self._window.refuse(str(error))
            return False
        self._subject, self._sweep, self._reel = subject or self._window, sweep(state), Reel()
        self._number, self._count = 0, max(2, round(FRAMES_PER_S * state.play_seconds))
        self._window.measuring.rest(True)
        reel, frame_ms = self._reel, round(1000 / FRAMES_PER_S)
        self._worker.submit(path, lambda cancelled, _: write_film(reel.frames(cancelled), path, frame_ms))
        self._timer.start(0)
        return True

    def cancel(self) -> None:
        """Stop, and leave no file."""
        self._timer.stop()
        self._worker.cancel()

    def stop(self) -> None:
        """End the worker's thread."""
        self._timer.stop()
        self._worker.stop()

    def _next(self) -> None:
        """Show and hand over one frame, unless the writer is behind."""
        if self._reel.full:
            return
        if self._number == self._count:
            self._timer.stop()
            self._reel.put(None)
            return
        state = self._window.store.state
        moved = changes(state, self._sweep.value(self._number / (self._count - 1)))
        self._window.refresh(self._window.store.changed_by(moved))
        self._reel.put(frame_of(self._subject))
        self._number += 1
        self.progressed.emit(self._number / self._count)

    def _written(self, paths) -> str:
        if len(paths) == 1:
            return tr("Saved {name}", name=paths[0].name)
        return tr("Saved {count} frames, {first} to {last}", count=len(paths), first=paths[0].name, last=paths[-1].name)

    def _end(self, sentence: str) -> None:
        self._timer.stop()
        self._window.measuring.rest(False)
        self._window.refresh(self._window.store.state)
        self.ended.emit(sentence)


def frame_of(widget: QWidget) -> Frame:
    """Return a widget's picture."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    rows = bytes(image.constBits())
    line, width = image.bytesPerLine(), 3 * image.width()
    packed = rows if line == width else b"".join(rows[k * line : k * line + width] for k in range(image.height()))
    return Frame(image.width(), image.height(), packed)
