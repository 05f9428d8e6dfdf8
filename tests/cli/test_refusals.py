"""Refusals and rare roads that no other test takes: each is a sentence that names what is wrong, or an exact answer."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.cli import main
from p2sf.colour.spectrum import relative_power, spectrum_of
from p2sf.errors import ExportError, GeometryError, LensFileError, RequestError, SamplingError
from p2sf.figures.spot import spot
from p2sf.glass.media import ConstantIndex, catalogue_glass
from p2sf.io.photo_files import read_photo
from p2sf.lens.lens import Aperture, Lens, Surface, with_aim
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, load_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.lensfile.writing import SILICA_LABEL, write_lens
from p2sf.paraxial.pupils import pupils
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.reading import read_psf
from p2sf.raytrace.pencil import pencil
from p2sf.scene.files import read_scene
from p2sf.scene.sensor import Sensor
from tests.support.lenses.lens_files import read, read_file
from tests.support.lenses.simple_lenses import twice_telecentric

TRIPLET, DOUBLET, BENCH = "triplet.json", "doublet.seq", "bench.txt"
GLASS = ConstantIndex(1.5)
ON_AXIS = np.zeros(1), np.zeros(1)


def steep(rim: float) -> Lens:
    """Return half a ball of glass that rays beyond 5 mm miss and that reflects those in a ring within."""
    ball = Surface(5.0, 5.0, GLASS), Surface(inf, 5.0)
    return Lens(ball, Aperture("stop_semi_diameter", rim), 1)


def test_real_rays_have_no_pupil_at_infinity_to_go_through():
    with pytest.raises(GeometryError, match="entrance pupil is at infinity, so a field angle has no meaning"):
        pencil(twice_telecentric(), Source(98.0, 0.0, 0.5), *ON_AXIS)


def test_no_cone_of_light_leaves_an_object_in_the_entrance_pupil():
    """A stop far behind a lens shows as a real entrance pupil in front of it; to see it an object must avoid it."""
    surfaces = Surface(50.0, 3.0, GLASS), Surface(-50.0, 80.0), Surface(inf, 40.0)
    lens = Lens(surfaces, Aperture("stop_semi_diameter", 3.0), 3)
    where = -float(pupils(lens, 0.5).entrance_from_first)
    with pytest.raises(GeometryError, match="object lies in the entrance pupil, so no cone of light is defined"):
        pencil(lens, Source(where, 0.0, 0.5), *ON_AXIS)


def test_an_unknown_aim_is_answered_with_the_known_ones():
    with pytest.raises(GeometryError, match='aim "sharp" is unknown; choose "stop" or "paraxial"'):
        with_aim(find_lens("tessar"), "sharp")


def test_a_lens_without_rims_cannot_clip():
    with pytest.raises(GeometryError, match="states no semi-diameters, so nothing can be clipped"):
        spot(steep(1.0), Source(inf, 0.0, 0.5), clip=True)


def test_a_blur_of_more_rays_than_allowed_is_refused_before_the_work():
    lens = find_lens("double_gauss_28")
    with pytest.raises(SamplingError, match=r"needs \d+ rays; bring the sensor nearer to the image"):
        huygens_psf(lens, Source(20.0, 0.0, 0.5876), 512, 500.0)


@pytest.mark.slow
def test_a_bundle_of_which_the_chief_ray_alone_arrives_has_no_psf():
    """Every ray of a rim 400 times the ball's radius misses it, but for the one through its middle."""
    with pytest.raises(GeometryError, match="no ray but the chief ray reaches the sensor"):
        huygens_psf(steep(2000.0), Source(inf, 0.0, 0.5), 8, 1.0)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--pixels", "1"], "--pixels is 1; give a whole number from 2"),
        (["--pixels", "4097"], "--pixels is 4097; give a whole number from 2 to 4096"),
        (["--pixel-um", "-2"], "--pixel-um is -2 µm; give a positive finite number"),
    ],
)
def test_an_export_that_cannot_be_sampled_is_refused(options, words, refused):
    assert words in refused("export", "any.npz", "--to", "fits", *options)


