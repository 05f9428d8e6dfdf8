"""PSFs as FITS, with the keywords of poppy (its documentation, "FITS Header Keywords Definitions")."""

import os
from math import isfinite
from pathlib import Path

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.export.psf_cube import Cube, PsfArray
from p2sf.files.writing import write_beside
from p2sf.io.fits import Card, Column, axis_cards, write_image
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import pupils

METRES_PER_UM = 1e-6
ARCSECONDS = 180 * 3600 / np.pi


def write_fits(cube: Cube, path: str | os.PathLike[str]) -> Path:
    """Write a cube as one image (x, y, wavelength, field, depth in FITS order) and a table per axis; ExportError."""
    header, tables = keywords(cube), axis_tables(cube)
    return write_beside(path, lambda handle: write_image(handle, cube.values, header, cube.record, tables))


def axis_tables(cube: PsfArray) -> dict[str, list[Column]]:
    """Return a table of one column for each of the axes of a cube."""
    axes = ("WAVELENGTH", cube.wavelengths_nm, "nm"), ("FIELD", cube.fields_deg, "deg"), ("DEPTH", cube.depths_mm, "mm")
    return {axis[0]: [axis] for axis in axes}


def keywords(cube: Cube) -> list[Card]:
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
        *axis_cards(cube.values.shape, cube.pixel_um),
        ("INSTRUME", lens.name[:60], "lens"),
        ("AIM", cube.stored.meta["aim"], "exact rays fill the stop/paraxial pupil"),
        ("METHOD", cube.stored.database.method, "method of computing the PSF"),
        *((name, value, f"predicted 1 - R2, {text}") for name, value, text in _accuracy(cube) if isfinite(value)),
        ("LENSHASH", cube.stored.meta["lens"]["sha256_of_toml"], ""),  # SHA-256 fills the card
    ]


def _accuracy(cube: Cube) -> tuple[tuple[str, float, str], ...]:
    known = cube.stored.accuracy
    return ("ERRMED", known.median, "median"), ("ERRWORST", known.worst, "worst")


def _pupil_metres(lens: Lens) -> float:
    return float(pupils(lens, lens.reference_wavelength_um).entrance_diameter) / UM_PER_MM
