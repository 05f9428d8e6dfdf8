"""`p2sf psf --spectrum`: the colour PSF of a point that is not of one wavelength."""

from pathlib import Path

import numpy as np

from p2sf.cli.options import check_output
from p2sf.cli.screen import heading, print_json, print_table, warn
from p2sf.colour import bands, chromaticity
from p2sf.errors import RequestError
from p2sf.export import describe
from p2sf.export.colour_files import COLOUR_ENDINGS, write_colour_psf
from p2sf.polychromatic import ColourPsf, chief_shifts_um, colour_psf, record
from p2sf.psf import suitable_pixel_um
from p2sf.request import Setup
from p2sf.seidel import coefficients
from p2sf.spectrum import Spectrum, spectrum_of

WAVELENGTHS_LOOKED_AT = 9


def colour(setup: Setup, spectrum: str, picture, output: Path | None, as_json: bool) -> None:
    """Compute, write and report the colour PSF of a setup; ``picture`` is how each wavelength's PSF is made."""
    wanted = spectrum_of(spectrum)
    check_output(output, COLOUR_ENDINGS)
    if picture.sampling:
        raise RequestError(f"--sampling is {picture.sampling}, and --spectrum takes its samples by --method alone")
    window = picture.pixels, picture.pixel_um or suitable_pitch_um(setup, wanted, picture.pixels)
    found = colour_psf(setup.lens, setup.source, wanted, window, picture.method or "auto")
    if output:
        write_colour_psf(found, output, describe(setup))
    if as_json:
        return print_json({"file": None if output is None else str(output), "pixels": picture.pixels, **figures(found)})
    warn(setup.stop.warning)
    return print_table(heading(setup), ("colour point spread function", "value", "unit"), rows(found, output))


def suitable_pitch_um(setup: Setup, spectrum: Spectrum, pixels: int) -> float:
    """Return the pitch at which the window shows the PSF of every colour, lateral colour included, µm."""
    source = setup.source
    waves, _ = bands(spectrum, WAVELENGTHS_LOOKED_AT)
    c = coefficients(setup.lens, source.depth_mm, source.field_slope, waves, setup.stop)
    shift = np.abs(chief_shifts_um(setup.lens, source, waves))
    return float(np.max(suitable_pixel_um(c, pixels) + 2 * shift / pixels))


def figures(found: ColourPsf) -> dict:
    """Return what the colour PSF knows, and its colour as a whole, in CIE x and y."""
    x, y = chromaticity(found.xyz.sum((0, 1)))
    return {**record(found), "chromaticity_xy": [float(x), float(y)]}


def rows(found: ColourPsf, output: Path | None) -> list[tuple]:
    """Return the rows that tell a person what was computed."""
    known = figures(found)
    x, y = known["chromaticity_xy"]
    shift = float(np.ptp(found.shift_um))
    table = [
        ("spectrum", found.spectrum, ""),
        ("wavelengths rendered", len(found.wavelengths_um), ""),
        ("methods", ", ".join(found.methods), ""),
        ("samples", f"{found.xyz.shape[1]} × {found.xyz.shape[0]}", ""),
        ("pixel", found.pixel_um, "µm"),
        ("light inside the window", known["light_in_window"], ""),
        ("lateral colour between the outermost chief rays", shift, "µm"),
        ("chromaticity x, y (CIE 1931)", f"{x:.4f}, {y:.4f}", ""),
        ("time", 1e3 * found.seconds, "ms"),
    ]
    return table if output is None else [*table, ("written to", str(output), "")]
