"""What builds are judged by: the criterion of the worst field, what each error adds to it, and yields."""

from collections.abc import Mapping, Sequence
from math import sqrt
from typing import Literal

import numpy as np

from p2sf.tolerance.builds import Builds

Criterion = Literal["rms_waves", "strehl", "mtf", "boresight_um"]
CRITERIA: tuple[Criterion, ...] = ("rms_waves", "strehl", "mtf", "boresight_um")
LARGE_IS_GOOD: tuple[Criterion, ...] = ("strehl", "mtf")


def of_worst_field(found: Builds, criterion: Criterion) -> np.ndarray:
    """Return the criterion of every build in its worst field, (builds,).

    That is the least Strehl ratio, or contrast in both directions, else the largest value.
    """
    if criterion == "boresight_um":
        distance: np.ndarray = np.hypot(*np.moveaxis(found.boresight_um, -1, 0)).max(1)
        return distance
    values: np.ndarray = getattr(found, criterion).reshape(len(found.errors), -1)
    worst: np.ndarray = values.min(1) if criterion in LARGE_IS_GOOD else values.max(1)
    return worst


def keeps(values: np.ndarray, criterion: Criterion, limit: float | np.ndarray) -> np.ndarray:
    """Return whether each value keeps a limit."""
    kept: np.ndarray = values >= limit if criterion in LARGE_IS_GOOD else values <= limit
    return kept


def share_of(kept: np.ndarray) -> tuple[float, float]:
    """Return the share of builds that are kept, and its standard error.

    That is √(y(1 − y)/n), for a share of 0 or 1 the one at half a build from there.
    """
    count, share = kept.size, float(kept.mean())
    inner = min(max(share, 0.5 / count), 1 - 0.5 / count)
    return share, sqrt(inner * (1 - inner) / count)


def share_within(found: Builds, limits: Mapping[Criterion, float]) -> tuple[float, float]:
    """Return the share of builds that keep all limits in all fields, and its standard error."""
    kept = np.ones(len(found.errors), bool)
    for criterion, limit in limits.items():
        kept &= keeps(of_worst_field(found, criterion), criterion, limit)
    return share_of(kept)


def best_first(values: np.ndarray, criterion: Criterion) -> np.ndarray:
    """Return the places of values from the best to the worst."""
    order: np.ndarray = np.argsort(values if criterion not in LARGE_IS_GOOD else -values, kind="stable")
    return order


def harms(alone: Builds, criterion: Criterion, compensators: Sequence[int] = ()) -> np.ndarray:
    """Return by how much each error, at its limit, makes the worst field worse, (errors,), of both signs the larger.

    ``alone`` is of `p2sf.tolerance.sensitivities`. A Strehl ratio that falls counts as positive; compensators are 0.
    """
    values = of_worst_field(alone, criterion) * (-1 if criterion in LARGE_IS_GOOD else 1)
    worse: np.ndarray = values[:-1].reshape(-1, 2).max(1) - values[-1]
    worse[list(compensators)] = 0.0
    return worse
