"""NetCDF: samples over named axes with units, and facts as attributes; the classic format, which every reader knows."""

import io
import json
import os
from collections.abc import Mapping
from typing import Any, BinaryIO

import numpy as np

from p2sf.files.reading import parse_json, read_bytes
from p2sf.named_arrays import NamedAxes, attributes, unit_of

META = "p2sf_meta"
"""The attribute that holds all facts as JSON; the others are the same on one level, for people and xarray."""


def write_netcdf(handle: BinaryIO, arrays: NamedAxes, meta: Mapping[str, Any]) -> None:
    """Write arrays of floats, a coordinate by the name of its axis, and ``meta`` (NetCDF classic format, Unidata)."""
    from scipy.io import netcdf_file

    content = io.BytesIO()
    file = netcdf_file(content, "w")
    for name, value in {**attributes(meta), META: json.dumps(meta)}.items():
        # Names of the writer's own, such as "mode", hold no attribute of a file.
        setattr(file, f"meta_{name}" if hasattr(file, name) else name, _value(value))
    for dims, values in arrays.values():
        for dim, count in zip(dims, values.shape, strict=True):
            if dim not in file.dimensions:
                file.createDimension(dim, count)
    for name, (dims, values) in arrays.items():
        variable = file.createVariable(name, "d", dims)
        variable[...] = values
        for key, value in unit_of(name).items():
            setattr(variable, key, _value(value))
    file.flush()
    handle.write(content.getbuffer())


def read_netcdf(path: str | os.PathLike[str], name: str) -> tuple[np.ndarray, Any]:
    """Return one array of a file of `write_netcdf` and its facts.

    Raises OSError, ValueError, KeyError, TypeError and AttributeError for what cannot be read.
    """
    from scipy.io import netcdf_file

    file = netcdf_file(io.BytesIO(read_bytes(path)), "r")
    values = np.array(file.variables[name][...], dtype=float)
    return values, parse_json(getattr(file, META).decode())


def _value(value: Any) -> Any:
    """Return an attribute as the format has it: UTF-8, a double or four bytes."""
    if isinstance(value, str):
        return value.encode() or b" "  # an empty text has no place in it
    whole = not isinstance(value, float) and abs(value) <= np.iinfo(np.int32).max
    return np.int32(value) if whole else np.float64(value)
