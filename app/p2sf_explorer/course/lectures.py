"""The lectures and the concept check as lessons: Markdown files of this folder. No Qt in here."""

from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from hashlib import sha256
from pathlib import Path

from p2sf.errors import P2SFError
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.lesson import ENGLISH, Lesson, found_lessons, lesson_files
from p2sf_explorer.lessons.task import Exercise

FOLDER = Path(__file__).parent
CHECK = "check"
BEFORE, AFTER = "check_before", "check_after"


def find_lectures(language: str = ENGLISH, folder: Path = FOLDER) -> tuple[dict[str, Lesson], tuple[P2SFError, ...]]:
    """Return the lectures by name, the concept check before and after them, and the errors of files that are none."""
    found, faults = found_lessons((folder,), language)
    check = found.pop(CHECK, None)
    if check is None:
        return found, faults
    before = replace(
        check, name=BEFORE, title=tr("Before the course: {title}", title=check.title), attempts=1, silent=True
    )
    after = replace(check, name=AFTER, title=tr("After the course: {title}", title=check.title), attempts=1)
    return {BEFORE: before, **found, AFTER: after}, faults


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
