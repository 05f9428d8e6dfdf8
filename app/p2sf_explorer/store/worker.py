"""Work too slow for a frame: one job running, one waiting, every finished result shown."""

from collections.abc import Callable
from functools import partial
from threading import Event

from PySide6.QtCore import QObject, QThread, Signal, Slot

from p2sf.errors import Cancelled, P2SFError
from p2sf.messages import Message

Job = Callable[[Event, Callable[[float], None]], object]
"""What a worker runs: given a cancel flag to look at and a progress function (0 to 1), it returns a result."""


class _Runner(QObject):
    finished = Signal(object, object)
    failed = Signal(object, Message)
    gave_up = Signal()
    progressed = Signal(object, float)

    @Slot(object, object, object)
    def run(self, key: object, job: Job, cancelled: Event) -> None:
        end: Callable[[], object] = self.gave_up.emit  # after an unexpected error too: the next job is to run
        try:
            end = partial(self.finished.emit, key, job(cancelled, lambda part: self.progressed.emit(key, part)))
        except P2SFError as error:
            if not isinstance(error, Cancelled):
                end = partial(self.failed.emit, key, error.message)
        finally:
            end()


class LatestWins(QObject):
    """One background thread. ``submit`` replaces the job that waits, never the one that runs.

    ``finished(key, result)`` is emitted for every job that ends, stale or not: during a drag old answers are
    better than none, and the receiver compares ``key`` with what it shows. ``failed(key, message)`` likewise. A job
    that ends with `Cancelled` is no failure and emits nothing: its key may have been submitted again.
    """

    finished = Signal(object, object)
    failed = Signal(object, Message)
    progressed = Signal(object, float)
    _start = Signal(object, object, object)

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._thread = QThread(self)
        self._runner = _Runner()
        self._runner.moveToThread(self._thread)
        self._start.connect(self._runner.run)
        self._runner.finished.connect(self._on_finished)
        self._runner.failed.connect(self._on_failed)
        self._runner.gave_up.connect(self._on_gave_up)
        self._runner.progressed.connect(self.progressed)
        self._waiting: tuple[object, Job] | None = None
        self._cancelled: Event | None = None
        self._stopped = False

    @property
    def busy(self) -> bool:
        """Return whether a job is running."""
        return self._cancelled is not None

    def submit(self, key: object, job: Job) -> None:
        """Run the job now if nothing runs, else next; a job that waited is dropped, and one after the end too."""
        if self._stopped:
            return
        self._waiting = (key, job)
        if not self.busy:
            self._next()

    def cancel(self) -> None:
        """Ask the running job to stop and forget the waiting one."""
        self._waiting = None
        if self._cancelled:
            self._cancelled.set()

    def stop(self) -> None:
        """End the thread for good; call before the application ends."""
        self._stopped = True
        self.cancel()
        self._thread.quit()
        self._thread.wait()

    def _next(self) -> None:
        if self._waiting is None:
            return
        (key, job), self._waiting = self._waiting, None
        if not self._thread.isRunning():
            self._thread.start(QThread.Priority.LowPriority)
        self._cancelled = Event()
        self._start.emit(key, job, self._cancelled)

    @Slot(object, object)
    def _on_finished(self, key: object, result: object) -> None:
        self._cancelled = None
        self.finished.emit(key, result)
        self._next()

    @Slot(object, Message)
    def _on_failed(self, key: object, message: Message) -> None:
        self._cancelled = None
        self.failed.emit(key, message)
        self._next()

    @Slot()
    def _on_gave_up(self) -> None:
        self._cancelled = None
        self._next()
