"""Films a sweep: the window goes through its frames one by one, a worker writes them."""

from dataclasses import replace

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget

from p2sf.errors import P2SFError
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.playback.film import FilmFrame, Reel, check_film, write_film
from p2sf_explorer.playback.sweep import changes, sweep
from p2sf_explorer.state.pinning import with_links
from p2sf_explorer.state.state import State
from p2sf_explorer.workers.live_accuracy import asked_for
from p2sf_explorer.workers.worker import LatestWins

FRAMES_PER_S = 12
TICK_MS = 4  # between looks at what is being computed


class Filming(QObject):
    """``start`` films the state's sweep once, from its first value to its last; ``cancel`` leaves no file.

    Each frame waits for the panels that fill in the background. What changes meanwhile is not filmed: the moments are
    those of the state at the start. ``progressed`` tells the part done, ``ended`` a sentence: what was written, or why
    not. The state stays as it is.
    """

    progressed, ended = Signal(float), Signal(str)

    def __init__(self, window):
        super().__init__(window)
        self._window, self._worker = window, LatestWins(self)
        self._worker.finished.connect(lambda key, paths: self._end(self._written(paths)))
        self._worker.failed.connect(lambda key, message: self._end(said(message)))
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._next)
        self._reel, self._number, self._shown = Reel(), 0, False
        self._moments: tuple[State, ...] = ()
        self._subject: QWidget = window
        window.store.changed.connect(self._disturb)

    @property
    def busy(self) -> bool:
        """Return whether a film is being made."""
        return self._worker.busy

    def start(self, path: str, subject: QWidget | None = None) -> bool:
        """Film to a .gif or numbered .png files, of the window or one of its parts; return whether it began."""
        state = self._window.store.state
        try:
            check_film(path)
            self._moments = moments(state)
        except P2SFError as error:
            self._window.refuse(str(error))
            return False
        self._subject, self._reel = subject or self._window, Reel()
        self._number, self._shown = 0, False
        self._window.measuring.rest(not asked_for(state))
        reel, frame_ms = self._reel, round(1000 / FRAMES_PER_S)
        self._worker.submit(path, lambda cancelled, _: write_film(reel.frames(cancelled), path, frame_ms))
        self._timer.start(TICK_MS)
        return True

    def cancel(self) -> None:
        """Stop, and leave no file."""
        self._timer.stop()
        self._worker.cancel()

    def stop(self) -> None:
        """End the worker's thread."""
        self._timer.stop()
        self._worker.stop()

    def _disturb(self) -> None:
        """Note that the window shows something else than the moment to be filmed."""
        self._shown = False

    def _next(self) -> None:
        """Show a moment, and hand over its frame once all of it is there, unless the writer is behind."""
        if self._reel.full:
            return
        if self._number == len(self._moments):
            self._timer.stop()
            self._reel.put(None)
            return
        if not self._shown:
            self._shown = True
            self._window.refresh(self._moments[self._number])
        if not self._shown or self._filling():
            return
        self._reel.put(frame_of(self._subject))
        self._number, self._shown = self._number + 1, False
        self.progressed.emit(self._number / len(self._moments))

    def _filling(self) -> bool:
        """Return whether something on show is still being computed."""
        panels = self._window.panels.values()
        workers = [worker for panel in panels for worker in panel.widget.findChildren(LatestWins)]
        own = self._window.measuring.worker, self._window.settling.worker
        return any(worker.busy for worker in (*workers, *own))

    def _written(self, paths) -> str:
        if len(paths) == 1:
            return tr("Saved {name}", name=paths[0].name)
        return tr("Saved {count} frames, {first} to {last}", count=len(paths), first=paths[0].name, last=paths[-1].name)

    def _end(self, sentence: str) -> None:
        self._timer.stop()
        self._window.measuring.rest(False)
        self._window.refresh(self._window.store.state)
        self.ended.emit(sentence)


def moments(state: State) -> tuple[State, ...]:
    """Return the states of a film's frames: the state's sweep once, its links moving along."""
    way, count = sweep(state), max(2, round(FRAMES_PER_S * state.play_seconds))
    moved = (changes(state, way.value(number / (count - 1))) for number in range(count))
    return tuple(replace(state, **with_links(state, each)) for each in moved)


def frame_of(widget: QWidget) -> FilmFrame:
    """Return a widget's picture."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    rows = bytes(image.constBits())
    line, width = image.bytesPerLine(), 3 * image.width()
    packed = rows if line == width else b"".join(rows[k * line : k * line + width] for k in range(image.height()))
    return FilmFrame(image.width(), image.height(), packed)
