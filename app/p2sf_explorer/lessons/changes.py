"""Changes of the state as a lesson writes them: ``field_deg 10, tab mtf``. No Qt in here."""

from math import inf
from pathlib import Path
from typing import Any, cast

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf.tolerance.errors_of_build import Kind
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.state.build_errors import BuildError
from p2sf_explorer.state.limits import ADDED, LISTED, PLAIN
from p2sf_explorer.state.state import ENTRIES, State, change, entry
from p2sf_explorer.state.state_files import present_name
from p2sf_explorer.state.terms import TERMS

NUMBERS: dict[str, float | None] = {"∞": inf, "inf": inf, "file": None, "whole": None}
TRUTH = {"yes": True, "no": False}

Changes = tuple[tuple[str, Any], ...]


def apply_changes(state: State, changes: Changes) -> State:
    """Return the state with (name, value) changes made; another lens brings its own defaults."""
    for name, value in changes:
        if name == "lens":
            state = with_lens(state, value)
        elif name.startswith(ADDED) and name != "added_waves":
            waves = list(state.what_if.added_waves)
            waves[TERMS.index(name.removeprefix(ADDED))] = value
            state = change(state, added_waves=tuple(waves))
        else:
            state = change(state, **{name: value})
    return state


def read_changes(text: str, number: int, where: str) -> Changes:
    """Return the changes of entries such as ``field_deg 10, tab mtf``; P2SFError names ``where`` and the line."""
    made = []
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, _, word = part.partition(" ")
        name = present_name(name)  # lessons of version 0.1 go on
        try:
            value = beside(word.strip(), where) if name == "lens" else _value(name, word.strip())
            apply_changes(State(), ((name, value),))
        except P2SFError as error:
            raise fault(where, number, error.message) from None
        made.append((name, value))
    return tuple(made)


def _value(name: str, word: str) -> object:
    default = State()  # made once: to check its entries takes longer than to read the rest of a lesson
    known = {name: entry(default, name) for name in ENTRIES}
    known |= {ADDED + term: 0.0 for term in TERMS}
    if name not in known or not word:
        raise P2SFError('"{entry}" sets nothing; write entries such as field_deg 10, tab mtf', entry=f"{name} {word}")
    if name == "errors":
        return () if word == "none" else tuple(_error(one) for one in word.split("+"))
    if name == "held_scales":
        return () if word == "none" else tuple(_held(one) for one in word.split("+"))
    if isinstance(known[name], bool):
        return TRUTH.get(word, word)
    if isinstance(known[name], tuple):
        parts = () if word == "none" else tuple(word.split("+"))
        return tuple(map(float, parts)) if name in LISTED else parts
    if isinstance(known[name], str) or name == "lens_text":
        return "" if word == "none" and known[name] == "" else word
    try:
        return NUMBERS[word] if word in NUMBERS else (int if PLAIN.get(name) is int else float)(word)
    except ValueError:
        raise P2SFError('{name} is "{word}"; give a number', name=name, word=word) from None


def _held(text: str) -> tuple[str, float]:
    """Return a panel and the end of its axes."""
    try:
        panel, end = text.split()
        return panel, float(end)  # the state checks both
    except ValueError:
        raise P2SFError('"{text}" is not a scale to hold; write for example psf 30', text=text) from None


def _error(text: str) -> BuildError:
    """Return an error of the build: its kind, its surface or surfaces such as 3-4, and its amount."""
    try:
        kind, span, amount = text.split()
        first, _, last = span.partition("-")
        return cast(Kind, kind), int(first), int(last or first), float(amount)  # the state checks the kind
    except ValueError:
        raise P2SFError(
            '"{text}" is not an error of a build; write for example decentre_y 3-4 0.2', text=text
        ) from None


class LessonError(P2SFError):
    """A lesson that cannot be read; the message begins with its file and line."""


def fault(where: str, line: int, template: str | Message, /, **values: object) -> LessonError:
    """Return the error that says what is wrong in a line of a lesson, as a template with values or a message."""
    message = template if isinstance(template, Message) else Message(template, **values)
    return LessonError("{path}, line {line}: {message}", path=where, line=line, message=message)


def beside(name: str, where: str) -> str:
    """Return the path of a lens file beside the lesson; the name of a shipped lens as it is."""
    path = Path(where).parent / name
    return str(path.resolve()) if path.suffix and path.is_file() else name
