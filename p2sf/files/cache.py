"""Arrays kept between runs in the platform's cache folder, or where P2SF_CACHE says; nothing depends on them.

What is damaged, foreign or cannot be written counts as missing. Files are written whole, so that programs that run at
the same time see old or new contents, never a part; the oldest go where all together exceed LARGEST.
"""

import os
from contextlib import suppress
from pathlib import Path

import numpy as np

from p2sf.files.atomic import write_whole
from p2sf.files.reading import read_arrays

VARIABLE = "P2SF_CACHE"
LARGEST = 64 * 2**20  # bytes of all files
ENDING = ".npz"

Arrays = dict[str, np.ndarray]


def cache_folder() -> Path | None:
    """Return the folder of the cache; None if P2SF_CACHE is empty, which switches it off."""
    stated = os.environ.get(VARIABLE)
    if stated is not None:
        return Path(stated) if stated.strip() else None
    from platformdirs import user_cache_path

    return user_cache_path("p2sf")


def read_cached(name: str) -> Arrays | None:
    """Return the arrays kept under a name; None if there are none, or they cannot be read."""
    folder = cache_folder()
    if folder is None:
        return None
    path = folder / (name + ENDING)
    try:
        found = read_arrays(path)
    except (OSError, ValueError):
        return None
    with suppress(OSError):
        os.utime(path)  # the oldest are those not used for longest
    return found


def write_cached(name: str, arrays: Arrays) -> None:
    """Keep arrays under a name, if the folder can be written to."""
    folder = cache_folder()
    if folder is None:
        return
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
        write_whole(folder / (name + ENDING), lambda handle: np.savez(handle, **arrays))  # type: ignore[arg-type]
        _drop_oldest(folder)


def _drop_oldest(folder: Path) -> None:
    """Remove files, those not used for longest first, until all together are within LARGEST."""
    files = []
    for path in folder.glob("*" + ENDING):
        with suppress(OSError):  # another program may have removed it
            files.append((path.stat().st_mtime, path.stat().st_size, path))
    total = sum(size for _, size, _ in files)
    for _, size, path in sorted(files):
        if total <= LARGEST:
            return
        with suppress(OSError):
            path.unlink()
        total -= size
