"""Lessons as files a teacher writes: Markdown with a small header, steps that set the window, claims that are checked.

A lesson is one ``.md`` file; the ``README.md`` of this folder describes the format. No Qt in here.
"""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from p2sf.errors import P2SFError
from p2sf.files.reading import read_text
from p2sf.files.reasons import reason
from p2sf.messages import Message
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.lessons.changes import Changes, LessonError, apply_changes, beside, fault, read_changes
from p2sf_explorer.lessons.claims import Claim, parse_claim
from p2sf_explorer.lessons.task import Exercise
from p2sf_explorer.lessons.task_parsing import TASK, TASK_WORDS, parse_task, parse_words
from p2sf_explorer.state.limits import SLIDERS
from p2sf_explorer.state.state import State, change, entry
from p2sf_explorer.state.workspaces import TEACH, WORKSPACES, with_workspace

FOLDER = Path(__file__).parent
FENCE = "---"
FIRST = State()
PERSONAL = (
    "theme",
    "language",
    "colours",
    "scale_percent",
    "show_more",
)  # a lesson changes the optics and leaves these to whoever sits there
MOST_BYTES, LONGEST_LINE = 1_000_000, 2000  # letters; what patterns cost grows with the square of a line
HEADER = ("title", "about", "lens", "state", "language", "lesson")
WORDS = ("try", "ask", "tell", "note")
STEP = ("set", "move", *WORDS, "claim", *TASK)
ENGLISH = "en"
ENTRY = re.compile(r"([a-z]+):\s*(.*)")

# Names begin with the number under which a lesson was written, which links keep; this is the order to learn in.
COURSE = "01 02 17 18 03 21 04 09 05 19 06 20 07 08 10 13 14 16".split()
APPENDIX = "11 12 15".split()
NUMBER = re.compile(r"\d+(?=_)")

Lines = list[tuple[int, str]]
"""Lines of a file with their numbers, from 1."""


@dataclass(frozen=True)
class Step:
    """One page: what it sets, which slider to ``move``, its text, a question and its answer, and what it claims.

    ``note`` is for who teaches; with a ``task`` the question is graded.
    """

    title: str
    changes: Changes
    move: str
    text: str
    attempt: str
    question: str
    answer: str
    claims: tuple[Claim, ...]
    note: str = ""
    task: Exercise | None = None


@dataclass(frozen=True)
class Lesson:
    """A lesson: its file's stem, title and one sentence about it, the lens and state it begins with, its steps.

    A lecture plays other ``lessons``, by their names. ``attempts`` is how many answers a task takes, 0 for any number;
    a ``silent`` lesson notes answers and tells nothing of them.
    """

    name: str
    title: str
    about: str
    lens: str
    changes: Changes
    steps: tuple[Step, ...]
    language: str = ENGLISH  # of its words
    lessons: tuple[str, ...] = ()
    attempts: int = 0
    silent: bool = False

    def state(self, number: int, like: State = FIRST) -> State:
        """Return the state at a step (from 0), with the PERSONAL entries of ``like``; P2SFError where there is none."""
        made = change(default_state(self.lens), **{name: entry(like, name) for name in PERSONAL})
        made = with_workspace(made, TEACH, WORKSPACES[TEACH])
        for changes in (self.changes, *(step.changes for step in self.steps[: number + 1])):
            shown = {"show_rail": True} if {"rail", "tab"} & {name for name, _ in changes} else {}
            made = apply_changes(change(made, **shown), changes)
        return change(made, lesson_name=self.name, lesson_step=number)


@lru_cache(maxsize=1)
def shipped_lessons() -> tuple[Lesson, ...]:
    """Return the lessons of the program's folder in the order of the course; a bad one raises P2SFError."""
    return tuple(read_lesson(path) for path in lesson_files())


def place_in_course(name: str) -> tuple[int, str]:
    """Return what lessons are sorted by: those of `COURSE`, then those of `APPENDIX`, then others by their names."""
    order = COURSE + APPENDIX
    number = NUMBER.match(name)
    return (order.index(number[0]) if number and number[0] in order else len(order)), name


def own_folder() -> Path:
    """Return where a person keeps lessons of their own beside an installed program."""
    from platformdirs import user_data_path

    return user_data_path("p2sf-explorer", appauthor=False) / "lessons"


