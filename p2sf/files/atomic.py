"""Files written atomically, even if an error, a full disk or a kill interrupts the writing."""

import errno
import os
import stat
import struct
import warnings
import zlib
from collections.abc import Callable
from contextlib import suppress
from tokenize import TokenError
from typing import BinaryIO
from zipfile import BadZipFile

from p2sf.errors import FileWarning
from p2sf.files.reasons import FileRefusedError
from p2sf.messages import Message

CUT = (
    "{path} had another name (a hard link), under which the old contents stay; copy the new file there if it is to "
    "follow"
)
NO_FILE = Message("it is a pipe or a device and not a file")
PROTECTED = Message("the file is write-protected")
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
    the system supports files without a name. A file that is replaced leaves its mode and, where that is allowed, its
    owner to the new one. A symbolic link stays, and what it names is replaced; a hard link is cut, with a FileWarning.
    """
    target = os.path.realpath(path)
    replaced = replaceable(target)
    folder = os.path.dirname(target)
    part = os.path.join(folder, f".{os.urandom(6).hex()}.part")
    try:
        unnamed = _nameless_file(folder)
        with unnamed or open(part, "xb") as handle:
            if replaced:
                _take_after(replaced, handle.fileno())
            write(handle)
            handle.flush()
            os.fsync(handle.fileno())
            if unnamed:
                _name(handle, part)
        os.replace(part, target)
    finally:
        with suppress(OSError):
            os.unlink(part)
    if replaced and replaced.st_nlink > 1:
        warnings.warn(FileWarning(Message(CUT, path=os.fspath(path))), stacklevel=3)


def replaceable(path: str | os.PathLike) -> os.stat_result | None:
    """Return what is known of the file that a new one would replace, None where there is none yet.

    Raises OSError for a folder, for a FIFO or a device, which would be gone, and for a file that is write-protected.
    """
    try:
        found = os.stat(path)
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(found.st_mode):
        raise OSError(errno.EISDIR, os.strerror(errno.EISDIR), os.fspath(path))
    if not stat.S_ISREG(found.st_mode):
        raise FileRefusedError(errno.EOPNOTSUPP, NO_FILE, os.fspath(path))
    if not os.access(path, os.W_OK):
        raise FileRefusedError(errno.EACCES, PROTECTED, os.fspath(path))
    return found


def _take_after(replaced: os.stat_result, number: int) -> None:
    """Give an open file the owner and the mode of another, as far as the system has and allows it."""
    with suppress(OSError, AttributeError):
        os.fchown(number, replaced.st_uid, replaced.st_gid)
    with suppress(OSError, AttributeError):
        os.fchmod(number, stat.S_IMODE(replaced.st_mode))  # second, since a change of owner clears bits


def _nameless_file(folder: str) -> BinaryIO | None:
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


def _name(handle: BinaryIO, path: str) -> None:
    """Give an unnamed file a name, as in open(2), O_TMPFILE.

    With a folder's descriptor Python follows the link in /proc; the absolute path makes the folder irrelevant.
    """
    os.link(f"/proc/self/fd/{handle.fileno()}", path, src_dir_fd=handle.fileno(), follow_symlinks=True)
