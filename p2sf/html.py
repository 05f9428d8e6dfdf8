"""HTML tables for notebooks, from which the ``_repr_html_`` of results is built."""

from collections.abc import Iterable, Sequence
from html import escape
from math import isinf
from numbers import Real

import numpy as np


def html_table(title: str, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table as HTML; numbers have six significant digits."""
    head = "".join(f"<th>{escape(name)}</th>" for name in columns)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell(value))}</td>' for value in row)}</tr>" for row in rows)
    return f"<table><caption>{escape(title)}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def cell(value: object) -> str:
    """Return one value as text: a number with six digits, ∞ for an infinite one, and an array by its shape."""
    if value is None:
        return ""
    if isinstance(value, np.ndarray) and value.ndim:
        return f"array of shape {value.shape}"
    if isinstance(value, np.ndarray):
        value = value[()]
    if isinstance(value, bool | int) or not isinstance(value, Real):
        return str(value)
    return ("−∞" if value < 0 else "∞") if isinf(value) else f"{float(value):.6g}"
