"""A picture cut at its jumps in depth into slabs, each of which goes on behind the nearer ones.

Of two surfaces with a jump between them the nearer one hides the farther one, and where it is blurred, part of the
pupil looks past it. No depth map can tell what is there: a hidden pixel takes colour and depth of the nearest pixel in
its row or column that is not hidden (as in `layers`). A surface that only slopes lies in one slab, or in two that meet.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from p2sf.image.layers import nearest_open
from p2sf.image.octaves import block_means, enlarge, finest_octave

LEVELS = 512  # of depth, even in 1/depth: of 60 pixels of blur each is an eighth of a pixel
JUMP = 20  # levels from one pixel to the next
MOST_SLABS = 4
FEW = 2e-4  # of the pixels: jumps of fewer are not cut
BESIDE = 2  # coarse pixels that the octaves of an edge reach


@dataclass(frozen=True, eq=False)
class Slab:
    """What lies between two jumps in depth, in the rows and columns of ``box`` of the coarse picture.

    ``planes``, (channels + 1, rows, columns): the colours times the opacity, and this, which is left out of the
    farthest slab, opaque everywhere. ``level``, (rows, columns): of depth, from far. ``octaves``: what the planes lack
    of finer pixels, the finest first, and ``levels`` the depth of each four of their pixels. ``seen``: the rows and
    columns that are not behind nearer slabs.
    """

    box: tuple[slice, slice]
    seen: tuple[slice, slice]
    planes: np.ndarray
    level: np.ndarray
    octaves: list[np.ndarray]
    levels: list[np.ndarray]

    def about_seen(self, more: int) -> "Slab":
        """Return what lies in the rows and columns that are seen, and ``more`` on every side."""
        box = tuple(
            slice(max(own.start, side.start - more), min(own.stop, side.stop + more))
            for own, side in zip(self.box, self.seen, strict=True)
        )

        def part(values: np.ndarray) -> np.ndarray:
            times = values.shape[-1] // (self.box[1].stop - self.box[1].start)
            rows, columns = (
                slice(times * (side.start - own.start), times * (side.stop - own.start))
                for own, side in zip(self.box, box, strict=True)
            )
            return values[..., rows, columns]

        planes, level = part(self.planes), part(self.level)
        return Slab(
            (box[0], box[1]), self.seen, planes, level, *(list(map(part, x)) for x in (self.octaves, self.levels))
        )


def depth_levels(vergences: np.ndarray, far: float, near: float) -> np.ndarray:
    """Return 1/depth as whole numbers from 0, far, to LEVELS − 1, near, in the shape of ``vergences``."""
    scaled = (vergences - far) * ((LEVELS - 1) / (near - far))
    levels: np.ndarray = np.rint(np.clip(scaled, 0, LEVELS - 1)).astype(np.int16)
    return levels


def cuts(levels: np.ndarray) -> list[int]:
    """Return the levels, increasing, from which slabs begin: those between the two sides of most jumps."""
    sides = ((levels[1:], levels[:-1]), (levels[:, 1:], levels[:, :-1]))
    pairs = [np.stack([np.minimum(*pair).ravel(), np.maximum(*pair).ravel()]) for pair in sides]
    low, high = np.concatenate(pairs, axis=1)
    jumps = high - low > JUMP
    found: list[int] = []
    low, high = low[jumps], high[jumps]
    while low.size > FEW * levels.size and len(found) < MOST_SLABS - 1:
        crossed = np.cumsum(np.bincount(low + 1, minlength=LEVELS + 1) - np.bincount(high + 1, minlength=LEVELS + 1))
        best = np.flatnonzero(crossed == crossed.max())
        found.append(int(best[len(best) // 2]))
        left = (low >= found[-1]) | (high < found[-1])
        low, high = low[left], high[left]
    return sorted(found)


class DepthEdge(NamedTuple):
    """An edge of depth: the ``share`` of pixels that lie along it, and the mean levels ``behind`` and ``before`` it."""

    share: float
    behind: float
    before: float


def depth_edges(levels: np.ndarray, starts: list[int]) -> list[DepthEdge]:
    """Return the edges between slabs that begin at these levels, but for the farthest one."""
    found = []
    for start in starts[1:]:
        near = levels >= start
        sides = [
            (near[1:] != near[:-1], levels[1:], levels[:-1]),
            (near[:, 1:] != near[:, :-1], levels[:, 1:], levels[:, :-1]),
        ]
        pairs = np.concatenate([np.stack([one[at], two[at]]) for at, one, two in sides], axis=1)
        found.append(
            DepthEdge(pairs.shape[1] / levels.size, *(float(end.mean()) for end in (pairs.min(0), pairs.max(0))))
        )
    return found


def cut_into_slabs(values: np.ndarray, levels: np.ndarray, halvings: int) -> tuple[list[Slab], list[DepthEdge]]:
    """Return the slabs of a picture from far to near, in pixels that are halved so often, and the edges between them.

    ``values`` (channels, rows, columns) and ``levels`` (rows, columns) have whole numbers of coarse pixels.
    """
    starts = [0, *cuts(levels)]
    ends = zip(starts, [*starts[1:], LEVELS], strict=True)
    return [_slab(values, levels, *pair, halvings) for pair in ends], depth_edges(levels, starts)


def _slab(values: np.ndarray, levels: np.ndarray, start: int, end: int, halvings: int) -> Slab:
    """Return the slab of levels from ``start`` to below ``end``."""
    times, own = 2**halvings, (levels >= start) & (levels < end)
    box, seen = _box_of(levels >= start, times), _box_of(own, times)
    fine = tuple(slice(side.start * times, side.stop * times) for side in box)
    values, levels, own = values[:, *fine], levels[fine], own[fine]
    share = block_means(own, times)
    at = nearest_open(share == 0)
    share = np.maximum(share, np.float32(1e-6))
    colours, depth = ((block_means(part * own, times) / share)[..., *at] for part in (values, levels))
    level = np.rint(depth).astype(np.int16)
    whole = np.where(own, levels, _repeat(level, times))
    for _ in range(halvings):
        colours = enlarge(colours)
    planes = np.where(own, values, colours)
    if start:
        opacity = (levels >= start).astype(np.float32)
        planes = np.concatenate([planes * opacity, opacity[None]])
    octaves, each = [], []
    for number in range(halvings):
        octave, planes = finest_octave(planes)
        step = 2 ** (number + 1)
        octaves.append(octave)
        each.append(whole[step // 2 :: step, step // 2 :: step])
    return Slab(box, seen, np.asarray(planes, np.float32), level, octaves, each)


def octave_powers(slab: Slab, number: int) -> np.ndarray:
    """Return the sum of the squares of an octave of a slab, mean of the colours, by level of depth, (LEVELS,)."""
    octave, level = slab.octaves[number], slab.levels[number]
    square = np.square(octave).mean(0)
    four = square[::2, ::2] + square[1::2, ::2] + square[::2, 1::2] + square[1::2, 1::2]
    return np.bincount(level.ravel(), four.ravel(), LEVELS)


def _box_of(inside: np.ndarray, times: int) -> tuple[slice, slice]:
    """Return the rows and columns of coarse pixels that hold a region, and of some beside it."""
    ends = []
    for axis, count in enumerate(inside.shape):
        at = np.flatnonzero(inside.any(1 - axis)) // times
        ends.append(slice(max(0, int(at[0]) - BESIDE), min(count // times, int(at[-1]) + 1 + BESIDE)))
    return ends[0], ends[1]


def _repeat(level: np.ndarray, times: int) -> np.ndarray:
    return level.repeat(times, 0).repeat(times, 1)
