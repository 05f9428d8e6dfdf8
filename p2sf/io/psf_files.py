"""One PSF to .npz, .tiff, .csv, .fits, .nc and a .png picture, and its samples and facts from all but the last."""

import json
import os
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from p2sf.errors import ExportError
from p2sf.figures.psf_data import PsfData
from p2sf.figures.record import CONVENTIONS
from p2sf.files.reading import LONGEST_TEXT, check_unpacked, first_page, open_file, parse_json, read_arrays, size_of
from p2sf.files.writing import by_ending, write_arrays, write_beside
from p2sf.io.fits import FITS, axis_cards, picture_and_meta, write_image
from p2sf.io.netcdf import read_netcdf, write_netcdf
from p2sf.io.record import caption, csv_head, with_facts
from p2sf.io.tiff import write_pages
from p2sf.named_arrays import along
from p2sf.version import program_version

UM_PER_CM = 1e4
CSV_HEAD = 4  # lines before the numbers of a .csv


def write_psf(psf: PsfData, path: str | os.PathLike[str], meta: dict | None = None) -> Path:
    """Write one PSF, shape (y, x), as .npz, .tiff, .csv, .fits, .nc or .png by the ending of ``path``; return the path.

    `Psf.record` is stored with it, and ``meta``, any facts as JSON has them. Raises ExportError for an unknown ending,
    a stack of PSFs, or a file that cannot be written; an old file then stays untouched.
    """
    write = by_ending(path, WRITERS)
    if psf.values.ndim != 2:
        raise ExportError(
            "{path}: one file holds one PSF, this stack has shape ({shape}); write them singly",
            path=str(path),
            shape=psf.values.shape,
        )
    record = with_facts(psf, meta or {})
    return write_beside(path, lambda handle: write(handle, psf, record))


def _write_npz(handle: BinaryIO, psf: PsfData, meta: dict) -> None:
    write_arrays(handle, {"psf": psf.values, "x_um": psf.x_um, "y_um": psf.y_um}, meta)


def _write_tiff(handle: BinaryIO, psf: PsfData, meta: dict) -> None:
    facts = {"description": json.dumps(meta), "metadata": None, "resolutionunit": "CENTIMETER"}
    write_pages(handle, psf.values.astype(np.float32), UM_PER_CM / psf.pixel_um, **facts)


def _write_fits(handle: BinaryIO, psf: PsfData, meta: dict) -> None:
    header = [
        *axis_cards(psf.values.shape, psf.pixel_um),
        ("BUNIT", "fraction", "of the light in the window, per pixel"),
        ("METHOD", psf.method, "method of computing the PSF"),
    ]
    write_image(handle, np.asarray(psf.values, dtype=float), header, meta)


def _write_netcdf(handle: BinaryIO, psf: PsfData, meta: dict) -> None:
    samples = {"psf": (("y_um", "x_um"), np.asarray(psf.values, dtype=float))}
    write_netcdf(handle, along("y_um", psf.y_um) | along("x_um", psf.x_um) | samples, meta)


def _write_csv(handle: BinaryIO, psf: PsfData, meta: dict) -> None:
    lines = [
        f"# point spread function, {CONVENTIONS}",
        "# first row: x in µm; first column: y in µm; cells: fraction of the window's light",
        csv_head(meta).rstrip("\n"),
        _csv_row("y_um\\x_um", psf.x_um),
        *(_csv_row(repr(y), row) for y, row in zip(psf.y_um.tolist(), psf.values, strict=True)),
    ]
    handle.write(("\n".join(lines) + "\n").encode())


def _csv_row(head: str, cells: np.ndarray) -> str:
    return ",".join([head, *map(repr, cells.tolist())])


def _write_png(handle: BinaryIO, psf: PsfData, meta: dict) -> None:
    from p2sf.io.psf_plot import draw_psf

    draw_psf(handle, psf, caption(meta), {"Description": json.dumps(meta), "Software": f"p2sf {program_version()}"})


def _read_npz(path: str | os.PathLike[str]) -> tuple[np.ndarray, Any]:
    found = read_arrays(path)
    return found["psf"], parse_json(str(found["meta"]))


def _read_tiff(path: str | os.PathLike[str]) -> tuple[np.ndarray, Any]:
    values, text = first_page(path, "{")
    return values, parse_json(text)


def _read_csv(path: str | os.PathLike[str]) -> tuple[np.ndarray, Any]:
    with open_file(path) as stream:
        lines = [stream.readline(LONGEST_TEXT).decode() for _ in range(CSV_HEAD)]
        meta = next((x.removeprefix("# meta: ") for x in lines if x.startswith("# meta: ")), "")
        check_unpacked(size_of(stream), 0)
        cells = np.loadtxt(stream, delimiter=",", comments=None, ndmin=2)
    return cells[:, 1:], parse_json(meta)


def _read_fits(path: str | os.PathLike[str]) -> tuple[np.ndarray, Any]:
    values, meta = picture_and_meta(path)
    return values.astype(float), meta


def _read_netcdf(path: str | os.PathLike[str]) -> tuple[np.ndarray, Any]:
    return read_netcdf(path, "psf")


WRITERS = {
    ".npz": _write_npz,
    **dict.fromkeys((".tiff", ".tif"), _write_tiff),
    ".csv": _write_csv,
    **dict.fromkeys(FITS, _write_fits),
    ".nc": _write_netcdf,
    ".png": _write_png,
}
READERS = {
    ".npz": _read_npz,
    **dict.fromkeys((".tiff", ".tif"), _read_tiff),
    ".csv": _read_csv,
    **dict.fromkeys(FITS, _read_fits),
    ".nc": _read_netcdf,
}
"""Return the samples and what else the file states; they raise what numpy, the parsers of JSON and `open` do."""
ENDINGS = tuple(WRITERS)
