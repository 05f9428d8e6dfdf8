"""A curved sensor: rays meet it, and each field's picture is that of the tilted plane which touches it there."""

from dataclasses import replace
from math import atan, degrees, hypot, inf, sqrt

import numpy as np
import pytest

import p2sf
from p2sf.lens.lens import Lens, with_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.paraxial.seidel import coefficients
from p2sf.pupil.zernike_fit import zernike_fit
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.field_curves import heights, real_foci
from p2sf.raytrace.pencil import displayed_opd, hexapolar, pencil
from p2sf.raytrace.trace import trace
from p2sf.tolerance.criteria import harms
from p2sf.tolerance.differentials import differentials, usual_sources, with_moved_sensor
from p2sf.tolerance.errors_of_build import Tolerance, build
from p2sf.tolerance.single import sensitivities

RADIUS, CONIC = -40.0, -0.7
FIELD = Source(field_slope=float(np.tan(np.deg2rad(14))), wavelength_um=0.55)
POINTS_OF_PUPIL = hexapolar(4)
XI, ETA = np.array([0.01, 0.3, -0.5, 0.9]), np.array([0.99, -0.4, 0.5, 0.1])


@pytest.fixture(scope="module")
def curved() -> Lens:
    return replace(find_lens("cooke_triplet"), sensor_radius=RADIUS, sensor_conic=CONIC)


def sag(height: float) -> float:
    """Return the sag of the sensor by the textbook's formula, mm."""
    c = 1 / RADIUS
    return c * height**2 / (1 + sqrt(1 - (1 + CONIC) * (c * height) ** 2))


def touching(lens: Lens, height: float) -> Lens:
    """Return the lens with a flat sensor that touches the curved one at this height, by a tilt about x."""
    c = 1 / RADIUS
    slope = c * height / sqrt(1 - (1 + CONIC) * (c * height) ** 2)
    place = Placement(0.0, height, sag(height), tilt_x_deg=degrees(atan(slope)))
    return replace(lens, sensor_radius=inf, sensor_conic=0.0, sensor_before=(place,))


def test_rays_end_on_the_surface(curved):
    rays = pupil_rays(curved, FIELD, XI, ETA)
    found = trace(curved, rays.origins, rays.directions, FIELD.wavelength_um)
    flat = trace(replace(curved, sensor_radius=inf), rays.origins, rays.directions, FIELD.wavelength_um)
    vertex = sum(surface.thickness for surface in curved.surfaces)
    x, y, z = found.points[-1].T
    assert [sag(hypot(*place)) for place in zip(x, y, strict=True)] == pytest.approx((z - vertex).tolist(), abs=1e-12)
    step = (found.points[-1] - flat.points[-1]) / found.cosines
    assert np.ptp(step, axis=1) == pytest.approx(0, abs=1e-11)  # on the same straight line
    assert found.path - flat.path == pytest.approx(step[:, 2], abs=1e-11)


def test_a_pencil_is_that_of_the_plane_that_touches(curved):
    height = float(pencil(curved, FIELD, [0.0], [0.5]).chief_y[0])
    here, there = (pencil(lens, FIELD, XI, ETA) for lens in (curved, touching(curved, height)))
    assert there.chief_y == pytest.approx(0, abs=1e-11)
    for name in ("dx", "dy", "kx", "ky", "kz", "path"):
        assert getattr(here, name) == pytest.approx(getattr(there, name), abs=1e-11), name
    assert here.phase == pytest.approx(there.phase, abs=1e-8)  # 1e-11 mm of path are 2e-8 waves


def test_the_displayed_wavefront_is_on_the_sphere_about_the_point_on_the_surface(curved):
    """The path from each ray back to that sphere, by its own intersection."""
    rays = pencil(curved, FIELD, XI, ETA)
    height = float(rays.chief_y[0])
    aimed = pupil_rays(curved, FIELD, np.append(XI, 0.0), np.append(ETA, 0.0))
    found = trace(curved, aimed.origins, aimed.directions, FIELD.wavelength_um)
    vertex = sum(surface.thickness for surface in curved.surfaces[:-1])
    exit_z = vertex + float(p2sf.paraxial.pupils.pupils(curved, FIELD.wavelength_um).exit_from_last)
    centre, chief = found.points[-1, -1], found.cosines[-1]
    radius = (centre[2] - exit_z) / chief[2]
    assert centre[1] == pytest.approx(height, abs=1e-12)
    from_centre = found.points[-1] - centre
    b = (from_centre * found.cosines).sum(1)
    back = b + np.sqrt(b * b - (from_centre**2).sum(1) + radius**2)
    path = found.path + aimed.path - back
    expected = (path[-1] - path[:-1]) * 1e3 / FIELD.wavelength_um
    assert displayed_opd(curved, FIELD, XI, ETA) == pytest.approx(expected, abs=1e-7)


