"""Connecting to a dask.distributed scheduler, and what its workers must have."""

import ctypes
import logging
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import lru_cache
from importlib import import_module
from typing import Any

from p2sf.errors import ClusterError, RequestError
from p2sf.version import program_version

ANSWER_S = 10.0  # for the scheduler to answer, and for the first worker to appear
ABSENCE_S = 60.0  # for which all workers may be absent while they are restarted
LOOK_S = 0.25  # between checks for cancellation and of the workers
SCHEDULER = "dask scheduler"
WORKER = "dask worker {address} --nworkers -1 --nthreads 1"
M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3  # malloc.h of glibc
LARGEST_MMAP_THRESHOLD = 4 * 1024 * 1024 * 8  # DEFAULT_MMAP_THRESHOLD_MAX there, at 8 bytes a word


def distributed() -> Any:
    """Return the library; if it is missing, ClusterError states how to install it."""
    try:
        return import_module("distributed")
    except ImportError as error:
        raise ClusterError(
            "a cluster needs {library}, which is not installed; pip install 'p2sf[dask]'",
            library=error.name or "distributed",
        ) from error


@contextmanager
def connect(scheduler: str) -> Iterator[Any]:
    """Connect to a scheduler; ClusterError if none answers."""
    library = distributed()
    try:
        library.comm.resolve_address(scheduler)
        client = library.Client(scheduler, timeout=ANSWER_S, set_as_default=False)
    except (OSError, ValueError) as error:  # ValueError: an address of no known form
        raise ClusterError(
            "no scheduler answers at {address}; start one with {command}, and give the address that it prints",
            address=scheduler,
            command=SCHEDULER,
        ) from error
    logs = [logging.getLogger(f"distributed.{name}") for name in ("batched", "client", "core")]
    levels = [log.level for log in logs]
    try:
        for log in logs:  # pages about a connection that is lost: an error says so in a sentence
            log.setLevel(logging.CRITICAL)
        with client:
            yield client
    finally:
        for log, level in zip(logs, levels, strict=True):
            log.setLevel(level)


def worker_versions(client: Any, scheduler: str) -> dict[str, str | Exception]:
    """Return P2SF's version on each worker by its address, or why it has none; ClusterError without a worker."""
    try:
        client.wait_for_workers(1, timeout=ANSWER_S)
    except TimeoutError as error:
        raise ClusterError(
            "the scheduler at {address} has no workers; start some with {command}",
            address=scheduler,
            command=WORKER.format(address=scheduler),
        ) from error
    # A lambda goes by value: a worker without p2sf could not load a function of this module.
    asked = {
        address: client.submit(lambda: __import__("p2sf").__version__, workers=[address], pure=False)
        for address in client.nthreads()
    }
    found: dict[str, str | Exception] = {}
    deadline = time.monotonic() + ANSWER_S
    for address, future in asked.items():
        with suppress(TimeoutError):  # a worker that does not answer may be frozen: the others suffice
            failure = future.exception(timeout=max(deadline - time.monotonic(), LOOK_S))
            found[address] = failure or future.result()
    return found


def check_versions(found: Mapping[str, str | Exception], wanted: str | None = None) -> None:
    """Raise ClusterError for the first worker that has another version of P2SF than wanted (this one's), or none."""
    wanted = wanted or program_version()
    for address, version in found.items():
        if version != wanted:
            has = f"P2SF {version}" if isinstance(version, str) else "no P2SF"
            raise ClusterError(
                "the worker at {address} has {has}, and {wanted} is needed; install p2sf[dask]=={wanted} there and "
                "start it again",
                address=address,
                has=has,
                wanted=wanted,
            )


@contextmanager
def checked_client(scheduler: Any, method: str = "scatter") -> Iterator[Any]:
    """Connect to a scheduler by its address, whose workers have this version of P2SF; else return the client given.

    Raises RequestError for what is neither: a client has the ``method`` that is needed.
    """
    if not isinstance(scheduler, str):
        if not hasattr(scheduler, method):
            raise RequestError(
                "{parameter} is {value}; give the address of a dask scheduler, or its client",
                parameter="scheduler",
                value=f"{scheduler!r:.60}",
            )
        yield scheduler
        return
    with connect(scheduler) as client:
        check_versions(worker_versions(client, scheduler))
        yield client


class Presence:
    """The workers of a scheduler, which are counted from time to time."""

    def __init__(self, client: Any) -> None:
        self.address = str(client.scheduler.address)
        self.threads = 0
        errors = distributed().client
        self.gone = OSError, errors.ClosedClientError, errors.FutureCancelledError  # raised for a lost scheduler
        self._client, self._looked, self._seen = client, 0.0, time.monotonic()

    def look(self) -> None:
        """Count the workers' threads; ClusterError once the scheduler, or for long all workers, are gone."""
        now = time.monotonic()
        if now - self._looked < LOOK_S:
            return
        try:
            self.threads = sum(self._client.nthreads().values())
        except self.gone as error:
            raise self.loss() from error
        self._looked = time.monotonic()
        if self.threads:
            self._seen = self._looked
        elif now - self._seen > ABSENCE_S:
            raise ClusterError(
                "the scheduler at {address} has lost all workers; start some with {command} and give the same command "
                "again",
                address=self.address,
                command=WORKER.format(address=self.address),
            )

    def loss(self) -> ClusterError:
        """Return the error of a lost scheduler."""
        return ClusterError(
            "the scheduler at {address} is lost; start it and its workers and give the same command again",
            address=self.address,
        )

    def result(self, future: Any) -> Any:
        """Return the result of work that has ended; ClusterError if its scheduler or its workers are gone."""
        if future.status == "error":
            raise self._in_words(future.exception())
        if future.status != "finished":
            raise self.loss()
        try:
            return future.result()
        except self.gone as error:  # between its end and this question
            raise self.loss() from error

    def _in_words(self, error: Exception) -> Exception:
        """Return the error of work, or a sentence where its workers ended."""
        if not isinstance(error, distributed().KilledWorker):
            return error
        return ClusterError(
            "{count} workers ended while they did the same work; look at their logs, give them more memory, and "
            "give the same command again",
            count=error.allowed_failures + 1,
        )


def in_order(client: Any, futures: Sequence[Any], check: Callable[[], None]) -> Iterator[Any]:
    """Yield results in their order; ``check`` is called meanwhile, and the rest is cancelled if it raises."""
    presence = Presence(client)
    try:
        for future in futures:
            while not future.done():
                check()
                presence.look()
                with suppress(*presence.gone):  # an OSError, too, that it is not done yet
                    future.exception(timeout=LOOK_S)
            yield presence.result(future)
    finally:
        with suppress(*presence.gone):
            client.cancel(list(futures))


@lru_cache(maxsize=1)
def keep_freed_memory() -> None:
    """Let malloc keep the memory of freed arrays for the next ones.

    The nanny of a dask worker sets MALLOC_TRIM_THRESHOLD_ to 64 KiB. With it, glibc gives the memory of every array
    back and gets each page of the next one anew and zeroed: 2.5 times the CPU time. These are the limits that glibc
    would come to by its own rule (mallopt(3), M_MMAP_THRESHOLD).
    """
    set_option: Callable[[int, int], int] | None = None
    if sys.platform == "linux":
        set_option = getattr(ctypes.CDLL(None), "mallopt", None)
    if set_option:
        set_option(M_MMAP_THRESHOLD, LARGEST_MMAP_THRESHOLD)
        set_option(M_TRIM_THRESHOLD, 2 * LARGEST_MMAP_THRESHOLD)
