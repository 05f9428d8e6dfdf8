"""Where a picture has structure: elsewhere it looks the same through any lens, and no kernel is needed.

A kernel without negative values and of unit sum makes of every pixel a weighted mean of those within its reach. So the
blurred pixel lies between the least and the greatest of these, as the pixel itself does, and the two differ by no more
than the range of the picture there, whichever the kernel. Where that range is small enough, a pixel remains as it is.
Relative illumination is smooth: by Taylor's theorem a kernel changes it by its slope times the distance of the kernel's
centroid, and by its bend times the square of the reach.
"""

from math import ceil, inf

import numpy as np

from p2sf.image.region import Region

TINY, MOST_ORDER = 1e-30, 3
BLOCK, SHORTEST = 8, 4  # pixels a side of what has structure or has none; blocks a side that are not halved
FLAT = 1 / 3  # of the tolerance: the range of light, relative to the dimmest within reach, that counts as flat


def structured_parts(values: np.ndarray, given: Region, tile: Region, half: int, allowed: float) -> list[Region]:
    """Return the parts of a tile that have structure: outside them no kernel changes a pixel by more than allowed.

    ``values``: (rows, columns, channels) of the region ``given``, which holds the pixels within ``half`` of the tile.
    ``allowed``: the change, relative to the least light within reach.
    """
    low, high = (_of_blocks(values, end) for end in (np.minimum, np.maximum))
    reach = ceil(half / BLOCK)
    busy = _beyond(low, high, reach, allowed)
    top, left = tile.top - given.top, tile.left - given.left
    first = top // BLOCK, left // BLOCK
    inside = busy[first[0] : ceil((top + tile.shape[0]) / BLOCK), first[1] : ceil((left + tile.shape[1]) / BLOCK)]
    origin = given.top + first[0] * BLOCK, given.left + first[1] * BLOCK
    return [
        Region(*(origin[0] + BLOCK * n for n in rows), *(origin[1] + BLOCK * n for n in columns)).meet(tile)
        for rows, columns in _boxes(inside, 2 * half / BLOCK)
    ]


def change_of_shade(shade: np.ndarray, half: int, off_px: float) -> float:
    """Return the largest relative change of the illumination, (rows, columns), by kernels, from Taylor's theorem.

    The kernels reach ``half`` pixels along rows and columns, and their centroids are ``off_px`` from their middle.
    """
    step = max(1, half // 2)  # finer differences are rounding
    coarse = shade[::step, ::step].astype(float)
    if min(coarse.shape) < MOST_ORDER:
        return inf
    slopes = [np.diff(coarse, axis=axis) / step for axis in (0, 1)]
    bends = [np.diff(slope, axis=axis) / step for slope, axis in ((slopes[0], 0), (slopes[1], 1), (slopes[0], 1))]
    down, right, both = (float(np.abs(bend).max()) for bend in bends)
    slope = float(np.hypot(*(np.abs(slope).max() for slope in slopes)))
    return (slope * off_px + half**2 / 2 * (down + right + 2 * both)) / max(float(shade.min()), TINY)


def centroid_px(kernels: np.ndarray) -> float:
    """Return how far the centroid of any kernel, (channels, size, size), is from its middle, pixels."""
    at = np.arange(kernels.shape[-1]) - kernels.shape[-1] // 2
    return float(np.hypot(kernels.sum(1) @ at, kernels.sum(2) @ at).max())


def _of_blocks(values: np.ndarray, end: np.ufunc) -> np.ndarray:
    """Return the least or greatest value in each block, (rows, columns, channels)."""
    starts = (np.arange(0, n, BLOCK) for n in values.shape[:2])
    rows, columns = starts
    found: np.ndarray = end.reduceat(end.reduceat(values, rows, axis=0), columns, axis=1)
    return found


def _beyond(low: np.ndarray, high: np.ndarray, reach: int, allowed: float) -> np.ndarray:
    """Return in which blocks the range of light within ``reach`` blocks is more than allowed, (rows, columns)."""
    from scipy.ndimage import maximum_filter, minimum_filter

    size = (2 * reach + 1, 2 * reach + 1, 1)
    least, most = minimum_filter(low, size, mode="nearest"), maximum_filter(high, size, mode="nearest")
    found: np.ndarray = (most - least > allowed * np.maximum(least, 0)).any(-1)
    return found


def _boxes(busy: np.ndarray, more: float, top: int = 0, left: int = 0) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return first and last + 1 of rows and columns of boxes that hold all that is true, of little area.

    Each costs the area that it has with ``more`` rows and columns: a box is halved where that makes it less.
    """
    rows, columns = (np.flatnonzero(busy.any(axis)) for axis in (1, 0))
    if not rows.size:
        return []
    box = (top + int(rows[0]), top + int(rows[-1]) + 1), (left + int(columns[0]), left + int(columns[-1]) + 1)
    within = busy[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    axis = int(within.shape[1] > within.shape[0])
    middle = within.shape[axis] // 2
    if within.shape[axis] <= SHORTEST or within.all():
        return [box]
    one, other = np.split(within, [middle], axis)
    start = box[0][0], box[1][0]
    beside = start[0] + middle * (1 - axis), start[1] + middle * axis
    halves = [*_boxes(one, more, *start), *_boxes(other, more, *beside)]
    return halves if sum(_area(each, more) for each in halves) < _area(box, more) else [box]


def _area(box: tuple[tuple[int, int], tuple[int, int]], more: float) -> float:
    (top, bottom), (left, right) = box
    return (bottom - top + more) * (right - left + more)
