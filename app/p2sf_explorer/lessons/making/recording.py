"""A lesson written from states of the window: what each step changes, in the words of a lesson file. No Qt in here."""

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, count
from math import inf
from pathlib import Path
from typing import Any

from p2sf.errors import P2SFError
from p2sf.lensfile.source_text import write_text
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.compute.setup import default_state, prescription, shipped_names, with_lens
from p2sf_explorer.compute.views.depths import FLAT, SLOPE, STEPS
from p2sf_explorer.lessons.changes import read_changes
from p2sf_explorer.lessons.lesson import ENGLISH, ENTRY, PERSONAL, parse_lesson
from p2sf_explorer.lessons.making.questions import Question, question_lines
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
RAIL, BRINGS_RAIL = "show_rail", ("rail ", "tab ")  # an entry, and those that show what it hides (`Lesson.state`)
SHORT = re.compile(r"[^a-z0-9]+")


LensOfStep = tuple[str, str | None]
"""The lens of a state: its name or path, and its text where it is edited."""


@dataclass(frozen=True)
class RecordedStep:
    """A state of the window with the words of its step, and its question."""

    state: State
    title: str
    text: str = ""
    attempt: str = ""
    question: Question = field(default_factory=Question)


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
    if not after.display.show_rail and any(part.startswith(BRINGS_RAIL) for part in parts):
        parts = [*(part for part in parts if not part.startswith(RAIL)), f"{RAIL} no"]
    return ", ".join(parts)


def _written(name: str, old: Any, new: Any) -> list[str]:
    """Return an entry's new value in the words of a lesson."""
    if name == "added_waves":
        pairs = zip(TERMS, old, new, strict=True)
        return [f"{ADDED}{term} {value:.10g}" for term, was, value in pairs if was != value]
    if name == "errors":
        return [f"errors {'+'.join(f'{kind} {a}-{b} {amount:.10g}' for kind, a, b, amount in new) or 'none'}"]
    if name == "held_scales":
        return [f"{name} {'+'.join(f'{panel} {end:.10g}' for panel, end in new) or 'none'}"]
    if isinstance(new, tuple):
        return [f"{name} {'+'.join(_value(item) for item in new) or 'none'}"]
    if name == "photo_depths" and new not in (FLAT, SLOPE, STEPS):
        return []  # a file, as `LEFT_OUT` has them
    return [f"{name} {_value(new)}"]


def _value(value: Any) -> str:
    if value is None:
        return "file"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return "inf" if value == inf else f"{value:.10g}"
    return str(value) or "none"


def _reads_back(part: str) -> bool:
    """Return whether a lesson file may say this."""
    try:
        read_changes(part, 1, "")
    except P2SFError:
        return False
    return True


def lesson_text(
    title: str, about: str, steps: Sequence[RecordedStep], lenses: Mapping[LensOfStep, str], language: str = ENGLISH
) -> str:
    """Return the text of a lesson file; ``lenses`` as it names them, by those of the steps."""
    first = steps[0].state
    before = with_workspace(default_state(*lens_of(first)), TEACH, WORKSPACES[TEACH])
    begun = written_changes(before, first)
    lines = ["---", f"title: {_line(title)}", f"about: {_line(about)}", f"lens: {lenses[lens_of(first)]}"]
    lines += [f"language: {language}"] if language != ENGLISH else []
    lines += [f"state: {begun}"] if begun else []
    lines.append("---")
    last = first
    for number, step in enumerate(steps, 1):
        parts = []
        if lens_of(step.state) != lens_of(last):
            last = with_lens(last, *lens_of(step.state))
            parts.append(f"lens {lenses[lens_of(step.state)]}")
        made = ", ".join(filter(None, (*parts, written_changes(last, step.state))))
        lines += [f"## {_line(step.title)}", *([f"set: {made}"] if made else []), ""]
        lines += [f" {line}" if _means_more(line) else line for line in step.text.splitlines()]
        lines += ["", f"try: {_line(step.attempt)}"] if step.attempt.strip() else []
        lines += question_lines(step.question, f"{_plain_name(title)[:30] or 'task'}-{number}".replace("_", "-"))
        lines.append("")
        last = step.state
    return "\n".join(lines).rstrip() + "\n"


def lens_of(state: State) -> LensOfStep:
    """Return the lens of a state."""
    return state.optics.lens, state.optics.lens_text


def _means_more(line: str) -> bool:
    """Return whether a line of text would be read as a heading, a fence or an entry."""
    return line.startswith(("## ", "---")) or bool(ENTRY.fullmatch(line))


def _line(text: str) -> str:
    return " ".join(text.split())


def save_lesson(title: str, about: str, steps: Sequence[RecordedStep], folder: Path, language: str = ENGLISH) -> Path:
    """Write a lesson into a folder, beside it its lenses that are edited or not shipped; return its path.

    ``language``: of its words.

    Raises P2SFError where it has no title or no step, cannot be read again, or cannot be written.
    """
    if not _line(title):
        raise P2SFError("the lesson has no title; give it one")
    if not steps:
        raise P2SFError("the lesson has no step; add what is on screen")
    path = _free_path(folder, title)
    states = {lens_of(step.state): step.state for step in reversed(steps)}
    own = [lens for lens in reversed(states) if lens[1] is not None or lens[0] not in shipped_names()]
    files = dict(zip(own, _free_lens_paths(path), strict=False))
    lenses = {lens: files[lens].name if lens in files else lens[0] for lens in states}
    text = lesson_text(title, _line(about) or title, steps, lenses, language)
    folder.mkdir(parents=True, exist_ok=True)
    try:
        for lens, file in files.items():
            write_text(lens_to_toml(prescription(states[lens])), file)
        parse_lesson(text, path.stem, str(path))
        write_text(text, path)
    except P2SFError:
        for file in files.values():
            file.unlink(missing_ok=True)
        raise
    return path


def _free_lens_paths(path: Path) -> Iterator[Path]:
    """Yield paths for the lenses of a lesson, beside it, that no file has yet."""
    names = chain((path.stem,), (f"{path.stem}_lens_{number}" for number in count(2)))
    return (found for name in names if not (found := path.with_name(f"{name}.toml")).exists())


def _free_path(folder: Path, title: str) -> Path:
    """Return a path for a lesson of this title, and for its lens beside it, that no file has yet."""
    stem = _plain_name(title) or "lesson"
    names = (f"90_{stem}", *(f"90_{stem}_{number}" for number in range(2, 1000)))
    paths = (folder / f"{name}.md" for name in names)
    return next(path for path in paths if not path.exists() and not path.with_suffix(".toml").exists())


def _plain_name(title: str) -> str:
    """Return a title in small letters, digits and underscores."""
    plain = unicodedata.normalize("NFKD", title.casefold()).encode("ascii", "ignore").decode()
    return SHORT.sub("_", plain).strip("_")[:40].strip("_")


def same_lens(steps: Sequence[State]) -> list[State]:
    """Return the states, in their order, that have the lens of the last, each different from the one before."""
    found: list[State] = []
    for state in steps:
        if lens_of(state) == lens_of(steps[-1]) and not (found and not written_changes(found[-1], state)):
            found.append(state)
    return found
