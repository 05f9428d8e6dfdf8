"""Depth of field against the formulas of a thin lens, which is also its own pupil."""

from math import inf

import numpy as np
import pytest

from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.paraxial.depth_of_field import AxialBlur
from p2sf.paraxial.pupils import find_stop

FOCAL, NUMBER, BLUR_UM, UM = 50.0, 4.0, 30.0, 0.55
HYPERFOCAL = FOCAL**2 / (NUMBER * BLUR_UM / 1000)  # from infinity's focus: f²/(N c), and the focus itself f + that


def thin(sensor_mm: float) -> AxialBlur:
    rim = FOCAL / NUMBER / 2
    surface = Surface(thickness=sensor_mm, ideal_focal_length=FOCAL, semi_diameter=rim)
    lens = Lens((surface,), Aperture("stop_semi_diameter", rim), 1)
    return AxialBlur(lens, UM, find_stop(lens))


def focused(distance: float) -> AxialBlur:
    return thin(1 / (1 / FOCAL - 1 / distance))


@pytest.mark.parametrize("distance", [300.0, 2000.0, 50000.0])
def test_near_and_far_limits_are_those_of_a_thin_lens(distance):
    """The blur at u is D·v·|1/u − 1/a| behind a lens of diameter D focused on a, its sensor at v."""
    axial = focused(distance)
    step = BLUR_UM / 1000 / (FOCAL / NUMBER * axial.lens.sensor_mm)
    near, far = 1 / (1 / distance + step), 1 / (1 / distance - step) if 1 / distance > step else inf
    assert axial.sharp_mm(BLUR_UM) == pytest.approx((near, far), rel=1e-9)
    depths = np.array([distance / 2, 3 * distance])
    by_hand = FOCAL / NUMBER / 2 * axial.lens.sensor_mm * np.abs(1 / depths - 1 / distance)
    assert np.abs(axial.heights_mm(depths)) == pytest.approx(by_hand, rel=1e-9)


def test_the_hyperfocal_distance_brings_infinity_just_within():
    hyperfocal = thin(FOCAL).hyperfocal_mm(BLUR_UM)
    assert hyperfocal == pytest.approx(HYPERFOCAL + FOCAL, rel=1e-9)
    blur = 2000 * abs(float(focused(hyperfocal).heights_mm(np.array([inf]))[0]))
    assert blur == pytest.approx(BLUR_UM, rel=1e-9)


def test_nothing_is_sharp_where_the_sensor_stands_before_every_image():
    assert thin(FOCAL / 2).sharp_mm(BLUR_UM) is None
