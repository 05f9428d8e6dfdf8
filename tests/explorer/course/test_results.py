"""Files of results: written whole, read strictly, thirty of them as a table and as CSV, damaged ones named."""

import csv
import json
from dataclasses import replace

import pytest

from p2sf.cli import main
from p2sf.errors import ExportError
from p2sf_explorer.course.lectures import course_version
from p2sf_explorer.course.results_table import (
    OF_TASK,
    PERSON,
    concept_gain,
    item_gains,
    read_folder,
    sure_but_wrong,
    write_table,
)
from p2sf_explorer.lessons.task_record import FORMAT, MARK, CourseResult, TaskRecord, read_result, write_result

KNOWN = (("lecture_1", "airy"), ("lecture_1", "flare"), ("lecture_2", "never"))


def result_of(number: int) -> CourseResult:
    """Return what student ``number`` did: the first task right at the attempt 1 + number mod 3, the second never."""
    made = CourseResult(name=f"Student {number:02d}", course="12345678", language="de")
    record = TaskRecord(hints=number % 2, seconds=10.0 + number)
    for attempt in range(number % 3 + 1):
        record = record.with_answer(f"{attempt} µm", right=attempt == number % 3)
    made = made.with_record("lecture_1", "airy", record)
    record = replace(TaskRecord().with_answer("1", False), because="It turns.")
    return made.with_record("lecture_1", "flare", record)


@pytest.fixture
def folder(tmp_path):
    for number in range(30):
        write_result(tmp_path / f"result_{number:02d}.json", result_of(number))
    return tmp_path


def test_a_file_is_read_as_it_was_written(tmp_path):
    made = replace(result_of(2), name="Ä. Müller")
    write_result(tmp_path / "a.json", made)
    assert read_result(tmp_path / "a.json") == made


def test_an_answer_after_the_solution_is_not_right_by_itself():
    assert TaskRecord(told=True).with_answer("1", True).right is False
    assert TaskRecord(right=True).with_answer("1", False).right is True


def test_thirty_files_are_a_table_of_students_and_tasks(folder):
    table = read_folder(folder, KNOWN)
    assert len(table.rows) == 30 and table.tasks == ("lecture_1/airy", "lecture_1/flare") and not table.faults
    airy, flare = (table.summary(task) for task in table.tasks)
    assert (airy.count, airy.share_right) == (30, 1.0) and (flare.count, flare.share_right) == (30, 0.0)
    assert airy.wrong == (("0 µm", 20),) and flare.wrong == (("1", 30),)  # two thirds were wrong at first


def test_the_gain_is_hakes_of_those_who_took_both_checks(tmp_path):
    """Of four questions 1 and 3 are right before, 3 and 4 after: 50 % and 87.5 %, so three quarters are gained."""
    for number, (before, after) in enumerate(((1, 3), (3, 4))):
        made = CourseResult(name=str(number))
        for question in range(4):
            for lesson, right in (("check_before", before), ("check_after", after)):
                made = made.with_record(lesson, f"c{question}", TaskRecord().with_answer("1", question < right))
        write_result(tmp_path / f"{number}.json", made)
    absent = CourseResult(name="only before").with_record("check_before", "c0", TaskRecord().with_answer("1", True))
    write_result(tmp_path / "absent.json", absent)
    items = item_gains(read_folder(tmp_path))
    assert [(one.before, one.after) for one in items.values()] == [(1, 1), (0.5, 1), (0.5, 1), (0, 0.5)]
    gain = concept_gain(read_folder(tmp_path))
    assert (gain.count, gain.before, gain.after, gain.share_gained) == (2, 0.5, 0.875, 0.75)
    (tmp_path / "0.json").unlink()
    (tmp_path / "1.json").unlink()
    assert concept_gain(read_folder(tmp_path)) is None


def test_who_is_wrong_and_sure_of_it_is_counted(tmp_path):
    """The third number of an answer is how sure one was, from 1 to 4; a guess that is wrong is no misconception."""
    for number, (before, after) in enumerate((("2 1 4", "1 1 4"), ("2 1 2", "2 1 3"), ("1 1 4", "2 1"))):
        made = CourseResult(name=str(number))
        for lesson, text in (("check_before", before), ("check_after", after)):
            made = made.with_record(lesson, "i1", TaskRecord().with_answer(text, text.startswith("1")))
        write_result(tmp_path / f"{number}.json", made)
    assert sure_but_wrong(read_folder(tmp_path), "i1") == (1, 1)


def test_the_csv_has_one_row_a_student_and_the_same_numbers(folder, tmp_path):
    path = write_table(read_folder(folder, KNOWN), tmp_path / "table.csv")
    with path.open(encoding="utf-8-sig", newline="") as handle:
        rows = list(csv.reader(handle))
    assert len(rows) == 31 and {len(row) for row in rows} == {len(PERSON) + 1 + 2 * len(OF_TASK)}
    head, fifth = rows[0], dict(zip(rows[0], rows[6], strict=True))
    assert head[: len(PERSON)] == list(PERSON)
    assert (fifth["name"], fifth["right in all"]) == ("Student 05", "1")
    assert (fifth["lecture_1/airy right"], fifth["lecture_1/airy attempts"]) == ("1", "3")
    assert (fifth["lecture_1/airy hints"], fifth["lecture_1/airy seconds"]) == ("1", "15")
    assert fifth["lecture_1/flare last answer"] == "1" and fifth["lecture_1/flare because"] == "It turns."


