"""Sheets of lectures: all of it is there, inside the edges of its paper, in both languages; each page's state opens."""

import re
from itertools import chain

import pytest

from p2sf.cli import main
from p2sf.errors import ExportError
from p2sf_explorer.course import sheets
from p2sf_explorer.course.lectures import BEFORE, CHECKS, FOLDER
from p2sf_explorer.course.sheets import lecture_sheets, write_course
from p2sf_explorer.files.opening import open_file
from p2sf_explorer.i18n.language import texts
from p2sf_explorer.lessons.lesson import found_lessons
from p2sf_explorer.report.pages import A4, EDGE_MM, LETTER, Lettering, wrap_lines
from p2sf_explorer.state.state import State
from tests.support.tiers import in_tiers

WORDS = re.compile(r"\w{3,}")
EVERY = [(name, language) for name in (*(f"lecture_{k}" for k in range(1, 7)), *CHECKS) for language in ("en", "de")]


def lecture(name: str, language: str):
    return found_lessons((FOLDER,), language)[0][name]


def texts_on(pages) -> str:
    """Return what is written on sheets, page by page, from top to bottom, without what each has at its foot."""
    lines = [sorted(page.figure.texts, key=lambda text: (-round(text.get_position()[1], 4), text.get_position()[0]))
             for page in pages]  # fmt: skip
    return " ".join(text.get_text().replace("\u00a0", " ") for text in chain(*lines))


@pytest.mark.parametrize("paper", [A4, LETTER], ids=["a4", "letter"])
@pytest.mark.parametrize(("name", "language"), in_tiers(EVERY, [(BEFORE, "de")]))
def test_nothing_runs_over_the_edges(name, language, paper):
    for solved in (False, True):
        for page in lecture_sheets(lecture(name, language), paper, solved):
            for text in page.figure.texts:
                x, y = text.get_position()
                heavy, slanted = text.get_fontweight() == "bold", text.get_fontstyle() == "italic"
                wide = Lettering(text.get_fontsize(), bold=heavy, italic=slanted).wide_mm(text.get_text())
                left = x * paper.wide_mm - (wide if text.get_ha() == "right" else 0)
                assert EDGE_MM - 0.1 <= left and left + wide <= paper.wide_mm - EDGE_MM + 0.5, text.get_text()
                assert 5 / paper.high_mm < y < 1 - 0.9 * EDGE_MM / paper.high_mm


@pytest.mark.parametrize("language", in_tiers(["en", "de"], ["de"]))
def test_students_have_the_questions_and_who_teaches_the_answers_too(language):
    found = lecture("lecture_1", language)
    plain, solved = (texts_on(lecture_sheets(found, A4, with_answers)) for with_answers in (False, True))
    local = {"5.35 µm": "5,35 µm" if language == "de" else "5.35 µm"}
    for step in found.steps:
        assert step.title in plain and step.title in solved
        for word in WORDS.findall(step.question):
            assert word in plain and word in solved
        note = step.note.split(".")[0]
        assert not note or (note not in plain and all(word in solved for word in WORDS.findall(note)))
        if step.task:
            hints = {hint for hint in (*step.task.words.wrong, *step.task.words.option_hints) if hint}
            assert not any(hint[:40] in plain for hint in hints)
            assert all(hint[:40] in solved for hint in hints)
    known = texts(language)
    assert known.get("Who answers {answer}", "Who answers {answer}").format(answer=local["5.35 µm"]) in solved
    assert f"{known.get('Solution', 'Solution')}." in solved.replace(" .", ".")


@pytest.fixture
def written(tmp_path, monkeypatch):
    """Yield what is written of a course of one lecture, and the shares that were told."""
    short = {"lecture_1": lecture("lecture_1", "de")}
    monkeypatch.setattr(sheets, "found_lessons", lambda folders, language: (short, ()))
    told: list[float] = []
    yield write_course(tmp_path / "new" / "sheets", "de", LETTER, told.append), told


@pytest.mark.slow
def test_a_folder_has_both_sheets_and_a_state_for_every_page_that_opens_there(written):
    paths, told = written
    assert [path.suffix for path in paths] == [".pdf", ".pdf", *[".json"] * 7] and told == [1.0]
    for path in paths[:2]:
        document = path.read_bytes()
        boxes = re.findall(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)", document)
        assert boxes and all([float(side) for side in box] == pytest.approx([612, 792], abs=0.5) for box in boxes)
    for number, path in enumerate(paths[2:]):
        state = open_file(State(), str(path))
        assert (state.lesson.name, state.lesson.step) == ("lecture_1", number)


def test_what_cannot_be_written_is_one_sentence(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="language"):
        write_course(tmp_path, "xx")
    with pytest.raises(ExportError, match="cannot be made"):
        write_course(tmp_path / "file" / "folder")
    assert main(["course"]) == 2 and main(["course", "-o", str(tmp_path), "--paper", "a5"]) == 2
    assert capsys.readouterr().err.count("\n") == 2


@pytest.mark.slow
def test_the_command_writes_nine_pairs_of_sheets(tmp_path):
    assert main(["course", "-o", str(tmp_path)]) == 0
    assert len(list(tmp_path.glob("*.pdf"))) == 18 and len(list(tmp_path.glob("lecture_?_?.json"))) > 40


def test_lines_break_between_words_and_keep_their_lettering():
    look = Lettering(9)
    lines = wrap_lines("A **bold word** and (*Field*), which 3.3\u00a0mm " * 4, look, 60)
    assert all(sum(part.wide_mm(text) for text, part in line) <= 60 for line in lines)
    joined = " ".join("".join(text for text, _ in line) for line in lines)
    assert joined == " ".join(["A bold word and (Field), which 3.3\u00a0mm"] * 4)
    assert {text.strip() for line in lines for text, part in line if part.italic} == {"Field"}
    assert wrap_lines("", look, 60) == [] and len(wrap_lines("1 * 2 * 3", look, 60)[0]) == 1
