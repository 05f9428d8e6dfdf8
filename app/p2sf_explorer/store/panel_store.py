"""The store as panels have it: what is on screen is what they change, or nothing is."""

from p2sf_explorer.state.pinning import OPTICS
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store

OTHER_SIDE = "B is on screen, and the controls move A; show A, or swap the two, to change this one"


class PanelStore:
    """A `Store` that refuses in a sentence to change A's optics by what a panel shows of B.

    A panel takes its values from the picture under the pointer: B's place, B's surface, B's coefficient would be put
    into A. How things are looked at is common to both, and changes as ever.
    """

    def __init__(self, store: Store):
        self._store = store

    def __getattr__(self, name: str):
        return getattr(self._store, name)

    def update(self, **changes) -> None:
        """Change some entries, as `Store.update`."""
        if not self._refused(changes):
            self._store.update(**changes)

    def replace(self, state: State) -> None:
        """Make this the present state, as `Store.replace`."""
        if not self._refused({name: getattr(state, name) for name in OPTICS}):
            self._store.replace(state)

    def _refused(self, changes: dict) -> bool:
        state = self._store.state
        moves = any(name in OPTICS and getattr(state, name) != value for name, value in changes.items())
        return moves and self.refused_for_b()

    def refused_for_b(self) -> bool:
        """Return whether B is on screen, and say that what a panel shows of it is not changed."""
        if self._store.state.shown == "b":
            self._store.refused.emit(OTHER_SIDE)
            return True
        return False
