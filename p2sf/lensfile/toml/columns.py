"""Columns of a lens file: an entry that has one value for each position of a zoom or focus ring.

[zoom]                           # or [focus], or both
columns = ["wide", "middle", "tele"]
at = [24, 35, 70]                # where on the ring's scale, ascending; left out: evenly from 0 to 1
unit = "mm"                      # of this scale; left out: none

With one ring an entry lists its values: ``thickness = [1.2, 10.0, 20.0]``. With both, a list for every zoom column
holds a value for every focus column, and an entry that follows one ring says which: ``thickness = { focus = […] }``.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product
from math import isfinite, prod
from typing import Any

from p2sf.errors import GeometryError, LensFileError
from p2sf.lens.lens import Lens
from p2sf.lens.positions import Axis, Kind, with_positions
from p2sf.lensfile.toml.table import Constraint, Table, shorten
from p2sf.messages import Message

KINDS: tuple[Kind, ...] = ("zoom", "focus")
AXIS = ("columns", "at", "unit")
PLACE = Constraint(isfinite, Message("write a finite number"))
# How deep lists are nested in an entry that is the same at every position; of other entries only tables vary.
NUMBERS = ("radius", "thickness", "glass", "semi_diameter", "conic", "object_distance")
LISTS = ("fields_deg", "fields_x_deg", "wavelengths_nm", "wavelength_weights", "aspheric")
APERTURES = ("stop_semi_diameter", "entrance_pupil_diameter", "f_number")
DEPTH = {**dict.fromkeys((*NUMBERS, *APERTURES), 0), **dict.fromkeys(LISTS, 1)}
Column = dict[Kind, int]


def read_columns(top: Table, read: Callable[[Table], Lens]) -> Lens:
    """Return the lens of a file, each of whose columns ``read`` reads as if it were the only one; LensFileError."""
    axes = tuple(_axis(top, kind) for kind in KINDS if kind in top.values)
    plain = {key: value for key, value in top.values.items() if key not in KINDS}
    if not axes:
        return read(replace(top, values=plain))
    counts = [range(len(axis.columns)) for axis in axes]
    combinations = [dict(zip((axis.kind for axis in axes), numbers, strict=True)) for numbers in product(*counts)]
    lenses = [read(replace(top, values=_column(top, plain, axes, column))) for column in combinations]
    if len(set(lenses)) == 1:
        top.fail("nothing varies from column to column; list the values of what does", axes[0].kind)
    return with_positions(axes, lenses)


def _axis(top: Table, kind: Kind) -> Axis:
    values = top.values[kind]
    if not isinstance(values, dict):
        top.fail("{name} is {found}; write a table [{name}] with its columns", kind, name=kind, found=shorten(values))
    table = Table(top.path, top.text, values, kind)
    table.check_keys(AXIS)
    names = values.get("columns")
    if not isinstance(names, list) or len(names) < 2 or not all(isinstance(name, str) and name for name in names):
        table.fail(
            'columns is {found}; write at least two names, as in ["wide", "tele"]', "columns", found=shorten(names)
        )
    evenly = tuple(number / (len(names) - 1) for number in range(len(names)))
    try:
        return Axis(kind, tuple(names), table.numbers("at", PLACE, evenly), table.string("unit"))
    except GeometryError as error:
        table.fail(error.message, "at")


def _column(top: Table, values: dict[str, Any], axes: tuple[Axis, ...], column: Column) -> dict[str, Any]:
    """Return the file's values in one column: an entry with a list of values has the one of this column."""
    found = _resolve_column(top, values, axes, column)
    if isinstance(values.get("aperture"), dict):
        found["aperture"] = _resolve_column(Table(top.path, top.text, values["aperture"], "aperture"), {}, axes, column)
    rows = values.get("surface")
    if isinstance(rows, list) and all(isinstance(row, dict) for row in rows):
        tables = [Table(top.path, top.text, row, "surface", number) for number, row in enumerate(rows, 1)]
        found["surface"] = [_resolve_column(table, {}, axes, column) for table in tables]
    return found


def _resolve_column(table: Table, values: dict[str, Any], axes: tuple[Axis, ...], column: Column) -> dict[str, Any]:
    return {key: _value(table, key, value, axes, column) for key, value in (values or table.values).items()}


