"""One colour PSF to a .npz or to a .png picture."""

import json
import os
from pathlib import Path
from typing import BinaryIO

from p2sf.figures.colour_psf import ColourPsf, record
from p2sf.files.writing import by_ending, plain, write_arrays, write_beside
from p2sf.version import program_version


def write_colour_psf(found: ColourPsf, path: str | os.PathLike[str], meta: dict) -> Path:
    """Write a colour PSF as .npz (CIE X, Y, Z, linear) or .png (sRGB) by the ending of ``path``; return the path.

    ``meta`` (see `p2sf.io.record.describe`) is stored with it. Raises ExportError for another ending or a
    file that cannot be written.
    """
    write = by_ending(path, COLOUR_WRITERS)
    full = {**plain(meta), "colour_psf": plain(record(found))}
    return write_beside(path, lambda handle: write(handle, found, full))


def _write_npz(handle: BinaryIO, found: ColourPsf, meta: dict) -> None:
    write_arrays(handle, {"xyz": found.xyz, "x_um": found.x_um, "y_um": found.y_um}, meta)


def _write_png(handle: BinaryIO, found: ColourPsf, meta: dict) -> None:
    from p2sf.io.psf_plot import draw_colour_psf

    title = f"{meta.get('lens', {}).get('title', 'point spread function')}\n{found.spectrum}, square root of the light"
    draw_colour_psf(handle, found, title, {"Description": json.dumps(meta), "Software": f"p2sf {program_version()}"})


COLOUR_WRITERS = {".npz": _write_npz, ".png": _write_png}
COLOUR_ENDINGS = tuple(COLOUR_WRITERS)
