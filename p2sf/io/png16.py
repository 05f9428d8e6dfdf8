"""PNG of 16 bits a sample, which Pillow reduces to 8 bits in colour pictures (ISO/IEC 15948)."""

import os
import struct
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from p2sf.files.picture_parts import open_picture

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

SIGNATURE = b"\x89PNG\r\n\x1a\n"
GREY, RGB, GREY_ALPHA, RGBA = 0, 2, 4, 6  # colour types
COLOUR_TYPE = {1: GREY, 3: RGB}  # by channels


def deep_colours(head: bytes) -> int | None:
    """Return the colour type of a PNG that Pillow would reduce to 8 bits, from its first bytes; None for others."""
    deep = head[:8] == SIGNATURE and len(head) > 26 and head[24] == 16
    return head[25] if deep and head[25] in (RGB, GREY_ALPHA, RGBA) else None


def read_deep(picture: "ImageFile", colour_type: int) -> np.ndarray:
    """Return the samples of an open 16-bit PNG in colours or with alpha, (rows, columns, channels) uint16.

    Pillow undoes the filters of all 16 bits and then keeps the high bytes. Told that they are little-endian it keeps
    the other byte of each pair, hence all of them in two passes; grey with alpha has four bytes a pixel, as RGBA of 8
    bits has. Raises as Pillow does.
    """
    if colour_type == GREY_ALPHA:
        return _unpacked(picture, "RGBA").view(">u2").astype(np.uint16)
    deep = _unpacked(picture, f"{picture.mode};16B").astype(np.uint16)
    deep <<= 8
    with open_picture(os.fsdecode(picture.filename), ("PNG",)) as again:
        deep |= _unpacked(again, f"{picture.mode};16L")
    return deep


def _unpacked(picture: "ImageFile", raw_mode: str) -> np.ndarray:
    """Return the samples of a PNG that is not loaded yet, of 8 bits, as Pillow unpacks them by one of its raw modes."""
    tile: Any = picture.tile[0]  # where its data are, as Pillow's guide to plugins has it: coder, box, place, raw mode
    picture.tile = [(*tile[:3], raw_mode)]  # type: ignore[list-item]  # a named tuple since Pillow 11.1
    return np.asarray(picture)


def write_deep(values: np.ndarray) -> bytes:
    """Return the bytes of a 16-bit PNG of uint16 samples, (rows, columns) or (rows, columns, 3)."""
    rows = values.reshape(*values.shape[:2], -1)
    height, width, channels = rows.shape
    raw = np.ascontiguousarray(rows.astype(">u2")).view(np.uint8).reshape(height, -1)
    up = np.diff(
        raw, axis=0, prepend=np.zeros((1, raw.shape[1]), np.uint8)
    )  # filter 2: the difference to the row above
    body = np.concatenate([np.full((height, 1), 2, np.uint8), up], axis=1).tobytes()
    header = struct.pack(">IIBBBBB", width, height, 16, COLOUR_TYPE[channels], 0, 0, 0)
    chunks = (b"IHDR", header), (b"IDAT", zlib.compress(body, 6)), (b"IEND", b"")
    return SIGNATURE + b"".join(_chunk(*chunk) for chunk in chunks)


def _chunk(name: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
