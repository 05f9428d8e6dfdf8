"""Contours of a wavefront: bands of equal height with lines between them, on finer samples. No Qt in here."""

from functools import lru_cache
from math import ceil

import numpy as np

from p2sf_explorer.state.scales import nice

FINE = 384  # samples across, at least
BANDS = 12  # at most, between the highest and the lowest wave


def interval(peak_to_valley: float) -> float:
    """Return the round step between two lines, in waves; at least a hundredth."""
    return nice(max(peak_to_valley / BANDS, 0.01)) if peak_to_valley > 0 else 0.01


def contours(waves: np.ndarray, step: float) -> np.ndarray:
    """Return the middle of each sample's band, NaN on the lines between bands and where there is no wavefront.

    ``waves``: (n, n), NaN outside the pupil; the result is a whole number of times as fine, at least `FINE` across,
    with straight lines between samples.
    """
    fine = finer(waves)
    band = np.floor(fine / step)
    shown = (band + 0.5) * step
    known = np.isfinite(fine)
    every, later, earlier = slice(None), slice(1, None), slice(None, -1)
    for last, first in (((later, every), (earlier, every)), ((every, later), (every, earlier))):
        line = known[last] & known[first] & (band[last] != band[first])
        shown[last][line] = np.nan
    return shown


def finer(waves: np.ndarray) -> np.ndarray:
    """Return the map on finer samples, NaN where no neighbouring sample is known."""
    times = ceil(FINE / len(waves))
    if times == 1:
        return waves
    matrix = _between(len(waves), times)
    known = np.isfinite(waves)
    weight = matrix @ known @ matrix.T
    found: np.ndarray = matrix @ np.where(known, waves, 0.0) @ matrix.T
    return np.divide(found, weight, out=weight * np.nan, where=weight > 0)


@lru_cache(maxsize=4)
def _between(count: int, times: int) -> np.ndarray:
    """Return the linear interpolation between cell centres, (times·count, count)."""
    place = np.clip((np.arange(times * count) + 0.5) / times - 0.5, 0, count - 1)
    left = np.minimum(place.astype(int), count - 2)
    matrix, rows = np.zeros((times * count, count)), np.arange(times * count)
    matrix[rows, left], matrix[rows, left + 1] = left + 1 - place, place - left
    return matrix
