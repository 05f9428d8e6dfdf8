"""p2sf database, export, and psf from a database: what they print, what they write, what they refuse."""

import json

import numpy as np
import pytest

from p2sf.cli import main
from p2sf.database.files.npz import load_database
from p2sf.database.files.stack import open_stack
from p2sf.lens.lens import with_f_number
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.psf.prediction import ALLOWED
from p2sf.psf.reading import read_psf
from tests.database.test_npz import damaged

GRID = ("--depths-mm", "500:inf:5", "--fields-deg", "0:14:3", "--wavelengths-nm", "450:650:3", "--method", "seidel")


@pytest.fixture
def file(said, tmp_path):
    said("database", "build", "double_gauss_28", *GRID, "-o", tmp_path / "gauss.npz")
    return tmp_path / "gauss.npz"


def test_build_reports_what_it_made_and_how_exact(said, tmp_path):
    answer = json.loads(said("database", "build", "tessar", *GRID, "-o", tmp_path / "a.npz", "--json"))
    assert answer["nodes"] == [5, 3, 3]
    assert answer["bytes"] == (tmp_path / "a.npz").stat().st_size
    assert set(answer["errors_waves"]) == {"w40", "w31", "w22", "w20", "w11", "wd"}
    assert "largest error of Wd" in said("database", "build", "tessar", *GRID, "-o", tmp_path / "b.npz")


def test_a_look_up_says_what_the_database_is_worth(answer, said, tmp_path):
    """At f/3 six coefficients describe nothing of 14°: an estimate of 1 − R² above 1 is no number to a person."""
    path, nodes = tmp_path / "six.npz", ("--depths-mm", "inf", "--fields-deg", "0:14:3", "--wavelengths-nm", 550)
    said("database", "build", "double_gauss_28", *nodes, "--method", "seidel", "-o", path)
    stated = load_database(path).accuracy
    found = answer("psf", path)
    assert stated.worst > 1 and found["database_predicted_error"]["worst"] == pytest.approx(stated.worst)
    assert found["centroid_um"] == [0.0, 0.0]  # on the axis of a centred lens
    text = said("psf", path)
    assert f"{stated.worst:.3g}" not in text.split() and "14°" in text
    assert stated.caution is not None and "worst" not in stated.caution.values


def test_what_leaves_the_program_says_how_true_it_is(said, answer, tmp_path, capsys):
    """Six coefficients at f/3 describe little of 14°: said when built, looked into and exported, and kept in each."""
    path, nodes = tmp_path / "six.npz", ("--depths-mm", "inf", "--fields-deg", "0:14:3", "--wavelengths-nm", 550)
    assert main(["database", "build", "double_gauss_28", *map(str, nodes), "--method", "seidel", "-o", str(path)]) == 0
    assert "predicted" in (built := capsys.readouterr()).err and "predicted 1 − R², worst" in built.out
    known = answer("database", "info", path)["predicted_error"]
    assert known["worst"] > known["median"] > ALLOWED and known["field_deg"] == pytest.approx(14)
    for format in ("iset", "tiff", "fits", "csv"):
        assert main(["export", str(path), "--to", format]) == 0
        assert "predicted" in capsys.readouterr().err
    assert answer("export", path, "--to", "tiff")["predicted_error"] == known
    fitted = answer("database", "build", "double_gauss_28", *nodes, "-o", tmp_path / "auto.npz")
    assert fitted["method"] == "fitted" and fitted["predicted_error"]["worst"] < ALLOWED
    stack = tmp_path / "six.zarr"
    samples = ("--stack", "--pixels", 8, "--pixel-um", 4)
    answer("database", "build", "double_gauss_28", *nodes, "--method", "seidel", *samples, "-o", stack)
    assert json.loads((stack / "zarr.json").read_text())["attributes"]["predicted_error"] == known


