"""Filling a PSF stack chunk by chunk, on local threads or on a cluster, scheduled by dask."""

import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.database.render import Database, Sampling, critical_pixel_um, rendered_light, samples_per_pixel
from p2sf.database_files import database_bytes, same_database
from p2sf.database_files.stack import TEMPORARY, Stack, create, needed, open_stack
from p2sf.errors import DatabaseError
from p2sf.lens.lens import Lens

Progress = Callable[[int, int, float], None]


@dataclass(frozen=True)
class StackProgress:
    """``progress(done, total, seconds_left)`` and ``cancelled()``, both called between chunks."""

    progress: Progress = lambda done, total, seconds_left: None
    cancelled: Callable[[], bool] = lambda: False


UNWATCHED = StackProgress()
USUAL = Sampling()


def write_stack(
    database: Database,
    lens: Lens,
    path: str | PathLike[str],
    sampling: Sampling = USUAL,
    watch: StackProgress = UNWATCHED,
    scheduler: str | None = None,
) -> Stack:
    """Render every node of a database into a Zarr v3 stack and return it; chunks already there are kept.

    ``scheduler``: the address of a dask.distributed scheduler whose workers see the same ``path``; None for
    the threads of this machine. Cancelled or killed, the stack keeps all finished chunks, and the same call
    resumes from there. Raises DatabaseError, also when ``path`` holds another stack.
    """
    raw = database_bytes(database, lens)
    pitch = sampling.pixel_um or critical_pixel_um(database)
    if not Path(path).exists():
        with _disk_errors(path):
            create(path, raw, sampling)
    stack = open_stack(path, "r+")
    asked = sampling.pixels, pitch, samples_per_pixel(database, sampling) > 1
    if (stack.psf.shape[-1], stack.pixel_um, stack.integrated) != asked or not same_database(stack.raw, raw):
        raise DatabaseError(
            "{path} holds a stack of another lens, aim, nodes or samples; choose another name or delete it",
            path=str(path),
        )
    with _disk_errors(path):
        for torn in Path(path).rglob(f"*{TEMPORARY}*"):
            torn.unlink()  # left by a writer that was killed
        _fill(stack, watch, scheduler)
    return stack


@contextmanager
def _disk_errors(path: str | PathLike[str]) -> Iterator[None]:
    """Turn an OSError into a DatabaseError; finished chunks stay."""
    try:
        yield
    except OSError as error:
        raise DatabaseError(
            "{path} cannot be written, {reason}; make room and give the same command again, which keeps what is done",
            path=str(path),
            reason=(error.strerror or str(error)).lower(),
        ) from error


def _fill(stack: Stack, watch: StackProgress, scheduler: str | None) -> None:
    dask = needed("dask")
    whole, missing = lazy_stack(stack), stack.missing
    total, start = len(stack.chunks), time.monotonic()
    before = total - len(missing)
    with _workers(scheduler) as count:
        for first in range(0, len(missing), 2 * count):
            if watch.cancelled():
                return
            dask.compute(*_stores(stack, whole, missing[first : first + 2 * count]))
            done = min(first + 2 * count, len(missing))
            left = (time.monotonic() - start) / done * (len(missing) - done)
            watch.progress(before + done, total, left)


def _stores(stack: Stack, whole: Any, chunks: Sequence[tuple[int, int, int]]) -> list[Any]:
    """Return one lazy write per chunk."""
    array = needed("dask.array")
    blocks = [whole.blocks[(*chunk, 0, 0)] for chunk in chunks]
    regions = [(*stack.region(chunk), slice(None), slice(None)) for chunk in chunks]
    return [
        array.store([block], [stack.psf], regions=[region], lock=False, compute=False)
        for block, region in zip(blocks, regions, strict=True)
    ]


def lazy_stack(stack: Stack) -> Any:
    """Return all PSFs of a stack as a dask.array.Array, rendered when and where they are computed."""
    array = needed("dask.array")
    shape, chunks = stack.psf.shape, stack.psf.chunks
    space = stack.stored.database.space
    axes = [
        array.from_array(np.expand_dims(nodes, [k for k in range(5) if k != axis]), chunks=(chunks[axis],) * 5)
        for axis, nodes in enumerate((space.depths_mm, space.field_slopes, space.wavelengths_um))
    ]
    sides = ((shape[3],), (shape[4],))
    return array.map_blocks(
        _render_block,
        *axes,
        database=stack.stored.database,
        pixels=shape[-1],
        pixel_um=stack.pixel_um,
        chunks=(*array.core.normalize_chunks(chunks[:3], shape[:3]), *sides),
        dtype=np.float32,
        meta=np.empty((0,) * 5, np.float32),
    )


def _render_block(
    depth: np.ndarray,
    slope: np.ndarray,
    wavelength: np.ndarray,
    database: Database,
    pixels: int,
    pixel_um: float,
) -> np.ndarray:
    points = (x[..., 0, 0] for x in (depth, slope, wavelength))
    return rendered_light(database, points, Sampling(pixels, pixel_um))


@contextmanager
def _workers(address: str | None) -> Iterator[int]:
    """Run dask on the scheduler at an address, or on local threads of one BLAS thread each; yield how many."""
    if address:
        with needed("distributed").Client(address) as client:
            yield max(1, sum(client.nthreads().values()))
        return
    from threadpoolctl import threadpool_limits

    with needed("dask").config.set(scheduler="threads"), threadpool_limits(1):
        yield os.cpu_count() or 1
