"""The public interface: one import, names that load on use, and results that show themselves."""

import doctest
import inspect
import pydoc
import re
from dataclasses import replace
from importlib import import_module
from io import BytesIO
from math import hypot, inf, nan

import numpy as np
import pytest

import p2sf
from p2sf.camera import Camera
from p2sf.conventions import centred_axis, slope_from_degrees
from p2sf.disc.quadrature import cell_areas
from p2sf.disc.transform import matrix_dft
from p2sf.errors import RequestError, SamplingError
from p2sf.figures.compare import r_squared
from p2sf.io import psf_plot
from p2sf.lens.lens import with_aim, with_sensor
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.seidel import coefficients
from p2sf.psf import choosing, methods
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.setting import Request, set_up, set_up_source
from tests.support.interpreter import loaded_by

LENS = p2sf.load_lens("double_gauss_28")
FUNCTIONS = (
    *("build_database", "form_image", "load_lens", "open_database", "plan", "render", "tradeoff"),
    *("energy_of_psf", "fit_psf", "fit_zernike", "line_spread_of_psf", "mtf_of_psf"),
)
EXPLAINED = (*FUNCTIONS, "Camera", "Source", "psf_of_opd", "Pupil", "ObjectPoints")
CAMERAS = tuple(name for name in FUNCTIONS if "camera" in inspect.signature(getattr(p2sf, name)).parameters)
LINES = """
import p2sf
lens = p2sf.load_lens("double_gauss_28")
psf = p2sf.render(lens, p2sf.Source(field_deg=10, wavelength_nm=587.6))
print(psf.method, psf.values.shape, psf.pixel_um, psf.strehl)
"""


def test_a_newcomer_needs_one_import(capsys):
    exec(LINES, {})
    assert capsys.readouterr().out.split()[0] == "traced"


def test_importing_loads_nothing_heavy():
    loaded = {name.split(".")[0] for name in loaded_by("import p2sf; dir(p2sf)")}
    assert not loaded & {"numpy", "scipy", "matplotlib", "cyclopts"}
    computing = loaded_by("import p2sf; p2sf.Camera('double_gauss_28').at().coefficients()")
    assert not {name.split(".")[0] for name in computing} & {"scipy", "matplotlib"}


@pytest.mark.parametrize("name", p2sf.__all__)
def test_every_name_is_documented(name):
    value = getattr(p2sf, name)
    assert name in dir(p2sf) and inspect.getdoc(value)
    if name in FUNCTIONS:
        assert "Raises" in value.__doc__ and "Examples" in value.__doc__


def test_a_name_that_is_none_is_no_attribute():
    with pytest.raises(AttributeError, match="no attribute 'rendering'"):
        _ = p2sf.rendering


@pytest.mark.parametrize("module", sorted({getattr(p2sf, name).__module__ for name in EXPLAINED}))
def test_the_examples_of_the_docstrings_hold(module):
    module = import_module(module)
    found = doctest.testmod(module)
    assert found.attempted and not found.failed


@pytest.mark.parametrize("name", p2sf._FORMER)
def test_a_former_name_says_what_is_written_now(name):
    with pytest.raises(AttributeError, match=re.escape(p2sf._FORMER[name])):
        getattr(p2sf, name)
    assert name not in p2sf.__all__


@pytest.mark.parametrize("name", ["psf", "sweep"])
def test_a_former_method_of_a_camera_says_what_is_written_now(name):
    with pytest.raises(AttributeError, match=re.escape("camera.at(")):
        getattr(Camera(LENS), name)


def test_a_source_takes_degrees_and_nanometres():
    source = p2sf.Source(depth_mm=500, field_deg=10, wavelength_nm=550)
    assert source.field_slope == slope_from_degrees(10) and source.wavelength_um == 0.55
    assert source == p2sf.Source(500, float(slope_from_degrees(10)), 0.55)
    assert source.field_deg == pytest.approx(10, rel=1e-15)
    assert replace(source, depth_mm=inf).field_slope == source.field_slope


