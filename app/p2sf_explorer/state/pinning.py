"""B, the setup a person has pinned to compare with: put in, taken out, exchanged, moved along. No Qt in here."""

from dataclasses import replace

from p2sf_explorer.state.limits import LINKABLE
from p2sf_explorer.state.state import State
from p2sf_explorer.state.what_if import UNTOUCHED

# What makes a picture; the rest of a State says how it is looked at, and A and B are looked at alike.
OPTICS = (
    *("lens", "lens_text", "depth_mm", "focus_mm", "sensor_shift_um", "field_deg", "wavelength_nm", "f_number"),
    *("stop", "clip", "method", "tolerance", *UNTOUCHED),
)


def optics(state: State) -> dict:
    """Return the entries of a state that make its picture."""
    return {name: getattr(state, name) for name in OPTICS}


def pin(state: State) -> State:
    """Return the state with its own setup pinned as B."""
    return replace(state, pinned=State(**optics(state)), shown="a")


def unpin(state: State) -> State:
    """Return the state with nothing pinned."""
    return replace(state, pinned=None, shown="a", linked=())


def swapped(state: State) -> State:
    """Return the state with A and B exchanged, so that the controls move the other one."""
    return replace(state, **optics(state.pinned), pinned=State(**optics(state)))


def side_b(state: State) -> State:
    """Return B alone, looked at as A is."""
    return replace(state, **optics(state.pinned), pinned=None, shown="a")


def with_links(state: State, changes: dict) -> dict:
    """Return changes to A together with what they change in B through the links."""
    both = {name: value for name, value in changes.items() if name in state.linked}
    return changes | {"pinned": replace(state.pinned, **both)} if state.pinned and both else changes


def link_toggled(state: State, key: str) -> tuple[str, ...]:
    """Return the links with one made or broken."""
    return tuple(name for name in LINKABLE if (name in state.linked) != (name == key))
