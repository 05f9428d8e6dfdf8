"""The shipped lenses: twelve that equal their reference data, are found everywhere, and show what they promise."""

import time
import tomllib
import zipfile
from pathlib import Path
from shutil import copy, copytree, ignore_patterns

import numpy as np
import pytest

from p2sf.conventions import slope_from_degrees
from p2sf.errors import LensFileError
from p2sf.glass.media import catalogue_glass
from p2sf.lens.lens import indices, lens_range_um
from p2sf.lensfile.library import find_lens, lenses_folder, shipped_lenses
from p2sf.paraxial.first_order import cardinal_points, image_distance, magnification
from p2sf.paraxial.pupils import f_number, find_stop, paraxial_rays
from p2sf.paraxial.seidel import seidel_sums
from tests.support.reference import LENSES, listed_indices, prescriptions

ROOT = Path(__file__).parents[2]
OWN = ("fast_gauss_f14", "periskop", "singlet_f6", "wide_angle_35")
TELESCOPES = ("cassegrain_f10", "hubble", "maksutov", "schmidt_camera")
RINGS = ("macro_floating", "zoom_3x")
MADE = ("diffractive_singlet", "microscope_10x", "phone_f28", "telecentric_relay", *TELESCOPES, *RINGS)
NEAR = {"relay", "telecentric_relay"}  # for near objects only
D_LINE = 0.5875618


def sums(lens, depth_mm=np.inf, field_deg=None):
    """Return S_I … S_V of a lens, mm, at its largest field."""
    slope = slope_from_degrees(max(lens.fields_deg) if field_deg is None else field_deg)
    return [float(s) for s in seidel_sums(lens, paraxial_rays(lens, depth_mm, D_LINE), slope).total().columns()]


def focal_length(lens, wavelength_um=D_LINE):
    return float(cardinal_points(lens, wavelength_um).effective_focal_length)


def test_the_reference_lenses_and_more_are_shipped():
    assert shipped_lenses() == tuple(sorted((*LENSES, *OWN, *MADE)))


@pytest.mark.parametrize("name", LENSES)
def test_the_twelve_are_their_prescriptions(name):
    lens, data = find_lens(name), prescriptions()[name]
    assert (lens.name, lens.title, lens.source) == (name, data["title"], data["source"])
    assert lens.stop_surface == data["stop_surface"]
    assert (lens.aperture.kind, lens.aperture.value) == ("stop_semi_diameter", data["stop_semi_diameter"])
    assert lens.fields_deg == tuple(data["fields_deg"]) and lens.wavelengths_nm == tuple(data["wavelengths_nm"])
    for surface, row in zip(lens.surfaces, data["surfaces"], strict=True):
        assert surface.radius == (np.inf if row["radius"] is None else row["radius"])
        assert (surface.thickness, surface.semi_diameter) == (row["thickness"], row["semi_diameter"])
        assert (surface.conic, surface.aspheric) == (row["conic"], tuple(row["aspheric_A4_A6"]))


@pytest.mark.parametrize("name", LENSES)
def test_the_twelve_have_the_witness_indices(name):
    """2e-7: the catalogue's float32 coefficients, as in test_glass."""
    lens = find_lens(name)
    for nm in lens.wavelengths_nm:
        np.testing.assert_allclose(indices(lens, nm / 1000), listed_indices(name, nm), rtol=2e-7)


@pytest.mark.parametrize("name", shipped_lenses())
def test_every_lens_says_what_it_is_and_where_it_comes_from(name):
    lens = find_lens(name)
    assert lens.title and lens.source and lens.comment
    assert 20 < len(lens.character) <= 110 and "\n" not in lens.character
    assert tomllib.loads((lenses_folder() / f"{name}.toml").read_text("utf-8"))["unit"] == "mm"


@pytest.mark.parametrize("name", shipped_lenses())
def test_the_stated_aperture_is_the_published_one(name):
    """A file's comment states what was published; the f-number and pupil it leads to agree to its digits."""
    published = prescriptions().get(name, {}).get("published_aperture", {})
    lens = find_lens(name)
    number = float(f_number(lens, lens.reference_wavelength_um))
    if "FNO" in published:
        assert number == pytest.approx(published["FNO"], rel=1e-6)
    if "EPD" in published:
        assert focal_length(lens, lens.reference_wavelength_um) / number == pytest.approx(published["EPD"], rel=1e-6)