def test_a_source_beside_the_plane_of_the_field_keeps_its_direction():
    source = p2sf.Source(field_deg=(3, -4))
    x, y = slope_from_degrees([3, -4])
    assert source.field_slope == pytest.approx(hypot(x, y), rel=1e-15)
    azimuth = np.deg2rad(source.azimuth_deg)
    np.testing.assert_allclose(source.field_slope * np.array([np.sin(azimuth), np.cos(azimuth)]), [x, y], rtol=1e-14)
    turned, plain = (p2sf.render(LENS, s, "seidel", pixels=16) for s in (source, replace(source, azimuth_deg=0.0)))
    assert (turned.azimuth_deg, plain.azimuth_deg) == (source.azimuth_deg, 0)
    np.testing.assert_array_equal(turned.values, plain.values)
    assert p2sf.Source(field_deg=(0, -4)) == p2sf.Source(field_deg=-4)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"depth_mm": -5}, "depth_mm is -5 mm; give a positive number, inf allowed"),
        ({"depth_mm": nan}, "depth_mm is nan mm"),
        ({"depth_mm": None}, "depth_mm is None; give a distance, inf for infinity"),
        ({"field_deg": "ten"}, "field_deg is 'ten'; give one angle"),
        ({"field_slope": inf}, "field_slope is inf; give a finite number"),
        ({"field_deg": 95}, "field_deg is 95°"),
        ({"field_deg": (3, nan)}, "field_deg is nan°"),
        ({"field_deg": (1, 2, 3)}, r"field_deg is \(1, 2, 3\); give one angle in degrees, or two, x and y"),
        ({"field_deg": 3, "field_slope": 0.1}, "field_deg and field_slope are both given; keep one"),
        ({"wavelength_nm": 0}, "wavelength_nm is 0 nm; give a positive finite number"),
        ({"wavelength_um": inf}, "wavelength_um is inf µm"),
        ({"wavelength_nm": 550, "wavelength_um": 0.55}, "wavelength_nm and wavelength_um are both given"),
        ({"azimuth_deg": nan}, "azimuth_deg is nan°"),
        ({"field_deg": (3, 4), "azimuth_deg": 10}, "azimuth_deg and field_deg are both given"),
    ],
)
def test_a_source_that_cannot_be_is_one_sentence(values, words):
    with pytest.raises(RequestError, match=words):
        p2sf.Source(**values)


def test_a_source_of_arrays_stands_for_many():
    many = p2sf.Source(np.array([inf, 500.0]), np.array([[0.0], [0.1]]), 0.55)
    assert many.depth_mm.shape == (2,) and many.field_slope.shape == (2, 1)


def test_the_library_and_the_command_line_set_a_lens_up_by_one_road():
    source = p2sf.Source(3000, field_deg=10, wavelength_nm=550)
    camera = {"focus_mm": 3000, "sensor_shift_um": 20.0, "f_number": 5.6, "stop": "auto"}
    mine = set_up_source(LENS, source, Camera(**camera))
    theirs = set_up(LENS, Request(depth_mm=3000, field_deg=10, wavelength_nm=550, **camera))
    assert mine == theirs
    same = render_integrated(theirs.lens, theirs.source, "seidel", 16)
    np.testing.assert_array_equal(p2sf.render(LENS, source, "seidel", pixels=16, **camera).values, same.values)
    assert p2sf.Camera(LENS, **camera).at(source).choose_method(0.9) == choosing.choose(theirs.lens, theirs.source, 0.9)


