"""The lectures and both forms of the concept check as lessons: Markdown files of this folder. No Qt in here."""

from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from hashlib import sha256
from pathlib import Path

from p2sf.errors import P2SFError
from p2sf_explorer.lessons.lesson import ENGLISH, Lesson, found_lessons, lesson_files
from p2sf_explorer.lessons.task import Exercise

FOLDER = Path(__file__).parent
CHECKS = BEFORE, AFTER = "check_before", "check_after"


def find_lectures(language: str = ENGLISH, folder: Path = FOLDER) -> tuple[dict[str, Lesson], tuple[P2SFError, ...]]:
    """Return the lectures between both forms of the concept check, by name, and the errors of files that are none."""
    found, faults = found_lessons((folder,), language)
    before, after = ({name: found.pop(name)} if name in found else {} for name in CHECKS)
    first = {name: replace(check, attempts=1, silent=True) for name, check in before.items()}
    return first | found | {name: replace(check, attempts=1) for name, check in after.items()}, faults


def tasks_of(lesson: Lesson) -> tuple[Exercise, ...]:
    """Return the tasks of a lesson in their order."""
    return tuple(step.task for step in lesson.steps if step.task)


def task_keys(lessons: Iterable[Lesson]) -> tuple[tuple[str, str], ...]:
    """Return lecture and name of every task, in their order."""
    return tuple((lesson.name, task.name) for lesson in lessons for task in tasks_of(lesson))


@cache
def course_version(folder: Path = FOLDER) -> str:
    """Return eight digits that change with any word of the lectures: results of the same version can be compared."""
    digest = sha256()
    for path in lesson_files(folder):
        digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return digest.hexdigest()[:8]
