"""Tasks grade themselves: numbers with units, choices, orders, goals; what cannot be read costs no attempt."""

import pytest

from p2sf.errors import P2SFError
from p2sf_explorer.compute.setup import default_state, paraxial_setup
from p2sf_explorer.lessons.changes import apply_changes
from p2sf_explorer.lessons.lesson import parse_lesson, with_words
from p2sf_explorer.lessons.task import diagnose, shuffle
from p2sf_explorer.lessons.typed_numbers import read_typed, units_like
from p2sf_explorer.state.state import change

HEAD = "---\ntitle: T\nabout: A.\nlens: achromat_f6\nlesson: 01_what_is_a_psf, 02_diffraction\n---\n"
LECTURE = f"""{HEAD}## Radius
task: radius
answer: 6.7 ± 0.2 µm
wrong: 13.4 ± 0.4 :: The diameter.
wrong: 0.0034 ± 0.0001 mm :: Half of it.
hint: One.
hint: Two.
ask: How large?
tell: So large.
note: For who teaches.
## Measured
set: f_number 12
task: measured
answer: measure airy_radius_um ± 3 %
wrong: measure airy_radius_um [f_number 6] ± 3 % :: At f/12.
ask: How large?
tell: So large.
## Choice
task: choice
choose: left :: Not left. | *right | up :: Not up.
see: set: field_deg 2
ask: Where?
tell: There.
## Order
task: order
order: a; b; c
wrong: 3 2 1 :: From the largest.
ask: Order.
tell: a, b, c.
## Goal
set: sensor_shift_um 200, field_deg 0
task: goal
goal: wd_waves within ± 0.2, field_deg is 1
solve: sensor_shift_um 0, field_deg 1
wrong: field_deg is 0 :: Go to 1°.
ask: Focus at 1°.
tell: So.
## Curve
task: curve
answer: 0.8 ± 0.05 :: at 10/mm
answer: 20 ± 2 % :: at 50/mm
ask: How high?
tell: So high.
"""
WORDS = """---
title: T
about: A.
---
## Radius
task: radius
wrong: :: Der Durchmesser.
wrong: :: Die Hälfte.
hint: Eins.
hint: Zwei.
ask: Wie groß?
tell: So groß.
note: Für Lehrende.
## Gemessen
task: measured
wrong: :: Bei f/12.
ask: Wie groß?
tell: So groß.
## Wahl
task: choice
choose: links :: Nicht links. | rechts | oben :: Nicht oben.
ask: Wo?
tell: Da.
## Ordnung
task: order
order: A; B; C
wrong: :: Vom größten an.
ask: Ordnen.
tell: A, B, C.
## Ziel
task: goal
wrong: :: Zu 1° gehen.
ask: Bei 1° scharfstellen.
tell: So.
## Kurve
task: curve
answer: :: bei 10/mm
answer: :: bei 50/mm
ask: Wie hoch?
tell: So hoch.
"""


def parsed(text: str = LECTURE):
    return parse_lesson(text, "lecture", "lecture.md")


LESSON = parsed()
STEP = {step.task.name: number for number, step in enumerate(LESSON.steps)}


def judged(name: str, text: str, **moves):
    number = STEP[name]
    state = LESSON.state(number)
    return LESSON.steps[number].task.judge(text, state, change(state, **moves))


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("6.7", "µm", 6.7),
        ("6,7 µm", "µm", 6.7),
        ("6.7um", "µm", 6.7),
        ("0.0067 mm", "µm", 6.7),
        ("6700 nm", "µm", 6.7),
        ("6.7×10^-6 m", "µm", 6.7),
        ("6,7 * 10^-3 mm", "µm", 6.7),
        ("6.7·10⁻⁶ m", "µm", 6.7),
        ("6.7e-3 mm", "µm", 6.7),
        ("1/4", "λ", 0.25),
        ("−1/4 λ", "λ", -0.25),
        ("λ/4", "λ", 0.25),
        ("0,25 Wellen", "λ", 0.25),
        ("50 1/mm", "/mm", 50.0),
        ("50 lp/mm", "/mm", 50.0),
        ("30′", "°", 0.5),
        ("20 %", "", 0.2),
        ("0.2", "%", 0.2),
        ("f/8", "f/", 8.0),
        ("5,6", "f/", 5.6),
    ],
)
def test_a_number_is_read_as_students_write_it(text, unit, value):
    assert read_typed(text, unit) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(("text", "unit"), [("", "µm"), ("much", "µm"), ("6.7 s", "µm"), ("6.7 µm 3", "µm"),
                                            ("1e999", "µm"), ("1/0", "λ"), ("nan", ""), ("1.2.3", "")])  # fmt: skip