def test_help_fits_a_screen():
    """Of 50 rows and 120 columns, over which its long line of parameters is wrapped."""
    lines = pydoc.plain(pydoc.render_doc(p2sf.render)).splitlines()
    assert sum(max(1, -(-len(line) // 120)) for line in lines) <= 50
    assert "Union" not in lines[2] and "method='auto'" in lines[2]


def test_every_function_that_takes_a_camera_takes_how_rays_fill_its_pupil():
    takes = {name: set(inspect.signature(getattr(p2sf, name)).parameters) for name in p2sf.__all__ if name[0].islower()}
    cameras = {name for name, parameters in takes.items() if "f_number" in parameters}
    assert cameras == {"render", "build_database"}
    assert set(CAMERAS) == cameras | {"tradeoff"}
    assert {name for name, parameters in takes.items() if "aim" in parameters} == cameras | {"tradeoff"}


@pytest.mark.parametrize("aim", ["stop", "paraxial"])
def test_an_aim_is_that_of_the_lens_and_real_its_former_name(aim):
    """At 14° the Double Gauss's two pupils differ: R² between them is far below what rounding explains."""
    source, window, filled = p2sf.Source(field_deg=14), {"pixels": 32, "pixel_um": 1.0}, with_aim(LENS, aim)
    mine = p2sf.render(LENS, source, "traced", aim=aim, **window)
    assert np.array_equal(mine.values, p2sf.render(filled, source, "traced", **window).values)
    other = p2sf.render(LENS, source, "traced", aim="paraxial" if aim == "stop" else "real", **window)
    assert r_squared(mine.values, other.values) < 0.99
    assert p2sf.Camera(LENS, aim=aim).at(source).choose_method() == p2sf.Camera(filled).at(source).choose_method()
    assert p2sf.Camera(LENS, aim=aim).at(source).zernike().rms == p2sf.Camera(filled).at(source).zernike().rms
    assert p2sf.tradeoff(LENS, fields_deg=[0], methods="fitted", pixels=16, aim=aim)[0].aim == aim
    assert p2sf.build_database(LENS, [inf], [0, 5], [550], aim=aim).lens == with_aim(LENS, aim)


def test_coefficients_are_those_of_the_focused_lens():
    source = p2sf.Source(3000, field_deg=10)
    focused = with_sensor(LENS, float(image_distance(LENS, 3000, LENS.reference_wavelength_um)))
    direct = coefficients(focused, source.depth_mm, source.field_slope, source.wavelength_um)
    assert p2sf.Camera(LENS, focus_mm=3000).at(source).coefficients() == direct


@pytest.mark.parametrize("method", ["seidel", "fitted"])
def test_a_database_is_built_written_opened_and_asked(tmp_path, method):
    path = tmp_path / "dg.npz"
    nodes = [5000, 10000, inf], [10, 12, 14], [540, 550, 560]
    built = p2sf.build_database(LENS, *nodes, method=method, path=path, f_number=5.6)
    source = p2sf.Source(8000, field_deg=(3, 12), wavelength_nm=545)
    direct = p2sf.render(LENS, source, method, pixels=16, pixel_um=1.0, f_number=5.6)
    for database in (built, p2sf.open_database(path)):
        looked_up = database.psf(source, 16, 1.0)
        np.testing.assert_allclose(looked_up.values, direct.values, atol=1e-4)
        assert looked_up.azimuth_deg == source.azimuth_deg
        six = p2sf.Camera(LENS, f_number=5.6).at(source).coefficients()
        assert float(database.coefficients(source).w40) == pytest.approx(float(six.w40), rel=1e-9)
        assert database.meta["aim"] == LENS.aim
        assert f"double_gauss_28: {method}, exact, 3 × 3 × 3 nodes" in repr(database)
        assert "∞" in database._repr_html_()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: p2sf.tradeoff(LENS, fields_deg=[0, 175]), "fields_deg is 175°"),
        (lambda: p2sf.build_database(LENS, [inf], [0, 175], [550]), "fields_deg is 175°"),
        (lambda: p2sf.tradeoff(LENS, fields_deg=[0], pixels=0), "pixels is 0; give a whole number from 1"),
        (lambda: p2sf.tradeoff(LENS, fields_deg=[0], pixel_um=0), "pixel_um is 0 µm; give a positive finite number"),
        (lambda: p2sf.render(LENS, p2sf.Source(field_slope=np.array([0.0, 0.1]))), r"of shape \(2,\)"),
        (lambda: p2sf.Camera(LENS).at(p2sf.Source(np.array([500.0]))).coefficients(), r"of shape \(1,\)"),
        (
            lambda: p2sf.Camera(LENS).at(p2sf.Source(wavelength_um=np.array([0.5, 0.6]))).choose_method(),
            r"of shape \(2,\)",
        ),
        (lambda: p2sf.render(LENS, aim="sharp"), 'aim is "sharp"; choose stop or paraxial'),
        (lambda: p2sf.tradeoff(LENS, fields_deg=[0], aim="sharp"), 'aim is "sharp"; choose stop or paraxial'),
        (lambda: p2sf.render("double_gauss_28"), "lens is 'double_gauss_28'; give what p2sf.load_lens returns"),
        (lambda: p2sf.build_database("dg", [inf], [0], [550]), "p2sf.load_lens"),
        (lambda: p2sf.tradeoff("dg"), "p2sf.load_lens"),
        (lambda: p2sf.plan("dg", "s.toml"), "p2sf.load_lens"),
        (lambda: p2sf.build_database(LENS, [inf], [0], [550], path="dg.zarr"), "path is dg.zarr; a database is a .npz"),
        (lambda: p2sf.build_database(LENS, [inf], [0], [550], path="none/dg.npz"), "none"),
        (
            lambda: p2sf.build_database(LENS, [inf], [0], [550], method="fitted", interpolant="linear"),
            "interpolant is linear, which is for method seidel",
        ),
    ],
)
def test_what_cannot_be_is_one_sentence_before_the_work(call, words):
    with pytest.raises(p2sf.P2SFError, match=words):
        call()


