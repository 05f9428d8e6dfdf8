"""The parts of PNG, JPEG and HEIF files, counted before Pillow walks through them: it keeps each, and has no end."""

import re
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, BinaryIO
from warnings import catch_warnings

from p2sf.files.reading import PathName, check_unpacked, open_file, size_of
from p2sf.files.reasons import OversizedError
from p2sf.messages import Message

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

PNG, JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"
MOST_CHUNKS = 100_000  # of a PNG: 800 MB of picture at 8 kB a chunk, as libpng writes them
BESIDE = 64_000_000  # bytes of a PNG beside its picture: profiles, texts, Exif; Pillow reads them all
MOST_SEGMENTS = 10_000  # of a JPEG before its picture, a byte that belongs to none counted as one
MOST_SCANS = 60  # of a JPEG and the small ones in it; progressive ones have some ten, each of which costs all pixels
START_OF_SCAN, END, WITHOUT_LENGTH = 0xDA, 0xD9, {0x01, *range(0xD0, 0xD9)}  # ITU T.81, table B.1
MARK = re.compile(rb"\xff[\xc0-\xcf\xd8-\xfe]")  # behind the first scan, where others stand within data


@contextmanager
def open_picture(path: PathName, formats: tuple[str, ...]) -> Iterator["ImageFile"]:
    """Open a picture of one of Pillow's formats, its parts counted first and its pixels not yet unpacked.

    Raises OversizedError, OSError as `open_file`, and what Pillow raises for another file.
    """
    from PIL import Image

    with open_file(path) as stream:
        check_parts(stream)
    try:
        with catch_warnings(category=Image.DecompressionBombWarning, action="ignore"):
            picture = Image.open(path, formats=formats)
    except Image.DecompressionBombError as error:
        most = 2e-6 * (Image.MAX_IMAGE_PIXELS or 0)
        raise OversizedError(Message("more than {most:.0f} million pixels", most=most)) from error
    with picture:
        yield picture


def check_parts(stream: BinaryIO) -> None:
    """Raise OversizedError for a picture's file that costs more than its pixels; the stream is then at its start."""
    stream.seek(0)
    head = stream.read(len(PNG))
    if head == PNG:
        _check_chunks(stream)
    else:
        check_unpacked(size_of(stream), 0)
    if head.startswith(JPEG):
        _check_segments(stream)
    stream.seek(0)


def _check_chunks(stream: BinaryIO) -> None:
    """Raise OversizedError for a PNG of too many chunks, or with too much beside its picture (ISO/IEC 15948, 5.3)."""
    stream.seek(8)
    beside, left = 0, size_of(stream)
    for _ in range(MOST_CHUNKS):
        head = stream.read(8)
        if len(head) < 8 or head[4:] == b"IEND" or stream.tell() > left:
            return
        (length,) = struct.unpack(">I", head[:4])
        beside += length if head[4:] != b"IDAT" else 0
        if beside > BESIDE:
            raise OversizedError(Message("more than {most:.0f} MB beside the picture", most=BESIDE / 1e6))
        stream.seek(length + 4, 1)
    raise OversizedError(Message("more than {most} parts", most=MOST_CHUNKS))


def _check_segments(stream: BinaryIO) -> None:
    """Raise OversizedError for a JPEG whose picture begins late, or is refined too often (ITU T.81, B.1.1)."""
    stream.seek(2)
    for _ in range(MOST_SEGMENTS):
        mark = stream.read(1)
        if mark == b"\xff":
            kind = stream.read(1)
            if kind == b"\xff":
                stream.seek(-1, 1)  # a byte to fill in
            elif not kind or kind[0] == START_OF_SCAN:
                break
            elif kind[0] not in WITHOUT_LENGTH:
                stream.seek(max(0, int.from_bytes(stream.read(2), "big") - 2), 1)
        elif not mark:
            break
    else:
        raise OversizedError(Message("no picture within {most} parts", most=MOST_SEGMENTS))
    stream.seek(-2, 1)  # back to the first scan
    _check_scans(stream.read())


def _check_scans(data: bytes) -> None:
    """Raise OversizedError for too many scans up to the end of a JPEG's picture; phones append films behind that."""
    place = scans = 0
    for _ in range(MOST_SEGMENTS):
        mark = MARK.search(data, place)
        if mark is None or data[mark.end() - 1] == END:
            return
        scans += data[mark.end() - 1] == START_OF_SCAN
        if scans > MOST_SCANS:
            raise OversizedError(Message("more than {most} passes over its pixels", most=MOST_SCANS))
        place = mark.end() + int.from_bytes(data[mark.end() : mark.end() + 2], "big")
    raise OversizedError(Message("more than {most} parts", most=MOST_SEGMENTS))
