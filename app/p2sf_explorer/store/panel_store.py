"""The store as panels have it: they change A only while A is on screen."""

from typing import Any

from PySide6.QtCore import QObject, Signal

from p2sf.messages import Message
from p2sf_explorer.state.pinning import OPTICS
from p2sf_explorer.state.state import State, entry
from p2sf_explorer.store.store import Store

OTHER_SIDE = Message("B is on screen, and the controls move A; show A, or swap the two, to change this one")


class PanelStore(QObject):
    """A `Store` that refuses to change the optics of A from a panel that shows B.

    A panel takes its values from the picture under the pointer, so a place, a surface or a coefficient of B would be
    put into A. The entries that say how A and B are displayed change as ever. What a panel hears of other panels ends
    with this object. A panel whose ``side`` is "b" shows B whatever is on screen.
    """

    selected = Signal(object)
    pointed = Signal(int)

    def __init__(self, store: Store, side: str = "") -> None:
        super().__init__()
        self._store, self._side = store, side
        store.selected.connect(self.selected)
        store.pointed.connect(self.pointed)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._store, name)

    def update(self, **changes: Any) -> None:
        """Change some entries, as `Store.update`."""
        if not self._refused(changes):
            self._store.update(**changes)

    def replace(self, state: State) -> None:
        """Make this the present state, as `Store.replace`."""
        if not self._refused({name: entry(state, name) for name in OPTICS}):
            self._store.replace(state)

    def _refused(self, changes: dict[str, Any]) -> bool:
        state = self._store.state
        moves = any(name in OPTICS and entry(state, name) != value for name, value in changes.items())
        return moves and self.refused_for_b()

    def refused_for_b(self) -> bool:
        """Return whether B is on screen; if so, say why nothing is changed."""
        if "b" in (self._store.state.compare.shown, self._side):
            self._store.refused.emit(OTHER_SIDE)
            return True
        return False
