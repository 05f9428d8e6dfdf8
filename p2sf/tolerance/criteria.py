"""Criteria for builds: the value in the worst field, the contribution of each error to it, and yields."""

from collections.abc import Mapping, Sequence
from math import sqrt
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from p2sf.tolerance.builds import Builds


Criterion = Literal["rms_waves", "strehl", "mtf", "boresight_um"]
CRITERIA: tuple[Criterion, ...] = ("rms_waves", "strehl", "mtf", "boresight_um")
LARGE_IS_GOOD: tuple[Criterion, ...] = ("strehl", "mtf")


def of_worst_field(found: "Builds", criterion: Criterion) -> np.ndarray:
    """Return the criterion of every build in its worst field, (builds,).

    That is the smallest Strehl ratio, or contrast in both directions, else the largest value.
    """
    if criterion == "boresight_um":
        distance: np.ndarray = np.hypot(*np.moveaxis(found.boresight_um, -1, 0)).max(1)
        return distance
    values: np.ndarray = getattr(found, criterion).reshape(len(found.errors), -1)
    worst: np.ndarray = values.min(1) if criterion in LARGE_IS_GOOD else values.max(1)
    return worst


def within_limit(values: np.ndarray, criterion: Criterion, limit: float | np.ndarray) -> np.ndarray:
    """Return whether each value is within a limit."""
    kept: np.ndarray = values >= limit if criterion in LARGE_IS_GOOD else values <= limit
    return kept


def share_of(kept: np.ndarray) -> tuple[float, float]:
    """Return the share of accepted builds and its standard error.

    The latter is √(y(1 − y)/n); for a share of 0 or 1, its value half a build away.
    """
    count, share = kept.size, float(kept.mean())
    inner = min(max(share, 0.5 / count), 1 - 0.5 / count)
    return share, sqrt(inner * (1 - inner) / count)


def share_within(found: "Builds", limits: Mapping[Criterion, float]) -> tuple[float, float]:
    """Return the share of builds within all limits in all fields, and its standard error."""
    kept = np.ones(len(found.errors), bool)
    for criterion, limit in limits.items():
        kept &= within_limit(of_worst_field(found, criterion), criterion, limit)
    return share_of(kept)


def best_first(values: np.ndarray, criterion: Criterion) -> np.ndarray:
    """Return the indices of values from the best to the worst."""
    order: np.ndarray = np.argsort(values if criterion not in LARGE_IS_GOOD else -values, kind="stable")
    return order


def harms(alone: "Builds", criterion: Criterion, compensators: Sequence[int] = ()) -> np.ndarray:
    """Return the degradation of the worst field by each error at its limit, (errors,), the larger of both signs.

    ``alone`` is of `p2sf.tolerance.sensitivities`. A Strehl ratio that falls counts as positive; compensators are 0.
    """
    values = of_worst_field(alone, criterion) * (-1 if criterion in LARGE_IS_GOOD else 1)
    worse: np.ndarray = values[:-1].reshape(-1, 2).max(1) - values[-1]
    worse[list(compensators)] = 0.0
    return worse
