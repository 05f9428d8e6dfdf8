"""The shipped lectures: what they claim is measured, foreseen answers are judged, German is whole, texts are easy."""

import re

import pytest

from p2sf.errors import P2SFError
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.quantities import QUANTITIES
from p2sf_explorer.compute.setup import state_ranges
from p2sf_explorer.course.lectures import AFTER, BEFORE, CHECKS, FOLDER, find_lectures, tasks_of
from p2sf_explorer.i18n.language import texts
from p2sf_explorer.lessons.changes import apply_changes, read_changes
from p2sf_explorer.lessons.claims import holds, measure_claim
from p2sf_explorer.lessons.lesson import COURSE, lesson_files, read_lesson, shipped_lessons, with_words
from p2sf_explorer.lessons.task import ChoiceAnswer, GoalAnswer, NumericAnswer, OrderAnswer
from tests.long.reading_age import HIGHEST, read_all
from tests.support.reading_age import GRADES, syllables

LECTURES = [read_lesson(path) for path in lesson_files(FOLDER)]
GERMAN = [with_words(lesson, FOLDER / "de" / f"{lesson.name}.md", "de") for lesson in LECTURES]
STEPS = [(lesson, number, step) for lesson in LECTURES for number, step in enumerate(lesson.steps)]
CLAIMS = [
    pytest.param(lesson, number, claim, id=f"{lesson.name}-{number + 1}-{claim.text}")
    for lesson, number, step in STEPS
    for claim in step.claims
]
TASKS = [
    pytest.param(lesson.state(number), step.task, id=step.task.name) for lesson, number, step in STEPS if step.task
]
LECTURE = re.compile(r"Lecture (\d)\. ")
NUMBER = re.compile(r"\d+(?:[.,]\d+)*")
EMPHASISED = re.compile(r"(?<!\*)\*([^*]+)\*(?!\*)")
FORESEEN = 40
# Where a student ends who makes the foreseen mistakes, in the order of the file.
MISTAKES = {
    "l1-goal": ("f_number 15.28, wavelength_nm 540", "f_number 7", "f_number 5"),
    "l2-coma": ("field_deg 0.5", "f_number file", "f_number 6"),
    "l3-focus": ("depth_mm inf", "f_number 32", "focus_mm 5000"),
    "l4-red": ("wavelength_nm 587.6", "f_number 32", "sensor_shift_um -50", "sensor_shift_um 200"),
    "l5-contrast": ("f_number file", "f_number 22", "f_number 5"),
    "l6-slope": ("field_deg 0", "f_number 11", "field_deg 10", "depth_mm 2000"),
}


@pytest.mark.parametrize(("lesson", "number", "claim"), CLAIMS)
def test_a_claim_is_what_the_program_measures(lesson, number, claim):
    value = measure_claim(claim, lesson.state(number))
    assert holds(claim, value), f"{claim.text}: measured {value:.6g}"


@pytest.mark.parametrize(("state", "task"), TASKS)
def test_right_answers_are_right_and_foreseen_wrong_ones_get_their_own_hint(state, task):
    answer = task.answer
    if isinstance(answer, NumericAnswer):
        right = [str(part.target(state)) for part in answer.parts]
        wrong = [(f"{part.target(state)} {part.unit}", hint) for part, hint in answer.wrong]
    elif isinstance(answer, ChoiceAnswer):
        why = f" {answer.why + 1} 4" if answer.reasons else ""
        right = [f"{answer.right + 1}{why}"]
        wrong = [
            (f"{k + 1}{why}", hint) for k, hint in enumerate(answer.hints) if k != answer.right and any(answer.hints)
        ]
    elif isinstance(answer, OrderAnswer):
        right = [" ".join(str(k + 1) for k in range(len(answer.items)))]
        wrong = [(" ".join(str(k + 1) for k in order), hint) for order, hint in answer.wrong]
    else:
        right, wrong = [""], []
    now = apply_changes(state, answer.solution) if isinstance(answer, GoalAnswer) else state
    assert task.judge(";".join(right), state, now).right
    for text, hint in wrong:
        judged = task.judge(text, state, state)
        assert (judged.right, judged.hint) == (False, hint) and hint
    if isinstance(answer, GoalAnswer):
        assert not task.judge("", state, state).right, "nothing is left to do"
        for moves, (_, hint) in zip(MISTAKES[task.name], answer.wrong, strict=True):
            judged = task.judge("", state, apply_changes(state, read_changes(moves, 1, "a mistake")))
            assert (judged.right, judged.hint) == (False, hint), moves


