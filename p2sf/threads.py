"""Threads for work that can be split into parts, with BLAS limited to one thread meanwhile.

The caller chooses the parts, independently of the number of threads, and results come in the order of the parts, so
that sums of them are identical to the last bit for any number of threads. NumPy releases the interpreter's lock only in
loops over large arrays, products and FFTs: a part should take some milliseconds for threads to pay off.

BLAS distributes a product over its own threads from some 2¹⁸ multiplications on. The products of a PSF are hardly
larger: two threads then wait for each other at the end of each product, and a sum of many products takes several times
as long. Hence all work of this library runs within `one_blas_thread`, and threads work on different parts.
"""

import os
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ContextDecorator, contextmanager
from contextvars import ContextVar, copy_context
from functools import lru_cache
from itertools import chain, islice
from math import inf
from threading import Lock, local
from typing import TYPE_CHECKING, Any, TypeVar

from p2sf.errors import RequestError

if TYPE_CHECKING:
    from concurrent.futures import Future

VARIABLE = "P2SF_THREADS"
AHEAD = 2  # parts per thread: no thread idles while the caller takes a result, and few results are kept

Item = TypeVar("Item")
Result = TypeVar("Result")
_here = local()  # ``worker`` is set in threads of a pool
_asked: ContextVar[int | None] = ContextVar("threads", default=None)


def never() -> bool:
    """Return False: work that nobody cancels."""
    return False


def threads_or_default(threads: int | None = None) -> int:
    """Return the number of threads: the argument, else that of `using_threads`, else the variable P2SF_THREADS.

    Without any of these it is the number of cores available to the process. Raises RequestError unless it is an integer
    of at least 1.
    """
    threads = _asked.get() if threads is None else threads
    if threads is not None:
        if isinstance(threads, bool) or not isinstance(threads, int) or threads < 1:
            raise RequestError(
                "{parameter} is {value}; give a whole number of 1 or more", parameter="threads", value=threads
            )
        return threads
    asked = os.environ.get(VARIABLE, "").strip()
    if not asked:
        return _usable_cores()
    if not asked.isdecimal() or int(asked) < 1:
        raise RequestError(
            "the environment variable {name} is {value}; give a whole number of 1 or more", name=VARIABLE, value=asked
        )
    return int(asked)


@contextmanager
def using_threads(threads: int | None) -> Iterator[None]:
    """Set the number of threads within the context for calls that state none; None changes nothing."""
    if threads is None:
        yield
        return
    before = _asked.set(threads_or_default(threads))
    try:
        yield
    finally:
        _asked.reset(before)


def _usable_cores() -> int:
    if sys.platform == "linux":  # a batch system or container may restrict the process to a part of the machine
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def map_threads(function: Callable[[Item], Result], items: Iterable[Item], threads: int | None = None) -> list[Result]:
    """Return ``function(item)`` of every item, in order, computed by ``threads`` threads (`threads_or_default`).

    Raises what ``function`` raises for the first item that fails, after the running items have ended.
    """
    results: list[Result] = []
    for_each(function, items, results.append, threads, ahead=None)
    return results


def for_each(
    function: Callable[[Item], Result],
    items: Iterable[Item],
    take: Callable[[Result], object],
    threads: int | None = None,
    ahead: int | None = AHEAD,
) -> None:
    """Call ``take(function(item))`` for every item in order: ``function`` in threads, ``take`` in the caller's own.

    At most ``ahead`` results per thread, if given, are being computed or wait for ``take``; an error in ``take`` ends
    the work. ``function`` runs in the context of the caller, such as `numpy.errstate`. Nested calls from within
    ``function`` run in its own thread, so that pools do not multiply.
    """
    remaining = iter(items)
    first = list(islice(remaining, 2))
    several = len(first) > 1 and not getattr(_here, "worker", False)
    count = threads_or_default(threads) if several or threads is not None else 1
    with one_blas_thread:
        if several and count > 1:
            _by_pool(function, chain(first, remaining), take, count, inf if ahead is None else ahead * count)
            return
        for item in chain(first, remaining):
            take(function(item))


def _by_pool(
    function: Callable[[Item], Result],
    items: Iterable[Item],
    take: Callable[[Result], object],
    count: int,
    most: float,
) -> None:
    """Do the work of `for_each` in ``count`` threads, with at most ``most`` results running or waiting."""
    from concurrent.futures import ThreadPoolExecutor

    waiting: deque[Future[Result]] = deque()
    with ThreadPoolExecutor(count, initializer=_become_worker) as pool:
        try:
            for item in items:
                waiting.append(pool.submit(copy_context().run, function, item))
                if len(waiting) >= most:
                    take(waiting.popleft().result())
            while waiting:
                take(waiting.popleft().result())
        finally:
            for future in waiting:  # after an error
                future.cancel()


def _become_worker() -> None:
    """Mark the thread as one of a pool; it stays within `one_blas_thread` until it ends."""
    _here.worker = True
    _of_this_thread().enter(_blas("scipy.linalg" in sys.modules)[1])


class _OneBlasThread(ContextDecorator):
    """Limits BLAS to one thread while any context is active; the last exit restores the previous number.

    Most BLAS libraries have one number for the whole process: active contexts share it, and a counter tells the last
    exit. Libraries built on OpenMP have a number for each thread. The first entry costs some microseconds, later ones
    one.
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._process = _Held()

    def __enter__(self) -> None:
        shared, own = _blas("scipy.linalg" in sys.modules)
        with self._lock:
            self._process.enter(shared)
        _of_this_thread().enter(own)

    def __exit__(self, *error: object) -> None:
        _of_this_thread().leave()
        with self._lock:
            self._process.leave()


class _Held:
    """Number of active contexts, and the libraries limited to one thread with their previous numbers."""

    def __init__(self) -> None:
        self.within = 0
        self.seen: list[Any] | None = None
        self.before: list[tuple[Any, int]] = []

    def enter(self, libraries: list[Any]) -> None:
        """Set the number of each library to 1, unless an active context has done so already."""
        self.within += 1
        if libraries is not self.seen:
            self.seen = libraries
            for library in libraries:
                number = library.get_num_threads()
                if number != 1:
                    self.before.append((library, number))
                    _set(library, 1)

    def leave(self) -> None:
        """Restore the previous numbers if this is the last active context."""
        self.within -= 1
        if self.within == 0:
            for library, number in self.before:
                _set(library, number)
            self.before, self.seen = [], None


def _of_this_thread() -> _Held:
    if not hasattr(_here, "held"):
        _here.held = _Held()
    held: _Held = _here.held
    return held


def _set(library: Any, number: int) -> None:
    library.set_num_threads(number)
    if hasattr(library, "clear_controlling_thread"):
        library.clear_controlling_thread()  # otherwise threadpoolctl 3.8 ignores all other threads from now on


@lru_cache(maxsize=2)
def _blas(with_scipy: bool) -> tuple[list[Any], list[Any]]:
    """Return the BLAS libraries with one number for all threads, and those with one number per thread.

    They are those of NumPy and, once ``scipy.linalg`` is loaded, of SciPy.
    """
    from threadpoolctl import ThreadpoolController

    found = ThreadpoolController().select(user_api="blas").lib_controllers
    own = [library for library in found if getattr(library, "threading_layer", "") == "openmp"]
    return [library for library in found if library not in own], own


one_blas_thread = _OneBlasThread()
