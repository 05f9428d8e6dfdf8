"""`p2sf import`: the report on screen and as JSON, what is written, and exit code 2 where a lens is refused."""

import json
import shutil

from p2sf.cli import main
from p2sf.lensfile.library import load_lens
from p2sf.lensfile.report import ImportReport, Note, Notebook
from p2sf.messages import Message, Style
from tests.support.lenses.lens_files import FOLDER, text_of


def run(capsys, *arguments):
    code = main(["import", *map(str, arguments)])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def test_the_report_is_printed_and_the_lens_written(capsys, tmp_path):
    out = tmp_path / "lens.toml"
    code, text, errors = run(capsys, FOLDER / "doublet.zmx", "-o", out)
    assert (code, errors) == (0, "")
    assert "3 surfaces, stop on surface 1, entrance pupil diameter 20 mm" in text and f"written: {out}" in text
    written, read = load_lens(out), load_lens(FOLDER / "doublet.zmx")
    assert written == read


def test_a_refused_lens_is_exit_code_2_and_one_sentence(capsys, tmp_path):
    path = tmp_path / "binary.zmx"
    path.write_text(text_of("doublet.zmx").replace("TYPE EVENASPH", "TYPE BINARY_1"), encoding="utf-8")
    code, text, errors = run(capsys, path, "-o", tmp_path / "out.toml")
    assert (code, text) == (2, "") and errors.count("\n") == 1
    assert "surface 3 has type BINARY_1" in errors and not (tmp_path / "out.toml").exists()


def test_a_substitute_needs_consent(capsys, tmp_path):
    path = tmp_path / "old.zmx"
    path.write_text(text_of("doublet.zmx").replace("N-BK7", "S-BK7"), encoding="utf-8")
    code, _, errors = run(capsys, path)
    assert code == 2 and "accept a substitute (SCHOTT N-BK7" in errors
    code, text, _ = run(capsys, path, "--accept-substitutes")
    assert code == 0 and "replaced by SCHOTT N-BK7 (nd 1.51680)" in text


def test_a_catalogue_of_ones_own(capsys, tmp_path):
    path = tmp_path / "own.zmx"
    path.write_text(
        text_of("doublet.zmx").replace("GCAT SCHOTT", "GCAT OWN SCHOTT").replace("N-BK7", "HOUSE1"), encoding="utf-8"
    )
    assert run(capsys, path)[0] == 2
    code, text, _ = run(capsys, path, "--agf", FOLDER / "own.agf", "--json")
    record = json.loads(text)
    assert code == 0 and record["format"] == "Zemax" and record["output"] is None
    assert {"kind", "text", "surface", "line"} == set(record["notes"][0])


def test_what_was_read_is_not_overwritten(capsys, tmp_path):
    path = tmp_path / "lens.zmx"
    shutil.copy(FOLDER / "doublet.zmx", path)
    code, _, errors = run(capsys, path, "-o", path)
    assert code == 2 and "choose another name" in errors and path.read_text(encoding="utf-8") == text_of("doublet.zmx")


def test_a_note_says_where_and_is_kept_once():
    notes = Notebook()
    notes.add("caution", "something", 3, 12)
    notes.add("caution", "something", 3, 12)
    assert notes.notes == [Note("caution", Message("something"), 3, 12)]
    assert str(notes.notes[0].sentence) == "surface 3, line 12: something"


def test_a_report_lists_kinds_in_order_and_leaves_empty_ones_out():
    notes = (Note("ignored", Message("paint")), Note("read", Message("glass")))
    text = ImportReport("a.zmx", "Zemax", "utf-8", notes).text
    assert text.index("glass") < text.index("paint") and "substituted" not in text


def test_a_report_can_be_written_in_any_style():
    german = {"surface {surface}: {message}": "Fläche {surface}: {message}", "a gap of {gap:g} mm": "Lücke {gap:g} mm"}
    style = Style(translate=lambda text: german.get(text, text), number=lambda text: text.replace(".", ","))
    notes = Notebook()
    notes.add("caution", "a gap of {gap:g} mm", 3, gap=0.5)
    lines = [line.text(style) for line in ImportReport("a.zmx", "Zemax", "utf-8", tuple(notes.notes)).lines()]
    assert lines == ["a.zmx: Zemax, utf-8", "taken differently from the file:", "  - Fläche 3: Lücke 0,5 mm"]
