"""The text of a lens file on disk: read with an error for every way to fail, written whole or not at all."""

import os
from pathlib import Path

from p2sf.errors import LensFileError
from p2sf.files.atomic import write_whole

LARGEST_FILE = 1_000_000  # bytes; a lens takes a few thousand


def read_text(path: str | os.PathLike) -> str:
    """Return a lens file's text; LensFileError for a file that is missing, unreadable, empty, huge or not UTF-8."""
    try:
        return _decoded(_bytes(Path(path)), path)
    except FileNotFoundError:
        raise LensFileError("there is no such file; check the path", path) from None
    except IsADirectoryError:
        raise LensFileError("this is a folder; name a lens file in it", path) from None
    except LensFileError:
        raise
    except (OSError, ValueError) as error:
        raise LensFileError(
            "the file cannot be read ({reason}); check its path and permissions",
            path,
            reason=getattr(error, "strerror", None) or str(error),
        ) from None


def _bytes(path: Path) -> bytes:
    with open(path, "rb") as file:
        return file.read(LARGEST_FILE + 1)


def _decoded(data: bytes, path: str | os.PathLike) -> str:
    if len(data) > LARGEST_FILE:
        raise LensFileError("the file is larger than {size} bytes; this is no lens file", path, size=LARGEST_FILE)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise LensFileError("the file is not UTF-8 text; save it as UTF-8", path, line) from None
    if not text.strip():
        raise LensFileError("the file is empty; write a lens into it", path)
    return text


def write_text(text: str, path: str | os.PathLike) -> None:
    """Write a text whole or not at all (`files.atomic.write_whole`); LensFileError."""
    try:
        write_whole(path, lambda handle: handle.write(text.encode("utf-8")))
    except OSError as error:
        raise LensFileError(
            "the file cannot be written ({reason}); choose another place", path, reason=error.strerror
        ) from None