@pytest.mark.parametrize("method", ["auto", *methods.NAMES])
@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"pixels": 0}, "pixels is 0"),
        ({"pixels": 16.0}, "pixels is 16.0"),
        ({"pixel_um": 0.0}, "pixel_um is 0 µm"),
        ({"pixel_um": nan}, "pixel_um is nan µm"),
        ({"pixel_um": inf}, "pixel_um is inf µm"),
        ({"quality": "best"}, 'quality "best" is unknown'),
        ({"min_r2": nan}, "min_r2 is nan"),
        ({"min_r2": 1.5}, "min_r2 is 1.5; give the R² to hold, below 1"),
        ({"min_r2": -inf}, "min_r2 is -inf"),
    ],
)
def test_every_method_refuses_the_same_samples_qualities_and_tolerances(method, options, words):
    with pytest.raises((RequestError, SamplingError), match=words):
        p2sf.render(LENS, method=method, **options)


@pytest.mark.parametrize("angle", [np.float32(10), np.int64(10), np.array(10.0)])
def test_a_numpy_scalar_is_one_angle(angle):
    assert p2sf.Source(field_deg=angle) == p2sf.Source(field_deg=10)


def test_only_public_names_are_listed():
    listed = {name for name in dir(p2sf) if not (name.startswith("__") and name.endswith("__"))}
    assert listed == {*p2sf.__all__, "conventions"}


def test_psfs_compare_by_identity():
    one, other = (p2sf.render(LENS, method="seidel", pixels=8) for _ in range(2))
    assert one == one and one != other and len({one, other}) == 2


def test_a_turned_psf_is_drawn_along_its_field(monkeypatch):
    drawn = []
    monkeypatch.setattr(psf_plot, "_write_png", lambda figure, *_: drawn.append(figure.axes[0].get_xlabel()))
    for field in (5, (3, 4)):
        p2sf.draw_psf(BytesIO(), p2sf.render(LENS, p2sf.Source(field_deg=field), "seidel", pixels=8))
    assert drawn == ["x on the sensor, µm", "across the field, µm"]


def test_a_method_no_database_has_is_refused():
    with pytest.raises(RequestError, match='method is "traced"; choose auto, seidel or fitted'):
        p2sf.build_database(LENS, [inf], [0], [550], method="traced")


def test_a_scene_is_planned_from_a_file_and_formed(tmp_path):
    (tmp_path / "s.toml").write_text(
        "rtol = 0.4\nf_number = 8\n[sensor]\nrows = 6\ncolumns = 8\npixel_um = 60.0\n"
        '[[channel]]\nname = "green"\nwavelengths_nm = [540]\n'
    )
    planned = p2sf.plan(LENS, tmp_path / "s.toml")
    formed = p2sf.form_image(planned, np.ones((6, 8, 1)), np.full((6, 8), inf), method="lowrank")
    assert formed.shape == (6, 8, 1) and np.allclose(formed, 1, atol=0.1)
    assert repr(planned).startswith("<Plan double_gauss_28: 6 × 8 pixels, 1 channels, predicted error 0.")


def test_what_was_measured_prints_as_a_table():
    rows = p2sf.tradeoff(p2sf.load_lens("landscape"), fields_deg=[0.0], methods="seidel", pixels=16)
    head, *lines = repr(rows).splitlines()
    assert head.startswith("method") and [line.split()[0] for line in lines] == ["seidel", "seidel"]
    assert rows._repr_html_().count("<tr>") == 3


