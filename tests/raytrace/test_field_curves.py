"""Focal surfaces, distortion and colour shift: exact rays against the third order, and laws of symmetric lenses."""

from dataclasses import dataclass
from math import atan, degrees, hypot, inf, nan

import numpy as np
import pytest
from numpy.typing import ArrayLike

from p2sf.errors import GeometryError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, seen_from, with_sensor
from p2sf.lens.misalignment import displaced, with_tilted_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import cardinal_points, image_distance, magnification
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace import field_curves as fieldcurves
from p2sf.raytrace.aiming import pupil_rays, start
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.trace import run

SMALL = np.array([0.01, 0.02])
NAMES = ("double_gauss_28", "cooke_triplet", "landscape", "eye_navarro", "telephoto")


@dataclass(frozen=True, eq=False)
class FocalSurface:
    """The surface of best focus over a grid of fields (x, y), in the axes of the sensor, mm.

    ``points``: (ny, nx, 3), halfway between both foci of each field, z > 0 behind the sensor; NaN where rays are lost.
    ``tilt_deg``: the right-handed tilts about x and y that align a sensor with the least-squares plane through the
    points, degrees; ``shift_mm``: where that plane crosses the middle of the points.
    """

    points: np.ndarray
    tilt_deg: tuple[float, float]
    shift_mm: float


def focal_surface(lens: Lens, source: Source, x_deg: ArrayLike, y_deg: ArrayLike) -> FocalSurface:
    """Return where the points of a plane object are in focus, at all fields (x, y), and the best-fit plane.

    Raises GeometryError if fewer than three fields pass.
    """
    rows = [[_focal_point(lens, source, float(x), float(y)) for x in np.ravel(x_deg)] for y in np.ravel(y_deg)]
    points = np.array(rows)
    known = points[np.isfinite(points).all(-1)]
    if len(known) < 3:
        raise GeometryError(
            "only {count} fields have a focus, but a plane needs three; choose smaller fields", count=len(known)
        )
    centre = known.mean(0)
    across, up = np.linalg.lstsq((known - centre)[:, :2], known[:, 2] - centre[2], rcond=None)[0].tolist()
    # The normal (−across, −up, 1) is R_x(a)·R_y(b)·z = (sin b, −sin a·cos b, cos a·cos b).
    tilt = degrees(atan(up)), degrees(-atan(across / hypot(1.0, up)))
    return FocalSurface(points, tilt, float(centre[2]))


def _focal_point(lens: Lens, source: Source, x_deg: float, y_deg: float) -> list[float]:
    """Return the point (x, y, z) halfway between the foci of a field, in the axes of the sensor, mm."""
    point = Source(source.depth_mm, wavelength_um=source.wavelength_um, field_deg=(x_deg, y_deg))
    foci = fieldcurves.real_foci(lens, point, point.field_slope)
    turned = seen_from(lens, point.azimuth_deg)
    rays = pupil_rays(turned, point, np.zeros(1), np.zeros(1))
    beam = run(turned, start(rays), rays.index)
    if beam.status.any():
        return [nan, nan, nan]
    z = float(foci.sagittal + foci.tangential) / 2
    across, up = (float((place + z * part / beam.r)[0]) for place, part in ((beam.x, beam.p), (beam.y, beam.q)))
    turn = np.deg2rad(point.azimuth_deg)
    return [float(across * np.cos(turn) + up * np.sin(turn)), float(up * np.cos(turn) - across * np.sin(turn)), z]