def test_no_thread_at_all_is_refused(refused):
    told = refused("psf", "tessar", "--method", "huygens", "--pixels", "4", "--threads", "0")
    assert "--threads is 0; give a whole number of 1 or more" in told


def test_an_export_and_a_stack_are_told_about_in_words(said, tmp_path):
    path = tmp_path / "one.zarr"
    nodes = ("--depths-mm", "inf", "--fields-deg", 0, "--wavelengths-nm", 550)
    said("database", "build", "tessar", *nodes, "--stack", "--pixels", 16, "-o", path)
    told = said("database", "info", path)
    assert "complete" in told and "1 × 1 × 1" in told
    assert " kB" in said("export", path, "--to", "csv", "-o", tmp_path / "one.csv")


def test_the_window_without_its_libraries_says_what_to_install(monkeypatch, refused):
    monkeypatch.setattr("p2sf_explorer.commands.find_spec", lambda name: None)
    assert "PySide6" in refused("explore")


def test_the_window_opens_what_it_is_given(monkeypatch):
    opened = []
    monkeypatch.setattr("p2sf_explorer.application.main.main", lambda argv: opened.append(argv) or 0)
    assert main(["explore", "tessar"]) == main(["explore"]) == 0
    assert opened == [["tessar"], []]


ISET = {
    "a surface that is a number": ('"surfaces": [', '"surfaces": [7, ', "is not an object with radius and thickness"),
    "too many terms": ('"aspheric_coefficients": [', f'"aspheric_coefficients": [{"0, " * 30}', "aspheric"),
}


@pytest.mark.parametrize("what", ISET)
def test_an_iset_file_that_is_none_is_refused(what):
    old, new, words = ISET[what]
    with pytest.raises(LensFileError, match=words):
        read(TRIPLET, (old, new))


def test_a_microlens_array_is_told():
    text = read(TRIPLET, ('"surfaces": [', '"microlens": {"a": 1}, "surfaces": [')).report.text
    assert "microlens array is left out" in text


def test_a_plane_of_an_iset_file_may_have_an_infinite_radius():
    lens = read(TRIPLET, ('"radius": 23.713', '"radius": "inf"')).lens
    assert lens.surfaces[0].radius == inf


def test_a_bench_row_of_aspherical_data_needs_its_numbers():
    with pytest.raises(LensFileError, match="needs number, radius, conic; complete it"):
        read(BENCH, ("\n6\t80.0\t0.2", "\n6\n6\t80.0\t0.2"))


@pytest.mark.parametrize("word", ["OBS", "HOL"])
def test_an_obscuration_of_a_codev_file_is_told(word):
    text = read(DOUBLET, ("CIR EDG", f"CIR {word}")).report.text
    assert "rays within a radius of" in text


def test_a_psf_of_an_unknown_ending_is_refused_with_the_known(tmp_path):
    with pytest.raises(ExportError, match=r'the ending "\.doc" is unknown; choose'):
        read_psf(tmp_path / "a.doc")


def test_a_name_no_file_can_have_is_no_lens(refused):
    assert "lens" in refused("info", "x" * 5000)


def test_a_scene_without_a_sensor_is_refused(tmp_path):
    (tmp_path / "s.toml").write_text("rtol = 0.1\nsensor = 5\n")
    with pytest.raises(RequestError, match=r"there is no table \[sensor\]; add it, with rows"):
        read_scene(tmp_path / "s.toml")


def test_a_depth_that_is_no_table_is_told_by_itself(tmp_path):
    (tmp_path / "s.toml").write_text("depth = 5\n[sensor]\nrows = 4\ncolumns = 4\npixel_um = 4\n")
    with pytest.raises(RequestError, match=r"s\.toml: depth is 5; write a table \[depth\]"):
        read_scene(tmp_path / "s.toml")


def test_spectral_lines_have_no_power_per_wavelength():
    with pytest.raises(RequestError, match="take their wavelengths one by one"):
        relative_power(spectrum_of("lines:486,588"), 0.5)


def test_a_sensor_stands_somewhere():
    with pytest.raises(RequestError, match="give two finite numbers"):
        Sensor(4, 4, 1.0, (np.nan, 0.0))


