"""Which of the controls under *More controls* are shown. Uses no Qt."""

from collections.abc import Collection

from p2sf.errors import P2SFError
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.state.state import Optics, State

USUAL = Optics()
SHIFT, SHAPE, STOP, AIM, FOCUS, METHOD = PARTS = "shift", "shape", "stop", "aim", "focus", "method"


def differing(state: State) -> set[str]:
    """Return the parts that differ from the lens as its file has it, or from the usual method and accuracy."""
    optics = state.optics
    asked = {
        SHIFT: bool(optics.sensor_shift_um),
        SHAPE: bool(optics.mask) or state.display.show_pupil_shape,
        STOP: optics.stop != USUAL.stop or optics.clip,
        AIM: optics.aim != _own_aim(optics),
        METHOD: not optics.automatic or optics.tolerance != USUAL.tolerance,
    }
    return {part for part, differs in asked.items() if differs}


def _own_aim(optics: Optics) -> str:
    """Return how rays fill the pupil by the lens file; the usual way for one that the banner says cannot be read."""
    try:
        return default_state(optics.lens, optics.lens_text).optics.aim
    except P2SFError:
        return USUAL.aim


class Fold:
    """What is shown stays, so that no control vanishes under the hand that sets it back.

    It folds with another lens, another page of a lesson, or when a person folds it.
    """

    def __init__(self) -> None:
        self._of: tuple[object, ...] = ()
        self._shown: frozenset[str] = frozenset()

    def shown(self, state: State, pointed: Collection[str] = ()) -> frozenset[str]:
        """Return the parts to show; ``pointed``: those that a lesson points to."""
        of = state.optics.lens, state.lesson.name, state.lesson.step, state.display.show_more
        kept = self._shown if of == self._of else frozenset()
        self._of, self._shown = of, kept | differing(state) | frozenset(pointed)
        return frozenset(PARTS) if state.display.show_more else self._shown
