"""Lectures in the window: tasks answered by mouse and keyboard, hints, solutions, progress, results in and out."""

import html
import os

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtWidgets import QFileDialog, QInputDialog

from p2sf_explorer.course.lectures import AFTER, BEFORE, course_version
from p2sf_explorer.course.results_window import FIRST
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.lessons import task_record
from p2sf_explorer.lessons.answer_fields import OptionLabel, answer_field
from p2sf_explorer.lessons.controller import OPEN, progress_path
from p2sf_explorer.lessons.task import ChoiceAnswer, Exercise
from p2sf_explorer.lessons.task_record import CourseResult, TaskRecord, read_result, write_result
from tests.explorer.course.test_tasks import LESSON, STEP
from tests.support.windows.windows import at_rest

NAME = "lecture_1"
MARKED = """---
title: A mark
about: One question.
lens: achromat_f6
state: field_deg 0
---
## One
set: held_scales psf 18
task: mark-it
choose: *wide | narrow :: No.
mark: FORM MEASURE
see: f_number 12
ask: How wide?
tell: Wide.
"""


@pytest.fixture
def at(teaching):
    """Return a function that goes to a task and returns the panel that asks it."""

    def go(task: str):
        teaching._go(NAME, STEP[task])
        return teaching.panel.task

    return go


def record(teaching, task: str, lesson: str = NAME) -> TaskRecord:
    return teaching.desk.result().record(lesson, task)


def test_a_number_is_typed_and_checked_with_enter(window, qtbot, teaching, at):
    panel = at("radius")
    (edit,) = panel.field.edits
    qtbot.keyClicks(edit, "13,4")
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert "The diameter." in panel.verdict.text() and not record(teaching, "radius").right
    edit.clear()
    qtbot.keyClicks(edit, "6,7 µm")
    qtbot.mouseClick(panel.check, Qt.MouseButton.LeftButton)
    assert record(teaching, "radius").right and record(teaching, "radius").answers == ("13,4", "6,7 µm")
    assert not panel.field.isEnabled() and not panel.check.isVisible()


def test_what_cannot_be_read_costs_no_attempt(teaching, at):
    panel = at("radius")
    for text in ("", "much", "6.7 s"):
        panel.field.edits[0].setText(text)
        panel.check.click()
        assert panel.verdict.isVisible() and record(teaching, "radius").attempts == 0


@pytest.mark.parametrize(("language", "text"), [("de", "6.700"), ("en", "6,700 µm")])
def test_an_answer_that_can_mean_two_numbers_is_asked_for_again(teaching, at, language, text):
    panel = at("radius")
    set_language(language)
    try:
        panel.field.edits[0].setText(text)
        panel.check.click()
    finally:
        set_language("en")
    assert "6700" in panel.verdict.text() and record(teaching, "radius").attempts == 0


def test_hints_come_one_at_a_time_and_are_counted(teaching, at):
    panel = at("radius")
    assert not panel.hints.isVisible()
    panel.hint.click()
    assert panel.hints.text().count("\n") == 0 and record(teaching, "radius").hints == 1
    panel.hint.click()
    assert panel.hints.text().count("\n") == 1 and record(teaching, "radius").hints == 2 and not panel.hint.isVisible()


def test_an_option_is_chosen_by_its_letter_or_its_text_and_the_window_shows_what_was_predicted(
    window, qtbot, teaching, at
):
    panel = at("choice")
    labels = {label.text(): label for label in panel.field.findChildren(OptionLabel)}
    assert set(labels) == {"left", "right", "up"}
    qtbot.mouseClick(labels["up"], Qt.MouseButton.LeftButton)
    assert panel.field.text() == "3"
    panel.check.click()
    assert "Not up." in panel.verdict.text() and window.store.state.optics.field_deg == 2.0
    qtbot.mouseClick(panel.field.group.button(1), Qt.MouseButton.LeftButton)
    panel.check.click()
    assert record(teaching, "choice").right and record(teaching, "choice").attempts == 2


def test_after_an_answer_one_sentence_says_why_and_is_kept(qtbot, teaching, at):
    panel = at("choice")
    assert not panel.because.isVisible(), "first the answer"
    panel.field.group.buttons()[0].click()
    panel.check.click()
    qtbot.keyClicks(panel.because, "it turns ")
    qtbot.keyClick(panel.because, Qt.Key.Key_Return)
    assert record(teaching, "choice").because == "it turns" and record(teaching, "choice").attempts == 1
    at("radius")
    assert not panel.because.isVisible()
    assert at("choice").because.text() == "it turns"


