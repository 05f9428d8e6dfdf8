"""Tests of a lesson: does each step have a picture, is what it claims true, can its tasks be solved. No Qt in here."""

import re
from collections.abc import Callable, Container, Iterator
from functools import partial
from itertools import pairwise

from p2sf.errors import P2SFError
from p2sf.messages import Message, Number
from p2sf_explorer.compute.live import live
from p2sf_explorer.lessons.changes import apply_changes
from p2sf_explorer.lessons.claims import Claim, holds, measure_claim
from p2sf_explorer.lessons.lesson import Lesson, Step
from p2sf_explorer.lessons.task import ChoiceAnswer, Exercise, GoalAnswer, NumericAnswer, OrderAnswer
from p2sf_explorer.state.state import State

EMPHASISED = re.compile(r"(?<!\*)\*([^*]+)\*(?!\*)")  # which lessons keep for the names of controls
Check = Callable[[], Iterator[Message]]
"""One check: what it finds wrong."""


def checks(lesson: Lesson, names: Container[str]) -> Iterator[tuple[int, Check]]:
    """Yield the number of a step, from 0, and a check of it; ``names`` are all names on screen."""
    seen: set[str] = set()
    for number, step in enumerate(lesson.steps):
        state = lesson.state(number)
        yield number, partial(check_picture, state)
        yield number, partial(check_names, step, names)
        for claim in step.claims:
            yield number, partial(check_claim, claim, state)
        if step.task:
            yield number, partial(check_task, step.task, state, step.task.name in seen)
            seen.add(step.task.name)


def findings(lesson: Lesson, names: Container[str]) -> list[tuple[int, Message]]:
    """Return all that is wrong with a lesson, each with the number of its step."""
    return [(number, found) for number, check in checks(lesson, names) for found in faults_of(check)]


def faults_of(check: Check) -> list[Message]:
    """Return what a check finds; an error of the program is a finding."""
    try:
        return list(check())
    except P2SFError as error:
        return [error.message]


def check_picture(state: State) -> Iterator[Message]:
    """Find a state that has no picture."""
    live(state, "preview")
    yield from ()


def check_names(step: Step, names: Container[str]) -> Iterator[Message]:
    """Find names of controls that are not on screen."""
    words = " ".join((step.text, step.attempt, step.question, step.answer))
    for name in dict.fromkeys(EMPHASISED.findall(words)):
        if name not in names:
            yield Message("*{name}* is the name of nothing on screen; write emphasis as **{name}**", name=name)


def check_claim(claim: Claim, state: State) -> Iterator[Message]:
    """Find a claim that is not true."""
    value = measure_claim(claim, state)
    if not holds(claim, value):
        yield Message("{claim}: {value} is measured", claim=claim.text, value=Number(f"{value:.6g}"))


def check_task(task: Exercise, state: State, repeated: bool) -> Iterator[Message]:
    """Find a task that cannot be solved, or whose hints are never shown."""
    if repeated:
        yield Message('two tasks are named "{name}"; name one otherwise', name=task.name)
    apply_changes(state, task.see)
    yield from ANSWERS[type(task.answer)](task, state)


def _check_number(task: Exercise, state: State) -> Iterator[Message]:
    answer = task.answer
    assert isinstance(answer, NumericAnswer)
    for foreseen, hint in answer.wrong:
        value = foreseen.target(state)
        if any(part.covers(value, state) for part in answer.parts):
            yield Message(
                "the wrong answer {value} counts as right; narrow the tolerance", value=Number(f"{value:.4g}")
            )
            continue
        text = "; ".join([f"{value!r}"] * len(answer.parts))
        if answer.judge(text, state, state).hint != hint:
            yield Message("the hint for {value} is never shown; another comes first", value=Number(f"{value:.4g}"))


def _check_choice(task: Exercise, state: State) -> Iterator[Message]:
    answer = task.answer
    assert isinstance(answer, ChoiceAnswer)
    for number, (option, hint) in enumerate(zip(answer.options, answer.hints, strict=True)):
        if number != answer.right and not hint and not answer.reasons:  # an item with reasons tests, and does not teach
            yield Message("the wrong answer “{option}” has no hint; add one", option=option)


def _check_order(task: Exercise, state: State) -> Iterator[Message]:
    answer = task.answer
    assert isinstance(answer, OrderAnswer)
    for order, _ in answer.wrong:
        if all(a < b for a, b in pairwise(order)):
            yield Message("the right order is listed as a wrong one; leave it out")


def _check_goal(task: Exercise, state: State) -> Iterator[Message]:
    answer = task.answer
    assert isinstance(answer, GoalAnswer)
    if answer.judge("", state, state).right:
        yield Message("the goal is reached before anything is moved; begin elsewhere")
    reached = apply_changes(state, answer.solution)
    if not (judgement := answer.judge("", state, reached)).right:
        yield Message("what solves the goal does not reach it: {why}", why=judgement.words)


ANSWERS: dict[type, Callable[[Exercise, State], Iterator[Message]]] = {
    NumericAnswer: _check_number,
    ChoiceAnswer: _check_choice,
    OrderAnswer: _check_order,
    GoalAnswer: _check_goal,
}
