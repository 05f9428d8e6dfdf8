"""A lesson written from states of the window: what each step changes, in the words of a lesson file. No Qt in here."""

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

from p2sf.errors import P2SFError
from p2sf.lensfile.source_text import write_text
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.compute.setup import default_state, prescription, shipped_names
from p2sf_explorer.lessons.changes import read_changes
from p2sf_explorer.lessons.lesson import ENTRY, PERSONAL, parse_lesson
from p2sf_explorer.state.limits import ADDED
from p2sf_explorer.state.state import ENTRIES, State, entry
from p2sf_explorer.state.terms import TERMS
from p2sf_explorer.state.workspaces import TEACH, WORKSPACES, with_workspace

LEFT_OUT = (
    *PERSONAL,
    "lens",
    "lens_text",
    "pinned",
    "shown",
    "linked",
    "workspace",
    "lesson_name",
    "lesson_step",
    "lesson_told",
    "scale_percent",
    "photo_source",
    "measured_picture",
    "windows",
)
"""Entries that a step does not set: the person's own, B, files, and windows of panels."""
SHORT = re.compile(r"[^a-z0-9]+")


@dataclass(frozen=True)
class RecordedStep:
    """A state of the window with the words of its step."""

    state: State
    title: str
    text: str = ""
    attempt: str = ""


def written_changes(before: State, after: State) -> str:
    """Return what leads from one state to another as a lesson writes it: ``field_deg 10, tab mtf``.

    What a lesson file cannot say is left out (`LEFT_OUT`).
    """
    parts = []
    for name in ENTRIES:
        if name in LEFT_OUT or entry(after, name) == entry(before, name):
            continue
        for part in _written(name, entry(before, name), entry(after, name)):
            if _reads_back(part):
                parts.append(part)
    return ", ".join(parts)


def _written(name: str, old: Any, new: Any) -> list[str]:
    """Return an entry's new value in the words of a lesson."""
    if name == "added_waves":
        pairs = zip(TERMS, old, new, strict=True)
        return [f"{ADDED}{term} {value:.10g}" for term, was, value in pairs if was != value]
    if name == "errors":
        return [f"errors {'+'.join(f'{kind} {a}-{b} {amount:.10g}' for kind, a, b, amount in new) or 'none'}"]
    if isinstance(new, tuple):
        return [f"{name} {'+'.join(_value(item) for item in new) or 'none'}"]
    return [f"{name} {_value(new)}"]


def _value(value: Any) -> str:
    if value is None:
        return "file"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return "inf" if value == inf else f"{value:.10g}"
    return str(value)


def _reads_back(part: str) -> bool:
    """Return whether a lesson file may say this."""
    try:
        read_changes(part, 1, "")
    except P2SFError:
        return False
    return True


def lesson_text(title: str, about: str, steps: Sequence[RecordedStep], lens: str) -> str:
    """Return the text of a lesson file; ``lens`` as its header names it."""
    first = steps[0].state
    before = with_workspace(default_state(first.optics.lens, first.optics.lens_text), TEACH, WORKSPACES[TEACH])
    begun = written_changes(before, first)
    lines = ["---", f"title: {_line(title)}", f"about: {_line(about)}", f"lens: {lens}"]
    lines += [f"state: {begun}"] if begun else []
    lines.append("---")
    last = first
    for step in steps:
        made = written_changes(last, step.state)
        lines += [f"## {_line(step.title)}", *([f"set: {made}"] if made else []), ""]
        lines += [f" {line}" if _means_more(line) else line for line in step.text.splitlines()]
        lines += ["", f"try: {_line(step.attempt)}"] if step.attempt.strip() else []
        lines.append("")
        last = step.state
    return "\n".join(lines).rstrip() + "\n"


def _means_more(line: str) -> bool:
    """Return whether a line of text would be read as a heading, a fence or an entry."""
    return line.startswith(("## ", "---")) or bool(ENTRY.fullmatch(line))


def _line(text: str) -> str:
    return " ".join(text.split())


def save_lesson(title: str, about: str, steps: Sequence[RecordedStep], folder: Path) -> Path:
    """Write a lesson into a folder, beside it its lens where that is edited or not shipped; return its path.

    Steps keep the lens of the first. Raises P2SFError where it has no title or no step, cannot be read again, or cannot
    be written.
    """
    if not _line(title):
        raise P2SFError("the lesson has no title; give it one")
    if not steps:
        raise P2SFError("the lesson has no step; add what is on screen")
    path = _free_path(folder, title)
    first = steps[0].state.optics
    shipped = first.lens_text is None and first.lens in shipped_names()
    lens = first.lens if shipped else path.with_suffix(".toml").name
    text = lesson_text(title, _line(about) or title, steps, lens)
    folder.mkdir(parents=True, exist_ok=True)
    if not shipped:
        write_text(lens_to_toml(prescription(steps[0].state)), path.with_suffix(".toml"))
    try:
        parse_lesson(text, path.stem, str(path))
        write_text(text, path)
    except P2SFError:
        if not shipped:
            path.with_suffix(".toml").unlink(missing_ok=True)
        raise
    return path


def _free_path(folder: Path, title: str) -> Path:
    """Return a path for a lesson of this title, and for its lens beside it, that no file has yet."""
    plain = unicodedata.normalize("NFKD", title.casefold()).encode("ascii", "ignore").decode()
    stem = SHORT.sub("_", plain).strip("_")[:40] or "lesson"
    names = (f"90_{stem}", *(f"90_{stem}_{number}" for number in range(2, 1000)))
    paths = (folder / f"{name}.md" for name in names)
    return next(path for path in paths if not path.exists() and not path.with_suffix(".toml").exists())


def same_lens(steps: Sequence[State]) -> list[State]:
    """Return the states, in their order, that have the lens of the last, each different from the one before."""
    last = steps[-1].optics
    found: list[State] = []
    for state in steps:
        own = (state.optics.lens, state.optics.lens_text) == (last.lens, last.lens_text)
        if own and not (found and not written_changes(found[-1], state)):
            found.append(state)
    return found
