"""The state inside a file that the window saved: found again by what a file is, not by its name. No Qt in here."""

import os
from collections.abc import Callable
from io import TextIOWrapper
from itertools import takewhile
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np

from p2sf.errors import P2SFError
from p2sf.files.atomic import DAMAGED
from p2sf.files.reading import open_file, parse_json, silence
from p2sf.io.png_text import text_in
from p2sf.messages import Message
from p2sf_explorer.state.state import State
from p2sf_explorer.state.state_files import state_from_json

KEYWORD = "p2sf-state"  # of the text in a picture
ENTRY = "state"  # of the facts that data carry as JSON
MOST = 4_000_000  # bytes of a state: one with two lenses of thousands of numbers has a quarter of it
HEAD = 200
PathLike = str | os.PathLike[str]
DATABASE = Message("this is a database of PSFs, not a lens or a state; use it with p2sf psf, or open its lens")
STATELESS = Message(
    "there is no readable state in this picture or PSF; open a snapshot, written by the window with Ctrl+E, or with "
    "the Image panel open drop a photo"
)
CSV_HEAD = b"# point spread function"
META = "meta.npy"
CSV_META = "# meta: "
BEGINNINGS = (
    (b"\x89PNG", "png"),
    (b"PK\x03\x04", ".npz"),
    (b"II*\0", ".tiff"),
    (b"MM\0*", ".tiff"),
    (b"SIMPLE  =", "fits"),
    (CSV_HEAD, ".csv"),
    (b"v/1\x01", "exr"),
)


def state_inside(path: PathLike) -> State | None:
    """Return the state that a file holds; None for a file without one.

    P2SFError for one that cannot be, and where the library is missing that reads the file.
    """
    text = _text(path)
    return None if text is None else state_from_json(text, Message("the state inside {name}", name=Path(path).name))


def text_inside(path: PathLike) -> str | None:
    """Return the text of the state that a file holds, None where there is none that can be read."""
    try:
        return _text(path)
    except P2SFError:
        return None


def _text(path: PathLike) -> str | None:
    kind = kind_of(path)
    if kind is None:
        return None
    try:
        found = READERS[kind](path)
    except P2SFError:
        raise
    except (OSError, ValueError, *DAMAGED):
        return None  # `foreign` says that there is none
    return found if isinstance(found, str) and len(found) <= MOST else None


def foreign(path: PathLike) -> Message | None:
    """Return why a file without a state in it is no lens either; None where it may be one, as in a zip."""
    kind = kind_of(path)
    if kind == ".npz":
        start = _beginning(path)
        return DATABASE if b"p2sf_database.npy" in start else STATELESS if b".npy" in start else None
    return STATELESS if kind else None


def _beginning(path: PathLike) -> bytes:
    try:
        with open_file(path) as stream:
            return stream.read(HEAD)
    except OSError:
        return b""


def kind_of(path: PathLike) -> str | None:
    """Return which file that holds a state this may be by its first bytes, None for none."""
    head = _beginning(path)
    return next((kind for beginning, kind in BEGINNINGS if head.startswith(beginning)), None)


def _in_png(path: PathLike) -> Any:
    return text_in(path, KEYWORD, MOST)


def _in_npz(path: PathLike) -> Any:
    with open_file(path) as stream, ZipFile(stream) as archive:
        if archive.getinfo(META).file_size > 8 * MOST:  # numpy keeps four bytes a letter, and JSON escapes some
            raise ValueError(META)
        with archive.open(META) as member:
            return parse_json(str(np.lib.format.read_array(member, allow_pickle=False))).get(ENTRY)


def _in_tiff(path: PathLike) -> Any:
    """Return the state in a TIFF's description, or in the Info of ImageJ's."""
    import tifffile

    silence(tifffile.logger())
    with tifffile.TiffFile(path) as file:
        page: Any = file.pages.first
        told = (file.imagej_metadata or {}).get("Info", "") if file.is_imagej else page.description
    facts = parse_json(told)
    return facts.get(ENTRY, facts.get(KEYWORD))


def _in_fits(path: PathLike) -> Any:
    from p2sf.io.fits import picture_and_meta

    return picture_and_meta(path)[1].get(ENTRY)


def _in_csv(path: PathLike) -> Any:
    with TextIOWrapper(open_file(path), encoding="utf-8") as file:
        lines = takewhile(lambda line: line.startswith("#"), iter(lambda: file.readline(2 * MOST), ""))
        meta = next((line.removeprefix(CSV_META) for line in lines if line.startswith(CSV_META)), "{}")
    return parse_json(meta).get(ENTRY)


def _in_exr(path: PathLike) -> Any:
    from p2sf.io.photo_files import exr_library

    with exr_library(path).File(os.fspath(path), header_only=True) as file:
        return file.header().get(KEYWORD)


READERS: dict[str, Callable[[PathLike], Any]] = {
    "png": _in_png,
    ".npz": _in_npz,
    ".tiff": _in_tiff,
    "fits": _in_fits,
    ".csv": _in_csv,
    "exr": _in_exr,
}
