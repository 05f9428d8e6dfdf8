"""`p2sf spot` traces what it says and writes it in the format of the ending."""

import json

import numpy as np
import pytest

import p2sf
from p2sf.cli import main
from p2sf.raytrace.pencil import hexapolar, pencil

PLACE = ("spot", "double_gauss_28", "--field-deg", "14")
FIGURES = ["rms_um", "largest_um", "centroid_x_um", "centroid_y_um", "airy_radius_um", "rays", "lost"]


def test_the_points_are_evenly_spread_over_the_pupil(answer):
    found = answer(*PLACE, "--rings", 6)
    assert list(found) == ["file", "aim", *FIGURES, "points_um"]
    points, lens = np.array(found["points_um"]), p2sf.load_lens("double_gauss_28")
    assert found["rays"] == len(points) == 1 + 3 * 6 * 7  # the centre and rings of 6, 12, … 36
    rays = pencil(lens, p2sf.Source(field_deg=14), *hexapolar(6))
    np.testing.assert_allclose(points, 1e3 * np.stack([rays.dx, rays.dy], -1), atol=1e-8)  # 14° to and fro
    assert found["largest_um"] > np.hypot(*(points - (0, found["centroid_y_um"])).T).max()  # on the rim, beyond them


def test_the_figures_do_not_depend_on_the_rings_and_are_those_of_the_psf(answer):
    coarse, fine = (answer(*PLACE, "--rings", rings) for rings in (1, 30))
    for key in ("rms_um", "largest_um", "centroid_x_um", "centroid_y_um"):
        assert coarse[key] == fine[key]
    for method in ("seidel", "fitted", "traced"):
        assert answer("psf", *PLACE[1:], "--method", method)["rms_um"] == pytest.approx(fine["rms_um"], rel=1e-12)


def test_the_airy_circle_has_the_radius_of_the_textbook(answer):
    found = answer("spot", "asphere", "--wavelength-nm", 550)
    na = na_of(answer, "asphere", 550)
    assert found["airy_radius_um"] == pytest.approx(0.61 * 0.55 / na, rel=3e-4)  # 0.61 is 0.60983 rounded


def na_of(answer, name, wavelength_nm) -> float:
    return answer("info", name, "--wavelength-nm", wavelength_nm)["numerical_aperture"]


def test_a_spot_on_the_axis_has_its_centroid_there_and_not_a_rounding_beside(answer):
    found = answer("spot", "double_gauss_28")
    assert found["centroid_y_um"] == 0 < found["rms_um"]


def test_vignetting_loses_rays(answer):
    assert answer(*PLACE)["lost"] == 0
    assert answer(*PLACE, "--clip")["lost"] > 0


def test_aiming_at_the_stop_changes_the_spot(answer):
    stop, paraxial = (answer(*PLACE, "--aim", aim) for aim in ("stop", "paraxial"))
    assert (stop["aim"], paraxial["aim"]) == ("stop", "paraxial")
    assert stop["rms_um"] != pytest.approx(paraxial["rms_um"], rel=1e-3)
    assert answer(*PLACE, "--aim", "real") == stop  # its former name


def test_files_hold_the_points(answer, tmp_path):
    found = answer(*PLACE, "-o", tmp_path / "spot.csv")
    table = np.genfromtxt(tmp_path / "spot.csv", delimiter=",", names=True, skip_header=1)
    np.testing.assert_array_equal(np.stack([table["x_um"], table["y_um"]], -1), found["points_um"])
    answer(*PLACE, "-o", tmp_path / "spot.json")
    kept = json.loads((tmp_path / "spot.json").read_text(encoding="utf-8"))
    assert kept["points_um"] == found["points_um"] and kept["lens"]["name"] == "double_gauss_28"
    answer(*PLACE, "-o", tmp_path / "spot.png")
    assert (tmp_path / "spot.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("options", "words"), [("--rings 0", "--rings is 0"), ("-o a.npz", ".npz"), ("--aim high", "high")]
)
def test_an_option_that_cannot_be(capsys, options, words):
    assert main([*PLACE, *options.split()]) == 2
    assert words in capsys.readouterr().err


def test_a_table_for_people(capsys):
    assert main(list(PLACE)) == 0
    assert "RMS radius" in capsys.readouterr().out
