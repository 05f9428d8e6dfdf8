"""Focal lengths in two meridians, against matrices of either of them and rays beside the axis."""

from dataclasses import replace
from math import inf, isinf

import numpy as np
import pytest

from p2sf.glass.media import AIR, ConstantIndex
from p2sf.lens.anamorphic import Biconic, Toroid
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.lens.meridians import in_meridian, meridians
from p2sf.lens.placement import Placement
from p2sf.lens.shapes import Qbfs, RadialPolynomial
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import cardinal_points
from p2sf.raytrace.trace import trace
from tests.support.lenses.anamorphs import ANAMORPH, CYLINDER, anamorph, cylinder, figures, turned_by_breaks

UM = 0.5875618
SHAPES = {
    "biconic": Biconic(radius_x=40.0, radius_y=-60.0, conic_x=0.3, conic_y=-2.0, turn_deg=20.0),
    "toroid": Toroid(radius_x=30.0, radius_y=50.0, coefficients=(2e-3, 1e-5), turn_deg=-35.0),
    "cylinder": Toroid(radius_x=30.0, turn_deg=10.0),
    "XY polynomial": XYPolynomial((0.1, -0.2, 0.3, 0.4, -0.5, 0.02, 0.03), 7.0),
    "Zernike standard": ZernikeStandardSag(tuple(1e-3 * np.arange(1, 30)), 8.0),
    "Zernike fringe": ZernikeFringeSag(tuple(1e-3 * np.arange(1, 37)), 8.0),
    "powers": RadialPolynomial((0.0, 2e-3, 0.0, 1e-5)),
    "Qbfs": Qbfs((0.02, 0.01), 9.0),
}


@pytest.mark.parametrize("kind", SHAPES)
@pytest.mark.parametrize("azimuth_deg", [0.0, 25.0, 90.0, 160.0])
def test_the_curvature_of_a_section_is_the_second_derivative_of_the_sag_along_it(kind, azimuth_deg):
    shape, step = SHAPES[kind], 1e-3
    x, y = np.sin(np.deg2rad(azimuth_deg)), np.cos(np.deg2rad(azimuth_deg))  # from +y towards +x
    gradients = [shape.sag_and_gradient(np.array(side * x), np.array(side * y))[1] for side in (step, -step)]
    slopes = [float(gradient @ (x, y)) for gradient in gradients]
    # Central differences of gradients are good to the square of the step over that of the dimensions.
    assert shape.curvature_at(azimuth_deg) == pytest.approx((slopes[0] - slopes[1]) / (2 * step), rel=1e-5, abs=1e-9)


@pytest.mark.parametrize(("lens", "elements"), [(cylinder(), CYLINDER), (anamorph(), ANAMORPH)])
def test_each_meridian_has_the_focal_lengths_of_its_own_matrix(lens, elements):
    for one, meridian in zip(meridians(lens), "yx", strict=True):
        found = cardinal_points(one, UM)
        for name, due in figures(elements, meridian).items():
            assert float(getattr(found, name)) == pytest.approx(due, rel=1e-12), (meridian, name)


def test_the_figures_are_those_of_the_lenses_that_makers_list():
    listed = figures(CYLINDER, "y"), figures(CYLINDER, "x"), figures(ANAMORPH, "y"), figures(ANAMORPH, "x")
    assert [round(each["effective_focal_length"], 2) for each in listed] == [3.91, inf, 31.2, 60.17]


@pytest.mark.parametrize(("lens", "elements"), [(cylinder(), CYLINDER), (anamorph(), ANAMORPH)])
def test_breaks_that_turn_the_axes_about_z_exchange_the_meridians(lens, elements):
    turned = meridians(turned_by_breaks(lens))
    for one, meridian in zip(turned, "xy", strict=True):
        due, found = figures(elements, meridian)["effective_focal_length"], cardinal_points(one, UM)
        assert float(found.effective_focal_length) == pytest.approx(due, rel=1e-12) or isinf(due)


@pytest.mark.parametrize("write", [lambda lens: lens, turned_by_breaks], ids=["plain", "turned by breaks"])
def test_rays_beside_the_axis_leave_at_the_angles_of_both_focal_lengths(write):
    """The slope of a ray that enters at a height h leaves by −h/f, in each meridian: over 10 mm behind the lens."""
    lens, height, way = write(anamorph()), 1e-3, 10.0
    for one, along in zip(meridians(lens), ((0.0, 1.0), (1.0, 0.0)), strict=True):
        start, axis = np.array([[*height * np.array(along), 0.0]]), np.array([[0.0, 0.0, 1.0]])
        near, far = (
            trace(with_sensor(lens, lens.sensor_mm + more), start, axis, UM).points[-1, 0, :2] @ along
            for more in (0.0, way)
        )
        focal = float(cardinal_points(one, UM).effective_focal_length)
        assert (far - near) / way == pytest.approx(-height / focal, rel=1e-6)


def test_a_turn_ends_where_it_is_undone():
    first = Surface(inf, 3.0, ConstantIndex(1.5), semi_diameter=8.0, shape=Toroid(radius_y=50.0))
    turn = Placement(tilt_z_deg=90.0)
    turned = replace(first, before=(turn,), after=(turn.inverse,))
    for surfaces, bends in (((first, first), (1, 1)), ((turned, first), (0, 1)), ((first, turned), (1, 0))):
        lens = Lens((*surfaces, Surface(inf, 90.0, AIR)), Aperture("stop_semi_diameter", 2.0), 1)
        curved = [isinf(surface.radius) is False for surface in in_meridian(lens, 0.0).surfaces[:2]]
        assert curved == [bool(each) for each in bends]


@pytest.mark.parametrize("name", ["cooke_triplet", "phone_f28", "diffractive_singlet"])
def test_lenses_of_revolution_are_their_own_meridians(name):
    lens = find_lens(name)
    assert meridians(lens).y is lens and meridians(lens).x is lens