@pytest.mark.parametrize("interpolant", ["table1", "linear"])
def test_the_camera_and_the_interpolant_are_kept(said, tmp_path, interpolant):
    path = tmp_path / "a.npz"
    camera = ("--focus-mm", 2000, "--f-number", 5.6, "--interpolant", interpolant)
    said("database", "build", "double_gauss_28", *GRID, *camera, "-o", path)
    stored = load_database(path)
    assert stored.database.interpolant == interpolant
    assert stored.meta["sensor_mm"] > 60
    assert float(stored.database.coefficients(np.inf, 0.0, 0.55).na) == pytest.approx(1 / 11.2, rel=0.02)


def test_info_says_where_it_comes_from(said, file):
    printed = said("database", "info", file)
    assert "SCHOTT" in printed
    assert "500 to ∞" in printed
    answer = json.loads(said("database", "info", file, "--json"))
    assert answer["lens"]["name"] == "double_gauss_28"
    assert answer["covers"]["depth_mm"] == [500, None]
    assert answer["schema"] == 1


@pytest.mark.parametrize(("aim", "words"), [("stop", "the real stop"), ("paraxial", "the paraxial entrance pupil")])
def test_how_rays_filled_the_pupil_is_kept_and_told(said, refused, tmp_path, aim, words):
    path = tmp_path / "a.npz"
    build = ("database", "build", "double_gauss_28", *GRID, "--aim", aim, "--json")
    assert json.loads(said(*build, "-o", path))["aim"] == aim
    assert load_database(path).lens.aim == json.loads(said("database", "info", path, "--json"))["aim"] == aim
    assert words in said("database", "info", path)
    point = ("--wavelength-nm", 550, "--pixels", 16, "--pixel-um", 20)
    assert json.loads(said("psf", path, *point, "--json"))["aim"] == aim
    said("psf", path, *point, "-o", tmp_path / "a.tiff")
    assert read_psf(tmp_path / "a.tiff")[1]["setup"]["aim"] == aim
    assert "--aim needs the lens" in refused("psf", path, "--aim", aim)
    said("export", path, "--to", "csv", "-o", tmp_path / "a.csv")
    assert f'"aim": "{aim}"' in (tmp_path / "a.csv").read_text(encoding="utf-8")


@pytest.mark.slow
def test_psf_from_a_database_is_the_psf_of_the_lens(said, file, tmp_path):
    point = ("--depth-mm", 3000, "--field-deg", 7, "--wavelength-nm", 550, "--pixels", 32, "--pixel-um", 20)
    said("psf", file, *point, "-o", tmp_path / "a.npz")
    said("psf", "double_gauss_28", "--method", "seidel", *point, "-o", tmp_path / "b.npz")
    (looked, meta), (direct, _) = read_psf(tmp_path / "a.npz"), read_psf(tmp_path / "b.npz")
    np.testing.assert_allclose(looked.values, direct.values, atol=1e-12)  # both settled, from equal coefficients
    assert meta["lens"]["name"] == "double_gauss_28"
    assert "field 7°, 550 nm" in said("psf", file, *point)


def test_a_database_answers_in_image_height_and_moves_its_sensor(said, file):
    common = ("--wavelength-nm", 550, "--pixels", 16, "--pixel-um", 1, "--json")
    by_height = json.loads(said("psf", file, "--image-height-mm", 17.0, "--sensor-shift-um", 50, *common))
    of_lens = ("psf", "double_gauss_28", "--method", "seidel", "--image-height-mm", 17.0, "--sensor-shift-um", 50)
    assert by_height["strehl"] == pytest.approx(json.loads(said(*of_lens, *common))["strehl"], rel=1e-3)


def test_a_stack_is_built_told_about_and_exported(said, tmp_path):
    path = tmp_path / "gauss.zarr"
    near = ("--depths-mm", "20000:inf:2", *GRID[2:])
    said("database", "build", "double_gauss_28", *near, "--stack", "--pixels", 16, "--pixel-um", 2, "-o", path)
    assert open_stack(path).psf.shape == (2, 3, 3, 16, 16)
    answer = json.loads(said("database", "info", path, "--json"))
    assert answer["complete"] is True
    assert answer["psfs"] == [2, 3, 3, 16, 16]
    assert json.loads(said("export", path, "--to", "tiff", "-o", tmp_path / "a.tif", "--json"))["bytes"] > 18 * 1024


