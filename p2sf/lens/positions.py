"""Zoom and focus positions: a lens whose prescription is known in named columns, and what lies between them."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from itertools import pairwise
from math import inf, isfinite, prod
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from p2sf.errors import GeometryError, RequestError
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.properties import PROPERTIES
from p2sf.messages import Message

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

Kind = Literal["zoom", "focus"]
PARAMETER: dict[Kind, str] = {"zoom": "zoom", "focus": "focus_position"}
"""What a request calls the position on an axis."""
Address = tuple[int, str, int]
"""Where a number of a lens is: surface from 0 (−1: the lens itself), field, place in the field's tuple."""
WHOLE = -1
KEPT = ("name", "title", "source", "comment", "character", "aim", "mask", "absorption")
"""Fields of a lens that are the same at every position; columns have their defaults."""
PLAIN: dict[str, Any] = {field.name: field.default for field in fields(Lens) if field.name in (*KEPT, "positions")}


@dataclass(frozen=True)
class Axis:
    """One ring of a lens: its scale, and where on it the prescription is known.

    Parameters
    ----------
    kind : str
        "zoom" or "focus".
    columns : tuple of str
        The name of every column, such as "wide" or "35 mm".
    at : tuple of float
        Where on the ring's scale each column is, ascending. Numbers between columns are interpolated in this variable.
    unit : str
        The unit of the scale, "" for a bare number.

    Raises
    ------
    GeometryError
        For fewer than two columns, and for places that do not ascend.
    """

    kind: Kind
    columns: tuple[str, ...]
    at: tuple[float, ...]
    unit: str = ""

    def __post_init__(self) -> None:
        if len(self.columns) < 2 or len(self.columns) != len(self.at):
            raise GeometryError(
                "{kind} has {columns} columns at {places} places; give at least two, and one place for each",
                kind=self.kind,
                columns=len(self.columns),
                places=len(self.at),
            )
        if len(set(self.columns)) < len(self.columns):
            raise GeometryError(
                "{kind} has two columns of one name: {names}; rename one", kind=self.kind, names=self.columns
            )
        if not all(map(isfinite, self.at)) or any(high <= low for low, high in pairwise(self.at)):
            raise GeometryError(
                "{kind} has its columns at {places}; give finite numbers that ascend", kind=self.kind, places=self.at
            )

    @property
    def low(self) -> float:
        """Return where the scale begins."""
        return self.at[0]

    @property
    def high(self) -> float:
        """Return where the scale ends."""
        return self.at[-1]

    def nearest(self, place: float) -> int:
        """Return the column nearest to a place, from 0; of two equally near ones the first."""
        return min(range(len(self.at)), key=lambda column: abs(self.at[column] - place))

    def words(self, place: float) -> str:
        """Return a place as its column is called, else as a number with its unit."""
        if place in self.at:
            return self.columns[self.at.index(place)]
        return f"{place:.6g} {self.unit}".strip()

    def place(self, asked: float | str) -> float:
        """Return the place that a number, or the name of a column, means; RequestError for one that is not there."""
        names = {name.casefold(): place for name, place in zip(self.columns, self.at, strict=True)}
        try:
            place = names[asked.strip().casefold()] if isinstance(asked, str) else float(asked)
        except KeyError:
            place = _number(str(asked), self.unit)
        if self.low <= place <= self.high:
            return place
        raise RequestError(
            "{parameter} is {value}; give a number from {low:g} to {high:g}{unit}, or a column of the lens: {columns}",
            parameter=PARAMETER[self.kind],
            value=position_text(asked),
            low=self.low,
            high=self.high,
            unit=f" {self.unit}" if self.unit else "",
            columns=self.columns,
        )


def position_text(asked: float | str) -> str:
    """Return a position as a person may have written it."""
    return asked if isinstance(asked, str) else f"{asked:g}"


def _number(text: str, unit: str) -> float:
    """Return a number that may have its unit behind it; inf, which is on no scale, for anything else."""
    try:
        return float(text.strip().removesuffix(unit))
    except ValueError:
        return inf


