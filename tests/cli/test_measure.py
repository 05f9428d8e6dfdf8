"""`p2sf measure` finds, fits and writes; `p2sf compare` puts two of its files beside each other."""

import json
from itertools import count

import numpy as np
import pytest

from p2sf.cli import main
from p2sf.cli.measuring import _scale
from p2sf.lens.lens import with_f_number
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import read_toml
from p2sf.measure.frame import Frame, FrameGeometry
from p2sf.measure.measurement import read_measurement
from p2sf.measure.simulation import Exposure, grid_of_points, simulated_frame
from p2sf.setting import Request

SCALE = ("--pixel-um", "3.45", "--f-number", "4")


@pytest.fixture(scope="module")
def picture(tmp_path_factory):
    """Return a picture of 3 × 2 points through the Cooke triplet at f/4, its sensor 20 µm too far."""
    path = tmp_path_factory.mktemp("frames") / "points.npy"
    places = grid_of_points(3, 2, 1.2, 0.6)
    lens = with_f_number(find_lens("cooke_triplet"), 4.0)
    np.save(path, simulated_frame(lens, places, FrameGeometry(300, 480, 3.45), Exposure(sensor_shift_um=20.0)).values)
    return path


def test_an_f_number_and_a_wavelength_are_a_scale_without_a_lens():
    """NA = 1/(2N) for a far point, and nanometres are a thousandth of a micrometre."""
    frame = Frame(np.ones((4, 6)), FrameGeometry(4, 6, 3.45))
    found = _scale(None, Request(f_number=4.0, wavelength_nm=550.0), frame)
    assert (found.na, found.wavelength_um, found.pixel_um) == pytest.approx((0.125, 0.55, 3.45))


@pytest.mark.slow
def test_a_picture_beside_its_lens(picture, answer, tmp_path, capsys):
    file, built = tmp_path / "coefficients.npz", tmp_path / "built.toml"
    command = ("measure", str(picture), "--lens", "cooke_triplet", *SCALE, "--unknowns", "sensor_shift_um")
    found = answer(*command, "-o", str(file), "--built", str(built))
    shift = found["frame"]["unknowns"]["sensor_shift_um"]
    assert abs(shift["value"] - 20.0) < 5 * shift["error"] and shift["unit"] == "µm"
    moved = read_toml(built).sensor_mm - find_lens("cooke_triplet").sensor_mm
    assert 1000 * moved == pytest.approx(shift["value"], rel=1e-6)
    assert len(found["points"]) == 6 and all(point["r2"][0] > 0.9 for point in found["points"])
    assert main(["compare", str(file), str(file)]) == 0
    out = capsys.readouterr().out
    assert "6 points in common" in out and "sensor_shift_um" in out


@pytest.mark.slow
def test_light_of_several_wavelengths_is_taken(picture, answer, tmp_path):
    """The picture is of 550 nm; light within a nanometre of it tells the same. Five standard deviations."""
    command = ("measure", str(picture), "--lens", "cooke_triplet", *SCALE, "--unknowns", "sensor_shift_um")
    found = answer(*command, "--light", "549:1", "--light", "551:1", "-o", str(tmp_path / "found.npz"))
    shift = found["frame"]["unknowns"]["sensor_shift_um"]
    assert abs(shift["value"] - 20.0) < 5 * shift["error"]
    assert read_measurement(tmp_path / "found.npz")[1]["optics"]["light"] == [[0.549, 1.0], [0.551, 1.0]]


@pytest.mark.slow
def test_points_are_those_of_a_target(picture, answer, tmp_path, capsys):
    """Places on the sensor, far away: the lens's focal length of 50 mm makes angles of them, to its distortion."""
    places, target, file = grid_of_points(3, 2, 1.2, 0.6), tmp_path / "target.csv", tmp_path / "found.npz"
    angles = np.rad2deg(np.arctan(places / 50))
    lines = [f"{number}, {x}, {y}" for number, (x, y) in zip((7, 3, 5, 2, 9, 4), angles, strict=True)]
    target.write_text("\n".join(["number, x_deg, y_deg", *lines]))
    command = ("measure", str(picture), "--lens", "cooke_triplet", *SCALE, "--unknowns", "sensor_shift_um")
    found = answer(*command, "--target", str(target), "-o", str(file))
    assert found["target"]["found"] == found["target"]["of"] == 6 and not found["target"]["mirrored"]
    known = {point["number"]: (point["x_mm"], point["y_mm"]) for point in found["points"]}
    for number, place in zip((7, 3, 5, 2, 9, 4), places.tolist(), strict=True):
        assert known[number] == pytest.approx(place, abs=0.006)
    assert sorted(read_measurement(file)[0]["target_numbers"]) == [2, 3, 4, 5, 7, 9]
    assert main([*command, "--target", str(target)]) == 0
    said = capsys.readouterr()
    assert "target: 6 of 6 points" in said.out and "4 ways" in said.err and "7: -0.6" in said.out
    target.write_text("number, x_mm, y_mm\n1, 0, 0\n2, 5, 0\n3, 0, 9\n")
    assert main([*command, "--target", str(target)]) == 2
    assert "give --depth-mm" in capsys.readouterr().err


