"""A lesson that is made of what is on screen shows it again, step by step."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from p2sf.errors import P2SFError
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.compute.editing import edited_state
from p2sf_explorer.compute.setup import default_state, paraxial_setup, prescription
from p2sf_explorer.lessons.lesson import read_lesson
from p2sf_explorer.lessons.lesson_list import content
from p2sf_explorer.lessons.making.recording import LEFT_OUT, RecordedStep, same_lens, save_lesson, written_changes
from p2sf_explorer.state.state import ENTRIES, change, entry
from tests.explorer.conftest import FIRST

START = default_state("cooke_triplet")
STATES = (
    change(START, field_deg=7.5, wavelength_nm=486.1, method="fitted"),
    change(START, field_deg=7.5, wavelength_nm=486.1, f_number=11.0, blades=6, stage="pupil", tab="mtf"),
    change(START, f_number=None, added_waves=(0.0, 0.5, 0.0, 0.0, 0.0, 0.0), solo=("w31",), rail=()),
    change(START, errors=(("decentre_y", 3, 4, 0.02),), curves_of="focus", curves_frequencies_per_mm=(5.0, 12.5)),
)


def steps(*states) -> list[RecordedStep]:
    return [RecordedStep(state, f"Step {number}", "Words.", "Try this.") for number, state in enumerate(states, 1)]


def shown(state) -> dict:
    return {name: entry(state, name) for name in ENTRIES if name not in LEFT_OUT}


def test_each_step_shows_what_was_on_screen(tmp_path):
    lesson = read_lesson(save_lesson("My coma", "One sentence.", steps(*STATES), tmp_path))
    assert (lesson.title, lesson.about, len(lesson.steps)) == ("My coma", "One sentence.", len(STATES))
    for number, state in enumerate(STATES):
        assert shown(lesson.state(number)) == shown(state), number
        assert (lesson.steps[number].text, lesson.steps[number].attempt) == ("Words.", "Try this.")


def test_depths_of_a_picture_come_and_go_but_a_map_of_ones_own_is_left_out(tmp_path):
    states = START, change(START, photo_depths="slope"), START, change(START, photo_depths="/home/me/map.png")
    path = save_lesson("Depths", "", steps(*states), tmp_path)
    lesson = read_lesson(path)
    assert [lesson.state(number).photo.depths for number in range(4)] == ["", "slope", "", ""]
    assert "map.png" not in path.read_text(encoding="utf-8")


def test_an_edited_lens_stands_beside_its_lesson(tmp_path):
    state = edited_state(change(START, keep_focus="off"), prescription(default_state("tessar")))
    lesson = read_lesson(save_lesson("Mine", "", steps(state), tmp_path))
    assert {path.suffix for path in tmp_path.iterdir()} == {".md", ".toml"}
    assert paraxial_setup(lesson.state(0)).focal_length_mm == pytest.approx(paraxial_setup(state).focal_length_mm)


def test_a_step_brings_its_own_lens(tmp_path):
    """A shipped one, an edited one and the first again; what is set on the lens before does not stay."""
    edited = edited_state(change(START, keep_focus="off"), prescription(default_state("achromat_f6")))
    states = (change(START, f_number=9.0), default_state("tessar"), edited, change(START, field_deg=3.0))
    path = save_lesson("Many", "", steps(*states), tmp_path)
    lesson = read_lesson(path)
    for number, state in enumerate(states):
        found = lesson.state(number)
        kept = {name: value for name, value in shown(state).items() if name != "keep_focus"}
        assert {name: value for name, value in shown(found).items() if name != "keep_focus"} == kept, number
        assert paraxial_setup(found).focal_length_mm == pytest.approx(paraxial_setup(state).focal_length_mm)
    assert [one.name for one in tmp_path.glob("*.toml")] == [f"{path.stem}.toml"]


def test_what_is_hidden_beside_the_stage_stays_hidden(tmp_path):
    """Changes of rail or tab show what stands beside the stage (`Lesson.state`), which the window did not."""
    states = change(START, show_rail=True), change(START, show_rail=False, tab="mtf"), change(START, show_rail=False)
    lesson = read_lesson(save_lesson("Rail", "", steps(*states), tmp_path))
    assert [lesson.state(number).display.show_rail for number in range(3)] == [True, False, False]


@pytest.mark.parametrize("language", ["en", "de"])
def test_a_lesson_states_the_language_of_its_words(tmp_path, language):
    assert read_lesson(save_lesson("Sprache", "", steps(START), tmp_path, language)).language == language


def test_titles_that_are_alike_have_files_of_their_own(tmp_path):
    paths = [save_lesson("Größe & Ähnlichkeit", "", steps(START), tmp_path) for _ in range(3)]
    assert len(set(paths)) == 3 and all(path.is_file() for path in paths)


def test_what_is_written_cannot_break_the_lesson(tmp_path):
    text = "---\n## no step\nset: nothing\nnote: x\ntry: y"
    lesson = read_lesson(save_lesson("T", " ", [RecordedStep(START, "A\n## heading", text, "a\nb")], tmp_path))
    (step,) = lesson.steps
    assert [line.strip() for line in step.text.splitlines()] == text.splitlines() and step.attempt == "a b"


def test_the_lens_of_another_lesson_stays(tmp_path):
    (tmp_path / "90_mine.toml").write_text("kept")
    own = change(START, lens_text=lens_to_toml(find_lens("tessar")))
    path = save_lesson("Mine", "", [RecordedStep(own, "A")], tmp_path)
    assert path.stem == "90_mine_2" and path.with_suffix(".toml").is_file()
    assert (tmp_path / "90_mine.toml").read_text() == "kept"


def test_a_lesson_without_title_or_step_is_refused(tmp_path):
    for title, made in (("", steps(START)), ("T", [])):
        with pytest.raises(P2SFError):
            save_lesson(title, "", made, tmp_path)
    assert not list(tmp_path.iterdir())


def test_the_steps_of_undo_are_those_of_the_last_lens_without_repetitions():
    other = default_state("tessar")
    moved = change(START, field_deg=3.0)
    assert same_lens([other, START, change(START, theme="dark"), moved]) == [START, moved]
    assert written_changes(START, moved) == "field_deg 3"


@pytest.fixture
def teaching(window, tmp_path, monkeypatch):
    monkeypatch.setattr("p2sf_explorer.lessons.lesson.own_folder", lambda: tmp_path)
    yield window.teaching
    if window.teaching.maker:
        window.teaching.maker.deleteLater()
        window.teaching.maker = None
    window.teaching.leave()
    window.teaching._lessons = {}


def test_a_lesson_from_the_screen_takes_two_actions(window, qtbot, teaching):
    """The command, and Enter in the dialog: the lesson is written and stands open."""
    window.store.update(field_deg=4.0)
    teaching.make()
    maker = teaching.maker
    maker.name.setText("From the screen")
    qtbot.keyClick(maker.name, Qt.Key.Key_Return)
    assert window.store.state.lesson.name == "90_from_the_screen" and not maker.isVisible()
    assert window.store.state.optics.field_deg == 4.0
    assert teaching.panel.choice.currentData() == "90_from_the_screen"


def test_undo_gives_a_step_for_each_change(window, qtbot, teaching):
    for angle in (2.0, 5.0):
        window.store.update(field_deg=angle)
    teaching.make()
    teaching.maker.add_history()
    assert [step.state.optics.field_deg for step in teaching.maker.steps] == [FIRST.optics.field_deg, 2.0, 5.0]
    teaching.maker.close()
    assert teaching.maker.steps, "what is being made is kept"


def test_keys_in_the_search_choose_in_the_list(window, qtbot, teaching):
    teaching.open_list()
    found = teaching.list
    for key, row in ((Qt.Key.Key_Down, 1), (Qt.Key.Key_Down, 2), (Qt.Key.Key_Up, 1)):
        qtbot.keyClick(found.sought, key)
        assert found.list.currentRow() == row
    qtbot.keyClick(found.sought, Qt.Key.Key_Return)
    assert window.store.state.lesson.name == list(teaching.lessons())[1]
    QApplication.processEvents()


def test_the_list_finds_lessons_by_title_and_content(window, qtbot, teaching):
    teaching.open_list()
    found = teaching.list
    assert found.list.count() == len(teaching.lessons())
    found.sought.setText("hubble mirror")
    names = [found.list.item(row).data(Qt.ItemDataRole.UserRole) for row in range(found.list.count())]
    assert "14_hubble" in names and all("hubble" in content(teaching.lessons()[name]) for name in names)
    qtbot.waitUntil(lambda: set(names) <= set(found._pictures))
    qtbot.keyClick(found.sought, Qt.Key.Key_Return)
    assert window.store.state.lesson.name == names[0] and not found.isVisible()
    QApplication.processEvents()