def found_lessons(
    folders: tuple[Path, ...], language: str = ENGLISH
) -> tuple[dict[str, Lesson], tuple[P2SFError, ...]]:
    """Return the lessons of these folders by name, in the order of the course, and the errors of files that are none.

    A lesson of a later folder replaces one of the same name. Its text is taken from the file of the same name in the
    folder ``language`` beside it, where there is one.
    """
    found: dict[str, Lesson] = {}
    faults: list[P2SFError] = []
    for path in (path for folder in folders for path in lesson_files(folder)):
        try:
            found[path.stem] = read_lesson(path)
            words = path.parent / language / path.name
            if language != ENGLISH and words.is_file():
                found[path.stem] = with_words(found[path.stem], words, language)
        except P2SFError as error:
            faults.append(error)
    return {name: found[name] for name in sorted(found, key=place_in_course)}, tuple(faults)


def lesson_files(folder: Path = FOLDER) -> tuple[Path, ...]:
    """Return the lesson files of a folder, in order."""
    found = (path for path in folder.glob("*.md") if path.name != "README.md")
    return tuple(sorted(found, key=lambda path: place_in_course(path.stem)))


def read_lesson(path: str | os.PathLike[str]) -> Lesson:
    """Return the lesson of a file; P2SFError says what is wrong and in which line."""
    return parse_lesson(_text(path), Path(path).stem, str(path))


def _text(path: str | os.PathLike[str]) -> str:
    try:
        text = read_text(path, MOST_BYTES)
    except (OSError, UnicodeDecodeError) as error:
        raise P2SFError(
            "{path} cannot be read ({why}); give a lesson as UTF-8 text", path=str(path), why=reason(error)
        ) from None
    long = next((n for n, line in enumerate(text.split("\n"), 1) if len(line) > LONGEST_LINE), 0)
    if long:
        raise fault(str(path), long, "the line has over {count} letters; break it", count=LONGEST_LINE)
    return text


def with_words(lesson: Lesson, path: str | os.PathLike[str], language: str) -> Lesson:
    """Return a lesson with the text of a file in another language; its changes, sliders and claims stay.

    P2SFError for a file with another number of steps, or with more than text in it.
    """
    where = str(path)
    head, body = _halves(_text(path), where)
    found = {name: text for name, (_, text) in _entries(head, where, HEADER[:2]).items()}
    parts = _parts(body, where)
    if len(parts) != len(lesson.steps):
        one, many = Message("there is 1 step"), Message("there are {count} steps", count=len(parts))
        raise fault(
            where,
            1,
            "{there} of words, and the lesson has {count}; say each in its place",
            there=one if len(parts) == 1 else many,
            count=len(lesson.steps),
        )
    steps = tuple(_with_words(old, part, where) for old, part in zip(lesson.steps, parts, strict=True))
    return replace(lesson, title=found["title"], about=found["about"], steps=steps, language=language)


def _with_words(step: Step, lines: Lines, where: str) -> Step:
    """Return a step with the texts of its lines in another language."""
    found, text = _entries_of_step(lines, where, (*WORDS, *TASK_WORDS))
    attempt, question, answer, note = _words(found, lines[0][0], where)
    return replace(
        step,
        title=lines[0][1][3:].strip(),
        text=text,
        attempt=attempt,
        question=question,
        answer=answer,
        note=note,
        task=_task_with_words(step.task, found, lines[0][0], where),
    )


def _task_with_words(task: Exercise | None, found: dict[str, Lines], number: int, where: str) -> Exercise | None:
    name, words = parse_words(found)
    if name != (task.name if task else ""):
        wanted = task.name if task else Message("none")
        raise fault(where, number, 'the task of this step is "{wanted}"; name the same', wanted=wanted)
    if task and words.shape != task.words.shape:
        raise fault(where, number, "the task has other options or hints than its original; say each in its place")
    return task and task.with_words(words)


def parse_lesson(text: str, name: str, where: str) -> Lesson:
    """Return the lesson of a file's text; P2SFError names ``where`` and the line."""
    head, body = _halves(text, where)
    header = _header(head, name, where)
    steps = tuple(_step(part, where) for part in _parts(body, where))
    if not steps:
        raise fault(
            where, head[-1][0] + 1, "there is no step; begin one with a line such as ## A point becomes a patch"
        )
    return replace(header, steps=steps)


def _halves(text: str, where: str) -> tuple[Lines, Lines]:
    """Return the numbered lines of the header, and those below it."""
    lines = list(enumerate(text.splitlines(), 1))
    if not lines or lines[0][1].strip() != FENCE:
        raise fault(where, 1, 'a lesson begins with a line "{fence}"; put title, about and lens below it', fence=FENCE)
    close = next((n for n, line in lines[1:] if line.strip() == FENCE), None)
    if close is None:
        raise fault(where, 1, 'the header has no end; close it with a line "{fence}"', fence=FENCE)
    return lines[1 : close - 1], lines[close:]


