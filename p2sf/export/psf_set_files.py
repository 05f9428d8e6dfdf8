"""A set of PSFs in one file: .npz, an ImageJ .tif, .fits, .mat, or their figures as .csv."""

import csv
import io
import json
import os
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from p2sf.export.fits import METRES_PER_UM, axis_tables
from p2sf.export.psf_set import PsfSet
from p2sf.export.tiff import write_hyperstack
from p2sf.figures.record import CONVENTIONS
from p2sf.files.writing import by_ending, plain, write_arrays, write_beside
from p2sf.io.fits import Card, axis_cards, write_image
from p2sf.io.record import csv_head
from p2sf.version import program_version

PathLike = str | os.PathLike[str]
Meta = dict[str, Any]


def write_psf_set(psfs: PsfSet, path: PathLike, meta: dict[str, Any] | None = None) -> Path:
    """Write a set by the ending of ``path``, whole or not at all; ExportError.

    ``meta``, any facts as JSON has them, is stored with it: of a .csv in a line before its table.
    """
    write, facts = by_ending(path, WRITERS), plain(about(psfs)) | plain(meta or {})
    return write_beside(path, lambda handle: write(handle, psfs, facts))


def check_set_ending(path: PathLike) -> None:
    """Raise ExportError for an ending that no set has."""
    by_ending(path, WRITERS)


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


def _write_npz(handle: BinaryIO, psfs: PsfSet, facts: Meta) -> None:
    write_arrays(handle, arrays(psfs) | {"method": psfs.methods}, facts)


def _write_mat(handle: BinaryIO, psfs: PsfSet, facts: Meta) -> None:
    from scipy.io import savemat

    told = {"meta": plain(about(psfs)), "record": json.dumps(facts, ensure_ascii=False)}
    found = {**arrays(psfs), "method": psfs.methods.astype(object), **told}
    savemat(handle, found, do_compression=True, oned_as="row")


def _write_tiff(handle: BinaryIO, psfs: PsfSet, facts: Meta) -> None:
    figures = {name: plain(values) for name, values in arrays(psfs).items() if name != "psf"}
    write_hyperstack(handle, psfs, {**facts, **figures, "method": psfs.methods.tolist()})


def _write_fits(handle: BinaryIO, psfs: PsfSet, facts: Meta) -> None:
    header: list[Card] = [
        ("PIXELSCL", psfs.pixel_um * METRES_PER_UM, "[m] sensor pitch per pixel"),
        ("PIXUNIT", "meter", "unit of PIXELSCL"),
        ("FILLFACT", psfs.grid.fill_factor, "sensitive part of a pixel's area"),
        ("NORMALIZ", "all light of the point", "PSF normalization"),
        ("BUNIT", "fraction", "of the point's light, per pixel"),
        *axis_cards(psfs.values.shape, psfs.pixel_um),
        ("INSTRUME", psfs.lens.name[:60], "lens"),
        ("AIM", psfs.lens.aim, "exact rays fill the stop/paraxial pupil"),
    ]
    names, *rows = table(psfs)
    figures = [(str(name), np.array(values), "") for name, values in zip(names, zip(*rows, strict=True), strict=True)]
    write_image(handle, psfs.values, header, facts, axis_tables(psfs) | {"FIGURES": figures})


def _write_csv(handle: BinaryIO, psfs: PsfSet, facts: Meta) -> None:
    text = io.StringIO()
    text.write(csv_head(facts))
    csv.writer(text, lineterminator="\n").writerows(table(psfs))
    handle.write(text.getvalue().encode())


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
WRITERS: dict[str, Callable[[BinaryIO, PsfSet, Meta], None]] = {
    ".npz": _write_npz,
    ".tif": _write_tiff,
    ".tiff": _write_tiff,
    ".fits": _write_fits,
    ".mat": _write_mat,
    ".csv": _write_csv,
}
