"""Threads in fresh processes: ``python -m tests.benchmarks.threads [PART OF A CALL'S NAME]``, on an idle machine.

1. Every public call in a process without environment variables against one whose BLAS has one thread: what a script
   loses by knowing nothing of BLAS. At most 1.1.
2. 12 400 PSFs, a picture of one megapixel and a Huygens sum of 128² samples on two threads against one, and whether
   their results are the same to the last bit. At most 0.6 for the PSFs, 0.65 for the others.

The two processes of a comparison answer in turn, so that a load of the machine meets both; the least times count.
"""

import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

ROUNDS = 9
READING_S = 0.05  # at least so long is a call repeated for one reading
VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "P2SF_THREADS")
MOST_BLAS, MOST_PSFS, MOST_OTHERS = 1.1, 0.6, 0.65
Calls = dict[str, Callable[[], object]]


def public_calls() -> Calls:
    """Return every call of the public API that computes, as users make it, and the sums below it."""
    import p2sf
    from p2sf.image.charts import draw_chart
    from p2sf.image.preview import preview

    lens = p2sf.load_lens("double_gauss_28")
    corner, near = p2sf.Source(field_deg=10), p2sf.Source(field_deg=10, depth_mm=3000)
    small = p2sf.Scene(p2sf.Sensor(rows=200, columns=300, pixel_um=60.0), rtol=0.2, f_number=8)
    planned, picture = p2sf.plan(lens, small), draw_chart("landscape", 200, 300)
    axes = [2000, 5000, np.inf], np.linspace(0, 14, 8), np.linspace(450, 650, 5)
    exact, fitted = (p2sf.build_database(lens, *axes, method=method) for method in ("seidel", "fitted"))
    opd = np.add.outer(np.linspace(-1, 1, 128) ** 2, np.linspace(-1, 1, 128) ** 4)
    calls: Calls = {
        "coefficients": lambda: p2sf.Camera(lens).at(near).coefficients(),
        "choose_method": lambda: p2sf.Camera(lens).at(near).choose_method(),
        "zernike": lambda: p2sf.Camera(lens).at(near).zernike(),
        "mtf": lambda: p2sf.Camera(lens).at(near).mtf(),
        "mtf of a spectrum": lambda: p2sf.Camera(lens).at(near).mtf(spectrum="d65"),
        "encircled_energy": lambda: p2sf.Camera(lens).at(near).energy(),
        "line_spread": lambda: p2sf.Camera(lens).at(near).line_spread(),
        "build_database seidel": lambda: p2sf.build_database(lens, *axes),
        "build_database fitted": lambda: p2sf.build_database(lens, *axes, method="fitted"),
        "plan": lambda: p2sf.plan(lens, small),
        "form_image patches": lambda: p2sf.form_image(planned, picture),
        "form_image lowrank": lambda: p2sf.form_image(planned, picture, method="lowrank"),
        "preview": lambda: preview(lens, small, picture),
        "psf_of_opd": lambda: p2sf.psf_of_opd(opd, wavelength_nm=550, na=0.1, pixels=64, pixel_um=1.0),
        "tradeoff": lambda: p2sf.tradeoff(lens, fields_deg=[10], methods=["seidel", "fitted", "huygens"], pixels=32),
        "database.psf seidel": lambda: exact.psf(near),
        "database.psf fitted": lambda: fitted.psf(near),
    }
    for method in ("seidel", "fitted", "traced", "huygens", "gaussian", "auto"):
        for quality in ("settled", "preview"):
            for pixels in (32, 128):
                calls[f"render {method} {quality} {pixels}²"] = lambda m=method, q=quality, n=pixels: p2sf.render(
                    lens, corner, m, pixels=n, quality=q
                )
    return calls | stack_calls(lens)


def stack_calls(lens) -> Calls:
    """Return stacks of PSFs: of a database near focus and of large blur, of coefficients, of a fitted database."""
    import p2sf
    from p2sf.database.build import build_database
    from p2sf.database.render import Sampling, render_source
    from p2sf.database.space import Space
    from p2sf.psf.seidel import seidel_psf

    blurred = Space(np.linspace(800, 1000, 4), np.linspace(0, 0.2, 5), np.array([0.5, 0.6]))
    near_focus = Space(np.linspace(20_000, 60_000, 10), np.linspace(0, 0.2, 10), np.linspace(0.45, 0.65, 5))
    axes = [2000, 5000], [0, 7, 14], [500, 600]
    wide, sharp = build_database(lens, blurred), build_database(lens, near_focus)
    fitted = p2sf.build_database(lens, *axes, method="fitted").database
    six = sharp.coefficients(*near_focus.axes)
    return {
        "stack near focus": lambda: render_source(sharp, near_focus.axes, Sampling(64, 1.0)),
        "stack of blur": lambda: render_source(wide, blurred.axes, Sampling(64, 8.0)),
        "stack fitted": lambda: render_source(fitted, fitted.space.axes, Sampling(64, 2.0)),
        "seidel_psf of arrays": lambda: seidel_psf(six, 64, 1.0),
    }


