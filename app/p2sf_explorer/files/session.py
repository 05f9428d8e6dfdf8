"""The last window, kept from one session to the next; a damaged file costs only the memory. No Qt in here."""

import json
import os
from pathlib import Path

from p2sf.errors import P2SFError
from p2sf.files.writing import write_beside
from p2sf_explorer.compute.setup import first_state, prescription
from p2sf_explorer.files import recent
from p2sf_explorer.state.state import State
from p2sf_explorer.state.state_files import state_from_json, state_to_json

Session = tuple[State, dict[str, str]]
"""A state and where the parts of its window stand."""


def session_path() -> Path:
    """Return where the last window is kept for this person."""
    return recent.recent_path().with_name("window.json")


def rescued_path() -> Path:
    """Return where the window of a run that crashed is kept, until it is taken up again or given up."""
    return recent.recent_path().with_name("rescued.json")


def keep_session(state: State, geometry: dict[str, str]) -> bool:
    """Keep the state and where the window's parts stand, whole or not at all; return whether they are kept."""
    path = session_path()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_beside(path, lambda handle: handle.write(state_to_json(state, geometry=geometry).encode()))
    except (OSError, P2SFError):
        return False
    return True


def last_session() -> Session:
    """Return the state and the window's geometry as kept last; those of a first start where these cannot be opened."""
    return _session(session_path()) or (first_state(), {})


def rescue_session() -> None:
    """Put the last session aside, so that what is done before it is taken up again does not write over it."""
    if _session(session_path()):
        os.replace(session_path(), rescued_path())


def rescued_session() -> Session | None:
    """Return the session of a run that crashed; None where there is none, or none that can be opened."""
    return _session(rescued_path())


def forget_rescued() -> None:
    """Give up the session of a run that crashed, or note that it has been taken up."""
    rescued_path().unlink(missing_ok=True)


def _session(path: Path) -> Session | None:
    try:
        text = path.read_text(encoding="utf-8")
        state, geometry = state_from_json(text), json.loads(text).get("geometry")
        prescription(state)
        if state.compare.pinned:
            prescription(state.compare.pinned)
    except (OSError, UnicodeDecodeError, P2SFError):
        return None
    sound = isinstance(geometry, dict) and all(isinstance(item, str) for item in geometry.values())
    return state, geometry if sound else {}
