"""Whole files or none: write beside, then rename."""

import errno
import json
import os
from collections.abc import Callable
from math import isfinite
from pathlib import Path
from typing import BinaryIO

import numpy as np

from p2sf.errors import ExportError
from p2sf.files.atomic import write_whole

REMEDIES = {
    errno.ENOSPC: "free some space or choose another disk",
    errno.EDQUOT: "free some space or choose another disk",
    errno.EFBIG: "choose fewer pixels or another disk",
    errno.EACCES: "choose a folder you may write to",
    errno.EPERM: "choose a folder you may write to",
    errno.EROFS: "choose a folder you may write to",
    errno.ENOENT: "make the folder first or choose another",
    errno.ENOTDIR: "choose a folder that is one",
    errno.EISDIR: "give the name of a file in it",
}


def write_json(path, value: dict) -> Path:
    """Write a JSON object, whole or not at all; infinite values become null. Raises ExportError."""
    text = json.dumps(plain(value), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    return write_beside(path, lambda handle: handle.write(text.encode()))


def write_beside(path, write: Callable[[BinaryIO], object]) -> Path:
    """Let ``write`` fill a new file next to ``path``, then give it that name; raises ExportError.

    Whatever fails, a file already at ``path`` keeps its contents and no half-written one is left.
    """
    try:
        write_whole(path, write)
    except OSError as error:
        raise ExportError(_why_not(path, error)) from error
    return Path(path)


def check_place(path) -> None:
    """Raise ExportError where `write_beside` could only fail: the folder is missing, or ``path`` is itself one."""
    target = Path(path).resolve()
    wrong = errno.EISDIR if target.is_dir() else 0 if target.parent.is_dir() else errno.ENOENT
    if wrong:
        raise ExportError(_why_not(path, OSError(wrong, os.strerror(wrong))))


def _why_not(path, error: OSError) -> str:
    reason = (error.strerror or str(error)).rstrip(".").lower()
    return f"{path} cannot be written, {reason}; {REMEDIES.get(error.errno, 'choose another place')}"


def plain(value):
    """Return numbers, texts, lists and dicts that JSON can carry; what is not finite becomes None."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return value + 0.0 if isfinite(value) else None  # + 0.0 turns −0 into 0
    return value
