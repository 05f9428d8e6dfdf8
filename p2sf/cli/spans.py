"""Axes as a person types them: 500:inf:20, 400:700:31, or a list."""

from math import isfinite, isnan

import numpy as np

from p2sf.errors import RequestError

MOST_NODES = 4096
FORM = "{parameter} is {value}; write LOW:HIGH:COUNT, one number, or numbers with commas"


def span(text: str, name: str) -> tuple[float, float, int] | np.ndarray:
    """Return (low, high, count), or the numbers of a list, ascending; RequestError says what is wrong with ``name``."""
    if ":" in text:
        return _range(text, name)
    values = np.array([_number(part, text, name) for part in text.split(",")])
    if (values[1:] <= values[:-1]).any():
        raise RequestError(
            "{parameter} is {value}, which does not ascend; put the numbers in ascending order",
            parameter=name,
            value=text,
        )
    return values


def even_span(text: str, name: str) -> np.ndarray:
    """Return the nodes of an axis, evenly spaced between its finite ends; RequestError."""
    found = span(text, name)
    if isinstance(found, np.ndarray):
        return found
    if not isfinite(found[1]):
        raise RequestError(
            "{parameter} is {value}, and only a depth may reach to inf; give a finite end", parameter=name, value=text
        )
    return np.linspace(*found)


def _range(text: str, name: str) -> tuple[float, float, int]:
    parts = text.split(":")
    if len(parts) != 3 or not parts[2].strip().isdecimal():
        raise RequestError(FORM, parameter=name, value=text)
    low, high = (_number(part, text, name) for part in parts[:2])
    count = int(parts[2])
    if not (isfinite(low) and low < high):
        raise RequestError(
            "{parameter} is {value}, which does not ascend from a finite number; "
            "write LOW:HIGH:COUNT, one number, or numbers with commas",
            parameter=name,
            value=text,
        )
    if not 2 <= count <= MOST_NODES:
        raise RequestError(
            "{parameter} is {value}, {count} nodes; give from 2 to {most}",
            parameter=name,
            value=text,
            count=count,
            most=MOST_NODES,
        )
    return low, high, count


def _number(part: str, text: str, name: str) -> float:
    try:
        value = float(part)
    except ValueError as error:
        raise RequestError(FORM, parameter=name, value=text) from error
    if isnan(value):
        raise RequestError(FORM, parameter=name, value=text)
    return value
