"""PNG of 16 bits a sample, which Pillow cuts down to 8 where there is colour (ISO/IEC 15948)."""

import struct
import zlib

import numpy as np

from p2sf.errors import RequestError

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # colour type: grey, RGB, grey with alpha, RGB with alpha
COLOUR_TYPE = {1: 0, 3: 2}
LARGEST = 2**28  # samples of a picture that is read


def is_deep(data: bytes) -> bool:
    """Return whether these are the bytes of a PNG with 16 bits a sample."""
    return data[:8] == SIGNATURE and len(data) > 26 and data[24] == 16


def read_deep(data: bytes, path) -> np.ndarray:
    """Return the samples of a 16-bit PNG, (rows, columns, channels) uint16; RequestError for a damaged file."""
    try:
        width, height, _, colour, _, _, interlaced = struct.unpack(">IIBBBBB", data[16:29])
        if interlaced or colour not in CHANNELS or not 0 < width * height * 4 <= LARGEST:
            raise RequestError(f"{path} is an interlaced or oversized 16-bit PNG; save it without interlacing")
        stride = width * CHANNELS[colour] * 2
        raw = np.frombuffer(zlib.decompress(_body(data)), np.uint8).reshape(height, stride + 1)
    except (struct.error, zlib.error, ValueError) as error:
        if isinstance(error, RequestError):
            raise
        raise RequestError(f"{path} is a damaged PNG ({error}); save the picture again") from error
    plain = _unfiltered(raw, 2 * CHANNELS[colour])
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


def _unfiltered(raw: np.ndarray, step: int) -> np.ndarray:
    """Return the bytes before filtering; ``step`` bytes a pixel (ISO/IEC 15948, §9)."""
    plain, above = np.empty((raw.shape[0], raw.shape[1] - 1), np.uint8), np.zeros(raw.shape[1] - 1, np.uint8)
    for number, row in enumerate(raw):
        kind, line = row[0], row[1:]
        if kind == 1:
            line = np.cumsum(line.reshape(-1, step), axis=0, dtype=np.uint8).ravel()
        elif kind == 2:
            line = line + above
        elif kind in (3, 4):
            line = _from_both(line.tolist(), above.tolist(), step, kind == 4)
        plain[number] = above = np.asarray(line, np.uint8)
    return plain


def _from_both(line: list[int], above: list[int], step: int, paeth: bool) -> list[int]:
    """Undo the average or the Paeth filter, which need the byte on the left first."""
    out = [0] * step + line
    upper = [0] * step + above
    for i in range(step, len(out)):
        left, up = out[i - step], upper[i]
        guess = _paeth(left, up, upper[i - step]) if paeth else (left + up) // 2
        out[i] = (out[i] + guess) & 255
    return out[step:]


def _paeth(left: int, up: int, corner: int) -> int:
    guess = left + up - corner
    return min((left, up, corner), key=lambda value: abs(guess - value))
