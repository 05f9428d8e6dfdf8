"""The watch over a sum: its progress, its end where the caller cancels it, and what it may cost."""

from collections.abc import Callable
from math import inf
from typing import Any

from p2sf.errors import Cancelled
from p2sf.pupil.cost import LAST_PASS, RAY_SECONDS

MOST_RAYS = 2**22  # of one sum


class Watch:
    """Reports progress and ends the work if the caller cancels it.

    ``most_seconds``: estimated ones of a sum on one core, which then takes at most ``most`` nodes in its last pass.
    ``allowed``: relative error of the field of spherical waves that may be left.
    """

    def __init__(
        self,
        progress: Callable[[float], None] | None = None,
        cancelled: Callable[[], bool] | None = None,
        most_seconds: float = inf,
        allowed: float = 0.0,
    ) -> None:
        self.progress, self.cancelled = progress, cancelled
        self.limits: dict[str, Any] = {"watch": self.look, "most_seconds": most_seconds, "allowed": allowed}
        self.most = int(min(MOST_RAYS, LAST_PASS * most_seconds / RAY_SECONDS))
        self.finished, self.expected = 0, 0

    def expect(self, nodes: int) -> None:
        """Add work to come."""
        self.expected += nodes

    def advance(self, nodes: int) -> None:
        """Add work done; raise Cancelled if the caller has cancelled it."""
        self.finished += nodes
        self.look()
        if self.progress and self.expected:
            self.progress(min(self.finished / self.expected, 0.99))

    def look(self) -> None:
        """Raise Cancelled if the caller has cancelled the work."""
        if self.cancelled and self.cancelled():
            raise Cancelled("the reference was cancelled before it was done")

    def finish(self) -> None:
        """Report that all work is done."""
        if self.progress:
            self.progress(1.0)
