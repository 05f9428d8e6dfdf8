"""Many sources at once: arrays of depths, fields and wavelengths for a database, and their PSFs in blocks."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import real_array
from p2sf.conventions import NM_PER_UM, slope_from_degrees
from p2sf.database.render import Database, Sampling, critical_pixel_um, grid_of, light_of
from p2sf.database.space import Space
from p2sf.errors import DatabaseError, RequestError

AT_ONCE = 2**24  # samples of PSFs in memory in addition to those written: 64 MB of float32

Points = tuple[np.ndarray, ...]
"""Depth (mm), field slope or slopes and wavelength (µm), which broadcast, in the order of `Space.nodes`."""


def points_of(
    space: Space,
    depth_mm: ArrayLike,
    field_deg: ArrayLike,
    wavelength_nm: ArrayLike | None = None,
    field_x_deg: ArrayLike | None = None,
) -> Points:
    """Return points of a space, by default of its middle wavelength and with no angle along x.

    Raises RequestError for values that are not real numbers or do not broadcast, DatabaseError for angles along x if
    fields are along one line.
    """
    if wavelength_nm is None:
        wavelength_nm = space.wavelengths_um[len(space.wavelengths_um) // 2] * NM_PER_UM
    given = {"depth_mm": depth_mm, "field_deg": field_deg}
    if space.field_x_slopes is not None:
        given["field_x_deg"] = 0.0 if field_x_deg is None else field_x_deg
    elif field_x_deg is not None:
        raise DatabaseError(
            "this database has fields along one line; give angles from the axis, without {parameter}",
            parameter="field_x_deg",
        )
    given["wavelength_nm"] = wavelength_nm
    depth, *fields, wavelength = (real_array(name, values) for name, values in given.items())
    shapes = [each.shape for each in (depth, *fields, wavelength)]
    try:
        np.broadcast_shapes(*shapes)
    except ValueError:
        raise RequestError(
            "{names} have the shapes {shapes}, which do not broadcast; give arrays as numpy adds them",
            names=tuple(given),
            shapes=tuple(map(str, shapes)),
        ) from None
    return depth, *(slope_from_degrees(angles) for angles in fields), wavelength / NM_PER_UM


def psfs_into(database: Database, points: Points, sampling: Sampling, out: Any = None) -> Any:
    """Return unit-sum PSFs at points, (*broadcast shape, pixels, pixels), written to ``out``, or as float32.

    They are rendered in blocks, so that ``out`` may be an array on a disk, larger than the memory. Raises RequestError
    for an ``out`` of another shape, and what `render_source` does.
    """
    every = np.broadcast_arrays(*points)
    shape = (*every[0].shape, sampling.pixels, sampling.pixels)
    found = np.empty(shape, np.float32) if out is None else out
    if tuple(found.shape) != shape:
        raise RequestError(
            "{parameter} has the shape {given}, and the PSFs {shape}; give one of that shape",
            parameter="out",
            given=str(tuple(found.shape)),
            shape=str(shape),
        )
    sampling = replace(sampling, pixel_um=sampling.pixel_um or critical_pixel_um(database))
    grid = grid_of(database, sampling)
    for some in _blocks(shape):
        found[some] = light_of(database, [each[some] for each in every], sampling, grid, found.dtype)
    return found


def _blocks(shape: tuple[int, ...]) -> list[Any]:
    """Return indices along the first axis that take at most AT_ONCE samples each, as far as that axis allows."""
    *points, rows, columns = shape
    if not points:
        return [()]
    each = max(1, AT_ONCE // max(1, int(np.prod(points[1:])) * rows * columns))
    return [slice(start, start + each) for start in range(0, points[0], each)]
