"""Parameters in two tiers: those that differ in kind are tested with every commit, the others by `pytest -m slow`."""

from collections.abc import Collection
from typing import Any

import pytest

# A photographic lens, one of a wide field, a fast one, one of aspheres, a folded one with a mask, an eye in water:
# what has gone wrong for any of the shipped lenses went wrong for one of these.
LENSES = ("double_gauss_28", "reverse_telephoto", "petzval", "phone_f28", "cassegrain_f10", "eye_navarro")


def in_tiers(values: Collection[Any], kept: Collection[Any] = LENSES) -> list[Any]:
    """Return the values, or tuples of them, as parameters; all but those kept are slow."""
    assert kept is LENSES or all(value in values for value in kept), "what is kept is among the values"
    given = ((value, value if isinstance(value, tuple) else (value,)) for value in values)
    return [value if value in kept else pytest.param(*parts, marks=pytest.mark.slow) for value, parts in given]
