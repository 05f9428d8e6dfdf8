"""Tasks of a lesson that grade themselves: a number, a choice, an order, or sliders to be set. No Qt in here.

An answer is a text: a number with its unit ("6.7 µm", several separated by ";"), the number of an option in the file
("2"), the numbers of items in their order ("2 1 3"), or nothing where the state of the window is the answer. Judging
never compares texts.
"""

from dataclasses import dataclass, fields, replace
from itertools import pairwise
from math import copysign, isclose, isfinite, log10
from typing import Protocol, TypeVar
from zlib import crc32

from p2sf.errors import P2SFError
from p2sf.messages import Message, Number
from p2sf_explorer.lessons.changes import Changes
from p2sf_explorer.lessons.claims import Claim, holds, measure_claim
from p2sf_explorer.lessons.measure_words import measure_words
from p2sf_explorer.lessons.typed_numbers import read_typed, unit_of, written_value
from p2sf_explorer.state.state import State, entry

SEPARATOR = ";"
RIGHT, WRONG = Message("Right."), Message("Not yet.")


@dataclass(frozen=True)
class Judgement:
    """Whether an answer is right, what the program says of it, and the author's hint for it, "" for none."""

    right: bool
    words: Message
    hint: str = ""


@dataclass(frozen=True)
class TaskWords:
    """The texts of a task that are translated, each list in the order of the file."""

    labels: tuple[str, ...] = ()
    options: tuple[str, ...] = ()
    option_hints: tuple[str, ...] = ()
    items: tuple[str, ...] = ()
    wrong: tuple[str, ...] = ()
    hints: tuple[str, ...] = ()
    reasons: tuple[str, ...] = ()

    @property
    def shape(self) -> tuple[tuple[bool, ...], ...]:
        """Return which texts there are: the same in every language."""
        return tuple(tuple(map(bool, getattr(self, part.name))) for part in fields(self))


class Answer(Protocol):
    """What a task asks for."""

    def judge(self, text: str, set_up: State, now: State) -> Judgement:
        """Judge an answer; P2SFError, which costs no attempt, for one that cannot be read.

        ``set_up`` is the state of the task, ``now`` that of the window.
        """

    @property
    def words(self) -> "TaskWords":
        """Return all texts of the answer that are translated."""

    def with_words(self, words: "TaskWords") -> "Answer":
        """Return this with such texts in another language."""


Foreseen = TypeVar("Foreseen")


def with_hints(wrong: tuple[tuple[Foreseen, str], ...], words: TaskWords) -> tuple[tuple[Foreseen, str], ...]:
    """Return foreseen wrong answers with their hints in another language."""
    return tuple((foreseen, hint) for (foreseen, _), hint in zip(wrong, words.wrong, strict=True))


@dataclass(frozen=True)
class NumericPart:
    """A number in ``unit`` and how far off an answer may be, or the measure that gives the number in a state.

    A ``relative`` tolerance is a share of the number.
    """

    number: float
    measure: Claim | None
    tolerance: float
    relative: bool
    unit: str
    label: str = ""

    def target(self, state: State) -> float:
        """Return the number, measured at a state where the program is to give it; P2SFError."""
        return measure_claim(self.measure, state) if self.measure else self.number

    def covers(self, value: float, state: State) -> bool:
        """Return whether a value is near enough."""
        wanted = self.target(state)
        allowed = self.tolerance * abs(wanted) if self.relative else self.tolerance
        return abs(value - wanted) <= allowed + 1e-9 * abs(wanted)  # the rounding of units


@dataclass(frozen=True)
class NumericAnswer:
    """One number or several, and foreseen wrong ones, each with the hint for it."""

    parts: tuple[NumericPart, ...]
    wrong: tuple[tuple[NumericPart, str], ...] = ()

    def judge(self, text: str, set_up: State, now: State) -> Judgement:
        """Judge numbers, separated by semicolons, in the order of the parts."""
        texts = text.split(SEPARATOR)
        if len(texts) != len(self.parts):
            count = len(self.parts)
            raise P2SFError("{given} numbers are given, {count} are asked for", given=len(texts), count=count)
        values = [read_typed(one, part.unit) for one, part in zip(texts, self.parts, strict=True)]
        for value, part in zip(values, self.parts, strict=True):
            if not part.covers(value, set_up):
                return self._judge_wrong(value, part, set_up)
        return Judgement(True, RIGHT)

    def _judge_wrong(self, value: float, part: NumericPart, state: State) -> Judgement:
        alike = ((foreseen, hint) for foreseen, hint in self.wrong if foreseen.unit == part.unit)
        hint = next((hint for foreseen, hint in alike if foreseen.covers(value, state)), "")
        said = diagnose(value, part.target(state)) if not hint else WRONG
        if part.label:
            said = Message("{label}: {words}", label=part.label, words=said)
        return Judgement(False, said, hint)

    @property
    def words(self) -> TaskWords:
        """Return labels and hints."""
        labels = tuple(part.label for part in self.parts)
        return TaskWords(labels=labels if any(labels) else (), wrong=tuple(hint for _, hint in self.wrong))

    def with_words(self, words: TaskWords) -> "NumericAnswer":
        """Return this with labels and hints in another language."""
        labels = words.labels or [part.label for part in self.parts]
        parts = tuple(replace(part, label=label) for part, label in zip(self.parts, labels, strict=True))
        return NumericAnswer(parts, with_hints(self.wrong, words))


