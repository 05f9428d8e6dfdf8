"""Zoom and focus positions: a lens whose prescription is known in named columns, and its interpolation between them."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from itertools import pairwise
from math import inf, isfinite, prod
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from p2sf.conventions import depth_of
from p2sf.errors import GeometryError, RequestError
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.properties import PROPERTIES
from p2sf.messages import Message

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

Kind = Literal["zoom", "focus"]
PARAMETER: dict[Kind, str] = {"zoom": "zoom", "focus": "focus_position"}
"""The parameter of a request for the position on an axis."""
Address = tuple[int, str, int]
"""Address of a number in a lens: surface from 0 (−1: the lens itself), field, index in the field's tuple."""
WHOLE = -1
OBJECT_VERGENCE: Address = (WHOLE, "object_distance", 0)
FIELDS = ("fields_deg", "fields_x_deg")
KEPT = ("name", "title", "source", "comment", "character", "aim", "mask", "absorption", "sensor_radius", "sensor_conic")
"""Fields of a lens that are the same at every position; in columns they have their defaults."""
PLAIN: dict[str, Any] = {field.name: field.default for field in fields(Lens) if field.name in (*KEPT, "positions")}


@dataclass(frozen=True)
class Axis:
    """One ring of a lens: its scale, and the positions on it at which the prescription is known.

    Parameters
    ----------
    kind : str
        "zoom" or "focus".
    columns : tuple of str
        The name of every column, such as "wide" or "35 mm".
    at : tuple of float
        Position of each column on the ring's scale, ascending; interpolation between columns uses this variable.
    unit : str
        The unit of the scale, "" for a plain number.

    Raises
    ------
    GeometryError
        For fewer than two columns, and for positions that do not ascend.
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
                "{kind} has two columns with the same name: {names}; rename one", kind=self.kind, names=self.columns
            )
        if not all(map(isfinite, self.at)) or any(high <= low for low, high in pairwise(self.at)):
            raise GeometryError(
                "{kind} has its columns at {places}; give finite numbers that ascend", kind=self.kind, places=self.at
            )

    @property
    def low(self) -> float:
        """Return the lower end of the scale."""
        return self.at[0]

    @property
    def high(self) -> float:
        """Return the upper end of the scale."""
        return self.at[-1]

    def nearest(self, place: float) -> int:
        """Return the column nearest to a position, from 0; the first of two equally near ones."""
        return min(range(len(self.at)), key=lambda column: abs(self.at[column] - place))

    def words(self, place: float) -> str:
        """Return a position as the name of its column or, between columns, as a number with its unit."""
        if place in self.at:
            return self.columns[self.at.index(place)]
        return f"{place:.6g} {self.unit}".strip()

    def place(self, asked: float | str) -> float:
        """Return the position of a number or of the name of a column; RequestError if it does not exist."""
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
    """Return a position as a user may write it."""
    return asked if isinstance(asked, str) else f"{asked:g}"


def _number(text: str, unit: str) -> float:
    """Return a number with or without its unit; inf, which is on no scale, for anything else."""
    try:
        return float(text.strip().removesuffix(unit))
    except ValueError:
        return inf


@dataclass(frozen=True)
class Positions:
    """The data of a lens that zooms or focuses: a plain lens for every combination of columns.

    Parameters
    ----------
    axes : tuple of Axis
        The rings of the lens, zoom first.
    lenses : tuple of Lens
        The lens at each combination of columns, with the last axis varying fastest.
    place : tuple of float
        The position of each ring.

    Raises
    ------
    GeometryError
        If the number of lenses is not that of the combinations, or the numbers of surfaces differ.
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
        """Return the axis of a kind, None if the lens has none."""
        return next((axis for axis in self.axes if axis.kind == kind), None)

    def at(self, kind: Kind) -> float | None:
        """Return the position of the ring of a kind, None if the lens has none."""
        return next((place for axis, place in zip(self.axes, self.place, strict=True) if axis.kind == kind), None)

    @property
    def column(self) -> int | None:
        """Return the index in ``lenses`` of this position, None between columns."""
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
    """Return the lens with these columns, in its first column; GeometryError for inconsistent columns.

    ``lenses`` has a plain lens for each combination of columns, with the last axis varying fastest. Texts, such as the
    name, and the aim are those of the first.
    """
    columns = tuple(replace(lens, **PLAIN) for lens in lenses)
    return replace(lenses[0], positions=Positions(tuple(axes), columns, tuple(axis.low for axis in axes)))


