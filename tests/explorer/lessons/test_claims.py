"""Every claim of a lesson or lecture by a road of its own, so that a fault of the program is not what it teaches."""

import pytest

from p2sf_explorer.course.lectures import FOLDER as COURSE_FOLDER
from p2sf_explorer.lessons.changes import apply_changes
from p2sf_explorer.lessons.claims import Claim, holds
from p2sf_explorer.lessons.lesson import FOLDER as LESSON_FOLDER
from p2sf_explorer.lessons.lesson import lesson_files, read_lesson
from p2sf_explorer.lessons.measures import MEASURES
from p2sf_explorer.state.state import State
from tests.support.windows.lesson_measures import OWN_ACCOUNT, REFEREE

LESSONS = [read_lesson(path) for folder in (LESSON_FOLDER, COURSE_FOLDER) for path in lesson_files(folder)]
CLAIMS = [
    pytest.param(lesson.state(number), claim, id=f"{lesson.name}-{number + 1}-{claim.text}")
    for lesson in LESSONS
    for number, step in enumerate(lesson.steps)
    for claim in step.claims
    if claim.measure not in OWN_ACCOUNT
]


def by_another_road(claim: Claim, state: State) -> float:
    """Return the left side of a claim as the referee measures it."""
    measure = REFEREE[claim.measure]
    value = measure(apply_changes(state, claim.first))
    if not claim.how:
        return value
    other = measure(apply_changes(state, claim.second))
    return value / other if claim.how == "/" else value - other


@pytest.mark.slow
@pytest.mark.parametrize(("state", "claim"), CLAIMS)
def test_a_claim_is_true(state, claim):
    value = by_another_road(claim, state)
    assert holds(claim, value), f"{claim.text}: the referee measures {value:.6g}"


def test_every_measure_has_another_road_or_a_reason():
    assert set(MEASURES) == set(REFEREE) | set(OWN_ACCOUNT)
