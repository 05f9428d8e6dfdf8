import pytest

from p2sf_explorer.course.lectures import CHECKS, find_lectures
from p2sf_explorer.lessons import controller
from tests.explorer.course.test_tasks import LECTURE

CHECK = """---
title: What do you expect?
about: Two questions.
lens: achromat_f6
---
## One
task: c1
choose: *yes | no :: Never shown.
ask: Is it?
tell: It is.
## Two
task: c2
choose: yes :: Never shown. | *no
ask: Is it?
tell: It is not.
"""


@pytest.fixture
def teaching(window, tmp_path, monkeypatch):
    """Return what teaches, with one lecture and a concept check of the tests' own and no answers yet."""
    folder = tmp_path / "course"
    folder.mkdir()
    (folder / "lecture_1.md").write_text(LECTURE, encoding="utf-8")
    for form in CHECKS:
        (folder / f"{form}.md").write_text(CHECK, encoding="utf-8")
    monkeypatch.setattr(window.teaching, "_find_lectures", lambda language: find_lectures(language, folder))
    monkeypatch.setattr(window.teaching, "_lectures", None)
    monkeypatch.setattr(controller.recent, "recent_path", lambda: tmp_path / "recent.json")
    yield window.teaching
    window.teaching.leave()
