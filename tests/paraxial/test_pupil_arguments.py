"""Every pupil function looks at the wavelength and the stop it is given, not at the file's."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.glass.media import ConstantIndex, TabulatedIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.paraxial.pupils import (
    Stop,
    f_number,
    field_from_image_height,
    field_from_object_height,
    find_stop,
    numerical_aperture,
    paraxial_rays,
    pupils,
    stop_rim,
    working_f_number,
)
from p2sf.paraxial.seidel import coefficients

GLASS = TabulatedIndex((0.4, 0.7), (1.7, 1.5))
SURFACES = (
    Surface(40.0, 5.0, GLASS, semi_diameter=9.0),
    Surface(-60.0, 6.0, semi_diameter=8.0),
    Surface(semi_diameter=3.0, thickness=60.0, medium=ConstantIndex(1.33)),
)
LENS = Lens(SURFACES, Aperture("stop_semi_diameter", 3.0), 3, wavelengths_nm=(500.0,))
OTHER = Stop(np.asarray(2), np.asarray(2.0), np.asarray(2), "file")
COLOURS = (0.4, 0.5, 0.7)
ANSWERS = {
    "f-number": lambda lens, wavelength, stop: f_number(lens, wavelength, stop),
    "aperture": lambda lens, wavelength, stop: numerical_aperture(lens, 300.0, wavelength, stop),
    "working f-number": lambda lens, wavelength, stop: working_f_number(lens, 300.0, wavelength, stop),
    "entrance pupil": lambda lens, wavelength, stop: pupils(lens, wavelength, stop).entrance_from_first,
    "object height": lambda lens, wavelength, stop: field_from_object_height(lens, 300.0, wavelength, 20.0, stop),
    "image height": lambda lens, wavelength, stop: field_from_image_height(lens, wavelength, 5.0, stop),
    "coma": lambda lens, wavelength, stop: coefficients(lens, 300.0, 0.1, wavelength, stop).w31,
}


def frozen_at(wavelength: float, surface: int, rim: float) -> Lens:
    """Return the lens as one of constant indices whose file names this stop: nothing is left to look up."""
    surfaces = tuple(replace(s, medium=ConstantIndex(float(s.medium.index(wavelength)))) for s in SURFACES)
    return replace(LENS, surfaces=surfaces, stop_surface=surface, aperture=Aperture("stop_semi_diameter", rim))


@pytest.mark.parametrize("name", ANSWERS)
def test_the_given_wavelength_and_stop_decide(name):
    for wavelength in COLOURS:
        for stop, surface, rim in ((None, 3, 3.0), (OTHER, 2, 2.0)):
            expected = ANSWERS[name](frozen_at(wavelength, surface, rim), wavelength, None)
            assert ANSWERS[name](LENS, wavelength, stop) == pytest.approx(float(expected), rel=1e-14)
    assert len({float(ANSWERS[name](LENS, x, stop)) for x in COLOURS for stop in (None, OTHER)}) == 6


def test_an_image_height_is_the_one_the_chief_ray_reaches():
    """Behind the last surface there is water, so that the reduced angle and the slope differ."""
    slope = field_from_image_height(LENS, 0.4, 5.0)
    assert coefficients(LENS, np.inf, slope, 0.4).image_height == pytest.approx(5.0, rel=1e-14)


def test_a_sensor_in_the_exit_pupil_has_no_image_height():
    lens = with_sensor(LENS, 0.0)  # the stop is the last surface, where every chief ray is on the axis
    with pytest.raises(
        GeometryError, match=r"^every chief ray meets the sensor on the axis; give the field as an angle$"
    ):
        field_from_image_height(lens, 0.5, 5.0)


def test_a_stop_table_gives_each_wavelength_its_own_pupil():
    table = Stop(np.array([[2, 3, 3], [3, 2, 3]]), np.array([[2.0, 3.0, 3.0], [3.0, 2.0, 3.0]]), np.asarray(2), "auto")
    found = pupils(LENS, np.array(COLOURS), table)
    for i, j in np.ndindex(2, 3):
        one = Stop(*(np.asarray(x) for x in (table.surface[i, j], table.semi_diameter[i, j], 2)), "auto")
        for name, value in vars(pupils(LENS, COLOURS[j], one)).items():
            assert getattr(found, name)[i, j] == value


def test_the_narrowest_rim_decides_with_its_own_radius():
    found = find_stop(replace(LENS, aperture=Aperture("stop_semi_diameter", 30.0)), np.inf, 0.5, "auto")
    assert (int(found.surface), float(found.semi_diameter), found.chosen_by) == (2, 8.0, "auto")
    nameless = find_stop(replace(LENS, stop_surface=None), np.inf)
    assert (int(nameless.surface), nameless.chosen_by) == (3, "auto")
    assert find_stop(LENS).chosen_by == "file"


@pytest.mark.parametrize("stop", [3, None])
def test_a_pupil_diameter_or_f_number_holds_at_the_reference_wavelength(stop):
    lens = replace(LENS, stop_surface=stop)
    for kind, value, measure in (
        ("entrance_pupil_diameter", 7.0, lambda x: pupils(x, 0.5).entrance_diameter),
        ("f_number", 8.0, lambda x: f_number(x, 0.5)),
    ):
        made = replace(lens, aperture=Aperture(kind, value))
        assert float(measure(made)) == pytest.approx(value, rel=1e-14)
        assert stop_rim(made) > 0


def test_the_marginal_ray_of_a_telecentric_lens_is_positive_in_the_stop():
    telecentric = (Surface(50.0, 100.0, ConstantIndex(1.0)), Surface(np.inf, 5.0))
    lens = Lens((Surface(25.0, 75.0, ConstantIndex(1.5)), *telecentric[1:]), Aperture("stop_semi_diameter", 2.0), 2)
    assert np.isinf(pupils(lens, 0.5).entrance_from_first)
    rays = paraxial_rays(lens, 200.0, 0.5, field="height")
    assert rays.y[1] == pytest.approx(2.0, rel=1e-14)
    assert rays.chief_y[0] == pytest.approx(-1.0, rel=1e-14) and rays.chief_nu[0] == 0
