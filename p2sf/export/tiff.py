"""PSFs as one TIFF of float pages, an ImageJ hyperstack."""

import json
import os
from itertools import product
from pathlib import Path
from typing import Any, BinaryIO

from p2sf.export.psf_cube import Cube, PsfArray
from p2sf.figures.record import CONVENTIONS
from p2sf.files.writing import write_beside
from p2sf.io.tiff import write_pages


def write_tiff(cube: Cube, path: str | os.PathLike[str]) -> Path:
    """Write a cube as float32 pages, depth as frames, field as slices, wavelength as channels; ExportError."""
    return write_beside(path, lambda handle: write_hyperstack(handle, cube, cube.record))


def write_hyperstack(handle: BinaryIO, cube: PsfArray, about: dict[str, Any]) -> None:
    """Write PSFs as the pages of an ImageJ hyperstack, ``about`` in its Info."""
    info = {"conventions": CONVENTIONS, "pixel_um": cube.pixel_um, **about}
    metadata = {
        "axes": "TZCYX",
        "unit": "um",
        "mode": "grayscale",
        "max": float(cube.values.max()),
        "min": 0.0,
        "Labels": labels(cube),
        "Info": json.dumps(info, ensure_ascii=False),
    }
    write_pages(handle, cube.values, 1 / cube.pixel_um, imagej=True, metadata=metadata)


def labels(cube: PsfArray) -> list[str]:
    """Return what each page shows, in page order."""
    axes = product(cube.depths_mm.tolist(), cube.fields_deg.tolist(), cube.wavelengths_nm.tolist())
    return [f"depth {depth:g} mm, field {field:g} deg, {colour:g} nm" for depth, field, colour in axes]
