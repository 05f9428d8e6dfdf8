"""Sums the waves of settled pictures that are too slow for a frame, in the background, while others stand in."""

from PySide6.QtCore import QObject

from p2sf.psf.result import Psf
from p2sf_explorer.compute.deferred_sums import SumCache, SumRequest, by_rays
from p2sf_explorer.i18n.messages import spoken
from p2sf_explorer.state.state import State
from p2sf_explorer.workers.worker import LatestWins


class DeferredWorker(QObject):
    """Owns the worker and the ``cache`` of its sums; `watch` is told what a picture waits for."""

    def __init__(self, window):
        super().__init__(window)
        self._window, self.cache = window, SumCache()
        self._state = window.store.state
        self._wanted: SumRequest | None = None
        self.worker = LatestWins(self)
        self.worker.finished.connect(self._on_finished)
        self.worker.failed.connect(self._on_failed)

    def watch(self, state: State, pending: SumRequest | None) -> None:
        """Work on what the picture of a state owes, and on nothing else."""
        self._state = state
        if pending == self._wanted:
            return
        self.worker.cancel()
        self._wanted = pending
        if pending:
            self.worker.submit(pending, lambda cancelled, _: by_rays(pending, cancelled=cancelled.is_set))

    def _on_finished(self, asked: SumRequest, psf: Psf) -> None:
        self.cache.keep(asked, psf)
        if asked == self._wanted:
            self._wanted = None
            self._window.refresh(self._state)

    def _on_failed(self, asked: SumRequest, sentence: str) -> None:
        """Say why there is no picture, and remember it: the same sum would fail again."""
        self.cache.keep(asked, spoken(sentence))
        if asked == self._wanted:
            self._wanted = None
            self._window.refresh(self._state)
            self._window.refuse(sentence)

    def stop(self) -> None:
        """End the worker's thread."""
        self.worker.stop()
