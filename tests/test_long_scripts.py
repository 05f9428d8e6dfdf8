"""What compares versions finds what differs, and what counts the program counts it."""

import ast
import subprocess
import sys
from itertools import islice
from math import inf
from pathlib import Path

import numpy as np
import pytest

from tests.long import breaks, golden, mutation, structure, walks


def test_every_script_and_benchmark_can_be_imported():
    """In a process of its own: some set the environment of Qt. What they ask of the program by its name is there."""
    files = [path for folder in ("long", "benchmarks") for path in (structure.HERE / "tests" / folder).rglob("*.py")]
    names = [".".join(path.relative_to(structure.HERE).with_suffix("").parts) for path in files if path.stem[0] != "_"]
    script = f"import importlib\nfor name in {sorted(names)}:\n    importlib.import_module(name)"
    run = subprocess.run(
        [sys.executable, "-c", script], cwd=structure.HERE, capture_output=True, text=True, check=False
    )
    assert len(names) > 50 and run.returncode == 0, run.stderr[-2000:]


def test_a_difference_is_judged_by_the_larger_value():
    picture = np.array([[0.0, 2.0], [1.0, 0.0]])
    assert golden.difference("values", picture, picture.copy()) == 0
    assert golden.difference("values", picture, picture + np.array([[0, 0], [0, 1e-3]])) == pytest.approx(5e-4)
    assert golden.difference("rms_waves", np.array(1e-9), np.array(3e-9)) == pytest.approx(
        2e-6
    )  # far below 0.001 waves


@pytest.mark.parametrize("other", [None, np.zeros(3), np.array([1.0, np.nan]), "2"])
def test_what_cannot_be_compared_is_infinitely_far(other):
    assert golden.difference("strehl", np.array([1.0, 2.0]), other) == inf


def test_the_worst_state_and_what_one_version_refuses_are_named():
    before = {("PSF", "a"): {"x": np.array(1.0)}, ("PSF", "b"): {"x": np.array(1.0)}, ("MTF", "c"): "too wide"}
    now = {("PSF", "a"): {"x": np.array(1.0)}, ("PSF", "b"): {"x": np.array(1.1)}, ("MTF", "c"): {"y": np.array(1.0)}}
    table, deliberate, refusals = golden.compared(now, before)
    assert table["PSF"] == golden.Row(2, 2, 1, pytest.approx(0.1 / 1.1), "b: x") and not deliberate
    assert len(refusals) == 1 and "MTF, c" in refusals[0]


def test_what_differs_on_purpose_stands_apart(monkeypatch):
    monkeypatch.setattr(golden, "DELIBERATE", {("PSF", "x"): (0.4, "better")})
    before = {("PSF fitted", "a"): {"x": np.array(1.0), "y": np.array(1.0), "far x": np.array(1.0)}}
    now = {("PSF fitted", "a"): {"x": np.array(1.5), "y": np.array(1.5), "far x": np.array(2.0)}}
    table, deliberate, _ = golden.compared(now, before)
    assert table["PSF fitted"].where == "a: far x" and deliberate["better"].where == "PSF fitted, a: x"
    assert table["PSF fitted"].figures == 2 and deliberate["better"].figures == 1


def test_a_state_gives_figures():
    kind, _, figures = next(s for s in golden.states() if s[0] == "coefficients")
    found = dict(golden.flat(figures()))
    assert kind == "coefficients" and np.isfinite(found["w40_waves"])


SOURCE = '''"""Text."""

def f(lens, a, b, c, d, e, g, h):
    """More text,
    on two lines."""
    # a comment
    if lens.misaligned and a:
        return b if c == "traced" else d
    return (
        e
    )
'''


def test_code_is_counted_without_text():
    tree, path = ast.parse(SOURCE), Path("p2sf/x.py")
    assert structure.lines_of_code(SOURCE) == 6
    assert [place[1] for place in structure.branches(path, tree)] == [7]
    assert [place[2] for place in structure.method_comparisons(path, tree)] == ["c == 'traced'"]
    assert [place[2] for place in structure.long_signatures(path, tree)] == ["f"]


