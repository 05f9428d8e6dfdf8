"""What compares versions finds what differs, and what counts the program counts it."""

import ast
from math import inf
from pathlib import Path

import numpy as np
import pytest

from tests.long import golden, structure, walks


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


MOST_ACTIONS = {"MTF of five fields": 2, "report": 2, "a lesson of the screen": 3, "A beside B": 1}


def test_what_a_lecturer_and_an_engineer_want_takes_few_actions():
    taken = {task: len(actions) for walk in walks.WALKS for task, actions in walk.tasks}
    assert all(taken[task] <= most for task, most in MOST_ACTIONS.items())
