"""Lessons as files a teacher writes: Markdown with a small header, steps that set the window, claims that are checked.

A lesson is one ``.md`` file; ``app/lessons/README.md`` tells its form. No Qt in here.
"""

import re
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from app.changes import beside, changed, fault, read_changes
from app.claims import Claim, parse_claim
from app.limits import DRAGGED
from app.setting import default_state
from app.state import State
from p2sf.errors import P2SFError

FOLDER = Path(__file__).parent / "lessons"
FENCE = "---"
FIRST = State()
PERSONAL = ("theme", "language", "colours")  # a lesson changes the optics and leaves these to whoever sits there
HEADER = ("title", "about", "lens", "state")
STEP = ("set", "move", "try", "ask", "tell", "claim")
ENTRY = re.compile(r"([a-z]+):\s*(.*)")


@dataclass(frozen=True)
class Step:
    """One page: what it sets, which slider to ``move``, its text, a question and its answer, and what it claims."""

    title: str
    changes: tuple[tuple[str, object], ...]
    move: str
    text: str
    attempt: str
    question: str
    answer: str
    claims: tuple[Claim, ...]


@dataclass(frozen=True)
class Lesson:
    """A lesson: its file's stem, title and one sentence about it, the lens and state it begins with, its steps."""

    name: str
    title: str
    about: str
    lens: str
    changes: tuple[tuple[str, object], ...]
    steps: tuple[Step, ...]

    def state(self, number: int, like: State = FIRST) -> State:
        """Return what the window shows at a step (from 0), with the PERSONAL entries of ``like``; P2SFError."""
        made = replace(default_state(self.lens), **{name: getattr(like, name) for name in PERSONAL})
        for step in (self, *self.steps[: number + 1]):
            made = changed(made, step.changes)
        return replace(made, lesson=self.name, lesson_step=number)


@lru_cache(maxsize=1)
def shipped_lessons() -> tuple[Lesson, ...]:
    """Return the lessons of the program's folder in the order of their files' names; a bad one raises P2SFError."""
    return tuple(read_lesson(path) for path in lesson_files())


def own_folder() -> Path:
    """Return where a person keeps lessons of their own beside an installed program."""
    from platformdirs import user_data_path

    return user_data_path("p2sf-explorer", appauthor=False) / "lessons"


def found_lessons(folders: tuple[Path, ...]) -> tuple[dict[str, Lesson], tuple[str, ...]]:
    """Return the lessons of these folders by name, in its order, and a sentence for every file that is none.

    A lesson of a later folder takes the place of one of the same name.
    """
    found, faults = {}, []
    for path in (path for folder in folders for path in lesson_files(folder)):
        try:
            found[path.stem] = read_lesson(path)
        except P2SFError as error:
            faults.append(str(error))
    return dict(sorted(found.items())), tuple(faults)


def lesson_files(folder: Path = FOLDER) -> tuple[Path, ...]:
    """Return the lesson files of a folder, in order."""
    return tuple(sorted(path for path in folder.glob("*.md") if path.name != "README.md"))


def read_lesson(path) -> Lesson:
    """Return the lesson of a file; P2SFError says what is wrong and in which line."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise P2SFError(f"{path} cannot be read ({type(error).__name__}); give a lesson as UTF-8 text") from None
    return parse_lesson(text, Path(path).stem, str(path))


def parse_lesson(text: str, name: str, where: str) -> Lesson:
    """Return the lesson of a file's text; P2SFError names ``where`` and the line."""
    lines = list(enumerate(text.splitlines(), 1))
    if not lines or lines[0][1].strip() != FENCE:
        raise fault(where, 1, f'a lesson begins with a line "{FENCE}"; put title, about and lens below it')
    close = next((n for n, line in lines[1:] if line.strip() == FENCE), None)
    if close is None:
        raise fault(where, 1, f'the header has no end; close it with a line "{FENCE}"')
    header = _header(lines[1 : close - 1], where)
    steps = tuple(_step(part, where) for part in _parts(lines[close:], where))
    if not steps:
        raise fault(where, close, "there is no step; begin one with a line such as ## A point becomes a patch")
    return Lesson(name, *header, steps)


def _header(lines, where: str):
    found = {}
    for number, line in lines:
        entry = ENTRY.fullmatch(line.strip())
        if line.strip() and (not entry or entry[1] not in HEADER):
            raise fault(where, number, f'"{line.strip()}" is no entry of the header; give {", ".join(HEADER)}')
        if entry:
            found[entry[1]] = number, entry[2]
    for name in HEADER[:3]:
        if not found.get(name, (0, ""))[1]:
            raise fault(where, 1, f'the header lacks "{name}"; add a line such as {name}: …')
    changes = read_changes(found["state"][1], found["state"][0], where) if "state" in found else ()
    lens = beside(found["lens"][1], where)
    _check_lens(lens, found["lens"][0], where)
    return found["title"][1], found["about"][1], lens, changes


def _parts(lines, where: str):
    """Return the lines of every step, its heading first."""
    parts: list[list[tuple[int, str]]] = []
    for number, line in lines:
        if line.startswith("## "):
            parts.append([])
        if parts:
            parts[-1].append((number, line))
        elif line.strip():
            raise fault(where, number, "this stands before the first step; begin a step with a line ## and its title")
    return parts


def _step(lines, where: str) -> Step:
    found: dict[str, list[tuple[int, str]]] = {name: [] for name in STEP}
    text, last = [], None
    for number, line in lines[1:]:
        entry = ENTRY.fullmatch(line)
        if entry and entry[1] not in STEP:
            raise fault(where, number, f'"{entry[1]}:" is no entry of a step; give {", ".join(STEP)}')
        if entry:
            last = found[entry[1]]
            last.append((number, entry[2]))
        elif last and line.startswith("  "):
            last[-1] = last[-1][0], f"{last[-1][1]} {line.strip()}"
        else:
            last = None
            text.append(line)
    changes = tuple(change for number, value in found["set"] for change in read_changes(value, number, where))
    words = {name: " ".join(value for _, value in found[name]) for name in ("try", "ask", "tell")}
    if bool(words["ask"]) != bool(words["tell"]):
        raise fault(where, lines[0][0], "a question and its answer go together; give both ask: and tell:")
    move = _move(found["move"], where)
    claims = tuple(_claim(value, number, where) for number, value in found["claim"])
    return Step(lines[0][1][3:].strip(), changes, move, "\n".join(text).strip(), *words.values(), claims)


def _move(found, where: str) -> str:
    for number, value in found:
        if value not in DRAGGED:
            raise fault(where, number, f'"{value}" is no slider; move one of {", ".join(DRAGGED)}')
    return found[-1][1] if found else ""


def _claim(text: str, number: int, where: str) -> Claim:
    try:
        return parse_claim(text, lambda inner: read_changes(inner, number, where))
    except P2SFError as error:
        raise error if str(error).startswith(where) else fault(where, number, str(error)) from None


def _check_lens(name: str, number: int, where: str) -> None:
    try:
        default_state(name)
    except P2SFError as error:
        raise fault(where, number, str(error)) from None
