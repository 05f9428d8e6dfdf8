"""One way to time for all benchmarks: medians of CPU and wall time after a warm-up, on one thread."""

from collections.abc import Callable
from dataclasses import dataclass
from statistics import median
from time import perf_counter, process_time

import numpy as np

from p2sf.threads import using_threads

ROUNDS = 200


@dataclass(frozen=True)
class Timed:
    """Median CPU and wall milliseconds of a call."""

    cpu_ms: float
    wall_ms: float


@using_threads(1)
def timed(work: Callable[[], object], rounds: int = ROUNDS) -> Timed:
    """Return the medians of ``rounds`` calls after three that do not count."""
    # Once a process has freed megabytes it keeps them, as an app's does; before, every array costs page faults.
    np.ones(1 << 20)
    for _ in range(3):
        work()
    cpu, wall = [], []
    for _ in range(rounds):
        start = process_time(), perf_counter()
        work()
        cpu.append(process_time() - start[0])
        wall.append(perf_counter() - start[1])
    return Timed(1e3 * median(cpu), 1e3 * median(wall))
