"""`p2sf psf` of several depths, fields and wavelengths: a set of PSFs in one file."""

from collections.abc import Callable
from math import isnan
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.cli.cautions import caution, open_lens
from p2sf.cli.lookups import is_database
from p2sf.cli.options import check_output
from p2sf.cli.picture_options import USUAL, Picture, SetOptions
from p2sf.cli.screen import Row, percent_line, print_json, print_table, warn
from p2sf.conventions import NM_PER_UM
from p2sf.errors import RequestError
from p2sf.export.psf_set import PIXEL_UM, PIXELS, PixelGrid, PsfSet, SetAxes, axes_of, left_out, psf_set
from p2sf.export.psf_set_files import WRITERS, table, write_psf_set
from p2sf.image.progress import Progress
from p2sf.io.record import describe_many
from p2sf.messages import ParameterName
from p2sf.parameters import check_angle, check_positive
from p2sf.setting import Request, Setup, set_up
from p2sf.spans import depths, numbers

INSTEAD = {  # of an axis of a set: what states it for one PSF
    "depths_mm": ("depth_mm",),
    "fields_deg": ("field_deg", "object_height_mm", "image_height_mm"),
    "wavelengths_nm": ("wavelength_nm",),
}
UNFIT = "method", "min_r2", "sampling"  # of a picture: a set is of fits, or of rays
SHOWN = "depth_mm", "field_deg", "wavelength_nm", "chief_mm", "captured", "peak", "rms_radius_um", "method"
MOST_ROWS = 60


def write_set(
    lens: str,
    request: Request,
    picture: Picture,
    spectrum: str | None,
    several: SetOptions,
    output: Path | None,
    as_json: bool,
) -> None:
    """Make the PSFs of a set, write them where a file is given, and show their figures."""
    check_output(output, WRITERS, lens)
    _check(lens, request, picture, spectrum, several)
    setup = set_up(open_lens(lens), request)
    if not as_json:
        caution(setup, seidel=False)
    grid = PixelGrid(picture.pixel_um or PIXEL_UM, several.fill_factor or 1.0, picture.pixels or PIXELS)
    with percent_line() as tell:
        found = psf_set(setup.lens, _axes(setup, several), grid, picture.clip, Progress(tell))
    if output:
        write_psf_set(found, output, describe_many(setup))
    warn(left_out(found))
    if as_json:
        return print_json(_record(found, output))
    return _show(setup, found, output)


def _check(lens: str, request: Request, picture: Picture, spectrum: str | None, several: SetOptions) -> None:
    """Raise RequestError for what a set does not know, and for an axis that is stated twice."""
    if is_database(lens):
        raise RequestError(
            "a set of PSFs needs the lens, and {path} is a database; name the lens, or render one PSF", path=lens
        )
    for axis, singles in INSTEAD.items():
        for single in singles:
            if getattr(several, axis) and getattr(request, single) != getattr(Request(), single):
                raise RequestError(
                    "{parameter} and {axis} are both given; keep one of them",
                    parameter=single,
                    axis=ParameterName(axis),
                )
    unfit = [name for name in UNFIT if getattr(picture, name) != getattr(USUAL, name)]
    unfit += ["spectrum"] * (spectrum is not None) + ["field_x_deg"] * bool(request.field_x_deg)
    for name in unfit:
        raise RequestError(
            "{parameter} is for one PSF; leave it out, or leave out what asks for a set: {axes}",
            parameter=name,
            axes=tuple(ParameterName(axis) for axis in INSTEAD if getattr(several, axis)),
        )


def _axes(setup: Setup, several: SetOptions) -> SetAxes:
    """Return the axes asked for; what has none is that of the one source."""
    source = setup.source
    fields = _parse_values(several.fields_deg, "fields_deg", numbers, setup.field_deg)
    colours = _parse_values(several.wavelengths_nm, "wavelengths_nm", numbers, source.wavelength_um * NM_PER_UM)
    for angle in fields:
        check_angle("fields_deg", float(angle))
    for colour in colours:
        check_positive("wavelengths_nm", float(colour))
    distances = _parse_values(several.depths_mm, "depths_mm", depths, source.depth_mm)
    return axes_of(distances, fields, colours)


def _parse_values(text: str | None, name: str, read: Callable[[str, str], np.ndarray], single: float) -> np.ndarray:
    return np.array([single]) if text is None else read(text, name)


def _figures(found: PsfSet) -> list[dict[str, object]]:
    names, *rows = table(found)
    return [dict(zip(map(str, names), row, strict=True)) for row in rows]


def _record(found: PsfSet, output: Path | None) -> dict[str, Any]:
    about = {"file": None if output is None else str(output), "shape": list(found.values.shape)}
    figures = [{name: None if value != value else value for name, value in row.items()} for row in _figures(found)]
    return {**about, "pixel_um": found.pixel_um, "fill_factor": found.grid.fill_factor, "psfs": figures}


def _show(setup: Setup, found: PsfSet, output: Path | None) -> None:
    """Print the figures of the first PSFs, and where all are."""
    figures = _figures(found)
    rows: list[Row] = [tuple(row[name] for name in SHOWN) for row in figures[:MOST_ROWS]]
    lens, size = setup.prescription, found.values.shape[-1]
    count = "1 PSF" if len(figures) == 1 else f"{len(figures)} PSFs"
    title = f"{lens.title or lens.name}: {count} of {size}² pixels of {found.pixel_um:g} µm"
    columns = (
        "depth, mm",
        "field, °",
        "nm",
        "chief ray, mm",
        "captured",
        "peak",
        "RMS radius in the window, µm",
        "method",
    )
    print_table(title, columns, rows)
    if len(figures) > MOST_ROWS:
        print(f"and {len(figures) - MOST_ROWS} more")
    worst = [error for error in found.error.ravel().tolist() if not isnan(error)]
    if worst:
        print(f"largest predicted 1 - R² of the fits: {max(worst):.2g}")
    if output:
        print(f"{output}: {output.stat().st_size / 1e3:.0f} kB")
