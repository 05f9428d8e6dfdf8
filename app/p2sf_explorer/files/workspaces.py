"""Workspaces as a person left them, kept from one session to the next beside the recent files. No Qt in here."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from p2sf.errors import P2SFError
from p2sf.files.writing import write_beside
from p2sf_explorer.files import recent
from p2sf_explorer.state.state import State
from p2sf_explorer.state.workspaces import Workspace, with_workspace

MOST = 24  # workspaces: a list that a person can still read
LONGEST = 24  # letters of a name


def workspaces_path() -> Path:
    """Return where workspaces are kept for this person."""
    return recent.recent_path().with_name("workspaces.json")


def kept_workspaces() -> dict[str, Workspace]:
    """Return the workspaces by name, as they were left; none where the file is missing or damaged."""
    try:
        listed = json.loads(workspaces_path().read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    read = {name: _workspace(value) for name, value in listed.items()} if isinstance(listed, dict) else {}
    return {name: found for name, found in list(read.items())[:MOST] if found}


def _workspace(values: Any) -> Workspace | None:
    """Return the workspace of plain values, None where it is none."""
    try:
        read: dict[str, Any] = {name: tuple(v) if isinstance(v, list) else v for name, v in values.items()}
        found = Workspace(**read)
        with_workspace(State(), "", found)  # which checks every entry
    except (TypeError, AttributeError, P2SFError):
        return None
    return found


def keep_workspaces(workspaces: Mapping[str, Workspace]) -> None:
    """Keep workspaces, whole or not at all; a folder that cannot be written to costs only the memory."""
    text = json.dumps({name: asdict(found) for name, found in workspaces.items()}, indent=1, ensure_ascii=False)
    path = workspaces_path()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_beside(path, lambda handle: handle.write((text + "\n").encode()))
    except (OSError, P2SFError):
        return
