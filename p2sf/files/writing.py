"""Result files and JSON, written to a temporary file beside the target and renamed; failures are `ExportError`."""

import errno
import json
import os
from collections.abc import Callable, Iterable, Mapping
from math import isfinite
from os import PathLike
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

import numpy as np

from p2sf.errors import ExportError
from p2sf.files.atomic import replaceable, write_whole
from p2sf.files.reasons import reason
from p2sf.messages import Message

Kind = TypeVar("Kind")
LARGEST_READ = 64_000_000  # bytes of a file that are searched for a mark: some hundred pages as PDF
FREE_SPACE = Message("free some space or choose another disk")
WRITABLE_FOLDER = Message("choose a folder you may write to")
ANOTHER_PLACE = Message("choose another place")
REMEDIES = {
    errno.ENOSPC: FREE_SPACE,
    errno.EDQUOT: FREE_SPACE,
    errno.EFBIG: Message("choose fewer pixels or another disk"),
    errno.EACCES: WRITABLE_FOLDER,
    errno.EPERM: WRITABLE_FOLDER,
    errno.EROFS: WRITABLE_FOLDER,
    errno.ENOENT: Message("make the folder first or choose another"),
    errno.ENOTDIR: Message("choose a folder that is one"),
    errno.EISDIR: Message("give the name of a file in it"),
    errno.EOPNOTSUPP: Message("give the name of a file"),
}


def write_json(path: str | PathLike, value: dict[str, Any]) -> Path:
    """Write a JSON object atomically; values that are not finite become null. Raises ExportError."""
    text = json.dumps(plain(value), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    return write_beside(path, lambda handle: handle.write(text.encode()))


def write_beside(path: str | PathLike, write: Callable[[BinaryIO], object]) -> Path:
    """Call ``write`` with a new file next to ``path``, then rename it to ``path``; raises ExportError.

    On failure an existing file at ``path`` keeps its contents and no partial file is left.
    """
    try:
        write_whole(path, write)
    except OSError as error:
        raise _unwritable(path, error) from error
    return Path(path)


def write_arrays(handle: BinaryIO, arrays: Mapping[str, np.ndarray], meta: Mapping[str, Any] | None = None) -> None:
    """Write arrays as a compressed .npz, with ``meta`` as the JSON text of another one, where there is any."""
    facts = {} if meta is None else {"meta": np.array(json.dumps(meta))}
    np.savez_compressed(handle, **arrays, **facts)  # type: ignore[arg-type]  # its stub takes them for allow_pickle


def by_ending(path: str | PathLike[str], kinds: Mapping[str, Kind]) -> Kind:
    """Return what belongs to the ending of a path, such as what writes the file; ExportError for an unknown one."""
    ending = Path(path).suffix
    if ending.lower() not in kinds:
        raise ExportError(
            '{path}: the ending "{ending}" is unknown; choose {choices}',
            path=str(path),
            ending=ending,
            choices=tuple(sorted(kinds)),
        )
    return kinds[ending.lower()]


def check_place(path: str | PathLike) -> None:
    """Raise ExportError if `write_beside` cannot succeed: no such folder, or ``path`` is a folder, device or FIFO."""
    try:
        if replaceable(path) is None:
            os.stat(os.path.dirname(os.path.realpath(path)))
    except OSError as error:
        raise _unwritable(path, error) from error


def check_own(path: str | PathLike, mark: bytes) -> None:
    """Raise ExportError if a file is there without the ``mark`` of those that this program writes.

    For names that nobody has typed, and so nobody knows to be replaced.
    """
    try:
        if replaceable(path) is None:
            return
        with open(path, "rb") as file:
            own = mark in file.read(LARGEST_READ)
    except OSError as error:
        raise _unwritable(path, error) from error
    if not own:
        raise ExportError(
            "{path} is there already and is not of this program; move it, or choose another name", path=str(path)
        )


def check_known_ending(path: str | PathLike[str], endings: Iterable[str]) -> None:
    """Raise ExportError unless the name of an output has one of the endings that choose what is written."""
    if Path(path).suffix.lower() not in endings:
        raise ExportError(
            '{parameter} is {path}, its ending "{ending}" is unknown; choose {endings}',
            parameter="output",
            path=str(path),
            ending=Path(path).suffix,
            endings=tuple(endings),
        )


def check_ending(name: str, path: str | PathLike[str], ending: str, wanted: Message) -> None:
    """Raise ExportError unless the name of a file of the kind ``wanted`` has its ending."""
    if Path(path).suffix.lower() != ending:
        raise ExportError(
            "{parameter} is {path}; {wanted}, choose a name that ends in {ending}",
            parameter=name,
            path=str(path),
            wanted=wanted,
            ending=ending,
        )


def _unwritable(path: str | PathLike, error: OSError) -> ExportError:
    remedy = REMEDIES.get(error.errno or 0, ANOTHER_PLACE)
    return ExportError(
        "{path} cannot be written, {reason}; {remedy}", path=str(path), reason=reason(error), remedy=remedy
    )


def plain(value: object) -> Any:
    """Return a value as JSON types: numbers, strings, lists and dicts; a float that is not finite becomes None."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return value + 0.0 if isfinite(value) else None  # + 0.0 turns −0 into 0
    return value
