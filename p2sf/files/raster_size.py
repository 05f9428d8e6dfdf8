"""Limits to the size that an image file declares, checked before memory is allocated for it."""

from logging import NullHandler
from math import prod
from os import PathLike
from typing import BinaryIO

import numpy as np

SAMPLES = 50_000_000  # samples in any file
PER_BYTE = 20  # samples per byte of a large file: photos have 2, charts 10
LONGEST = 65_535  # pixels on a side, as in JPEG
SILENT = NullHandler()  # tifffile logs every defect of a file; here it is one exception


class OversizedError(ValueError):
    """An image with too many samples to unpack; the file itself may be valid."""


def check_samples(shape: tuple[int, ...], size: int) -> None:
    """Raise OversizedError for more samples than ``size`` bytes can plausibly hold, ValueError for none."""
    claim = " × ".join(map(str, shape))
    reason = f"{claim} samples in {size} bytes, at most {LONGEST} on a side and {SAMPLES:,} in all"
    if not prod(shape):
        raise ValueError(reason)
    if max(shape) > LONGEST or prod(shape) > max(SAMPLES, PER_BYTE * size):
        raise OversizedError(reason)


def first_page(source: str | PathLike | BinaryIO) -> tuple[np.ndarray, str]:
    """Return the samples of the first page of a TIFF and its description.

    ``source`` is a path or a stream. Raises ValueError for a file that is not a TIFF and for a page with more strips
    and tiles than the file has bytes; OSError as `open`, and tifffile's own errors for a damaged file.
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
