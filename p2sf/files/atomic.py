"""Files written atomically, even if an error, a full disk or a kill interrupts the writing."""

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

# Errors for a damaged archive: numpy parses headers as Python, and zip and its compressors raise their own.
DAMAGED = (
    BadZipFile,
    zlib.error,
    struct.error,
    TokenError,
    SyntaxError,
    LookupError,
    EOFError,
    TypeError,
    AttributeError,
    ArithmeticError,
    RuntimeError,
    MemoryError,
)


def write_whole(path: str | os.PathLike, write: Callable[[BinaryIO], object]) -> None:
    """Call ``write`` with a new file in the folder of ``path``, then rename it to ``path``; raises OSError.

    On failure an existing file at ``path`` keeps its contents and no partial file is left; after a kill as well where
    the system supports files without a name.
    """
    target = Path(path).resolve()
    part = target.with_name(f".{secrets.token_hex(6)}.part")
    try:
        unnamed = _nameless_file(target.parent)
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


def _nameless_file(folder: Path) -> BinaryIO | None:
    """Return a new file without a name, which vanishes with its process; None where the system has no such files."""
    try:
        number = os.open(folder, os.O_TMPFILE | os.O_RDWR, 0o666)
    except (AttributeError, OSError):
        return None
    try:
        # Opened by its path, because some writers ask for the name of a handle, which a descriptor lacks.
        return open(f"/proc/self/fd/{number}", "r+b")
    except OSError:
        return None
    finally:
        os.close(number)


def _name(handle: BinaryIO, path: Path) -> None:
    """Give an unnamed file a name, as in open(2), O_TMPFILE.

    With a folder's descriptor Python follows the link in /proc; the absolute path makes the folder irrelevant.
    """
    os.link(f"/proc/self/fd/{handle.fileno()}", path, src_dir_fd=handle.fileno(), follow_symlinks=True)
