"""Filling a PSF stack by the workers of a dask.distributed scheduler.

A worker receives the names of the stack and of some chunks: it opens the stack itself, keeps it for later chunks,
renders, writes, and returns the seconds taken.
"""

import ctypes
import logging
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import lru_cache
from hashlib import sha256
from queue import Empty, Queue
from typing import Any

from p2sf import __version__
from p2sf.database.files.place import Place
from p2sf.database.files.stack import Chunk, Stack, import_optional, open_stack
from p2sf.database.files.stack_write import StackWork, write_chunk
from p2sf.errors import DatabaseError
from p2sf.threads import one_blas_thread

AHEAD = 2  # groups of chunks per thread in flight: while one is rendered, the next is ready
GROUP_S = 0.5  # of work, a hundred times what sending a group and its answer takes
SHARE = 4  # fewest remaining groups per thread: groups become smaller towards the end
RETRIES = 2  # attempts to write a group before its error is raised
LATE = 4.0  # times the longest group's seconds, after which one is given to another worker too
ANSWER_S = 10.0  # for the scheduler to answer, and for the first worker to appear
ABSENCE_S = 60.0  # for which all workers may be absent while they are restarted
LOOK_S = 0.25  # between checks for cancellation and of the workers
SCHEDULER = "dask scheduler"
WORKER = "dask worker {address} --nworkers -1 --nthreads 1"
Group = tuple[Chunk, ...]
M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3  # malloc.h of glibc
LARGEST_MMAP_THRESHOLD = 4 * 1024 * 1024 * 8  # DEFAULT_MMAP_THRESHOLD_MAX there, at 8 bytes a word


def fill(work: StackWork, scheduler: str) -> None:
    """Fill a stack by the workers of a scheduler; DatabaseError if that cannot continue, finished chunks stay."""
    _check_shared(work.stack.path)
    if work.chunks and not work.watch.cancelled():
        with connect(scheduler) as client:
            check_versions(worker_versions(client, scheduler))
            _Dispatch(work, client, scheduler).run()


