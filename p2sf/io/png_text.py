"""Texts in PNG files, in compressed chunks of their own (PNG 1.2, 3.2 and 4.2.3.3)."""

import os
import struct
import zlib

HEADER = 33  # bytes: signature and the chunk of the size
INTERNATIONAL = b"iTXt"
COMPRESSED = b"\0\1\0\0\0"  # ends the keyword; compressed by zlib, without language and translated keyword
MOST_CHUNKS = 100_000  # that are walked through: 800 MB of picture at 8 kB a chunk, as libpng writes them


def with_text(png: bytes, keyword: str, text: str) -> bytes:
    """Return a PNG with a text behind its header.

    Every other byte stays as it is: to encode the picture once more would take a third of a second.
    """
    data = INTERNATIONAL + keyword.encode("latin-1") + COMPRESSED + zlib.compress(text.encode())
    chunk = struct.pack(">I", len(data) - 4) + data + struct.pack(">I", zlib.crc32(data))
    return png[:HEADER] + chunk + png[HEADER:]


def text_in(path: str | os.PathLike[str], keyword: str, most: int) -> str | None:
    """Return a text that `with_text` put into a PNG; None where there is none.

    The picture is not unpacked. Raises ValueError for a text that is damaged or has more than ``most`` bytes, OSError
    as `open`.
    """
    begin = keyword.encode("latin-1") + COMPRESSED
    with open(path, "rb") as file:
        file.seek(8)
        for _ in range(MOST_CHUNKS):
            head = file.read(8)
            if len(head) < 8:
                return None
            (length,), kind = struct.unpack(">I", head[:4]), head[4:]
            if kind == INTERNATIONAL and length > len(begin):
                data = file.read(min(length, most + len(begin)))
                if data.startswith(begin):
                    return _unpacked(data.removeprefix(begin), most)
                file.seek(length - len(data) + 4, os.SEEK_CUR)
            else:
                file.seek(length + 4, os.SEEK_CUR)
    return None


def _unpacked(packed: bytes, most: int) -> str:
    inflating = zlib.decompressobj()
    try:
        plain = inflating.decompress(packed, most)
    except zlib.error as error:
        raise ValueError(str(error)) from error
    if not inflating.eof:
        raise ValueError(f"a text that is cut off or longer than {most} bytes")
    return plain.decode()
