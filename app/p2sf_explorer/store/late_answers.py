"""Answers too slow for a frame: worked out off the window's thread, for the latest question, and shown as they come."""

from collections.abc import Callable
from functools import partial
from threading import Event
from typing import Any, Protocol

from PySide6.QtCore import QObject, QThread, QTimer, Signal, Slot

from p2sf.errors import Cancelled, P2SFError
from p2sf.messages import Message
from p2sf_explorer.compute.live import View
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.i18n.tr import tr

HELD_MS = 60  # for which a slider is held still before work that would slow its frames is begun


class Tell(Protocol):
    """Tells how far a job is, 0 to 1, and what of its answer is there so far."""

    def __call__(self, share: float, so_far: object = None, /) -> None:
        """Tell it."""


Job = Callable[[Event, Tell], object]
"""What runs off the window's thread: given a cancel flag to look at and a way to tell how far it is, it answers."""


class _Runner(QObject):
    finished = Signal(object, object)
    failed = Signal(object, Message)
    gave_up = Signal()
    progressed = Signal(object, float, object)

    @Slot(object, object, object)
    def run(self, question: object, job: Job, cancelled: Event) -> None:
        def tell(share: float, so_far: object = None) -> None:
            self.progressed.emit(question, share, so_far)

        end: Callable[[], object] = self.gave_up.emit  # after an unexpected error too: the next job is to run
        try:
            end = partial(self.finished.emit, question, job(cancelled, tell))
        except P2SFError as error:
            if not isinstance(error, Cancelled):
                end = partial(self.failed.emit, question, error.message)
        finally:
            end()


