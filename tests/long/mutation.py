"""Do the tests notice when the formulas change? Mutation testing by mutmut, in a copy of the project.

``python -m tests.long.mutation [module …]`` (needs ``pip install mutmut``; by default those of `TESTS`) prints
for each module how many mutants its tests kill, and every survivor as a difference. The working tree is not touched.
``psf/seidel:7`` tries the tenth of its mutants whose number ends in 7.

Last complete runs, in which survivors are mutants that no test tells from the original:

- gaussian: 527 of 570 (92.5 %). 26 are ``strict`` of a zip over columns of one length, 6 a dtype that all numbers
  have already, 6 the short way of one source, which gives the numbers of the long one; the others multiply a height
  of 0, count a gap behind the last surface, begin a sum or an axis where broadcasting would.
- seidel: 304 of 319 (95.3 %). 12 times ``strict``, two short ways, −2 for the −1 of a reshape.
- pupils: 463 of 465 (99.6 %). −2 for −1, and a division by a sign of 1 or −1.
- wavefront: 341 of 361 (94.5 %), one by timeout: a slope 1728 times too large, which its first test refuses at
  once and others sum for long. Memory used twice (4), dtypes (2), −2 for −1; a tilt of 0 added or carried (3);
  the signs of an angular slope whose largest value all of them share (3), and powers of ρ in it, which is largest at
  the rim, where they are 1 (2); slope points more or fewer within the promised 1 % (3); what a division by 0 leaves
  undefined and then multiplies by 0 (2).
- psf: 438 of 445 (98.4 %). 3 times ``strict``; more nodes or a wider empty rim than needed, in the two plain formulas
  that others are compared with: the same picture to rounding (4).
- fitted: 188 of 189 (99.5 %). None in place of False for a table's odd half.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[2]
FIRST_ORDER = (
    "tests/paraxial/test_first_order.py",
    "tests/paraxial/test_pupils.py",
    "tests/paraxial/test_pupil_arguments.py",
    "tests/paraxial/test_seidel.py",
    "tests/extremes/test_named.py",
    "tests/extremes/test_rounding.py",
)
TESTS = {
    "paraxial/first_order": FIRST_ORDER,
    "paraxial/pupils": FIRST_ORDER,
    "paraxial/seidel": FIRST_ORDER,
    "paraxial/wavefront": ("tests/paraxial/test_wavefront.py", "tests/pupil/test_quadrature.py"),
    "psf/seidel": ("tests/psf/test_seidel.py", "tests/extremes/test_psf_extremes.py"),
    "psf/fitted": ("tests/psf/test_fitted.py", "tests/psf/test_traced.py"),
}
BARE = (
    "paraxial/seidel",
    "paraxial/wavefront",
)  # tried without their caches, because mutmut passes over decorated functions
SETTINGS = """[mutmut]
source_paths=p2sf
only_mutate=p2sf/{module}.py
pytest_add_cli_args_test_selection={tests}
pytest_add_cli_args=
    -p
    no:cacheprovider
    -W
    error::RuntimeWarning
also_copy=
    lenses
    app
    pyproject.toml
    tests
"""


def mutate(module: str, folder: Path, ending: str = "") -> Counter:
    """Return how many mutants of a module were killed or survived, and print the survivors, and what timed out."""
    for name in ("p2sf", "app", "tests", "lenses"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", folder)
    if module in BARE:
        source = folder / "p2sf" / f"{module}.py"
        source.write_text(re.sub(r"^@lru_cache.*\n", "", source.read_text(), flags=re.MULTILINE))
    tests = "".join(f"\n    {path}" for path in TESTS[module])
    (folder / "setup.cfg").write_text(SETTINGS.format(module=module, tests=tests))
    run(
        "run", "--max-children", "1", *([f"p2sf.{module.replace('/', '.')}.*{ending}"] if ending else []), folder=folder
    )
    states = dict(
        line.strip().rsplit(": ", 1)
        for line in run("results", "--all", "true", folder=folder).splitlines()
        if ": " in line and not line.endswith("not checked")
    )
    for name, state in states.items():
        if state != "killed":
            print(f"--- {state}\n{run('show', name, folder=folder)}", flush=True)
    return Counter(states.values())


def run(*arguments: str, folder: Path) -> str:
    result = subprocess.run([sys.executable, "-m", "mutmut", *arguments], cwd=folder, capture_output=True, text=True)
    if result.returncode and arguments[0] == "run":
        print(result.stdout[-3000:], result.stderr[-3000:])
    return result.stdout


def main() -> None:
    for asked in sys.argv[1:] or TESTS:
        module, _, ending = asked.partition(":")
        with tempfile.TemporaryDirectory() as folder:
            found = mutate(module, Path(folder), ending)
        killed = found["killed"] + found["timeout"]
        share = 100 * killed / max(1, found.total())
        print(f"{asked}: {killed} of {found.total()} mutants killed ({share:.1f} %), {dict(found)}", flush=True)


if __name__ == "__main__":
    main()
