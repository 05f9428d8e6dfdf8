"""What is left to be done of a PSF stack, chunk by chunk, and doing it."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from p2sf.database.files.stack import Chunk, Stack
from p2sf.database.render import fine_sampling, light_of
from p2sf.pupil.cost import separable_products


@dataclass(frozen=True)
class StackStatus:
    """Progress of a stack: finished and total chunks, the PSFs of this run and its rate, the remaining time."""

    done: int
    total: int
    psfs: int
    psfs_per_second: float
    seconds_left: float


@dataclass(frozen=True)
class StackProgress:
    """``progress(now)`` is called after each chunk, ``cancelled()`` before and after: True ends the filling."""

    progress: Callable[[StackStatus], None] = lambda now: None
    cancelled: Callable[[], bool] = lambda: False


COSTS_AT_ONCE = 1000  # chunks whose costs are computed together, which takes some mebibytes


class StackWork:
    """The missing chunks of a stack, the most expensive first, so that at the end no worker waits for a long one.

    ``costs``: about how many products each takes that is not done (`pupil.cost`).
    """

    def __init__(self, stack: Stack, missing: Sequence[Chunk], watch: StackProgress) -> None:
        self.stack, self.watch = stack, watch
        costs = chunk_costs(stack, missing)
        order = np.argsort(-costs, kind="stable").tolist()
        self.chunks = [missing[k] for k in order]
        self.costs = {missing[k]: float(costs[k]) for k in order}
        self._left = float(costs.sum())
        self._before = len(stack.chunks) - len(missing)
        self._start, self._cost, self._psfs, self._done = time.monotonic(), 0.0, 0, 0

    def finished(self, chunk: Chunk) -> None:
        """Count a written chunk and report it to the watch."""
        cost = self.costs.pop(chunk)
        self._cost, self._left = self._cost + cost, self._left - cost
        self._psfs, self._done = self._psfs + psf_count(self.stack, chunk), self._done + 1
        seconds = max(time.monotonic() - self._start, 1e-9)
        left = seconds / self._cost * self._left if self.costs else 0.0
        done, total = self._before + self._done, self._before + self._done + len(self.costs)
        self.watch.progress(StackStatus(done, total, self._psfs, self._psfs / seconds, left))


def psf_count(stack: Stack, chunk: Chunk) -> int:
    """Return the number of PSFs in a chunk."""
    return int(np.prod([part.stop - part.start for part in stack.region(chunk)]))


def chunk_costs(stack: Stack, chunks: Sequence[Chunk]) -> np.ndarray:
    """Return the estimated products of each chunk, from the first and last field at its middle depth and colour."""
    database, space = stack.stored.database, stack.stored.database.space
    regions = [stack.region(chunk) for chunk in chunks]
    middle = [[(part.start + part.stop) // 2 for part in region] for region in regions]
    of_chunks = [space.radial_slopes[region[1:-1]].ravel() for region in regions]
    ends = np.array([[slopes[0], slopes[-1]] for slopes in of_chunks]).reshape(-1, 2)
    depth, *_, colour = np.array(middle, dtype=int).reshape(-1, len(space.nodes)).T
    sampling = stack.sampling
    if stack.grid:
        sampling = fine_sampling(sampling, stack.grid)
    found = np.zeros(len(chunks))
    for some in np.array_split(np.arange(len(chunks)), len(chunks) // COSTS_AT_ONCE + 1):
        points = space.depths_mm[depth[some], None], ends[some]
        coefficients = database.coefficients(*points, space.wavelengths_um[colour[some], None])
        found[some] = separable_products(coefficients, sampling.pixels, sampling.pixel_um or stack.pixel_um).mean(-1)
    return found * [psf_count(stack, chunk) for chunk in chunks]


def write_chunk(stack: Stack, chunk: Chunk) -> None:
    """Render the PSFs of a chunk in this thread and write them atomically."""
    space, region = stack.stored.database.space, stack.region(chunk)
    points = np.ix_(*(nodes[part] for nodes, part in zip(space.nodes, region, strict=True)))
    stack.psf[region] = light_of(stack.stored.database, points, stack.sampling, stack.grid, threads=1)
