"""What the site is made of: every page is in its contents, links lead somewhere, four questions have their answers."""

import re

import pytest

import p2sf
from p2sf.cli import COMMANDS
from p2sf_explorer.course.lectures import FOLDER as COURSE
from p2sf_explorer.handbook.pages import PAGES, page
from p2sf_explorer.lessons.lesson import found_lessons, shipped_lessons
from p2sf_explorer.site.generated import navigation, pages
from p2sf_explorer.site.links import link_faults
from p2sf_explorer.site.pictures import lesson_states


def paths(entry: object) -> list[str]:
    """Return the pages that an entry of the contents leads to."""
    if isinstance(entry, str):
        return [entry]
    return [path for item in (entry.values() if isinstance(entry, dict) else entry) for path in paths(item)]


def test_every_page_is_in_the_contents_once():
    assert sorted(paths(navigation())) == sorted([*pages(), *(f"{name}.md" for name in PAGES)])


def test_the_command_line_page_has_every_command_and_the_library_page_every_name():
    found = pages()
    assert set(COMMANDS) <= set(re.findall(r"^## p2sf ([a-z]+)$", found["cli.md"], re.MULTILINE))
    assert set(re.findall(r"^::: p2sf\.(\w+)$", found["api.md"], re.MULTILINE)) >= set(p2sf.__all__)


def test_a_lesson_has_every_step_with_its_picture():
    found, pictures = pages(), lesson_states()
    for lesson in shipped_lessons():
        text = found[f"lessons/{lesson.name}.md"]
        assert re.findall(r"^## (.+)$", text, re.MULTILINE) == [step.title for step in lesson.steps]
        assert set(re.findall(r"\.\./made/([\w.]+)", text)) <= set(pictures)


def test_a_lecture_has_every_page_its_lessons_and_sheets_in_both_languages():
    found = pages()
    for name, lecture in found_lessons((COURSE,))[0].items():
        text = found[f"course/{name}.md"]
        assert re.findall(r"^## (.+)$", text, re.MULTILINE) == [step.title for step in lecture.steps]
        assert text.count(".pdf)") == 4 and all(f"../lessons/{one}.md" in text for one in lecture.lessons)
        assert f"[{lecture.title}]({name}.md)" in found["course/index.md"]


def test_pages_of_the_sources_link_to_pages_of_the_site():
    for text in pages().values():
        assert not re.search(r"\]\((?:app|p2sf|tests)/", text)


@pytest.mark.parametrize(
    ("question", "answer", "place"),
    [
        ("How is depth measured?", "first vertex", "theory.md#13-depth-field-and-source"),
        ("What is W20 here?", "S_{III} + S_{IV}", "theory.md#32-seidel-sums"),
        ("export to ISETCam", "--to iset", "export.md#isetcam"),
        ("What does R² on the badge compare with?", "Huygens sum of exact rays", "theory.md#61-"),
    ],
)
def test_four_questions_are_answered_where_they_are_asked(question, answer, place):
    after = page("find")[page("find").index(question) :][:600]
    assert answer in after and place in after


def test_dead_links_are_found(tmp_path):
    (tmp_path / "b.html").write_text('<p id="here">')
    (tmp_path / "a.html").write_text(
        '<a href="b.html#here"></a><a href="b.html#gone"></a><img src="c.png"><a href="https://example.org"></a>'
        '<script src="https://example.org/x.js"></script><a href="#nowhere"></a>'
    )
    assert link_faults(tmp_path) == [
        "a.html: no such anchor: b.html#gone",
        "a.html: no such file: c.png",
        "a.html: fetches from the network https://example.org/x.js",
        "a.html: no such anchor: #nowhere",
    ]
