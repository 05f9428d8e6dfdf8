"""Measures every settled picture against the Huygens reference in the background, for the panels that show it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from PySide6.QtCore import QObject

from p2sf.messages import Message
from p2sf_explorer.compute.live import Live
from p2sf_explorer.state.state import State
from p2sf_explorer.state.what_if import NO_REFERENCE
from p2sf_explorer.state.workspaces import on_show
from p2sf_explorer.store.late_answers import LateAnswers, Tell

if TYPE_CHECKING:
    from p2sf_explorer.compute.reference import Accuracy

REST_MS = 300  # of a picture before it is measured, so that the first picture, and the next state, do not wait for it


class ShowBadge(Protocol):
    """Writes the measured R² of an answer, None for none, on the PSF, and the method that it refers to."""

    def __call__(self, live: Live, r_squared: float | None, reference: str = ..., /) -> None:
        """Show it."""


@runtime_checkable
class AccuracyDisplay(Protocol):
    """A panel that shows the accuracy."""

    def show_accuracy(self, accuracy: "Accuracy", stale: bool, /) -> None:
        """Show a measured accuracy; ``stale`` where it belongs to an earlier picture."""

    def show_failure(self, why: Message, /) -> None:
        """Show why there is no accuracy."""

    def show_progress(self, part: float, /) -> None:
        """Show how far the measuring is, 0 to 1."""


@dataclass(frozen=True)
class AccuracyQuestion:
    """What R² of a settled picture depends on, and whether every method's is wanted."""

    picture: tuple
    every_method: bool
    live: Live = field(compare=False)


class LiveAccuracy(QObject):
    """Has every settled picture measured; ``watch`` is called with every answer, and with None where there is none.

    ``display()`` is the panel that shows the accuracy, None before it was first opened.
    """

    def __init__(
        self,
        show_badge: ShowBadge,
        display: Callable[[], AccuracyDisplay | None],
        parent: QObject,
        enabled: bool = True,
    ) -> None:
        super().__init__(parent)
        self._enabled, self._filming = enabled, False
        self._show_badge, self._display = show_badge, display
        self._live: Live | None = None
        self._last: Accuracy | None = None
        self.late = LateAnswers(self, _measured, held_ms=REST_MS)
        self.late.finished.connect(self._on_finished)
        self.late.failed.connect(self._on_failed)
        self.late.progressed.connect(self._on_progress)

    def film(self, on: bool) -> None:
        """While the pictures are for a film, measure only for a panel on show, and at once: frames wait for it."""
        self._filming = on
        self.late.let_go()

    def watch(self, live: Live | None) -> None:
        """Measure a settled answer that stands in for no other; none of an altered lens, which has no reference."""
        self._live = live
        if live is None or not self._enabled or live.quality != "settled" or live.pending:
            self.late.let_go()
            return
        every_method = asked_for(live.state)
        if self._filming and not every_method:
            return
        if live.setup.altered:
            self.late.forget()
            self._show_badge(live, None)
            self._show(lambda panel: panel.show_failure(Message(NO_REFERENCE)))
        elif self._last and fits(self._last, live, every_method):
            self.late.forget()
            self._tell(self._last)
        else:
            ask = self.late.ask if self._filming else self.late.ask_when_held
            ask(AccuracyQuestion(picture(live), every_method, live))

    def _on_progress(self, question: AccuracyQuestion, part: float) -> None:
        if question == self.late.asked:
            self._show(lambda panel: panel.show_progress(part))

    def _on_finished(self, question: AccuracyQuestion | None, accuracy: "Accuracy") -> None:
        if question == self.late.asked:  # else a figure that is known answers for the picture by now
            self._last = accuracy
            self._tell(accuracy)

    def _on_failed(self, _: AccuracyQuestion, message: Message) -> None:
        self._show(lambda panel: panel.show_failure(message))
        self.late.forget()  # so that it is said again of this picture

    def _tell(self, accuracy: "Accuracy") -> None:
        live = self._live
        if live is None or live.setup.altered:
            return
        stale = not fits(accuracy, live, False) or live.quality != "settled" or live.pending is not None
        if not stale:
            self._show_badge(live, accuracy.r_squared, accuracy.reference.method)
        self._show(lambda panel: panel.show_accuracy(accuracy, stale))

    def _show(self, what: Callable[[AccuracyDisplay], None]) -> None:
        """Have the panel show something where it is on show."""
        if self._live and asked_for(self._live.state) and (panel := self._display()):
            what(panel)


def asked_for(state: State) -> bool:
    """Return whether the accuracy has its panel on show."""
    return "accuracy" in on_show(state.display)


def _measured(question: AccuracyQuestion, stopped: Callable[[], bool], tell: Tell) -> "Accuracy":
    """Measure an answer in the background, where what measures is loaded too."""
    from p2sf_explorer.compute.reference import measure

    return measure(question.live, question.every_method, stopped, tell)


def fits(known: "Accuracy", live: Live, every_method: bool) -> bool:
    """Return whether a known figure answers for this picture: it may differ in looks but neither in light nor window.

    Two fits of one method differ in their ``numbers``, which the tolerance decides.
    """
    return picture(known.live) == picture(live) and bool(known.results or not every_method)


def picture(live: Live) -> tuple:
    """Return everything that R² of a settled picture depends on."""
    setup, psf = live.setup, live.psf
    return setup.lens, setup.source, psf.method, psf.numbers, live.state.optics.clip, psf.values.shape, psf.pixel_um
