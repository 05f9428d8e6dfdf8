"""Measures every settled picture against the Huygens reference in the background, for the panels that show it."""

from typing import Any

from PySide6.QtCore import QObject

from p2sf.messages import Message
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.reference import Accuracy, measure
from p2sf_explorer.state.state import State
from p2sf_explorer.state.what_if import NO_REFERENCE
from p2sf_explorer.workers.worker import LatestWins


class LiveAccuracy(QObject):
    """Owns the worker; ``watch`` is called with every answer, results go to the panels that show accuracy."""

    def __init__(self, window: Any, enabled: bool = True):
        super().__init__(window)
        self._enabled, self._resting = enabled, False
        self._window = window
        self._last: Accuracy | None = None
        self.worker = LatestWins(self)
        self.worker.finished.connect(self._on_finished)
        self.worker.failed.connect(self._on_failed)
        self.worker.progressed.connect(self._on_progress)

    def rest(self, resting: bool) -> None:
        """Measure nothing while ``resting``: the pictures are for a film."""
        self._resting = resting

    def watch(self, live: Live) -> None:
        """Measure a settled answer unless its own sum is pending; show an earlier figure in grey meanwhile."""
        if not self._enabled or self._resting or live.quality != "settled" or live.pending:
            return
        if live.setup.altered:
            self._refuse_altered(live)
            return
        every_method = asked_for(live.state)
        if self._last and fits(self._last, live, every_method):
            self._tell(self._last)
            return
        self.worker.submit(live, lambda cancelled, progress: measure(live, every_method, cancelled, progress))

    def _refuse_altered(self, live: Live) -> None:
        """Show no figure: the reference is the lens's, and this picture is not."""
        self.worker.cancel()
        self._window.panels["psf"].show_badge(live, None, False)
        self._each("show_failure", Message(NO_REFERENCE))

    def _on_finished(self, key: Live, accuracy: Accuracy) -> None:
        self._last = accuracy
        self._tell(accuracy)

    def _tell(self, accuracy: Accuracy) -> None:
        live = self._window.live
        if live is None or live.setup.altered:
            return
        stale = not fits(accuracy, live, False) or live.quality != "settled" or live.pending is not None
        self._window.panels["psf"].show_badge(live, accuracy.r_squared, stale)
        self._each("show_accuracy", accuracy, stale)

    def _on_failed(self, key: Live, message: Message) -> None:
        self._each("show_failure", message)

    def _on_progress(self, key: Live, part: float) -> None:
        self._each("show_progress", part)

    def _each(self, method: str, *arguments: object) -> None:
        panel = self._window.panels.get("accuracy")
        if panel and self._window.live and asked_for(self._window.live.state):
            getattr(panel, method)(*arguments)

    def stop(self) -> None:
        """End the worker's thread."""
        self.worker.stop()


def asked_for(state: State) -> bool:
    """Return whether the accuracy has its panel on show, in front of the tabs or in a window of its own."""
    return "accuracy" in (state.tab, *state.windows)


def fits(known: Accuracy, live: Live, every_method: bool) -> bool:
    """Return whether a known figure answers for this picture: it may differ in looks but neither in light nor window.

    Two fits of one method differ in their ``numbers``, which the tolerance decides.
    """
    return picture(known.live) == picture(live) and bool(known.results or not every_method)


def picture(live: Live) -> tuple:
    """Return everything that R² of a settled picture depends on."""
    setup, psf = live.setup, live.psf
    return setup.lens, setup.source, psf.method, psf.numbers, live.state.clip, psf.values.shape, psf.pixel_um
