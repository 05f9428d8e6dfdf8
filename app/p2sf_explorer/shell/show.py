"""What is shown where something has no answer: of a set-up its lens and rays, of a panel why. No Qt in here."""

from dataclasses import dataclass

from p2sf.errors import P2SFError
from p2sf_explorer.compute.layout import Layout, layout
from p2sf_explorer.compute.live import Live, Refused
from p2sf_explorer.compute.setup import ParaxialSetup, paraxial_setup
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.state.state import State

WHY = "This set-up cannot be computed; what was here belongs to the one before."
UNKNOWN = "–"


@dataclass(frozen=True)
class Drawn:
    """What the layout panel needs of an answer."""

    state: State
    setup: ParaxialSetup
    layout: Layout


def drawn(state: State) -> Drawn | None:
    """Return the lens, its rays and marks for a state without a picture; None where they cannot be computed either."""
    try:
        found = paraxial_setup(state)
        return Drawn(state, found, layout(found))
    except P2SFError:
        return None


def paint(panel, key: str, live: Live) -> None:
    """Have a panel show an answer, and which side of a comparison it is; or say over it why it has nothing to show."""
    found = live.views.get(key)
    if isinstance(found, Refused):
        panel.widget.show_overlay(said(found.message))
        return
    panel.show(live)
    panel.widget.show_overlay("")
    why = live.difference.why.get(key) if live.difference else None
    panel.widget.show_side("A" if why else live.side, said(why) if why else "")
