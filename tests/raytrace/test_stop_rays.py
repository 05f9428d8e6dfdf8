"""Rays that fill the real stop against rays traced backwards from it; the long run is `tests.long.aiming`."""

from math import inf

import pytest

from p2sf.lens.lens import with_aim, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from tests.long.aiming import DISTORTION_MM, distortion_mm, row, symmetric_lens
from tests.support.pupil_sums import best_shift_mm
from tests.support.tiers import in_tiers

CELLS = 400  # across the stop: the referee's own error in R² is then below 3e-7


@pytest.mark.parametrize(
    ("name", "field", "depth", "f_number"),
    in_tiers(
        [
            ("wide_angle_35", 21, inf, 5.6),
            ("periskop", 30, 1000.0, None),
            ("reverse_telephoto", 30, 30.0, None),
            ("cooke_triplet", 20, inf, None),
            ("eye_navarro", 30, 250.0, None),
        ],
        [("cooke_triplet", 20, inf, None), ("eye_navarro", 30, 250.0, None)],
    ),
)
def test_psf_light_and_places_are_those_of_rays_from_the_stop(name, field, depth, f_number):
    lens = with_aim(find_lens(name), "stop")
    lens = with_f_number(lens, f_number) if f_number else lens
    source = Source(depth, field_deg=field, wavelength_nm=1000 * lens.reference_wavelength_um)
    found = row(with_sensor(lens, lens.sensor_mm + best_shift_mm(lens, source, "stop")), source, CELLS)
    assert found.good, found


@pytest.mark.parametrize("height", [2.0, 10.0, 20.0])
def test_a_symmetric_lens_at_unit_magnification_does_not_distort(height):
    """Each half undoes the other's: exactly so for the ray through the stop's centre, and for no other."""
    lens = symmetric_lens()
    assert abs(distortion_mm(with_aim(lens, "stop"), height)) <= DISTORTION_MM
    assert abs(distortion_mm(with_aim(lens, "paraxial"), height)) > 1000 * DISTORTION_MM
