"""Conversion of states to and from JSON, including states written by version 0.1. Uses no Qt."""

import json
import os
from dataclasses import fields, is_dataclass, replace
from math import inf
from typing import Any

from p2sf.errors import P2SFError
from p2sf.files.reading import open_file, read_text
from p2sf.files.reasons import reason
from p2sf.messages import Message
from p2sf_explorer.state.state import ENTRIES, FIRST, State

SCHEMA = "p2sf-explorer-state"
HEAD = 4096  # bytes of a file, in whose first lines a state names its schema
THE_STATE = Message("the state")
VERSION = 6
"""1 was one flat table, 2 had no aim, 3 no stage, 4 no mask, rings, tolerances, errors, 5 no choices of panels."""
BEFORE_AIM = {"optics": {"aim": "paraxial"}}  # the aim of a state that states none
# Entries that had another name in version 0.1 (VERSION 1, one flat table).
RENAMED = {
    "play": "playback_slider",
    "play_range": "playback_range",
    "play_seconds": "playback_seconds",
    "photo": "photo_source",
    "lesson": "lesson_name",
    "eye_turn_deg": "camera_turn_deg",
    "eye_tilt_deg": "camera_tilt_deg",
    "eye_near": "camera_zoom",
    "relief_turn_deg": "camera_surface_turn_deg",
    "relief_tilt_deg": "camera_surface_tilt_deg",
}


def present_name(name: str) -> str:
    """Return the present name of an entry of version 0.1, or the name itself."""
    return RENAMED.get(name, name)


def state_to_dict(state: State) -> dict[str, Any]:
    """Return the state as plain JSON values, group by group; infinity is written "inf"."""
    return {group.name: _plain(getattr(state, group.name)) for group in fields(state)}


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: _plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return "inf" if value == inf else value


def state_from_dict(values: dict[str, Any], version: int = VERSION) -> State:
    """Return the state of plain JSON values, with defaults for absent entries; P2SFError for anything else.

    ``version`` 1 is the flat table of version 0.1. A state without ``aim`` is from before it, and paraxial.
    """
    try:
        return _state(_migrate(values) if version == 1 else values)
    except RecursionError:  # nested lists, as deep as the JSON parser allows
        raise P2SFError("the state's lists are nested too deep; save it again from the explorer") from None


def _migrate(values: dict[str, Any]) -> dict[str, Any]:
    """Return the groups of a flat table of version 0.1; newer entries keep their defaults."""
    groups: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        if present_name(name) not in ENTRIES or name in RENAMED.values():
            raise _unknown(name, tuple(sorted(ENTRIES)))
        group, field = ENTRIES[present_name(name)]
        nested = isinstance(value, dict) and name == "pinned"
        groups.setdefault(group, {})[field] = _migrate(value) if nested else value
    return groups


def _state(values: dict[str, Any]) -> State:
    known = tuple(field.name for field in fields(State))
    groups: dict[str, Any] = {}
    for name, entries in (BEFORE_AIM | values).items():
        if name not in known:
            raise _unknown(name, known)
        if not isinstance(entries, dict):
            raise P2SFError('the state\'s group "{group}" is not a table; save it again from the explorer', group=name)
        default = getattr(FIRST, name)
        own = tuple(field.name for field in fields(default))
        entries = BEFORE_AIM.get(name, {}) | entries
        for entry in entries:
            if entry not in own:
                raise _unknown(entry, own)
        groups[name] = replace(default, **{entry: _read(entry, value) for entry, value in entries.items()})
    return replace(FIRST, **groups)


def _unknown(entry: str, known: tuple[str, ...]) -> P2SFError:
    return P2SFError(
        'the state has an unknown entry "{entry}"; known are {known}',
        entry=entry,
        known=known,
    )


def _read(name: str, value: Any) -> Any:
    if isinstance(value, list):
        return tuple(_read("", item) for item in value)
    if name == "pinned" and isinstance(value, dict):
        if isinstance(value.get("compare"), dict) and value["compare"].get("pinned"):
            raise P2SFError("what is pinned as B must be one state with nothing pinned in it; pin it again")
        return _state(value)
    return inf if value == "inf" else value


def state_to_json(state: State, **extra: object) -> str:
    """Return the text of a state file; ``extra`` entries, such as versions, are written and not read back."""
    document = {
        "schema": SCHEMA,
        "version": VERSION,
        **extra,
        "state": state_to_dict(state),
    }
    return json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def state_from_json(text: str, where: str | Message = THE_STATE) -> State:
    """Return the state of a state file's text; P2SFError states the fault and ``where``."""
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise P2SFError(
            "{where}, line {line}: not JSON ({why}); correct it or save it again",
            where=where,
            line=error.lineno,
            why=error.msg,
        ) from None
    except (ValueError, RecursionError):
        raise P2SFError(
            "{where} is nested too deep or holds too long a number; save it again",
            where=where,
        ) from None
    if (
        not isinstance(document, dict)
        or document.get("schema") != SCHEMA
        or not isinstance(document.get("state"), dict)
    ):
        raise P2SFError(
            "{where} is not a state of the explorer; give a .json the explorer has written",
            where=where,
        )
    check_version(document.get("version"), where)
    return state_from_dict(document["state"], document["version"])


def check_version(found: object, where: str | Message) -> None:
    """Raise P2SFError for a version of states that this program does not read."""
    if found not in range(1, VERSION + 1) or isinstance(found, bool):
        raise P2SFError(
            "{where} has version {found}; this program reads versions up to {version:d}",
            where=where,
            found=str(found),
            version=VERSION,
        )


def is_state(path: str | os.PathLike[str]) -> bool:
    """Return whether a file says that it is a state of the explorer."""
    try:
        with open_file(path) as stream:
            head = stream.read(HEAD)
    except (OSError, ValueError):
        return False  # the reader of lenses says why it cannot be read
    return head.lstrip().startswith(b"{") and SCHEMA.encode() in head


def read_state(path: str | os.PathLike[str]) -> State:
    """Return the state saved at ``path``; P2SFError if it cannot be read."""
    try:
        text = read_text(path)
    except (OSError, UnicodeDecodeError) as error:
        raise P2SFError(
            "{path} cannot be read ({why}); give a state file that exists",
            path=str(path),
            why=reason(error),
        ) from None
    return state_from_json(text, str(path))