@pytest.mark.parametrize("name", sorted(set(shipped_lenses()) - NEAR))
def test_the_sensor_is_near_the_focus_and_no_rim_cuts_the_axial_beam(name):
    """3% of the focal length: field curvature and spherical aberration are shared out, nothing else is."""
    lens = find_lens(name)
    focus = float(image_distance(lens, np.inf, lens.reference_wavelength_um))
    assert lens.sensor_mm == pytest.approx(focus, abs=0.03 * focal_length(lens))
    assert find_stop(lens).warning is None


def test_the_relay_is_for_near_objects():
    lens = find_lens("relay")
    assert float(image_distance(lens, 95.0, D_LINE)) == pytest.approx(lens.sensor_mm, abs=0.6)
    assert float(magnification(lens, 95.0, D_LINE)) == pytest.approx(-1, abs=1e-3)


def test_singlet_and_achromat_are_twins_but_for_colour_and_spherical():
    singlet, achromat = find_lens("singlet_f6"), find_lens("achromat_f6")
    assert focal_length(singlet) == pytest.approx(focal_length(achromat), rel=1e-4)
    assert f_number(singlet, D_LINE) == pytest.approx(f_number(achromat, D_LINE), rel=1e-4)
    assert sums(singlet)[0] > 20 * sums(achromat)[0] > 0
    colour = [np.ptp([focal_length(lens, w) for w in (0.4861327, 0.6562725)]) for lens in (singlet, achromat)]
    assert colour[0] > 10 * colour[1]


def test_the_singlet_has_its_best_form():
    """No bending of equal power has less spherical aberration: either neighbour has more."""
    lens = find_lens("singlet_f6")
    index = float(catalogue_glass("SCHOTT N-BK7").index(D_LINE))
    front, back = (1 / surface.radius for surface in lens.surfaces)
    shape, best = (front + back) / (front - back), 2 * (index**2 - 1) / (index + 2)
    assert shape == pytest.approx(best, abs=0.02)  # Welford's thin-lens best form; this one is 0.755 mm thick


def test_symmetry_cancels_the_odd_aberrations_at_unit_magnification():
    """Coma and distortion vanish to round-off beside terms of 1e-2 mm, the even ones do not."""
    lens = find_lens("periskop")
    points = cardinal_points(lens, D_LINE)
    depth = float(points.effective_focal_length - points.front_focal_distance)
    assert float(magnification(lens, depth, D_LINE)) == pytest.approx(-1, abs=1e-12)
    spherical, coma, astigmatism, petzval, distortion = sums(lens, depth)
    assert abs(coma) < 1e-14 and abs(distortion) < 1e-14
    assert min(abs(spherical), abs(astigmatism), abs(petzval)) > 1e-3
    bend, gap = [s.curvature for s in lens.surfaces], [s.thickness for s in lens.surfaces[:-1]]
    assert bend == [-c for c in bend[::-1]] and gap == gap[::-1] and lens.stop_surface == 3


def test_the_periskop_has_a_flat_tangential_field():
    """3 S_III + S_IV = 0 is a flat tangential field (Welford 1986, §8.6); the radii are rounded to 0.01 mm."""
    _, _, astigmatism, petzval, _ = sums(find_lens("periskop"))
    assert abs(3 * astigmatism + petzval) < 0.05 * petzval


@pytest.mark.parametrize(("name", "stated", "scale"), [("fast_gauss_f14", 50, 1), ("wide_angle_35", 100, 0.35)])
def test_patents_give_the_focal_length_they_state(name, stated, scale):
    """Agreement to 1e-4 says that no leading digit of any radius, thickness or index was lost on the way."""
    assert focal_length(find_lens(name)) / scale == pytest.approx(stated, rel=1e-4)


def test_the_fast_lens_is_fast_and_the_wide_one_wide():
    assert f_number(find_lens("fast_gauss_f14"), D_LINE) == pytest.approx(1.4)
    wide = find_lens("wide_angle_35")
    assert 2 * max(wide.fields_deg) == 63 and wide.sensor_mm > focal_length(wide)


