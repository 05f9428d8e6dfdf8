"""Progress and cancellation of long work."""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from threading import Lock

from p2sf.errors import Cancelled

LEAST_SHARE, LEAST_SECONDS = 0.05, 1.0  # done, before a rate is reliable


@dataclass(eq=False)
class Progress:
    """Count of steps done and expected; ``progress`` receives the fraction, ``cancelled`` is polled at each step."""

    progress: Callable[[float], None] | None = None
    cancelled: Callable[[], bool] | None = None
    expected: int = 0
    done: int = 0

    def __post_init__(self) -> None:
        self._lock = Lock()

    def __reduce__(self) -> tuple[type["Progress"], tuple[()]]:
        """Return what another process makes it of: there nobody looks on."""
        return Progress, ()

    def expect(self, steps: int) -> None:
        """Add work to come."""
        with self._lock:
            self.expected += steps

    def check(self) -> None:
        """Raise Cancelled if the caller has cancelled the work."""
        if self.cancelled and self.cancelled():
            raise Cancelled("the picture was cancelled before it was done")

    def advance(self, steps: int = 1) -> None:
        """Add work done; raise Cancelled if the caller has cancelled it."""
        self.check()
        with self._lock:
            self.done += steps
            part = min(self.done / max(self.expected, 1), 1.0)
        if self.progress:
            self.progress(part)


def seconds_left(share: float, seconds: float) -> int | None:
    """Return the remaining whole seconds at the rate so far; None while too little is done for an estimate."""
    if share < LEAST_SHARE or seconds < LEAST_SECONDS:
        return None
    return ceil(seconds * (1 - share) / share)
