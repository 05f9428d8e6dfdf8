"""A set of PSFs in one file: .npz, an ImageJ .tif, .fits, .mat, or their figures as .csv."""

import csv
import io
import json
import os
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.errors import ExportError
from p2sf.export.fits import METRES_PER_UM, axis_keywords, write_image
from p2sf.export.psf_set import PsfSet
from p2sf.export.tiff import write_pages
from p2sf.figures.record import CONVENTIONS
from p2sf.files.writing import plain, write_beside
from p2sf.io.fits_psf import META
from p2sf.io.record import csv_head
from p2sf.version import program_version

PathLike = str | os.PathLike[str]
Meta = dict[str, Any]


def write_psf_set(psfs: PsfSet, path: PathLike, meta: dict[str, Any] | None = None) -> Path:
    """Write a set by the ending of ``path``, whole or not at all; ExportError.

    ``meta``, any facts as JSON has them, is stored with it: of a .csv in a line before its table.
    """
    check_set_ending(path)
    return WRITERS[Path(path).suffix.lower()](psfs, path, plain(meta or {}))


def check_set_ending(path: PathLike) -> None:
    """Raise ExportError for an ending that no set has."""
    if Path(path).suffix.lower() not in WRITERS:
        raise ExportError(
            '{path}: the ending "{ending}" is unknown; choose {choices}',
            path=str(path),
            ending=Path(path).suffix,
            choices=tuple(WRITERS),
        )


def about(psfs: PsfSet) -> dict[str, object]:
    """Return what is true of the whole set."""
    return {
        "conventions": CONVENTIONS,
        "lens": psfs.lens.name,
        "aim": psfs.lens.aim,
        "clip": psfs.clip,
        "fill_factor": psfs.grid.fill_factor,
        "values": "share of a point's light per pixel, chief ray in pixel N//2 counted from 0, rows +y",
        "software": f"p2sf {program_version()}",
    }


def arrays(psfs: PsfSet) -> dict[str, np.ndarray]:
    """Return PSFs, axes and figures by name; figures are (depth, field, wavelength)."""
    return {
        "psf": psfs.values,
        "depth_mm": psfs.depths_mm,
        "field_deg": psfs.fields_deg,
        "wavelength_nm": psfs.wavelengths_nm,
        "pixel_um": np.array(psfs.pixel_um),
        "fill_factor": np.array(psfs.grid.fill_factor),
        "chief_mm": psfs.chief_mm,
        "chief_x_mm": psfs.chief_x_mm,
        "captured": psfs.captured,
        "collected": psfs.collected,
        "predicted_error": psfs.error,
    }


def _told(psfs: PsfSet, meta: Meta) -> str:
    return json.dumps(plain(about(psfs)) | meta, ensure_ascii=False)


def _write_npz(psfs: PsfSet, path: PathLike, meta: Meta) -> Path:
    found: dict[str, Any] = {**arrays(psfs), "method": psfs.methods, "meta": np.array(_told(psfs, meta))}
    return write_beside(path, lambda handle: np.savez_compressed(handle, **found))


def _write_mat(psfs: PsfSet, path: PathLike, meta: Meta) -> Path:
    from scipy.io import savemat

    facts = {"meta": plain(about(psfs)), "record": _told(psfs, meta)}
    found = {**arrays(psfs), "method": psfs.methods.astype(object), **facts}
    return write_beside(path, lambda handle: savemat(handle, found, do_compression=True, oned_as="row"))


def _write_tiff(psfs: PsfSet, path: PathLike, meta: Meta) -> Path:
    figures = {name: plain(values) for name, values in arrays(psfs).items() if name != "psf"}
    return write_pages(psfs, path, {**about(psfs), **meta, **figures, "method": psfs.methods.tolist()})


def _write_fits(psfs: PsfSet, path: PathLike, meta: Meta) -> Path:
    header: list[tuple[str, object, str]] = [
        ("PIXELSCL", psfs.pixel_um * METRES_PER_UM, "[m] sensor pitch per pixel"),
        ("PIXUNIT", "meter", "unit of PIXELSCL"),
        ("FILLFACT", psfs.grid.fill_factor, "sensitive part of a pixel's area"),
        ("NORMALIZ", "all light of the point", "PSF normalization"),
        ("BUNIT", "fraction", "of the point's light, per pixel"),
        *axis_keywords(psfs),
        ("INSTRUME", psfs.lens.name[:60], "lens"),
        ("AIM", psfs.lens.aim, "exact rays fill the stop/paraxial pupil"),
        ("CREATOR", f"p2sf {program_version()}", "software"),
        (META, json.dumps(plain(about(psfs)) | meta), "facts as JSON"),
    ]
    rows = table(psfs)
    columns = {str(name): np.array([row[k] for row in rows[1:]]) for k, name in enumerate(rows[0])}
    return write_image(psfs, path, header, {"FIGURES": columns})


def _write_csv(psfs: PsfSet, path: PathLike, meta: Meta) -> Path:
    text = io.StringIO()
    text.write(csv_head(plain(about(psfs)) | meta))
    csv.writer(text, lineterminator="\n").writerows(table(psfs))
    return write_beside(path, lambda handle: handle.write(text.getvalue().encode()))


def table(psfs: PsfSet) -> list[list[object]]:
    """Return the figures, a row for each PSF, names first."""
    names = ["depth_mm", "field_deg", "wavelength_nm", "chief_mm", "chief_x_mm", "captured", "collected", "peak"]
    rows: list[list[object]] = [
        [*names, "centroid_x_um", "centroid_y_um", "rms_radius_um", "predicted_error", "method"]
    ]
    axes = product(*(range(n) for n in psfs.axes.shape))
    for at in axes:
        values = psfs.values[at]
        place = psfs.axes.depths_mm[at[0]], psfs.axes.fields_deg[at[1]], psfs.axes.wavelengths_nm[at[2]]
        light = (float(x[at]) for x in (psfs.chief_mm, psfs.chief_x_mm, psfs.captured, psfs.collected))
        x, y, radius = moments(values, psfs.pixel_um)
        figures = float(values.max()), x, y, radius, float(psfs.error[at])
        rows.append([*place, *light, *figures, str(psfs.methods[at])])
    return rows


def moments(values: np.ndarray, pixel_um: float) -> tuple[float, float, float]:
    """Return the centroid from the chief ray, x and y, and the RMS radius about it, µm, of what the pixels receive."""
    axis = (np.arange(len(values)) - len(values) // 2) * pixel_um
    light = values / values.sum(dtype=float)
    x, y = float(light.sum(0) @ axis), float(light.sum(1) @ axis)
    square = light.sum(0) @ (axis - x) ** 2 + light.sum(1) @ (axis - y) ** 2
    return x, y, float(square) ** 0.5


HOLDING = (".npz", ".tif", ".tiff", ".fits")  # the ``meta`` of `write_psf_set`
WRITERS: dict[str, Callable[[PsfSet, PathLike, Meta], Path]] = {
    ".npz": _write_npz,
    ".tif": _write_tiff,
    ".tiff": _write_tiff,
    ".fits": _write_fits,
    ".mat": _write_mat,
    ".csv": _write_csv,
}
