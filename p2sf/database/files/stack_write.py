"""Filling a PSF stack chunk by chunk, by the threads of this machine or by the workers of a cluster."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from os import PathLike
from pathlib import Path

from p2sf.database.files.npz import database_bytes, same_database
from p2sf.database.files.place import exists, failures, place_of
from p2sf.database.files.stack import TEMPORARY, Chunk, Stack, create, open_stack
from p2sf.database.files.stack_work import StackProgress, StackWork, write_chunk
from p2sf.database.render import Database, Sampling, critical_pixel_um, grid_of
from p2sf.errors import DatabaseError
from p2sf.files.reasons import reason
from p2sf.lens.lens import Lens
from p2sf.threads import for_each

UNWATCHED = StackProgress()
USUAL = Sampling()


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
    asked = sampling.pixels, pitch, grid_of(database, sampling) is not None
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