def _value(table: Table, key: str, value: Any, axes: tuple[Axis, ...], column: Column) -> Any:
    """Return the value of an entry in a column; LensFileError for another number of values than columns."""
    if isinstance(value, dict) and len(value) == 1 and next(iter(value)) in KINDS:
        kind = next(iter(value))
        axis = next((axis for axis in axes if axis.kind == kind), None)
        if axis is None:
            table.fail("{name} varies with {kind}, of which there is no table; add [{kind}]", key, name=key, kind=kind)
        others = tuple(other for other in axes if other is not axis)
        return _value(table, key, _item(table, key, value[kind], axis, column), others, column)
    deeper = _depth(value) - DEPTH.get(key, _depth(value))
    if deeper <= 0:
        return value
    if deeper < len(axes):
        table.fail(
            "{name} has one list, and the lens has two rings; write {{ zoom = […] }} or {{ focus = […] }}, "
            "or a list of lists",
            key,
            name=key,
        )
    if not axes:
        return value  # too deep, which the reader of a plain lens refuses by its place
    return _value(table, key, _item(table, key, value, axes[0], column), axes[1:], column)


def _item(table: Table, key: str, values: Any, axis: Axis, column: Column) -> Any:
    if not isinstance(values, list) or len(values) != len(axis.columns):
        table.fail(
            "{name} is {found}; write one value for each of the {count} columns of {kind}",
            key,
            name=key,
            found=shorten(values),
            count=len(axis.columns),
            kind=axis.kind,
        )
    return values[column[axis.kind]]


def _depth(value: Any) -> int:
    return 1 + max(map(_depth, value), default=0) if isinstance(value, list) else 0


def axis_text(axis: Axis, quoted: Callable[[str], str], numbers: Callable[[Sequence[float]], str]) -> str:
    """Return the table of an axis as TOML."""
    names = ", ".join(map(quoted, axis.columns))
    unit = f"unit = {quoted(axis.unit)}\n" if axis.unit else ""
    return f"\n[{axis.kind}]\ncolumns = [{names}]\nat = {numbers(axis.at)}\n{unit}"


def join_columns(axes: tuple[Axis, ...], key: str, values: Sequence[str]) -> str:
    """Return the TOML of one entry from its value in every combination of columns: itself where all are equal.

    LensFileError for an entry that only some columns have.
    """
    if len(set(values)) == 1:
        return values[0]
    if not all(values):
        raise LensFileError("only some columns of the lens have {name}; give it to all of them or to none", name=key)
    stride = prod(len(axis.columns) for axis in axes[1:])
    rows = [values[start : start + stride] for start in range(0, len(values), stride)]
    if len(axes) == 1:
        return _list_toml(values) if key in DEPTH else _table(axes[0], values)
    if all(len(set(row)) == 1 for row in rows):
        return _table(axes[0], [row[0] for row in rows])
    if len(set(map(tuple, rows))) == 1:
        return _table(axes[1], rows[0])
    if key in DEPTH:
        return _list_toml(list(map(_list_toml, rows)))
    return _table(axes[0], [_table(axes[1], row) for row in rows])


def _table(axis: Axis, values: Sequence[str]) -> str:
    return f"{{ {axis.kind} = {_list_toml(values)} }}"


def _list_toml(values: Sequence[str]) -> str:
    return f"[{', '.join(values)}]"


def columns_of(lens: Lens) -> tuple[Lens, ...]:
    """Return the lenses that a file of this one states: its columns, or itself where it has none.

    LensFileError for columns that differ in what a file states once: the kind of aperture, and the stop.
    """
    columns = lens.positions.lenses if lens.positions else (lens,)
    for words, stated in (
        (Message("kinds of aperture"), [column.aperture.kind for column in columns]),
        (Message("stops"), [column.stop_surface for column in columns]),
    ):
        if len(set(stated)) > 1:
            raise LensFileError(
                "the columns of the lens have different {what}, {stated}; a file holds one, so give all the same",
                what=words,
                stated=tuple(dict.fromkeys(map(str, stated))),
            )
    return columns