def test_answer_reason_and_how_sure_are_chosen_one_below_the_other(qtbot):
    answer = ChoiceAnswer(("yes", "no"), 0, ("", ""), ("because", "for", "since"), 1)
    field = answer_field(Exercise("sure", answer))
    qtbot.addWidget(field)
    field.show()
    assert field.text() == ""
    for group, number in zip(field.groups, (0, 1, 3), strict=True):
        qtbot.mouseClick(group.button(number), Qt.MouseButton.LeftButton)
    assert field.text() == "1 2 4" and answer.judge(field.text(), None, None).right
    assert {group.button(0).accessibleName() for group in field.groups} >= {"a guess"}
    again = answer_field(Exercise("sure", answer))
    qtbot.addWidget(again)
    again.show_answer("1 2 4")
    assert again.text() == "1 2 4"


@pytest.mark.parametrize(("form", "measure", "truth"), [("ring", "airy_radius_um", "8.60"), ("level", "rms_waves", "")])
def test_what_is_expected_is_marked_on_the_picture_and_told_beside_what_is(
    window, qtbot, teaching, tmp_path, form, measure, truth
):
    """A click 6 µm above the chief ray and 8 µm beside it is a ring of 10 µm, or a level of 6 µm."""
    text = MARKED.replace("FORM", form).replace("MEASURE", measure)
    (tmp_path / "course" / "lecture_2.md").write_text(text, encoding="utf-8")
    teaching._go("lecture_2", 0)
    at_rest(window, qtbot)
    chart, panel = window.panels["psf"].map.chart, teaching.panel.task
    assert panel.to_mark.isVisible() and chart.expects == form and chart.expected is None
    before = chart.grab().toImage()
    at = QPointF(*(float(part) for part in chart.to_pixels(8.0, 6.0)))
    qtbot.mouseClick(chart, Qt.MouseButton.LeftButton, pos=at.toPoint())
    assert chart.expected == pytest.approx({"ring": 10.0, "level": 6.0}[form], abs=3 * chart.per_pixel())
    row = round(at.y()) if form == "level" else round(float(chart.to_pixels(0.0, 10.0)[1]))
    column = round(float(chart.to_pixels(0.0 if form == "ring" else -10.0, 0.0)[0]))
    after = chart.grab().toImage()
    strip = [(column + k, row + j) for k in range(-8, 9) for j in (-2, -1, 0, 1, 2)]
    assert any(after.pixelColor(*at) != before.pixelColor(*at) for at in strip), "it is painted there"
    panel.field.show_answer("1")
    panel.check.click()
    assert "You marked" in panel.verdict.text() and truth in panel.verdict.text()
    assert chart.expected is not None, "it stays beside what is seen"
    teaching._go(NAME, 0)
    qtbot.waitUntil(lambda: not chart.expects)
    assert not chart.pins


def test_the_line_under_the_stage_does_not_give_the_answer_while_a_question_is_open(window, qtbot, teaching, at):
    panel, line = at("choice"), window.foot.sentence
    at_rest(window, qtbot)
    assert line.text() == OPEN
    panel.field.show_answer(str(LESSON.steps[STEP["choice"]].task.answer.right + 1))
    panel.check.click()
    at_rest(window, qtbot)
    assert line.text() not in ("", OPEN)
    at("radius")
    assert line.text() == OPEN
    teaching.leave()
    at_rest(window, qtbot)
    assert line.text() not in ("", OPEN)


