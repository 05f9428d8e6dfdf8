"""`p2sf tolerance`: what hurts, compensators, yields, and a file of one's own tolerances."""

import re

import pytest

from p2sf.cli import main
from p2sf.cli.tolerances import WORST, _show_doubts
from p2sf.errors import LensFileError
from p2sf.lensfile.library import find_lens
from p2sf.tolerance.builds import SUMMED_RMS
from p2sf.tolerance.errors_of_build import Tolerance, usual_tolerances
from p2sf.tolerance.files import back_focus, read_tolerances, with_compensators

STATE = "--f-number", "8", "--field-deg", "5"
LENS, SMALL = ("tolerance", "double_gauss_28", *STATE), ("tolerance", "achromat_f6", *STATE)
OWN = """grade = "{grade}"
[[tolerance]]
kind = "decentre_y"
first = 3
last = 4
amount = 0.05
{more}
"""


@pytest.mark.slow
def test_what_hurts_most_comes_first_and_more_of_it_hurts_more(answer):
    found, worse = (answer(*LENS, "--builds", 200, "--grade", grade) for grade in ("high", "commercial"))
    adds = [row["adds_waves"] for row in found["errors"]]
    assert adds == sorted(adds, reverse=True) and len(adds) > 50
    assert found["compensators"][0] | {"rms": 0} == {"kind": "thickness", "first": 11, "rms": 0}
    assert worse["percentiles"]["90"]["rms_waves"] > found["percentiles"]["90"]["rms_waves"]
    assert found["nominal"] == worse["nominal"] and found["fields_deg"] == [pytest.approx(5.0)]


def test_a_yield_is_said_with_its_error(capsys):
    main([*SMALL, "--builds", "500", "--strehl", "0.5", "--rms-waves", "0.3"])
    said = capsys.readouterr().out
    assert "% keep RMS ≤ 0.3 and Strehl ratio ≥ 0.5 in all fields" in said and "±" in said


def test_the_percentiles_are_of_the_criterion_too(answer, capsys):
    asked = (*SMALL, "--builds", 200, "--criterion", "boresight_um", "--field-x-deg", 2)
    found = answer(*asked)
    assert found["azimuths_deg"] == [pytest.approx(21.7592, abs=1e-3)]  # arctan(tan 2° / tan 5°)
    capsys.readouterr()
    assert main([str(word) for word in asked]) == 0
    said = capsys.readouterr().out
    assert WORST["boresight_um"] in said and f"{found['percentiles']['90']['boresight_um']:.6g}" in said


def test_no_strehl_ratio_is_told_of_many_waves(answer):
    """Nor one like 4e-77, which follows from an RMS alone."""
    found = answer("tolerance", "achromat_f6", "--f-number", 2, "--builds", 20)
    for one in (found["designed"], *found["percentiles"].values()):
        assert one["rms_waves"] > SUMMED_RMS and one["strehl"] == 0


def test_every_column_of_builds_says_on_which_side_its_figures_lie(capsys):
    assert main([*SMALL, "--builds", "200"]) == 0
    table = capsys.readouterr().out.partition("200 builds")[2].splitlines()
    heads = re.split(r"  +", table[1].strip())
    assert len(heads) == 1 + len(table[2].split()[-2:])
    assert all(("at most" in head) != ("at least" in head) for head in heads[1:]) and "at " not in heads[0]


def test_a_file_of_ones_own(tmp_path):
    lens, path = find_lens("double_gauss_28"), tmp_path / "own.toml"
    path.write_text(OWN.format(grade="none", more='[[compensator]]\nkind = "tilt_x"\nfirst = 8'), encoding="utf-8")
    listed, compensators = read_tolerances(path, lens)
    assert listed == (Tolerance("decentre_y", 3, 0.05, 4),)
    assert [(one.kind, one.first) for one in compensators] == [("tilt_x", 8)]
    path.write_text(OWN.format(grade="high", more=""), encoding="utf-8")
    listed, compensators = read_tolerances(path, lens)
    assert listed[:-1] == usual_tolerances(lens, "high") and compensators == (back_focus(lens),)
    every, places = with_compensators(listed, compensators)
    assert [every[place].kind for place in places] == ["thickness"] and len(every) == len(listed) + 1


