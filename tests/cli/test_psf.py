"""`p2sf psf` writes the PSF it says, in every format, by every method."""

import json

import numpy as np
import pytest

import p2sf
from p2sf.cli import main
from p2sf.cli.cautions import long_sum
from p2sf.lensfile.library import find_lens
from p2sf.psf.reading import read_psf
from p2sf.psf.result import IN_WINDOW
from p2sf.setting import Request, set_up


@pytest.mark.parametrize("ending", ["npz", "tiff", "csv", "fits", "png"])
def test_psf_writes_what_it_says(answer, tmp_path, ending):
    path = tmp_path / f"spot.{ending}"
    place = ("--field-deg", 10, "--wavelength-nm", 656.2725, "--pixels", 32, "--pixel-um", 0.69125)
    said = answer("psf", "double_gauss_28", *place, "--method", "seidel", "--sampling", "mdft", "-o", path)
    assert (said["file"], said["pixels"], said["pixel_um"], said["method"]) == (str(path), 32, 0.69125, "seidel")
    if ending != "png":
        psf, meta = read_psf(path)
        assert psf.values.shape == (32, 32) and psf.values.sum() == pytest.approx(1, abs=1e-6)
        assert meta["lens"]["name"] == "double_gauss_28" and len(meta["lens"]["sha256_of_toml"]) == 64
        assert meta["setup"]["depth_mm"] is None and meta["setup"]["field_deg"] == pytest.approx(10)
        assert set(meta["versions"]) >= {"p2sf", "numpy", "python"}


def test_both_samplings_show_the_same_spot(tmp_path, said):
    pictures = []
    for sampling in ("fft", "mdft"):
        path = tmp_path / f"{sampling}.npz"
        said("psf", "cooke_triplet", "--sampling", sampling, "--pixels", 64, "--pixel-um", 0.5, "-o", path)
        pictures.append(read_psf(path)[0].values)
    # A square pupil grid with a yes/no edge is off by some 1e-2; a shift or a flip by far more.
    assert np.linalg.norm(pictures[0] - pictures[1]) < 0.05 * np.linalg.norm(pictures[1])


def test_a_folder_that_is_not_there(capsys):
    place = ("--sampling", "mdft", "-o", "no_such_folder/spot.npz")
    assert main(["psf", "double_gauss_28", *place]) == 2
    error = capsys.readouterr().err
    assert "no_such_folder" in error and "make the folder" in error


def test_rims_clip_as_in_the_library(answer, refused):
    """One colour and a spectrum of one line; an FFT of square samples knows no rims."""
    lens, source, place = (
        p2sf.load_lens("double_gauss_28"),
        p2sf.Source(field_deg=14),
        ("double_gauss_28", "--field-deg", 14),
    )
    own, whole = (p2sf.render(lens, source, pixels=64, pixel_um=4.0, clip=clip) for clip in (True, False))
    found = answer("psf", *place, "--pixel-um", 4, "--clip")
    assert found["strehl"] == pytest.approx(own.strehl, rel=1e-9) and abs(own.strehl / whole.strehl - 1) > 0.1
    all_light = p2sf.Camera(lens).at(source).energy(method=own.method, clip=True)
    assert found["radius_80_um"] == pytest.approx(all_light.radius_80_um, rel=1e-6)  # that of its root
    line = ("--spectrum", f"lines:{1000 * source.wavelength_um}", "--pixel-um", 4)
    assert answer("psf", *place, *line, "--clip")["methods"] == [own.method]
    for flags in (("--method", "seidel"), ("--sampling", "mdft"), ("--method", "fitted")):
        rims, none = (answer("psf", *place, "--pixel-um", 4, *flags, *clip)["strehl"] for clip in (("--clip",), ()))
        assert abs(rims / none - 1) > 0.01
    assert "--clip" in refused("psf", *place, "--sampling", "fft", "--clip")


