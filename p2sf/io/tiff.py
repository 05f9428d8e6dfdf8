"""Samples of PSFs as pages of a TIFF; photos are those of `photo_files`."""

from typing import Any, BinaryIO

import numpy as np

from p2sf.version import program_version

ORIENTATION = (274, "H", 1, 4, True)  # TIFF 6.0, section 8: row 0 is the picture's bottom, y = lowest


def write_pages(handle: BinaryIO, values: np.ndarray, per_unit: float, **own: Any) -> None:
    """Write samples, (…, y, x), with as many ``per_unit`` of length; ``own``: more for `tifffile.imwrite`."""
    import tifffile

    software = f"p2sf {program_version()}"
    sides = (per_unit, per_unit)
    tifffile.imwrite(handle, values, resolution=sides, extratags=[ORIENTATION], software=software, **own)
