"""The last window, kept from one session to the next; a damaged file costs only the memory. No Qt in here."""

import json
import os
from contextlib import suppress
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
    """Return the state and the window's geometry as kept last; those of a first start where these cannot be opened.

    One that cannot, as its lens is not there now, is put aside before the window writes over it.
    """
    found = _session(session_path())
    if found is None:
        rescue_session()
    return found or (first_state(), {})


def rescue_session() -> None:
    """Put the last session aside, under a number of its own, until it is taken up again or given up."""
    if _kept(session_path()):
        number = max(map(_number, _rescued_paths()), default=0) + 1
        os.replace(session_path(), session_path().with_name(f"rescued-{number}.json"))


def rescued_sessions() -> dict[Path, Session]:
    """Return the sessions that were put aside and can be opened, by their files, the latest first."""
    found = {path: _session(path) for path in sorted(_rescued_paths(), key=_number, reverse=True)}
    return {path: session for path, session in found.items() if session}


def take_rescued(path: Path) -> None:
    """Make a session that was put aside the last one: if the program ends at once, it is put aside again."""
    with suppress(OSError):  # a window beside this one may have taken it
        os.replace(path, session_path())


def forget_rescued(path: Path) -> None:
    """Give up a session that was put aside."""
    path.unlink(missing_ok=True)


def _rescued_paths() -> list[Path]:
    return list(session_path().parent.glob("rescued*.json"))


def _number(path: Path) -> int:
    """Return which of the sessions put aside this was; 0 for the one that versions before 0.3 kept."""
    digits = path.stem.removeprefix("rescued-")
    return int(digits) if digits.isdecimal() else 0


def _session(path: Path) -> Session | None:
    """Return a session that is kept and can be opened, None where there is none."""
    kept = _kept(path)
    try:
        for state in (kept[0], kept[0].compare.pinned) if kept else ():
            if state:
                prescription(state)
    except P2SFError:
        return None
    return kept


def _kept(path: Path) -> Session | None:
    """Return a session that is kept, None where there is none or it is damaged."""
    try:
        text = path.read_text(encoding="utf-8")
        state, geometry = state_from_json(text), json.loads(text).get("geometry")
    except (OSError, UnicodeDecodeError, P2SFError):
        return None
    sound = isinstance(geometry, dict) and all(isinstance(item, str) for item in geometry.values())
    return state, geometry if sound else {}
