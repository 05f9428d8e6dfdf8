"""`p2sf psf`: one point spread function, computed and written to a file."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from p2sf.cli.cautions import TOO_COARSE, caution
from p2sf.cli.lookups import is_database, looked_up
from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName, Output, Whole, check_output
from p2sf.cli.screen import heading, print_json, print_table
from p2sf.colour.spectrum import WORDS
from p2sf.errors import RequestError, SamplingError
from p2sf.io.psf_files import ENDINGS, write_psf
from p2sf.io.record import describe, facts
from p2sf.lensfile.library import find_lens
from p2sf.psf.metrics import centroid, radius_of_energy
from p2sf.psf.result import Psf
from p2sf.request import Setup, set_up

MOST_PIXELS = 2048  # 32 MiB a picture; a kernel of this width still fits any machine


@dataclass(frozen=True)
class Picture:
    """How a PSF is computed and sampled.

    Attributes
    ----------
    method
        Rung of the methods; auto takes the cheapest one that holds the tolerance.
    tolerance
        Least R² against the exact reference that auto accepts.
    sampling
        How the six coefficients become a PSF: matrix DFT of any size, or zero-padded FFT of even sizes.
    pixels
        Samples along each side.
    pixel_um
        Distance between samples, µm; one that holds the PSF when not given.
    """

    method: Literal["auto", "seidel", "fitted", "traced", "huygens", "gaussian"] | None = None
    tolerance: float = 0.99
    sampling: Literal["fft", "mdft"] | None = None
    pixels: Whole = 64
    pixel_um: float | None = None

    def __post_init__(self):
        if not 2 <= self.pixels <= MOST_PIXELS:
            raise RequestError(f"--pixels is {self.pixels}; give a whole number from 2 to {MOST_PIXELS}")
        if self.pixel_um is not None and not 0 < self.pixel_um < 1e6:
            raise RequestError(f"--pixel-um is {self.pixel_um:g} µm; give a positive number below a metre")
        if not 0 < self.tolerance < 1:
            raise RequestError(f"--tolerance is {self.tolerance:g}; give an R² between 0 and 1, such as 0.99")
        if self.sampling and self.method not in (None, "seidel"):
            raise RequestError(
                f"--sampling is {self.sampling}, which samples Seidel coefficients and not --method {self.method}; "
                "leave one of the two away"
            )
        if self.sampling == "fft" and self.pixels % 2:
            raise SamplingError(
                f"--pixels is {self.pixels}, and --sampling fft needs an even size; "
                f"give {self.pixels + 1} or choose --sampling mdft"
            )

    @property
    def seidel(self) -> bool:
        """Return whether the six coefficients are asked for."""
        return self.method == "seidel" or self.sampling is not None


USUAL = Picture()
SpectrumName = Annotated[str | None, Parameter(help=f"Colour PSF of a point with this spectrum: {WORDS}.")]


def psf(
    lens: LensName,
    /,
    *,
    request: Asked = AS_IN_THE_FILE,
    picture: Annotated[Picture, Parameter(name="*")] = USUAL,
    spectrum: SpectrumName = None,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Compute the PSF of one source and write it as .npz, .tiff, .csv or .png; with a spectrum as .npz or .png."""
    if spectrum is not None:
        return _in_colour(lens, request, picture, spectrum, output, as_json)
    check_output(output, ENDINGS)
    if is_database(lens):
        if picture.sampling or picture.method not in (None, "auto"):
            raise RequestError(f"--method and --sampling need the lens, and {lens} is a database; leave them away")
        result, about, title = looked_up(lens, request, picture.pixels, picture.pixel_um)
    else:
        setup = set_up(find_lens(lens), request)
        if not as_json:
            caution(setup, picture.seidel and picture.sampling != "fft")
        result, about, title = render(setup, picture), describe(setup) if output else {}, heading(setup)
    if output:
        write_psf(result, output, about)
    if as_json:
        file = None if output is None else str(output)
        return print_json({"file": file, "pixels": picture.pixels, **facts(result), **figures(result)})
    return print_table(title, ("point spread function", "value", "unit"), summary(result, output))


def _in_colour(lens: str, request, picture: Picture, spectrum: str, output: Path | None, as_json: bool) -> None:
    from p2sf.cli.colours import colour

    if is_database(lens):
        raise RequestError(f"--spectrum needs the lens, and {lens} is a database; leave it away or name the lens")
    return colour(set_up(find_lens(lens), request), spectrum, picture, output, as_json)


def render(setup: Setup, picture: Picture) -> Psf:
    """Return the asked PSF: by the ladder, or straight from the six coefficients when they are asked for."""
    method = picture.method or "auto"
    if picture.seidel:
        return _from_coefficients(setup, picture)
    from p2sf.psf import methods

    grid = {"pixels": picture.pixels, "pixel_um": picture.pixel_um}
    return methods.render(setup.lens, setup.source, method=method, tolerance=picture.tolerance, **grid)


def _from_coefficients(setup: Setup, picture: Picture) -> Psf:
    from p2sf.paraxial.seidel import coefficients
    from p2sf.psf.seidel import seidel_psf

    source = setup.source
    six = coefficients(setup.lens, source.depth_mm, source.field_slope, source.wavelength_um, setup.stop)
    return seidel_psf(six, picture.pixels, picture.pixel_um, sampling=picture.sampling or "mdft")


def figures(result: Psf) -> dict:
    """Return the centroid, from the chief ray, and the radii around it that hold 50 and 80 % of the window's light."""
    x, y = centroid(result)
    half, most = (float(radius_of_energy(result, share)) for share in (0.5, 0.8))
    return {"centroid_um": [float(x), float(y)], "radius_50_um": half, "radius_80_um": most}


def summary(result: Psf, output: Path | None) -> list[tuple]:
    """Return the rows that tell a person what was computed."""
    known, measured = facts(result), figures(result)
    rows = [
        ("method", result.method, ""),
        ("samples", f"{result.values.shape[-1]} × {result.values.shape[-2]}", ""),
        ("pixel", result.pixel_um, "µm"),
        ("Strehl ratio", known["strehl"], "not defined for a fitted shape" if known["strehl"] is None else ""),
        ("light in the picture", known["energy"], TOO_COARSE if known["energy"] is None else ""),
        ("centroid, from the chief ray, along y", measured["centroid_um"][1], "µm"),
        ("radius of 50 % of the light in the picture", measured["radius_50_um"], "µm"),
        ("radius of 80 % of the light in the picture", measured["radius_80_um"], "µm"),
        ("sampling", result.sampling, ""),
        ("numbers that describe it", result.numbers, ""),
        ("traced rays", result.rays, ""),
        ("time", 1e3 * result.seconds, "ms"),
    ]
    return rows if output is None else [*rows, ("written to", str(output), "")]