def focused(name):
    lens, source = find_lens(name), Source(inf, 0.0, 0.5875618)
    return with_sensor(lens, float(image_distance(lens, inf, source.wavelength_um))), source


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("which", ["sagittal", "tangential"])
def test_near_the_axis_exact_foci_are_the_third_orders(name, which):
    lens, source = focused(name)
    real = getattr(fieldcurves.real_foci(lens, source, SMALL), which)
    third = getattr(fieldcurves.seidel_foci(coefficients(lens, inf, SMALL, source.wavelength_um)), which)
    rest = np.abs(real - third)
    # What is left is the spherical aberration of the pencil, NEAR² of W40's, and the fifth order, h⁴.
    assert rest == pytest.approx(np.zeros(2), abs=2e-2 * np.abs(third).max())
    assert third[1] / third[0] == pytest.approx(4, rel=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_distortion_tends_to_the_third_orders_with_its_sign(name):
    lens, source = focused(name)
    found = fieldcurves.heights(lens, source, np.append(0.0, SMALL))
    assert found.distortion[0] == found.third_order_distortion[0] == 0
    assert found.distortion[1:] == pytest.approx(found.third_order_distortion[1:], rel=2e-2)  # the fifth order


def test_a_stop_in_front_makes_a_barrel_and_one_behind_a_cushion():
    """Welford 1986, §8: a singlet's distortion turns its sign with the side the stop is on."""
    lens = find_lens("landscape")
    assert lens.stop_surface == 1 or lens.stop_surface == len(lens.surfaces)
    sign = fieldcurves.heights(lens, Source(), np.array([0.3])).distortion[0]
    assert (sign > 0) == (lens.stop_surface == len(lens.surfaces))


def test_a_symmetric_relay_at_unit_magnification_has_next_to_no_distortion():
    lens = find_lens("relay")
    found = fieldcurves.heights(lens, Source(95.0, 0.0, 0.5875618), np.array([1e-3]))
    assert abs(found.distortion[0]) < 3e-6, "95 mm is near 1:1, not at it"


def test_a_bare_plane_image_of_one_sphere_has_petzvals_curvature():
    """One surface with the stop at its centre of curvature: no astigmatism, image on the sphere of radius n′·f′/n."""
    index, radius = 1.5, 50.0
    ball = Lens(
        (Surface(radius, radius, ConstantIndex(index)), Surface(inf, 2 * radius, ConstantIndex(index))),
        Aperture("stop_semi_diameter", 1.0),
        stop_surface=2,
    )
    slope = np.array([0.05, 0.1])
    foci = fieldcurves.real_foci(ball, Source(), slope)
    assert foci.sagittal == pytest.approx(foci.tangential, abs=1e-6)
    reach = index * radius / (index - 1) - radius  # from the centre of curvature to the focus
    turn = np.arctan(slope)
    assert foci.sagittal == pytest.approx(reach * np.cos(turn) - 2 * radius, abs=1e-4)


def test_a_lost_chief_ray_is_no_number_and_spoils_no_other():
    lens = find_lens("double_gauss_28")
    slope = np.array([0.1, 3.0])
    assert np.isnan(fieldcurves.real_foci(lens, Source(), slope).sagittal).tolist() == [False, True]
    assert np.isnan(fieldcurves.heights(lens, Source(), slope).distortion).tolist() == [False, True]


def test_blue_comes_first_in_a_simple_lens_and_the_paraxial_zone_is_the_limit():
    lens, wave = find_lens("plano_convex"), np.array([0.4861327, 0.5875618, 0.6562725])
    shift = fieldcurves.colour_shift(lens, inf, wave, (0.0, 1e-3, 1.0))
    assert (np.diff(shift[0]) > 0).all()
    assert shift[1] == pytest.approx(shift[0], abs=1e-5 * abs(shift[2] - shift[0]).max() + 1e-9)
    assert (shift[2] < shift[0]).all(), "rim rays of an undercorrected lens meet first"


def test_an_achromat_brings_two_colours_together():
    lens = find_lens("achromat_f6")
    shift = fieldcurves.colour_shift(lens, inf, np.array([0.4861327, 0.5875618, 0.6562725]), (0.0,))[0]
    single = fieldcurves.colour_shift(find_lens("singlet_f6"), inf, np.array([0.4861327, 0.6562725]), (0.0,))[0]
    assert abs(shift[0] - shift[2]) < 0.1 * abs(single[0] - single[1])


GRID = np.array([-0.4, 0.0, 0.4])


def misaligned(x=0.05, tilt=0.1):
    return displaced(find_lens("double_gauss_28"), 3, 5, Placement(x, 0.1, 0, tilt, -0.2))


def test_foci_without_symmetry_are_those_of_symmetry_where_there_is_one():
    """A sphere turned about its own centre is the same sphere, but takes the road of misaligned lenses."""
    lens, slopes = find_lens("double_gauss_28"), np.tan(np.deg2rad([-8.0, 5.0, 10.0]))
    pivot = 0.0, 0.0, lens.surfaces[0].radius
    turned = displaced(lens, 1, 1, Placement(tilt_x_deg=2.0, tilt_y_deg=1.0, pivot=pivot))
    assert turned.misaligned
    for one, two in zip(
        fieldcurves.real_foci(turned, Source(), slopes), fieldcurves.real_foci(lens, Source(), slopes), strict=True
    ):
        assert one == pytest.approx(two, abs=1e-6)
    seen = fieldcurves.heights(turned, Source(azimuth_deg=30.0), slopes)
    assert seen.real == pytest.approx(fieldcurves.heights(lens, Source(), slopes).real, abs=1e-9)
    assert np.abs(seen.aside).max() < 1e-9
    waves, zones = np.array([0.48, 0.65]), (0.0, 0.5, 1.0)
    plain = fieldcurves.colour_shift(lens, inf, waves, zones)
    assert fieldcurves.colour_shift(turned, inf, waves, zones) == pytest.approx(plain, abs=1e-6)


def test_neighbours_of_the_chief_ray_cross_it_at_the_foci():
    """By rays in every direction of the pupil: none comes nearer to the chief ray than those of the two foci."""
    lens, source = misaligned(), Source(field_deg=(6.0, 8.0))
    foci = fieldcurves.real_foci(lens, source, source.field_slope)
    turn, near = np.arange(720) * np.pi / 720, 1e-3
    rays = pencil(lens, source, near * np.sin(turn), near * np.cos(turn))
    chief = rays.chief_kx / rays.chief_kz, rays.chief_ky / rays.chief_kz
    for z in foci:
        apart = np.hypot(rays.dx + z * (rays.kx / rays.kz - chief[0]), rays.dy + z * (rays.ky / rays.kz - chief[1]))
        assert apart.min() < 0.01 * apart.max()
    assert abs(float(foci.sagittal - foci.tangential)) > 0.05


@pytest.mark.parametrize("tilt", [(1.0, 0.0), (0.0, 1.0), (0.6, -0.8)])
def test_the_plane_of_focus_of_a_tilted_sensor_is_tilted_the_other_way(tilt):
    lens, _ = focused("tessar")
    sensor = with_tilted_sensor(lens, Placement(tilt_x_deg=tilt[0], tilt_y_deg=tilt[1]))
    found = focal_surface(sensor, Source(), GRID, GRID)
    assert found.tilt_deg == pytest.approx((-tilt[0], -tilt[1]), rel=1e-3, abs=1e-3)  # of second order in the tilt


@pytest.mark.parametrize("depth", [inf, 150.0])
def test_scheimpflug(depth):
    """A lens turned by α sees the object tilted by −α and tilts its image by −mα to its axis, α(1 − m) to the sensor.

    On top comes the slope of its curved field where the middle of the picture now lies, α·(distance)·|m| off its axis.
    """
    alpha, lens = 0.5, find_lens("tessar")
    lens = with_sensor(lens, float(image_distance(lens, depth, 0.5875618)))
    straight = focal_surface(lens, Source(depth, 0.0, 0.5875618), GRID, GRID)
    assert straight.tilt_deg == pytest.approx((0.0, 0.0), abs=1e-9)
    curvature = 2 * (straight.points[2, 1, 2] - straight.points[1, 1, 2]) / straight.points[2, 1, 1] ** 2
    turned = displaced(lens, 1, len(lens.surfaces), Placement(tilt_x_deg=alpha))
    found = focal_surface(turned, Source(depth, 0.0, 0.5875618), GRID, GRID)
    focal = float(cardinal_points(lens, 0.5875618).effective_focal_length)
    m = 0.0 if depth == inf else float(magnification(lens, depth, 0.5875618))
    lever = focal if depth == inf else -m * depth
    assert found.tilt_deg == pytest.approx((alpha * (1 - m + curvature * lever), 0.0), rel=2e-3, abs=1e-6)


def test_a_chief_ray_lands_beside_the_field_of_a_misaligned_lens():
    found = fieldcurves.heights(misaligned(x=0.2), Source(), np.array([0.0, 0.1]))
    rays = pencil(misaligned(x=0.2), Source(field_slope=0.1), np.zeros(1), np.zeros(1))
    assert (found.aside[1], found.real[1]) == (pytest.approx(rays.chief_x[0]), pytest.approx(rays.chief_y[0]))
    assert abs(found.aside[0]) > 5e-4


@pytest.mark.parametrize("depth", [inf, 900.0])
def test_a_decentred_sensor_distorts_nothing(depth):
    # It moves every image by as much: distortion is that of the aligned lens, to the square of the step of 1e-3.
    lens, source = find_lens("cooke_triplet"), Source(depth, 0.0, 0.5875618)
    slopes = np.array([0.0, 0.01, 0.1, 0.25])
    off = fieldcurves.heights(with_tilted_sensor(lens, Placement(decentre_y=0.2, decentre_x=-0.1)), source, slopes)
    due = fieldcurves.heights(lens, source, slopes)
    assert off.distortion == pytest.approx(due.distortion, abs=2e-6)
    assert off.third_order_distortion == pytest.approx(due.third_order_distortion, rel=1e-5)
    assert off.middle == pytest.approx(-0.2) and off.aside == pytest.approx(0.1 + 0 * slopes)