def test_a_spectrum_keeps_the_tolerance(answer):
    line = ("tessar", "--field-deg", 20, "--spectrum", "lines:588", "--pixels", 16)
    assert answer("psf", *line)["methods"] != answer("psf", *line, "--min-r2", 0.999999)["methods"] == ["spherical"]


def test_the_figures_are_those_of_all_light(answer, tmp_path):
    """Of a wide window whose share of all light is known, its samples on the circle counted in part."""
    wide = ("--pixels", 256, "--pixel-um", 0.4, "-o", tmp_path / "a.npz")
    found = answer("psf", "tessar", "--field-deg", 15, "--method", "seidel", *wide)
    psf, _ = read_psf(tmp_path / "a.npz")
    assert found["share_of"] == "all light" and found["centroid_um"][0] == 0
    assert found["centroid_um"][1] == pytest.approx((psf.values.sum(1) * psf.y_um).sum(), abs=0.1)
    distance = np.hypot(psf.x_um, (psf.y_um - found["centroid_um"][1])[:, None])
    for name, share in (("radius_50_um", 0.5), ("radius_80_um", 0.8)):
        inside = np.clip((found[name] - distance) / psf.pixel_um + 0.5, 0, 1)
        assert found["energy"] * (psf.values * inside).sum() == pytest.approx(share, abs=0.01)


def test_of_a_fitted_shape_the_figures_are_those_of_its_samples(answer, tmp_path):
    found = answer("psf", "tessar", "--field-deg", 15, "--method", "gaussian", "-o", tmp_path / "a.csv")
    psf, _ = read_psf(tmp_path / "a.csv")
    centre = [(psf.values.sum(0) * psf.x_um).sum(), (psf.values.sum(1) * psf.y_um).sum()]
    assert found["share_of"] == f"the {IN_WINDOW}" and found["centroid_um"] == pytest.approx(centre, abs=1e-9)
    assert 0 < found["radius_50_um"] < found["radius_80_um"]


def test_a_table_for_people(said):
    text = said("psf", "asphere", "--method", "seidel", "--pixels", 31)
    assert "31 × 31" in text and "Strehl ratio" in text and "µm" in text and IN_WINDOW in text