def _entries(lines: Lines, where: str, allowed: tuple[str, ...]) -> dict[str, tuple[int, str]]:
    """Return the line number and text of every entry of a header."""
    found: dict[str, tuple[int, str]] = {}
    for number, line in lines:
        entry = ENTRY.fullmatch(line.strip())
        if line.strip() and (not entry or entry[1] not in allowed):
            raise fault(
                where, number, '"{line}" is not an entry of the header; give {names}', line=line.strip(), names=allowed
            )
        if entry:
            found[entry[1]] = number, entry[2]
    for name in allowed[:3]:
        if not found.get(name, (0, ""))[1]:
            raise fault(where, 1, 'the header lacks "{name}"; add a line such as {name}: …', name=name)
    return found


def _header(lines: Lines, name: str, where: str) -> Lesson:
    """Return what the header says of a lesson, without steps."""
    found = _entries(lines, where, HEADER)
    changes = read_changes(found["state"][1], found["state"][0], where) if "state" in found else ()
    lens = beside(found["lens"][1], where)
    _check_lens(lens, found["lens"][0], where)
    lessons = tuple(filter(None, (part.strip() for part in found.get("lesson", (0, ""))[1].split(","))))
    language = found.get("language", (0, ENGLISH))[1]
    return Lesson(name, found["title"][1], found["about"][1], lens, changes, (), language, lessons=lessons)


def _parts(lines: Lines, where: str) -> list[Lines]:
    """Return the lines of every step, its heading first."""
    parts: list[Lines] = []
    for number, line in lines:
        if line.startswith("## "):
            parts.append([])
        if parts:
            parts[-1].append((number, line))
        elif line.strip():
            raise fault(where, number, "this stands before the first step; begin a step with a line ## and its title")
    return parts


def _step(lines: Lines, where: str) -> Step:
    found, text = _entries_of_step(lines, where, STEP)
    changes = tuple(change for number, value in found["set"] for change in read_changes(value, number, where))
    attempt, question, answer, note = _words(found, lines[0][0], where)
    claims = tuple(_claim(value, number, where) for number, value in found["claim"])
    move, task = _move(found["move"], where), parse_task(found, where)
    if task and not question:
        raise fault(where, found["task"][0][0], "a task has no question; give both ask: and tell:")
    return Step(lines[0][1][3:].strip(), changes, move, text, attempt, question, answer, claims, note, task)


def _entries_of_step(lines: Lines, where: str, allowed: tuple[str, ...]) -> tuple[dict[str, Lines], str]:
    """Return the lines of every entry of a step, and the text between them."""
    found: dict[str, Lines] = {name: [] for name in STEP}
    text: list[str] = []
    last: Lines | None = None
    for number, line in lines[1:]:
        entry = ENTRY.fullmatch(line)
        if entry and entry[1] not in allowed:
            raise fault(
                where, number, '"{name}:" is not an entry of a step here; give {names}', name=entry[1], names=allowed
            )
        if entry:
            last = found[entry[1]]
            last.append((number, entry[2]))
        elif last and line.startswith("  "):
            last[-1] = last[-1][0], f"{last[-1][1]} {line.strip()}"
        else:
            last = None
            text.append(line)
    return found, "\n".join(text).strip()


def _words(found: dict[str, Lines], number: int, where: str) -> tuple[str, str, str, str]:
    """Return what to try, a question, its answer, and a note to who teaches."""
    attempt, question, answer, note = (" ".join(value for _, value in found[name]) for name in WORDS)
    if bool(question) != bool(answer):
        raise fault(where, number, "a question and its answer go together; give both ask: and tell:")
    return attempt, question, answer, note


def _move(found: Sequence[tuple[int, str]], where: str) -> str:
    for number, value in found:
        if value not in SLIDERS:
            raise fault(where, number, '"{name}" is not a slider; move one of {names}', name=value, names=SLIDERS)
    return found[-1][1] if found else ""


def _claim(text: str, number: int, where: str) -> Claim:
    try:
        return parse_claim(text, lambda inner: read_changes(inner, number, where))
    except LessonError:
        raise
    except P2SFError as error:
        raise fault(where, number, error.message) from None


def _check_lens(name: str, number: int, where: str) -> None:
    try:
        default_state(name)
    except P2SFError as error:
        raise fault(where, number, error.message) from None
