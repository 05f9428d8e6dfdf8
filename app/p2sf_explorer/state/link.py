"""A state as one line of text that a person can paste anywhere: ``p2sf:`` and URL-safe letters. No Qt in here."""

import binascii
import json
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode

from p2sf.errors import P2SFError
from p2sf_explorer.state.state import VERSION, State, state_from_dict, state_to_dict

PREFIX = "p2sf:"
LARGEST = 4_000_000  # bytes of JSON: a state with two edited lenses is a hundredth of it


def is_link(text: str) -> bool:
    """Return whether a text says that it is a link."""
    return text.strip().startswith(PREFIX)


def link(state: State) -> str:
    """Return the state as text: the entries that differ from the default, as deflated JSON in URL-safe base 64.

    The alphabet is that of RFC 4648, section 5, without padding.
    """
    plain = json.dumps({"version": VERSION, "state": shortened(state)}, separators=(",", ":"))
    return PREFIX + urlsafe_b64encode(zlib.compress(plain.encode(), 9)).decode().rstrip("=")


def state_of_link(text: str) -> State:
    """Return the state of a link; P2SFError when it is cut off, changed, or of another version."""
    letters = "".join(text.split()).removeprefix(PREFIX)
    try:
        packed = urlsafe_b64decode(letters + "=" * (-len(letters) % 4))
        document = json.loads(unpacked(packed))
    except (ValueError, RecursionError, binascii.Error, zlib.error):
        raise P2SFError("the link is cut off or changed; copy all of it again, from p2sf: to its last letter") from None
    if not isinstance(document, dict) or not isinstance(document.get("state"), dict):
        raise P2SFError("the link holds no state of the explorer; copy it again from the explorer")
    if document.get("version") != VERSION:
        raise P2SFError(
            "the link has version {found}; this program reads version {version}",
            found=str(document.get("version")),
            version=VERSION,
        )
    return state_from_dict(document["state"])


def shortened(state: State) -> dict[str, object]:
    """Return the entries that differ from the default state, as plain JSON values."""
    usual = state_to_dict(State())
    short = {name: value for name, value in state_to_dict(state).items() if value != usual[name]}
    return short | ({"pinned": shortened(state.pinned)} if state.pinned else {})


def unpacked(packed: bytes) -> bytes:
    """Return inflated bytes, at most `LARGEST` of them: a short text must not fill the memory. Raises zlib.error."""
    inflating = zlib.decompressobj()
    plain = inflating.decompress(packed, LARGEST)
    if not inflating.eof:
        raise zlib.error("cut off or too large")
    return plain
