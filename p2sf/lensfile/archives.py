"""Lenses inside archives, with the glass catalogues that travel with them: zip, and OpticStudio's .zar.

A .zar is a row of records. Each begins with its version, EA 00, EA 03 (of 2010) or EC 03, and has the size of its data,
the name and the data themselves at fixed places; data under a name that ends in .LZW are compressed (T. A. Welch,
Computer 17, 8, 1984), with codes of nine bits and more, the first bit first. The places are those that the package
zmxtools documents.
"""

import io
import zipfile
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import PureWindowsPath

from p2sf.errors import LensFileError
from p2sf.files.reading import zip_archive

# A prescription of a thousand surfaces is 300 kB, the largest glass catalogue 1.2 MB.
LARGEST_BYTES = 4_000_000
LENSES = (".zmx", ".seq", ".len", ".roa", ".fx", ".json", ".txt")
CATALOGUE = ".agf"
MOST_CATALOGUES = 20  # of the largest two seconds of reading
DAMAGED = (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, OSError, ValueError)
COMPRESSED = ".LZW"
ZIP = b"PK\x03\x04"


@dataclass(frozen=True)
class ZarLayout:
    """Where a record of a .zar has what: the size of its data, its name, how that is encoded, and its data."""

    size: slice
    name: int
    encoding: str
    data: int


LAYOUTS = {
    **dict.fromkeys((b"\xea\x00", b"\xea\x03"), ZarLayout(slice(0x0C, 0x10), 0x20, "utf-8", 0x14C)),
    b"\xec\x03": ZarLayout(slice(0x10, 0x18), 0x30, "utf-16-le", 0x288),
}
Member = tuple[str, Callable[[], bytes]]  # a name, and what unpacks it


def is_archive(data: bytes) -> bool:
    """Return whether these are the bytes of a zip archive or of a .zar."""
    return data[:4] == ZIP or data[:2] in LAYOUTS


def unpack(data: bytes, path: str) -> list[tuple[str, bytes]]:
    """Return name and bytes of the first lens of an archive, and of its glass catalogues behind it.

    LensFileError for an archive that is damaged or holds no lens, and as for a file where one of them is too large.
    """
    try:
        members = list((_zip_members if data[:4] == ZIP else _zar_members)(data))
        lenses = [member for member in members if member[0].lower().endswith(LENSES)]
        if not lenses:
            raise LensFileError("the archive contains no .zmx or .seq file; unpack the lens yourself", path)
        first = min(lenses, key=lambda member: (not member[0].lower().endswith(LENSES[0]), member[0]))
        catalogues = [member for member in members if member[0].lower().endswith(CATALOGUE)][:MOST_CATALOGUES]
        unpacked = [(name, read()) for name, read in (first, *catalogues)]
    except DAMAGED as failure:
        raise LensFileError(
            "the archive cannot be unpacked ({reason}); unpack it yourself", path, reason=str(failure)
        ) from failure
    for name, content in unpacked:
        check_size(len(content), f"{path}/{name}")
    return unpacked


def check_size(count: int, path: str) -> None:
    """Raise LensFileError for a file of more than `LARGEST_BYTES`."""
    if count > LARGEST_BYTES:
        raise LensFileError(
            "the file is over {size:g} MB; a prescription is far smaller", path, size=LARGEST_BYTES / 1e6
        )


def _zip_members(data: bytes) -> Iterator[Member]:
    archive = zip_archive(io.BytesIO(data))
    for name in archive.namelist():
        yield name, partial(_from_zip, archive, name)


def _from_zip(archive: zipfile.ZipFile, name: str) -> bytes:
    with archive.open(name) as stream:
        return stream.read(LARGEST_BYTES + 1)


def _zar_members(data: bytes) -> Iterator[Member]:
    start = 0
    while start < len(data):
        layout = LAYOUTS.get(data[start : start + 2])
        if layout is None:
            raise ValueError(f"byte {start} begins no record")
        head = data[start : start + layout.data]
        size = int.from_bytes(head[layout.size], "little")
        name = head[layout.name :].decode(layout.encoding, "replace").partition("\0")[0]
        start += layout.data + size
        if start > len(data):
            raise EOFError("it ends within a record")
        content = data[start - size : start]
        if name.upper().endswith(COMPRESSED):
            yield PureWindowsPath(name[: -len(COMPRESSED)]).name, partial(decompress_lzw, content)
        else:
            yield PureWindowsPath(name).name, partial(bytes, content)


def decompress_lzw(data: bytes) -> bytes:
    """Return what LZW has compressed; ValueError for a code that cannot stand there. Stops above `LARGEST_BYTES`."""
    words = [bytes([value]) for value in range(256)]
    found, last = bytearray(), b""
    waiting = bits = 0
    width = 9
    for byte in data:
        waiting, bits = waiting << 8 | byte, bits + 8
        if bits < width:
            continue
        bits -= width
        code, waiting = waiting >> bits, waiting & ((1 << bits) - 1)
        if code > len(words) - (not last):
            raise ValueError(f"code {code} has no word")
        word = words[code] if code < len(words) else last + last[:1]
        if last:
            words.append(last + word[:1])
        found += word
        last = word
        if len(found) > LARGEST_BYTES:
            break
        width = max(9, len(words).bit_length())
    return bytes(found)
