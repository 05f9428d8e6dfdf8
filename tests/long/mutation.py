"""Do the tests notice when the code is wrong? Single breaks, each tried in a copy of the project.

``python -m tests.long.mutation --breaks 200 --seed 1 --keep FILE`` draws breaks (`breaks.py`) over the whole core and
the numbers of the window, as many of each rule, and runs the tests of the first tier that stand for the broken file:
those that import it or have its name, then those of its folder and of `BESIDE`, up to the first that fails. Breaks are
drawn at random and tried in the order drawn, so that the first fifty are a fair sample of all. FILE keeps the outcomes:
a run goes on where it ended; ``--again`` tries again what no test noticed. ``--only p2sf/psf`` draws in one folder.

Of 200 drawn with seed 1 at 3c68adf8, 17 are equivalent; of the other 183 tests noticed 140, with 60 to 20 seconds each
on full cores, and 173 (94.5 %) with tests written for those that none noticed. What was left is a limit of cost, more
nodes or room than a sum needs, the room of controls and of a heading, and guards of rare cases; one break never ends,
which is out of time.

Survivors are listed with what they change. Those of `EQUIVALENT` change nothing that anybody sees; they are not tried.
"""

import argparse
import ast
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from functools import lru_cache
from itertools import islice, zip_longest
from pathlib import Path

from tests.long.breaks import RULES, Break, places

ROOT = Path(__file__).parents[2]
WINDOW = ("charts", "compare", "compute", "panels", "playback", "report", "scene3d", "state", "widgets")
SUBJECTS = ("p2sf", *(f"app/p2sf_explorer/{name}" for name in WINDOW))
BESIDE = {  # where else a folder's numbers are read, by the beginning of its path
    "app/p2sf_explorer/compute": ("tests/explorer/panels", "tests/explorer/test_every_road.py"),
    "app/p2sf_explorer/charts": ("tests/explorer/panels",),
    "app/p2sf_explorer/widgets": ("tests/explorer/panels", "tests/explorer/window"),
    "app/p2sf_explorer/state": ("tests/explorer/window",),
    "p2sf/studies": ("tests/cli",),
    "p2sf/figures": ("tests/io",),
    "p2sf/colour": ("tests/io", "tests/image"),
    "p2sf/lens": ("tests/lensfile", "tests/raytrace"),
}
NOT_RUN = ("tests/test_package.py", "tests/explorer/i18n", "tests/explorer/handbook")  # read sources, not numbers
SECONDS = 60.0  # of the processor, for the tests of one break
BYTES = 8 << 30  # of memory, for a break that asks for too much
EQUIVALENT: dict[tuple[str, str], str] = {
    (
        "p2sf/measure/fitting/point_problem.py",
        'xi, eta = np.meshgrid(line, line, indexing="ij")',
    ): "the steepest slope over a square grid is that over the grid transposed",
    (
        "p2sf/disc/domain.py",
        "rho, held = np.sqrt((1 + square) / 2), (HELD_OUT_AROUND_DEG)",
    ): "rays held out to judge a fit may have any directions",
    (
        "p2sf/disc/mask_nodes.py",
        "return ceil((2 * ((radial - 4) * width))) + 4 if radial > 4 else radial",
    ): "more nodes than the sum needs",
    (
        "p2sf/measure/fitting/point_model.py",
        "return 1 if self.fill == 0 else max(3, ceil(4 * self.finest.cycles * self.pixel_um * self.fill) + 2)",
    ): "one sample of a pixel more than its sum needs",
    (
        "p2sf/paraxial/depth_of_field.py",
        "if not isfinite(focus):",
    ): "the marginal ray of a lens that has a focus slopes there",
    (
        "p2sf/psf/pixel_integrals.py",
        "costly = (isinstance(known, Later) and known.costly) or (known is None)",
    ): "of a window too wide for waves the estimate is the share of rays as well",
    (
        "p2sf/image/charts.py",
        "noise = np.fft.irfft2((2 * (np.fft.rfft2(random.standard_normal(shape)) * weight)), s=shape)",
    ): "the noise is divided by its own standard deviation",
    (
        "p2sf/psf/opd_pupil.py",
        "spectrum = fft.fft(lines, fft.next_fast_len(2 * size + 2))",
    ): "more zeros than the transform needs",
    (
        "p2sf/image/form.py",
        "found = Region(top, source.top + int(rows[-1]) + 1, left, source.left + int(columns[-1]) + 2)",
    ): "one column more, in which the layer has the light of the picture",
    (
        "p2sf/figures/window.py",
        "fine, coarse = _split(values.astype(float), psf.x_um - x, psf.y_um - y, psf.pixel_um)",
    ): "both parts are joined, in either order",
    (
        "p2sf/image/pupil_moments.py",
        "self.cut = bool(self.values[2:].any())",
    ): "no edge cuts a pupil so that its first moment alone is not zero",
    (
        "p2sf/lens/shapes.py",
        "for m in range(2, count + 2):",
    ): "one step more, which is cut off",
    (
        "app/p2sf_explorer/compute/views/field.py",
        "line, along = np.linspace(-1, 1, GRID) / np.sqrt(2), np.linspace(-1, 1, 2 * GRID + 2) / np.sqrt(2)",
    ): "one place more along a side of a map",
    (
        "app/p2sf_explorer/compute/views/tolerances.py",
        "air = (2 * (0.02 * (high - low))) or max(abs(low), 1e-6)",
    ): "the air beyond the ends of an axis",
    (
        "app/p2sf_explorer/charts/axes.py",
        "if not area.left() - 2 <= x <= area.right() + 1:",
    ): "a tick may stand a pixel beyond its axis",
    (
        "p2sf/pupil/spherical_waves.py",
        "columns, rows = (np.unique(np.linspace(0, axis.size - 2, PROBED_SIDE).round().astype(int)) "
        "for axis in (x, y))",
    ): "the places that are probed may be any",
    (
        "p2sf/raytrace/field_geometry.py",
        "rays.append(_chief(flat, source_at(source.depth_mm, slope_x + x, slope_y - y, source.wavelength_um)))",
    ): "neighbours on both sides are summed",
}
"""Of a file and a broken line, why nobody can tell it from the right one."""


