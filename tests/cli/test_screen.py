"""Tables of the command line: what a terminal and a pipe show of the same rows."""

from collections import Counter
from unicodedata import east_asian_width

import pytest

from p2sf.cli.screen import print_table, text_width

HEADS = "name", "focal length, mm", "what it is"
ROWS = [
    ("双高斯", 100.0, "six elements round a stop, excellent on the axis"),
    ("triplet", 50.25, "the fewest elements that correct all five sums"),
]


def columns_of(line: str) -> int:
    return sum(2 if east_asian_width(letter) == "W" else 1 for letter in line)


def test_columns_stand_below_each_other_whatever_their_letters_take(capsys):
    print_table("Lenses", HEADS, ROWS)
    title, head, *body = capsys.readouterr().out.splitlines()
    assert title == "Lenses" and len(body) == len(ROWS)
    for line, (name, _, what) in zip(body, ROWS, strict=True):
        assert line.startswith(name) and what in line
        assert columns_of(line[: line.index(what)]) == head.index("what it is")
    assert [line.split()[1] for line in body] == ["100", "50.25"]
    ends = {
        columns_of(line[: line.index(number) + len(number)])
        for line, number in zip(body, ("100", "50.25"), strict=True)
    }
    assert ends == {head.index("mm") + 2}


@pytest.mark.parametrize("room", [40, 60, 120])
def test_a_table_keeps_within_a_terminal_and_loses_no_word(capsys, monkeypatch, room):
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", str(room))
    monkeypatch.setenv("TERM", "dumb")
    print_table("Lenses", HEADS, ROWS)
    page = capsys.readouterr().out
    assert max(map(columns_of, page.splitlines())) <= room and "\033" not in page
    assert sorted(page.replace("─", "").split()) == sorted(" ".join(["Lenses", *HEADS, *map(words, ROWS)]).split())


@pytest.mark.parametrize(
    ("heads", "rows"),
    [
        (("name", "remark"), [("alpha " * 10, "beta " * 12)]),
        (("name", "n"), [("日本語レンズ名前が長い場合はどうなるでしょうか" * 2, 1.5), ("x", 2.5)]),
        (("S", "W040, waves", "W131, waves", "W222, waves"), [("1", "-0.12345", "0.2", "12.5")] * 2),
    ],
)
def test_columns_of_text_share_what_room_there_is(capsys, monkeypatch, heads, rows):
    """Two long ones, letters that are two columns wide, and numbers that are given as text, under long heads."""
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.setenv("COLUMNS", "40")
    print_table("T", heads, rows)
    page = capsys.readouterr().out
    assert max(map(columns_of, page.splitlines())) <= 40
    assert not Counter("".join("".join(map(str, row)) for row in rows).replace(" ", "")) - Counter(page)


def words(row: tuple[str, float, str]) -> str:
    name, number, what = row
    return f"{name} {number:g} {what}"


def test_an_accent_of_its_own_takes_no_column():
    assert text_width("é") == text_width("e\u0301") == 1