def test_an_untouched_page_is_not_told_that_a_slider_was_moved():
    """The ring at f/6 is 4.29979 µm, and "below 4.3" said to who had touched nothing that the stop was opened."""
    state, task = next(entry.values for entry in TASKS if entry.id == "l1-goal")
    judged = task.judge("", state, state)
    assert not judged.right and judged.hint not in [hint for _, hint in task.answer.wrong]


def test_there_are_six_lectures_of_three_tasks():
    others = (*CHECKS, "unknown_stars")
    lectures = [lesson for lesson in LECTURES if lesson.name not in others]
    assert [lesson.name for lesson in lectures] == [f"lecture_{k}" for k in range(1, 7)]
    for lesson in lectures:
        named = [step.task for step in lesson.steps if step.task and step.title.startswith("Task ")]
        assert len(named) == 3 and all(task.hints or isinstance(task.answer, ChoiceAnswer) for task in named)
        assert lesson.steps[0].note and "- " in lesson.steps[0].text
    names = [task.name for lesson in LECTURES if lesson.name != AFTER for task in tasks_of(lesson)]
    assert len(set(names)) == len(names)


def test_both_forms_of_the_check_have_twelve_items_of_every_lecture_that_are_not_the_same():
    """An item is told by its name; its note names the lecture that it belongs to, the same in both forms."""
    forms = [next(lesson for lesson in LECTURES if lesson.name == name) for name in (BEFORE, AFTER)]
    before, after = ({step.task.name: step for step in form.steps} for form in forms)
    assert len(before) == 12 and list(before) == list(after)
    lectures = {LECTURE.match(step.note)[1] for step in before.values()}
    assert lectures == set("123456")
    for name, step in before.items():
        other, (first, second) = after[name], (step.task.answer, after[name].task.answer)
        assert step.note == other.note and step.text != other.text
        assert first.reasons == second.reasons and len(first.reasons) == 3 and first.why == second.why
        assert not any(first.hints) and second.right == first.right == 0 and all(second.hints[1:])


def test_ten_stars_are_unknown_and_of_some_one_picture_leaves_a_sign_open():
    lesson = find_lectures()[0]["unknown_stars"]
    tasks = tasks_of(lesson)
    assert len(tasks) == len(lesson.steps) == 10
    right = [task.answer.options[task.answer.right] for task in tasks if isinstance(task.answer, ChoiceAnswer)]
    assert sum("of either sign" in text for text in right) == 3, "defocus, astigmatism, spherical aberration"
    assert [step.move for step in lesson.steps].count("sensor_shift_um") == 3, "a second focus"
    assert list(find_lectures()[0])[-2:] == ["unknown_stars", AFTER]


def test_an_answer_is_right_with_its_reason_alone():
    task = find_lectures()[0][BEFORE].steps[0].task
    state = find_lectures()[0][BEFORE].state(0)
    judged = {text: task.judge(text, state, state).right for text in ("1 1 1", "1 1 4", "1 2 4", "2 1 4")}
    assert judged == {"1 1 1": True, "1 1 4": True, "1 2 4": False, "2 1 4": False}
    for text in ("1", "1 1", "1 1 5", "1 4 1", "0 1 1", ""):
        with pytest.raises(P2SFError, match="a reason and how sure"):
            task.judge(text, state, state)


