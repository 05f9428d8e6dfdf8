"""One PSF to FITS, and pictures and facts from it: the samples as the image, all facts about them in its header."""

import io
import json
import os
import warnings
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.errors import ExportError
from p2sf.figures.psf_data import PsfData
from p2sf.files.reading import LONGEST_TEXT, check_samples, open_file, parse_json, size_of
from p2sf.files.writing import write_beside
from p2sf.io.record import with_facts
from p2sf.version import program_version

META = "P2SFMETA"
SIMPLE, END = b"SIMPLE", b"END     "  # begin and end the head of every FITS file
MOST_UNITS = 64  # looked through for a picture


def write_psf_fits(psf: PsfData, path: str | os.PathLike[str], meta: dict) -> Path:
    """Write one PSF, shape (y, x), as a FITS image of doubles; return the path. Raises ExportError.

    `Psf.record` and ``meta`` go into the header as JSON, over CONTINUE cards (FITS 4.0, 4.2.1.2).
    """
    fits = astropy_fits()
    image = fits.PrimaryHDU(np.asarray(psf.values, dtype=float))
    for axis, name in ((1, "X"), (2, "Y")):
        image.header[f"CTYPE{axis}"] = f"{name} (field along +Y)" if axis == 2 else name
        image.header[f"CRPIX{axis}"] = (psf.values.shape[-axis] // 2 + 1, "chief ray")
        image.header[f"CRVAL{axis}"] = (0.0, "chief ray")
        image.header[f"CDELT{axis}"] = (psf.pixel_um, "pitch")
        image.header[f"CUNIT{axis}"] = "um"
    image.header["BUNIT"] = ("fraction", "of the light in the window, per pixel")
    image.header["METHOD"] = (psf.method, "method of computing the PSF")
    image.header["CREATOR"] = f"p2sf {program_version()}"
    image.header[META] = json.dumps(with_facts(psf, meta))
    content = io.BytesIO()  # astropy refuses a handle that was opened to create a file
    fits.HDUList([image]).writeto(content)
    return write_beside(path, lambda handle: handle.write(content.getbuffer()))


def first_picture(path: str | os.PathLike[str]) -> tuple[np.ndarray, Any]:
    """Return the samples and the header of a FITS file's first picture, rows up.

    Raises ExportError without astropy; OSError, ValueError, KeyError and TypeError for what cannot be read.
    """
    fits = astropy_fits()
    with warnings.catch_warnings(action="ignore"), open_file(path) as stream:
        size = size_of(stream)
        head = stream.read(LONGEST_TEXT)
        if not head.startswith(SIMPLE) or END not in head:  # astropy would unpack it, or look for its end for ever
            raise ValueError("no FITS file")
        stream.seek(0)
        with fits.open(stream, memmap=False) as file:
            for unit in islice(file, MOST_UNITS):
                if unit.is_image and len(unit.shape) >= 2:
                    check_samples(unit.shape, size, abs(unit.header["BITPIX"]) // 8)
                    return unit.data, unit.header
    raise ValueError("no picture in it")


def read_meta(path: str | os.PathLike[str]) -> Any:
    """Return the facts in the header of a FITS file that this program wrote, as JSON has them.

    Raises as `first_picture`, and KeyError for another file.
    """
    return parse_json(first_picture(path)[1][META])


def astropy_fits() -> Any:
    """Return `astropy.io.fits`; ExportError where it is not installed."""
    try:
        from astropy.io import fits
    except ImportError as error:
        raise ExportError("FITS files need astropy, which is not installed; pip install 'p2sf[fits]'") from error
    return fits
