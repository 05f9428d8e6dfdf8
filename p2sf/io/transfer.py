"""Between linear light and what files hold."""

from p2sf.colour.colorimetry import linear_from_srgb, srgb_from_linear
from p2sf.errors import RequestError

__all__ = ["ENCODINGS", "check_encoding", "linear_from_srgb", "srgb_from_linear"]

ENCODINGS = ("srgb", "linear")


def check_encoding(encoding: str) -> None:
    """Raise RequestError unless the encoding is one of ENCODINGS."""
    if encoding not in ENCODINGS:
        raise RequestError(f'picture encoding "{encoding}" is unknown; choose {" or ".join(ENCODINGS)}')
