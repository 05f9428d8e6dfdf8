"""Files of unknown origin: what one may cost is checked by its kind, its size and what it declares, before it is paid.

Every reader opens its files here. What is refused is an OSError, as for a missing file, or a ValueError where the
content is wrong; `reasons.reason` says why.
"""

import errno
import json
import os
import re
import stat
import tomllib
import zipfile
from math import prod
from os import PathLike
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from p2sf.files.atomic import DAMAGED, NO_FILE
from p2sf.files.reasons import ContentRefusedError, FileRefusedError, OversizedError
from p2sf.messages import Message

if TYPE_CHECKING:
    from logging import Logger

LARGEST = 200_000_000  # bytes read or unpacked at once: any machine has room for them, and reads them in a second
PER_BYTE = 20  # bytes or samples that one byte of a large file may unpack to: photos have 2, charts 10
EVER = 10  # times as much is unpacked from no file, however large it is
LONGEST_TEXT = 8_000_000  # letters of JSON; as Python's own objects they take up to thirty times the room
MOST_MEMBERS = 2_000  # of an archive; a set of PSFs has a few arrays
MOST_SAMPLES = 320_000_000  # of any picture: 105 megapixels in colour, as light in four bytes 1.3 GB
FEW_SAMPLES = 50_000_000  # that a file of any size may hold: 16 megapixels of one colour, read in a second
SAMPLES_PER_BYTE = 50  # of a larger picture: 0.2 to 2 in a PNG, 20 in a HEIF, 50 in a JPEG of sky, 1000 where all is 0
LONGEST_SIDE = 65_535  # pixels, as in JPEG
NPY = b"\x93NUMPY\x01\x00"  # first of an array of numbers: the head of other versions may have any length
MOST_DOTS = 500  # in a line, between parts of a key: a hundred times more than any file needs
DOT = re.compile(r"(?<!\d)\.|\.(?!\d)|\.\d+\.")  # but not that of a number

PathName = str | PathLike[str]


def open_file(path: PathName) -> BinaryIO:
    """Open a file to be read; OSError as `open`, and for what has no end: a pipe, a device."""
    mode = os.stat(path).st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):  # of a folder `open` says so itself
        raise FileRefusedError(errno.EINVAL, NO_FILE, str(path))
    return open(path, "rb")


def read_bytes(path: PathName, most: int = LARGEST) -> bytes:
    """Return all bytes of a file; OSError as `open_file`, and for more than ``most``."""
    with open_file(path) as stream:
        if size_of(stream) <= most:
            return stream.read()
    more = Message("it has more than {count:g} million bytes", count=most / 1e6)
    raise FileRefusedError(errno.EFBIG, more, str(path))


def read_text(path: PathName, most: int = LONGEST_TEXT) -> str:
    """Return a file's text in UTF-8, with line feeds only; OSError as `read_bytes`, UnicodeDecodeError."""
    return read_bytes(path, most).decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")


def parse_json(text: str) -> Any:
    """Return what a JSON text holds; ValueError where it is another text, too long, or nested too deep."""
    if len(text) > LONGEST_TEXT:
        raise OversizedError(Message("{count} letters of JSON, at most {most}", count=len(text), most=LONGEST_TEXT))
    try:
        return json.loads(text)
    except RecursionError as error:
        raise ContentRefusedError(Message("lists or tables are nested too deep")) from error


def toml_table(text: str) -> dict[str, Any]:
    """Return the values of a TOML text; TOMLDecodeError, and ValueError for what no person writes.

    The time that a key takes is quadratic in its parts, which dots separate.
    """
    line = next((n for n, row in enumerate(text.split("\n"), 1) if sum(1 for _ in DOT.finditer(row)) > MOST_DOTS), 0)
    if line:
        raise ContentRefusedError(Message("line {line} has a key of more than {most} parts", line=line, most=MOST_DOTS))
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        raise
    except RecursionError as error:
        raise ContentRefusedError(Message("lists or tables are nested too deep")) from error
    except ValueError as error:
        raise ContentRefusedError(Message("a number is too long")) from error


def size_of(stream: BinaryIO) -> int:
    """Return the bytes of an open file or stream, whose place stays."""
    place = stream.tell()
    size = stream.seek(0, os.SEEK_END)
    stream.seek(place)
    return size


