"""The lines of a lesson file that make a task. No Qt in here."""

import re
from collections.abc import Callable, Mapping

from p2sf.errors import P2SFError
from p2sf_explorer.lessons.changes import Changes, LessonError, fault, read_changes
from p2sf_explorer.lessons.claims import Claim, parse_claim, parse_measure
from p2sf_explorer.lessons.task import (
    Answer,
    ChoiceAnswer,
    Exercise,
    GoalAnswer,
    Mark,
    NumericAnswer,
    NumericPart,
    OrderAnswer,
    TaskWords,
)
from p2sf_explorer.lessons.typed_numbers import F_NUMBER, is_unit, unit_of, units_like

KINDS = ("answer", "choose", "order", "goal")
TASK = ("task", *KINDS, "solve", "see", "wrong", "hint", "because", "mark")
TASK_WORDS = ("task", "answer", "choose", "order", "wrong", "hint", "because")
BELONGS = {"wrong": ("answer", "order", "goal"), "solve": ("goal",), "because": ("choose",)}  # and to no other kind
NAME = re.compile(r"[a-z0-9][a-z0-9_-]*")
AMOUNT = r"[-−+]?\d+(?:[.,]\d+)?(?:e[-+]?\d+)?"
NUMERIC = re.compile(
    rf"(?P<f>f/)?(?:(?P<number>{AMOUNT})|measure\s++(?P<measure>[^±]+)(?<!\s))"
    rf"\s*+±\s*+(?P<tolerance>{AMOUNT})\s*+(?P<percent>%(?=\s*\S)|%$)?\s*+(?P<unit>\S*)"
)
NUMERIC_EXAMPLE = "answer: 6.7 ± 0.2 µm"
MARKS = ("ring", "level")
HINT, BETWEEN, PICKED = "::", "|", "*"
OUTSIDE_BRACKETS = re.compile(r",(?![^\[]*\])")

Lines = list[tuple[int, str]]
"""Lines of a file with their numbers, from 1."""


def parse_task(found: Mapping[str, Lines], where: str) -> Exercise | None:
    """Return the task of a step's lines, None where there are none; P2SFError names ``where`` and the line."""
    first = next((found[name][0] for name in TASK if found[name]), None)
    if first is None:
        return None
    if not found["task"]:
        raise fault(where, first[0], "a task needs a name; add a line such as task: my-first-task")
    number, name = found["task"][0]
    if not NAME.fullmatch(name):
        raise fault(where, number, '"{name}" is no name of a task; use small letters, digits and hyphens', name=name)
    kinds = [kind for kind in KINDS if found[kind]]
    if len(kinds) != 1:
        raise fault(where, number, "a task asks for one thing; give one of {names}", names=KINDS)
    for extra, home in BELONGS.items():
        if found[extra] and kinds[0] not in home:
            raise fault(where, found[extra][0][0], '"{name}:" does not go with "{kind}:"', name=extra, kind=kinds[0])
    answer = READERS[kinds[0]](found, where)
    hints = tuple(text for _, text in found["hint"])
    return Exercise(name, answer, hints, _see(found, where), _mark(found, where))


def parse_words(found: Mapping[str, Lines]) -> tuple[str, TaskWords]:
    """Return the name of a task, "" where there is none, and its texts in the file of another language."""
    options = _all_options(found["choose"])
    labels = tuple(_with_hint(text)[1] for _, text in found["answer"])
    words = TaskWords(
        labels=labels if any(labels) else (),
        options=tuple(text.removeprefix(PICKED).strip() for text, _ in options),
        option_hints=tuple(hint for _, hint in options),
        items=tuple(item for _, text in found["order"] for item in _items(text)),
        wrong=tuple(_with_hint(text)[1] for _, text in found["wrong"]),
        hints=tuple(text for _, text in found["hint"]),
        reasons=tuple(reason.removeprefix(PICKED).strip() for reason, _ in _all_options(found["because"])),
    )
    return (found["task"][0][1] if found["task"] else ""), words


def _see(found: Mapping[str, Lines], where: str) -> Changes:
    return tuple(
        change for number, text in found["see"] for change in read_changes(text.removeprefix("set:"), number, where)
    )


def _mark(found: Mapping[str, Lines], where: str) -> Mark | None:
    if not found["mark"]:
        return None
    number, text = found["mark"][0]
    form, _, measure = text.partition(" ")
    if form not in MARKS:
        raise fault(where, number, '"{form}" cannot be marked; mark one of {names}', form=form, names=MARKS)
    return Mark(form, _from_line(measure, number, where, parse_measure))


def _with_hint(text: str) -> tuple[str, str]:
    """Return what stands before and behind the two colons."""
    before, _, hint = text.partition(HINT)
    return before.strip(), hint.strip()


def _options(text: str) -> list[tuple[str, str]]:
    return [_with_hint(option) for option in text.split(BETWEEN) if option.strip()]


def _all_options(lines: Lines) -> list[tuple[str, str]]:
    return [option for _, text in lines for option in _options(text)]


def _items(text: str) -> list[str]:
    return [item.strip() for item in text.split(";") if item.strip()]


