"""The files opened lately, newest first, kept from one session to the next. No Qt in here."""

import json
import os
from pathlib import Path

from p2sf.errors import P2SFError
from p2sf.lensfile.source_text import write_text

MOST = 10


def recent_path() -> Path:
    """Return where the list is kept for this person."""
    from platformdirs import user_state_path

    return user_state_path("p2sf-explorer", appauthor=False) / "recent.json"


def recent_files() -> tuple[str, ...]:
    """Return the files that are still there, newest first; none when the list is missing or damaged."""
    try:
        listed = json.loads(recent_path().read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return ()
    paths = [item for item in listed if isinstance(item, str)] if isinstance(listed, list) else []
    return tuple(path for path in paths if os.path.isfile(path))[:MOST]


def remember(path: str) -> None:
    """Put a file at the head of the list; a folder that cannot be written to costs only the memory."""
    path = os.path.abspath(path)
    listed = (path, *(known for known in recent_files() if known != path))[:MOST]
    try:
        recent_path().parent.mkdir(parents=True, exist_ok=True)
        write_text(json.dumps(listed, indent=1, ensure_ascii=False) + "\n", recent_path())
    except (OSError, P2SFError):
        return
