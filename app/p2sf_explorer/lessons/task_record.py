"""How far a person has got with the tasks, and the file of results that is handed in. No Qt in here.

The same file keeps progress between starts and goes to the lecturer; nothing in it says whose it is but the name that
the person types.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from math import isfinite
from pathlib import Path
from typing import Any

from p2sf.errors import ExportError
from p2sf.files.reading import parse_json, read_text
from p2sf.files.reasons import reason
from p2sf.files.writing import write_json
from p2sf.messages import Message
from p2sf.version import program_version

FORMAT = 1  # of the file
MARK = "p2sf_course"
MOST_BYTES, MOST_TASKS, MOST_ANSWERS, LONGEST = 2_000_000, 2_000, 200, 200
JOINT = "/"  # between lecture and task


@dataclass(frozen=True)
class TaskRecord:
    """What was answered to one task, first to last, hints and solution that were shown, the time it took, and why."""

    answers: tuple[str, ...] = ()
    hints: int = 0
    right: bool = False
    told: bool = False
    seconds: float = 0.0
    because: str = ""  # why, in the person's own words

    @property
    def attempts(self) -> int:
        """Return how often it was answered."""
        return len(self.answers)

    def with_answer(self, text: str, right: bool) -> "TaskRecord":
        """Return the record after one more answer; one that comes after the solution is no longer right by itself."""
        answers = (*self.answers, text[:LONGEST])[-MOST_ANSWERS:]
        return replace(self, answers=answers, right=self.right or (right and not self.told))


@dataclass(frozen=True)
class CourseResult:
    """The results of one person: versions of program and course, and records by "lecture/task"."""

    name: str = ""
    program: str = field(default_factory=program_version)
    course: str = ""
    language: str = "en"
    tasks: Mapping[str, TaskRecord] = field(default_factory=dict)

    def record(self, lecture: str, task: str) -> TaskRecord:
        """Return the record of a task, an empty one for a task that was never tried."""
        return self.tasks.get(f"{lecture}{JOINT}{task}", TaskRecord())

    def with_record(self, lecture: str, task: str, record: TaskRecord) -> "CourseResult":
        """Return the results with the record of one task replaced."""
        return replace(self, tasks={**self.tasks, f"{lecture}{JOINT}{task}": record})


def write_result(path: Path, result: CourseResult) -> None:
    """Write the file of results whole; ExportError."""
    tasks = {key: asdict(record) | {"attempts": record.attempts} for key, record in result.tasks.items()}
    write_json(path, {MARK: FORMAT, **asdict(replace(result, tasks={})), "tasks": tasks})


def read_result(path: Path) -> CourseResult:
    """Return the results in a file; ExportError names the file and says what is wrong with it."""
    try:
        content = parse_json(read_text(path, MOST_BYTES))
    except OSError as error:
        raise _unreadable(path, reason(error)) from None
    except ValueError:
        raise _unreadable(path, Message("it is damaged")) from None
    if not isinstance(content, dict) or MARK not in content:
        raise _unreadable(path, Message("it holds no results of the course"))
    if content[MARK] != FORMAT:
        raise _unreadable(path, Message("it was written by another version of the program"))
    try:
        return _result(content)
    except (ValueError, OverflowError) as error:
        raise _unreadable(path, Message("its entry {entry} is damaged", entry=str(error))) from None


def _unreadable(path: Path, why: Message | str) -> ExportError:
    return ExportError("{path} cannot be read: {why}", path=path.name, why=why)


def _result(content: dict[str, Any]) -> CourseResult:
    texts = {name: _entry(content, name, str) for name in ("name", "program", "course", "language")}
    tasks = _entry(content, "tasks", dict)
    if len(tasks) > MOST_TASKS:
        raise ValueError("tasks")
    return CourseResult(**{name: _printable(text) for name, text in texts.items()}, tasks={
        _printable(key): _record(record, key) for key, record in tasks.items()
    })  # fmt: skip


def _printable(text: str) -> str:
    """Return the first LONGEST characters, spaces for those by which a file could steer a terminal."""
    return "".join(letter if letter.isprintable() else " " for letter in text[:LONGEST])


def _record(content: object, key: str) -> TaskRecord:
    if not isinstance(content, dict):
        raise ValueError(key)
    answers, hints = _entry(content, "answers", list), _entry(content, "hints", int)
    seconds = content.get("seconds")
    if not all(isinstance(answer, str) for answer in answers) or len(answers) > MOST_ANSWERS or hints < 0:
        raise ValueError(key)
    if not isinstance(seconds, int | float) or isinstance(seconds, bool) or not isfinite(seconds) or seconds < 0:
        raise ValueError(f"{key} seconds")
    right, told = (_entry(content, name, bool) for name in ("right", "told"))
    because = content.get("because", "")  # files of version 0.3 have none
    if not isinstance(because, str):
        raise ValueError(f"{key} because")
    return TaskRecord(tuple(map(_printable, answers)), hints, right, told, float(seconds), _printable(because))


def _entry(content: dict[str, Any], name: str, kind: type) -> Any:
    """Return an entry of the right kind; ValueError names one that is missing or of another."""
    value = content.get(name)
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        raise ValueError(name)
    return value