def test_how_to_start_a_cluster_is_two_lines(said):
    lines = json.loads(said("cluster", "--json"))
    assert lines["scheduler"].split() == ["dask", "scheduler"]
    assert lines["worker"].split()[:2] == ["dask", "worker"]
    told = said("cluster")
    assert all(line in told for line in lines.values()) and "p2sf database build" in told


@pytest.mark.slow
@pytest.mark.parametrize("to", ["iset", "fits", "tiff", "csv"])
def test_every_export_is_written_beside_the_database(said, file, to):
    answer = json.loads(said("export", file, "--to", to, "--pixels", 16, "--pixel-um", 20, "--json"))
    assert answer["bytes"] == (file.parent / answer["file"]).stat().st_size > 1000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--depths-mm", "500-inf"), "--depths-mm is 500-inf; write LOW:HIGH:COUNT"),
        (("--depths-mm", "500:inf"), "--depths-mm is 500:inf; write LOW:HIGH:COUNT"),
        (("--depths-mm", "inf:500:3"), "which does not ascend from a finite number"),
        (("--depths-mm", "500:inf:1"), "2 to 4096"),
        (("--depths-mm=-5:inf:3",), "--depths-mm is -5:inf:3"),
        (("--depths-mm", "nan"), "--depths-mm is nan; write"),
        (("--depths-mm", "0:10:3"), "--depths-mm is 0:10:3"),
        (("--stack", "--pixels", "9.5"), "--pixels"),
        (("--fields-deg", "0:inf:3"), "--fields-deg is 0:inf:3"),
        (("--fields-deg", "0:90:3"), "give angles from 0 to below 90 degrees"),
        (("--fields-deg", "5,2"), "put the numbers in ascending order"),
        (("--wavelengths-nm", "0:500:3"), "give wavelengths above 0"),
        (("--wavelengths-nm", "100:500:3"), "outside the data of"),
        (("--pixels", "1"), "--pixels is 1; give a whole number"),
        (("--pixel-um", "-1"), "--pixel-um is -1 µm"),
        (("--stack",), "a stack is a .zarr folder, choose a name that ends in .zarr"),
        (("--method", "fitted", "--interpolant", "linear"), "--interpolant is linear, which is for --method seidel"),
        (("--interpolant", "cubic"), "cubic"),
    ],
)
def test_bad_builds_are_one_sentence(refused, tmp_path, arguments, words):
    assert words in refused("database", "build", "double_gauss_28", *arguments, "-o", tmp_path / "a.npz")
    assert not list(tmp_path.iterdir())


def test_bad_files_and_questions_are_one_sentence(refused, file, tmp_path):
    foreign = tmp_path / "foreign.npz"
    foreign.write_bytes(b"text")
    assert "is not a P2SF database" in refused("database", "info", foreign)
    assert "is not a P2SF database" in refused("psf", foreign)
    assert "cannot be read" in refused("export", tmp_path / "none.npz", "--to", "csv")
    assert "is not a P2SF stack" in refused("database", "info", tmp_path)
    assert "depth 100 mm is outside this database" in refused("psf", file, "--depth-mm", 100)
    assert "--f-number needs the lens" in refused("psf", file, "--f-number", 4)
    assert "--obscuration needs the lens" in refused("psf", file, "--obscuration", 0.3)
    assert "--absorption needs the lens" in refused("psf", file, "--no-absorption")
    assert "leave them out" in refused("psf", file, "--method", "huygens")
    assert "33 samples a side" in refused("export", file, "--to", "iset", "--pixels", 33)
    assert "choose a name that ends in .npz" in refused("database", "build", "tessar", "-o", tmp_path / "a.zarr")


def test_an_export_under_another_formats_ending_is_refused_and_writes_nothing(refused, file, tmp_path):
    said = refused("export", file, "--to", "fits", "-o", tmp_path / "x.txt")
    assert 'its ending ".txt" is unknown; choose .fits, .fit, .fts' in said
    assert not (tmp_path / "x.txt").exists()


