"""`p2sf import --list`: one row for every lens file of a folder, with its first-order data or its refusal."""

import json
import shutil

import pytest

from p2sf.cli import main
from p2sf.lensfile.library import load_lens
from p2sf.paraxial.first_order import cardinal_points
from tests.long.damaged_files import zar_of, zip_of
from tests.support.lenses.lens_files import FOLDER, text_of


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "deeper").mkdir()
    shutil.copy(FOLDER / "doublet.seq", tmp_path / "deeper" / "b.seq")
    shutil.copy(FOLDER / "mirrors.roa", tmp_path / "c.roa")
    gradient = text_of("doublet.zmx").replace("TYPE EVENASPH", "TYPE GRINSUR1")
    (tmp_path / "a.zmx").write_text(gradient, encoding="utf-8")
    (tmp_path / "notes.txt").write_text("no lens", encoding="utf-8")
    (tmp_path / "settings.json").write_text("[1, 2]", encoding="utf-8")
    (tmp_path / "broken.len").write_text("nothing", encoding="utf-8")
    return tmp_path


def listed(capsys, *arguments):
    code = main(["import", "--list", *map(str, arguments)])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def test_every_lens_file_has_its_verdict(capsys, folder):
    code, out, errors = listed(capsys, folder, "--json")
    record = json.loads(out)
    rows = {row["file"].replace("\\", "/"): row for row in record["files"]}
    assert (code, errors, record["opens"]) == (0, "", 2)
    assert list(rows) == ["a.zmx", "broken.len", "c.roa", "deeper/b.seq"]  # neither notes nor settings
    lens = load_lens(FOLDER / "doublet.seq")
    efl = float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length)
    assert rows["deeper/b.seq"]["focal_length"] == efl and rows["deeper/b.seq"]["f_number"] == pytest.approx(efl / 20)
    assert rows["deeper/b.seq"]["stated_focal_length"] is None
    assert rows["deeper/b.seq"]["notes"] > 0 and rows["deeper/b.seq"]["reason"] is None
    refused = rows["a.zmx"]
    assert (refused["opens"], refused["format"], refused["surface"]) == (False, "Zemax", 3)
    assert refused["line"] and refused["reason"].startswith("surface 3 has type GRINSUR1")
    assert rows["broken.len"]["reason"] and not rows["broken.len"]["opens"]


def test_the_table_counts_and_says_why(capsys, folder):
    code, out, _ = listed(capsys, folder)
    assert code == 0 and f"{folder}: 2 of 4 lens files open" in out.replace("\n", "")
    assert "surface 3 has type GRINSUR1" in out and "ray-optics model" in out


def test_glasses_of_a_catalogue_and_substitutes_count(capsys, folder):
    own = text_of("doublet.zmx").replace("GCAT SCHOTT", "GCAT OWN SCHOTT").replace("N-BK7", "HOUSE1")
    (folder / "own.zmx").write_text(own, encoding="utf-8")
    (folder / "old.zmx").write_text(text_of("doublet.zmx").replace("N-BK7", "S-BK7"), encoding="utf-8")
    plain = json.loads(listed(capsys, folder, "--json")[1])["opens"]
    more = json.loads(listed(capsys, folder, "--json", "--agf", FOLDER / "own.agf")[1])["opens"]
    most = json.loads(listed(capsys, folder, "--json", "--agf", FOLDER / "own.agf", "--accept-substitutes")[1])["opens"]
    assert (plain, more, most) == (2, 3, 4)


def test_archives_are_listed_with_their_lenses(capsys, tmp_path):
    (tmp_path / "a.zar").write_bytes(zar_of("doublet.zmx"))
    (tmp_path / "b.zip").write_bytes(zip_of("doublet.seq"))
    (tmp_path / "c.zip").write_bytes(zip_of("own.agf"))
    (tmp_path / "d.zos").write_bytes(b"ZOS\0\1\2")
    record = json.loads(listed(capsys, tmp_path, "--json")[1])
    assert [row["file"] for row in record["files"]] == ["a.zar", "b.zip", "d.zos"]  # a zip without a lens is none
    assert [row["format"] for row in record["files"]] == ["Zemax", "CODE V", ""] and record["opens"] == 2
    assert "save it as .zmx" in record["files"][2]["reason"]


def test_what_is_no_folder_and_an_output_are_refused(capsys, folder):
    code, _, errors = listed(capsys, folder / "a.zmx")
    assert code == 2 and "is not a folder; name one for --list" in errors
    code, _, errors = listed(capsys, folder, "-o", folder / "x.toml")
    assert code == 2 and "--output is for one lens" in errors
