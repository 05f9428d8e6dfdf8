"""The obscuration of telescopes: by the shadow of a secondary, by a primary's hole, and none of a lens."""

from dataclasses import replace

import pytest

from p2sf.errors import GeometryError
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.obscuration import central_obscuration
from tests.raytrace.test_clear_pieces import telescope
from tests.support.lenses.mirrors import classical, two_mirrors


def test_a_secondary_in_collimated_light_hides_its_own_radius():
    lens = two_mirrors(classical())  # primary 50 mm, secondary 20 mm
    assert central_obscuration(lens) == pytest.approx(20 / 50, abs=1e-12)
    # From 10 m before the primary light diverges: in the secondary's plane the beam is narrower than on the primary.
    apart = abs(lens.surfaces[0].thickness)
    assert central_obscuration(lens, 10_000.0) == pytest.approx(20 / (50 * (1 - apart / 10_000.0)), rel=1e-9)


def test_the_larger_of_shadow_and_hole_counts():
    lens = two_mirrors(classical())
    holed = replace(lens, surfaces=(replace(lens.surfaces[0], inner_radius=30.0), lens.surfaces[1]))
    assert central_obscuration(holed) == pytest.approx(30 / 50, abs=1e-12)
    with pytest.raises(GeometryError, match="no light passes"):
        central_obscuration(replace(lens, surfaces=(lens.surfaces[0], replace(lens.surfaces[1], semi_diameter=60.0))))


def test_the_telescope_with_a_hole_in_its_primary():
    """The hole of 2558 mm stands in collimated light: 0.61196 of the stop's rim, as its listing has it."""
    assert central_obscuration(telescope(4180.0)) == pytest.approx(2558 / 4180, abs=1e-12)


def test_a_lens_hides_nothing():
    assert central_obscuration(find_lens("double_gauss_28")) == 0