@dataclass(frozen=True)
class Positions:
    """All that is known of a lens that zooms or focuses: a plain lens for every combination of columns.

    Parameters
    ----------
    axes : tuple of Axis
        The rings of the lens, zoom first.
    lenses : tuple of Lens
        The lens at each combination of columns, those of the last axis next to each other.
    place : tuple of float
        Where each ring stands.

    Raises
    ------
    GeometryError
        For another number of lenses than there are combinations, and for lenses of different numbers of surfaces.
    """

    axes: tuple[Axis, ...]
    lenses: tuple[Lens, ...]
    place: tuple[float, ...]

    def __post_init__(self) -> None:
        count = prod(len(axis.columns) for axis in self.axes)
        if len(self.lenses) != count:
            raise GeometryError(
                "there are {count} lenses for {due} columns; give one for each", count=len(self.lenses), due=count
            )
        surfaces = {len(lens.surfaces) for lens in self.lenses}
        if len(surfaces) > 1:
            raise GeometryError(
                "the columns have {counts} surfaces; give every column the same surfaces",
                counts=tuple(sorted(surfaces)),
            )

    def axis(self, kind: Kind) -> Axis | None:
        """Return the axis of a kind, None where the lens has none."""
        return next((axis for axis in self.axes if axis.kind == kind), None)

    def at(self, kind: Kind) -> float | None:
        """Return where the ring of a kind stands, None where the lens has none."""
        return next((place for axis, place in zip(self.axes, self.place, strict=True) if axis.kind == kind), None)

    @property
    def column(self) -> int | None:
        """Return which of ``lenses`` this position is, None between columns."""
        number = 0
        for axis, place in zip(self.axes, self.place, strict=True):
            if place not in axis.at:
                return None
            number = number * len(axis.at) + axis.at.index(place)
        return number

    @property
    def words(self) -> Message:
        """Return the position in words: "zoom 35 mm", "zoom tele, focus 0.5 m"."""
        parts = [
            Message(WORDS[axis.kind], place=axis.words(place))
            for axis, place in zip(self.axes, self.place, strict=True)
        ]
        return parts[0] if len(parts) == 1 else Message("{first}, {second}", first=parts[0], second=parts[1])


WORDS: dict[Kind, str] = {"zoom": "zoom {place}", "focus": "focus {place}"}


def with_positions(axes: Sequence[Axis], lenses: Sequence[Lens]) -> Lens:
    """Return the lens of these columns, in its first one; GeometryError for columns that make no lens.

    ``lenses`` has a plain lens for each combination of columns, those of the last axis next to each other. Texts, such
    as the name, and the aim are those of the first.
    """
    columns = tuple(replace(lens, **PLAIN) for lens in lenses)
    return replace(lenses[0], positions=Positions(tuple(axes), columns, tuple(axis.low for axis in axes)))


@lru_cache(maxsize=128)
def interpolate_lens(positions: Positions, place: tuple[float, ...]) -> Lens:
    """Return the plain lens with its rings at ``place``, one number for each axis, within its scale.

    In a column it is the column's own. Between columns every number that varies is a monotone cubic of the place
    (`scipy.interpolate.PchipInterpolator`), a radius by its curvature, and what is no number, such as a glass, is that
    of the nearest column.
    """
    lenses = positions.lenses
    for axis, there in reversed(list(zip(positions.axes, place, strict=True))):
        count = len(axis.at)
        lenses = tuple(_along(axis, lenses[k : k + count], there) for k in range(0, len(lenses), count))
    return lenses[0]


def _along(axis: Axis, lenses: tuple[Lens, ...], place: float) -> Lens:
    """Return the lens at a place of one axis, of whose columns ``lenses`` are."""
    if place in axis.at:
        return lenses[axis.at.index(place)]
    near, (addresses, curve) = lenses[axis.nearest(place)], _curves(axis.at, lenses)
    if curve is None:
        return near
    values = dict(zip(addresses, curve(place).tolist(), strict=True))
    surfaces = tuple(_with_values(surface, number, values) for number, surface in enumerate(near.surfaces))
    return replace(
        near,
        surfaces=surfaces,
        aperture=Aperture(near.aperture.kind, values.get((WHOLE, near.aperture.kind, 0), near.aperture.value)),
        fields_deg=tuple(values.get((WHOLE, "fields_deg", k), field) for k, field in enumerate(near.fields_deg)),
    )