@pytest.mark.parametrize("method", ["seidel", "fitted", "traced", "huygens", "gaussian"])
def test_the_method_asked_for_makes_the_picture(method, capsys):
    assert main(["psf", "landscape", "--method", method, "--pixels", "16", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["method"] == method and (found["strehl"] is None) == (method == "gaussian")


def test_a_fitted_gaussian_has_a_dash_for_its_strehl_ratio(said, tmp_path):
    where = tmp_path / "psf.png"
    text = said("psf", "landscape", "--method", "gaussian", "--pixels", 16, "-o", where)
    assert where.stat().st_size > 1000
    assert any(line.split()[:3] == ["Strehl", "ratio", "–"] for line in text.splitlines())
    assert "read off a window" in text


def test_auto_is_the_default_and_takes_the_cheapest_method_that_holds(capsys):
    """Six coefficients describe f/16 on axis and fail off it at f/5, where the blur is small."""
    found = []
    for arguments in (["landscape"], ["cooke_triplet", "--field-deg", "10"]):
        assert main(["psf", *arguments, "--pixels", "16", "--json"]) == 0
        found.append(json.loads(capsys.readouterr().out)["method"])
    assert found == ["seidel", "traced"]


@pytest.mark.slow
def test_a_virtual_image_is_told_beside_the_blur(capsys):
    assert main(["psf", "plano_convex", "--depth-mm", "20", "--method", "seidel", "--pixels", "8"]) == 0
    error = capsys.readouterr().err
    assert error.startswith("warning: the image of an object at 20 mm is virtual, ") and error.count("\n") == 1
    assert "beyond the front focal point" in error
    assert main(["psf", "plano_convex", "--depth-mm", "200", "--method", "seidel", "--pixels", "8"]) == 0
    assert capsys.readouterr().err == ""


def test_a_sum_of_seconds_is_announced_with_its_time():
    setup = set_up(find_lens("double_gauss_28"), Request(field_deg=60.0))
    assert "rise 1490 waves per pupil radius here, so their sum takes some 9 s" in str(long_sum(setup))
    assert long_sum(set_up(find_lens("double_gauss_28"), Request(field_deg=14.0))) is None


def test_a_mask_is_stated_by_options(capsys):
    """As with the lens's own mask; what no mask can be is named by its option."""
    window = ["--method", "huygens", "--pixels", "16", "--pixel-um", "0.5", "--json"]
    assert main(["psf", "cooke_triplet", "--obscuration", "0.4", "--blades", "5", *window]) == 0
    stated = json.loads(capsys.readouterr().out)["strehl"]
    lens = p2sf.with_mask(p2sf.load_lens("cooke_triplet"), p2sf.PupilMask(obscuration=0.4, blades=5))
    source = p2sf.Source(wavelength_nm=lens.reference_wavelength_um * 1000)
    assert stated == pytest.approx(p2sf.render(lens, source, "huygens", pixels=16, pixel_um=0.5).strehl, rel=1e-6)
    assert main(["psf", "cooke_triplet", "--blades", "2"]) == 2
    assert "--blades is 2" in capsys.readouterr().err


@pytest.mark.parametrize("method", ["auto", "seidel", "fitted", "traced", "huygens", "gaussian"])
def test_a_file_holds_what_the_library_returns(answer, tmp_path, method):
    """4 µm at f/5 are wider than λ/(4 NA): light of pixels on both roads."""
    options = ("--f-number", 5, "--pixels", 16, "--pixel-um", 4, "--field-deg", 5, "--method", method)
    found = answer("psf", "double_gauss_28", *options, "-o", tmp_path / "psf.npz")
    lens = find_lens("double_gauss_28")
    source = p2sf.Source(field_deg=5, wavelength_um=lens.reference_wavelength_um)
    mine = p2sf.render(lens, source, method, f_number=5, pixels=16, pixel_um=4.0)
    assert mine.integrated and found["integrated"]
    np.testing.assert_allclose(read_psf(tmp_path / "psf.npz")[0].values, mine.values, rtol=1e-6)  # float32 in the file
    for name in ("strehl", "energy", "predicted_error", "plane_wave_error", "fresnel_number"):
        assert found[name] == (
            pytest.approx(getattr(mine, name), rel=1e-6) if getattr(mine, name) is not None else None
        )


def test_a_looked_up_file_holds_what_the_library_looks_up(answer, tmp_path):
    place = tmp_path / "dg.npz"
    stored = p2sf.build_database(find_lens("double_gauss_28"), [np.inf], [0, 10], [550], path=place, f_number=5)
    answer("psf", place, "--pixels", 16, "--pixel-um", 4, "--field-deg", 5, "-o", tmp_path / "psf.npz")
    mine = stored.psf(p2sf.Source(field_deg=5, wavelength_nm=550), 16, 4.0)
    assert mine.integrated
    np.testing.assert_allclose(read_psf(tmp_path / "psf.npz")[0].values, mine.values, rtol=1e-6)


def test_a_window_that_cuts_light_off_is_warned_about(capsys):
    cut = ["psf", "double_gauss_28", "--field-deg", "10", "--f-number", "2.8", "--pixel-um", "1", "--method", "fitted"]
    assert main(cut) == 0
    error = capsys.readouterr().err
    assert error.startswith("warning: ") and "--pixels" in error and "--pixel-um" in error


def test_the_peak_has_two_coordinates(said):
    rows = [line for line in said("psf", "achromat_f6", "--field-deg", 3).splitlines() if line.startswith("peak,")]
    assert [row.split("  ")[0][-1] for row in rows] == ["x", "y"]
