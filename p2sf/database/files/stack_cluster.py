"""Filling a PSF stack by the workers of a dask.distributed scheduler.

A worker receives the names of the stack and of some chunks: it opens the stack itself, keeps it for later chunks,
renders, writes, and returns the seconds taken.
"""

import time
from collections import deque
from functools import lru_cache
from hashlib import sha256
from queue import Empty, Queue
from typing import Any

from p2sf.cluster import (
    LOOK_S,
    Presence,
    check_versions,
    checked_client,
    distributed,
    keep_freed_memory,
)
from p2sf.database.files.place import Place
from p2sf.database.files.stack import Chunk, Stack, open_stack
from p2sf.database.files.stack_work import StackWork, write_chunk
from p2sf.errors import ClusterError, DatabaseError
from p2sf.threads import one_blas_thread
from p2sf.version import program_version

AHEAD = 2  # groups of chunks per thread in flight: while one is rendered, the next is ready
GROUP_S = 0.5  # of work, a hundred times what sending a group and its answer takes
SHARE = 4  # fewest remaining groups per thread: groups become smaller towards the end
RETRIES = 2  # attempts to write a group before its error is raised
LATE = 4.0  # times the longest group's seconds, after which one is given to another worker too
Group = tuple[Chunk, ...]


def fill(work: StackWork, scheduler: str) -> None:
    """Fill a stack by the workers of a scheduler; DatabaseError if that cannot continue, finished chunks stay."""
    _check_shared(work.stack.path)
    if work.chunks and not work.watch.cancelled():
        with checked_client(scheduler) as client:
            try:
                _Dispatch(work, client).run()
            except ClusterError as error:
                raise DatabaseError("{error}, which keeps what is done", error=error.message) from error


def _check_shared(place: Place) -> None:
    if isinstance(place, str) and place.startswith("memory://"):
        raise DatabaseError(
            "{path} is the memory of one process, which workers do not share; give a folder or a URL that all reach",
            path=place,
        )


class _Dispatch:
    """Groups of chunks on their way to the workers and back."""

    def __init__(self, work: StackWork, client: Any) -> None:
        self._work, self._client, self._presence = work, client, Presence(client)
        self._waiting = deque(work.chunks)
        self._under_way: dict[Any, Group] = {}
        self._since: dict[Group, float] = {}  # when a group was sent that is not done
        self._twice: set[Group] = set()
        self._answers: Queue[Any] = Queue()
        self._longest = self._seconds = self._cost = 0.0
        place = work.stack.path
        self._place = place if isinstance(place, str) else str(place.absolute())
        self._content = content(work.stack)

    def run(self) -> None:
        """Send groups and take answers until all are done, or cancelled."""
        while (self._waiting or self._since) and not self._work.watch.cancelled():
            self._presence.look()
            while self._waiting and len(self._under_way) < AHEAD * self._presence.threads:
                self._send(self._next_group())
            try:
                self._take(self._answers.get(timeout=LOOK_S))
            except Empty:
                self._send_late_ones()
        self._client.cancel(list(self._under_way))

    def _next_group(self) -> Group:
        """Return chunks of GROUP_S of work, or fewer near the end (Polychronopoulos and Kuck 1987); one at first."""
        most = max(1, len(self._waiting) // (SHARE * self._presence.threads))
        group = [self._waiting.popleft()]
        cost = self._work.costs[group[0]]
        while len(group) < most and 0 < cost * self._seconds < GROUP_S * self._cost:
            group.append(self._waiting.popleft())
            cost += self._work.costs[group[-1]]
        return tuple(group)

    def _send(self, group: Group) -> None:
        future = self._client.submit(
            fill_chunks, self._place, self._content, program_version(), group, retries=RETRIES, pure=False
        )
        self._under_way[future] = group
        self._since.setdefault(group, time.monotonic())
        future.add_done_callback(self._answers.put)

    def _take(self, future: Any) -> None:
        """Count a group that is done, or raise why it is not."""
        group = self._under_way.pop(future, None)
        if group is None or group not in self._since:
            return  # the later answer of two
        seconds = self._presence.result(future)
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


def content(stack: Stack) -> str:
    """Return a name for what a stack holds, which differs for any other database or sampling."""
    about = f"{stack.psf.shape} {stack.psf.chunks} {stack.pixel_um!r} {stack.integrated}"
    return sha256(about.encode() + stack.raw).hexdigest()


def fill_chunks(place: str, named: str, version: str, chunks: Group) -> float:
    """Render and write chunks on a worker, and return the seconds that it took."""
    start = time.monotonic()
    if version != program_version():  # on a worker that came after the others were asked
        check_versions({distributed().get_worker().address: program_version()}, version)
    keep_freed_memory()
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
