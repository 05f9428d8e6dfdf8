"""PNG of 16 bits a sample, which Pillow reduces to 8 bits in colour pictures (ISO/IEC 15948)."""

import os
import struct
import zlib

import numpy as np

from p2sf.errors import RequestError
from p2sf.files.reading import OversizedError, check_samples, read_bytes

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # colour type: grey, RGB, grey with alpha, RGB with alpha
COLOUR_TYPE = {1: 0, 3: 2}
BAND = 256  # rows


def is_deep(head: bytes) -> bool:
    """Return whether these are the first bytes of a PNG with 16 bits a sample."""
    return head[:8] == SIGNATURE and len(head) > 26 and head[24] == 16


def read_deep(path: str | os.PathLike[str]) -> np.ndarray:
    """Return the samples of a 16-bit PNG, (rows, columns, channels) uint16; RequestError for a damaged file."""
    try:
        data = read_bytes(path)
    except OSError as error:
        raise RequestError(
            "{path} cannot be read, {reason}; save it smaller, or as a TIFF", path=str(path), reason=str(error.strerror)
        ) from error
    if data[25] not in CHANNELS or any(data[28:29]):
        raise RequestError(
            "{path} is an interlaced or indexed 16-bit PNG; save it without interlacing, in RGB or grey", path=str(path)
        )
    channels = CHANNELS[data[25]]
    try:
        width, height = struct.unpack(">II", data[16:24])
        check_samples((height, width, channels), len(data))
        # No more is unpacked than the header has announced.
        line = 2 * width * channels + 1
        raw = zlib.decompressobj().decompress(_body(data), height * line)
        plain = reverse_filters(np.frombuffer(raw, np.uint8).reshape(height, line), 2 * channels)
    except OversizedError as error:
        raise RequestError(
            "{path} is too large a PNG ({why}); save it smaller", path=str(path), why=str(error)
        ) from error
    except (zlib.error, ValueError) as error:
        raise RequestError(
            "{path} is a damaged PNG ({why}); save the picture again", path=str(path), why=str(error)
        ) from error
    return plain.view(">u2").astype(np.uint16).reshape(height, width, -1)


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


def _body(data: bytes) -> bytes:
    """Return the joined compressed data."""
    place, parts = 8, []
    while place + 8 <= len(data):
        (length,) = struct.unpack(">I", data[place : place + 4])
        if data[place + 4 : place + 8] == b"IDAT":
            parts.append(data[place + 8 : place + 8 + length])
        place += length + 12
    return b"".join(parts)


def reverse_filters(raw: np.ndarray, step: int) -> np.ndarray:
    """Return the bytes before filtering, (rows, width · step); each raw row begins with its filter's number.

    A byte depends on its neighbours on the left and above (ISO/IEC 15948, §9). Those of one diagonal do not depend on
    each other, hence one diagonal at a time, in bands of rows so that the slanted copy stays small. Raises ValueError
    for an unknown filter.
    """
    kinds, lines = raw[:, 0], raw[:, 1:].reshape(len(raw), -1, step)
    if kinds.max(initial=0) > 4 or not lines.size:
        raise ValueError("unknown filters")
    plain = np.empty_like(lines)
    above = np.zeros_like(lines[0])
    for start in range(0, len(raw), BAND):
        band = slice(start, start + BAND)
        plain[band] = _unfiltered_band(kinds[band], lines[band], above)
        above = plain[band][-1]
    return plain.reshape(len(raw), -1)


def _unfiltered_band(kinds: np.ndarray, lines: np.ndarray, above: np.ndarray) -> np.ndarray:
    """Return a band's bytes; ``above`` is the row before it. Row c of the slanted copy is the diagonal x + row = c."""
    rows, width, step = lines.shape
    slanted = np.zeros(
        (width + rows + 1, rows + 1, step), np.int16
    )  # one more at the start of each axis: zeros, and ``above``
    slanted[1 : width + 1, 0] = above
    row, pick = np.arange(rows), kinds[:, None]
    for c in range(width + rows - 1):
        now = slice(max(0, c - width + 1), min(rows, c + 1))
        shifted = slice(now.start + 1, now.stop + 1)
        left, up, corner = slanted[c + 1, shifted], slanted[c + 1, now], slanted[c, now]
        guess = _guess(pick[now], left, up, corner)
        slanted[c + 2, shifted] = (lines[row[now], c - row[now]] + guess) & 255
    return np.stack([slanted[r + 2 : r + 2 + width, r + 1] for r in row]).astype(np.uint8)


def _guess(kind: np.ndarray, left: np.ndarray, up: np.ndarray, corner: np.ndarray) -> np.ndarray:
    """Return each filter's prediction of a byte, 0 to 4: zero, left, above, their mean, Paeth's."""
    return np.choose(kind, (np.zeros_like(left), left, up, (left + up) >> 1, _paeth(left, up, corner)))


def _paeth(left: np.ndarray, up: np.ndarray, corner: np.ndarray) -> np.ndarray:
    """Return the neighbour nearest to left + up − corner; of equally near ones left before up before corner."""
    far_left, far_up, far_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
    up_or_corner = np.where(far_up <= far_corner, up, corner)
    return np.where((far_left <= far_up) & (far_left <= far_corner), left, up_or_corner)
