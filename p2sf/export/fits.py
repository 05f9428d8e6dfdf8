"""PSFs as FITS, with the keywords of poppy (its documentation, "FITS Header Keywords Definitions")."""

import io
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import ExportError
from p2sf.export.psf_cube import Cube, PsfArray
from p2sf.files.writing import write_beside
from p2sf.io.fits_psf import META
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import pupils
from p2sf.version import program_version

METRES_PER_UM = 1e-6
ARCSECONDS = 180 * 3600 / np.pi


def write_fits(cube: Cube, path: str | os.PathLike[str]) -> Path:
    """Write a cube as one image (x, y, wavelength, field, depth in FITS order) and a table per axis; ExportError."""
    return write_image(cube, path, keywords(cube))


def write_image(
    cube: PsfArray,
    path: str | os.PathLike[str],
    header: Iterable[tuple[str, object, str]],
    tables: Mapping[str, Mapping[str, np.ndarray]] | None = None,
) -> Path:
    """Write PSFs as one image with a ``header`` of (keyword, value, comment), a table per axis and more ``tables``."""
    try:
        from astropy.io import fits
    except ImportError as error:
        raise ExportError("FITS files need astropy, which is not installed; pip install 'p2sf[fits]'") from error
    image = fits.PrimaryHDU(cube.values)
    for keyword, value, comment in header:
        image.header[keyword] = (value, comment)
    parts = [_axis_table(fits, *axis) for axis in _axes(cube)]
    for name, columns in (tables or {}).items():
        made = [fits.Column(name=key, format=_form(column), array=column) for key, column in columns.items()]
        parts.append(fits.BinTableHDU.from_columns(made, name=name))
    content = io.BytesIO()  # astropy refuses a handle that was opened to create a file
    fits.HDUList([image, *parts]).writeto(content)
    return write_beside(path, lambda handle: handle.write(content.getbuffer()))


def _form(column: np.ndarray) -> str:
    """Return the FITS format of a column: double, or text as wide as its longest."""
    return "D" if column.dtype.kind == "f" else f"{column.dtype.itemsize // 4}A"


def keywords(cube: Cube) -> list[tuple[str, object, str]]:
    """Return (keyword, value, comment) of the image's header; lengths in metres, as in poppy."""
    lens, colours = cube.stored.lens, cube.wavelengths_nm * 1e-9
    middle, width = float(colours[len(colours) // 2]), _pupil_metres(cube.stored.lens)
    return [
        ("WAVELEN", middle, "[m] middle wavelength"),
        ("NWAVES", len(colours), "number of wavelengths, the third axis"),
        *((f"WAVE{k}", float(x), "[m] wavelength") for k, x in enumerate(colours)),
        ("PIXELSCL", cube.pixel_um * METRES_PER_UM, "[m] sensor pitch per pixel"),
        ("PIXUNIT", "meter", "unit of PIXELSCL"),
        ("OVERSAMP", 1, "samples per pixel"),
        ("DET_SAMP", 1, "samples per detector pixel"),
        ("DIAM", width, "[m] entrance-pupil diameter"),
        ("DIFFLMT", middle / width * ARCSECONDS, "[arcsec] lambda/D in object space"),
        ("INTEGRAT", cube.integrated, "samples are light of whole pixels"),
        ("NORMALIZ", "unit sum in the window", "PSF normalization"),
        ("BUNIT", "fraction", "of the light in the window, per pixel"),
        *axis_keywords(cube),
        ("INSTRUME", lens.name[:60], "lens"),
        ("AIM", cube.stored.meta["aim"], "exact rays fill the stop/paraxial pupil"),
        ("METHOD", cube.stored.database.method, "method of computing the PSF"),
        *((name, value, f"predicted 1 - R2, {text}") for name, value, text in _accuracy(cube) if isfinite(value)),
        ("LENSHASH", cube.stored.meta["lens"]["sha256_of_toml"], ""),  # SHA-256 fills the card
        (META, json.dumps(cube.record), "facts as JSON"),
        ("CREATOR", f"p2sf {program_version()}", "software"),
    ]


def _accuracy(cube: Cube) -> tuple[tuple[str, float, str], ...]:
    known = cube.stored.accuracy
    return ("ERRMED", known.median, "median"), ("ERRWORST", known.worst, "worst")


def axis_keywords(cube: PsfArray) -> Iterator[tuple[str, object, str]]:
    """Yield where the chief ray lies: sample N//2 counted from 0, that is N//2 + 1 from 1."""
    for axis, name in ((1, "X"), (2, "Y")):
        yield f"CTYPE{axis}", f"{name} (field along +Y)" if axis == 2 else name, "sensor axis"
        yield f"CRPIX{axis}", cube.values.shape[-axis] // 2 + 1, "chief ray"
        yield f"CRVAL{axis}", 0.0, "chief ray"
        yield f"CDELT{axis}", cube.pixel_um, "pitch"
        yield f"CUNIT{axis}", "um", ""


def _pupil_metres(lens: Lens) -> float:
    return float(pupils(lens, lens.reference_wavelength_um).entrance_diameter) / UM_PER_MM


def _axes(cube: PsfArray) -> Iterator[tuple[str, str, np.ndarray]]:
    yield "WAVELENGTH", "nm", cube.wavelengths_nm
    yield "FIELD", "deg", cube.fields_deg
    yield "DEPTH", "mm", cube.depths_mm


def _axis_table(fits: Any, name: str, unit: str, values: np.ndarray) -> Any:
    column = fits.Column(name=name, format="D", unit=unit, array=values)
    return fits.BinTableHDU.from_columns([column], name=name)