def _numeric(found: Mapping[str, Lines], where: str) -> Answer:
    parts = tuple(_part(text, number, where) for number, text in found["answer"])
    wrong = tuple((_part(_with_hint(text)[0], number, where, parts[0]), _hint(text, number, where))
                  for number, text in found["wrong"])  # fmt: skip
    return NumericAnswer(parts, wrong)


def _part(text: str, number: int, where: str, like: NumericPart | None = None) -> NumericPart:
    """Return the number of a line; one that is foreseen as wrong is converted to the unit of the answer, ``like``."""
    stated, label = _with_hint(text)
    found = NUMERIC.fullmatch(stated)
    if not found or not is_unit(found["unit"].lower()):
        raise fault(
            where,
            number,
            '"{text}" is no answer with its tolerance; write one such as {example}',
            text=stated,
            example=NUMERIC_EXAMPLE,
        )
    unit, tolerance = F_NUMBER if found["f"] else found["unit"].lower(), _amount(found["tolerance"])
    relative = bool(found["percent"])
    if found["measure"]:
        claim = _from_line(found["measure"], number, where, parse_measure)
        own = "" if claim.how == "/" else unit_of(claim.measure)
        if unit not in ("", own) or (like and like.unit != own):
            raise fault(
                where,
                number,
                "{measure} has the unit {unit}; leave the unit out, and ask for a number in it",
                measure=claim.measure,
                unit=own or "1",
            )
        return NumericPart(0.0, claim, tolerance / 100 if relative else tolerance, relative, own, label)
    if relative and not unit:  # 20 ± 1 % is a number of percents
        unit, relative = "%", False
    factor = units_like(like.unit).get(unit) if like else 1.0
    if factor is None:
        raise fault(where, number, "the answer has the unit {unit}; write the wrong one in it", unit=like and like.unit)
    allowed = tolerance / 100 if relative else tolerance * factor
    return NumericPart(factor * _amount(found["number"]), None, allowed, relative, like.unit if like else unit, label)


def _amount(text: str) -> float:
    return float(text.replace("−", "-").replace(",", "."))


def _from_line(text: str, number: int, where: str, parse: Callable[[str, Callable[[str], Changes]], Claim]) -> Claim:
    """Return what ``parse`` makes of a text; its errors name the line."""
    try:
        return parse(text, lambda inner: read_changes(inner, number, where))
    except LessonError:
        raise
    except P2SFError as error:
        raise fault(where, number, error.message) from None


def _hint(text: str, number: int, where: str) -> str:
    hint = _with_hint(text)[1]
    if not hint:
        raise fault(where, number, "a wrong answer needs a hint; write it behind {colons}", colons=HINT)
    return hint


def _choice(found: Mapping[str, Lines], where: str) -> Answer:
    texts, right, hints = _picked(found["choose"], where)
    reasons, why, _ = _picked(found["because"], where) if found["because"] else ((), 0, ())
    return ChoiceAnswer(texts, right, hints, reasons, why)


def _picked(lines: Lines, where: str) -> tuple[tuple[str, ...], int, tuple[str, ...]]:
    """Return the options of some lines, the number of the one with a star, from 0, and their hints."""
    options = _all_options(lines)
    right = [k for k, (text, _) in enumerate(options) if text.startswith(PICKED)]
    if len(options) < 2 or len(right) != 1:
        raise fault(where, lines[0][0], "a choice has two options or more, and a star before the right one")
    return tuple(text.removeprefix(PICKED).strip() for text, _ in options), right[0], tuple(h for _, h in options)


def _order(found: Mapping[str, Lines], where: str) -> Answer:
    number = found["order"][0][0]
    items = tuple(item for _, text in found["order"] for item in _items(text))
    if len(set(items)) < 2 or len(set(items)) != len(items):
        raise fault(where, number, "an order has two different items or more, separated by semicolons")
    wrong = []
    for line, text in found["wrong"]:
        words = _with_hint(text)[0].split()
        order = tuple(int(word) - 1 for word in words if word.isdecimal())
        if sorted(order) != list(range(len(items))) or len(words) != len(items):
            raise fault(where, line, "a wrong order has the numbers of all items, such as 2 1 3")
        wrong.append((order, _hint(text, line, where)))
    return OrderAnswer(items, tuple(wrong))


def _goal(found: Mapping[str, Lines], where: str) -> Answer:
    conditions = tuple(claim for number, text in found["goal"] for claim in _claims(text, number, where))
    if not found["solve"]:
        raise fault(where, found["goal"][0][0], "a goal needs a way there; add a line such as solve: field_deg 10")
    solution = tuple(change for number, text in found["solve"] for change in read_changes(text, number, where))
    wrong = tuple(
        (_claims(_with_hint(text)[0], number, where), _hint(text, number, where)) for number, text in found["wrong"]
    )
    return GoalAnswer(conditions, solution, wrong)


def _claims(text: str, number: int, where: str) -> tuple[Claim, ...]:
    return tuple(_from_line(one, number, where, parse_claim) for one in OUTSIDE_BRACKETS.split(text) if one.strip())


READERS: dict[str, Callable[[Mapping[str, Lines], str], Answer]] = {
    "answer": _numeric,
    "choose": _choice,
    "order": _order,
    "goal": _goal,
}
