"""What counts as rounding: the bound below which an angle is zero, term by term, and what survives in arrays."""

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.glass.media import TabulatedIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.paraxial.first_order import (
    ROUNDING,
    SUSPICIOUS,
    abcd,
    basis_rays,
    cardinal_points,
    check_depth,
    chief_ray,
    crossing,
    magnification,
    settled_angle,
)

POWER, GAP = (0.5, -0.25, 0.125), (3.0, -2.0, 1e9)  # the gap behind the last surface never counts
Y, NU = (8.0, 4.0, 2.0), (2.0, 4.0)  # heights; the angles between the surfaces
# Σ|power|y² + Σ|gap|nu² = 0.5·64 + 0.25·16 + 0.125·4 + 3·4 + 2·16, over the last height 2
BOUND = ROUNDING * (32 + 4 + 0.5 + 12 + 32) / 2


@pytest.mark.parametrize("sign", [1, -1])
def test_an_angle_is_rounding_up_to_its_bound_and_not_beyond(sign):
    def settle(angle):
        return float(settled_angle(POWER, GAP, np.array(Y), np.array([*NU, angle])))

    assert settle(sign * BOUND) == 0
    assert settle(sign * BOUND * (1 + 1e-9)) == sign * BOUND * (1 + 1e-9)
    assert settle(0.0) == 0


def test_a_ray_that_ends_on_the_axis_keeps_its_angle():
    """Its last height is 0, so the bound is infinite; only an angle far below the ray's others is suspicious."""
    least = max(NU) * SUSPICIOUS
    for angle, expected in ((1.0, 1.0), (least * 1.01, least * 1.01), (least, 0.0)):
        assert settled_angle(POWER, GAP, np.array([8.0, 4.0, 0.0]), np.array([*NU, angle])) == expected


def test_each_of_several_rays_is_judged_by_itself():
    """The fourth ends on the axis: only its own angles, not its neighbours' larger ones, set the scale of rounding."""
    size = np.array([1.0, 1.0, 1e6, 1.0])
    y, nu = np.outer(Y, size), np.outer((*NU, 0.0), size)
    y[-1, 3], nu[-1] = 0.0, (BOUND / 2, BOUND * 2, BOUND * 9e5, max(NU) * SUSPICIOUS * 2)
    assert settled_angle(POWER, GAP, y, nu).tolist() == [0.0, BOUND * 2, 0.0, max(NU) * SUSPICIOUS * 2]


GLASS = TabulatedIndex((0.4, 0.7), (1.6, 1.5))


def dispersive() -> Lens:
    return Lens((Surface(50.0, 4.0, GLASS), Surface(-50.0, 90.0)), Aperture("stop_semi_diameter", 5.0), 1)


def test_every_first_order_quantity_belongs_to_its_own_wavelength():
    lens, wavelengths = dispersive(), np.array([[0.4, 0.5, 0.6], [0.45, 0.55, 0.7]])
    matrices, points = abcd(lens, wavelengths), cardinal_points(lens, wavelengths)
    sizes = magnification(lens, 300.0, wavelengths)
    assert matrices.shape == (2, 3, 2, 2)
    for place in np.ndindex(2, 3):
        n = float(np.interp(wavelengths[place], (0.4, 0.7), (1.6, 1.5)))
        power = (n - 1) / 50 * (2 - (n - 1) / 50 * 4 / n)  # the lensmaker's equation
        assert points.effective_focal_length[place] == pytest.approx(1 / power, rel=1e-13)
        np.testing.assert_allclose(matrices[place], abcd(lens, wavelengths[place]), rtol=1e-15)
        assert sizes[place] == magnification(lens, 300.0, wavelengths[place])


def test_one_surface_has_its_principal_points_in_its_vertex_at_every_wavelength():
    lens = Lens((Surface(20.0, 30.0, GLASS),), Aperture("stop_semi_diameter", 1.0), 1)
    for wavelength in (0.5, np.array([0.5, 0.6])):
        points = cardinal_points(lens, wavelength)
        for value in (points.front_principal_from_first, points.rear_principal_from_last):
            assert np.shape(value) == np.shape(wavelength) and np.all(value == 0)
        for value in (points.front_nodal_from_first, points.rear_nodal_from_last):
            np.testing.assert_allclose(value, 20.0, rtol=1e-14)  # the centre of curvature


@pytest.mark.parametrize("wavelength", [0.5, np.array([0.5, 0.6])])
def test_a_plane_plate_has_no_cardinal_points_and_says_so_with_plus_infinity(wavelength):
    """Its A − 1 and D − 1 are 0 as well: 0/0, which is no number and no reason for a warning."""
    plate = Lens((Surface(thickness=5.0, medium=GLASS), Surface()), Aperture("stop_semi_diameter", 1.0), 1)
    points = vars(cardinal_points(plate, wavelength))
    assert np.all(np.isinf(points.pop("effective_focal_length")))  # −1/C, and C may be 0 or −0
    for name, value in points.items():
        np.testing.assert_array_equal(value, np.full(np.shape(wavelength), np.inf), name)


def test_the_axis_itself_crosses_the_axis_nowhere():
    assert crossing(1.0, np.array([0.0, 2.0]), np.array([0.0, 0.0])).tolist() == [np.inf, np.inf]
    assert crossing(1.0, 0.0, np.float64(0.0)) == np.inf


def test_the_chief_ray_of_one_wavelength_is_kept_and_that_of_many_is_not():
    """A slider asks for the one a hundred times a second; tables of the other would fill the memory."""
    one, many = (basis_rays(dispersive(), x) for x in (0.5, np.array([0.5, 0.6])))
    assert chief_ray(one, 2)[0] is chief_ray(one, 2)[0] and not chief_ray(one, 2)[0].flags.writeable
    assert chief_ray(many, 2)[0] is not chief_ray(many, 2)[0]


def test_the_first_bad_depth_is_the_one_named():
    with pytest.raises(GeometryError, match="depth is -3 mm"):
        check_depth(np.array([[0.5, 1.0], [-3.0, np.nan]]))
    check_depth([1, 2])
