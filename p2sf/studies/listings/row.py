"""One number of a listing beside this program's own."""

import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

FOLDER = Path(__file__).parent
OPTICSTUDIO = "Ansys OpticStudio"
PRINTED = "half a unit of the last printed digit, and {own:.0e} of rounding"


@dataclass(frozen=True)
class ListedNumber:
    """One listed number, this program's own, and what is agreement.

    ``why`` says where ``tolerance`` comes from. Where the two differ by more, ``explained`` says why, and ``within`` is
    the largest difference that this accounts for. Of a whole list, map or picture ``listed`` is 0 and ``ours`` its
    largest difference from this program's own, or 1 − R².
    """

    group: str
    quantity: str
    lens: str
    source: str
    listed: float
    ours: float
    tolerance: float
    why: str
    unit: str = ""
    explained: str = ""
    within: float = 0.0


@lru_cache(maxsize=8)
def numbers_of(name: str) -> dict[str, Any]:
    """Return the numbers of the listings of one system."""
    found: dict[str, Any] = json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))
    return found


@lru_cache(maxsize=4)
def arrays_of(name: str) -> dict[str, np.ndarray]:
    """Return the maps, pictures and curves of the listings of one system."""
    with np.load(FOLDER / f"{name}.npz") as stored:
        return dict(stored)


def r_squared_gap(ours: np.ndarray, listed: np.ndarray) -> float:
    """Return 1 − R² of two pictures of unit sum, without a subtraction from 1."""
    one, other = ours / ours.sum(), listed / listed.sum()
    return float(((one - other) ** 2).sum() / ((other - other.mean()) ** 2).sum())
