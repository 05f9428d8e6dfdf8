"""`p2sf export`: a database or a stack in another program's format."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from p2sf.cli.options import Json, check_output
from p2sf.cli.screen import percent_line, print_json, warn
from p2sf.database.files.place import is_url
from p2sf.database.render import Sampling
from p2sf.files.writing import plain
from p2sf.io.fits import FITS
from p2sf.parameters import check_samples

if TYPE_CHECKING:
    from p2sf.export.psf_cube import Cube

# The first ending of a format is the one a file gets when no --output is given.
ENDINGS = {"iset": (".mat",), "fits": FITS, "tiff": (".tif", ".tiff"), "csv": (".csv",)}


@dataclass(frozen=True)
class RenderedOptions:
    """How a .npz is rendered; a stack is exported as it is.

    Attributes
    ----------
    pixels
        Samples along each side; 64, and 128 for ISETCam, when not given.
    pixel_um
        Distance between samples, µm; what the finest PSF needs when not given.
    depth_mm
        For ISETCam, which holds one object distance: which, mm; the farthest when not given.
    """

    pixels: int | None = None
    pixel_um: float | None = None
    depth_mm: float | None = None

    def __post_init__(self) -> None:
        check_samples(self.pixels, self.pixel_um, least=2)


def export(
    file: str,
    /,
    *,
    to: Literal["iset", "fits", "tiff", "csv"],
    output: Annotated[Path | None, Parameter(["--output", "-o"], negative="", help="File to write.")] = None,
    picture: Annotated[RenderedOptions, Parameter(name="*")] = RenderedOptions(),
    as_json: Json = False,
) -> None:
    """Write a database (.npz) or stack (.zarr) as ISETCam optics, FITS, an ImageJ TIFF, or a table."""
    check_output(output, ENDINGS[to], file)
    beside = Path(file.rpartition("/")[2] if is_url(file) else file)
    target = output or beside.with_suffix(ENDINGS[to][0])
    _WRITERS[to](file, target, picture)
    from p2sf.export.psf_cube import open_database

    known = open_database(file).accuracy
    if as_json:
        about = {"file": str(target), "to": to, "bytes": target.stat().st_size}
        print_json({**about, "predicted_error": plain(known.record)})
    else:
        warn(known.caution)
        print(f"{target}: {target.stat().st_size / 1e3:.0f} kB")


def _iset(file: str, target: Path, picture: RenderedOptions) -> None:
    from p2sf.export.iset import IsetOptions, write_iset
    from p2sf.export.psf_cube import open_database

    options = IsetOptions(picture.depth_mm, picture.pixels or IsetOptions().pixels, picture.pixel_um)
    write_iset(open_database(file), target, options)


def _fits(file: str, target: Path, picture: RenderedOptions) -> None:
    from p2sf.export.fits import write_fits

    write_fits(_cube(file, picture), target)


def _tiff(file: str, target: Path, picture: RenderedOptions) -> None:
    from p2sf.export.tiff import write_tiff

    write_tiff(_cube(file, picture), target)


def _csv(file: str, target: Path, picture: RenderedOptions) -> None:
    from p2sf.export.coefficient_table import write_csv
    from p2sf.export.psf_cube import open_database

    write_csv(open_database(file), target)


def _cube(file: str, picture: RenderedOptions) -> "Cube":
    """Return all PSFs of a file, and show how far their rendering is."""
    from p2sf.export.psf_cube import open_cube

    with percent_line() as tell:
        return open_cube(file, Sampling(picture.pixels or Sampling().pixels, picture.pixel_um), tell)


_WRITERS = {"iset": _iset, "fits": _fits, "tiff": _tiff, "csv": _csv}