def test_results_show_themselves():
    psf = p2sf.render(LENS, p2sf.Source(field_deg=10, wavelength_nm=550), "seidel", pixels=16, pixel_um=0.5)
    assert repr(psf).startswith("<Psf: seidel, 16 × 16 samples of 0.5 µm, 550 nm, Strehl ratio 0.0")
    assert psf._repr_png_().startswith(b"\x89PNG")
    assert replace(psf, values=psf.values[None])._repr_png_() is None
    assert repr(LENS) == "<Lens double_gauss_28: 11 surfaces, stop_semi_diameter 10.5673, aim stop>"
    assert LENS._repr_html_().count("<tr>") == 12 and "N-SSK2" in LENS._repr_html_()
    six = p2sf.Camera(LENS).at(p2sf.Source(field_deg=10)).coefficients()
    assert repr(six).startswith("<Coefficients in waves: w40 6.4") and "W22" in six._repr_html_()
    assert "array of shape (2,)" in repr(coefficients(LENS, np.array([inf, 500.0]), 0.1, 0.55))
    assert repr(p2sf.Source(field_deg=10, wavelength_nm=550)) == "Source(depth_mm=inf, field_deg=10, wavelength_nm=550)"


SIZE = 64
CELL = (2 * np.arange(SIZE) + 1 - SIZE) / SIZE
XI, ETA = np.meshgrid(CELL, CELL)


@pytest.mark.parametrize("wavefront", [0.8 * ETA**3 + 0.3 * XI**2, 0.8 * XI**3 + 0.5 * XI * ETA], ids=["even", "skew"])
def test_the_psf_of_anybodys_wavefront_is_the_plain_transform(wavefront):
    area = cell_areas(CELL, CELL, 2 / SIZE)
    k, axis = 0.1 / 0.5 * CELL, centred_axis(24, 0.6)
    wanted = np.abs(matrix_dft(area * np.exp(2j * np.pi * wavefront), k, k, axis, axis) / area.sum()) ** 2
    opaque = np.where(area > 0, wavefront, nan)
    found = p2sf.psf_of_opd(opaque, 0.1, 500, pixels=24, pixel_um=0.6)
    np.testing.assert_allclose(found.values, wanted / wanted.sum(), atol=1e-14)
    assert found.over_unaberrated.max() == pytest.approx(wanted.max(), rel=1e-12)
    assert wanted.max() <= found.strehl < 1.05 * wanted.max()


def test_the_light_in_a_window_of_a_wavefront_is_a_share():
    one = p2sf.psf_of_opd(np.zeros((SIZE, SIZE)), 0.1, 500, pixels=48)
    assert 0.97 < one.energy < 1 and one.strehl == pytest.approx(1)
    whole = p2sf.psf_of_opd(XI * ETA**2, 0.1, 500, amplitude=0.5 + XI**2, pixels=2 * SIZE)
    assert whole.energy == pytest.approx(1, abs=1e-9)  # one whole period of the sum holds all of its light


def test_a_wavefront_of_the_six_coefficients_gives_their_psf():
    six = p2sf.Camera(LENS, f_number=8).at(p2sf.Source(wavelength_nm=550)).coefficients()
    square = XI**2 + ETA**2
    opd = float(six.w40) * square**2 + float(six.wd) * square
    seidel = p2sf.render(LENS, p2sf.Source(wavelength_nm=550), "seidel", pixels=32, pixel_um=0.8, f_number=8)
    ours = p2sf.psf_of_opd(opd, float(six.na), 550, pixels=32, pixel_um=0.8)
    assert np.linalg.norm(ours.values - seidel.values) < 2e-3 * np.linalg.norm(seidel.values)
    assert ours.energy == pytest.approx(seidel.energy, rel=1e-3)


