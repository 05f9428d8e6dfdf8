"""The last window, kept from one session to the next; a damaged file costs only the memory. No Qt in here."""

import json
from pathlib import Path

from p2sf.errors import P2SFError
from p2sf.files.writing import write_beside
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.files import recent
from p2sf_explorer.state.state import State
from p2sf_explorer.state.state_files import state_from_json, state_to_json


def session_path() -> Path:
    """Return where the last window is kept for this person."""
    return recent.recent_path().with_name("window.json")


def keep_session(state: State, geometry: dict[str, str]) -> None:
    """Keep the state and where the window's parts stand, whole or not at all."""
    path = session_path()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_beside(path, lambda handle: handle.write(state_to_json(state, geometry=geometry).encode()))
    except (OSError, P2SFError):
        return


def last_session() -> tuple[State, dict[str, str]]:
    """Return the state and the window's geometry as kept last; the default ones where these cannot be opened."""
    try:
        text = session_path().read_text(encoding="utf-8")
        state, geometry = state_from_json(text), json.loads(text).get("geometry")
        prescription(state)
        if state.compare.pinned:
            prescription(state.compare.pinned)
    except (OSError, UnicodeDecodeError, P2SFError):
        return State(), {}
    sound = isinstance(geometry, dict) and all(isinstance(item, str) for item in geometry.values())
    return state, geometry if sound else {}
