"""Limits to the size that a picture file claims, checked before memory is taken for it."""

from logging import NullHandler
from math import prod
from os import PathLike
from typing import BinaryIO

import numpy as np

SAMPLES = 50_000_000  # that any file may hold
PER_BYTE = 20  # that a large file may hold for each of its bytes: photos come to 2, charts to 10
LONGEST = 65_535  # pixels on a side, as in JPEG
SILENT = NullHandler()  # tifffile logs every fault of a file, which is one exception here


class OversizedError(ValueError):
    """A picture of more samples than are unpacked; the file itself may be sound."""


def check_samples(shape: tuple[int, ...], size: int) -> None:
    """Raise OversizedError for more samples than ``size`` bytes can reasonably hold, ValueError for no samples."""
    claim = " × ".join(map(str, shape))
    reason = f"{claim} samples in {size} bytes, at most {LONGEST} on a side and {SAMPLES:,} in all"
    if not prod(shape):
        raise ValueError(reason)
    if max(shape) > LONGEST or prod(shape) > max(SAMPLES, PER_BYTE * size):
        raise OversizedError(reason)


def first_page(source: str | PathLike | BinaryIO) -> tuple[np.ndarray, str]:
    """Return the samples of a TIFF's first page and its description.

    ``source`` is a path or a stream. Raises ValueError for a file that is not a TIFF and for a page of more strips and
    tiles, each of which takes bytes, than the file has bytes; OSError as `open`, and tifffile's own errors for a
    damaged file.
    """
    import tifffile

    tifffile.logger().addHandler(SILENT)
    try:
        with tifffile.TiffFile(source) as file:
            page, size = file.pages.first, file.filehandle.size
            check_samples(page.shape, size)
            if prod(page.chunked) > size:
                raise ValueError(f"{prod(page.chunked)} parts in {size} bytes")
            return page.asarray(), page.description
    except tifffile.TiffFileError as error:
        raise ValueError(str(error)) from error
