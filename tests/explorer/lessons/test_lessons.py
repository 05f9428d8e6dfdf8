"""Every lesson file that is found: it can be read, its steps make pictures, and what it claims is measured."""

from contextlib import suppress
from math import inf
from pathlib import Path

import pytest

from p2sf.errors import P2SFError
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.quantities import QUANTITIES
from p2sf_explorer.compute.setup import state_ranges
from p2sf_explorer.lessons.changes import apply_changes
from p2sf_explorer.lessons.claims import Claim, holds, measure_claim, parse_claim
from p2sf_explorer.lessons.lesson import FOLDER, found_lessons, lesson_files, parse_lesson, read_lesson, shipped_lessons
from p2sf_explorer.lessons.measures import MEASURES
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import Optics, new_state

FILES = lesson_files()


def readable():
    """Yield the lessons that can be read, so that a bad one fails its own test only."""
    for path in FILES:
        with suppress(P2SFError):
            yield read_lesson(path)


LESSONS = list(readable())
CLAIMS = [
    pytest.param(lesson, number, claim, id=f"{lesson.name}-{number + 1}-{claim.text}")
    for lesson in LESSONS
    for number, step in enumerate(lesson.steps)
    for claim in step.claims
]
TABS = {entry.key for entry in REGISTRY}
GOOD = """---
title: One
about: A sentence.
lens: achromat_f6
state: field_deg 3, solo w31+w22
---
## First
set: f_number 12
move: f_number
try: Do this
  and that.
ask: Why?
tell: So.
claim: strehl above 0.9

Some *text*.

More.
## Second
set: f_number file
"""


def parsed(text: str):
    return parse_lesson(text, "one", "lesson.md")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_lesson_can_be_read(path):
    assert read_lesson(path).name == path.stem


@pytest.mark.parametrize(("lesson", "number", "claim"), CLAIMS)
def test_a_claim_is_what_the_program_measures(lesson, number, claim):
    value = measure_claim(claim, lesson.state(number))
    assert holds(claim, value), f"{claim.text}: measured {value:.6g}"


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda lesson: lesson.name)
def test_every_step_has_a_picture_a_panel_and_something_to_read(lesson):
    assert 1 < len(lesson.steps) < 8
    assert any(step.claims for step in lesson.steps) and any(step.question for step in lesson.steps)
    for number, step in enumerate(lesson.steps):
        state = lesson.state(number)
        assert compute.live(state, "preview").psf.values.sum() == pytest.approx(1, abs=1e-3)
        assert state.display.tab in TABS and set(state.display.windows) <= TABS
        assert step.title and (step.text or step.attempt)


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda lesson: lesson.name)
def test_whatever_a_lesson_sets_can_be_set_by_the_slider(lesson):
    """A value beyond the slider's end jumps to the end at the first touch, and nobody can drag it "on"."""
    for number, step in enumerate(lesson.steps):
        first = lesson.state(number)
        for state in (first, *(apply_changes(first, claim.first) for claim in step.claims)):
            limits = state_ranges(state)
            for quantity in QUANTITIES:
                value, scale = quantity.shown(state, limits), quantity.scale(limits)
                if quantity.key == "focus_mm" and state.optics.focus_mm is None and value < 0:
                    value = inf  # the file's sensor, nearer than the image of ∞: the slider's end is next to it
                    assert step.move != quantity.key
                assert scale.value(scale.travel(value)) == pytest.approx(value), f"step {number + 1}: {quantity.title}"


def test_the_course_is_whole():
    about = " ".join(f"{lesson.title} {lesson.about}".lower() for lesson in LESSONS)
    assert len(LESSONS) >= 13
    for (
        word
    ) in "spread function, diffraction, defocus, spherical, coma, astigmatism, field curvature, distortion".split(", "):
        assert word in about
    for word in "stop matters, stopping down, chromatic, not enough, database, to image".split(", "):
        assert word in about
    assert shipped_lessons() == tuple(LESSONS)


def test_lessons_come_in_the_order_of_the_course_and_own_ones_behind_them(tmp_path):
    numbers = [int(lesson.name[:2]) for lesson in LESSONS]
    assert numbers == [1, 2, 17, 18, 3, 21, 4, 9, 5, 19, 6, 20, 7, 8, 10, 13, 14, 16, 11, 12, 15]
    for name in ("99_own", "00_own", "own"):
        (tmp_path / f"{name}.md").write_text(GOOD, encoding="utf-8")
    found, _ = found_lessons((FOLDER, tmp_path))
    assert list(found) == [*(lesson.name for lesson in LESSONS), "00_own", "99_own", "own"]


def test_steps_go_on_from_one_another_and_a_lens_begins_anew():
    lesson = parsed(GOOD)
    first, second = lesson.state(0), lesson.state(1)
    assert (first.optics.f_number, first.optics.field_deg, first.what_if.solo) == (12.0, 3.0, ("w31", "w22"))
    assert (second.optics.f_number, second.optics.field_deg) == (None, 3.0)
    assert (first.lesson.name, second.lesson.step) == ("one", 1)
    third = parsed(GOOD + "## Third\nset: lens singlet_f6\n").state(2)
    assert third.optics.lens == "singlet_f6" and third.optics.f_number is None and third.optics.field_deg != 3.0
    assert lesson.state(0, new_state(theme="dark")).display.theme == "dark"


def test_a_step_is_read_whole():
    step = parsed(GOOD).steps[0]
    assert (step.title, step.move, step.attempt) == ("First", "f_number", "Do this and that.")
    assert (step.question, step.answer, step.text) == ("Why?", "So.", "Some *text*.\n\nMore.")


