"""Files that are there whole or not at all, whatever ends the writing: an error, a full disk, a kill; and archives."""

import os
import secrets
import struct
import zlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from tokenize import TokenError
from typing import BinaryIO
from zipfile import BadZipFile

import numpy as np

# A header of numpy's is Python, whose parser has errors of its own, and so have zip and its packers.
DAMAGED = (BadZipFile, zlib.error, struct.error, TokenError, SyntaxError, LookupError, EOFError, TypeError)
DAMAGED += (AttributeError, ArithmeticError, RuntimeError, MemoryError)


def read_arrays(file) -> dict[str, np.ndarray]:
    """Return the arrays of an .npz file or stream; ValueError for one that is damaged or none, OSError as `open`."""
    try:
        with np.load(file, allow_pickle=False) as archive:
            return dict(archive)
    except DAMAGED as error:
        raise ValueError(f"no archive of arrays: {error}") from error


def write_whole(path, write: Callable[[BinaryIO], object]) -> None:
    """Let ``write`` fill a new file in the folder of ``path``, then give it that name; raises OSError.

    Whatever fails, a file already at ``path`` keeps its contents and no half-written one is left; a kill leaves none
    either where the system knows files without a name.
    """
    target = Path(path).resolve()
    part = target.with_name(f".{secrets.token_hex(6)}.part")
    try:
        unnamed = _unnamed(target.parent)
        with unnamed or open(part, "xb") as handle:
            write(handle)
            handle.flush()
            os.fsync(handle.fileno())
            if unnamed:
                _name(handle, part)
        os.replace(part, target)
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def _unnamed(folder: Path) -> BinaryIO | None:
    """Return a new file without a name, which ends with its process; None where the system has no such files."""
    try:
        number = os.open(folder, os.O_TMPFILE | os.O_RDWR, 0o666)
    except (AttributeError, OSError):
        return None
    try:
        # By its path, since some writers ask a handle for its name and a number is none.
        return open(f"/proc/self/fd/{number}", "r+b")
    except OSError:
        return None
    finally:
        os.close(number)


def _name(handle: BinaryIO, path: Path) -> None:
    """Give an unnamed file a name (open(2), O_TMPFILE; a folder's number makes Python follow the link of /proc)."""
    os.link(f"/proc/self/fd/{handle.fileno()}", path, src_dir_fd=handle.fileno(), follow_symlinks=True)
