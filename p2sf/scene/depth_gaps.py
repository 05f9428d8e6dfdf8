"""Depths that occur in a scene, and the gaps between them, where a plan needs no kernels."""

from math import ceil

import numpy as np

from p2sf.conventions import vergence
from p2sf.errors import RequestError

MOST_GAPS = 31  # of a depth map, the widest in 1/depth
LEAST_GAP = 1 / 192  # of the range: no plan has depth nodes nearer to each other
BINS = 4096  # of the range, in which the ends of a map's gaps are sought
SAME_DEPTH, SAME_VERGENCE = 1e-6, 1e-12  # a relative difference due to float32; 1/mm, beyond which all is infinity
ROUNDING = 1e-9

Gaps = tuple[tuple[float, float], ...]
"""Near and far end of each gap, mm, from near to far."""


def occupied_intervals(near_mm: float, far_mm: float, gaps_mm: Gaps) -> np.ndarray:
    """Return the ends of the ranges in which depths occur, 1/mm, (ranges, 2), increasing."""
    ends = [far_mm, *(end for near, far in reversed(gaps_mm) for end in (far, near)), near_mm]
    return vergence(ends).reshape(-1, 2)


def depth_parts(intervals: np.ndarray, count: int) -> list[np.ndarray]:
    """Return depth nodes, 1/mm, in parts between which there is a gap.

    The steps are at most those of ``count`` nodes over the whole range, and a gap narrower than a step is none. A
    single node is in the middle of all.
    """
    far, near = float(intervals[0, 0]), float(intervals[-1, 1])
    if count == 1:
        return [np.array([(far + near) / 2])]
    step = (near - far) / (count - 1)
    wide = intervals[1:, 0] - intervals[:-1, 1] >= step * (1 - ROUNDING)
    starts, stops = intervals[np.append(True, wide), 0], intervals[np.append(wide, True), 1]
    return [
        np.linspace(start, stop, 1 + ceil((stop - start) / step - ROUNDING)) if step else np.array([start])
        for start, stop in zip(starts.tolist(), stops.tolist(), strict=True)
    ]


def nearest_occupied(intervals: np.ndarray, vergences: np.ndarray) -> np.ndarray:
    """Return the nearest vergences that occur, sorted, each once."""
    inside = np.clip(vergences[:, None], *intervals.T)
    nearest = np.abs(inside - vergences[:, None]).argmin(1)
    return np.unique(np.take_along_axis(inside, nearest[:, None], 1))


def ends_and_gaps(depth_mm: np.ndarray) -> tuple[float, float, Gaps]:
    """Return the nearest and the farthest depth of a map, mm, and its widest gaps in 1/depth.

    Depths that are not positive do not count.
    """
    depths = depth_mm[depth_mm > 0].astype(float)
    near, far = float(depths.min()), float(depths.max())
    if near == far:
        return near, far, ()
    place = vergence(depths)
    low, high = float(vergence(far)), float(vergence(near))
    number = np.minimum((place - low) * (BINS / (high - low)), BINS - 1).astype(np.intp)
    nearest, farthest = np.full(BINS, np.inf), np.zeros(BINS)
    np.minimum.at(nearest, number, depths)
    np.maximum.at(farthest, number, depths)
    filled = np.flatnonzero(farthest)
    ends = np.stack([farthest[filled[1:]], nearest[filled[:-1]]], 1)  # a gap begins behind the nearer bin
    widths = (vergence(ends[:, 0]) - vergence(ends[:, 1])) / (high - low)
    widest = np.sort(widths.argsort()[::-1][:MOST_GAPS])[::-1]
    return near, far, tuple(map(tuple, ends[widest][widths[widest] >= LEAST_GAP].tolist()))


def check_depths(intervals: np.ndarray, depth_mm: np.ndarray) -> None:
    """Raise RequestError for a positive depth that is not in the scene's ranges, see `occupied_intervals`."""
    ends = intervals * (1 + SAME_DEPTH * np.array([-1, 1])) + SAME_VERGENCE * np.array([-1, 1])
    positive = depth_mm[depth_mm > 0]
    missing = positive[np.searchsorted(ends.ravel(), vergence(positive)) % 2 == 0]
    if not missing.size:
        return
    far, near = (float(1 / end) if end else np.inf for end in (intervals[0, 0], intervals[-1, 1]))
    gap = missing[(missing > near * (1 + SAME_DEPTH)) & (missing < far * (1 - SAME_DEPTH))]
    if gap.size:
        raise RequestError(
            "the depth map holds {depth:g} mm, which lies in a gap of the scene; leave {parameter} out, or plan for "
            "the depths of this map",
            depth=float(gap.flat[0]),
            parameter="gaps_mm",
        )
    raise RequestError(
        "the depth map reaches from {low:g} mm to {high:g} mm, and the scene from {near:g} mm to {far:g} mm; give "
        "depths in mm from the first vertex, and the scene a range that holds them",
        low=float(positive.min()),
        high=float(positive.max()),
        near=near,
        far=far,
    )