def test_a_lens_may_lie_beside_its_lesson():
    lesson = next(lesson for lesson in LESSONS if lesson.name == "08_the_stop")
    assert Path(lesson.state(1).optics.lens) == FOLDER / "landscape_front.toml"


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("---\ntitle", "title", 1, "begins with"),
        ("w22\n---\n", "w22\n", 1, "has no end"),
        ("title: One\n", "", 1, 'lacks "title"'),
        ("title: One", "titel: One", 2, "not an entry of the header"),
        ("lens: achromat_f6", "lens: achromat_f7", 4, "achromat_f7"),
        ("field_deg 3", "field_degrees 3", 5, "field_degrees"),
        ("field_deg 3", "field_deg three", 5, 'field_deg is "three"'),
        ("field_deg 3", "field_deg 95", 5, "field angle is 95"),
        ("solo w31+w22", "solo w22+w31", 5, "solo"),
        ("solo w31+w22", "free_pupil perhaps", 5, "free_pupil"),
        ("set: f_number 12", "sett: f_number 12", 8, "not an entry of a step"),
        ("move: f_number", "move: shutter", 9, '"shutter" is not a slider'),
        ("tell: So.\n", "", 7, "question and its answer"),
        ("claim: strehl above 0.9", "claim: strehl is high", 14, "is not a claim"),
        ("claim: strehl above 0.9", "claim: stroll above 0.9", 14, 'measure "stroll"'),
        ("claim: strehl above 0.9", "claim: strehl is 0.9", 14, "tolerance"),
        ("claim: strehl above 0.9", "claim: strehl [f_numbr 2] above 0.9", 14, "f_numbr"),
        ("## First\n", "Words.\n## First\n", 7, "before the first step"),
        ("## ", "### ", 6, "no step"),
    ],
)
def test_a_bad_file_is_one_sentence_with_file_and_line(old, new, line, words):
    assert old in GOOD
    text = GOOD.replace(old, new)
    if words == "no step":
        text = text.split("###")[0]
    with pytest.raises(P2SFError) as caught:
        parsed(text)
    assert str(caught.value).startswith(f"lesson.md, line {line}: ") and words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_cannot_be_read_is_one_sentence(tmp_path):
    (tmp_path / "bad.md").write_bytes(b"\xff\xfe---")
    with pytest.raises(P2SFError, match="cannot be read"):
        read_lesson(tmp_path / "bad.md")


def test_a_bad_file_costs_only_itself_and_an_own_one_takes_the_place_of_a_shipped_one(tmp_path):
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "02_diffraction.md").write_text(GOOD, encoding="utf-8")
    (mine / "99_bad.md").write_text("no lesson", encoding="utf-8")
    found, faults = found_lessons((FOLDER, mine, tmp_path / "nowhere"))
    assert list(found) == [lesson.name for lesson in LESSONS]
    assert found["02_diffraction"].title == "One"
    assert len(faults) == 1 and "99_bad.md, line 1" in str(faults[0])


def test_a_claim_compares_states_and_knows_when_it_fails():
    state = parsed(GOOD).state(1)
    ratio = parse_claim("airy_radius_um [f_number 12] / [f_number 6] is 2 ± 0.001", lambda text: changes(text))
    assert holds(ratio, measure_claim(ratio, state))
    apart = parse_claim("airy_radius_um [f_number 12] − [f_number 6] above 4", lambda text: changes(text))
    assert measure_claim(apart, state) == pytest.approx(4.3, abs=0.01)  # 0.61 λ/NA is 4.3 µm at f/6, twice that at f/12
    wrong = Claim("", "strehl", (), "", (), "is", 0.5, 0.1)
    assert holds(wrong, 0.59) and not holds(wrong, 0.61)
    assert not holds(Claim("", "strehl", (), "", (), "above", 0.5, 0.0), 0.5)


def changes(text: str):
    from p2sf_explorer.lessons.changes import read_changes

    return read_changes(text, 1, "lesson.md")


def test_reading_an_entry_does_not_check_a_state_for_every_name_there_is(monkeypatch):
    """The fifty checks an entry cost held the window up for a third of a second when the lessons opened."""
    made, check = [], Optics.__post_init__
    monkeypatch.setattr(Optics, "__post_init__", lambda group: (made.append(group), check(group)))
    assert changes("field_deg 10, tab mtf") == (("field_deg", 10.0), ("tab", "mtf"))
    assert len(made) <= 8


def test_a_step_may_set_the_errors_of_a_build():
    assert changes("errors decentre_y 3-4 -0.2") == (("errors", (("decentre_y", 3, 4, -0.2),)),)
    both = changes("errors decentre_x 1 0.1+tilt_x 7 3.2")
    assert both == (("errors", (("decentre_x", 1, 1, 0.1), ("tilt_x", 7, 7, 3.2))),)
    assert changes("errors none") == (("errors", ()),)
    for bad in ("errors decentre_y 3-4", "errors decentre_y three 0.2", "errors 0.2"):
        with pytest.raises(P2SFError, match="is not an error of a build; write for example decentre_y 3-4"):
            changes(bad)


def test_every_measure_is_used_or_at_least_measures():
    used = {claim.measure for lesson in LESSONS for step in lesson.steps for claim in step.claims}
    state = parsed(GOOD).state(0)
    assert all(MEASURES[name](state) == MEASURES[name](state) for name in set(MEASURES) - used)
