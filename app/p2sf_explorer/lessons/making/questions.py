"""Questions as the form of a lesson takes them, and as a lesson file writes them. No Qt in here."""

from dataclasses import dataclass

from p2sf.errors import P2SFError
from p2sf_explorer.lessons.task_parsing import BETWEEN, HINT, PICKED

NONE, OPEN, NUMBER, CHOICE, ORDER, GOAL = "", "open", "answer", "choose", "order", "goal"
WITH_WRONG = NUMBER, ORDER, GOAL


@dataclass(frozen=True)
class Question:
    """What a form holds: the kind, question and solution, and by kind its ``subject`` and ``rows``.

    ``subject`` is the right answer of a number, the items of an order or the claims of a goal, as a lesson writes them;
    ``rows`` are options, the right one first, or foreseen wrong answers, each with its hint. ``solve`` are the changes
    that reach a goal.
    """

    kind: str = NONE
    words: str = ""
    solution: str = ""
    subject: str = ""
    rows: tuple[tuple[str, str], ...] = ()
    hints: tuple[str, ...] = ()
    solve: str = ""


def question_lines(question: Question, name: str) -> list[str]:
    """Return the lines of a lesson file; ``name`` is that of the task. P2SFError where a text would end its entry."""
    if question.kind == NONE:
        return []
    lines = [f"ask: {_line(question.words)}", f"tell: {_line(question.solution)}"]
    if question.kind == OPEN:
        return lines
    rows = [(_text(words), _text(hint)) for words, hint in question.rows if words.strip()]
    lines.append(f"task: {name}")
    if question.kind == CHOICE:
        options = [f"{words} {HINT} {hint}" if hint else words for words, hint in rows]
        lines.append(f"choose: {f' {BETWEEN} '.join([f'{PICKED}{options[0]}', *options[1:]] if options else [])}")
    else:
        lines.append(f"{question.kind}: {_line(question.subject)}")
    if question.kind in WITH_WRONG:
        lines += [f"wrong: {words} {HINT} {hint}" for words, hint in rows]
    if question.kind == GOAL:
        lines.append(f"solve: {question.solve}")
    return lines + [f"hint: {_line(hint)}" for hint in question.hints if hint.strip()]


def _line(text: str) -> str:
    return " ".join(text.split())


def _text(text: str) -> str:
    """Return a text on one line; P2SFError where it holds what parts the texts of a line."""
    if HINT in text or BETWEEN in text:
        raise P2SFError('"{text}" has a bar or two colons, which part answers in a file; write it without', text=text)
    return _line(text).removeprefix(PICKED)
