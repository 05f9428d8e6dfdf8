"""What a panel needs that asks a background worker: ask, show what is there so far, show the rest."""

from collections.abc import Callable

from PySide6.QtCore import QObject

from p2sf_explorer.i18n.messages import spoken
from p2sf_explorer.workers.worker import LatestWins

EARLIER, WORKING = " · earlier picture", "working"


class Asking(QObject):
    """Asks ``answer(question, stopped, tell)`` off the window's thread; ``paint(question, found)`` shows it.

    ``tell(share, found so far)`` has it painted while it grows. ``say`` is told the words that ``paint`` returns,
    marked while another question's picture is on screen, or a sentence on why there is none.
    """

    def __init__(self, owner: QObject, answer: Callable, paint: Callable[..., str], say: Callable[[str], None]):
        super().__init__(owner)
        self._answer, self._paint, self._say = answer, paint, say
        self._so_far: dict[object, object] = {}
        self.asked: object = None
        self._shown: tuple[object, object] | None = None
        self._words = self._refusal = ""
        self.worker = LatestWins(self)
        self.worker.finished.connect(self._on_finished)
        self.worker.failed.connect(self._on_failed)
        self.worker.progressed.connect(self._on_progress)

    def ask(self, question) -> None:
        """Ask, unless this is what was asked last."""
        if question == self.asked:
            return
        self.asked, self._refusal = question, ""
        self._tell()
        self.worker.submit(question, lambda cancelled, progress: self._work(question, cancelled, progress))

    def refuse(self, sentence: str) -> None:
        """Say why there is nothing to ask; what is on its way is no longer wanted."""
        self.asked, self._refusal, self._shown = None, spoken(sentence), None
        self.worker.cancel()
        self._tell()

    def again(self) -> None:
        """Paint what is there once more, for another look at it."""
        if self._shown:
            self._show(*self._shown)

    def _show(self, question, found) -> None:
        self._shown = question, found
        self._words = self._paint(question, found)
        self._tell()

    def _tell(self) -> None:
        earlier = EARLIER if self._shown and self._shown[0] != self.asked else ""
        self._say(self._refusal or (self._words or WORKING) + earlier)

    def _work(self, question, cancelled, progress):
        def tell(share: float, found) -> None:
            self._so_far[question] = found
            progress(share)

        return self._answer(question, cancelled.is_set, tell)

    def _on_progress(self, question, share: float) -> None:
        if question in self._so_far and self.asked is not None:
            self._show(question, self._so_far[question])

    def _on_finished(self, question, found) -> None:
        self._so_far.clear()
        if self.asked is not None:
            self._show(question, found)

    def _on_failed(self, question, sentence: str) -> None:
        if question == self.asked:
            self._refusal = spoken(sentence)
            self._tell()
