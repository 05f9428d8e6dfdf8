"""The setup B that a user has pinned for comparison: pin, unpin, swap, link. Uses no Qt."""

from dataclasses import replace
from typing import Any

from p2sf_explorer.state.limits import LINKABLE
from p2sf_explorer.state.state import ENTRIES, Compare, State, change

# The entries that determine the picture; the others determine its display, which A and B share.
OPTICS = tuple(name for name, (group, _) in ENTRIES.items() if group in ("optics", "what_if"))


def optics(state: State) -> State:
    """Return the entries that determine the picture of a state; all others have their defaults."""
    return State(optics=state.optics, what_if=state.what_if)


def pin(state: State) -> State:
    """Return the state with its own setup pinned as B."""
    return change(state, pinned=optics(state), shown="a")


def unpin(state: State) -> State:
    """Return the state with nothing pinned."""
    return replace(state, compare=Compare())


def swap(state: State) -> State:
    """Return the state with A and B exchanged, so that the controls act on the other one."""
    b = state.compare.pinned or state
    return change(replace(state, optics=b.optics, what_if=b.what_if), pinned=optics(state))


def side_b(state: State) -> State:
    """Return B alone, displayed as A is."""
    b = state.compare.pinned or state
    return change(replace(state, optics=b.optics, what_if=b.what_if), pinned=None, shown="a")


def b_alone(state: State) -> bool:
    """Return whether B is on screen and A is not, so that only links let the controls move what is seen."""
    return state.compare.pinned is not None and state.compare.shown == "b"


def with_links(state: State, changes: dict[str, Any]) -> dict[str, Any]:
    """Return changes to A together with what they change in B through the links."""
    b, both = state.compare.pinned, {name: value for name, value in changes.items() if name in state.compare.linked}
    return changes | {"pinned": change(b, **both)} if b and both else changes


def link_toggled(state: State, key: str) -> tuple[str, ...]:
    """Return the links with one made or broken."""
    return tuple(name for name in LINKABLE if (name in state.compare.linked) != (name == key))
