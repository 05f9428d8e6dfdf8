"""Raw numbers of a sensor as a DNG file, which raw converters develop (Adobe, DNG Specification 1.7.1, 2023)."""

import io
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.colour.colorimetry import RGB_OF_XYZ
from p2sf.files.writing import write_beside

BYTE, TEXT, SHORT, LONG, RATIONAL, SRATIONAL, DOUBLE = 1, 2, 3, 4, 5, 10, 12  # types of TIFF 6.0
CFA, LINEAR_RAW = 32803, 34892
D65 = 21  # a light source of Exif
PER_UNIT = 10000  # of the colour matrix, which has four decimals


@dataclass(frozen=True)
class RawLevels:
    """What raw numbers mean: those of a dark pixel and of a full one, and the colours of a mosaic, as "rggb".

    ``noise``: (s, o), the variance s·x + o of a reading x from 0 (dark) to 1 (full).
    """

    black: int
    white: int
    mosaic: str | None = None
    noise: tuple[float, float] = (0.0, 0.0)


def write_dng(path: str | os.PathLike[str], numbers: np.ndarray, levels: RawLevels) -> Path:
    """Write raw numbers, (rows, columns) behind a mosaic or (rows, columns, 3), uint16, row 0 at the top; ExportError.

    The colours are the primaries of sRGB with white at D65.
    """
    import tifffile

    buffer = io.BytesIO()
    tifffile.imwrite(
        buffer,
        numbers,
        photometric=CFA if levels.mosaic else LINEAR_RAW,
        planarconfig=None if levels.mosaic else "contig",
        metadata=None,
        software=False,
        extratags=_tags(levels),
    )
    return write_beside(path, lambda handle: handle.write(buffer.getvalue()))


def _tags(levels: RawLevels) -> list[tuple[int, int, int, Any, bool]]:
    """Return tags as tifffile takes them: number, type, count, value, and that they stand on this page only."""
    samples = 1 if levels.mosaic else 3
    matrix = np.rint(RGB_OF_XYZ * PER_UNIT).astype(int).ravel().tolist()
    tags: list[tuple[int, int, int, Any]] = [
        (50706, BYTE, 4, (1, 4, 0, 0)),  # DNGVersion
        (50707, BYTE, 4, (1, 3, 0, 0)),  # DNGBackwardVersion
        (50708, TEXT, 0, "P2SF"),  # UniqueCameraModel
        (274, SHORT, 1, 1),  # Orientation: upright
        (50714, LONG, samples, (levels.black,) * samples),  # BlackLevel
        (50717, LONG, samples, (levels.white,) * samples),  # WhiteLevel
        (51041, DOUBLE, 2, levels.noise),  # NoiseProfile, one for all colours
        (50721, SRATIONAL, 9, tuple(number for each in matrix for number in (each, PER_UNIT))),  # ColorMatrix1
        (50778, SHORT, 1, D65),  # CalibrationIlluminant1
        (50728, RATIONAL, 3, (1, 1) * 3),  # AsShotNeutral
    ]
    if levels.mosaic:
        tags += [
            (33421, SHORT, 2, (2, 2)),  # CFARepeatPatternDim
            (33422, BYTE, 4, tuple("rgb".index(colour) for colour in levels.mosaic)),  # CFAPattern
            (50710, BYTE, 3, (0, 1, 2)),  # CFAPlaneColor
            (50711, SHORT, 1, 1),  # CFALayout: rectangular
        ]
    return [(*tag, True) for tag in tags]