class LateAnswers(QObject):
    """Has the latest question answered in one background thread: one is worked on, one waits.

    A question holds all that its answer depends on, and equal questions have one answer. A new question takes the place
    of the one that waits, never of the one that is worked on: during a drag old answers are better than none.

    ``finished(question, answer)`` is emitted for every answer, of an earlier question too, ``failed(question,
    message)`` for the question ``asked`` last. A job that ends with `Cancelled` is no failure and emits nothing: its
    question may have been asked again. After `stop` nothing is emitted.

    ``answer(question, stopped, tell)`` is what `ask` runs. ``paint(question, answer)`` shows an answer, whole or what
    ``tell(share, so far)`` has of it, as long as one is wanted. ``say`` is called with the text that ``paint``
    returns, marked while the picture of another question is on screen, or with the reason why there is none.
    ``held_ms``: how long a question stands in `ask_when_held` before it is asked.
    """

    finished = Signal(object, object)
    failed = Signal(object, Message)
    progressed = Signal(object, float)
    _start = Signal(object, object, object)

    def __init__(
        self,
        owner: QObject | None = None,
        answer: Callable[[Any, Callable[[], bool], Tell], object] | None = None,
        paint: Callable[[Any, Any], Message | str] | None = None,
        say: Callable[[str], None] = lambda text: None,
        held_ms: int = HELD_MS,
    ):
        super().__init__(owner)
        self._answer, self._paint, self._say = answer, paint, say
        self.asked: object = None
        self._shown: tuple[object, object] | None = None
        self._text: Message | str = ""
        self._refusal: Message | P2SFError | None = None
        self._later: object = None
        self._held = QTimer(self, singleShot=True, interval=held_ms)
        self._held.timeout.connect(lambda: self.ask(self._later))
        self._thread, self._runner = QThread(self), _Runner()
        self._runner.moveToThread(self._thread)
        self._start.connect(self._runner.run)
        self._runner.finished.connect(self._on_finished)
        self._runner.failed.connect(self._on_failed)
        self._runner.gave_up.connect(self._on_gave_up)
        self._runner.progressed.connect(self._on_progress)
        self._waiting: tuple[object, Job] | None = None
        self._cancelled: Event | None = None
        self._stopped = False

    @property
    def busy(self) -> bool:
        """Return whether a job is running, or will once its question has been held."""
        return self._cancelled is not None or self._held.isActive()

    def ask(self, question: object) -> None:
        """Ask, unless this is what was asked last and has not been cancelled."""
        if (question != self.asked or self._is_cancelled()) and (answer := self._answer):
            self.submit(question, lambda cancelled, tell: answer(question, cancelled.is_set, tell))

    def ask_when_held(self, question: object) -> None:
        """Ask once no other question has come for ``held_ms``, since the frames of a slider that moves go first.

        What is on its way is no longer wanted; the picture on screen stays, marked as an earlier one.
        """
        if question == (self._later if self._held.isActive() else self.asked):
            return
        self.cancel()
        self.asked, self._refusal, self._later = None, None, question
        self._held.start()
        self._tell()

    def let_go(self) -> None:
        """Do not ask what is held; what runs goes on."""
        self._held.stop()

    def follow(self, view: View[Any]) -> None:
        """Ask what a view leaves to be asked, at once or once it is held; where nothing is left, want nothing more.

        What is answered already is painted once more, since the panel has begun anew.
        """
        if view.question is None:
            self.forget()
        elif self._shown and self._shown[0] == view.question == self.asked:
            self.again()
        else:
            (self.ask_when_held if view.held else self.ask)(view.question)

    def submit(self, question: object, job: Job) -> None:
        """Run a job for a question now if nothing runs, else next, whatever was asked last; after the end drop it."""
        if self._stopped:
            return
        self.let_go()
        self.asked, self._refusal = question, None
        self._waiting = (question, job)
        if self._cancelled is None:
            self._next()
        self._tell()

    def refuse(self, reason: Message | P2SFError) -> None:
        """Say why there is nothing to ask; what is on its way is no longer wanted."""
        self.forget()
        self._refusal = reason
        self._tell()

    def forget(self) -> None:
        """Want nothing that is on its way, since something else is shown; say nothing."""
        self.let_go()
        self.asked, self._refusal, self._shown, self._text = None, None, None, ""
        self.cancel()

    def again(self) -> None:
        """Paint the present answer once more, for another look at it."""
        if self._shown:
            self._show(*self._shown)

    def cancel(self) -> None:
        """Ask the running job to stop and drop the waiting one; what comes of it all the same is not painted."""
        self._waiting = None
        if self._cancelled:
            self._cancelled.set()

    def stop(self) -> None:
        """End the thread for good; call before the application ends."""
        self._stopped = True
        self.blockSignals(True)
        self.forget()
        self._thread.quit()
        self._thread.wait()
        self._cancelled = None  # nothing more is heard of a job that had not begun

    def _show(self, question: object, answer: object) -> None:
        if self._paint:
            self._shown = question, answer
            self._text = self._paint(question, answer)
            self._tell()

    def _tell(self) -> None:
        if self._refusal is not None:
            self._say(said(self._refusal))
            return
        text = self._text.text(WINDOW) if isinstance(self._text, Message) else self._text
        earlier = self._shown is not None and self._shown[0] != self.asked
        self._say((text or (tr("working") if self.busy else "")) + (f" · {tr('earlier picture')}" if earlier else ""))

    def _next(self) -> None:
        if self._waiting is None:
            return
        (question, job), self._waiting = self._waiting, None
        if not self._thread.isRunning():
            self._thread.start(QThread.Priority.LowPriority)
        self._cancelled = Event()
        self._start.emit(question, job, self._cancelled)

    def _is_cancelled(self) -> bool:
        """Return whether a job runs that was asked to stop."""
        return self._cancelled is not None and self._cancelled.is_set()

    def _end(self) -> None:
        """Note that the running job has ended; the question of one that was cancelled may be asked again."""
        if self._is_cancelled() and self._waiting is None:
            self.asked = None
        self._cancelled = None

    @Slot(object, float, object)
    def _on_progress(self, question: object, share: float, so_far: object) -> None:
        if so_far is not None and question == self.asked and not self._is_cancelled():  # of an earlier one the whole
            self._show(question, so_far)
        self.progressed.emit(question, share)

    @Slot(object, object)
    def _on_finished(self, question: object, answer: object) -> None:
        wanted = self.asked is not None and not self._is_cancelled()
        self._end()
        if wanted:
            self._show(question, answer)
        self.finished.emit(question, answer)
        self._next()

    @Slot(object, Message)
    def _on_failed(self, question: object, message: Message) -> None:
        wanted = question == self.asked
        self._end()
        if wanted:
            self._refusal = message
            self._tell()
            self.failed.emit(question, message)
        self._next()

    @Slot()
    def _on_gave_up(self) -> None:
        self._end()
        if self.asked is not None and self._waiting is None:  # after an unexpected error
            self.asked = None
            self._tell()
        self._next()
