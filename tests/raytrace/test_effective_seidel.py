"""The six coefficients by real rays: equal to Seidel's where third order holds, different where it does not."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.lens.lens import Aperture, with_sensor
from p2sf.paraxial.first_order import image_distance
from p2sf.raytrace.effective_seidel import effective_seidel
from tests.support.reference import case, huygens_rows

NAMES = ("w40", "w31", "w22", "w20", "w11")


@pytest.mark.parametrize(("name", "index"), [("double_gauss_28", 1), ("cooke_triplet", 4), ("eye_navarro", 1)])
def test_small_apertures_and_fields_give_seidels_numbers(name, index):
    """Aperture and field scaled by s: each coefficient is of order s⁴ and its departure of order s⁶."""
    lens, source = case(name, huygens_rows(name)[index][0])
    lens = with_sensor(lens, float(image_distance(lens, source.depth_mm, source.wavelength_um)))
    scales = np.array([0.2, 0.1])
    left = np.array([_departures(lens, source, s) for s in scales])
    largest = np.array([_departures(lens, source, scales[1], of=lambda v: v.seidel)]).max()
    assert np.all(left[1] < 0.02 * largest)
    orders = np.log(left[0] / left[1]) / np.log(2)
    assert np.all(orders > 5), orders


def _departures(lens, source, scale, of=None):
    small = replace(lens, aperture=Aperture("stop_semi_diameter", lens.aperture.value * scale))
    found = effective_seidel(small, replace(source, field_slope=source.field_slope * scale), 46)
    if of:
        return [abs(float(getattr(of(found), name))) for name in NAMES]
    return [abs(float(getattr(found.fitted, name) - getattr(found.seidel, name))) for name in NAMES]


def test_off_axis_the_coefficients_differ_and_the_remainder_shows_that_six_are_not_enough():
    lens, source = case("double_gauss_28", huygens_rows("double_gauss_28")[2][0])
    found = effective_seidel(lens, source, 46)
    assert abs(float(found.fitted.w22 - found.seidel.w22)) > 1
    assert found.remainder_waves > 0.1
    # From another program: NA × 0.979 sagittal, × 0.945 tangential at the chief ray.
    assert found.na_ratio_x == pytest.approx(0.979, abs=0.02) and found.na_ratio_y == pytest.approx(0.945, abs=0.02)


def test_on_axis_there_is_no_field_term():
    lens, source = case("double_gauss_28", huygens_rows("double_gauss_28")[0][0])
    found = effective_seidel(lens, source)
    assert found.fitted.w11 == 0 and abs(float(found.fitted.w31)) < 1e-9 and abs(float(found.fitted.w22)) < 1e-9