def diagnose(value: float, wanted: float) -> Message:
    """Return what a wrong number tells: a slip of unit, sign or a factor of two, else on which side it lies."""
    if value and wanted and isfinite(wanted):
        power = log10(abs(value / wanted))
        if round(power) and abs(power - round(power)) < 0.01:
            return Message("Not yet: the digits are right, and the power of ten is not. Check the unit.")
        if isclose(value, -wanted, rel_tol=0.02):
            return Message("Not yet: the size is right, and the sign is not.")
        if isclose(abs(power), log10(2), abs_tol=0.01):
            return Message("Not yet: a factor of two is wrong. Radius or diameter?")
    if value == wanted or copysign(1, value) != copysign(1, wanted):
        return WRONG
    return Message("Not yet: that is too large.") if value > wanted else Message("Not yet: that is too small.")


SURE = ("a guess", "unsure", "rather sure", "sure")
"""How sure somebody is of an answer and its reason, from 1."""


@dataclass(frozen=True)
class ChoiceAnswer:
    """Options in the order of the file, which one is right (from 0), and the hint for each of the others.

    With ``reasons``, of which the one at ``why`` is right, an answer has three numbers from 1: option, reason, and how
    sure one is (Kaltakci-Gurel, Eryilmaz and McDermott 2017, Res. Sci. Technol. Educ. 35, 238). Option and reason both
    have to be right.
    """

    options: tuple[str, ...]
    right: int
    hints: tuple[str, ...]
    reasons: tuple[str, ...] = ()
    why: int = 0

    def judge(self, text: str, set_up: State, now: State) -> Judgement:
        """Judge the number of an option, from 1, in the order of the file; where it is asked for, that of a reason."""
        most = (len(self.options), len(self.reasons), len(SURE)) if self.reasons else (len(self.options),)
        remedy = "choose an answer, a reason and how sure you are" if self.reasons else "choose one of the answers"
        picked = _numbers(text, most, remedy)
        if picked[0] != self.right:
            return Judgement(False, WRONG, self.hints[picked[0]])
        if self.reasons and picked[1] != self.why:
            return Judgement(False, Message("Not yet: the answer is right, and its reason is not."))
        return Judgement(True, RIGHT)

    @property
    def words(self) -> TaskWords:
        """Return options, hints and reasons."""
        return TaskWords(options=self.options, option_hints=self.hints, reasons=self.reasons)

    def with_words(self, words: TaskWords) -> "ChoiceAnswer":
        """Return this with its texts in another language."""
        return replace(self, options=words.options, hints=words.option_hints, reasons=words.reasons)


@dataclass(frozen=True)
class OrderAnswer:
    """Items in their right order, and foreseen wrong orders (from 0), each with the hint for it."""

    items: tuple[str, ...]
    wrong: tuple[tuple[tuple[int, ...], str], ...] = ()

    def judge(self, text: str, set_up: State, now: State) -> Judgement:
        """Judge the numbers of the items, from 1 in the order of the file, in the order that they are given."""
        order = _numbers(text, (len(self.items),) * len(self.items), "put all items into an order")
        if len(set(order)) != len(order):
            raise P2SFError("put all items into an order")
        misplaced = [(a, b) for a, b in pairwise(order) if a > b]
        if not misplaced:
            return Judgement(True, RIGHT)
        hint = next((hint for foreseen, hint in self.wrong if foreseen == order), "")
        first, second = (self.items[k] for k in misplaced[0])
        words = Message("Not yet: “{first}” does not come before “{second}”.", first=first, second=second)
        return Judgement(False, WRONG if hint else words, hint)

    @property
    def words(self) -> TaskWords:
        """Return items and hints."""
        return TaskWords(items=self.items, wrong=tuple(hint for _, hint in self.wrong))

    def with_words(self, words: TaskWords) -> "OrderAnswer":
        """Return this with items and hints in another language."""
        return OrderAnswer(words.items, with_hints(self.wrong, words))


BESIDE_GOAL = {
    "lens": Message("Not yet: this is not the lens of the task. Set the task up again."),
    "lens_text": Message("Not yet: this is not the lens of the task. Set the task up again."),
    "added_waves": Message("Not yet: waves were added by hand. Set the task up again."),
    "errors": Message("Not yet: the lens was misaligned or aligned. Set the task up again."),
}
"""Entries that stay as the task sets them while its goal is sought, and what is said where they do not."""