def test_what_is_missing_or_wrong_is_said(picture, tmp_path, capsys):
    for wrong, words in (
        ((), "--pixel-um"),
        (("--pixel-um", "3.45"), "--f-number is not given"),
        ((*SCALE,), "--wavelength-nm is not given"),
        (("--pixel-um", "3.45", "--lens", "cooke_triplet", "--model", "27"), "choose seidel"),
        ((*SCALE, "--wavelength-nm", "550", "--focus-um", "0", "--focus-um", "5"), "1 frames and 2 focus positions"),
        ((*SCALE, "--wavelength-nm", "550", "--focus-um", "nan"), "--focus-um is nan"),
        ((*SCALE, "--wavelength-nm", "550", "--gain", "-1"), "--gain is -1"),
        ((*SCALE, "--wavelength-nm", "550", "--gain", "0"), "--gain is 0"),
        ((*SCALE, "--wavelength-nm", "550", "--read-noise", "nan"), "--read-noise is nan"),
        ((*SCALE, "--wavelength-nm", "550", "--full-scale", "0"), "--full-scale is 0"),
        ((*SCALE, "--wavelength-nm", "550", "-o", "x.csv"), "choose .npz"),
        ((*SCALE, "--lens", "cooke_triplet", "--field-deg", "5"), "--field-deg is given"),
        ((*SCALE, "--lens", "cooke_triplet", "--image-height-mm", "5"), "--image-height-mm is given"),
        ((*SCALE, "--wavelength-nm", "550", "--f-number-error", "-1"), "--f-number-error is -1 %"),
        ((*SCALE, "--wavelength-nm", "550", "--threads", "0"), "--threads is 0"),
        ((*SCALE, "--wavelength-nm", "550", "--light", "550"), '--light "550" is not a wavelength'),
        ((*SCALE, "--wavelength-nm", "550", "--light", "550:-1"), "550 nm that brings -1"),
    ):
        assert main(["measure", str(picture), *wrong]) == 2
        error = capsys.readouterr().err
        assert error.startswith("p2sf: ") and words in error, error
    np.save(tmp_path / "noise.npy", np.random.default_rng(0).normal(50, 5, (40, 40)))
    assert main(["measure", str(tmp_path / "noise.npy"), *SCALE, "--wavelength-nm", "550"]) == 2
    assert "no point rises above" in capsys.readouterr().err
    assert main(["compare", str(picture), str(picture)]) == 2
    assert "not a measurement" in capsys.readouterr().err


@pytest.mark.slow
def test_percent_and_what_is_left_are_told_on_a_terminal_alone(picture, monkeypatch, capsys):
    """To the end and never back, one thread or two with the same numbers."""
    command = ["measure", str(picture), "--lens", "cooke_triplet", *SCALE, "--unknowns", "sensor_shift_um", "--json"]
    assert main([*command, "--threads", "2"]) == 0
    quiet = capsys.readouterr()
    assert "%" not in quiet.err
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    monkeypatch.setattr("p2sf.cli.screen.perf_counter", count(step=2.0).__next__)  # a machine of two seconds a step
    assert main([*command, "--threads", "1"]) == 0
    told = capsys.readouterr()
    assert told.out == quiet.out
    shares = [int(line.split("%")[0]) for line in told.err.split("\r") if "%" in line]
    assert shares == sorted(shares) and len(set(shares)) > 10 and shares[-1] == 100
    assert "s left" in told.err and told.err.rstrip("\n").endswith("\r")
    unknowns = json.loads(told.out)["frame"]["unknowns"]
    assert (
        unknowns["f_number"]["unit"] == "%" and abs(unknowns["f_number"]["value"]) < 4 * unknowns["f_number"]["error"]
    )
