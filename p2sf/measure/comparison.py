"""Two measurements of the same points beside each other."""

import os
from dataclasses import dataclass

import numpy as np

from p2sf.errors import RequestError
from p2sf.measure.measurement import read_measurement

NEAR_MM = 0.05  # points that lie as near in both are the same


@dataclass(frozen=True)
class ComparedNumber:
    """One number in both, of the frame or as the mean over common points; ``sigmas``: by which it differs."""

    name: str
    first: float
    second: float
    sigmas: float


@dataclass(frozen=True)
class Comparison:
    """Two measurements: how many points they have in common, and their numbers."""

    points: int
    rows: tuple[ComparedNumber, ...]


def compared(first: str | os.PathLike[str], second: str | os.PathLike[str]) -> Comparison:
    """Return two files of `write_measurement` beside each other; numbers of points as RMS-weighted means.

    Raises RequestError for other files, and where they have no number in common.
    """
    (one, named), (two, also) = (read_measurement(path) for path in (first, second))
    pairs = _pairs(one["places_mm"], two["places_mm"])
    rows = []
    if pairs and named.get("names") == also.get("names") and "numbers" in one and "numbers" in two:
        here, there = (np.array(k) for k in zip(*pairs, strict=True))
        for k, name in enumerate(named["names"]):
            a, b = one["numbers"][here, k], two["numbers"][there, k]
            error = np.hypot(one["errors"][here, k], two["errors"][there, k])
            rows.append(ComparedNumber(str(name), float(a.mean()), float(b.mean()), _rms((b - a) / error)))
    both = [name for name in named.get("unknowns", ()) if name in also.get("unknowns", ())]
    for name in both:
        i, j = list(named["unknowns"]).index(name), list(also["unknowns"]).index(name)
        a, b = float(one["whole"][i]), float(two["whole"][j])
        error = float(np.hypot(one["whole_errors"][i], two["whole_errors"][j]))
        rows.append(ComparedNumber(str(name), a, b, abs(b - a) / error))
    if not rows:
        raise RequestError(
            "{first} and {second} have no number in common; measure the same points by the same model",
            first=str(first),
            second=str(second),
        )
    return Comparison(len(pairs), tuple(rows))


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _pairs(one: np.ndarray, two: np.ndarray) -> list[tuple[int, int]]:
    """Return the numbers of points that lie near each other, (in the first, in the second)."""
    if not len(one) or not len(two):
        return []
    away = np.hypot(*(one[:, None] - two[None]).transpose(2, 0, 1))
    return [(k, int(np.argmin(row))) for k, row in enumerate(away) if row.min() < NEAR_MM]