def drawn(seed: int, only: str = "", root: Path = ROOT) -> Iterator[Break]:
    """Yield breaks at random, of every rule in turn."""
    found: dict[str, list[Break]] = {rule.__name__: [] for rule in RULES}
    for path in sorted(path for subject in SUBJECTS for path in (root / subject).rglob("*.py")):
        file = path.relative_to(root).as_posix()
        for one in places(file, path.read_bytes()) if file.startswith(only) else ():
            found[one.rule].append(one)
    for row in zip_longest(*(sorted(of_rule, key=lambda one: one.rank(seed)) for of_rule in found.values())):
        yield from (one for one in row if one and one.compiles((root / one.file).read_bytes()))


@lru_cache
def imported(root: Path) -> dict[str, frozenset[str]]:
    """Return the modules, and names in them, that every file of tests imports."""
    found = {}
    for path in sorted((root / "tests").rglob("test_*.py")):
        names = set()
        for node in ast.walk(ast.parse(path.read_bytes())):
            if isinstance(node, ast.ImportFrom) and node.module:
                names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
            elif isinstance(node, ast.Import):
                names |= {alias.name for alias in node.names}
        file = path.relative_to(root).as_posix()
        if not file.startswith((*NOT_RUN, "tests/benchmarks")):
            found[file] = frozenset(names)
    return found


def folder_of(file: str, root: Path) -> str:
    """Return the folder of tests for a file of code: that of the same name, or the next above it."""
    own = Path("tests") / Path(file.replace("app/p2sf_explorer", "explorer").removeprefix("p2sf/")).parent
    return next(folder.as_posix() for folder in (own, *own.parents) if (root / folder).is_dir())


def tests_of(file: str, function: str = "", root: Path = ROOT) -> list[str]:
    """Return the files of tests for a file of code, the closest first, of these those that name a function in it."""
    module = file.removeprefix("app/").removesuffix(".py").removesuffix("/__init__").replace("/", ".")
    folder = folder_of(file, root)
    beside = tuple(place for start, known in BESIDE.items() if file.startswith(f"{start}/") for place in known)

    def distance(test: str) -> int:
        in_folder = test.startswith("tests/test_" if folder == "tests" else f"{folder}/")
        if test.endswith(f"/test_{Path(file).stem}.py") or module in imported(root)[test]:
            return 0 if in_folder else 1
        return 2 if in_folder else 3 if test.startswith(beside) else 4

    named = re.compile(rf"\b{function}\b".encode())
    near = {test: distance(test) for test in imported(root) if distance(test) < 4}
    found = [(away, not named.search((root / test).read_bytes()), test) for test, away in near.items()]
    return [test for *_, test in sorted(found)]


