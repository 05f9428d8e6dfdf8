"""The one place the state lives while the window is open: changes, undo, redo."""

from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from p2sf.errors import P2SFError
from p2sf_explorer.state.pinning import with_links
from p2sf_explorer.state.state import State

MOST_STEPS = 1000  # of undo: an edited lens is kilobytes a step


class Store(QObject):
    """Holds the present State; ``changed`` tells of every new one.

    ``refused`` carries a sentence on what cannot be, ``said`` one on what was done; ``stepped`` comes before
    a step is taken back or again; ``pointed`` tells of the surface (from 1) under the pointer, 0 for none.
    A drag is one step of undo: what happens between ``begin`` and ``end`` is undone together.
    """

    changed = Signal(object)
    refused = Signal(object)
    said = Signal(object)
    stepped = Signal()
    pointed = Signal(int)

    def __init__(self, state: State, parent: QObject | None = None):
        super().__init__(parent)
        self._states, self._at = [state], 0
        self._before_drag: State | None = None
        self._pointed_at = 0

    def point_at(self, surface: int) -> None:
        """Tell that the pointer is at a surface (from 1), 0 for none; no part of the state, nothing to undo."""
        if surface != self._pointed_at:
            self._pointed_at = surface
            self.pointed.emit(surface)

    @property
    def state(self) -> State:
        """Return the present state."""
        return self._states[self._at]

    @property
    def moving(self) -> bool:
        """Return whether a control is being dragged."""
        return self._before_drag is not None

    def update(self, **changes) -> None:
        """Change some entries, and B's that are linked to them.

        A value that cannot be is refused in a sentence and nothing changes.
        """
        try:
            self.replace(self.changed_by(changes))
        except P2SFError as error:
            self.refused.emit(str(error))

    def changed_by(self, changes: dict) -> State:
        """Return what the state would be after changes; P2SFError for one that cannot be."""
        return replace(self.state, **with_links(self.state, changes))

    def replace(self, state: State) -> None:
        """Make this the present state: one step of undo, or part of the drag under way."""
        if state == self.state:
            return
        if self.moving and self.state is not self._before_drag:
            self._states[self._at] = state
        else:
            self._states[self._at + 1 :] = [state]
            del self._states[: -MOST_STEPS - 1]
            self._at = len(self._states) - 1
        self.changed.emit(state)

    def begin(self) -> None:
        """Begin a drag."""
        if not self.moving:
            self._before_drag = self.state

    def end(self) -> None:
        """End a drag; the settled picture is owed, so ``changed`` is sent once more."""
        if self.moving:
            moved = self.state is not self._before_drag
            self._before_drag = None
            if moved:
                self.changed.emit(self.state)

    @contextmanager
    def drag(self):
        """Hold a drag open for a block."""
        self.begin()
        try:
            yield self
        finally:
            self.end()

    @property
    def can_undo(self) -> bool:
        """Return whether there is a step to take back."""
        return self._at > 0

    @property
    def can_redo(self) -> bool:
        """Return whether there is a step to take again."""
        return self._at + 1 < len(self._states)

    def latest(self, wanted: Callable[[State], bool]) -> State | None:
        """Return the last state, the present one or a step to undo to, that is ``wanted``; None where none is."""
        return next((state for state in reversed(self._states[: self._at + 1]) if wanted(state)), None)

    def undo(self) -> None:
        """Take back one step."""
        self._go(-1, self.can_undo)

    def redo(self) -> None:
        """Take one step again."""
        self._go(1, self.can_redo)

    def take_over(self, other: "Store") -> None:
        """Become what another store is, its steps of undo included."""
        other.end()
        self._states, self._at = list(other._states), other._at

    def _go(self, step: int, possible: bool) -> None:
        self.stepped.emit()
        self.end()
        if possible:
            self._at += step
            self.changed.emit(self.state)
