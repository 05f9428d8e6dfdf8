"""Sums the waves of settled pictures in the background where that is too slow for a frame."""

from collections.abc import Callable

from PySide6.QtCore import QObject

from p2sf.messages import Message
from p2sf.psf.result import Psf
from p2sf_explorer.compute.deferred_sums import Request, SumCache, answer_to
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store
from p2sf_explorer.store.worker import LatestWins


class DeferredWorker(QObject):
    """Owns the worker and the ``cache`` of its sums; `watch` is called with the sum that a picture waits for.

    ``refresh(state)`` shows a state anew once the sum of its picture is there.
    """

    def __init__(self, store: Store, refresh: Callable[[State], None], parent: QObject) -> None:
        super().__init__(parent)
        self._store, self._refresh, self.cache = store, refresh, SumCache()
        self._state = store.state
        self._pending: Request | None = None
        self.worker = LatestWins(self)
        self.worker.finished.connect(self._on_finished)
        self.worker.failed.connect(self._on_failed)

    def watch(self, state: State, pending: Request | None) -> None:
        """Compute the pending sum of a state's picture, and nothing else."""
        self._state = state
        if pending == self._pending:
            return
        self.worker.cancel()
        self._pending = pending
        if pending:
            self.worker.submit(pending, lambda cancelled, _: answer_to(pending, cancelled.is_set))

    def _on_finished(self, request: Request, found: Psf | float) -> None:
        self.cache.keep(request, found)
        if request == self._pending:
            self._pending = None
            self._refresh(self._state)

    def _on_failed(self, request: Request, message: Message) -> None:
        """Say why there is no picture, and remember it: the same sum would fail again."""
        self.cache.keep(request, message)
        if request == self._pending:
            self._pending = None
            self._refresh(self._state)
            self._store.refused.emit(message)

    def stop(self) -> None:
        """End the worker's thread."""
        self.worker.stop()