@pytest.mark.parametrize("method", ["fitted", "traced", "huygens"])
def test_every_exact_method_shows_the_picture_of_that_plane(curved, method):
    height = float(pencil(curved, FIELD, [0.0], [0.5]).chief_y[0])
    pictures = [
        p2sf.render(lens, FIELD, method, pixels=16, pixel_um=2.0).values for lens in (curved, touching(curved, height))
    ]
    # Paths agree to 1e-11 mm, 1e-7 radians; a fit to the whole pupil and one to its half leave some 1e-4 of the waves.
    assert pictures[0] == pytest.approx(pictures[1], abs=(1e-3 if method == "fitted" else 3e-7) * pictures[1].max())


def test_foci_are_counted_from_the_surface(curved):
    flat = replace(curved, sensor_radius=inf)
    height = float(heights(curved, FIELD, FIELD.field_slope).real)
    here, there = (real_foci(lens, FIELD, FIELD.field_slope) for lens in (curved, flat))
    for one, other in zip(here, there, strict=True):
        assert one == pytest.approx(other - sag(height), abs=1e-8)


def test_six_coefficients_follow_the_surface_to_third_order(curved):
    """What is left of foci and heights falls with the fourth and the fifth power of the field."""
    left = []
    for angle in (2.0, 1.0):
        slope = float(np.tan(np.deg2rad(angle)))
        six = coefficients(curved, inf, slope, FIELD.wavelength_um)
        flat = coefficients(replace(curved, sensor_radius=inf), inf, slope, FIELD.wavelength_um)
        moved = with_sensor(curved, curved.sensor_mm + sag(float(flat.image_height)))
        there = coefficients(replace(moved, sensor_radius=inf), inf, slope, FIELD.wavelength_um)
        shift = float(there.image_height - flat.image_height)
        moved_mm = (six.w11 - flat.w11) * six.wavelength_um / six.reduced_slope / 1e3
        left.append((float(six.w20 + six.wd - there.w20 - there.wd), float(moved_mm) - shift))
    assert abs(left[0][0]) > 10 * abs(left[1][0]) and abs(left[0][1]) > 20 * abs(left[1][1])


def test_the_database_of_coefficients_knows_the_surface(curved, tmp_path):
    database = p2sf.build_database(curved, [500, inf], [0, 20], [480, 650], method="seidel", path=tmp_path / "a.npz")
    again = p2sf.open_database(tmp_path / "a.npz")
    direct = coefficients(curved, 900.0, 0.2, 0.55)
    for known in (database.database, again.database):
        found = known.coefficients(900.0, 0.2, 0.55)
        for name in ("w20", "w11", "wd", "w22"):
            assert float(getattr(found, name)) == pytest.approx(float(getattr(direct, name)), rel=1e-11), name


def test_toml_keeps_radius_and_conic(curved):
    assert parse_toml(lens_to_toml(curved), "cooke_triplet.toml") == curved


def test_a_moved_sensor_has_the_waves_of_rays_traced_to_it(curved):
    """Up to piston and tilt, and to the square of the move: the plane turns as the chief ray lands elsewhere."""
    sources, left = POINTS_OF_PUPIL, []
    for step in (1e-2, 1e-3):
        moved, rays = with_moved_sensor(curved, pencil(curved, FIELD, *sources), step)
        again = pencil(moved, FIELD, *sources)
        plane = np.stack([np.ones(rays.fx.size), rays.fx, rays.fy], axis=1)
        apart = rays.phase - again.phase
        apart -= plane @ np.linalg.lstsq(plane, apart, rcond=None)[0]
        left.append(np.abs(apart).max())
    assert left[0] < 1e-3 and left[0] > 30 * left[1]


@pytest.mark.parametrize(
    "error", [Tolerance("decentre_y", 3, 0.01), Tolerance("tilt_x", 7, 0.05), Tolerance("thickness", 6, 0.01)]
)
def test_tolerances_follow_the_surface(curved, error):
    """What an error adds to the RMS of the worst field, against the wavefront of the lens built with it."""
    sources = usual_sources(curved, Source(wavelength_um=curved.reference_wavelength_um))
    known = differentials(curved, sources, (error,))
    found = harms(sensitivities(known, ()), "rms_waves", ())[0]

    def worst(lens: Lens) -> float:
        return max(zernike_fit(lens, source).rms for source in sources)

    built = max(worst(build(curved, [error], [sign * error.amount])) for sign in (1, -1))
    assert found == pytest.approx(built - worst(curved), rel=1e-6)  # both of some 1e3 rays