def test_a_path_is_a_file_even_beside_a_shipped_name(tmp_path, monkeypatch):
    text = (lenses_folder() / "tessar.toml").read_text("utf-8")
    (tmp_path / "mine.toml").write_text(text, "utf-8")
    (tmp_path / "plain").write_text(text, "utf-8")
    monkeypatch.chdir(tmp_path)
    for way in ("mine.toml", "./mine.toml", str(tmp_path / "mine.toml"), tmp_path / "mine.toml"):
        assert find_lens(way).name == "mine" and find_lens(way).surfaces == find_lens("tessar").surfaces
    assert find_lens("plain").name == "plain"
    (tmp_path / "tessar").mkdir()
    assert find_lens("tessar").name == "tessar"


@pytest.mark.parametrize(
    ("wanted", "said"),
    [
        ("double_gaus_28", "did you mean double_gauss_28"),
        ("Tesar", "did you mean tessar"),
        ("zzz", "shipped are achromat_f6, asphere"),
        ("", "shipped are"),
        ("\0", "shipped are"),
        ("nowhere/lens.toml", "nowhere/lens.toml: there is no such file; check the path"),
        ("gone.toml", "gone.toml: there is no such file"),
    ],
)
def test_a_lens_that_is_not_there(wanted, said):
    with pytest.raises(LensFileError) as caught:
        find_lens(wanted)
    assert said in str(caught.value) and "\n" not in str(caught.value)


def test_lenses_are_found_in_a_checkout_and_in_an_installed_package(tmp_path):
    assert lenses_folder() == ROOT / "lenses"
    installed = tmp_path / "site-packages" / "p2sf"
    copytree(ROOT / "lenses", installed / "lenses")
    copytree(installed / "lenses", tmp_path / "site-packages" / "lenses")  # another project's folder of this name
    assert lenses_folder(installed) == installed / "lenses"
    with pytest.raises(LensFileError, match="the shipped lenses are missing; install p2sf again"):
        lenses_folder(tmp_path / "nothing" / "p2sf")


@pytest.mark.slow
def test_the_wheel_carries_the_lenses_and_lessons(tmp_path):
    """Build the wheel with the project's own backend, from a copy without git, and look inside."""
    from hatchling.builders.wheel import WheelBuilder

    source = tmp_path / "source"
    source.mkdir()
    for name in ("p2sf", "app", "lenses"):
        copytree(ROOT / name, source / name, ignore=ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        copy(ROOT / name, source / name)
    wheel = next(WheelBuilder(str(source)).build(directory=str(tmp_path), versions=["standard"]))
    names = set(zipfile.ZipFile(wheel).namelist())
    assert {f"p2sf/lenses/{name}.toml" for name in shipped_lenses()} <= names
    lessons = (path.relative_to(ROOT / "app") for path in (ROOT / "app/p2sf_explorer/lessons").rglob("*.*"))
    assert {str(path) for path in lessons if "__pycache__" not in path.parts} <= names
    zipfile.ZipFile(wheel).extractall(tmp_path / "site")
    assert lenses_folder(tmp_path / "site" / "p2sf") == tmp_path / "site" / "p2sf" / "lenses"


def test_all_indices_of_a_lens_are_quick():
    """A slider step has 30 µs for them (measured: 16 µs); three times that for a machine with other work."""
    lens, wave, times = find_lens("double_gauss_28"), np.asarray(0.55), []
    for _ in range(30):
        start = time.process_time()
        for _ in range(50):
            indices(lens, wave)
        times.append((time.process_time() - start) / 50)
    assert np.median(times) < 9e-5


def test_the_range_of_a_lens_is_what_all_its_glasses_share():
    lens = find_lens("telephoto")
    low, high = lens_range_um(lens)
    ranges = [catalogue_glass(f"SCHOTT {g}").range_um for g in ("N-BK7", "N-BASF2", "N-ZK7", "N-LAF33", "SF1")]
    assert (low, high) == (max(a for a, _ in ranges), min(b for _, b in ranges))
    assert np.all(np.isfinite(indices(lens, [low, high])))
    assert lens_range_um(find_lens("eye_navarro")) is None