COUNTED = """
from functools import cache, cached_property, lru_cache
@dataclass
class Waves:
    opd_waves: np.ndarray
class Trace:
    path: np.ndarray
class Wavefront:
    phase: np.ndarray
    @cached_property
    def rms(self): ...
@cache
def nodes(): ...
@lru_cache(maxsize=4)
def terms(): ...
plan = lru_cache(maxsize=8)(new_plan)
"""


def test_phases_and_kept_results_are_counted():
    path, tree = Path("p2sf/a.py"), ast.parse(COUNTED)
    assert [place[2] for place in structure.phases(path, tree)] == ["Waves", "Wavefront, in neither list"]
    assert structure._faults(list(structure.phases(path, tree))).startswith(
        "; new: Wavefront; gone: Cells, Coefficients, "
    )
    assert [place[2] for place in structure.memoised(path, tree)] == [
        "nodes",
        "terms",
        "lru_cache(maxsize=8)(new_plan)",
    ]


def test_the_types_that_hold_a_phase_are_those_of_the_list():
    root = structure.HERE
    trees = ((path.relative_to(root), ast.parse(path.read_text())) for path in structure.sources(root, "p2sf"))
    assert not structure._faults([place for path, tree in trees for place in structure.phases(path, tree)])


BROKEN = {
    "def f(a, b):\n    return (a) + 2 * b\n": {
        "sign": ["return (a) - 2 * b"],
        "factor": ["return (a) + (2 * (2 * b))"],
    },
    "def f(a):\n    low, high = a[:, 1].x\n": {
        "axes": ["high, low = a[:, 1].x", "low, high = a[:, 1].y", "low, high = a[:, 0].x"],
    },
    "def f(a):\n    return range(len(a) // 2)\n": {
        "one_off": ["return range(len(a) // 2 + 1)", "return range((len(a) // 2 + 1))"],
    },
    "def f(a):\n    b = 1e-3 * np.deg2rad(a)\n": {
        "factor": ["b = (2 * (1e-3 * np.deg2rad(a)))"],
        "unit": ["b = 1 * np.deg2rad(a)", "b = 1e-3 * (a)"],
    },
    "def f(a):\n    if a and (a != 3):\n        return None\n": {
        "guard": ["if False:", "if a:"],
    },
    'def f(a: "x + y"):\n    raise ValueError(f"{a + 1}" + "b")\n': {},
}


@pytest.mark.parametrize("source", BROKEN)
def test_a_break_changes_one_expression_and_no_text(source):
    found = list(breaks.places("p2sf/x.py", source.encode()))
    assert {(one.rule, one.after) for one in found} == {
        (rule, after) for rule, lines in BROKEN[source].items() for after in lines
    }
    assert all(one.compiles(source.encode()) for one in found)


def test_a_draw_begins_as_a_longer_one_does_and_takes_every_rule_in_turn():
    first, more = (list(islice(mutation.drawn(1, "p2sf/colour"), count)) for count in (6, 12))
    assert first == more[:6] and {one.rule for one in first} == {rule.__name__ for rule in breaks.RULES}


@pytest.mark.slow
def test_every_file_that_is_broken_has_tests_the_closest_first():
    assert mutation.tests_of("p2sf/psf/huygens.py")[:2] == ["tests/psf/test_fitted.py", "tests/psf/test_huygens.py"]
    files = (path for subject in mutation.SUBJECTS for path in (mutation.ROOT / subject).rglob("*.py"))
    assert all(mutation.tests_of(path.relative_to(mutation.ROOT).as_posix()) for path in files)


MOST_ACTIONS = {"MTF of five fields": 2, "report": 2, "a lesson of the screen": 3, "A beside B": 1}


def test_what_a_lecturer_and_an_engineer_want_takes_few_actions():
    taken = {task: len(actions) for walk in walks.WALKS for task, actions in walk.tasks}
    assert all(taken[task] <= most for task, most in MOST_ACTIONS.items())