def check_unpacked(declared: int, size: int) -> None:
    """Raise OversizedError for more bytes to unpack than a file of ``size`` bytes can plausibly hold."""
    most = min(max(LARGEST, PER_BYTE * size), EVER * LARGEST)
    if declared > most:
        raise OversizedError(
            Message(
                "{declared:.0f} MB in {size} bytes, at most {most:.0f} MB",
                declared=declared / 1e6,
                size=size,
                most=most / 1e6,
            )
        )


def check_samples(shape: tuple[int, ...], size: int, sample_bytes: int = 1) -> None:
    """Raise OversizedError for a picture of more samples than is read, or than ``size`` bytes can plausibly hold.

    The one limit of all readers of pictures, asked before anything is unpacked; ContentRefusedError for no samples.
    """
    check_unpacked(prod(shape) * sample_bytes, size)
    most = min(max(FEW_SAMPLES, SAMPLES_PER_BYTE * size), MOST_SAMPLES)
    sort = OversizedError if prod(shape) else ContentRefusedError
    if not 0 < prod(shape) <= most or max(shape, default=1) > LONGEST_SIDE:
        raise sort(
            Message(
                "{shape} samples in {size} bytes, at most {side} on a side and {most:.0f} million in all",
                shape=" × ".join(map(str, shape)),
                size=size,
                side=LONGEST_SIDE,
                most=most / 1e6,
            )
        )


def zip_archive(stream: BinaryIO) -> zipfile.ZipFile:
    """Return the zip archive in a stream; OversizedError for one with too many members, or too large in all."""
    archive = zipfile.ZipFile(stream)
    members = archive.infolist()
    if len(members) > MOST_MEMBERS:
        raise OversizedError(Message("{count} members, at most {most}", count=len(members), most=MOST_MEMBERS))
    check_unpacked(sum(member.file_size for member in members), size_of(stream))
    return archive


def read_arrays(file: PathName | BinaryIO) -> dict[str, np.ndarray]:
    """Return the arrays of an .npz file, or of a stream, which stays open.

    Raises ValueError for a damaged or other file, OSError as `open_file`.
    """
    if isinstance(file, str | PathLike):
        with open_file(file) as stream:
            return read_arrays(stream)
    try:
        zip_archive(file)
        file.seek(0)
        with np.load(file, allow_pickle=False) as archive:
            return dict(archive)
    except DAMAGED as error:
        raise ContentRefusedError(Message("no archive of arrays: {error}", error=str(error))) from error


def read_array(path: PathName) -> np.ndarray:
    """Return the array of an .npy file, which stays in it; ValueError for another file, OSError as `open_file`."""
    with open_file(path) as stream:
        if stream.read(len(NPY)) != NPY:
            raise ContentRefusedError(Message("no array of numbers"))
    found: np.ndarray = np.load(path, mmap_mode="r", allow_pickle=False)
    check_samples(found.shape, found.nbytes, found.itemsize)
    return found


def silence(log: "Logger") -> None:
    """Keep a library from printing what it logs: tifffile does every defect of a file, which here is one exception."""
    from logging import NullHandler

    if not log.handlers:
        log.addHandler(NullHandler())


def first_page(path: PathName, begins: str = "") -> tuple[np.ndarray, str]:
    """Return the samples of the first page of a TIFF and its description.

    Raises ValueError for a file that is not a TIFF, for a page with more strips and tiles than the file has bytes, and,
    before anything is unpacked, for a description that does not begin as wanted; OSError as `open_file`, and tifffile's
    own errors for a damaged file.
    """
    import tifffile

    silence(tifffile.logger())
    try:
        with open_file(path) as stream, tifffile.TiffFile(stream) as file:
            page, size = file.pages.first, file.filehandle.size
            check_samples(page.shape, size, page.dtype.itemsize if page.dtype else 1)
            if prod(page.chunked) > size:
                raise ContentRefusedError(Message("{count} parts in {size} bytes", count=prod(page.chunked), size=size))
            if not page.description.startswith(begins):
                raise ContentRefusedError(Message("its description is of another program"))
            return page.asarray(), page.description
    except tifffile.TiffFileError as error:
        raise ValueError(str(error)) from error
