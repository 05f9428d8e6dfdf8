"""What a plot says of a place: the values of its curves, or of its map, there. No Qt in here."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import ceil, floor, hypot, isfinite, log10, nan
from typing import Any, Protocol

import numpy as np

from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import significant

DIGITS = 4
SMALLEST, LARGEST = 1e-3, 1e6  # outside, a number is written with a power of ten
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Value:
    """One value: its name, the number as it is read, and where its mark is in the data, if it has one.

    ``token`` names the colour of the name, or is a colour; ``number`` is the value itself, in the unit of ``text``.
    """

    name: str
    text: str
    token: str = "text"
    mark: tuple[float, float] | None = None
    number: float = nan


def value_of(name: str, number: float, label: str, token: str = "text", **more: Any) -> Value:
    """Return a value of a quantity called as an axis is, "OPD, waves"."""
    return Value(name, with_unit(format_number(number), label), token, number=number, **more)


@dataclass(frozen=True)
class Reading:
    """What stands at a place of the data: ``head`` says which place, ``lines`` are those of the crosshair.

    ``x`` and ``y`` are the place that is read, which may lie beside the one asked for: samples are where they are.
    """

    x: float
    y: float
    head: str
    values: tuple[Value, ...]
    lines: str = "x"

    @property
    def place(self) -> tuple[float, float]:
        """Return the place of the first mark, else the one that is read."""
        marks = (value.mark for value in self.values if value.mark and isfinite(sum(value.mark)))
        return next(marks, (self.x, self.y))


class PlottedPoints(Protocol):
    """A curve: its name, the token of its colour, and its points."""

    name: str
    token: str
    x: np.ndarray
    y: np.ndarray


@dataclass(frozen=True, eq=False)
class Samples:
    """A map: (rows, columns) values, rows +y, over x, y, width and height of the data, and what they are, with unit."""

    values: np.ndarray
    rect: tuple[float, float, float, float]
    quantity: str = ""

    def nearest(self, x: float, y: float) -> tuple[int, int] | None:
        """Return row and column of the sample that covers a place; None outside."""
        left, low, wide, tall = self.rect
        rows, columns = self.values.shape[:2]
        row, column = floor((y - low) / tall * rows), floor((x - left) / wide * columns)
        return (row, column) if 0 <= row < rows and 0 <= column < columns else None

    def centre(self, row: int, column: int) -> tuple[float, float]:
        """Return the middle of a sample."""
        left, low, wide, tall = self.rect
        rows, columns = self.values.shape[:2]
        return left + (column + 0.5) * wide / columns, low + (row + 0.5) * tall / rows


def split_label(label: str) -> tuple[str, str]:
    """Return the name and the unit of an axis called "field, °"; what follows in brackets is neither."""
    name, _, unit = label.partition(" (")[0].rpartition(", ")
    return (name, unit) if name else (unit, "")


def with_unit(number: str, label: str) -> str:
    """Return a number with the unit of a label; what is a sentence stands in brackets."""
    unit = split_label(label)[1]
    if "=" in unit:
        return f"{number} ({unit})"
    return number + ("" if unit == "°" else " ") * bool(unit) + unit


def describe_value(value: float, label: str) -> str:
    """Return a place with the name and the unit of its axis."""
    return f"{split_label(label)[0]} {with_unit(format_number(value), label)}"


def format_number(value: float, digits: int = DIGITS) -> str:
    """Return a number with so many digits, with a power of ten where zeros would hide it; "–" for none."""
    if not isfinite(value):
        return "–"
    if value == 0 or SMALLEST <= abs(value) < LARGEST:
        return significant(value, digits) if value else "0"
    power = floor(log10(abs(value)))
    mantissa = f"{value / 10.0**power:.{digits - 1}f}"
    if mantissa.lstrip("-").startswith("10"):  # 9.9996 is written as 1.000·10
        mantissa, power = f"{value / 10.0 ** (power + 1):.{digits - 1}f}", power + 1
    return f"{mantissa.replace('-', '−')}·10{str(power).translate(RAISED)}"


def worded_both(place: Sequence[float], labels: Sequence[str]) -> str:
    """Return a place with the names of both axes; a unit that they share is written once."""
    first, second = labels
    if split_label(first)[1] == split_label(second)[1]:
        return f"{split_label(first)[0]} {format_number(place[0])}, {describe_value(place[1], second)}"
    return ", ".join(map(describe_value, place, labels))


def certain_digits(value: float, error: float) -> int:
    """Return how many digits of a value stand where it may be wrong by ``error``: one to `DIGITS`.

    The last of them counts for the error or more.
    """
    if not error or not value or not isfinite(error + value):
        return DIGITS
    return min(DIGITS, max(1, floor(log10(abs(value))) - ceil(log10(error) - 1e-9) + 1))


def nearest(at: np.ndarray, values: np.ndarray, place: float) -> int | None:
    """Return the number of the sample nearest to a place, of those that have a value; None without any."""
    apart = np.where(np.isfinite(values), np.abs(at - place), np.inf)
    if not apart.size:
        return None
    found = int(np.nanargmin(apart)) if not np.isnan(apart).all() else 0
    return found if np.isfinite(apart[found]) else None


def between(at: np.ndarray, values: np.ndarray, place: float) -> tuple[float, float]:
    """Return a curve's value between its samples and how far it may be wrong; NaN beyond the ends and in gaps.

    Cubic through the two samples at each side (Lagrange); its distance to the straight line bounds the error.
    """
    order = np.argsort(at, kind="stable")
    at, values = at[order], values[order]
    right = int(np.searchsorted(at, place))
    if right < len(at) and at[right] == place:
        return float(values[right]), 0.0
    if not 0 < right < len(at):
        return float("nan"), 0.0
    line = float(np.interp(place, at[right - 1 : right + 1], values[right - 1 : right + 1]))
    around = slice(max(0, right - 2), right + 2)
    cubic = lagrange(at[around], values[around], place)
    return (cubic, abs(cubic - line)) if isfinite(cubic) else (line, abs(line - float(values[right])))


def lagrange(at: np.ndarray, values: np.ndarray, place: float) -> float:
    """Return the polynomial through a few points (Lagrange) at a place."""
    total = 0.0
    for k, own in enumerate(at):
        others = np.delete(at, k)
        total += float(values[k]) * float(np.prod((place - others) / np.where(own == others, np.nan, own - others)))
    return total


def closest(points: np.ndarray, place: np.ndarray, per_px: Sequence[float]) -> int | None:
    """Return which of (n, 2) points is the nearest to a place, distances in pixels; None without any."""
    apart = (np.asarray(points, float) - place) / np.asarray(per_px)
    far = np.where(np.isfinite(apart).all(axis=-1), np.hypot(apart[..., 0], apart[..., 1]), np.inf)
    return int(far.argmin()) if far.size and np.isfinite(far).any() else None


def map_at(samples: Samples, x: float, y: float, labels: tuple[str, str]) -> Reading | None:
    """Return the sample of a map that covers a place; None outside."""
    found = samples.nearest(x, y)
    if found is None:
        return None
    across, up = (round(v, 12) for v in samples.centre(*found))
    value = float(samples.values[found])
    named = value_of(split_label(samples.quantity)[0], value, samples.quantity)
    return Reading(across, up, worded_both((across, up), labels), (named,), "xy")


def place_at(x: float, y: float, labels: tuple[str, str]) -> Reading:
    """Return a place without any value."""
    return Reading(x, y, worded_both((x, y), labels), (), "xy")


def is_function(at: np.ndarray) -> bool:
    """Return whether places only rise or only fall, gaps left out."""
    steps = np.diff(at[np.isfinite(at)])
    return bool(steps.size) and (bool((steps >= 0).all()) or bool((steps <= 0).all()))


def curves_at(
    curves: Sequence[PlottedPoints],
    labels: tuple[str, str],
    place: float,
    over: str = "bottom",
    snap: bool = True,
    write: Callable[[float], str] | None = None,
    least: float = 0.0,
) -> Reading | None:
    """Return the values of curves over one axis at a place; at the nearest sample if they may ``snap`` to it.

    ``write`` gives the words of a place; no digit is below ``least``. None without such a curve.
    """
    flat = over == "bottom"
    own, other = labels if flat else labels[::-1]
    found = [(c, *((c.x, c.y) if flat else (c.y, c.x))) for c in curves]
    found = [(curve, at, values) for curve, at, values in found if is_function(at)]
    if not found:
        return None
    if snap:
        tried = [float(at[k]) for _, at, values in found if (k := nearest(at, values, place)) is not None]
        place = min(tried, key=lambda at: abs(at - place), default=place)
    values = []
    for curve, at, numbers in found:
        number, error = between(at, numbers, place)
        digits = certain_digits(number, max(error, least))
        text = with_unit(format_number(number, digits) if not abs(number) < least else "0", other)
        mark = ((place, number) if flat else (number, place)) if isfinite(number) else None
        values.append(Value(curve.name or split_label(other)[0], text, curve.token, mark, number))
    head = write(place) if write else describe_value(place, own)
    x, y = (place, nan) if flat else (nan, place)
    return Reading(x, y, head, tuple(values), "x" if flat else "y")


def vertex_at(
    curves: Sequence[PlottedPoints], x: float, y: float, per_px: tuple[float, float], labels: tuple[str, str]
) -> Reading | None:
    """Return the point of curves that is nearest on screen; None without any."""
    tried = []
    for curve in curves:
        points = np.stack([curve.x, curve.y], axis=-1)
        k = closest(points, np.array([x, y]), per_px)
        if k is not None:
            tried.append((hypot(*((points[k] - (x, y)) / per_px)), k, curve))
    if not tried:
        return None
    _, k, curve = min(tried, key=lambda one: one[0])
    return point_reading(float(curve.x[k]), float(curve.y[k]), labels, curve.token, curve.name)


def point_reading(x: float, y: float, labels: tuple[str, str], token: str = "text", name: str = "") -> Reading:
    """Return both coordinates of a point as values, under its name."""
    first, second = (
        value_of(split_label(label)[0], at, label, token) for at, label in zip((x, y), labels, strict=True)
    )
    return Reading(x, y, name, (replace(first, mark=(x, y)), second), "xy")


def pin_rows(readings: Sequence[Reading], labels: tuple[str, str]) -> list[list[str]]:
    """Return pinned markers as rows to copy: number, place, then every value's name and number."""
    rows = [[tr("marker"), *labels, tr("value")]] if readings else []
    for number, reading in enumerate(readings, 1):
        place = ["" if not isfinite(v) else f"{v:.9g}" for v in (reading.x, reading.y)]
        values = [cell for value in reading.values for cell in (value.name, f"{value.number:.9g}")]
        rows.append([str(number), *place, *values])
    return rows
