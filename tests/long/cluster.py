"""What a cluster costs beside local threads, and what its faults cost: `python -m tests.long.cluster`.

A stack of 20 depths × 21 fields × 31 wavelengths, 13 020 PSFs of 64², is written by two threads of this process, by
two workers of one thread each, by the same while one is killed with SIGKILL and started again by its nanny, and while
one is frozen for ten seconds (SIGSTOP, SIGCONT). The four take turns, the medians of their times count, and all must
leave the same bytes. At last the scheduler is killed: that is to be a sentence, and a new cluster goes on with what is
missing.

It takes some ten minutes on two idle cores; `--wavelengths 6 --rounds 1 --frozen-s 2` less. The exit code is 1 where an
aim is missed; times count only on a machine that does nothing else.
"""

import argparse
import os
import shutil
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median

import numpy as np

from p2sf.conventions import slope_from_degrees
from p2sf.database.build import build_database
from p2sf.database.files.stack import open_stack
from p2sf.database.files.stack_work import StackProgress, StackStatus
from p2sf.database.files.stack_write import write_stack
from p2sf.database.render import Sampling
from p2sf.database.space import Space
from p2sf.errors import DatabaseError
from p2sf.lensfile.library import find_lens
from p2sf.spans import depth_nodes
from tests.support.cluster import RunningCluster, running_cluster

SAMPLING = Sampling(64, 1.0)
THREADS = 2
MOST = {"cluster": ("local", 1.15), "killed": ("cluster", 1.3), "frozen": ("cluster", 1.3)}
MIDDLE = 0.4  # of the chunks, when a fault happens

Contents = dict[str, bytes]


def stack_of(wavelengths: int):
    lens = find_lens("double_gauss_28")
    fields = slope_from_degrees(np.linspace(0, 14, 21))
    space = Space(depth_nodes(60_000, count=20), fields, np.linspace(0.42, 0.7, wavelengths))
    return build_database(lens, space), lens


def contents(path: Path) -> Contents:
    return {str(p.relative_to(path)): p.read_bytes() for p in sorted(path.rglob("*")) if p.is_file()}


def once(act: Callable[..., object], *on: object) -> StackProgress:
    """Return a watch that acts once, in the middle of the work."""
    left = [partial(act, *on)]

    def tell(now: StackStatus) -> None:
        if left and now.done >= MIDDLE * now.total:
            left.pop()()

    return StackProgress(tell)


def frozen(pid: int, seconds: float) -> None:
    os.kill(pid, signal.SIGSTOP)
    threading.Timer(seconds, os.kill, (pid, signal.SIGCONT)).start()


def filled(path: Path, database, watch: StackProgress, address: str | None) -> tuple[float, Contents]:
    """Return the seconds of writing a stack, and its files, which are deleted.

    A group that two workers wrote is done with the first; the other may still be writing, hence a path for each stack.
    """
    start = time.perf_counter()
    write_stack(*database, path, SAMPLING, watch, address, THREADS)
    seconds = time.perf_counter() - start
    found = contents(path)
    shutil.rmtree(path, ignore_errors=True)
    return seconds, found


def compared(folder: Path, database, cluster: RunningCluster, options: argparse.Namespace) -> bool:
    """Print the times of all ways to write a stack; return whether bytes and times are as they should be."""

    def victim() -> int:
        return max(cluster.worker_pids())

    ways: dict[str, Callable[[], StackProgress]] = {
        "local": StackProgress,
        "cluster": StackProgress,
        "killed": lambda: once(os.kill, victim(), signal.SIGKILL),
        "frozen": lambda: once(frozen, victim(), options.frozen_s),
    }
    times: dict[str, list[float]] = {name: [] for name in ways}
    same, first = True, None
    for number in range(options.rounds):
        for name, watch in ways.items():
            path, address = folder / f"{name}_{number}.zarr", None if name == "local" else cluster.address
            seconds, found = filled(path, database, watch(), address)
            times[name].append(seconds)
            first = first or found
            same = same and found == first
            print(f"{name:8} {seconds:7.1f} s, {'same' if found == first else 'OTHER'} bytes", flush=True)
            if name == "frozen":
                time.sleep(options.frozen_s)  # thawed by then
    good = [same]
    for name, (other, most) in MOST.items():
        ratio = median(times[name]) / median(times[other])
        good.append(ratio <= most)
        print(f"{name}: {ratio:.2f} × the time of {other}, aim {most} ×{'' if good[-1] else ', MISSED'}")
    return all(good)


def lost(folder: Path, database) -> bool:
    """Kill the scheduler, and let a new cluster go on; return whether that is a sentence and nothing is lost."""
    path = folder / "b.zarr"
    good = []
    with running_cluster(folder) as cluster:
        try:
            write_stack(*database, path, SAMPLING, once(cluster.kill_scheduler), cluster.address)
        except DatabaseError as error:
            print(error)
            good.append("is lost; start it" in str(error))
    stack = open_stack(path)
    done = 1 - len(stack.missing) / len(stack.chunks)
    good.append(0 < done < 1)
    with running_cluster(folder) as cluster:
        write_stack(*database, path, SAMPLING, scheduler=cluster.address)
    good.append(contents(path) == filled(folder / "c.zarr", database, StackProgress(), None)[1])
    print(f"scheduler lost at {done:.0%}, resumed, {'same' if good[-1] else 'OTHER'} bytes")
    return good == [True] * 3


def main(arguments: list[str] | None = None) -> int:
    asked = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    asked.add_argument("--wavelengths", type=int, default=31)
    asked.add_argument("--rounds", type=int, default=3)
    asked.add_argument("--frozen-s", type=float, default=10.0)
    options = asked.parse_args(arguments)
    database, warm = stack_of(options.wavelengths), stack_of(2)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with running_cluster(folder) as cluster:
            for address in (None, cluster.address):  # modules are loaded, and nodes of the pupil computed
                filled(folder / "warm.zarr", warm, StackProgress(), address)
            good = compared(folder, database, cluster, options)
        good = lost(folder, database) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
