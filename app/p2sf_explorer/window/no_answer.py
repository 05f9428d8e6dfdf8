"""What the window shows for a setup that has no answer: its lens and rays, where these can be drawn. No Qt in here."""

from dataclasses import dataclass

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.compute.layout import Layout, layout_of
from p2sf_explorer.compute.setup import ParaxialSetup, paraxial_setup
from p2sf_explorer.state.state import State

NO_ANSWER = Message("These settings cannot be computed; what was here belonged to the previous ones.")
UNKNOWN = "–"


@dataclass(frozen=True)
class SetupDrawing:
    """The part of an answer that the layout panel needs."""

    state: State
    setup: ParaxialSetup
    layout: Layout


def draw_setup(state: State) -> SetupDrawing | None:
    """Return the lens, its rays and marks for a state without a picture; None where these cannot be computed either."""
    try:
        found = paraxial_setup(state)
        return SetupDrawing(state, found, layout_of(state, found))
    except P2SFError:
        return None
