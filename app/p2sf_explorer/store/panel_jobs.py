"""What a panel needs that asks a background worker: ask, show what is there so far, show the rest."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, QTimer

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.store.worker import LatestWins

Tell = Callable[[float, object], None]
HELD_MS = 60  # for which a slider is held still before work that would slow its frames is asked for


class Asking(QObject):
    """Asks ``answer(question, stopped, tell)`` off the window's thread; ``paint(question, answer)`` shows it.

    ``tell(share, answer so far)`` has it painted while it grows. ``say`` is called with the text that ``paint``
    returns, marked while the picture of another question is on screen, or with the reason why there is none.
    """

    def __init__(
        self,
        owner: QObject,
        answer: Callable[[Any, Callable[[], bool], Tell], object],
        paint: Callable[[Any, Any], Message | str],
        say: Callable[[str], None],
    ):
        super().__init__(owner)
        self._answer, self._paint, self._say = answer, paint, say
        self._so_far: dict[object, object] = {}
        self.asked: object = None
        self._shown: tuple[object, object] | None = None
        self._text: Message | str = ""
        self._refusal: Message | P2SFError | None = None
        self._later: object = None
        self._held = QTimer(self, singleShot=True, interval=HELD_MS)
        self._held.timeout.connect(lambda: self.ask(self._later))
        self.worker = LatestWins(self)
        self.worker.finished.connect(self._on_finished)
        self.worker.failed.connect(self._on_failed)
        self.worker.progressed.connect(self._on_progress)

    def ask(self, question: object) -> None:
        """Ask, unless this is what was asked last."""
        self._held.stop()
        if question == self.asked:
            return
        self.asked, self._refusal = question, None
        self._tell()
        self.worker.submit(question, lambda cancelled, progress: self._work(question, cancelled.is_set, progress))

    def ask_when_held(self, question: object) -> None:
        """Ask once no other question has come for `HELD_MS`, since the frames of a slider that moves go first."""
        if question == self.asked:
            return
        self.forget()
        self._later = question
        self._held.start()

    def refuse(self, reason: Message | P2SFError) -> None:
        """Say why there is nothing to ask; what is on its way is no longer wanted."""
        self._held.stop()
        self.asked, self._refusal, self._shown = None, reason, None
        self.worker.cancel()
        self._tell()

    def forget(self) -> None:
        """Want nothing that is on its way, since something else is shown; say nothing."""
        self._held.stop()
        self.asked, self._refusal, self._shown = None, None, None
        self.worker.cancel()

    def again(self) -> None:
        """Paint the present answer once more, for another look at it."""
        if self._shown:
            self._show(*self._shown)

    def _show(self, question: object, answer: object) -> None:
        self._shown = question, answer
        self._text = self._paint(question, answer)
        self._tell()

    def _tell(self) -> None:
        if self._refusal is not None:
            self._say(said(self._refusal))
            return
        text = self._text.text(WINDOW) if isinstance(self._text, Message) else self._text
        earlier = self._shown is not None and self._shown[0] != self.asked
        self._say((text or tr("working")) + (f" · {tr('earlier picture')}" if earlier else ""))

    def _work(self, question: object, stopped: Callable[[], bool], progress: Callable[[float], None]) -> object:
        def tell(share: float, answer: object) -> None:
            self._so_far[question] = answer
            progress(share)

        return self._answer(question, stopped, tell)

    def _on_progress(self, question: object, share: float) -> None:
        if question in self._so_far and question == self.asked:  # of an earlier one only what is whole
            self._show(question, self._so_far[question])

    def _on_finished(self, question: object, answer: object) -> None:
        self._so_far.clear()
        if self.asked is not None:
            self._show(question, answer)

    def _on_failed(self, question: object, message: Message) -> None:
        if question == self.asked:
            self._refusal = message
            self._tell()
