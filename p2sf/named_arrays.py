"""Arrays with names on their axes: what points over axes and databases answer, for numpy, pandas and xarray alike."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import inf, prod
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import DTypeLike

from p2sf.arguments import UNITS
from p2sf.errors import ExportError
from p2sf.html import html_table

if TYPE_CHECKING:
    import xarray
    from pandas import DataFrame

Dims = tuple[str, ...]
NamedAxes = dict[str, tuple[Dims, np.ndarray]]
"""Values by name, with the names of their axes."""
WAVES = frozenset("w40 w31 w22 w20 w11 wd waves rms_waves rms residual".split())
SHOWN = 6  # values of a coordinate in a notebook


@dataclass(frozen=True, eq=False)
class NamedArrays(Mapping[str, np.ndarray]):
    """Arrays by name, each with named axes, and coordinates along these.

    ``found["tangential"]`` is an array of numpy, and ``np.asarray(found)`` the first of them. Units are in the names.

    Attributes
    ----------
    arrays : dict
        By name the names of the axes and the array, ``(dims, values)``.
    coords : dict
        The same for what lies along the axes, and for what is one number for all of them.
    provenance : dict
        What they are of, as JSON has it: the lens with a hash, and of the setting what no axis changes.
    """

    arrays: NamedAxes
    coords: NamedAxes
    provenance: Mapping[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: str) -> np.ndarray:
        found = self.arrays.get(name) or self.coords.get(name)
        if found is None:
            raise KeyError(f"{name}; there are {', '.join((*self.arrays, *self.coords))}")
        return found[1]

    def __iter__(self) -> Iterator[str]:
        return iter(self.arrays)

    def __len__(self) -> int:
        return len(self.arrays)

    def __eq__(self, other: object) -> bool:
        """Return whether names, axes and numbers are the same; NaN equals NaN."""
        if not isinstance(other, NamedArrays):
            return NotImplemented
        return _same(self.arrays, other.arrays) and _same(self.coords, other.coords)

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> np.ndarray:
        return np.array(next(iter(self.arrays.values()))[1], dtype, copy=copy)

    @property
    def sizes(self) -> dict[str, int]:
        """Return the length of every axis by its name."""
        pairs = (
            zip(dims, values.shape, strict=True) for dims, values in (*self.coords.values(), *self.arrays.values())
        )
        return {name: size for both in pairs for name, size in both}

    def to_xarray(self) -> "xarray.Dataset":
        """Return a dataset of xarray, with coordinates, units and `provenance`. Raises ExportError without xarray."""
        xarray_module = _import_module("xarray")
        coords, arrays = (
            {name: (dims, values, unit_of(name)) for name, (dims, values) in part.items()}
            for part in (self.coords, self.arrays)
        )
        dataset: xarray.Dataset = xarray_module.Dataset(arrays, coords, attributes(self.provenance))
        return dataset

    def to_dataframe(self) -> "DataFrame":
        """Return a table of pandas: one row for each place on all axes, an array a column. ExportError without pandas.

        What has fewer axes stands in every row; a place without a coordinate is its number. ``attrs`` of the table are
        those of `to_xarray`.
        """
        pandas = _import_module("pandas")
        sizes = {name: self.sizes[name] for dims, _ in self.arrays.values() for name in dims}
        places = [self.coords[name][1] if name in self.coords else np.arange(size) for name, size in sizes.items()]
        beside = {name: part for name, part in self.coords.items() if name not in sizes}
        columns = {name: _spread(dims, values, sizes) for name, (dims, values) in (beside | self.arrays).items()}
        index = pandas.MultiIndex.from_product(places, names=list(sizes)) if sizes else None
        table: DataFrame = pandas.DataFrame(columns, index)
        table.attrs |= attributes(self.provenance)
        return table

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name}: {size}" for name, size in self.sizes.items()) or "one point"
        return f"<{', '.join(self.arrays)} over ({sizes})>"

    def _repr_html_(self) -> str:
        rows = []
        for name, (dims, values) in (self.coords | self.arrays).items():
            few = values.size <= SHOWN
            text = (
                np.array2string(values, precision=5, separator=", ") if few else f"{np.min(values)} … {np.max(values)}"
            )
            rows.append((name, " × ".join(dims), text))
        return html_table(repr(self), ("array", "axes", "values"), rows)


def along(name: str, values: np.ndarray) -> NamedAxes:
    """Return a coordinate along its own axis, or of one number without one."""
    return {name: ((name,) if values.ndim else (), values)}


def _same(one: NamedAxes, other: NamedAxes) -> bool:
    def equal(first: np.ndarray, second: np.ndarray) -> bool:
        return np.array_equal(first, second, equal_nan=first.dtype.kind == second.dtype.kind == "f")

    return one.keys() == other.keys() and all(
        dims == other[name][0] and equal(values, other[name][1]) for name, (dims, values) in one.items()
    )


def _spread(dims: Dims, values: np.ndarray, sizes: Mapping[str, int]) -> np.ndarray:
    """Return values at all places of axes of these sizes, (places,)."""
    shape = [sizes[name] if name in dims else 1 for name in sizes]
    order = [dims.index(name) for name in sizes if name in dims]
    found: np.ndarray = np.broadcast_to(values.transpose(order).reshape(shape), tuple(sizes.values()))
    return found.reshape(prod(sizes.values()))


def attributes(record: Mapping[str, Any]) -> dict[str, Any]:
    """Return a record as one level of texts and numbers, which any format of xarray can store.

    A name within a part stands behind that of the part, as ``versions_p2sf``, but for those of ``setup`` and ``psf``;
    ``lens`` is the name of the lens. A length that is null is inf, anything else that is null is left out.
    """
    found: dict[str, Any] = {}
    for name, value in record.items():
        if isinstance(value, Mapping):
            before = "" if name in ("setup", "psf") else f"{name}_"
            found |= {before + key if key != "name" else name: each for key, each in attributes(value).items()}
        elif isinstance(value, list):
            found[name] = json.dumps(value, ensure_ascii=False)
        elif value is not None or name.endswith("_mm"):
            found[name] = inf if value is None else int(value) if isinstance(value, bool) else value
    return {name.replace(" ", "_"): value for name, value in found.items()}


def unit_of(name: str) -> dict[str, str]:
    """Return the unit of a quantity by the ending of its name, as the attribute that xarray and its like read."""
    unit = "waves" if name in WAVES else next((unit for ending, unit in UNITS if name.endswith(ending)), "")
    return {"units": unit} if unit else {}


def _import_module(name: str) -> Any:
    from importlib import import_module

    try:
        return import_module(name)
    except ImportError as error:
        raise ExportError(
            "{library} is not installed; pip install 'p2sf[xarray]'", library=error.name or name
        ) from error
