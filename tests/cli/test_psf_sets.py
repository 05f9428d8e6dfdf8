"""`p2sf psf` of several depths, fields and wavelengths: which PSFs a set holds, and what is refused."""

import json
from math import inf

import numpy as np
import pytest

from p2sf.cli import main
from p2sf_explorer.state.state import new_state
from p2sf_explorer.window.commands.set_request import first_texts

AXES = ("--depths-mm", "5000:inf:2", "--fields-deg", "0:8:3", "--wavelengths-nm", "486,588", "--f-number", "8")


def test_a_set_holds_every_depth_field_and_wavelength(tmp_path, capsys):
    path = tmp_path / "set.npz"
    made = main(["psf", "double_gauss_28", *AXES, "--pixels", "16", "--pixel-um", "6", "-o", str(path), "--json"])
    told = json.loads(capsys.readouterr().out)
    with np.load(path) as file:
        assert made == 0 and file["psf"].shape == (2, 3, 2, 16, 16) == tuple(told["shape"])
        assert file["depth_mm"].tolist() == [5000, inf] and file["field_deg"].tolist() == [0, 4, 8]
        assert file["wavelength_nm"].tolist() == [486, 588] and file["pixel_um"] == 6
        captured = file["psf"].sum((-2, -1)).ravel()
    assert [one["captured"] for one in told["psfs"]] == pytest.approx(captured, rel=1e-5)


def test_what_has_no_axis_is_that_of_the_one_source(capsys):
    """A field to either side of the axis of an aligned lens: mirror images but for wings that wrap around, 1 %."""
    asked = ("--fields-deg=-6,6", "--depth-mm", "8000", "--wavelength-nm", "550", "--pixels", "49", "--json")
    assert main(["psf", "double_gauss_28", *asked]) == 0
    below, above = json.loads(capsys.readouterr().out)["psfs"]
    assert (below["depth_mm"], below["wavelength_nm"]) == (8000, pytest.approx(550))
    assert below["chief_mm"] == pytest.approx(-above["chief_mm"]) and above["chief_mm"] > 0
    assert below["centroid_y_um"] == pytest.approx(-above["centroid_y_um"], rel=0.01)
    assert abs(above["centroid_y_um"]) > 0.1, "an asymmetry that could have the wrong side"


def test_light_beside_the_pixels_is_warned_of(capsys):
    assert main(["psf", "double_gauss_28", "--depths-mm", "3000,inf", "--pixels", "8", "--pixel-um", "2"]) == 0
    assert "warning" in capsys.readouterr().err
    assert main(["psf", "double_gauss_28", "--fields-deg", "0", "--pixels", "65"]) == 0
    assert not capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--depths-mm", "1000:inf"), "--depths-mm is 1000:inf"),
        (("--depths-mm", "0,5"), "--depths-mm is 0,5"),
        (("--fields-deg", "0:inf:3"), "--fields-deg is 0:inf:3"),
        (("--fields-deg", "0,95"), "--fields-deg is 95"),
        (("--wavelengths-nm", "-5"), "--wavelengths-nm"),
        (("--fields-deg", "0", "--field-deg", "3"), "--field-deg and --fields-deg"),
        (("--depths-mm", "inf", "--depth-mm", "3000"), "--depth-mm and --depths-mm"),
        (("--depths-mm", "inf", "--method", "huygens"), "--method"),
        (("--depths-mm", "inf", "--spectrum", "d65"), "--spectrum"),
        (("--depths-mm", "inf", "--field-x-deg", "3"), "--field-x-deg"),
        (("--depths-mm", "inf", "-o", "set.png"), ".fits"),
        (("--fill-factor", "0.5"), "--fill-factor"),
        (("--fields-deg", "0:14:4096", "--wavelengths-nm", "400:700:4096"), "GiB"),
    ],
)
def test_what_cannot_be_is_refused_at_once(capsys, words, named):
    assert main(["psf", "double_gauss_28", *words]) == 2
    assert named in capsys.readouterr().err


def test_a_set_has_the_pixels_that_the_window_offers(answer):
    found = answer("psf", "achromat_f6", "--fields-deg", "0", "--f-number", 12)
    assert found["shape"][-2:] == [int(first_texts(new_state()).pixels)] * 2
    assert answer("psf", "achromat_f6", "--fields-deg", "0", "--pixels", 64)["shape"][-2:] == [64, 64]
