"""A number in another unit, an object for a number, and two results compared: a sentence or an answer, no traceback."""

import subprocess
import sys
import tracemalloc

import numpy as np
import pytest

import p2sf
from p2sf.arguments import _kind_words
from p2sf.camera import _check_metres
from p2sf.errors import P2SFError, RequestError, SamplingError
from p2sf.paraxial.first_order import cardinal_points

LENS = p2sf.load_lens("tessar")


@pytest.mark.parametrize(
    ("wavelength_nm", "pixel_um", "na"), [(0.55, 1.375, 0.1), (550.0, 1375.0, 0.1), (550, 1.375, 60)]
)
def test_micrometres_for_nanometres_are_refused_at_once(wavelength_nm, pixel_um, na):
    psf = p2sf.psf_of_opd(np.zeros((64, 64)), 0.1, 550, pixels=64)
    tracemalloc.start()
    with pytest.raises(SamplingError) as refused:
        p2sf.fit_psf(psf.values, na, wavelength_nm, pixel_um)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert "nm" in str(refused.value) and "µm" in str(refused.value)
    assert most < 50e6  # bytes: a sum would take gigabytes


CAMERA = p2sf.Camera(LENS, focus_mm=3000, f_number=8, pixel_um=4)
ASKED = {
    "a wavelength in µm": (lambda: CAMERA.at(wavelength_nm=0.55), "wavelength_nm", "give nanometres, 550"),
    "wavelengths in µm": (lambda: CAMERA.at(wavelength_nm=[0.45, 0.55]), "wavelength_nm", "give nanometres, 450"),
    "a source in µm": (lambda: p2sf.Source(wavelength_nm=0.6328), "wavelength_nm", "give nanometres, 632.8"),
    "a depth in metres": (lambda: CAMERA.at(depth_mm=3.0), "depth_mm", "1000 for each metre"),
    "depths in metres": (lambda: CAMERA.at(depth_mm=np.linspace(1, 5, 4)), "depth_mm", "1000 for each metre"),
    "a wavelength of 0": (lambda: CAMERA.at(wavelength_nm=0), "wavelength_nm", "give a positive"),
    "a depth behind the lens": (lambda: CAMERA.at(depth_mm=-100), "depth_mm", "give a positive"),
    "an angle beyond 90°": (lambda: CAMERA.at(field_deg=[0, 120]), "field_deg", "give"),
    "a table of depths": (lambda: CAMERA.at(depth_mm=[[1000, 2000]]), "depth_mm", "give one number or a list"),
    "no depths": (lambda: CAMERA.at(depth_mm=[]), "depth_mm", "give one number or a list"),
    "a depth that is NaN": (lambda: CAMERA.at(depth_mm=np.nan), "depth_mm", "give one number or a list"),
    "a colour": (lambda: CAMERA.at(wavelength_nm=["green"]), "wavelength_nm", "give"),
    "a number for a source": (lambda: CAMERA.at(3000), "source", "give a p2sf.Source, or name"),
    "a tuple for a source": (lambda: CAMERA.at((3000, 10, 550)), "source", "give a p2sf.Source, or name"),
    "a source and a depth": (lambda: CAMERA.at(p2sf.Source(), depth_mm=3000), "depth_mm", "keep one"),
    "a number stated twice": (lambda: CAMERA.at(f_number=[4, 8]), "f_number", "keep one"),
    "an axis in the plural": (lambda: CAMERA.at(fields_deg=[0, 5]), "fields_deg", "choose"),
    "an axis in µm": (lambda: CAMERA.at(wavelength_um=[0.5]), "wavelength_um", "choose"),
    "no frequencies": (lambda: CAMERA.at(field_deg=[0, 5]).mtf(), "frequency_per_mm", "give one number or a list"),
    "no radii": (lambda: CAMERA.at(field_deg=[0, 5]).energy(), "radius_um", "give one number or a list"),
    "no positions": (lambda: CAMERA.at(field_deg=[0, 5]).line_spread(), "position_um", "give one number or a list"),
    "a method that is none": (lambda: CAMERA.at().psf("fft"), "fft", "choose"),
    "a method of no pupil": (lambda: CAMERA.at().mtf(20, "gaussian"), "gaussian", "choose"),
    "half a pixel": (lambda: CAMERA.at().psf(pixels=16.5), "pixels", "give a whole number"),
    "no pixels": (lambda: CAMERA.at(field_deg=[0, 5]).psf(pixels=0), "pixels", "give a whole number"),
    "a pitch of 0": (lambda: CAMERA.at(field_deg=[0, 5]).psf(pixel_um=0), "pixel_um", "give a positive"),
    "an R² of 1": (lambda: CAMERA.at().psf(min_r2=1.0), "min_r2", "give"),
    "an R² in per cent": (lambda: CAMERA.at().choose_method(99), "min_r2", "give"),
    "a basis that is none": (lambda: CAMERA.at().zernike("ansi"), "ansi", "choose"),
    "no terms": (lambda: CAMERA.at().zernike(terms=0), "terms", "give"),
    "a spectrum that is none": (lambda: CAMERA.at().mtf(20, spectrum="daylight"), "daylight", ";"),
    "an angle that is infinite": (lambda: CAMERA.at().mtf(20, turn_deg=np.inf), "turn_deg", "give"),
    "threads that are none": (lambda: CAMERA.at(threads=0).psf(), "threads", "give a whole number"),
    "an f-number of 0": (lambda: p2sf.Camera(LENS, f_number=0).at().psf(), "f_number", "give"),
    "a focus behind the lens": (lambda: p2sf.Camera(LENS, focus_mm=-3000), "focus_mm", "give a positive"),
    "a pixel below 0": (lambda: p2sf.Camera(LENS, pixel_um=-4), "pixel_um", "give a positive"),
    "the source of several": (lambda: CAMERA.at(field_deg=[0, 5]).source, "2 points", "ask one of them"),
}
"""What someone who knows optics and numpy may write: by what it is, the call, what is named, and what is to be done."""


