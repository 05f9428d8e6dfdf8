"""What can be shown of a set-up that has no picture: its lens and rays, and why nothing else. No Qt in here."""

from dataclasses import dataclass

from app.layout import Layout, layout
from app.setting import Setting, setting
from app.state import State
from p2sf.errors import P2SFError

WHY = "This set-up cannot be computed; what was here belongs to the one before."
UNKNOWN = "–"


@dataclass(frozen=True)
class Drawn:
    """What the layout panel needs of an answer."""

    state: State
    setting: Setting
    layout: Layout


def drawn(state: State) -> Drawn | None:
    """Return the lens, its rays and marks for a state without a picture; None where they cannot be computed either."""
    try:
        found = setting(state)
        return Drawn(state, found, layout(found))
    except P2SFError:
        return None
