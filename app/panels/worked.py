"""What a panel needs that asks a background worker: ask, show what is there so far, show the rest."""

from collections.abc import Callable

from PySide6.QtCore import QObject

from app.worker import LatestWins


class Asking(QObject):
    """Asks ``answer(question, stopped, tell)`` off the window's thread; ``paint(question, found)`` shows it.

    ``tell(share, found so far)`` has it painted while it grows. ``failed(sentence)`` says why there is none.
    """

    def __init__(self, owner: QObject, answer: Callable, paint: Callable, failed: Callable[[str], None]):
        super().__init__(owner)
        self._answer, self._paint = answer, paint
        self._so_far: dict[object, object] = {}
        self.asked: object = None
        self.worker = LatestWins(self)
        self.worker.finished.connect(self._on_finished)
        self.worker.failed.connect(lambda key, sentence: failed(sentence))
        self.worker.progressed.connect(self._on_progress)

    def ask(self, question) -> None:
        """Ask, unless this is what was asked last."""
        if question == self.asked:
            return
        self.asked = question
        self.worker.submit(question, lambda cancelled, progress: self._work(question, cancelled, progress))

    def _work(self, question, cancelled, progress):
        def tell(share: float, found) -> None:
            self._so_far[question] = found
            progress(share)

        return self._answer(question, cancelled.is_set, tell)

    def _on_progress(self, question, share: float) -> None:
        if question in self._so_far:
            self._paint(question, self._so_far[question])

    def _on_finished(self, question, found) -> None:
        self._so_far.clear()
        self._paint(question, found)