@pytest.mark.parametrize(("call", "named", "remedy"), ASKED.values(), ids=ASKED)
def test_a_wrong_call_is_one_sentence_with_a_remedy(call, named, remedy):
    with pytest.raises(P2SFError) as refused:
        call()
    told = str(refused.value)
    assert named in told and remedy in told and "\n" not in told


@pytest.mark.parametrize("depth_mm", [3000.0, [500.0, 3000.0], 400.0, np.inf])
def test_depths_that_are_no_metres_are_taken(depth_mm):
    assert CAMERA.at(depth_mm=depth_mm).points


def test_limits_are_no_tolerances():
    errors = [p2sf.Tolerance("radius", 1, 0.1)]
    with pytest.raises(RequestError, match="limits"):
        p2sf.Camera(LENS).tolerances(errors)
    with pytest.raises(RequestError, match="limits"):
        p2sf.tolerances(LENS, p2sf.Source(), errors)
    with pytest.raises(RequestError, match="lens"):
        p2sf.tolerances(errors)


def test_a_map_of_depths_in_metres_is_named():
    camera = p2sf.Camera("double_gauss_28", focus_mm=3000, pixel_um=60, f_number=8)
    metres = np.linspace(2.5, 9.0, 12 * 16).reshape(12, 16)
    for depth in (metres, 3.0):
        with pytest.raises(RequestError, match="1000 for each metre"):
            camera.photograph(np.ones((12, 16, 3)), depth)
    assert camera.photograph(np.ones((12, 16, 3)), 1000 * metres, rtol=0.5).shape == (12, 16, 3)


@pytest.mark.parametrize("focus_mm", [None, 2e5])
def test_a_thing_a_metre_away_may_be_out_of_focus(focus_mm):
    """At ten focal lengths, by a lens in focus far away, or for infinity to the digits of its file."""
    camera = p2sf.Camera("double_gauss_28", focus_mm=focus_mm, pixel_um=60, f_number=8)
    assert camera.photograph(np.ones((6, 8, 3)), 1000.0, rtol=0.5).shape == (6, 8, 3)


def test_results_can_be_compared():
    """By hand: the same call twice has the same numbers, and another depth has not."""
    found = [p2sf.Camera(LENS).at(depth_mm=[2000, far]).coefficients() for far in (3000, 3000, 4000)]
    assert found[0] == found[1] and found[0] != found[2] and found[0] != {} and found[0] != 1
    missing = p2sf.NamedArrays({"a": (("x",), np.array([np.nan, 1.0]))}, {})
    assert missing == p2sf.NamedArrays({"a": (("x",), np.array([np.nan, 1.0]))}, {})
    fits = [p2sf.Camera(LENS).at().zernike(terms=6) for _ in range(2)]
    assert fits[0] == fits[0] and fits[0] != fits[1] and len({*fits}) == 2  # as PSFs are compared: by identity


def test_the_docstring_of_the_package_is_true_in_a_fresh_interpreter():
    code = "import p2sf; assert 'mm' in p2sf.conventions.__doc__; assert 'conventions' in dir(p2sf)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_what_is_asked_for_exists():
    """Of every class that a refusal names: it is in the place that the sentence says."""
    from importlib import import_module

    from p2sf.lens.shapes import Shape

    with pytest.raises(RequestError) as refused:
        p2sf.Surface(10.0, 5.0, "N-BK7", shape="sphere")
    for words in (
        str(refused.value).partition("such as ")[2],
        _kind_words(p2sf.Source)[2:],
        _kind_words(Shape).split()[-1],
    ):
        module, _, name = words.rpartition(".")
        assert hasattr(import_module(module), name)


@pytest.mark.parametrize("depth_mm", [4.0e5, 2.0e4])
def test_an_object_within_the_front_focus_of_a_telescope_is_not_taken_for_metres(depth_mm):
    """The front focus of Hubble lies 474 m before it; its scenes may be nearer, and no number of metres is as large."""
    lens = p2sf.load_lens("hubble")
    assert -float(cardinal_points(lens, lens.reference_wavelength_um).front_focal_distance) > 4.7e5
    _check_metres(lens, depth_mm)
    with pytest.raises(RequestError, match="1000 for each metre"):
        _check_metres(lens, 400.0)
