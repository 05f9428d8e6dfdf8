"""Pages that are made from the sources: the README, how to contribute, the command line, the library, the lessons."""

import re
from pathlib import Path

import p2sf
from p2sf.cli import command_line_markdown
from p2sf_explorer.course.lectures import FOLDER as COURSE
from p2sf_explorer.course.sheets import ENDINGS, sheet_languages
from p2sf_explorer.handbook.pages import PAGES
from p2sf_explorer.lessons.lesson import APPENDIX, Lesson, Step, found_lessons, shipped_lessons
from p2sf_explorer.lessons.lesson import FOLDER as LESSONS
from p2sf_explorer.lessons.task import display_order
from p2sf_explorer.site.notebooks import SHOWN as NOTEBOOKS
from p2sf_explorer.site.notebooks import notebook_text
from p2sf_explorer.site.python_beside import with_python

ROOT = Path(__file__).parents[3]
# Where the files that pages link to in the sources stand on the site.
PLACES = {
    "app/p2sf_explorer/handbook/": "",
    "app/p2sf_explorer/lessons/README.md": "lessons/format.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
}
LINK = re.compile(r"(?<=\]\()(" + "|".join(map(re.escape, PLACES)) + ")")
# What a class of the library has from one that is not listed.
INHERITED = {
    "Camera": ("    options:", "      inherited_members: [source, settings, its_lens]"),
    "Psf": ("    options:", "      inherited_members: [with_figures, record, x_um, y_um]"),
}
MORE_OF_THE_LIBRARY = "p2sf.conventions", "p2sf.errors", "p2sf.export.psf_set", "p2sf.figures.psf_data"


SHEETS = "sheets"  # the folder of the PDFs on the site


def pages() -> dict[str, str]:
    """Return the Markdown of every generated page by its path on the site."""
    lectures = {f"course/{name}.md": lecture_page(lecture) for name, lecture in _lectures().items()}
    lessons = {f"lessons/{lesson.name}.md": lesson_page(lesson) for lesson in shipped_lessons()}
    notebooks = {f"examples/{name}.md": notebook_text(name) for name in NOTEBOOKS}
    own = {
        "index.md": _with_moved_links("README.md"),
        "contributing.md": _with_moved_links("CONTRIBUTING.md"),
        "changelog.md": _with_moved_links("CHANGELOG.md"),
        "cli.md": command_line_page(),
        "api.md": library_page(),
        "course/index.md": course_page(),
        "lessons/index.md": lessons_page(),
        "lessons/format.md": (LESSONS / "README.md").read_text(encoding="utf-8"),
    }
    return own | lectures | lessons | notebooks


def navigation() -> list[dict[str, object]]:
    """Return the site's contents, in the form of MkDocs' ``nav``."""
    named = {f"{name}.md": title for name, title in PAGES.items()}

    def entry(path: str) -> dict[str, object]:
        return {named[path]: path}

    lectures: list[object] = ["course/index.md", entry("first_lecture.md")]
    lectures += [{lecture.title: f"course/{name}.md"} for name, lecture in _lectures().items()]
    lessons: list[object] = ["lessons/index.md"]
    lessons += [{lesson.title: f"lessons/{lesson.name}.md"} for lesson in shipped_lessons()]
    how_to = [
        entry(f"{name}.md")
        for name in (
            "import",
            "lens_files",
            "export",
            "measure",
            "camera",
            "build",
            "notebook",
            "plans",
            "window",
            "panels",
        )
    ]
    return [
        {"P2SF Explorer": "index.md"},
        entry("find.md"),
        entry("install.md"),
        entry("tutorial.md"),
        {"Examples": [entry("gallery.md"), {"A camera and its figures": "examples/camera.md"}]},
        {"How to": [*how_to,
            {"Add a panel, a format, a lesson": "contributing.md"}, {"Write a lesson": "lessons/format.md"},
        ]},
        {"Course": lectures},
        {"Lessons": lessons},
        {"Theory and figures": [entry(path) for path in ("theory.md", "numerics.md", "speed.md")]},
        {"Reference": [{"Library": "api.md"}, {"Command line": "cli.md"}, {"Changes": "changelog.md"}]},
    ]  # fmt: skip


