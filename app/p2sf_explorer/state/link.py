"""A state as one line of text that a user can paste anywhere: ``p2sf:`` and URL-safe letters. Uses no Qt."""

import binascii
import json
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode
from typing import Any

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.state.state import State
from p2sf_explorer.state.state_files import VERSION, check_version, state_from_dict, state_to_dict

PREFIX = "p2sf:"
LARGEST = 4_000_000  # bytes of JSON: a state with two edited lenses needs a hundredth of it


def is_link(text: str) -> bool:
    """Return whether a text starts as a link."""
    return text.strip().startswith(PREFIX)


def link(state: State) -> str:
    """Return the state as text: ``aim`` and what differs from the default, as deflated JSON in URL-safe base 64.

    The alphabet is that of RFC 4648, section 5, without padding.
    """
    plain = json.dumps({"version": VERSION, "state": shorten_state(state)}, separators=(",", ":"))
    return PREFIX + urlsafe_b64encode(zlib.compress(plain.encode(), 9)).decode().rstrip("=")


def state_of_link(text: str) -> State:
    """Return the state of a link; P2SFError if it is truncated, changed, or of another version."""
    letters = "".join(text.split()).removeprefix(PREFIX)
    try:
        packed = urlsafe_b64decode(letters + "=" * (-len(letters) % 4))
        document = json.loads(unpack(packed))
    except (ValueError, RecursionError, binascii.Error, zlib.error):
        raise P2SFError("the link is cut off or changed; copy all of it again, from p2sf: to its last letter") from None
    if not isinstance(document, dict) or not isinstance(document.get("state"), dict):
        raise P2SFError("the link contains no state of the explorer; copy it again from the explorer")
    check_version(document.get("version"), Message("the link"))
    return state_from_dict(document["state"], document["version"])


def shorten_state(state: State) -> dict[str, dict[str, Any]]:
    """Return ``aim`` and the entries that differ from the first state, as plain JSON values, group by group."""
    usual, short = state_to_dict(State()), {}
    for group, entries in state_to_dict(state).items():
        stated = {name: value for name, value in entries.items() if value != usual[group][name] or name == "aim"}
        if stated:
            short[group] = stated
    if state.compare.pinned:
        short["compare"]["pinned"] = shorten_state(state.compare.pinned)
    return short


def unpack(packed: bytes) -> bytes:
    """Return inflated bytes, at most `LARGEST` of them: a short text must not fill the memory. Raises zlib.error."""
    inflating = zlib.decompressobj()
    plain = inflating.decompress(packed, LARGEST)
    if not inflating.eof:
        raise zlib.error("cut off or too large")
    return plain
