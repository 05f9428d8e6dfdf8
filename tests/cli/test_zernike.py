"""`p2sf zernike` prints and writes the terms that the library finds."""

import csv

import pytest

import p2sf
from p2sf.cli import main

PLACE = ("zernike", "telephoto", "--field-deg", "7", "--aim", "paraxial")


def test_json_has_the_terms_of_the_library(answer):
    found = answer(*PLACE, "--basis", "fringe", "--terms", "16")
    ours = p2sf.Camera(p2sf.load_lens("telephoto"), aim="paraxial").at(p2sf.Source(field_deg=7)).zernike("fringe", 16)
    # 7° and 587.5618 nm are converted to and fro: 1e-16 of a path of 1e5 waves.
    assert [term["waves"] for term in found["terms"]] == pytest.approx(ours.waves.tolist(), abs=1e-9)
    assert found["rms"] == pytest.approx(ours.rms, rel=1e-8)
    assert found["unit"] == "waves peak" and found["aim"] == "paraxial"
    assert found["gram_schmidt"] is False and found["clear_share_of_pupil"] == 1


def test_a_clipped_pupil_says_what_the_terms_are_orthogonal_over(answer, capsys):
    found = answer("zernike", "double_gauss_28", "--field-deg", "14", "--clip")
    assert found["gram_schmidt"] is True and 0.9 < found["clear_share_of_pupil"] < 1
    assert main(["zernike", "double_gauss_28", "--field-deg", "14", "--clip"]) == 0
    assert "Gram–Schmidt" in capsys.readouterr().out


def test_csv_has_a_row_for_each_term(tmp_path, capsys):
    path = tmp_path / "terms.csv"
    assert main([*PLACE, "-o", str(path)]) == 0
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()[1:]))
    assert [row["term"] for row in rows] == [str(number) for number in range(1, 38)]
    assert float(rows[6]["waves"]) == pytest.approx(-0.0685, abs=1e-4) and rows[6]["name"] == "coma"


@pytest.mark.parametrize("wrong", [("--terms", "0"), ("--basis", "fringe", "--terms", "38"), ("-o", "terms.xml")])
def test_what_cannot_be_is_refused_in_a_sentence(wrong, capsys):
    assert main([*PLACE, *wrong]) == 2
    assert capsys.readouterr().err.startswith("p2sf: ")
