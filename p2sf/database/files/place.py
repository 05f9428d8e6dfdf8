"""Location of a stack: a folder, or any URL known to fsspec, such as a bucket of an object store.

A URL is opened with the settings and credentials of the machine that opens it, as fsspec and the library of its
protocol find them in the environment and in files; a stack stores none.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

from p2sf.errors import DatabaseError
from p2sf.files.reasons import reason

Place = Path | str
"""A folder, or the URL of a place elsewhere."""
HEADER = "zarr.json"
# Errors of object stores other than OSError, by the library that raises them.
ELSEWHERE = (
    ("botocore.exceptions", "BotoCoreError"),
    ("botocore.exceptions", "ClientError"),
    ("aiohttp", "ClientError"),
)


def is_url(path: str | os.PathLike[str]) -> bool:
    """Return whether a path is a URL and not a local folder."""
    text = os.fspath(path)
    return "://" in text and not text.startswith(("file://", "local://"))


def place_of(path: str | os.PathLike[str]) -> Place:
    """Return a path as a location; a ``file://`` URL is the folder it names."""
    text = os.fspath(path)
    if is_url(text):
        return text.rstrip("/")
    return Path(unquote(urlsplit(text).path)) if "://" in text else Path(text)


def is_stack(path: str | os.PathLike[str]) -> bool:
    """Return whether a path can be a stack only: a folder or a URL."""
    return is_url(path) or Path(path).is_dir()


def exists(place: Place) -> bool:
    """Return whether a stack, or anything else, exists there; DatabaseError if there is no answer."""
    if isinstance(place, Path):
        return place.exists()
    with translate_errors(place):
        files, root = _elsewhere(place)
        return bool(files.exists(f"{root}/{HEADER}"))


def chunk_names(place: str) -> set[str]:
    """Return the names of all chunks of the PSFs below a URL, "0/1/2/0/0" for one."""
    with translate_errors(place):
        files, root = _elsewhere(place)
        folder = f"{root}/psf/c/"
        return {str(name).removeprefix(folder) for name in files.find(folder)}


def send(draft: Path, place: str) -> None:
    """Copy the files of an empty stack to a URL, the main header last: without it there is no stack."""
    with translate_errors(place):
        files, root = _elsewhere(place)
        for file in sorted((file for file in draft.rglob("*") if file.is_file()), key=lambda f: f == draft / HEADER):
            files.pipe_file(f"{root}/{file.relative_to(draft).as_posix()}", file.read_bytes())


def size_bytes(place: Place) -> int:
    """Return the total size of the files at a location, bytes."""
    if isinstance(place, Path):
        return sum(file.stat().st_size for file in place.rglob("*") if file.is_file())
    with translate_errors(place):
        files, root = _elsewhere(place)
        return int(files.du(root))


def _elsewhere(place: str) -> tuple[Any, str]:
    """Return the file system of a URL and the path in it; files written by others in the meantime are seen."""
    try:
        from fsspec.core import url_to_fs

        files, root = url_to_fs(place)
    except (ImportError, ValueError) as error:  # no library for the protocol, or no such protocol
        raise DatabaseError(
            "{path} needs a library that is not installed, {reason}", path=place, reason=reason(error)
        ) from error
    files.invalidate_cache()
    return files, root


@contextmanager
def translate_errors(place: Place) -> Iterator[None]:
    """Turn errors of a remote location into a DatabaseError; errors of a folder pass."""
    if isinstance(place, Path):
        yield
        return
    try:
        yield
    except failures() as error:
        raise DatabaseError(
            "{path} cannot be reached, {reason}; check the address, and this machine's access to it",
            path=place,
            reason=reason(error),
        ) from error


def failures() -> tuple[type[Exception], ...]:
    """Return the errors of reading and writing, in a folder or by any of the loaded libraries."""
    loaded = ((sys.modules.get(module), name) for module, name in ELSEWHERE)
    return (OSError, *(getattr(module, name) for module, name in loaded if module))
