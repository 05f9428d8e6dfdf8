"""A HEIF photo with a depth image, as telephones store it: pillow-heif writes the pictures, this joins them.

Boxes are those of ISO/IEC 14496-12 and 23008-12: the second picture becomes an auxiliary one of the first by an
``auxl`` reference and an ``auxC`` property, which holds the depth_representation_info of ITU-T H.265, F.14.2.3.
"""

import struct
from io import BytesIO
from math import floor, log2
from pathlib import Path

import numpy as np

from p2sf.io.photo_files import ORIENTATION

AUXILIARY = b"urn:mpeg:hevc:2015:auxid:2\0"
DISPARITY, SEI, DEPTH_INFO = 1, 39, 177  # kinds of representation, of NAL units, and of SEI messages
MANTISSA = 24  # bits
Boxes = list[tuple[bytes, bytes]]


def write_heif_with_depth(
    path: Path, colours: np.ndarray, nearness: np.ndarray, limits: tuple[float, float], turned: tuple[int, int] = (1, 1)
) -> None:
    """Write colours, (rows, columns, 3) of 8 bits, with disparity, (rows, columns) of 8 bits, between limits in 1/m.

    ``turned``: how both are to be turned, as the orientation of Exif says it, which the file states of each of them.
    """
    import pillow_heif
    from PIL import Image

    file = pillow_heif.HeifFile()
    for picture, mode, orientation in zip((colours, nearness), ("RGB", "L"), turned, strict=True):
        exif = Image.Exif()
        exif[ORIENTATION] = orientation
        added = file.add_frombytes(mode, picture.shape[1::-1], picture.tobytes())
        added.info["exif"] = exif.tobytes()
    buffer = BytesIO()
    file.save(buffer, quality=90, save_all=True)
    path.write_bytes(joined(buffer.getvalue(), limits))


def joined(heif: bytes, limits: tuple[float, float]) -> bytes:
    """Return a HEIF file of two pictures, of which the second is the depth image of the first."""
    boxes = read_boxes(heif)
    meta = dict(boxes)[b"meta"]
    inner = read_boxes(meta[4:])
    pictures = _pictures(dict(inner)[b"iinf"])
    first, second = pictures
    changed: Boxes = []
    for name, body in inner:
        if name == b"iprp":
            body = _with_property(body, second, limits)
        if name == b"iref":
            body += _box(b"auxl", struct.pack(">HHH", second, 1, first))
        changed.append((name, body))
    if b"iref" not in dict(inner):
        changed.append((b"iref", bytes(4) + _box(b"auxl", struct.pack(">HHH", second, 1, first))))
    grown = sum(8 + len(body) for _, body in changed) + 4 - len(meta)
    changed = [(name, _moved(body, grown) if name == b"iloc" else body) for name, body in changed]
    whole = meta[:4] + b"".join(_box(*box) for box in changed)
    return b"".join(_box(name, whole if name == b"meta" else body) for name, body in boxes)


def read_boxes(data: bytes) -> Boxes:
    """Return the boxes in a run of bytes by name, in order."""
    found, at = [], 0
    while at < len(data):
        size, name = struct.unpack_from(">I4s", data, at)
        size = size or len(data) - at
        found.append((name, data[at + 8 : at + size]))
        at += size
    return found


def _box(name: bytes, body: bytes) -> bytes:
    return struct.pack(">I4s", 8 + len(body), name) + body


def _pictures(iinf: bytes) -> list[int]:
    """Return the numbers of the items that are pictures."""
    entries = read_boxes(iinf[6:] if iinf[0] == 0 else iinf[8:])
    return [struct.unpack_from(">H", body, 4)[0] for _, body in entries if body[8:12] == b"hvc1"]


def _with_property(iprp: bytes, item: int, limits: tuple[float, float]) -> bytes:
    """Return properties with one more, that an item is a depth image; those of other items stay."""
    (_, ipco), (_, ipma) = read_boxes(iprp)
    count = len(read_boxes(ipco)) + 1
    ipco += _box(b"auxC", bytes(4) + AUXILIARY + _depth_info(*limits))
    version, flags = ipma[0], ipma[3]
    assert (version, flags) == (0, 0) and count < 128
    out, at = [], 8
    for _ in range(struct.unpack_from(">I", ipma, 4)[0]):
        number, held = struct.unpack_from(">HB", ipma, at)
        own = ipma[at + 3 : at + 3 + held] + (bytes([count]) if number == item else b"")
        out.append(struct.pack(">HB", number, len(own)) + own)
        at += 3 + held
    return _box(b"ipco", ipco) + _box(b"ipma", ipma[:8] + b"".join(out))


def _moved(iloc: bytes, by: int) -> bytes:
    """Return the places of items in the file moved by some bytes; of version 1, with offsets of 4 bytes."""
    version, sizes, base = iloc[0], iloc[4], iloc[5] >> 4
    assert version in (0, 1) and sizes == 0x44 and base in (0, 4)
    out, at = bytearray(iloc), 8
    for _ in range(struct.unpack_from(">H", iloc, 6)[0]):
        method = struct.unpack_from(">H", iloc, at + 2)[0] & 15 if version else 0
        at += 2 + 2 * version + 2
        at_base, at = at, at + base
        (extents,) = struct.unpack_from(">H", iloc, at)
        at += 2
        for _ in range(extents):
            if method == 0 and not (base and struct.unpack_from(">I", iloc, at_base)[0]):
                struct.pack_into(">I", out, at, struct.unpack_from(">I", iloc, at)[0] + by)
            at += 8
        if method == 0 and base and struct.unpack_from(">I", iloc, at_base)[0]:
            struct.pack_into(">I", out, at_base, struct.unpack_from(">I", iloc, at_base)[0] + by)
    return bytes(out)


def _depth_info(low: float, high: float) -> bytes:
    """Return what depth_representation_info says of disparity between two limits, as a list of SEI messages."""
    bits = "0011" + _exp_golomb(DISPARITY) + _exp_golomb(0) + _number(low) + _number(high)
    bits += "1" + "0" * (-(len(bits) + 1) % 8)
    payload = int(bits, 2).to_bytes(len(bits) // 8, "big")
    unit = bytes([SEI << 1, 1, DEPTH_INFO, len(payload)]) + payload + b"\x80"
    message = struct.pack(">I", len(unit)) + unit
    return struct.pack(">I", len(message)) + message


def _exp_golomb(value: int) -> str:
    code = f"{value + 1:b}"
    return "0" * (len(code) - 1) + code


def _number(value: float) -> str:
    """Return a positive number as sign, exponent, length of the mantissa, and this."""
    power = floor(log2(value))
    mantissa = round((value / 2.0**power - 1) * 2**MANTISSA)
    return f"0{power + 31:07b}{MANTISSA - 1:05b}{mantissa:0{MANTISSA}b}"
