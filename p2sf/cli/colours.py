"""`p2sf psf --spectrum`: the colour PSF of a point that is not of one wavelength."""

from pathlib import Path
from typing import Any

from p2sf.cli.cautions import TOO_COARSE
from p2sf.cli.options import check_output
from p2sf.cli.picture_options import Picture
from p2sf.cli.screen import Row, heading, print_json, print_table, warn
from p2sf.colour.colorimetry import chromaticity
from p2sf.colour.spectrum import spectrum_of
from p2sf.errors import RequestError
from p2sf.figures.colour_psf import ColourPsf, record
from p2sf.io.colour_files import COLOUR_ENDINGS, write_colour_psf
from p2sf.io.record import describe
from p2sf.messages import ParameterName
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.psf.polychromatic import colour_psf, suitable_pitch_um
from p2sf.psf.result import IN_WINDOW
from p2sf.setting import Setup


def colour(setup: Setup, spectrum: str, picture: Picture, output: Path | None, as_json: bool) -> None:
    """Compute, write and report the colour PSF of a setup; ``picture`` is how each wavelength's PSF is made."""
    wanted = spectrum_of(spectrum)
    check_output(output, COLOUR_ENDINGS)
    if picture.sampling:
        raise RequestError(
            "{parameter} is {value}, and {spectrum} takes its samples by {method} alone",
            parameter="sampling",
            value=picture.sampling,
            spectrum=ParameterName("spectrum"),
            method=ParameterName("method"),
        )
    pitch = suitable_pitch_um(setup.lens, setup.source, wanted, picture.side, setup.stop)
    window = picture.side, picture.pixel_um or pitch
    found = colour_psf(
        setup.lens,
        setup.source,
        wanted,
        window,
        lambda lens, source, pixels, pixel_um: render_integrated(
            lens, source, picture.described_by, pixels, pixel_um, picture.options
        ),
    )
    if output:
        write_colour_psf(found, output, describe(setup))
    if as_json:
        about = {"file": None if output is None else str(output), "pixels": picture.side, "aim": setup.lens.aim}
        return print_json({**about, **figures(found)})
    warn(setup.stop.warning)
    return print_table(heading(setup), ("colour point spread function", "value", "unit"), rows(found, output))


def figures(found: ColourPsf) -> dict[str, Any]:
    """Return what the colour PSF knows, and its colour as a whole, in CIE x and y."""
    x, y = chromaticity(found.xyz.sum((0, 1)))
    return {**record(found), "chromaticity_xy": [float(x), float(y)]}


def rows(found: ColourPsf, output: Path | None) -> list[Row]:
    """Return the rows that tell a person what was computed."""
    known = figures(found)
    x, y = known["chromaticity_xy"]
    shift = float(found.shift_um.max() - found.shift_um.min())
    table: list[Row] = [
        ("spectrum", found.spectrum, ""),
        ("wavelengths rendered", len(found.wavelengths_um), ""),
        ("methods", ", ".join(found.methods), ""),
        ("samples", f"{found.xyz.shape[1]} × {found.xyz.shape[0]}", ""),
        ("pixel", found.pixel_um, "µm"),
        (IN_WINDOW, known["light_in_window"], "" if known["light_in_window"] else TOO_COARSE),
        ("lateral colour between the outermost chief rays", shift, "µm"),
        ("chromaticity x, y (CIE 1931)", f"{x:.4f}, {y:.4f}", ""),
        ("time", 1e3 * found.seconds, "ms"),
    ]
    return table if output is None else [*table, ("written to", str(output), "")]
