"""One PSF to and from FITS: the samples as the image, all facts about them in its header."""

import io
import json
import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.errors import ExportError
from p2sf.files.writing import plain, write_beside
from p2sf.io.record import facts, psf_from
from p2sf.psf.result import Psf
from p2sf.version import program_version

META = "P2SFMETA"


def write_psf_fits(psf: Psf, path: str | os.PathLike[str], meta: dict) -> Path:
    """Write one PSF, shape (y, x), as a FITS image of doubles; return the path. Raises ExportError.

    ``meta`` (see `p2sf.io.record.describe`) goes into the header as JSON, over CONTINUE cards (FITS 4.0, 4.2.1.2).
    """
    fits = _astropy()
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
    image.header[META] = json.dumps({**plain(meta), "psf": facts(psf)})
    content = io.BytesIO()  # astropy refuses a handle that was opened to create a file
    fits.HDUList([image]).writeto(content)
    return write_beside(path, lambda handle: handle.write(content.getbuffer()))


def read_psf_fits(path: str | os.PathLike[str]) -> tuple[Psf, dict]:
    """Return the PSF of a FITS file that `write_psf_fits` wrote, exactly, and its meta. Raises ExportError."""
    fits = _astropy()
    try:
        with warnings.catch_warnings(action="ignore"), fits.open(path, memmap=False) as file:
            values, meta = file[0].data, json.loads(file[0].header[META])
        return psf_from(values.astype(float), meta["psf"]), meta
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise ExportError(
            "{path} is not a PSF that this program wrote as FITS; save the snapshot again", path=str(path)
        ) from error


def _astropy() -> Any:
    try:
        from astropy.io import fits
    except ImportError as error:
        raise ExportError("FITS files need astropy, which is not installed; pip install 'p2sf[fits]'") from error
    return fits