def library_page() -> str:
    """Return the page of the library, whose entries mkdocstrings fills from the docstrings."""
    lines = ["# Library", "", "Everything here is imported from `p2sf`: `import p2sf`, then `p2sf.render`.", ""]
    for name in p2sf.__all__:
        lines += [f"::: p2sf.{name}", *INHERITED.get(name, ()), ""]
    lines += ["## Beside these", ""]
    for name in MORE_OF_THE_LIBRARY:
        lines += [f"::: {name}", ""]
    return "\n".join(lines)


def command_line_page() -> str:
    """Return the help of every command, without the list of them that the site puts beside every page."""
    text = re.sub(r"^## Table of Contents.*?(?=^\*\*)", "", command_line_markdown(), flags=re.MULTILINE | re.DOTALL)
    return with_python(text.replace("# p2sf", "# Command line", 1))


def lessons_page() -> str:
    """Return the list of lessons."""
    rows = [f"1. [{lesson.title}]({lesson.name}.md): {lesson.about}" for lesson in shipped_lessons()]
    appendix = len(rows) - len(APPENDIX)
    return "\n".join(
        ("# Lessons", "", "F3 opens them in the window, where every slider can be moved.", "", *rows[:appendix], "",
         "## Appendix", "", *rows[appendix:], "", "A lesson is a file: [write one](format.md).", "")
    )  # fmt: skip


def _lectures() -> dict[str, Lesson]:
    return found_lessons((COURSE,))[0]


def course_page() -> str:
    """Return the list of lectures with their sheets."""
    rows = [f"- [{lecture.title}]({name}.md): {lecture.about}" for name, lecture in _lectures().items()]
    return "\n".join(("# Course", "", "Ctrl+F3 opens the lectures in the window.", "", *rows, ""))


def lecture_page(lecture: Lesson) -> str:
    """Return a lecture as a page: its sheets, the lessons it plays, and its pages with questions and solutions."""
    sheets = [
        f"[{words}, {language}](../{SHEETS}/{language}/{lecture.name}{ending})"
        for language in sheet_languages()
        for words, ending in zip(("for students", "with solutions"), ENDINGS, strict=True)
    ]
    titles = {lesson.name: lesson.title for lesson in shipped_lessons()}
    head = [f"# {lecture.title}", lecture.about, f"Sheets as PDF: {' · '.join(sheets)}."]
    if lecture.lessons:
        links = " · ".join(f"[{titles[name]}](../lessons/{name}.md)" for name in lecture.lessons)
        head.append(f"Lessons of this lecture: {links}.")
    return "\n\n".join((*head, *(_step(step, "") for step in lecture.steps)))


def lesson_page(lesson: Lesson) -> str:
    """Return a lesson as a page: every step with its picture of the window, its question and its answer."""
    head = f"# {lesson.title}\n\n{lesson.about}\n"
    steps = (_step(step, f"../made/{lesson.name}_{number}.png") for number, step in enumerate(lesson.steps, 1))
    return "\n".join((head, *steps))


def _step(step: Step, picture: str) -> str:
    parts = [f"## {step.title}", step.text]
    if picture:
        parts.append(f"![The window at the step “{step.title}”]({picture})")
    if step.attempt:
        parts.append(f"**Try.** {step.attempt}")
    if step.question:
        parts.append(f"**Question.** {step.question}")
    if step.task:
        offers = step.task.words.options or step.task.words.items
        parts.append("\n".join(f"- {offers[k]}" for k in display_order(step.task)))
    if step.answer:
        parts.append('??? success "Answer"\n\n' + "\n".join(f"    {line}" for line in step.answer.splitlines()))
    return "\n\n".join(filter(None, parts)) + "\n"


def _with_moved_links(name: str) -> str:
    """Return a file of the project's root with its links to other pages as they are on the site."""
    text = (ROOT / name).read_text(encoding="utf-8")
    return LINK.sub(lambda found: PLACES[found[1]], text)
