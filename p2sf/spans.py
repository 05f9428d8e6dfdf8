"""Axes typed by a user: numbers and ranges LOW:HIGH:COUNT, such as 500:inf:20 or 0,7,10:14:3."""

from collections.abc import Callable
from math import inf, isfinite, isnan

import numpy as np

from p2sf.conventions import vergence
from p2sf.errors import P2SFError, RequestError
from p2sf.messages import Message

MOST_NODES = 4096
SEPARATORS = {",": Message("commas"), ";": Message("semicolons")}
Reader = Callable[[str], float]
Range = tuple[float, float, int]


def depth_nodes(near_mm: float, far_mm: float = inf, count: int = 20) -> np.ndarray:
    """Return depths uniform in 1/depth, nearest first, shape (count,), mm; ``far_mm`` may be inf."""
    with np.errstate(divide="ignore"):
        depths = 1 / np.linspace(vergence(near_mm), vergence(far_mm), count)
    depths[0] = near_mm
    if count > 1:
        depths[-1] = far_mm
    return depths


def numbers(text: str, name: str, separator: str = ",", read: Reader | None = None) -> np.ndarray:
    """Return the numbers of a list in their order; those of a range are evenly spaced between its finite ends.

    ``read`` converts the text of one number, by default `float`. Raises RequestError, naming ``name``, for a text that
    is not a list.
    """
    ranges = _ranges(text, name, separator, read)
    if any(not isfinite(high) and count > 1 for _, high, count in ranges):
        raise RequestError(
            "{parameter} is {value}, but only depths may extend to inf; give a finite end", parameter=name, value=text
        )
    found = [np.linspace(low, high, count) if count > 1 else np.array([low]) for low, high, count in ranges]
    return np.concatenate(found)


def depths(text: str, name: str, separator: str = ",", read: Reader | None = None) -> np.ndarray:
    """Return distances in front of the lens, mm, as `numbers` does; a range is evenly spaced in 1/distance."""
    ranges = _ranges(text, name, separator, read)
    if not all(low > 0 for low, _, _ in ranges):
        raise RequestError(
            "{parameter} is {value}; give positive distances in front of the lens", parameter=name, value=text
        )
    return np.concatenate([depth_nodes(*each) for each in ranges])


def check_ascending(values: np.ndarray, text: str, name: str) -> None:
    """Raise RequestError unless the numbers of a list are strictly ascending."""
    if (values[1:] <= values[:-1]).any():
        raise RequestError(
            "{parameter} is {value}, which does not ascend; put the numbers in ascending order",
            parameter=name,
            value=text,
        )


def _ranges(text: str, name: str, separator: str, read: Reader | None) -> list[Range]:
    """Return the ends and the count of each range; a single number is both ends."""
    form = RequestError(
        "{parameter} is {value}; write LOW:HIGH:COUNT, one number, or numbers with {separators}",
        parameter=name,
        value=text,
        separators=SEPARATORS[separator],
    )

    def number(part: str) -> float:
        try:
            value = float(part) if read is None else read(part)
        except P2SFError as error:
            if separator == ";" and "," in part:
                raise RequestError(
                    "{parameter} is {value}; separate the numbers by semicolons, since a comma may belong to a number",
                    parameter=name,
                    value=text,
                ) from error
            raise
        except ValueError as error:
            raise form from error
        if isnan(value):
            raise form
        return value

    found = []
    for item in filter(str.strip, text.split(separator)):
        low, *others = item.split(":")
        if not others:
            found.append((number(low), number(low), 1))
            continue
        if len(others) != 2 or not others[1].strip().isdecimal():
            raise form
        found.append((number(low), number(others[0]), int(others[1])))
        _check_range(found[-1], text, name)
    if not found:
        raise RequestError("{parameter} has no number; give one or more", parameter=name)
    return found


def _check_range(found: Range, text: str, name: str) -> None:
    """Raise RequestError for a range that does not ascend or has too few or too many numbers."""
    low, high, count = found
    if not (isfinite(low) and low < high):
        raise RequestError(
            "{parameter} is {value}, which does not ascend from a finite number; write LOW:HIGH:COUNT",
            parameter=name,
            value=text,
        )
    if not 2 <= count <= MOST_NODES:
        raise RequestError(
            "{parameter} is {value}, whose COUNT is {count}; give from 2 to {most}",
            parameter=name,
            value=text,
            count=count,
            most=MOST_NODES,
        )
