"""The state inside a snapshot: found again by what a file is, not by its name. No Qt in here."""

import os
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

from p2sf.files.atomic import DAMAGED
from p2sf.io.psf_files import READERS
from p2sf.messages import Message
from p2sf_explorer.state.state import State
from p2sf_explorer.state.state_files import state_from_json

KEYWORD = "p2sf-state"  # of the PNG text chunk
PNG_HEADER = 33  # bytes: signature and the chunk of the size
HEAD = 200
PathLike = str | os.PathLike[str]
DATABASE = Message("this is a database of PSFs, not a lens or a state; use it with p2sf psf, or open its lens")
STATELESS = Message(
    "there is no readable state in this picture or PSF; open a snapshot, written by the window with Ctrl+E, or with "
    "the Image panel open drop a photo"
)
CSV_HEAD = b"# point spread function"
BEGINNINGS = (
    (b"\x89PNG", "png"),
    (b"PK\x03\x04", ".npz"),
    (b"II*\0", ".tiff"),
    (b"MM\0*", ".tiff"),
    (b"SIMPLE  =", "fits"),
    (CSV_HEAD, ".csv"),
)


def state_inside(path: PathLike) -> State | None:
    """Return the state that a snapshot holds; None for a file without one. P2SFError for one that cannot be."""
    text = text_inside(path)
    return None if text is None else state_from_json(text, Message("the state inside {name}", name=Path(path).name))


def text_inside(path: PathLike) -> str | None:
    """Return the text of the state file that a snapshot holds, None where there is none."""
    kind = kind_of(path)
    if kind is None:
        return None
    try:
        found = PICTURES[kind](path) if kind in PICTURES else READERS[kind](path)[1].get("state")
    except (OSError, ValueError, *DAMAGED):
        return None  # the reader of lenses says what is wrong with the file
    return found if isinstance(found, str) else None


def foreign(path: PathLike) -> Message | None:
    """Return why a file without a state in it is no lens either; None where it may be one, as in a zip."""
    kind = kind_of(path)
    if kind == ".npz":
        start = _beginning(path)
        return DATABASE if b"p2sf_database.npy" in start else STATELESS if b".npy" in start else None
    return STATELESS if kind else None


def _beginning(path: PathLike) -> bytes:
    try:
        with open(path, "rb") as stream:
            return stream.read(HEAD)
    except OSError:
        return b""


def kind_of(path: PathLike) -> str | None:
    """Return which snapshot a file may be by its first bytes, None for none."""
    head = _beginning(path)
    return next((kind for beginning, kind in BEGINNINGS if head.startswith(beginning)), None)


def with_state(png: bytes, text: str) -> bytes:
    """Return a PNG with the state in a compressed text chunk behind its header (PNG 1.2, 3.2 and 4.2.3.3).

    Every other byte stays as it is: to encode the picture once more would take a third of a second.
    """
    data = b"iTXt" + KEYWORD.encode("latin-1") + b"\0\1\0\0\0" + zlib.compress(text.encode())
    chunk = struct.pack(">I", len(data) - 4) + data + struct.pack(">I", zlib.crc32(data))
    return png[:PNG_HEADER] + chunk + png[PNG_HEADER:]


def _in_png(path: PathLike) -> str | None:
    from PIL import Image

    try:
        with Image.open(path) as picture:
            picture.load()
            return picture.info.get(KEYWORD)
    except Image.DecompressionBombError as error:
        raise ValueError(str(error)) from error


def _in_fits(path: PathLike) -> str | None:
    from p2sf.io.fits_psf import read_psf_fits

    return read_psf_fits(path)[1].get("state")


PICTURES: dict[str, Callable[[PathLike], str | None]] = {"png": _in_png, "fits": _in_fits}
