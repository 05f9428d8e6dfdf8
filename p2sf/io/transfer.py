"""Linear light and the encodings that picture files have."""

from p2sf.colour.colorimetry import linear_from_srgb, srgb_from_linear
from p2sf.errors import RequestError
from p2sf.messages import Alternatives

__all__ = ["ENCODINGS", "check_encoding", "linear_from_srgb", "srgb_from_linear"]

ENCODINGS = ("srgb", "linear")


def check_encoding(encoding: str) -> None:
    """Raise RequestError unless the encoding is one of ENCODINGS."""
    if encoding not in ENCODINGS:
        raise RequestError(
            'picture encoding "{encoding}" is unknown; choose {choices}',
            encoding=encoding,
            choices=Alternatives(ENCODINGS),
        )
