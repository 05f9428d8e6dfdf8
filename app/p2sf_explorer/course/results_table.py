"""A folder of result files as a table of students and tasks. No Qt in here."""

import csv
import io
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from p2sf.errors import ExportError, P2SFError
from p2sf.files.writing import write_beside
from p2sf_explorer.course.lectures import AFTER, BEFORE
from p2sf_explorer.lessons.task_record import JOINT, CourseResult, TaskRecord, read_result

FORMULA = ("=", "+", "-", "@", "\t", "\r")  # with which a spreadsheet begins a formula
PERSON = ("name", "file", "program", "course", "language")
OF_TASK = ("right", "attempts", "hints", "solution shown", "seconds", "last answer", "because")


@dataclass(frozen=True)
class TaskSummary:
    """Of all who tried a task: how many, the share that got it right, and the commonest first wrong answers.

    ``wrong`` are answers with how many people gave them first.
    """

    count: int
    share_right: float
    wrong: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Gain:
    """Mean shares right in the concept check before and after the course, of ``count`` people who took both."""

    count: int
    before: float
    after: float

    @property
    def share_gained(self) -> float:
        """Return the share of what was not right before that is right after (Hake 1998, Am. J. Phys. 66, 64)."""
        return (self.after - self.before) / (1 - self.before) if self.before < 1 else 0.0


@dataclass(frozen=True)
class ResultTable:
    """Files with the results in them, in the order of names, the tasks of the columns, and the files left out."""

    rows: tuple[tuple[Path, CourseResult], ...]
    tasks: tuple[str, ...]
    faults: tuple[P2SFError, ...]

    def summary(self, task: str) -> TaskSummary:
        """Return what a class makes of one task."""
        records = [result.tasks[task] for _, result in self.rows if task in result.tasks and result.tasks[task].answers]
        first_wrong = Counter(record.answers[0] for record in records if not (record.right and record.attempts == 1))
        share = sum(record.right for record in records) / len(records) if records else 0.0
        return TaskSummary(len(records), share, tuple(first_wrong.most_common(3)))


def concept_gain(table: ResultTable) -> Gain | None:
    """Return what a class gains in the concept check, None where nobody took it twice.

    Of each person the questions count that were answered both times.
    """
    shares = []
    for _, result in table.rows:
        names = (task.partition(JOINT)[2] for task in result.tasks if task.startswith(f"{BEFORE}{JOINT}"))
        pairs = [(result.record(BEFORE, name), result.record(AFTER, name)) for name in names]
        both = [(before.right, after.right) for before, after in pairs if before.answers and after.answers]
        if both:
            shares.append([sum(column) / len(both) for column in zip(*both, strict=True)])
    if not shares:
        return None
    before, after = (sum(column) / len(shares) for column in zip(*shares, strict=True))
    return Gain(len(shares), before, after)


def item_gains(table: ResultTable) -> dict[str, Gain]:
    """Return what a class gains in each item of the concept check, of those who answered both of its forms."""
    names = dict.fromkeys(
        name for task in table.tasks for lesson, _, name in [task.partition(JOINT)] if lesson == BEFORE
    )
    gains = {}
    for name in names:
        pairs = [(result.record(BEFORE, name), result.record(AFTER, name)) for _, result in table.rows]
        both = [(before.right, after.right) for before, after in pairs if before.answers and after.answers]
        if both:
            before, after = (sum(column) / len(both) for column in zip(*both, strict=True))
            gains[name] = Gain(len(both), before, after)
    return gains


def sure_but_wrong(table: ResultTable, name: str) -> tuple[int, int]:
    """Return how many were wrong in an item and rather sure of it, before the course and after.

    A wrong answer that somebody is sure of is a misconception, and not a gap.
    """

    def count(lesson: str) -> int:
        records = [result.record(lesson, name) for _, result in table.rows]
        return sum(not one.right and one.answers[0].split()[2:] > ["2"] for one in records if one.answers)

    return count(BEFORE), count(AFTER)


def read_folder(folder: Path, known: Sequence[tuple[str, str]] = ()) -> ResultTable:
    """Return the table of a folder's .json files; ExportError where there is no such folder, or no results in it.

    Columns are the ``known`` tasks, (lecture, task), that anybody tried, in their order, then others. A file that
    cannot be read is among the faults.
    """
    if not folder.is_dir():
        raise ExportError("{path} is no folder; choose the one that holds the files of results", path=str(folder))
    rows, faults = [], []
    for path in sorted(folder.glob("*.json")):
        try:
            rows.append((path, read_result(path)))
        except P2SFError as error:
            faults.append(error)
    if not rows and not faults:
        raise ExportError("{path} holds no files of results (.json)", path=str(folder))
    rows.sort(key=lambda row: (row[1].name.casefold(), row[0].name))
    tried = dict.fromkeys(key for _, result in rows for key in result.tasks)
    ordered = [key for lecture, task in known if (key := f"{lecture}{JOINT}{task}") in tried]
    return ResultTable(tuple(rows), tuple(dict.fromkeys((*ordered, *tried))), tuple(faults))


def write_table(table: ResultTable, path: Path) -> Path:
    """Write the table as CSV, one row a file, `OF_TASK` of each task; ExportError."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    heads = (_plain_text(f"{task} {part}") for task in table.tasks for part in OF_TASK)
    rows.writerow((*PERSON, "right in all", *heads))
    for file, result in table.rows:
        person = (result.name, file.name, result.program, result.course, result.language)
        right = sum(record.right for record in result.tasks.values())
        cells = (cell for task in table.tasks for cell in _cells(result.tasks.get(task)))
        rows.writerow((*map(_plain_text, person), right, *cells))
    # With a mark at the start, by which spreadsheets know the encoding.
    return write_beside(path, lambda handle: handle.write(text.getvalue().encode("utf-8-sig")))


def _cells(record: TaskRecord | None) -> tuple[object, ...]:
    if record is None:
        return ("",) * len(OF_TASK)
    last = record.answers[-1] if record.answers else ""
    counted = int(record.right), record.attempts, record.hints, int(record.told), round(record.seconds)
    return (*counted, _plain_text(last), _plain_text(record.because))


def _plain_text(text: str) -> str:
    """Return a text that no spreadsheet takes for a formula."""
    return f"'{text}" if text.startswith(FORMULA) and not _is_number(text) else text


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