def test_an_image_height_in_a_database_of_the_axis_is_one_sentence(said, refused, tmp_path):
    axis = tmp_path / "axis.npz"
    said("database", "build", "tessar", "--depths-mm", "inf", "--fields-deg", 0, "--wavelengths-nm", 550, "-o", axis)
    assert "build one with fields" in refused("psf", axis, "--image-height-mm", 1)


def test_a_fitted_database_is_built_and_rendered(said, refused, tmp_path):
    path = tmp_path / "fitted.npz"
    grid = ("--depths-mm", "5000:inf:3", "--fields-deg", "10:14:3", "--wavelengths-nm", "540:560:3")
    answer = json.loads(said("database", "build", "cooke_triplet", *grid, "--method", "fitted", "-o", path, "--json"))
    assert answer["errors_waves"]["phase"] < 1e-3
    shown = json.loads(said("psf", path, "--field-deg", 12, "--wavelength-nm", 550, "--pixels", 16, "--json"))
    assert shown["method"] == "fitted"
    assert "and this one is fitted; leave it out" in refused("psf", path, "--sensor-shift-um", 10)
    assert shown["rays"] == 0


@pytest.mark.slow
def test_a_thousand_corrupted_files_are_refused_with_code_2_and_one_sentence(refused, file, tmp_path):
    """The same random damage as in test_databasefile, through the command line."""
    whole, rng, broken = file.read_bytes(), np.random.default_rng(7), tmp_path / "broken.npz"
    for _ in range(1000):
        content = damaged(whole, rng)
        if content != whole:
            broken.write_bytes(content)
            assert str(broken) in refused("database", "info", broken)


def test_a_misaligned_lens_has_fields_along_x_and_y(said, refused, tmp_path):
    """Built, shown, and looked up where its own rays give the same picture, to what the database states."""
    bad = displaced(with_f_number(find_lens("double_gauss_28"), 8.0), 3, 5, Placement(0.2, 0.1, 0.0, 0.2, 0.0))
    lens, path = tmp_path / "bad.toml", tmp_path / "bad.npz"
    lens.write_text(lens_to_toml(bad), encoding="utf-8")
    grid = ("--depths-mm", "inf", "--wavelengths-nm", "540,560", "-o", path)
    assert "the six coefficients supports only rotational symmetry; build a fitted one" in refused(
        "database", "build", lens, *grid, "--method", "seidel"
    )
    said("database", "build", lens, "--method", "fitted", *grid)
    shown = said("database", "info", path)
    assert "depth × field y × field x × wavelength" in shown
    assert "-9.99859 to 9.99859" in shown  # the square within 14°: tan 14°/√2
    point = ("--field-deg", -4, "--field-x-deg", 3, "--wavelength-nm", 550, "--pixels", 16, "--pixel-um", 1)
    assert "field (3°, -4°)" in said("psf", path, *point, "-o", tmp_path / "looked.npz")
    said("psf", lens, *point, "--method", "fitted", "-o", tmp_path / "traced.npz")
    looked, traced = (read_psf(tmp_path / name)[0].values for name in ("looked.npz", "traced.npz"))
    assert np.linalg.norm(looked - traced) <= 2 * np.pi * 1e-3 * np.linalg.norm(traced)
    assert "field x 12 degrees is outside" in refused("psf", path, "--field-x-deg", 12, "--wavelength-nm", 550)
    assert "one axis of fields" in refused("export", path, "--to", "csv")


def test_fields_along_x_are_for_fits(refused, tmp_path):
    build = ("database", "build", "singlet_f6", "-o", tmp_path / "a.npz", "--fields-x-deg=-2:2:3", "--method=seidel")
    assert "--fields-x-deg is for --method fitted; leave it out" in refused(*build)
    assert "give angles between −90 and 90 degrees" in refused(*build[:-2], "--fields-x-deg=-95:2:3")
