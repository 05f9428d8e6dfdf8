"""The setup B that a person has pinned to compare with: pin, unpin, swap, link. No Qt in here."""

from dataclasses import replace
from typing import Any

from p2sf_explorer.state.limits import LINKABLE
from p2sf_explorer.state.state import State
from p2sf_explorer.state.what_if import UNTOUCHED

# The entries that determine the picture; the others say how it is displayed, the same way for A and for B.
OPTICS = (
    *("lens", "lens_text", "depth_mm", "focus_mm", "sensor_shift_um", "field_deg", "wavelength_nm", "f_number"),
    *("stop", "clip", "method", "tolerance", *UNTOUCHED),
)


def optics(state: State) -> dict[str, Any]:
    """Return the entries of a state that determine its picture."""
    return {name: getattr(state, name) for name in OPTICS}


def pin(state: State) -> State:
    """Return the state with its own setup pinned as B."""
    return replace(state, pinned=State(**optics(state)), shown="a")


def unpin(state: State) -> State:
    """Return the state with nothing pinned."""
    return replace(state, pinned=None, shown="a", linked=())


def swapped(state: State) -> State:
    """Return the state with A and B exchanged, so that the controls move the other one."""
    return replace(state, **_optics_of_b(state), pinned=State(**optics(state)))


def side_b(state: State) -> State:
    """Return B alone, displayed as A is."""
    return replace(state, **_optics_of_b(state), pinned=None, shown="a")


def _optics_of_b(state: State) -> dict[str, Any]:
    return optics(state.pinned) if state.pinned else {}


def with_links(state: State, changes: dict[str, Any]) -> dict[str, Any]:
    """Return changes to A together with what they change in B through the links."""
    both = {name: value for name, value in changes.items() if name in state.linked}
    return changes | {"pinned": replace(state.pinned, **both)} if state.pinned and both else changes


def link_toggled(state: State, key: str) -> tuple[str, ...]:
    """Return the links with one made or broken."""
    return tuple(name for name in LINKABLE if (name in state.linked) != (name == key))
