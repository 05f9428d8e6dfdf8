"""The commands print what the witness computed, under exactly the promised names."""

import subprocess
import sys
from math import inf
from pathlib import Path

import numpy as np
import pytest

from p2sf import __version__
from p2sf.cli import COMMANDS, main
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lensfile.library import shipped_lenses
from p2sf.lensfile.toml.lens import write_toml
from tests.support.reference import LENSES, prescription_lens, reference

ROOT = Path(__file__).parents[2]
# Promised: 1e-5 relative or 1e-5 waves. Measured 1e-8 where the indices are the witness's own; with catalogue glass its
# coefficients, in 32 bits, move a focal length by 3e-7.
CLOSE = {"rel": 1e-5, "abs": 1e-5}
INFO_KEYS = [
    "abcd",
    "effective_focal_length",
    "back_focal_distance",
    "front_focal_distance",
    "front_principal_from_first",
    "rear_principal_from_last",
    "front_nodal_from_first",
    "rear_nodal_from_last",
    "stop_surface",
    "stop_semi_diameter",
    "entrance_pupil",
    "exit_pupil",
    "numerical_aperture",
    "f_number",
    "image_distance",
    "magnification",
]
CASE_KEYS = ["w40", "w31", "w22", "w20", "w11", "wd", "na", "image_distance", "image_height"]


def depth(case: dict) -> float:
    return inf if case["depth_mm"] is None else case["depth_mm"]


@pytest.mark.parametrize("name", LENSES)
def test_info_is_what_the_witness_found(answer, name):
    for wavelength, expected in reference(name)["first_order"].items():
        found = answer("info", name, "--wavelength-nm", wavelength)
        assert list(found) == INFO_KEYS
        for key, value in expected.items():
            assert flat(found[key]) == pytest.approx(flat(value), **CLOSE), key


def flat(value) -> list:
    """Return a number, a list or the numbers of a dict by its sorted names, as a list."""
    if isinstance(value, dict):
        return [value[key] for key in sorted(value)]
    return value if isinstance(value, list) else [value]


@pytest.mark.parametrize("name", LENSES)
def test_coefficients_are_what_the_witness_found(answer, name, tmp_path):
    file = tmp_path / "witness.toml"
    for case in reference(name)["cases"][::4]:  # 4 and 3 × 3 × 3 have no common divisor: every value of each occurs
        place = ("--depth-mm", depth(case), "--field-deg", case["field_deg"], "--wavelength-nm", case["wavelength_nm"])
        write_toml(prescription_lens(name, case["wavelength_nm"]), file)
        found = answer("coefficients", file, *place)
        assert list(found) == [*CASE_KEYS, "field_deg", "per_surface"]
        assert {key: found[key] for key in CASE_KEYS} == pytest.approx({k: case[k] for k in CASE_KEYS}, **CLOSE)
        assert found["field_deg"] == pytest.approx(case["field_deg"], rel=1e-12)


@pytest.mark.parametrize("name", LENSES)
def test_seidel_sums_per_surface_are_what_the_witness_found(answer, name):
    sums = reference(name)["seidel_sums_per_surface"]
    place = ("--depth-mm", depth(sums), "--field-deg", sums["field_deg"], "--wavelength-nm", sums["wavelength_nm"])
    found = np.array(answer("coefficients", name, *place)["per_surface"])
    expected = np.array(sums["rows"])
    assert found.shape == expected.shape
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-5 * np.abs(expected).max())


def test_the_three_ways_to_state_a_field_agree(answer):
    place = ("coefficients", "double_gauss_28", "--depth-mm", 1000, "--focus-mm", 1000)
    by_angle = answer(*place, "--field-deg", 7)
    by_image = answer(*place, "--image-height-mm", by_angle["image_height"])
    height = np.tan(np.deg2rad(7)) * (1000 + answer("info", "double_gauss_28")["entrance_pupil"]["from_first"])
    by_object = answer(*place, "--object-height-mm", height)
    for other in (by_image, by_object):
        assert other["w31"] == pytest.approx(by_angle["w31"], rel=1e-9)
        assert other["field_deg"] == pytest.approx(7, rel=1e-9)


def test_focusing_removes_the_defocus_and_a_shift_brings_it_back(answer):
    place = ("coefficients", "double_gauss_28", "--depth-mm", 2000)
    assert abs(answer(*place)["wd"]) > 50
    assert abs(answer(*place, "--focus-mm", 2000)["wd"]) < 1e-6
    moved = answer(*place, "--focus-mm", 2000, "--sensor-shift-um", 100)
    waves = moved["na"] ** 2 * 100 / (2 * 0.5875618)  # Wd = NA² Δz / (2 n' λ)
    assert moved["wd"] == pytest.approx(waves, rel=1e-9)