def test_an_interlaced_deep_png_that_breaks_off_is_refused(tmp_path):
    header = b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR" + bytes([0, 0, 0, 4, 0, 0, 0, 4, 16, 2, 0, 0, 1])
    (tmp_path / "a.png").write_bytes(header + b"\x00" * 40)
    with pytest.raises(RequestError, match=r"^\S*a\.png is not a PNG, .* that can be read; convert it to one$"):
        read_photo(tmp_path / "a.png")


FIRST, SURFACE = "SO    0.0 0.1e14", "S     -128.2051282051282 95.5"
CODEV_REFUSED = {
    "an aperture angle beyond a right one": ((("EPD   20.0", "NA 1.5"),), "1.5 is impossible in index 1"),
    "an object in the first vertex": ((("EPD   20.0", "NAO 0.1"), (FIRST, "SO 0.0 0.0")), "lies at the first vertex"),
    "a surface out of its turn": (((SURFACE, "S7 -128.2 95.5"),), "surface 7 is where 3 is expected"),
    "a tilted image": ((("SI    0.0 0.5", "SI 0.0 0.5\n  XOD 3.0"),), "the image surface .*XOD"),
}


@pytest.mark.parametrize("what", CODEV_REFUSED)
def test_a_codev_file_that_describes_no_lens_is_refused(what):
    changes, words = CODEV_REFUSED[what]
    with pytest.raises(LensFileError, match=words):
        read(DOUBLET, *changes)


def test_what_a_codev_file_says_besides_is_told_and_changes_nothing():
    plain = read(DOUBLET)
    assert read(DOUBLET, ("REF   2", "REF   2\nZOO 2")).lens == plain.lens  # two positions that are alike
    assert read(DOUBLET, (SURFACE, f"{SURFACE} AIR")).lens == plain.lens


def test_heights_on_the_axis_are_a_field_of_zero_and_heights_at_infinity_none():
    assert read(DOUBLET, ("YAN   0.0 1.0", "YIM 0.0 0.0")).lens.fields_deg == (0.0,)
    far = read(DOUBLET, ("YAN   0.0 1.0", "YOB 0.0 5.0"))
    assert far.lens.fields_deg == (0.0,) and "the field list holds the axis only" in far.report.text


@pytest.mark.parametrize(("name", "words"), [("none.zmx", "no such file"), ("a\0b.zmx", "cannot be read")])
def test_a_lens_file_that_cannot_be_opened_is_a_sentence(tmp_path, name, words):
    with pytest.raises(LensFileError, match=words):
        read_file(tmp_path / name)


def test_a_comment_of_several_lines_is_written_and_read_as_it_is(tmp_path):
    lens = replace(find_lens("tessar"), comment='first "quoted"\nsecond \\ line\x7f')
    write_lens(lens, tmp_path / "a.toml")
    assert load_lens(tmp_path / "a.toml").comment == lens.comment


def test_fused_silica_keeps_its_dispersion_through_a_zemax_file(tmp_path):
    silica = Surface(50.0, 5.0, catalogue_glass(SILICA_LABEL), semi_diameter=5.0), Surface(inf, 100.0)
    write_lens(Lens(silica, Aperture("stop_semi_diameter", 5.0), 1), tmp_path / "a.zmx")
    again = load_lens(tmp_path / "a.zmx")
    assert float(again.media[1].index(0.5875618)) == pytest.approx(1.458464, abs=1e-5)  # Malitson 1965 at the d line
    assert float(again.media[1].index(0.3)) == pytest.approx(1.48779, abs=1e-5)


def test_a_misaligned_lens_is_told_to_be_set_straight_by_paraxial_figures(tmp_path, capsys):
    text = lens_to_toml(displaced(find_lens("double_gauss_28"), 3, 5, Placement(decentre_y=0.1)))
    (tmp_path / "bad.toml").write_text(text, encoding="utf-8")
    for command in ("info", "coefficients"):
        main([command, str(tmp_path / "bad.toml")])
        assert "those of the aligned lens" in capsys.readouterr().err