@lru_cache(maxsize=64)
def _curves(at: tuple[float, ...], lenses: tuple[Lens, ...]) -> "tuple[tuple[Address, ...], PchipInterpolator | None]":
    """Return where the lenses have different numbers, and these as a function of the place (Fritsch & Butland 1984)."""
    from scipy.interpolate import PchipInterpolator

    columns = [_numbers(lens) for lens in lenses]
    addresses = tuple(address for address in columns[0] if _varies(address, columns))
    if not addresses:
        return (), None
    return addresses, PchipInterpolator(at, np.array([[column[key] for key in addresses] for column in columns]))


def _varies(address: Address, columns: Sequence[dict[Address, float]]) -> bool:
    values = [column.get(address, inf) for column in columns]
    return all(map(isfinite, values)) and len(set(values)) > 1


def _numbers(lens: Lens) -> dict[Address, float]:
    """Return every number of a lens that can change steadily; a radius as its curvature, which passes through 0."""
    found: dict[Address, float] = {(WHOLE, "fields_deg", k): field for k, field in enumerate(lens.fields_deg)}
    found[WHOLE, lens.aperture.kind, 0] = lens.aperture.value
    for number, surface in enumerate(lens.surfaces):
        for entry in fields(Surface):
            value = surface.curvature if entry.name == "radius" else getattr(surface, entry.name)
            for place, item in enumerate(value if isinstance(value, tuple) else (value,)):
                if isinstance(item, int | float) and not isinstance(item, bool):
                    found[number, entry.name, place] = item
    return found


def _with_values(surface: Surface, number: int, values: dict[Address, float]) -> Surface:
    """Return a surface with those of the values that are its own."""
    own = {(name, place): value for (where, name, place), value in values.items() if where == number}
    changes: dict[str, object] = {}
    for name, place in own:
        before = getattr(surface, name)
        if name == "radius":
            changes[name] = 1 / own[name, 0] if own[name, 0] else inf
        elif isinstance(before, tuple):
            changes[name] = tuple(own.get((name, k), item) for k, item in enumerate(before))
        else:
            changes[name] = own[name, place]
    return replace(surface, **changes) if changes else surface  # type: ignore[arg-type]  # names are Surface's own


def alone(lens: Lens) -> Lens:
    """Return the lens of this position alone, which cannot be moved."""
    return replace(lens, positions=None)


def steps_between(lens: Lens) -> tuple[Message, ...]:
    """Return what of a lens between two columns is not interpolated, in words: glasses and other discrete changes."""
    if lens.positions is None or lens.positions.column is not None:
        return ()
    columns = lens.positions.lenses
    near = Message(
        "column {column}",
        column=tuple(axis.columns[axis.nearest(place)] for axis, place in _standing(lens.positions)),
    )
    found = []
    for number, rows in enumerate(zip(*(column.surfaces for column in columns), strict=True), 1):
        for each in PROPERTIES:
            if each.steps and len({getattr(row, each.name) for row in rows}) > 1:
                found.append(Message(STEP, surface=number, what=each.label, near=near))
    for name, words in DISCRETE.items():
        if len({getattr(column, name) for column in columns}) > 1:
            found.append(
                Message(
                    "{quantity} differ between columns and are those of the nearest, {near}", quantity=words, near=near
                )
            )
    return tuple(found)


STEP = "surface {surface}: {what} is not one in all columns; it is that of the nearest, {near}"
DISCRETE = {"wavelengths_nm": Message("wavelengths"), "stop_surface": Message("stops")}


def _standing(positions: Positions) -> list[tuple[Axis, float]]:
    return list(zip(positions.axes, positions.place, strict=True))