def test_forty_wrong_answers_and_more_are_foreseen_each_with_a_hint_of_its_own():
    lectures = [lesson for lesson in LECTURES if lesson.name not in CHECKS]
    words = [task.words for lesson in lectures for task in tasks_of(lesson)]
    hints = [(*one.wrong, *filter(None, one.option_hints)) for one in words]
    assert all(len(set(one)) == len(one) for one in hints)
    assert len({hint for one in hints for hint in one}) >= FORESEEN


def test_the_lessons_that_lectures_play_are_shipped_and_all_of_the_course_is_played():
    shipped = {lesson.name for lesson in shipped_lessons()}
    played = {name for lesson in LECTURES for name in lesson.lessons}
    assert played <= shipped
    assert {name[:2] for name in played} == set(COURSE)


@pytest.mark.parametrize(("lesson", "number", "step"), STEPS, ids=[f"{a.name}-{b + 1}" for a, b, _ in STEPS])
def test_every_page_has_a_picture_and_sliders_reach_what_it_sets(lesson, number, step):
    state = lesson.state(number)
    assert compute.live(state, "preview").psf.values.sum() == pytest.approx(1, abs=1e-3)
    limits = state_ranges(state)
    for quantity in QUANTITIES:
        value, scale = quantity.shown(state, limits), quantity.scale(limits)
        if quantity.key != "focus_mm":
            assert scale.value(scale.travel(value)) == pytest.approx(value), quantity.title


def told(step) -> str:
    words = step.task.words if step.task else None
    parts = [step.title, step.text, step.attempt, step.question, step.answer, step.note]
    if words:
        parts += [
            *words.labels,
            *words.options,
            *words.option_hints,
            *words.reasons,
            *words.items,
            *words.wrong,
            *words.hints,
        ]
    return "\n".join(parts)


@pytest.mark.parametrize(("lesson", "said"), zip(LECTURES, GERMAN, strict=True), ids=[one.name for one in LECTURES])
def test_german_has_the_same_parts_numbers_and_controls(lesson, said):
    known = texts("de")
    assert said.title != lesson.title and said.about != lesson.about
    for old, new in zip(lesson.steps, said.steps, strict=True):
        numbers = [{found.replace(",", ".") for found in NUMBER.findall(told(step))} for step in (old, new)]
        assert numbers[0] == numbers[1], old.title
        for part in ("text", "attempt", "question", "answer", "note"):
            assert bool(getattr(new, part)) == bool(getattr(old, part)), f"{old.title}: {part}"
        for control in EMPHASISED.findall(told(old)):
            assert f"*{known.get(control, control)}*" in told(new), control


def test_texts_are_for_pupils_of_sixteen():
    grades = {(name, language): GRADES[language](text) for name, language, text in read_all()}
    assert {key: grade for key, grade in grades.items() if grade > HIGHEST} == {}


def test_the_indices_are_those_of_their_authors():
    """By hand: 6 words of a syllable; 5 words, 3 of three syllables and more than six letters, 2 of one syllable."""
    assert GRADES["en"]("The cat sat on the mat.") == pytest.approx(0.39 * 6 + 11.8 - 15.59)
    expected = 0.1935 * 60 + 0.1672 * 5 + 0.1297 * 60 - 0.0327 * 40 - 0.875
    assert GRADES["de"]("Das Objektiv macht unscharfe Bildränder.") == pytest.approx(expected)
    counts = {"wave": 1, "waves": 1, "people": 2, "closed": 1, "aperture": 3, "spherical": 3, "quarter": 2}
    assert {word: syllables(word, "en") for word in counts} == counts
    german = {"Blendenzahl": 3, "Öffnungsfehler": 4, "Bild": 1, "Welle": 2, "breiter": 2, "Pupille": 3}
    assert {word: syllables(word, "de") for word in german} == german
