"""What every state at the defaults takes: ``python -m tests.benchmarks.states [--quick] [--lenses hubble,petzval]``.

A state is a lens, one of its fields, an object at infinity or NEAR_MM away, what is computed of it and how, with and
without clip. Each is computed in a process of its own, on one thread, and takes CPU seconds and a peak of memory, of
which the program itself is some 120 MB. A state that is refused counts as well, since a refusal must come at once;
one that takes longer than ``--timeout`` or more than ``--memory`` is stopped. The last lines list those above
MOST_SECONDS or MOST_MB. ``--quick``: the PSF by "auto" and by "huygens" at full field and infinity.
"""

import argparse
import os
import resource
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import product
from math import inf
from pathlib import Path
from signal import SIGXCPU

from p2sf.api import load_lens, render
from p2sf.camera import Camera
from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.threads import using_threads

LENSES = Path(__file__).parents[2] / "lenses"
NEAR_MM = 2000.0
MOST_SECONDS, MOST_MB = 5.0, 2000.0
Work = Callable[[Lens, Source, bool], object]


def _psf(method: str) -> Work:
    return lambda lens, source, clip: render(lens, source, method, clip=clip)


WORKS: dict[str, Work] = {
    **{f"psf {method}": _psf(method) for method in ("auto", "seidel", "fitted", "traced", "huygens")},
    "mtf": lambda lens, source, clip: Camera(lens).at(source).mtf(clip=clip),
    "energy": lambda lens, source, clip: Camera(lens).at(source).energy(clip=clip),
    "mtf d65": lambda lens, source, clip: Camera(lens).at(source).mtf(clip=clip, spectrum="d65"),
    "energy d65": lambda lens, source, clip: Camera(lens).at(source).energy(clip=clip, spectrum="d65"),
}
QUICK = "psf auto", "psf huygens"


@dataclass(frozen=True)
class State:
    """A lens by name, a source and what is computed of it."""

    lens: str
    field_deg: float
    depth_mm: float
    work: str
    clip: bool

    def __str__(self) -> str:
        depth = "infinity" if self.depth_mm == inf else f"{self.depth_mm:g} mm"
        return f"{self.lens} {self.field_deg:g}° {depth} {self.work}{' clip' if self.clip else ''}"


@dataclass(frozen=True)
class Cost:
    """CPU seconds and the peak of memory, MB, of a state, and how it ended: done, refused, killed, or an error."""

    seconds: float
    peak_mb: float
    end: str

    @property
    def too_much(self) -> bool:
        """Return whether nobody should have to wait for this."""
        return self.seconds > MOST_SECONDS or self.peak_mb > MOST_MB


def states(names: Iterable[str], quick: bool = False) -> Iterator[State]:
    """Yield the states of lenses."""
    for name in names:
        fields = load_lens(name).fields_deg
        for depth, field in product((inf,) if quick else (inf, NEAR_MM), fields[-1:] if quick else fields):
            for work, clip in product(QUICK if quick else WORKS, (False, True)):
                yield State(name, field, depth, work, clip)


def cost_of(state: State, timeout_s: int = 60, memory_gb: float = 8.0) -> Cost:
    """Return what a state takes, computed in a process of its own."""
    read, write = os.pipe()
    child = os.fork()
    if not child:
        os.close(read)
        resource.setrlimit(resource.RLIMIT_AS, (int(memory_gb * 2**30),) * 2)
        resource.setrlimit(resource.RLIMIT_CPU, (timeout_s, timeout_s + 1))
        os.write(write, _ended(state).encode())
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as said:
        end = said.read()
    _, status, used = os.wait4(child, 0)
    if not end:
        end = f"more than {timeout_s} s" if os.WTERMSIG(status) in (SIGXCPU, 9) else "killed"
    unit = 2**20 if sys.platform == "darwin" else 2**10
    return Cost(used.ru_utime + used.ru_stime, used.ru_maxrss / unit, end)


def _ended(state: State) -> str:
    """Compute a state, and return how that ended."""
    try:
        with using_threads(1):
            WORKS[state.work](load_lens(state.lens), Source(state.depth_mm, field_deg=state.field_deg), state.clip)
    except P2SFError as error:
        return f"refused: {error}"
    except MemoryError:
        return "out of memory"
    return "done"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="full field, infinity, two methods")
    parser.add_argument("--lenses", help="names, with commas between them")
    parser.add_argument("--timeout", type=int, default=60, metavar="S", help="CPU seconds after which a state ends")
    parser.add_argument("--memory", type=float, default=8.0, metavar="GB", help="the most a state may take")
    given = parser.parse_args()
    names = given.lenses.split(",") if given.lenses else sorted(path.stem for path in LENSES.glob("*.toml"))
    costly, every = [], list(states(names, given.quick))
    for state in every:
        cost = cost_of(state, given.timeout, given.memory)
        row = f"{state!s:58} {cost.seconds:6.1f} s {cost.peak_mb:6.0f} MB  {cost.end[:70]}"
        print(row, flush=True)
        costly += [row] if cost.too_much else []
    print(f"\n{len(costly)} of {len(every)} states above {MOST_SECONDS:g} s or {MOST_MB:g} MB", *costly, sep="\n")


if __name__ == "__main__":
    main()