@contextmanager
def connect(scheduler: str) -> Iterator[Any]:
    """Connect to a scheduler; DatabaseError if none answers."""
    distributed = import_optional("distributed")
    try:
        distributed.comm.resolve_address(scheduler)
        client = distributed.Client(scheduler, timeout=ANSWER_S, set_as_default=False)
    except (OSError, ValueError) as error:  # ValueError: an address of no known form
        raise DatabaseError(
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
    """Return P2SF's version on each worker by its address, or why it has none; DatabaseError without a worker."""
    try:
        client.wait_for_workers(1, timeout=ANSWER_S)
    except TimeoutError as error:
        raise DatabaseError(
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


def check_versions(found: Mapping[str, str | Exception], wanted: str = __version__) -> None:
    """Raise DatabaseError for the first worker that has another version of P2SF than the one wanted, or none."""
    for address, version in found.items():
        if version != wanted:
            has = f"P2SF {version}" if isinstance(version, str) else "no P2SF"
            raise DatabaseError(
                "the worker at {address} has {has}, and {wanted} is needed; install p2sf[dask]=={wanted} there and "
                "start it again",
                address=address,
                has=has,
                wanted=wanted,
            )


def _check_shared(place: Place) -> None:
    if isinstance(place, str) and place.startswith("memory://"):
        raise DatabaseError(
            "{path} is the memory of one process, which workers do not share; give a folder or a URL that all reach",
            path=place,
        )


class _Dispatch:
    """Groups of chunks on their way to the workers and back."""

    def __init__(self, work: StackWork, client: Any, scheduler: str) -> None:
        self._work, self._client, self._scheduler = work, client, scheduler
        self._waiting = deque(work.chunks)
        self._under_way: dict[Any, Group] = {}
        self._since: dict[Group, float] = {}  # when a group was sent that is not done
        self._twice: set[Group] = set()
        self._answers: Queue[Any] = Queue()
        self._longest = self._seconds = self._cost = 0.0
        self._threads, self._looked, self._seen = 0, 0.0, time.monotonic()
        place = work.stack.path
        self._place = place if isinstance(place, str) else str(place.absolute())
        self._content = content(work.stack)
        errors = import_optional("distributed").client
        self._gone = OSError, errors.ClosedClientError, errors.FutureCancelledError  # raised for a lost scheduler

    def run(self) -> None:
        """Send groups and take answers until all are done, or cancelled."""
        while (self._waiting or self._since) and not self._work.watch.cancelled():
            self._look()
            while self._waiting and len(self._under_way) < AHEAD * self._threads:
                self._send(self._next_group())
            try:
                self._take(self._answers.get(timeout=LOOK_S))
            except Empty:
                self._send_late_ones()
        self._client.cancel(list(self._under_way))

    def _next_group(self) -> Group:
        """Return chunks of GROUP_S of work, or fewer near the end (Polychronopoulos and Kuck 1987); one at first."""
        most = max(1, len(self._waiting) // (SHARE * self._threads))
        group = [self._waiting.popleft()]
        cost = self._work.costs[group[0]]
        while len(group) < most and 0 < cost * self._seconds < GROUP_S * self._cost:
            group.append(self._waiting.popleft())
            cost += self._work.costs[group[-1]]
        return tuple(group)

    def _look(self) -> None:
        """Count the workers' threads from time to time; DatabaseError once the scheduler or all workers are gone."""
        now = time.monotonic()
        if now - self._looked < LOOK_S:
            return
        try:
            self._threads = sum(self._client.nthreads().values())
        except self._gone as error:
            raise self._loss_error() from error
        self._looked = time.monotonic()
        if self._threads:
            self._seen = self._looked
        elif now - self._seen > ABSENCE_S:
            raise DatabaseError(
                "the scheduler at {address} has lost all workers; start some with {command} and give the same command "
                "again, which keeps what is done",
                address=self._scheduler,
                command=WORKER.format(address=self._scheduler),
            )

    def _send(self, group: Group) -> None:
        future = self._client.submit(
            fill_chunks, self._place, self._content, __version__, group, retries=RETRIES, pure=False
        )
        self._under_way[future] = group
        self._since.setdefault(group, time.monotonic())
        future.add_done_callback(self._answers.put)

    def _take(self, future: Any) -> None:
        """Count a group that is done, or raise why it is not."""
        group = self._under_way.pop(future, None)
        if group is None or group not in self._since:
            return  # the later answer of two
        if future.status == "error":
            raise self._put_into_words(future.exception())
        if future.status != "finished":
            raise self._loss_error()
        try:
            seconds = future.result()
        except self._gone as error:  # between its end and this question
            raise self._loss_error() from error
        self._longest, self._seconds = max(self._longest, seconds), self._seconds + seconds
        self._cost += sum(self._work.costs[chunk] for chunk in group)
        del self._since[group]
        for chunk in group:
            self._work.finished(chunk)

    def _send_late_ones(self) -> None:
        """Give groups to other workers too that are late, once there is nothing else to do: the first answer counts.

        Their worker may be frozen, or its machine busy with something else (Dean and Ghemawat 2004, §3.6). Both write
        the same bytes.
        """
        late = time.monotonic() - max(LATE * self._longest, 1.0)
        if not self._waiting:
            for group in [group for group, sent in self._since.items() if sent < late and group not in self._twice]:
                self._twice.add(group)
                self._send(group)

    def _put_into_words(self, error: Exception) -> Exception:
        if isinstance(error, import_optional("distributed").KilledWorker):
            return DatabaseError(
                "{count} workers ended while they rendered the same chunks; look at their logs, give them more memory, "
                "and give the same command again, which keeps what is done",
                count=error.allowed_failures + 1,
            )
        return error

    def _loss_error(self) -> DatabaseError:
        return DatabaseError(
            "the scheduler at {address} is lost; start it and its workers and give the same command again, which keeps "
            "what is done",
            address=self._scheduler,
        )


def content(stack: Stack) -> str:
    """Return a name for what a stack holds, which differs for any other database or sampling."""
    about = f"{stack.psf.shape} {stack.psf.chunks} {stack.pixel_um!r} {stack.integrated}"
    return sha256(about.encode() + stack.raw).hexdigest()


def fill_chunks(place: str, named: str, version: str, chunks: Group) -> float:
    """Render and write chunks on a worker, and return the seconds that it took."""
    start = time.monotonic()
    if version != __version__:  # on a worker that came after the others were asked
        check_versions({import_optional("distributed").get_worker().address: __version__}, version)
    _keep_freed_memory()
    with one_blas_thread:
        for chunk in chunks:
            write_chunk(_open(place, named), chunk)
    return time.monotonic() - start


@lru_cache(maxsize=4)
def _open(place: str, named: str) -> Stack:
    """Return the stack that this worker is to fill, kept from chunk to chunk."""
    stack = open_stack(place, "r+")
    if content(stack) != named:
        raise DatabaseError(
            "{path} is another stack where a worker runs; give a folder that all machines share, or a URL", path=place
        )
    return stack


@lru_cache(maxsize=1)
def _keep_freed_memory() -> None:
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