@lru_cache(maxsize=128)
def interpolate_lens(positions: Positions, place: tuple[float, ...]) -> Lens:
    """Return the plain lens with its rings at ``place``, one number for each axis, within its scale.

    At a column it is the lens of that column. Between columns every number that varies is interpolated by a monotone
    cubic (`scipy.interpolate.PchipInterpolator`), radii as curvatures and the object's distance as vergence; everything
    else, such as a glass, is taken from the nearest column.
    """
    lenses = positions.lenses
    for axis, there in reversed(list(zip(positions.axes, place, strict=True))):
        count = len(axis.at)
        lenses = tuple(_along(axis, lenses[k : k + count], there) for k in range(0, len(lenses), count))
    return lenses[0]


def _along(axis: Axis, lenses: tuple[Lens, ...], place: float) -> Lens:
    """Return the lens at a position on one axis with the columns ``lenses``."""
    if place in axis.at:
        return lenses[axis.at.index(place)]
    near, (addresses, curve) = lenses[axis.nearest(place)], _curves(axis.at, lenses)
    if curve is None:
        return near
    values = dict(zip(addresses, curve(place).tolist(), strict=True))
    surfaces = tuple(_with_values(surface, number, values) for number, surface in enumerate(near.surfaces))
    along_y, along_x = (
        tuple(values.get((WHOLE, name, k), field) for k, field in enumerate(getattr(near, name))) for name in FIELDS
    )
    vergence = values.get(OBJECT_VERGENCE)
    return replace(
        near,
        surfaces=surfaces,
        object_distance=near.object_distance if vergence is None else depth_of(vergence),
        aperture=Aperture(near.aperture.kind, values.get((WHOLE, near.aperture.kind, 0), near.aperture.value)),
        fields_deg=along_y,
        fields_x_deg=along_x,
    )


@lru_cache(maxsize=64)
def _curves(at: tuple[float, ...], lenses: tuple[Lens, ...]) -> "tuple[tuple[Address, ...], PchipInterpolator | None]":
    """Return the addresses of the numbers that differ and their interpolant (Fritsch & Butland 1984)."""
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
    """Return every number of a lens that can vary continuously; a radius as its curvature, which may pass through 0."""
    found: dict[Address, float] = {(WHOLE, n, k): f for n in FIELDS for k, f in enumerate(getattr(lens, n))}
    found[WHOLE, lens.aperture.kind, 0] = lens.aperture.value
    if lens.object_distance is not None:
        found[OBJECT_VERGENCE] = 1 / lens.object_distance
    for number, surface in enumerate(lens.surfaces):
        for entry in fields(Surface):
            value = surface.curvature if entry.name == "radius" else getattr(surface, entry.name)
            for place, item in enumerate(value if isinstance(value, tuple) else (value,)):
                if isinstance(item, int | float) and not isinstance(item, bool):
                    found[number, entry.name, place] = item
    return found


def _with_values(surface: Surface, number: int, values: dict[Address, float]) -> Surface:
    """Return a surface with the values that belong to it."""
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
    return replace(surface, **changes) if changes else surface  # type: ignore[arg-type]  # names of fields of Surface


def without_positions(lens: Lens) -> Lens:
    """Return the lens at this position as a lens without positions."""
    return replace(lens, positions=None)


def steps_between(lens: Lens) -> tuple[Message, ...]:
    """Return messages on what is not interpolated between two columns: glasses and other discrete changes."""
    if lens.positions is None or lens.positions.column is not None:
        return ()
    columns = lens.positions.lenses
    near = Message(
        "column {column}",
        column=tuple(axis.columns[axis.nearest(place)] for axis, place in _axes_and_places(lens.positions)),
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
                    "{quantity} differ between columns; they are those of the nearest, {near}",
                    quantity=words,
                    near=near,
                )
            )
    return tuple(found)


STEP = "surface {surface}: {what} differs between columns and is taken from the nearest, {near}"
DISCRETE = {"wavelengths_nm": Message("wavelengths"), "stop_surface": Message("stops")}


def _axes_and_places(positions: Positions) -> list[tuple[Axis, float]]:
    return list(zip(positions.axes, positions.place, strict=True))
