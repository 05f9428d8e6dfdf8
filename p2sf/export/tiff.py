"""PSFs as one TIFF of float pages, an ImageJ hyperstack."""

import json
import os
from itertools import product
from pathlib import Path

from p2sf.export.psf_cube import Cube, PsfArray
from p2sf.figures.record import CONVENTIONS
from p2sf.files.writing import write_beside
from p2sf.version import program_version

# Row 0 is the lowest y; a reader that honours the TIFF tag turns the picture up.
ORIENTATION = (274, "H", 1, 4, True)


def write_tiff(cube: Cube, path: str | os.PathLike[str]) -> Path:
    """Write a cube as float32 pages, depth as frames, field as slices, wavelength as channels; ExportError."""
    return write_pages(cube, path, cube.record)


def write_pages(cube: PsfArray, path: str | os.PathLike[str], about: dict[str, object]) -> Path:
    """Write PSFs as the pages of an ImageJ hyperstack, ``about`` in its Info; ExportError."""
    import tifffile

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
    per_um = 1 / cube.pixel_um
    return write_beside(
        path,
        lambda handle: tifffile.imwrite(
            handle,
            cube.values,
            imagej=True,
            resolution=(per_um, per_um),
            metadata=metadata,
            extratags=[ORIENTATION],
            software=f"p2sf {program_version()}",
        ),
    )


def labels(cube: PsfArray) -> list[str]:
    """Return what each page shows, in page order."""
    axes = product(cube.depths_mm.tolist(), cube.fields_deg.tolist(), cube.wavelengths_nm.tolist())
    return [f"depth {depth:g} mm, field {field:g} deg, {colour:g} nm" for depth, field, colour in axes]
