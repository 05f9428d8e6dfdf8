"""Changes of the state as a person writes them in a lesson: ``field_deg 10, tab mtf``. No Qt in here."""

from dataclasses import fields, replace
from math import inf
from pathlib import Path

from p2sf.errors import P2SFError
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.state.limits import ADDED
from p2sf_explorer.state.state import State
from p2sf_explorer.state.terms import TERMS

NUMBERS = {"∞": inf, "inf": inf, "file": None, "whole": None}
TRUTH = {"yes": True, "no": False}

Changes = tuple[tuple[str, object], ...]


def changed(state: State, changes: Changes) -> State:
    """Return the state with (name, value) changes made; another lens brings its own defaults."""
    for name, value in changes:
        if name == "lens":
            state = with_lens(state, value)
        elif name.startswith(ADDED) and name != "added_waves":
            waves = list(state.added_waves)
            waves[TERMS.index(name.removeprefix(ADDED))] = value
            state = replace(state, added_waves=tuple(waves))
        else:
            state = replace(state, **{name: value})
    return state


def read_changes(text: str, number: int, where: str) -> Changes:
    """Return the changes of entries such as ``field_deg 10, tab mtf``; P2SFError names ``where`` and the line."""
    made = []
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, _, word = part.partition(" ")
        try:
            value = beside(word.strip(), where) if name == "lens" else _value(name, word.strip())
            changed(State(), ((name, value),))
        except P2SFError as error:
            raise fault(where, number, str(error)) from None
        made.append((name, value))
    return tuple(made)


def _value(name: str, word: str):
    bare = State()  # made once: checking its entries takes longer than all the rest of a lesson
    known = {field.name: getattr(bare, field.name) for field in fields(State)}
    known |= {ADDED + term: 0.0 for term in TERMS}
    if name not in known or not word:
        raise P2SFError(f'"{name} {word}" sets nothing; write entries such as field_deg 10, tab mtf')
    if isinstance(known[name], bool):
        return TRUTH.get(word, word)
    if isinstance(known[name], tuple):
        return () if word == "none" else tuple(word.split("+"))
    if isinstance(known[name], str) or name == "lens_text":
        return word
    try:
        return NUMBERS[word] if word in NUMBERS else float(word)
    except ValueError:
        raise P2SFError(f'{name} is "{word}"; give a number') from None


def fault(where: str, line: int, sentence: str) -> P2SFError:
    """Return the error that says what is wrong with a lesson, and in which line."""
    return P2SFError(f"{where}, line {line}: {sentence}")


def beside(name: str, where: str) -> str:
    """Return the path of a lens file that stands beside the lesson, else the name of a shipped lens as it is."""
    path = Path(where).parent / name
    return str(path.resolve()) if path.suffix and path.is_file() else name
