"""npz files sealed against damage: the archive's comment contains a hash of all other bytes.

Any .npz reader opens them. The checksums of a zip file cover its members but not its directory, so that without the
hash a changed byte might go unnoticed.
"""

import hashlib
import io
import re
from os import PathLike
from pathlib import Path

import numpy as np

from p2sf.errors import DatabaseError
from p2sf.files.reading import read_arrays, read_bytes
from p2sf.files.reasons import reason
from p2sf.files.writing import write_arrays, write_beside

SEAL = b"p2sf sha256 "
DIGITS = 64
SEALED = re.compile(re.escape(SEAL) + b"[0-9a-f]{%d}" % DIGITS)


def write_sealed(path: str | PathLike[str], arrays: dict[str, np.ndarray]) -> Path:
    """Write arrays to a sealed .npz atomically; the same arrays give the same bytes. Raises ExportError."""
    return write_beside(path, lambda handle: handle.write(seal(arrays)))


def seal(arrays: dict[str, np.ndarray]) -> bytes:
    """Return the bytes of a sealed .npz."""
    archive = io.BytesIO()
    write_arrays(archive, arrays)
    comment_length = (len(SEAL) + DIGITS).to_bytes(2, "little")
    unsealed = archive.getvalue()[:-2] + comment_length + SEAL  # a zip ends with the length of its comment, here 0
    return unsealed + _digest(unsealed)


def read_sealed(path: str | PathLike[str], mark: str) -> dict[str, np.ndarray]:
    """Return the arrays of a sealed .npz file; DatabaseError as `unseal`, and where it cannot be read."""
    return unseal(_bytes(path), mark, path)


def unseal(raw: bytes, mark: str, name: str | PathLike[str]) -> dict[str, np.ndarray]:
    """Return the arrays in the bytes of a sealed .npz file, whose first member is called ``mark``.

    Raises DatabaseError, which calls the file ``name``, for one that is foreign, cut short, or damaged.
    """
    if not SEALED.fullmatch(raw[-len(SEAL) - DIGITS :]):
        if mark.encode() in raw[:200]:  # which a file that was cut short still shows
            raise DatabaseError("{name} is cut short or damaged at its end; copy or build it again", name=str(name))
        raise DatabaseError("{name} is not a P2SF database; build one with p2sf database build", name=str(name))
    if _digest(raw[:-DIGITS]) != raw[-DIGITS:]:
        raise DatabaseError(
            "{name} is damaged, its contents do not match its seal; copy or build it again", name=str(name)
        )
    try:
        return read_arrays(io.BytesIO(raw))
    except (ValueError, OSError) as error:  # a seal is not a signature: anybody can seal anything
        raise DatabaseError(
            "{name} is sealed but {reason}; build it again", name=str(name), reason=str(error)
        ) from error


def _bytes(path: str | PathLike[str]) -> bytes:
    try:
        return read_bytes(path)
    except OSError as error:
        raise DatabaseError(
            "{path} cannot be read, {reason}; check the name",
            path=str(path),
            reason=reason(error),
        ) from error


def _digest(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode()
