"""The y–ȳ diagram obeys Delano's laws, which need no ray: triangles from the origin are reduced thicknesses."""

from math import inf

import numpy as np
import pytest

from p2sf.lens.lens import indices
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.pupils import find_stop, paraxial_rays, pupils
from p2sf.paraxial.ybar import ybar

WAVE = 0.5875618


def diagram(name, depth_mm, slope=0.1):
    lens = find_lens(name)
    stop = find_stop(lens, depth_mm, WAVE)
    return lens, stop, ybar(lens, Source(depth_mm, slope, WAVE), stop, paraxial_rays(lens, depth_mm, WAVE, stop))


@pytest.mark.parametrize("name", ["double_gauss_28", "telephoto", "cassegrain_f10", "eye_navarro"])
@pytest.mark.parametrize("depth_mm", [inf, 900.0])
def test_twice_the_triangle_of_two_points_and_the_origin_is_invariant_times_reduced_thickness(name, depth_mm):
    """Delano 1963: y₁ȳ₂ − y₂ȳ₁ = H·t/n, with H from the entrance pupil alone."""
    lens, stop, found = diagram(name, depth_mm)
    pupil = pupils(lens, WAVE, stop)
    thickness = np.array([s.thickness for s in lens.surfaces])
    # A slanting chief ray through the entrance pupil's centre, the marginal ray through its rim: H = n·slope·radius.
    index = indices(lens, WAVE)
    invariant = index[0] * 0.1 * float(pupil.entrance_diameter) / 2
    last = slice(-len(thickness) - 1, None)
    y, chief = found.y[last], found.chief_y[last]
    twice, expected = y[:-1] * chief[1:] - y[1:] * chief[:-1], invariant * thickness / index[1:]
    assert np.sign(twice @ expected) * twice == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("name", ["double_gauss_28", "telephoto"])
def test_it_crosses_the_axes_at_the_stop_and_at_the_object_and_image(name):
    lens, stop, found = diagram(name, 900.0)
    assert found.names[0] == "object" and found.names[-1] == "sensor"
    assert found.y[0] == pytest.approx(0.0, abs=1e-9) and found.chief_y[0] != 0
    assert found.chief_y[found.stop] == pytest.approx(0.0, abs=1e-9)
    assert abs(found.y[found.stop]) == pytest.approx(float(stop.semi_diameter), rel=1e-9)
    defocus = lens.sensor_mm - float(image_distance(lens, 900.0, WAVE))
    na = (found.y[-1] - found.y[-2]) / lens.sensor_mm
    assert found.y[-1] == pytest.approx(na * defocus, rel=1e-6)


def test_of_an_infinite_object_the_last_side_is_the_focal_length_seen_from_the_origin():
    """The marginal ray comes in at the height of the entrance pupil's rim and leaves at −height/f."""
    lens, stop, found = diagram("double_gauss_28", inf)
    radius = float(pupils(lens, WAVE, stop).entrance_diameter) / 2
    focal = float(cardinal_points(lens, WAVE).effective_focal_length)
    assert found.y[0] == pytest.approx(radius)
    assert (found.y[-1] - found.y[-2]) / lens.sensor_mm == pytest.approx(-radius / focal)
    on_axis = diagram("double_gauss_28", inf, 0.0)[2]
    assert on_axis.axial and not found.axial
