"""Coefficients of a database as a CSV table."""

import csv
import io
import json
import os
from pathlib import Path

import numpy as np

from p2sf.conventions import NM_PER_UM, degrees_from_slope
from p2sf.database.files.provenance import Stored
from p2sf.export.psf_cube import check_line
from p2sf.files.writing import plain, write_beside

COLUMNS = (
    "depth_mm",
    "field_deg",
    "wavelength_nm",
    "w40",
    "w31",
    "w22",
    "w20",
    "w11",
    "wd",
    "na",
    "image_distance_mm",
    "image_height_mm",
)


def write_csv(stored: Stored, path: str | os.PathLike[str]) -> Path:
    """Write the coefficients at every node, one row each, in waves where a column names no unit; ExportError."""
    check_line(stored)
    known = stored.record | {"predicted_error": plain(stored.accuracy.record)}
    text = io.StringIO()
    text.write("# six coefficients in waves; an infinite depth or image distance is inf\n")
    text.write(f"# meta: {json.dumps(known, ensure_ascii=False)}\n")
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(COLUMNS)
    rows.writerows(coefficient_rows(stored).tolist())
    return write_beside(path, lambda handle: handle.write(text.getvalue().encode()))


def coefficient_rows(stored: Stored) -> np.ndarray:
    """Return ``COLUMNS`` at every node, shape (nodes, 12); depth varies slowest."""
    database = stored.database
    depth, slope, wavelength = database.space.axes
    found = database.coefficients(depth, slope, wavelength)
    six = (found.w40, found.w31, found.w22, found.w20, found.w11, found.wd)
    scale = (found.na, found.image_distance, found.image_height)
    point = (depth, degrees_from_slope(slope), wavelength * NM_PER_UM)
    rows: np.ndarray = np.stack([x.ravel() for x in np.broadcast_arrays(*point, *six, *scale)], axis=-1)
    return rows + 0.0  # −0 becomes 0