def test_no_name_or_answer_becomes_a_formula_in_a_spreadsheet(tmp_path):
    record = TaskRecord().with_answer("=1+1", False)
    write_result(tmp_path / "a.json", CourseResult(name="@SUM(A1)").with_record("lecture_1", "airy", record))
    record = TaskRecord().with_answer("-6.7", False)
    write_result(tmp_path / "b.json", CourseResult(name="+B").with_record("=2+3", "airy", record))
    path = write_table(read_folder(tmp_path), tmp_path / "table.csv")
    cells = [cell for row in csv.reader(path.read_text(encoding="utf-8-sig").splitlines()) for cell in row]
    assert not [cell for cell in cells if cell.startswith(("=", "@", "+"))] and "-6.7" in cells


def test_a_file_cannot_steer_the_terminal(tmp_path, capsys):
    record = TaskRecord().with_answer("\x1b[2J6.7\u00a0µm", False)
    write_result(tmp_path / "a.json", CourseResult(name="A\x07").with_record("lecture\n", "airy", record))
    assert read_result(tmp_path / "a.json").record("lecture ", "airy").answers == (" [2J6.7 µm",)
    assert main(["course", "--results", str(tmp_path)]) == 0
    assert all(line.isprintable() for line in capsys.readouterr().out.splitlines())


GOOD = {
    MARK: FORMAT,
    "name": "A",
    "program": "1",
    "course": "1",
    "language": "en",
    "tasks": {
        "lecture_1/airy": {"answers": ["1"], "hints": 0, "right": False, "told": False, "seconds": 1.0, "because": ""}
    },
}


def damaged(part: str, value: object) -> str:
    content = json.loads(json.dumps(GOOD))
    home = content["tasks"]["lecture_1/airy"] if part in GOOD["tasks"]["lecture_1/airy"] else content
    home[part] = value
    return json.dumps(content)


@pytest.mark.parametrize(
    "content",
    [
        "",
        "{",
        "[]",
        "null",
        '{"lens": "achromat_f6"}',
        "[" * 100_000,
        json.dumps(GOOD)[:-20],
        damaged(MARK, 99),
        damaged("name", 3),
        damaged("tasks", []),
        damaged("tasks", {"a/b": None}),
        damaged("answers", "1"),
        damaged("answers", [1]),
        damaged("hints", -1),
        damaged("hints", True),
        damaged("right", 1),
        damaged("seconds", "long"),
        damaged("because", 3),
        damaged("seconds", -1),
        damaged("seconds", float("nan")),
        damaged("seconds", 10**400),
    ],
)
def test_a_damaged_file_is_named_and_the_others_are_read(folder, content):
    (folder / "bad.json").write_text(content, encoding="utf-8")
    table = read_folder(folder)
    assert len(table.rows) == 30 and len(table.faults) == 1
    assert str(table.faults[0]).startswith("bad.json ") and "\n" not in str(table.faults[0])


def test_a_file_of_other_bytes_and_a_folder_named_as_a_file_are_named(folder):
    (folder / "bad.json").write_bytes(b"\xff\xfe\x00")
    (folder / "worse.json").mkdir()
    table = read_folder(folder)
    assert len(table.rows) == 30 and [str(fault).split()[0] for fault in table.faults] == ["bad.json", "worse.json"]


def test_a_folder_without_results_is_one_sentence(tmp_path):
    for path in (tmp_path, tmp_path / "nowhere"):
        with pytest.raises(ExportError):
            read_folder(path)


def test_the_command_line_makes_the_table(folder, tmp_path, capsys):
    (folder / "bad.json").write_text("{")
    assert main(["course", "--results", str(folder)]) == 0
    shown = capsys.readouterr()
    assert "lecture_1/airy" in shown.out and "bad.json" in shown.err
    assert main(["course", "--results", str(folder), "-o", str(tmp_path / "table.csv")]) == 0
    assert len((tmp_path / "table.csv").read_text(encoding="utf-8-sig").splitlines()) == 31
    assert main(["course", "--results", str(tmp_path / "nowhere")]) == 2
    assert main(["course", "--results", str(folder), "-o", str(tmp_path / "table.xls")]) == 2


def test_the_version_of_a_course_changes_with_its_words(tmp_path):
    (tmp_path / "one.md").write_text("a", encoding="utf-8")
    first = course_version(tmp_path)
    course_version.cache_clear()
    assert course_version(tmp_path) == first
    course_version.cache_clear()
    (tmp_path / "one.md").write_text("b", encoding="utf-8")
    assert course_version(tmp_path) != first and len(first) == 8
