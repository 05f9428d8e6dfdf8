"""Progress of long work, and whether it is still wanted."""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from threading import Lock

from p2sf.errors import Cancelled

LEAST_SHARE, LEAST_SECONDS = 0.05, 1.0  # done, before a pace is one


@dataclass(eq=False)
class Progress:
    """Count of steps done among those expected; ``progress`` gets the fraction, ``cancelled`` is asked at each step."""

    progress: Callable[[float], None] | None = None
    cancelled: Callable[[], bool] | None = None
    expected: int = 0
    done: int = 0

    def __post_init__(self) -> None:
        self._lock = Lock()

    def expect(self, steps: int) -> None:
        """Note more work to come."""
        with self._lock:
            self.expected += steps

    def advance(self, steps: int = 1) -> None:
        """Note work done; raise Cancelled where it is no longer wanted."""
        if self.cancelled and self.cancelled():
            raise Cancelled("the picture was cancelled before it was done")
        with self._lock:
            self.done += steps
            part = min(self.done / max(self.expected, 1), 1.0)
        if self.progress:
            self.progress(part)


def seconds_left(share: float, seconds: float) -> int | None:
    """Return how long the rest takes at the pace so far, whole seconds; None as long as too little is done to tell."""
    if share < LEAST_SHARE or seconds < LEAST_SECONDS:
        return None
    return ceil(seconds * (1 - share) / share)