def outcome(one: Break, copy: Path, seconds: float) -> dict[str, str]:
    """Return what the tests say to a break, which stands in the copy only meanwhile."""
    path = copy / one.file
    source, times = path.read_bytes(), path.stat()
    path.write_bytes(one.applied(source))
    try:
        return run_tests(tests_of(one.file, one.inside, copy), copy, seconds)
    finally:
        path.write_bytes(source)
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))  # its compiled form is that of this time


def run_tests(tests: list[str], copy: Path, seconds: float) -> dict[str, str]:
    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (round(seconds), round(seconds) + 5))
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))

    command = [sys.executable, "-m", "pytest", "-x", "-p", "no:cacheprovider", "--tb=line", *tests]
    paths = os.pathsep.join((str(copy), str(copy / "app")))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        result = subprocess.run(
            command,
            cwd=copy,
            env={**os.environ, "PYTHONPATH": paths},
            preexec_fn=limited,
            capture_output=True,
            text=True,
            timeout=10 * seconds,
        )
        code, said = result.returncode, result.stdout + result.stderr
    except subprocess.TimeoutExpired:
        code, said = -1, ""
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    failed = re.search(r"(?:FAILED|ERROR) (tests/\S+)", said)
    return {
        "outcome": "survived" if code in (0, 5) else "out of time" if code < 0 else "noticed",
        "by": failed[1] if failed else "" if code in (0, 5) else said.strip()[-200:],
        "seconds": f"{after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime:.0f}",
    }


def copied(folder: str) -> Path:
    """Return a copy of the project, without what is not of it."""
    copy = Path(folder) / "project"
    shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns("__pycache__", ".git", ".venv", ".*_cache", "dist"))
    return copy


def key(one: Break) -> str:
    return f"{one.file}\n{one.before}\n{one.after}"


def is_equivalent(one: Break) -> bool:
    return (one.file, one.after) in EQUIVALENT


def tried(breaks: list[Break], keep: Path, again: bool, seconds: float, copy: Path) -> dict[str, dict[str, str]]:
    """Return the outcome of every break of a copy by its key, those of the file without trying them again."""
    lines = keep.read_text(encoding="utf-8").splitlines() if keep.exists() else []
    known = {line["key"]: line for line in map(json.loads, lines)}
    for one in breaks:
        at = key(one)
        if is_equivalent(one) or (at in known and not (again and known[at]["outcome"] != "noticed")):
            continue
        known[at] = {"key": at, "rule": one.rule, **outcome(one, copy, seconds)}
        with keep.open("a", encoding="utf-8") as file:
            file.write(json.dumps(known[at], ensure_ascii=False) + "\n")
    return known


def report(breaks: list[Break], known: dict[str, dict[str, str]]) -> None:
    """Print the breaks that no test noticed, and how many of each rule were."""
    counts: Counter[tuple[str, str]] = Counter()
    for one in breaks:
        found = "equivalent" if is_equivalent(one) else known[key(one)]["outcome"]
        counts[one.rule, found] += 1
        if found in ("survived", "out of time"):
            print(f"{one.file}:{one.line} {one.rule}, {found}\n    {one.before}\n    {one.after}")
    columns = ("noticed", "survived", "out of time", "equivalent")
    for rule in RULES:
        print(f"{rule.__name__:8}", *(f"{counts[rule.__name__, column]} {column}" for column in columns), sep="  ")
    noticed, equivalent = (
        sum(n for (_, what), n in counts.items() if what == asked) for asked in (columns[0], columns[3])
    )
    told = len(breaks) - equivalent
    print(f"{noticed} of {told} breaks that are not equivalent noticed ({100 * noticed / max(1, told):.1f} %)")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--breaks", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, default=Path("breaks.jsonl"))
    parser.add_argument("--again", action="store_true", help="try again what no test noticed")
    parser.add_argument("--seconds", type=float, default=SECONDS, help="of the processor for each break")
    parser.add_argument("--only", default="", help="draw in files whose path begins so")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:  # what is edited meanwhile does not matter
        copy = copied(folder)
        breaks = list(islice(drawn(asked.seed, asked.only, copy), asked.breaks))
        report(breaks, tried(breaks, asked.keep, asked.again, asked.seconds, copy))


if __name__ == "__main__":
    main()
