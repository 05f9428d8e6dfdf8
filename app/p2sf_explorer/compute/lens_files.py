"""Lens files of the user: whether they are there, whether they have changed, and how they were read. No Qt in here."""

import os
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from p2sf.lensfile.importing import Import


def import_of(path: str, accept_substitutes: bool = False) -> "Import":
    """Return a lens file's lens and report, read again when the file has changed; P2SFError."""
    return _read(path, stamp(path), accept_substitutes)


@lru_cache(maxsize=16)
def _read(path: str, _stamp: tuple[int, int], accept_substitutes: bool) -> "Import":
    from p2sf.lensfile.importing import import_lens

    return import_lens(path, accept_substitutes)


def stamp(path: str) -> tuple[int, int]:
    """Return the modification time (ns) and the size of a file, which change with it; zeros where there is none."""
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return 0, 0
    return found.st_mtime_ns, found.st_size


def is_file(path: str) -> bool:
    """Return whether there is such a file; False for a name that no file can have."""
    try:
        return Path(path).is_file()
    except (OSError, ValueError):
        return False