def test_what_is_no_number_of_this_kind_is_one_sentence(text, unit):
    with pytest.raises(P2SFError) as caught:
        read_typed(text, unit)
    assert "\n" not in str(caught.value)


def test_units_of_a_kind_are_those_of_physics():
    assert units_like("µm")["mm"] == pytest.approx(1000) and units_like("°")["rad"] == pytest.approx(57.29577951)
    assert units_like("%")["%"] == 1 and units_like("")["%"] == 0.01


def test_a_number_is_right_within_its_tolerance_in_any_unit():
    for text in ("6.5", "6.9", "6,7", "0.0067 mm", "6700 nm"):
        assert judged("radius", text).right, text
    for text in ("6.49", "6.91", "6.7 mm", "-6.7"):
        assert not judged("radius", text).right, text


def test_a_foreseen_wrong_number_has_its_own_hint_and_others_tell_the_slip():
    assert judged("radius", "13.4").hint == "The diameter." and judged("radius", "3.4").hint == "Half of it."
    said = {judged("radius", text).words.template for text in ("6700", "-6.7", "20", "0.1")}
    assert len(said) == 4 and not any(judged("radius", text).hint for text in ("6700", "-6.7", "20", "0.1"))


def test_of_negative_numbers_the_lower_one_is_too_small():
    assert diagnose(-3.0, -2.0).template == diagnose(2.0, 3.0).template
    assert diagnose(-2.0, -3.0).template == diagnose(3.0, 2.0).template != diagnose(2.0, 3.0).template


def test_the_programs_own_figure_is_the_answer_at_the_state_of_the_task():
    number = STEP["measured"]
    made = paraxial_setup(LESSON.state(number))
    radius = 0.609835 * made.coefficients.wavelength_um / made.coefficients.na  # first zero of J1
    assert judged("measured", f"{radius:.3f}").right and judged("measured", f"{1.025 * radius:.3f}").right
    assert not judged("measured", f"{1.035 * radius:.3f}").right
    assert judged("measured", f"{radius:.3f}", f_number=6.0).right, "whatever the sliders show now"
    assert judged("measured", f"{radius / 2:.3f}").hint == "At f/12."


def test_each_wrong_choice_has_its_own_hint():
    assert judged("choice", "2").right
    assert [judged("choice", text).hint for text in ("1", "3")] == ["Not left.", "Not up."]
    for text in ("", "0", "4", "right", "1 2"):
        with pytest.raises(P2SFError):
            judged("choice", text)
    assert LESSON.steps[STEP["choice"]].task.see == (("field_deg", 2.0),)


def test_an_order_names_what_is_exchanged():
    assert judged("order", "1 2 3").right
    assert judged("order", "3 2 1").hint == "From the largest."
    wrong = judged("order", "1 3 2")
    assert not wrong.right and (wrong.words.values["first"], wrong.words.values["second"]) == ("c", "b")
    for text in ("1 2", "1 1 2", "a b c"):
        with pytest.raises(P2SFError):
            judged("order", text)


def test_a_goal_is_judged_by_measures_of_the_students_own_state():
    state = LESSON.state(STEP["goal"])
    task = LESSON.steps[STEP["goal"]].task
    assert not task.judge("", state, state).right
    assert task.judge("", state, apply_changes(state, task.answer.solution)).right
    assert judged("goal", "", sensor_shift_um=0.0).hint == "Go to 1°."
    unmet = judged("goal", "", field_deg=1.0)
    assert not unmet.right and not unmet.hint and str(unmet.words.values["measure"]) != "wd_waves"