@pytest.mark.parametrize(
    ("opd", "options", "words"),
    [
        (np.zeros((4, 6)), {}, "give a square array"),
        (np.zeros((64, 64)), {"amplitude": np.ones((6, 6))}, "give both on the same cells"),
        (np.full((64, 64), nan), {}, "give one that lets light through"),
        (5 * XI**2 * SIZE, {}, "give it on a finer grid"),
        (np.zeros((16, 16)), {"pixels": 64}, "repeats its PSF every 40 µm, and the window is 80 µm wide"),
        (np.zeros((64, 64)), {"pixels": 0}, "pixels is 0; give a whole number from 1"),
    ],
)
def test_a_wavefront_that_cannot_be_summed_is_one_sentence(opd, options, words):
    with pytest.raises(SamplingError, match=words):
        p2sf.psf_of_opd(opd, 0.1, 500, **{"pixels": 8, **options})


def test_masked_cells_of_a_wavefront_are_opaque():
    """What is written in a cell that is masked does not matter; NaN says the same, and so does no amplitude there."""
    rough = np.ma.masked_where(XI > 0.2, np.where(XI > 0.2, 1e3, 0.4 * ETA**3))
    by_nan = p2sf.psf_of_opd(rough.filled(nan), 0.1, 500, pixels=24)
    assert by_nan.values.max() != p2sf.psf_of_opd(0.4 * ETA**3, 0.1, 500, pixels=24).values.max()
    by_mask = p2sf.psf_of_opd(rough, 0.1, 500, pixels=24)
    np.testing.assert_array_equal(by_mask.values, by_nan.values)
    open_area = np.ma.masked_where(XI > 0.2, cell_areas(CELL, CELL, 2 / SIZE))
    by_amplitude = p2sf.psf_of_opd(rough.filled(0.0), 0.1, 500, amplitude=open_area, pixels=24)
    np.testing.assert_allclose(by_amplitude.values, by_nan.values, atol=1e-15)
    with pytest.raises(p2sf.P2SFError):
        p2sf.PupilMap(np.ma.masked_where(XI > 0.2, XI))


@pytest.mark.parametrize(
    "call",
    [
        lambda: p2sf.psf_of_opd(np.exp(1j * XI), 0.1, 500),
        lambda: p2sf.psf_of_opd(0 * XI, 0.1, 500, amplitude=np.exp(1j * XI)),
        lambda: p2sf.psf_of_opd([[0.0, 0.0], [0.0]], 0.1, 500),
        lambda: p2sf.psf_of_opd("wave", 0.1, 500),
        lambda: p2sf.PupilMap(np.exp(1j * XI)),
        lambda: p2sf.PupilMap.sampled(lambda xi, eta: np.exp(1j * xi)),
    ],
)
def test_a_pupil_of_complex_numbers_or_of_none_is_refused(call):
    with pytest.raises(RequestError) as raised:
        call()
    assert "give real numbers" in raised.value.message.template


@pytest.mark.parametrize(("na", "nm"), [(0, 500), (-0.1, 500), (0.1, nan)])
def test_a_wavefront_needs_an_aperture_and_a_wavelength(na, nm):
    with pytest.raises(RequestError, match="give a positive finite number"):
        p2sf.psf_of_opd(np.zeros((16, 16)), na, nm)


def test_a_lens_is_seen_at_its_own_wavelength_where_no_source_is_given():
    """Glass of one index has the same paths at every wavelength, so that waves times wavelength are one number."""
    surfaces = (p2sf.Surface(20.0, 3.0, 1.5), p2sf.Surface(-20.0, 19.0))
    lens = p2sf.Lens(surfaces, p2sf.Aperture("stop_semi_diameter", 1.0), 1, wavelengths_nm=(1550.0,))
    path = float(p2sf.Camera(lens).at(p2sf.Source(wavelength_nm=500.0)).coefficients().w40) * 0.5
    assert float(p2sf.Camera(lens).at().coefficients().w40) * 1.55 == pytest.approx(path, rel=1e-12)
    assert p2sf.render(lens, pixels=8).wavelength_um == 1.55
    assert p2sf.Camera(lens).at().zernike().rms * 1.55 == pytest.approx(
        p2sf.Camera(lens).at(p2sf.Source(wavelength_nm=500.0)).zernike().rms * 0.5, rel=1e-9
    )
    cut_off = 2000 * float(p2sf.Camera(lens).at().coefficients().na) / 1.55
    assert p2sf.Camera(lens).at().mtf().frequency_per_mm[-1] == pytest.approx(cut_off, rel=0.01)  # paraxially
