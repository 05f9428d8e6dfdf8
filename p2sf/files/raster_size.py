"""Picture files held to what their bytes can mean, before anything is made of their size."""

from logging import NullHandler
from math import prod

import numpy as np

SAMPLES = 50_000_000  # that any file may hold
PER_BYTE = 20  # that a large one may hold for each of its bytes: photos come to 2, charts to 10
LONGEST = 65_535  # pixels of a side, as in JPEG
UNHEARD = NullHandler()  # tifffile logs every fault of a file, which is one sentence here


class OversizedError(ValueError):
    """A picture of more samples than are unpacked; the file may be sound."""


def check_samples(shape: tuple[int, ...], size: int) -> None:
    """Raise OversizedError for more samples than ``size`` bytes have any business to hold, ValueError for none."""
    claim = " × ".join(map(str, shape))
    words = f"{claim} samples in {size} bytes, at most {LONGEST} on a side and {SAMPLES:,} in all"
    if not prod(shape):
        raise ValueError(words)
    if max(shape) > LONGEST or prod(shape) > max(SAMPLES, PER_BYTE * size):
        raise OversizedError(words)


def first_page(source) -> tuple[np.ndarray, str]:
    """Return the samples of a TIFF's first page and its description.

    ``source``: a path or a stream. Raises ValueError for what is none and for a page whose parts, each of which takes
    bytes, are more than the file has; OSError as `open`, and tifffile's others for a damaged one.
    """
    import tifffile

    tifffile.logger().addHandler(UNHEARD)
    try:
        with tifffile.TiffFile(source) as file:
            page, size = file.pages[0], file.filehandle.size
            check_samples(page.shape, size)
            if prod(page.chunked) > size:
                raise ValueError(f"{prod(page.chunked)} parts in {size} bytes")
            return page.asarray(), page.description
    except tifffile.TiffFileError as error:
        raise ValueError(str(error)) from error