@pytest.mark.parametrize("moves", [{"added_waves": (0.0,) * 5 + (1.0,)}, {"errors": (("tilt_x", 1, 1, 0.1),)}])
def test_a_goal_is_not_reached_by_other_means_than_the_sliders(moves):
    state = LESSON.state(STEP["goal"])
    task = LESSON.steps[STEP["goal"]].task
    reached = apply_changes(state, task.answer.solution)
    assert not task.judge("", state, change(reached, **moves)).right
    other = change(default_state("singlet_f6"), field_deg=1.0)
    assert not task.judge("", state, other).right


def test_several_numbers_have_labels_that_say_which_is_wrong():
    assert judged("curve", "0.8; 20 %").right and judged("curve", "80 %; 19").right
    assert judged("curve", "0.8; 0.5").words.values["label"] == "at 50/mm"
    with pytest.raises(P2SFError):
        judged("curve", "0.8")


def test_a_lecture_names_its_lessons_and_keeps_notes_apart():
    assert LESSON.lessons == ("01_what_is_a_psf", "02_diffraction")
    assert LESSON.steps[0].note == "For who teaches." and "teaches" not in LESSON.steps[0].text


def test_another_language_has_the_words_and_the_same_answers(tmp_path):
    path = tmp_path / "lecture.md"
    path.write_text(WORDS, encoding="utf-8")
    german = with_words(LESSON, path, "de")
    for old, new in zip(LESSON.steps, german.steps, strict=True):
        assert new.task.words.shape == old.task.words.shape and new.task.words != old.task.words
    state = german.state(STEP["choice"])
    assert german.steps[STEP["choice"]].task.judge("1", state, state).hint == "Nicht links."
    assert german.steps[0].task.judge("13.4", state, state).hint == "Der Durchmesser."
    assert german.steps[0].note == "Für Lehrende."


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("task: radius\n", "task: diameter\n"),
        ("hint: Zwei.\n", ""),
        (" | oben :: Nicht oben.", ""),
        ("Nicht links.", ""),
        ("order: A; B; C", "order: A; B"),
        ("answer: :: bei 50/mm\n", ""),
        ("task: order", "goal: strehl above 0.5\ntask: order"),
    ],
)
def test_words_that_do_not_fit_the_task_are_one_sentence(tmp_path, old, new):
    assert old in WORDS
    path = tmp_path / "lecture.md"
    path.write_text(WORDS.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(P2SFError, match=r"lecture\.md, line"):
        with_words(LESSON, path, "de")


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("task: radius\n", "", 8),
        ("task: radius", "task: My task", 8),
        ("answer: 6.7 ± 0.2 µm", "answer: 6.7", 9),
        ("answer: 6.7 ± 0.2 µm", "answer: 6.7 ± 0.2 furlongs", 9),
        ("answer: 6.7 ± 0.2 µm\n", "", 8),
        ("answer: 6.7 ± 0.2 µm", "answer: 6.7 ± 0.2 µm\norder: a; b", 8),
        ("wrong: 13.4 ± 0.4 :: The diameter.", "wrong: 13.4 ± 0.4", 10),
        ("measure airy_radius_um ± 3 %\nwrong", "measure airy_radius ± 3 %\nwrong", 20),
        ("measure airy_radius_um ± 3 %\nwrong", "measure airy_radius_um ± 3 % mm\nwrong", 20),
        ("*right", "right", 26),
        ("| *right", "| *right | *down", 26),
        ("order: a; b; c", "order: a; a; c", 32),
        ("wrong: 3 2 1", "wrong: 3 2", 33),
        ("solve: sensor_shift_um 0, field_deg 1\n", "", 39),
        ("wd_waves within ± 0.2", "wd_waves within", 39),
        ("ask: Order.\ntell: a, b, c.\n", "", 31),
        ("order: a; b; c\n", "order: a; b; c\nsolve: field_deg 1\n", 33),
    ],
)
def test_a_bad_task_is_one_sentence_with_file_and_line(old, new, line):
    assert old in LECTURE
    with pytest.raises(P2SFError) as caught:
        parsed(LECTURE.replace(old, new, 1))
    assert str(caught.value).startswith(f"lecture.md, line {line}: ") and "\n" not in str(caught.value)


def test_what_is_shuffled_is_the_same_everywhere_and_never_in_order():
    for count in range(2, 7):
        for seed in ("a", "b", "l1-airy"):
            order = shuffle(count, seed)
            assert sorted(order) == list(range(count)) and order != tuple(range(count))
            assert order == shuffle(count, seed)
