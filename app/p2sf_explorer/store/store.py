"""The one place where the state lives while the window is open: changes, undo, redo."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from PySide6.QtCore import QObject, Signal

from p2sf.errors import P2SFError
from p2sf_explorer.state.pinning import with_links
from p2sf_explorer.state.state import State, change

MOST_STEPS = 1000  # of undo: an edited lens is kilobytes a step


class Store(QObject):
    """Holds the present State and the steps of undo. A drag, from ``begin`` to ``end``, is one step."""

    changed = Signal(object)  # the new State
    refused = Signal(object)  # a Message, or the P2SFError, on what cannot be done
    said = Signal(object)  # a Message on what was done
    stepped = Signal()  # before undo and redo
    selected = Signal(object)  # the first and last surface (from 1) of what is selected, None for nothing
    pointed = Signal(int)  # the surface under the pointer, from 1; 0 for none

    def __init__(self, state: State, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._states, self._at = [state], 0
        self._before_drag: State | None = None
        self.pointed_at = 0
        self.selection: tuple[int, int] | None = None

    def point_at(self, surface: int) -> None:
        """Tell which surface (from 1) the pointer is at, 0 for none. This is no part of the state and not undone."""
        if surface != self.pointed_at:
            self.pointed_at = surface
            self.pointed.emit(surface)

    def select(self, surfaces: tuple[int, int] | None) -> None:
        """Select surfaces, first and last from 1, or nothing. This is no part of the state and not undone."""
        if surfaces != self.selection:
            self.selection = surfaces
            self.selected.emit(surfaces)

    @property
    def state(self) -> State:
        """Return the present state."""
        return self._states[self._at]

    @property
    def moving(self) -> bool:
        """Return whether a control is being dragged."""
        return self._before_drag is not None

    def update(self, **changes: Any) -> None:
        """Change some entries, and those of B that are linked to them; refuse a bad value and change nothing."""
        try:
            self.replace(self.changed_by(changes))
        except P2SFError as error:
            self.refused.emit(error)

    def changed_by(self, changes: dict[str, Any]) -> State:
        """Return the state after changes, without making them; P2SFError for a bad value."""
        return change(self.state, **with_links(self.state, changes))

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
        """End a drag, and send ``changed`` once more, for the settled picture."""
        if self.moving:
            moved = self.state is not self._before_drag
            self._before_drag = None
            if moved:
                self.changed.emit(self.state)

    def cancel(self) -> None:
        """Give up a drag: the state is as before it, and no step of undo is left."""
        if self.moving:
            moved = self.state is not self._before_drag
            self._before_drag = None
            if moved:
                del self._states[self._at :]
                self._at -= 1
                self.changed.emit(self.state)

    @contextmanager
    def drag(self) -> Iterator["Store"]:
        """Keep a drag open for a block."""
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
        """Return the latest state, the present one or a step of undo, that is ``wanted``; None where none is."""
        return next((state for state in reversed(self._states[: self._at + 1]) if wanted(state)), None)

    @property
    def history(self) -> list[State]:
        """Return the steps of undo from the first, the present state last."""
        return self._states[: self._at + 1]

    @property
    def previous(self) -> State | None:
        """Return the state that `undo` would give back, None where there is none."""
        return self._states[self._at - 1] if self.can_undo else None

    def undo(self) -> None:
        """Take back one step."""
        self._go(-1, self.can_undo)

    def redo(self) -> None:
        """Take one step again."""
        self._go(1, self.can_redo)

    def take_over(self, other: "Store") -> None:
        """Take over the state of another store with its steps of undo."""
        other.end()
        self._states, self._at = list(other._states), other._at

    def _go(self, step: int, possible: bool) -> None:
        self.stepped.emit()
        self.end()
        if possible:
            self._at += step
            self.changed.emit(self.state)
