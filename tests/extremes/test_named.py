"""Where no finite number exists: an exact answer, or an error that names the missing quantity and the reason."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.errors import GeometryError, GlassError
from p2sf.glass.media import TabulatedIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.paraxial.first_order import cardinal_points, image_distance, magnification
from p2sf.paraxial.pupils import (
    f_number,
    field_from_object_height,
    find_stop,
    numerical_aperture,
    paraxial_rays,
    pupils,
    stop_rim,
    working_f_number,
)
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.seidel import seidel_psf
from p2sf.raytrace.pencil import Status, trace
from tests.extremes.regimes import WAVELENGTH, base, random_lens
from tests.support.lenses.simple_lenses import simple, telescope, twice_telecentric

TELESCOPES = (telescope(-40.0, 3.0), telescope(25.0, 3.0), telescope(-33.3, 0.7), telescope(41.7, 0.3))


@pytest.mark.parametrize("lens", TELESCOPES)
def test_an_afocal_lens_has_no_focal_length_and_says_infinity(lens):
    points = cardinal_points(lens, WAVELENGTH)
    assert all(value == np.inf for value in vars(points).values())
    assert f_number(lens, WAVELENGTH) == inf
    assert image_distance(lens, inf, WAVELENGTH) == inf


@pytest.mark.parametrize("lens", TELESCOPES)
def test_an_afocal_lens_magnifies_every_object_alike(lens):
    values = magnification(lens, np.array([1.0, 1e3, 1e9, inf]), WAVELENGTH)
    # 1/D at every depth; at 1e9 mm the rounding of C, some 1e-18 per mm, counts 1e-9 times
    np.testing.assert_allclose(values, values[-1], rtol=1e-7)


def test_an_afocal_lens_has_coefficients_but_no_psf():
    found = coefficients(TELESCOPES[0], inf, 0.01, WAVELENGTH)
    assert found.na == 0 and found.wd == 0 and found.image_distance == inf and np.isfinite(found.w40)
    assert working_f_number(TELESCOPES[0], inf, WAVELENGTH) == inf
    with pytest.raises(GeometryError, match="image of this object lies at infinity"):
        seidel_psf(found)


def test_an_f_number_of_an_afocal_lens_is_refused():
    for lens in TELESCOPES:
        with pytest.raises(GeometryError, match=r"^an afocal lens has no f-number; state .* diameter$"):
            stop_rim(replace(lens, aperture=Aperture("f_number", 4.0)))


@pytest.mark.parametrize("name", ["double_gauss_28", "achromat_f6", "asphere"])
def test_an_object_in_the_front_focal_plane_has_its_image_at_infinity(name):
    lens = base(name)
    depth = -float(cardinal_points(lens, WAVELENGTH).front_focal_distance)
    assert image_distance(lens, depth, WAVELENGTH) == inf
    assert magnification(lens, depth, WAVELENGTH) == inf
    assert numerical_aperture(lens, depth, WAVELENGTH) == 0
    # 1e-12 beside it there is an image again, on the side it belongs to
    near, far = image_distance(lens, depth * np.array([1 - 1e-12, 1 + 1e-12]), WAVELENGTH)
    assert -inf < near < 0 < far < inf


def test_a_stop_imaged_to_infinity_on_both_sides():
    lens = twice_telecentric()
    pupil = pupils(lens, WAVELENGTH)
    assert all(np.isinf(value) for name, value in vars(pupil).items() if name != "upright")
    with pytest.raises(GeometryError) as refused:
        coefficients(lens, 98.0, 0.1, WAVELENGTH)
    assert str(refused.value) == (
        "the entrance pupil is at infinity, so a field angle has no meaning; move the stop away from that focus, "
        'or in Python state the field as an object height, field="height"'
    )
    with pytest.raises(GeometryError, match=r"^an object at infinity has no height; .* height$"):
        coefficients(lens, inf, 1.0, WAVELENGTH, field="height")
    found = coefficients(lens, 98.0, 3.0, WAVELENGTH, field="height")
    # The relay is 1:1 and turns the image upside down: an object 3 mm below the axis lands 3 mm above it.
    assert found.image_height == pytest.approx(3.0, rel=1e-14)
    assert found.na == pytest.approx(4.0 / 100, rel=1e-14)
    assert all(np.isfinite(value) for value in vars(found).values())


def test_object_height_and_field_slope_tell_the_same_story():
    lens = base("double_gauss_28")
    depth = np.array([[300.0], [5000.0]])
    slope = field_from_object_height(lens, depth, WAVELENGTH, 20.0)
    by_slope = coefficients(lens, depth, slope, WAVELENGTH)
    by_height = coefficients(lens, depth, 20.0, WAVELENGTH, field="height")
    for name, value in vars(by_slope).items():
        np.testing.assert_allclose(getattr(by_height, name), value, rtol=1e-13, err_msg=name)


def test_image_space_telecentric_lens_has_its_exit_pupil_exactly_at_infinity():
    lens = simple([(inf, 100.0, 1.0), (50.0, 3.0, 1.5), (inf, 98.0, 1.0)], 1, 3.0)
    assert pupils(lens, WAVELENGTH).exit_from_last == inf
    assert np.isfinite(coefficients(lens, inf, 0.1, WAVELENGTH).w31)


def test_an_object_in_the_entrance_pupil_is_refused():
    lens = simple([(inf, 10.0, 1.0), (50.0, 3.0, 1.5), (-50.0, 40.0, 1.0)], 3, 3.0)
    where = -float(pupils(lens, WAVELENGTH).entrance_from_first)
    if where <= 0:  # a lens of this power shows its last surface to the right: put the stop where it shows left
        lens = simple([(50.0, 3.0, 1.5), (-50.0, 80.0, 1.0), (inf, 40.0, 1.0)], 3, 3.0)
        where = -float(pupils(lens, WAVELENGTH).entrance_from_first)
    assert where > 0
    with pytest.raises(GeometryError, match="object lies in the entrance pupil"):
        paraxial_rays(lens, where, WAVELENGTH)


@pytest.mark.parametrize("depth", [0.0, -1.0, -inf, float("nan")])
def test_a_depth_that_is_no_distance_is_refused(depth):
    for function in (image_distance, magnification, numerical_aperture, find_depth_stop):
        with pytest.raises(GeometryError, match="depth is"):
            function(base("double_gauss_28"), depth, WAVELENGTH)


def find_depth_stop(lens, depth, wavelength):
    return find_stop(lens, depth, wavelength)


def test_total_reflection_is_a_reason_and_a_surface():
    prism = Lens(
        (Surface(inf, 5.0, base("achromat_f6").media[1]), Surface(inf, 5.0)), Aperture("stop_semi_diameter", 1.0), 1
    )
    steep = np.array([0.0, 0.99, np.sqrt(1 - 0.99**2)])
    assert (
        trace(prism, np.zeros(3)[None], steep[None], WAVELENGTH).status[0] == Status.PASSED
    )  # a plate lets it out again
    backwards = Lens((Surface(inf, 5.0),), Aperture("stop_semi_diameter", 1.0), 1, object_medium=prism.media[1])
    found = trace(backwards, np.zeros(3)[None], steep[None], WAVELENGTH)
    assert (found.status[0], found.failed_surface[0]) == (Status.REFLECTED, 1)
    assert np.isnan(found.cosines).all() and np.isnan(found.path).all()


def test_a_wavelength_outside_the_data_is_refused_everywhere():
    glass = TabulatedIndex((0.4, 0.7), (1.53, 1.51))
    lens = Lens((Surface(50.0, 3.0, glass), Surface(inf, 90.0)), Aperture("stop_semi_diameter", 5.0), 1)
    assert np.isfinite(coefficients(lens, inf, 0.1, np.array([0.4, 0.7])).w40).all()
    for wavelength in (np.nextafter(0.4, 0), np.nextafter(0.7, 1), -0.5, float("nan"), np.array([0.5, 0.8])):
        for function in (cardinal_points, pupils):
            with pytest.raises(GlassError, match="outside"):
                function(lens, wavelength)
        with pytest.raises(GlassError, match="outside"):
            coefficients(lens, inf, 0.1, wavelength)


def test_four_hundred_surfaces_overflow_nothing():
    with np.errstate(over="raise", invalid="raise"):
        found = coefficients(random_lens(400, 3), np.array([1e-3, 1.0, 1e15, inf]), 0.1, WAVELENGTH)
    assert all(np.isfinite(value).all() for value in vars(found).values())
