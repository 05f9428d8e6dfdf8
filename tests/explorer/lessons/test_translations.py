"""The lessons in other languages: all there, the same steps and numbers, the window's own names for its controls."""

import re

import pytest
from PySide6.QtWidgets import QApplication, QStyle, QStyleOptionComboBox

from p2sf.errors import P2SFError
from p2sf_explorer.charts.theme import LIGHT
from p2sf_explorer.i18n.language import set_language, texts
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.lessons.controller import UNTRANSLATED, LessonController
from p2sf_explorer.lessons.lesson import FOLDER, found_lessons, lesson_files, read_lesson, with_words
from p2sf_explorer.lessons.lesson_panel import LessonPanel, StepFrame
from p2sf_explorer.window.controls import WIDTH

NAMES = [path.name for path in lesson_files()]
NUMBER = re.compile(r"\d+(?:[.,]\d+)*")
EMPHASISED = re.compile(r"(?<!\*)\*([^*]+)\*(?!\*)")
HEAD = "---\ntitle: Eins\nabout: Ein Satz.\n---\n"


def told(step) -> str:
    return " ".join((step.title, step.text, step.attempt, step.question, step.answer))


def numbers(text: str) -> set[str]:
    return {found.replace(",", ".") for found in NUMBER.findall(text)}


def test_every_lesson_is_there_in_german():
    assert [path.name for path in lesson_files(FOLDER / "de")] == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_a_translated_lesson_has_the_steps_and_the_numbers_of_its_original(name):
    lesson = read_lesson(FOLDER / name)
    said = with_words(lesson, FOLDER / "de" / name, "de")
    assert said.language == "de" and said.title != lesson.title and said.about != lesson.about
    for number, (old, new) in enumerate(zip(lesson.steps, said.steps, strict=True)):
        assert (new.changes, new.move, new.claims) == (old.changes, old.move, old.claims)
        assert numbers(told(new)) == numbers(told(old)), f"step {number + 1}"
        for part in ("text", "attempt", "question", "answer"):
            assert bool(getattr(new, part)) == bool(getattr(old, part)), f"step {number + 1}: {part}"
        assert lesson.state(number) == said.state(number)


@pytest.mark.parametrize("name", NAMES)
def test_a_translated_lesson_calls_controls_as_the_window_does(name):
    """Who is told to move *Field* must find that name on the screen, and *Feld* on a German one."""
    lesson, german = read_lesson(FOLDER / name), texts("de")
    said = with_words(lesson, FOLDER / "de" / name, "de")
    for old, new in zip(lesson.steps, said.steps, strict=True):
        for control in EMPHASISED.findall(told(old)):
            assert f"*{german.get(control, control)}*" in told(new), control


def test_a_language_without_words_for_a_lesson_falls_back_file_by_file(tmp_path):
    for name in NAMES[:2]:
        (tmp_path / name).write_bytes((FOLDER / name).read_bytes())
    (tmp_path / "de").mkdir()
    (tmp_path / "de" / NAMES[0]).write_bytes((FOLDER / "de" / NAMES[0]).read_bytes())
    found, faults = found_lessons((tmp_path,), "de")
    assert [lesson.language for lesson in found.values()] == ["de", "en"] and not faults
    assert {lesson.language for lesson in found_lessons((tmp_path,))[0].values()} == {"en"}


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 1, "begins with"),
        (HEAD.replace("about: Ein Satz.\n", ""), 1, 'lacks "about"'),
        (HEAD.replace("about", "lens"), 3, "not an entry of the header"),
        (HEAD + "## Eins\nWorte.\n", 1, "there is 1 step of words, and the lesson has 3"),
        (HEAD + "## Eins\nset: field_deg 3\n## Zwei\n## Drei\n", 6, "not an entry of a step"),
        (HEAD + "## Eins\nask: Warum?\n## Zwei\n## Drei\n", 5, "question and its answer"),
    ],
)
def test_bad_words_are_one_sentence_and_the_lesson_is_told_as_it_was_written(tmp_path, text, line, words):
    (tmp_path / NAMES[0]).write_bytes((FOLDER / NAMES[0]).read_bytes())
    (tmp_path / "de").mkdir()
    (tmp_path / "de" / NAMES[0]).write_text(text, encoding="utf-8")
    found, faults = found_lessons((tmp_path,), "de")
    assert [lesson.language for lesson in found.values()] == ["en"]
    assert len(faults) == 1 and f"{NAMES[0]}, line {line}: " in str(faults[0]) and words in str(faults[0])
    with pytest.raises(P2SFError):
        with_words(read_lesson(FOLDER / NAMES[0]), tmp_path / "de" / NAMES[0], "de")


@pytest.fixture
def teaching_german(window, monkeypatch, tmp_path):
    """Yield what teaches in German, in place of the window's own, and a person's own lesson, which is in English."""
    (tmp_path / "99_own.md").write_bytes((FOLDER / "03_defocus.md").read_bytes())
    monkeypatch.setattr("p2sf_explorer.lessons.lesson.own_folder", lambda: tmp_path)
    window.store.changed.disconnect(window.teaching.follow)
    set_language("de")
    made = LessonController(window.store, window, window.lesson_room, lambda: LIGHT)
    yield made
    set_language("en")
    made.leave()
    made.panel.setParent(None)
    window.store.changed.disconnect(made.follow)
    window.store.changed.connect(window.teaching.follow)


def test_the_page_speaks_german_and_says_once_where_it_cannot(teaching_german, window):
    told = []
    window.store.said.connect(told.append)
    for name, words in (("03_defocus", 0), ("99_own", 1), ("03_defocus", 1), ("99_own", 1)):
        teaching_german.begin(name)
        QApplication.processEvents()
        assert len(told) == words
    window.store.said.disconnect(told.append)
    assert told == [UNTRANSLATED]
    assert said(UNTRANSLATED) == "Diese Lektion ist nicht übersetzt und steht hier, wie sie geschrieben wurde"
    panel = teaching_german.panel
    assert panel.title.text() == "A quarter of a wave" and panel.choice.count() == len(NAMES) + 1
    teaching_german.begin("03_defocus")
    assert (
        panel.title.text() == "Eine viertel Welle" and panel.choice.currentText() == "5  Defokus, und die Grenze 10 λ"
    )


@pytest.mark.parametrize("language", ["en", "de"])
def test_every_title_fits_into_the_list_beside_a_window_of_1280(window, language):
    """The box is closed and shows one title; cut off, it is the one thing that says which lesson this is."""
    lessons = found_lessons((FOLDER,), language)[0]
    panel = LessonPanel(tuple(lessons.values()), window)
    panel.resize(WIDTH, 420)
    panel.show_step(lessons["05_coma"], 0, StepFrame(False))
    panel.show()
    QApplication.processEvents()
    option = QStyleOptionComboBox()
    panel.choice.initStyleOption(option)
    part = QStyle.SubControl.SC_ComboBoxEditField
    room = panel.choice.style().subControlRect(QStyle.ComplexControl.CC_ComboBox, option, part, panel.choice).width()
    wide = {
        panel.choice.itemText(k): panel.choice.fontMetrics().horizontalAdvance(panel.choice.itemText(k))
        for k in range(panel.choice.count())
    }
    panel.setParent(None)
    assert room > 150 and not {title for title, width in wide.items() if width > room}