def test_an_open_question_leaves_out_figures_and_what_is_altered(window, qtbot, teaching, at):
    at("choice")
    at_rest(window, qtbot)
    window.store.update(added_waves=(1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    at_rest(window, qtbot)
    assert "RMS" not in window.caption.text and "Strehl" not in window.caption.text
    assert "nm" in window.caption.text and "What-if" not in window.status.warning.text()
    teaching.leave()
    window.store.update(added_waves=(1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    at_rest(window, qtbot)
    assert "RMS" in window.caption.text and "What-if" in window.status.warning.text()


def test_figures_come_back_with_the_answer(window, qtbot, teaching, at):
    panel = at("choice")
    at_rest(window, qtbot)
    assert "RMS" not in window.caption.text
    panel.field.show_answer(str(LESSON.steps[STEP["choice"]].task.answer.right + 1))
    panel.check.click()
    at_rest(window, qtbot)
    assert "RMS" in window.caption.text


def test_items_are_moved_into_order_by_buttons(teaching, at):
    panel = at("order")
    field = panel.field
    assert field.text() != "1 2 3"
    for wanted in range(3):
        for row in range(3):
            field.list.setCurrentRow(row)
            while field.text().split()[wanted] != str(wanted + 1) and field.text().split()[row] == str(wanted + 1):
                field.up.click()
                row -= 1
    assert field.text() == "1 2 3"
    panel.check.click()
    assert record(teaching, "order").right


def test_a_goal_is_reached_with_the_sliders(window, qtbot, drag, teaching, at):
    panel = at("goal")
    panel.check.click()
    assert not record(teaching, "goal").right and record(teaching, "goal").attempts == 1
    for key, value in (("sensor_shift_um", "0"), ("field_deg", "1")):
        edit = window.controls.rows[key].edit
        edit.setFocus()
        edit.selectAll()
        qtbot.keyClicks(edit, value)
        qtbot.keyClick(edit, Qt.Key.Key_Return)
    panel.check.click()
    assert record(teaching, "goal").right


def test_undo_takes_no_answer_back_and_set_up_again_is_undone(window, teaching, at):
    panel = at("goal")
    panel.check.click()
    window.store.update(sensor_shift_um=10.0)
    panel.again.click()
    assert window.store.state.optics.sensor_shift_um == 200.0
    window.store.undo()
    assert window.store.state.optics.sensor_shift_um == 10.0 and record(teaching, "goal").attempts == 1


def test_the_solution_closes_the_task_and_counts(window, teaching, at):
    panel = at("radius")
    teaching.panel.reveal.click()
    assert record(teaching, "radius").told and not record(teaching, "radius").right and not panel.check.isVisible()
    assert teaching.panel.answer.isVisible()


def test_progress_stays_after_a_restart(teaching, at):
    at("radius").field.edits[0].setText("6.7")
    teaching.panel.task.check.click()
    kept = read_result(progress_path())
    assert kept.record(NAME, "radius").right and kept.name == ""
    teaching.desk._read = None
    at("order")
    panel = at("radius")
    assert panel.field.edits[0].text() == "6.7" and not panel.check.isVisible() and panel.verdict.isVisible()


def test_damaged_progress_is_put_aside_and_not_lost(teaching, at):
    progress_path().write_text("{", encoding="utf-8")
    at("radius").field.edits[0].setText("6.7")
    teaching.panel.task.check.click()
    assert record(teaching, "radius").right
    assert progress_path().with_suffix(".damaged").read_text() == "{"


@pytest.mark.parametrize(("name", "told"), [(BEFORE, False), (AFTER, True)])
def test_a_concept_check_takes_one_answer_and_tells_only_afterwards(teaching, name, told):
    teaching.begin(name)
    panel = teaching.panel.task
    assert not teaching.panel.reveal.isVisible() and not panel.hint.isVisible()
    panel.field.show_answer("2")
    panel.check.click()
    assert record(teaching, "c1", name).answers == ("2",) and not record(teaching, "c1", name).right
    assert not panel.field.isEnabled() and "Never shown." not in teaching.panel.title.text()
    assert ("Never shown." in panel.verdict.text()) == told and teaching.panel.reveal.isVisible() == told
    assert record(teaching, "c1", {BEFORE: AFTER, AFTER: BEFORE}[name]).attempts == 0


def test_the_check_after_the_course_shows_nothing_of_the_answer_before(teaching):
    teaching.begin(BEFORE)
    panel = teaching.panel.task
    panel.field.show_answer("2")
    panel.check.click()
    teaching.begin(AFTER)
    assert not panel.field.text() and not panel.verdict.isVisible() and panel.field.isEnabled()


def test_answers_that_are_written_at_the_same_time_of_a_file_are_all_kept(teaching, at, monkeypatch):
    """Some file systems count whole seconds."""

    def write(path, result):
        write_result(path, result)
        os.utime(path, (1e9, 1e9))

    monkeypatch.setattr(task_record, "write_result", write)
    for task in ("radius", "choice", "order"):
        at(task)
        teaching.panel.task.hint.click()
        teaching.desk.answer({"radius": "6.7", "choice": "2", "order": "1 2 3"}[task])
    assert [record(teaching, task).right for task in ("radius", "choice", "order")] == [True] * 3


def test_what_a_students_file_says_is_never_read_as_html(course, tmp_path):
    folder, trick = tmp_path / "class", '<img src="file:///x.png">'
    folder.mkdir()
    answered = TaskRecord().with_answer(trick, False)
    write_result(folder / "a.json", CourseResult(name="A").with_record(NAME, "radius", answered))
    course.open_folder(folder)
    table = course.results.table
    tips = table.item(0, FIRST).toolTip(), table.horizontalHeaderItem(FIRST).toolTip()
    assert all(trick not in tip and html.unescape(tip).count(trick) == 1 for tip in tips)
    assert course.results.faults.textFormat() == Qt.TextFormat.PlainText


def test_a_lecture_plays_its_lessons_and_they_lead_back(window, teaching):
    teaching.begin(NAME)
    assert LESSON.lessons[1] in teaching.panel.blocks.text()
    teaching.panel.blocks.linkActivated.emit(LESSON.lessons[1])
    assert window.store.state.lesson.name == LESSON.lessons[1]
    for _ in teaching.lessons()[LESSON.lessons[1]].steps:
        teaching.move(1)
    assert (window.store.state.lesson.name, window.store.state.lesson.step) == (NAME, 0)
    teaching.begin(LESSON.lessons[1])
    window.store.update(lesson_name="")
    teaching.begin(LESSON.lessons[1])
    teaching.move(len(teaching.lessons()[LESSON.lessons[1]].steps))
    assert window.store.state.lesson.name not in ("", NAME), "begun by itself, it leads to the next lesson"


@pytest.fixture
def course(window, teaching):
    yield window.course
    for dialog in (window.course.list, window.course.results):
        if dialog:
            dialog.hide()
            dialog.deleteLater()
    window.course.list = window.course.results = None


def test_the_list_says_how_far_one_is(window, teaching, course, at):
    at("radius").field.edits[0].setText("6.7")
    teaching.panel.task.check.click()
    course.open_list()
    lines = [course.list.list.item(row).text() for row in range(course.list.list.count())]
    assert len(lines) == 3 and "1 " in lines[1].split("\n")[2] and str(len(STEP)) in lines[1].split("\n")[2]


def test_results_are_saved_under_a_name(window, teaching, course, at, monkeypatch, tmp_path):
    course.ask_save()
    assert not list(tmp_path.glob("*.json")), "nothing was answered"
    at("radius").field.edits[0].setText("6.7")
    teaching.panel.task.check.click()
    monkeypatch.setattr(QInputDialog, "getText", lambda *_: ("  Ada  Lovelace ", True))
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "ada"), ""))
    course.ask_save()
    saved = read_result(tmp_path / "ada.json")
    assert (saved.name, saved.course) == ("Ada Lovelace", course_version())
    assert saved.record(NAME, "radius").right


def test_a_folder_of_thirty_opens_as_a_table(window, course, tmp_path, monkeypatch):
    folder = tmp_path / "class"
    folder.mkdir()
    for number in range(30):
        result = CourseResult(name=f"S {number:02d}", course=course_version())
        result = result.with_record(NAME, "radius", TaskRecord().with_answer("6.7", number % 2 == 0))
        write_result(folder / f"{number}.json", result)
    (folder / "bad.json").write_text("{")
    course.open_folder(folder)
    shown = course.results
    assert shown.isVisible() and shown.table.rowCount() == 30 and shown.table.columnCount() == FIRST + 1
    assert "50 %" in shown.table.horizontalHeaderItem(FIRST).text() and "bad.json" in shown.faults.text()
    assert [shown.table.item(row, FIRST).text()[0] for row in range(2)] == ["✓", "✗"]
    shown.write(tmp_path / "table.csv")
    assert len((tmp_path / "table.csv").read_text(encoding="utf-8-sig").splitlines()) == 31
    refused = []
    window.store.refused.connect(refused.append)
    course.open_folder(tmp_path / "nowhere")
    window.store.refused.disconnect(refused.append)
    assert len(refused) == 1
