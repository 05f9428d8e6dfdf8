"""Filling a PSF stack chunk by chunk, by the threads of this machine or by the workers of a cluster."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np

from p2sf.database.cost import products
from p2sf.database.files.npz import database_bytes, same_database
from p2sf.database.files.place import exists, failures, place_of
from p2sf.database.files.stack import TEMPORARY, Chunk, Stack, create, open_stack
from p2sf.database.render import Database, Sampling, critical_pixel_um, fine_sampling, light_of, samples_per_pixel
from p2sf.errors import DatabaseError
from p2sf.files.reasons import reason
from p2sf.lens.lens import Lens
from p2sf.threads import for_each


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


UNWATCHED = StackProgress()
USUAL = Sampling()
COSTS_AT_ONCE = 1000  # chunks whose costs are computed together, which takes some mebibytes


def write_stack(
    database: Database,
    lens: Lens,
    path: str | PathLike[str],
    sampling: Sampling = USUAL,
    watch: StackProgress = UNWATCHED,
    scheduler: str | None = None,
    threads: int | None = None,
) -> Stack:
    """Render every node of a database into a Zarr v3 stack and return it; chunks already there are kept.

    ``path``: a folder, or a URL that fsspec knows, such as ``s3://bucket/name.zarr``. ``scheduler``: the address of a
    dask.distributed scheduler whose workers reach the same ``path``, and write to it themselves; None for ``threads``
    of this machine (`threads_or_default`). Cancelled or killed, the stack keeps all finished chunks, and the same call
    resumes from there. Raises DatabaseError, also when ``path`` holds another stack.
    """
    raw = database_bytes(database, lens)
    pitch = sampling.pixel_um or critical_pixel_um(database)
    place = place_of(path)
    with _write_errors(path):
        if not exists(place):
            create(path, raw, sampling)
    stack = open_stack(path, "r+")
    asked = sampling.pixels, pitch, samples_per_pixel(database, sampling) > 1
    if (stack.psf.shape[-1], stack.pixel_um, stack.integrated) != asked or not same_database(stack.raw, raw):
        raise DatabaseError(
            "{path} holds a stack of another lens, aim, nodes or samples; choose another name or delete it",
            path=str(path),
        )
    with _write_errors(path):
        if isinstance(place, Path):
            for torn in place.rglob(f"*{TEMPORARY}*"):
                torn.unlink()  # left by a writer that was killed
        work = StackWork(stack, stack.missing, watch)
        if scheduler:
            from p2sf.database.files.stack_cluster import fill

            fill(work, scheduler)
        else:
            _fill_here(work, threads)
    return stack


@contextmanager
def _write_errors(path: str | PathLike[str]) -> Iterator[None]:
    """Turn errors of a disk or a store into a DatabaseError; finished chunks stay."""
    try:
        yield
    except failures() as error:
        raise DatabaseError(
            "{path} cannot be written, {reason}; make room and give the same command again, which keeps what is done",
            path=str(path),
            reason=reason(error),
        ) from error


class StackWork:
    """The missing chunks of a stack, the most expensive first, so that at the end no worker waits for a long one.

    ``costs``: about how many products each takes that is not done (`database.cost`).
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
    if stack.across > 1:
        sampling = fine_sampling(sampling, stack.pixel_um, stack.across)
    found = np.zeros(len(chunks))
    for some in np.array_split(np.arange(len(chunks)), len(chunks) // COSTS_AT_ONCE + 1):
        points = space.depths_mm[depth[some], None], ends[some]
        coefficients = database.coefficients(*points, space.wavelengths_um[colour[some], None])
        found[some] = products(coefficients, sampling.pixels, stack.pixel_um / stack.across).mean(-1)
    return found * [psf_count(stack, chunk) for chunk in chunks]


class _Stopped(Exception):
    """The caller has cancelled."""


def _fill_here(work: StackWork, threads: int | None) -> None:
    """Fill a stack by threads of this process."""

    def written(chunk: Chunk) -> Chunk:
        write_chunk(work.stack, chunk)
        return chunk

    def count(chunk: Chunk) -> None:
        work.finished(chunk)
        if work.watch.cancelled():
            raise _Stopped

    if not work.watch.cancelled():
        with suppress(_Stopped):
            for_each(written, work.chunks, count, threads)


def write_chunk(stack: Stack, chunk: Chunk) -> None:
    """Render the PSFs of a chunk in this thread and write them atomically."""
    space, region = stack.stored.database.space, stack.region(chunk)
    points = np.ix_(*(nodes[part] for nodes, part in zip(space.nodes, region, strict=True)))
    stack.psf[region] = light_of(stack.stored.database, points, stack.sampling, stack.across, threads=1)