CAMERA = ("info", "coefficients", "psf", "spot", "zernike", "tradeoff", "database build")


@pytest.mark.parametrize("command", CAMERA)
def test_every_command_that_sets_a_camera_takes_how_rays_fill_the_pupil(said, refused, command):
    assert "--aim" in said(*command.split(), "--help")
    output = ("-o", "a.npz") if "build" in command else ()
    assert "--aim" in refused(*command.split(), "double_gauss_28", *output, "--aim", "high")


def test_rays_fill_the_stop_or_the_paraxial_pupil_and_json_says_which(answer):
    place = ("psf", "double_gauss_28", "--field-deg", 14, "--method", "traced", "--pixels", 32, "--pixel-um", 1)
    stop, paraxial, former = (answer(*place, "--aim", aim) for aim in ("stop", "paraxial", "real"))
    assert (stop["aim"], paraxial["aim"]) == ("stop", "paraxial")
    assert former["strehl"] == stop["strehl"] != pytest.approx(paraxial["strehl"], rel=1e-3)
    colour = ("--spectrum", "d65", "--pixels", 16, "--pixel-um", 2, "--aim")
    assert answer("psf", "double_gauss_28", "--method", "seidel", *colour, "paraxial")["aim"] == "paraxial"


def test_the_sensor_does_not_move_with_the_colour(answer):
    blue = answer("coefficients", "double_gauss_28", "--focus-mm", "inf", "--wavelength-nm", 486.1327)
    assert abs(blue["wd"]) > 0.5  # its image lies elsewhere than the reference wavelength's


def test_infinite_values_are_null(answer, tmp_path):
    glass = ConstantIndex(1.5)
    plate = Lens((Surface(thickness=5, medium=glass), Surface(thickness=20)), Aperture("stop_semi_diameter", 2.0), 1)
    write_toml(plate, tmp_path / "plate.toml")
    found = answer("info", tmp_path / "plate.toml")
    assert found["effective_focal_length"] is found["image_distance"] is found["f_number"] is None
    assert found["abcd"] == pytest.approx([1, 5 / 1.5, 0, 1])


def test_a_narrower_rim_is_a_warning_beside_the_results(capsys, answer):
    near = ("info", "petzval", "--depth-mm", 100)
    assert main([str(x) for x in near]) == 0
    output, error = capsys.readouterr()
    assert error.startswith("warning: the rim of surface") and "warning" not in output
    kept, freed = answer(*near), answer(*near, "--stop", "auto")
    assert list(kept) == INFO_KEYS and freed["stop_surface"] != kept["stop_surface"]
    assert freed["numerical_aperture"] < kept["numerical_aperture"]


def test_a_table_has_units_and_no_colour_codes_outside_a_terminal(said):
    text = said("info", "double_gauss_28")
    assert "effective focal length" in text and " mm" in text and "\x1b" not in text
    assert "W22 astigmatism" in said("coefficients", "double_gauss_28", "--field-deg", 10)


def test_lenses_lists_the_shelf(said, answer):
    names = [row["name"] for row in answer("lenses")["lenses"]]
    assert names == list(shipped_lenses()) and set(LENSES) <= set(names)
    assert all(name in said("lenses") for name in names)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself(said, command):
    assert f"p2sf {command}" in said(command, "-h")
    assert command in said("--help")


def test_version(said):
    told = dict(line.split(" ", 1) for line in said("--version").splitlines())
    assert told["p2sf"] == __version__ and told["numpy"] == np.__version__
    assert {"python", "system", "machine", "scipy"} <= set(told)


def test_info_loads_nothing_heavy():
    code = "from p2sf.cli import main; main(['info', 'double_gauss_28']); import sys; print(' '.join(sys.modules))"
    run = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    loaded = {name.split(".")[0] for name in run.stdout.splitlines()[-1].split()}
    assert not loaded & {"scipy", "matplotlib", "PySide6", "pyqtgraph", "pyvista", "tifffile", "PIL", "p2sf_explorer"}


@pytest.mark.parametrize(
    ("failure", "code", "words"),
    [
        (KeyboardInterrupt(), 130, ""),
        (OSError(28, "No space left on device", "out.npz"), 2, "out.npz: No space left on device"),
    ],
)
def test_what_stops_a_command_from_outside_is_no_traceback(failure, code, words, monkeypatch, capsys):
    def stopped(*_):
        raise failure

    monkeypatch.setattr("p2sf.cli._forget_output", lambda: None)
    monkeypatch.setattr("p2sf.cli.first_order.set_up", stopped)
    assert main(["info", "tessar"]) == code
    error = capsys.readouterr().err
    assert words in error and "Traceback" not in error