@dataclass(frozen=True)
class GoalAnswer:
    """What the measures of the window's own state have to be; what it says where another condition holds.

    ``solution`` are changes that reach the goal from the state of the task.
    """

    conditions: tuple[Claim, ...]
    solution: Changes
    wrong: tuple[tuple[tuple[Claim, ...], str], ...] = ()

    def judge(self, text: str, set_up: State, now: State) -> Judgement:
        """Judge the state ``now``."""
        moved = next((name for name in BESIDE_GOAL if entry(now, name) != entry(set_up, name)), "")
        if moved:
            return Judgement(False, BESIDE_GOAL[moved])
        values = {claim: measure_claim(claim, now) for claim in self.conditions}
        failed = next((claim for claim in self.conditions if not holds(claim, values[claim])), None)
        if failed is None:
            return Judgement(True, RIGHT)
        for conditions, hint in self.wrong:
            if all(holds(claim, measure_claim(claim, now)) for claim in conditions):
                return Judgement(False, WRONG, hint)
        return Judgement(False, unmet(failed, values[failed]))

    @property
    def words(self) -> TaskWords:
        """Return hints."""
        return TaskWords(wrong=tuple(hint for _, hint in self.wrong))

    def with_words(self, words: TaskWords) -> "GoalAnswer":
        """Return this with hints in another language."""
        return replace(self, wrong=with_hints(self.wrong, words))


def unmet(claim: Claim, value: float) -> Message:
    """Return what a measure is and what it has to be."""
    unit = unit_of(claim.measure)
    wanted, amount = Number(written_value(claim.number, unit)), Number(written_value(value, unit))
    bounds = {
        "is": Message("{wanted} ± {tolerance}", wanted=wanted, tolerance=Number(written_value(claim.tolerance, unit))),
        "above": Message("above {wanted}", wanted=wanted),
        "below": Message("below {wanted}", wanted=wanted),
    }
    return Message(
        "Not yet: {measure} is {value} and has to be {bounds}.",
        measure=measure_words(claim.measure),
        value=amount,
        bounds=bounds[claim.relation],
    )


def _numbers(text: str, most: tuple[int, ...], remedy: str) -> tuple[int, ...]:
    """Return whole numbers, each from 1 to one of ``most``, counted from 0; P2SFError, ``remedy``, for other texts."""
    words = text.split()
    limits = zip(words, most, strict=False)
    if len(words) != len(most) or not all(word.isdecimal() and 1 <= int(word) <= limit for word, limit in limits):
        raise P2SFError(Message(remedy))
    return tuple(int(word) - 1 for word in words)


@dataclass(frozen=True)
class Mark:
    """What is marked on the picture before an answer, a "ring" about the chief ray or a "level", and what it is."""

    form: str
    measure: Claim

    def words(self, marked: float, state: State) -> Message:
        """Return what was marked beside what the measure is in a state; P2SFError where it cannot be measured."""
        unit = unit_of(self.measure.measure)
        given, truth = (Number(written_value(value, unit)) for value in (marked, measure_claim(self.measure, state)))
        return Message("You marked {marked}; it is {truth}.", marked=given, truth=truth)


@dataclass(frozen=True)
class Exercise:
    """A task: its name, which is unique in a course and stays the same in all languages, and what it asks for.

    ``hints`` are shown one at a time; ``see`` are the changes that show what a first answer had predicted,
    and ``mark`` is what the prediction marks on the picture.
    """

    name: str
    answer: Answer
    hints: tuple[str, ...] = ()
    see: Changes = ()
    mark: Mark | None = None

    def judge(self, text: str, set_up: State, now: State) -> Judgement:
        """Judge an answer given at the state ``now``; P2SFError for one that cannot be read."""
        return self.answer.judge(text, set_up, now)

    @property
    def words(self) -> TaskWords:
        """Return all texts of the task that are translated."""
        return replace(self.answer.words, hints=self.hints)

    def with_words(self, words: TaskWords) -> "Exercise":
        """Return the task with such texts in another language."""
        return replace(self, answer=self.answer.with_words(words), hints=words.hints)


def shuffle(count: int, seed: str) -> tuple[int, ...]:
    """Return 0 … count − 1 in an order that a name gives, the same everywhere, and never as they are counted."""
    order = tuple(sorted(range(count), key=lambda k: crc32(f"{seed} {k}".encode())))
    return order if order != tuple(range(count)) else order[1:] + order[:1]


def reason_order(task: Exercise) -> tuple[int, ...]:
    """Return the numbers of reasons, from 0, in the order in which windows and sheets show them."""
    return shuffle(len(task.words.reasons), f"{task.name} why")


def display_order(task: Exercise) -> tuple[int, ...]:
    """Return the numbers of options or items, from 0, in the order in which windows and sheets show them."""
    return shuffle(len(task.words.options or task.words.items), task.name)