def shared_calls() -> Calls:
    """Return the calls that two threads share."""
    import p2sf
    from p2sf.conventions import slope_from_degrees
    from p2sf.database.build import build_database
    from p2sf.database.render import Sampling, render_source
    from p2sf.database.space import Space
    from p2sf.image.charts import draw_chart
    from p2sf.spans import depth_nodes

    lens = p2sf.load_lens("double_gauss_28")
    space = Space(depth_nodes(60_000), slope_from_degrees(np.linspace(0, 14, 20)), np.linspace(0.42, 0.7, 31))
    database = build_database(lens, space)
    planned = p2sf.plan(lens, p2sf.Scene(p2sf.Sensor(832, 1248, 36000 / 1248)))
    picture, corner = draw_chart("landscape", 832, 1248), p2sf.Source(field_deg=10)
    return {
        "12 400 PSFs preview": lambda: render_source(database, space.axes, Sampling(64, 1.0, "preview")),
        "12 400 PSFs settled": lambda: render_source(database, space.axes, Sampling(64, 1.0)),
        "1 megapixel patches": lambda: p2sf.form_image(planned, picture),
        "1 megapixel lowrank": lambda: p2sf.form_image(planned, picture, method="lowrank"),
        "huygens 128²": lambda: p2sf.render(lens, corner, "huygens", pixels=128).values,
    }


SETS = {"public": public_calls, "shared": shared_calls}


@dataclass(frozen=True)
class Reading:
    """Wall and CPU milliseconds of a call, and a digest of its result if that is an array."""

    wall_ms: float
    cpu_ms: float
    digest: str


class Process:
    """A fresh interpreter, without the variables that set threads but for those given, that makes calls when asked."""

    def __init__(self, calls: str, **environment: str):
        kept = {name: value for name, value in os.environ.items() if name not in VARIABLES}
        self._process = subprocess.Popen(
            [sys.executable, "-m", "tests.benchmarks.threads", "--answer", calls],
            cwd=Path(__file__).parents[2],
            env=kept | environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.names = self._process.stdout.readline().rstrip("\n").split("\t")

    def read(self, name: str) -> Reading:
        """Return one reading of a call."""
        self._process.stdin.write(name + "\n")
        self._process.stdin.flush()
        wall, cpu, digest = self._process.stdout.readline().rstrip("\n").split("\t")
        return Reading(float(wall), float(cpu), digest)

    def close(self) -> None:
        """End the process."""
        self._process.stdin.close()
        self._process.wait()


def answer(calls: Calls) -> None:
    """Print the names of the calls, then a reading of each one that is named on standard input."""
    print("\t".join(calls), flush=True)
    repeats: dict[str, int] = {}
    for line in sys.stdin:
        name = line.rstrip("\n")
        if name not in repeats:  # the first call fills caches
            calls[name]()
            start = perf_counter()
            calls[name]()
            repeats[name] = int(np.ceil(READING_S / (perf_counter() - start)))
        start = perf_counter(), process_time()
        for _ in range(repeats[name]):
            result = calls[name]()
        wall, cpu = (
            1e3 * (end - begin) / repeats[name]
            for begin, end in zip(start, (perf_counter(), process_time()), strict=True)
        )
        digest = sha256(np.ascontiguousarray(result)).hexdigest() if isinstance(result, np.ndarray) else ""
        print(wall, cpu, digest, sep="\t", flush=True)


def compared(one: Process, other: Process, name: str) -> tuple[Reading, Reading]:
    """Return the least times of a call in two processes, which answer in turn."""
    readings = [(one.read(name), other.read(name)) for _ in range(ROUNDS)]
    least = []
    for side in zip(*readings, strict=True):
        digests = {reading.digest for reading in side}
        assert len(digests) == 1, f"{name} is not the same twice"
        least.append(Reading(min(r.wall_ms for r in side), min(r.cpu_ms for r in side), side[0].digest))
    return least[0], least[1]


def table(one: Process, other: Process, words: str, most: Callable[[str], float]) -> bool:
    """Print the times of all calls whose name has these words, and return whether every ratio is small enough."""
    fine = True
    for name in one.names:
        if words in name:
            left, right = compared(one, other, name)
            ratio, same = left.wall_ms / right.wall_ms, left.digest == right.digest
            good = ratio <= most(name) and same
            fine = fine and good
            print(
                f"{name:34}{left.wall_ms:10.2f}{right.wall_ms:10.2f} ms wall{ratio:7.2f}"
                f"{left.cpu_ms / right.cpu_ms:7.2f} CPU{'' if same else '  DIFFERENT'}{'' if good else '  <--'}",
                flush=True,
            )
    return fine


def main(words: str = "") -> int:
    """Print both comparisons, and return 1 where a ratio is too large or a result differs."""
    fine = True
    for calls, title, left, right, most in (
        ("public", "plain against one BLAS thread", {}, {"OMP_NUM_THREADS": "1"}, lambda name: MOST_BLAS),
        (
            "shared",
            "two threads against one",
            {"P2SF_THREADS": "2"},
            {"P2SF_THREADS": "1"},
            lambda name: MOST_PSFS if "PSFs" in name else MOST_OTHERS,
        ),
    ):
        print(title)
        one, other = Process(calls, **left), Process(calls, **right)
        fine = table(one, other, words, most) and fine
        one.close()
        other.close()
    return 0 if fine else 1


if __name__ == "__main__":
    if sys.argv[1:2] == ["--answer"]:
        answer(SETS[sys.argv[2]]())
    else:
        sys.exit(main(*sys.argv[1:]))
