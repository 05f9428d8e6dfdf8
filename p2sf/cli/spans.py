"""Axes as a person types them: 500:inf:20, 400:700:31, or a list."""

from math import isfinite, isnan

import numpy as np

from p2sf.errors import RequestError

MOST_NODES = 4096
FORM = "write LOW:HIGH:COUNT, one number, or numbers with commas"


def span(text: str, option: str) -> tuple[float, float, int] | np.ndarray:
    """Return (low, high, count), or the numbers of a list, ascending; RequestError says what is wrong where."""
    if ":" in text:
        return _range(text, option)
    values = np.array([_number(part, text, option) for part in text.split(",")])
    if (values[1:] <= values[:-1]).any():
        raise RequestError(f"{option} is {text}, which does not ascend; put the numbers in ascending order")
    return values


def even_span(text: str, option: str) -> np.ndarray:
    """Return the nodes of an axis, evenly spaced between its finite ends; RequestError."""
    found = span(text, option)
    if isinstance(found, np.ndarray):
        return found
    if not isfinite(found[1]):
        raise RequestError(f"{option} is {text}, and only a depth may reach to inf; give a finite end")
    return np.linspace(*found)


def _range(text: str, option: str) -> tuple[float, float, int]:
    parts = text.split(":")
    if len(parts) != 3 or not parts[2].strip().isdecimal():
        raise RequestError(f"{option} is {text}; {FORM}")
    low, high = (_number(part, text, option) for part in parts[:2])
    count = int(parts[2])
    if not (isfinite(low) and low < high):
        raise RequestError(f"{option} is {text}, which does not ascend from a finite number; {FORM}")
    if not 2 <= count <= MOST_NODES:
        raise RequestError(f"{option} is {text}, {count} nodes; give from 2 to {MOST_NODES}")
    return low, high, count


def _number(part: str, text: str, option: str) -> float:
    try:
        value = float(part)
    except ValueError as error:
        raise RequestError(f"{option} is {text}; {FORM}") from error
    if isnan(value):
        raise RequestError(f"{option} is {text}; {FORM}")
    return value