@pytest.mark.parametrize(
    ("text", "said", "line"),
    [
        ("grade = 'best'", 'grade is "best"; write one of', 1),
        ("[[tolerance]]\nkind = 'colour'\nfirst = 1\namount = 1", 'tolerance "colour" is unknown', 2),
        ("[[tolerance]]\nkind = 'radius'\nfirst = 99\namount = 1", "surfaces 99 to 99 do not exist", 3),
        ("[[tolerance]]\nkind = 'radius'\nfirst = 1", "amount is missing; write a finite number", 1),
        ("[tolerance]\nfirst = 1", r"head every one with \[\[tolerance\]\]", None),
        ("tolerances = 1", 'key "tolerances" is unknown; did you mean "tolerance"', 1),
        ("grade = ", "this is not TOML", None),
    ],
)
def test_a_file_that_cannot_be_is_refused(tmp_path, text, said, line):
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    with pytest.raises(LensFileError, match=said) as error:
        read_tolerances(tmp_path / "own.toml", find_lens("double_gauss_28"))
    assert line is None or error.value.line == line


def test_a_field_beside_the_plane_is_named_by_both_angles(capsys):
    assert main(["tolerance", "singlet_f6", "--builds", "20", "--field-x-deg", "3"]) == 0
    assert "fields (3°, 0°)," in capsys.readouterr().out


@pytest.mark.parametrize(
    "wrong",
    [
        ("--frequency-per-mm", "0"),
        ("--strehl", "-1"),
        ("--strehl", "80"),
        ("--mtf", "1.01"),
        ("--builds", "0"),
        ("--seed", "-1"),
        ("--set", "nothing.toml"),
    ],
)
def test_what_cannot_be_is_one_sentence(capsys, wrong):
    assert main([*LENS, *wrong]) == 2
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


DOUBTFUL = """grade = "none"
[[tolerance]]
kind = "thickness"
first = 3
amount = 0.05
[[tolerance]]
kind = "decentre_y"
first = 3
amount = 0.03
"""


def test_what_loses_rays_has_no_figure_and_what_the_form_misses_is_said(answer, capsys, tmp_path):
    (tmp_path / "own.toml").write_text(DOUBTFUL, encoding="utf-8")
    asked = ("tolerance", "phone_f28", "--set", tmp_path / "own.toml", "--builds", 10)
    lost, off = answer(*asked)["errors"]
    assert (lost["kind"], lost["adds_waves"], lost["harm"]) == ("decentre_y", None, None)
    assert off["form_error"] > 0.1 * off["harm"] > 0
    capsys.readouterr()
    assert main([str(word) for word in asked]) == 0
    said = capsys.readouterr().out
    assert "Rays are lost at ± the tolerance of: decentre y of surface 3." in said
    assert "is off for: thickness behind surface 3 (+" in said and "Strehl ratio: of the peak" in said


def test_the_form_is_doubted_where_it_misses_a_tenth_of_a_harm_and_a_hundredth_of_the_largest(capsys):
    rows = [
        {"kind": kind, "first": 1, "last": 1, "harm": harm, "form_error": off}
        for kind, harm, off in (
            ("radius", 1.0, 0.09),
            ("thickness", 0.1, 0.012),
            ("tilt_x", 0.1, -0.012),
            ("index", 0.05, 0.009),
            ("decentre_x", 0.5, 0.06),
        )
    ]
    _show_doubts(rows)
    said = capsys.readouterr().out
    assert said.count("surface") == 3 and "radius" not in said and "index" not in said
    assert "thickness behind surface 1 (+12%)" in said and "(-12%)" in said and "(+12%)" in said
