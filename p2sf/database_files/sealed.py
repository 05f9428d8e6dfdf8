"""npz files that know whether they are whole: a hash of every other byte stands in the archive's comment.

Any .npz reader opens them. A zip's own checksums cover the members but not its directory, so a changed byte
could otherwise pass.
"""

import hashlib
import io
import re
from pathlib import Path

import numpy as np

from p2sf.errors import DatabaseError
from p2sf.files.atomic import read_arrays
from p2sf.files.writing import write_beside

SEAL = b"p2sf sha256 "
DIGITS = 64
SEALED = re.compile(re.escape(SEAL) + b"[0-9a-f]{%d}" % DIGITS)


def write_sealed(path, arrays: dict[str, np.ndarray]) -> Path:
    """Write arrays to a sealed .npz, whole or not at all; the same arrays give the same bytes. Raises ExportError."""
    return write_beside(path, lambda handle: handle.write(sealed(arrays)))


def sealed(arrays: dict[str, np.ndarray]) -> bytes:
    """Return the bytes of a sealed .npz."""
    archive = io.BytesIO()
    np.savez_compressed(archive, **arrays)
    comment_length = (len(SEAL) + DIGITS).to_bytes(2, "little")
    unsealed = archive.getvalue()[:-2] + comment_length + SEAL  # a zip ends with the length of its comment, here 0
    return unsealed + _digest(unsealed)


def read_sealed(path, mark: str) -> dict[str, np.ndarray]:
    """Return the arrays of a sealed .npz file; DatabaseError as `opened` and when it is not there."""
    return opened(_bytes(path), mark, path)


def opened(raw: bytes, mark: str, name) -> dict[str, np.ndarray]:
    """Return the arrays of a sealed .npz's bytes; ``mark`` is its first member, which a damaged one still shows.

    Raises DatabaseError, starting with ``name``: not ours, cut short, or damaged.
    """
    if not SEALED.fullmatch(raw[-len(SEAL) - DIGITS :]):
        raise DatabaseError(f"{name} {_why_unsealed(raw, mark)}")
    if _digest(raw[:-DIGITS]) != raw[-DIGITS:]:
        raise DatabaseError(f"{name} is damaged, its contents do not match its seal; copy or build it again")
    try:
        return read_arrays(io.BytesIO(raw))
    except (ValueError, OSError) as error:  # a seal is no signature: whoever recomputes it may have put anything before
        raise DatabaseError(f"{name} is sealed but {error}; build it again") from error


def _why_unsealed(raw: bytes, mark: str) -> str:
    if mark.encode() in raw[:200]:
        return "is cut short or damaged at its end; copy or build it again"
    return "is not a P2SF database; build one with p2sf database build"


def _bytes(path) -> bytes:
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise DatabaseError(
            f"{path} cannot be read, {(error.strerror or str(error)).lower()}; check the name"
        ) from error


def _digest(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode()
