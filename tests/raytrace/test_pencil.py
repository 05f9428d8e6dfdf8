"""Exact rays: against the witness's OPD maps, and against the laws that any ray obeys."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.figures.fans import opd_fan, ray_fan
from p2sf.lens.lens import Aperture, Lens, Surface, with_aim, with_sensor
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import numerical_aperture
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import (
    Status,
    displayed_opd,
    opd_map,
    pencil,
    pupil_grid,
    pupil_rays,
    trace,
)
from p2sf.raytrace.ray_field import steepness
from p2sf.raytrace.trace import status_message
from tests.support.rays.made_rays import made_rays
from tests.support.rays.pencils import GLASS, disc, double_gauss, one_surface
from tests.support.reference import LENSES, case, huygens_rows, prescription_lens

# The witness promises its OPD to 1e-9 waves of paths of 1e5 waves; ours keeps 3.5e-9 in double precision.
OPD_TOLERANCE = 1e-8


@pytest.mark.parametrize("name", LENSES)
def test_opd_and_chief_ray_equal_the_witness(name):
    for row, _, opd in huygens_rows(name):
        lens, source = case(name, row)
        ours = opd_map(lens, source, 32)
        assert np.array_equal(np.isnan(ours), np.isnan(opd))
        assert np.nanmax(np.abs(ours - opd)) < OPD_TOLERANCE
        assert pencil(lens, source, [0.0], [0.5]).chief_y[0] == pytest.approx(row["chief_ray_y_mm"], abs=1e-12)


def test_every_leading_axis_equals_its_own_trace():
    lens, (xi, eta) = double_gauss(), disc(20)
    fields = np.array([[0.0], [0.1], [0.2]])
    depths = np.array([inf, 2000.0])
    together = pencil(lens, Sources(depths, fields, 0.6562725), xi, eta)
    assert together.path.shape == (3, 2, 20)
    for i, j in np.ndindex(3, 2):
        alone = pencil(lens, Source(depths[j], fields[i, 0], 0.6562725), xi, eta)
        assert np.array_equal(together.path[i, j], alone.path)
        assert np.array_equal(together.dy[i, j], alone.dy)


def test_wavelengths_may_be_an_axis():
    lens, (xi, eta) = double_gauss(), disc(20)
    together = pencil(lens, Sources(inf, 0.1, np.array([0.5, 0.6])), xi, eta)
    alone = pencil(lens, Source(inf, 0.1, 0.6), xi, eta)
    assert np.allclose(together.phase[1], alone.phase, atol=1e-12)


def test_a_chief_ray_that_fails_is_an_error_that_says_why_and_where():
    with pytest.raises(GeometryError, match=r"the chief ray .* surface \d") as refused:
        pencil(double_gauss(), Source(inf, np.tan(np.deg2rad(75)), 0.6562725), [0.0], [0.5])
    outcome = refused.value.message.values["outcome"]
    assert outcome == status_message(double_gauss(), Status.REFLECTED, 2)


def test_an_object_a_million_metres_away_loses_no_digit():
    """Against infinity only the defocus of 1/10⁹ mm is left, which first-order optics knows exactly."""
    lens, far = double_gauss(), 1e9
    xi, eta = disc()
    change = displayed_opd(lens, Source(far, 0.1, 0.6562725), xi, eta)
    change = change - displayed_opd(lens, Source(inf, 0.1, 0.6562725), xi, eta)
    slow = displayed_opd(lens, Source(1e6, 0.1, 0.6562725), xi, eta)
    slow = slow - displayed_opd(lens, Source(inf, 0.1, 0.6562725), xi, eta)
    assert np.max(np.abs(change)) > 1e-4
    # Linear in vergence up to its square, 1e-3 of the slow change's thousandth; round-off of 1e-9 waves.
    assert np.max(np.abs(change - slow / 1e3)) < 1e-6 * np.max(np.abs(slow)) + 4e-9


def test_aimed_rays_fill_the_stop():
    lens, (xi, eta) = with_aim(double_gauss(), "stop"), disc(60)
    for depth in (inf, 2000.0):
        rays = pupil_rays(lens, Source(depth, np.tan(np.deg2rad(14)), 0.6562725), xi, eta)
        at_stop = trace(lens, rays.origins, rays.directions, 0.6562725).points[6]
        rim = lens.aperture.value
        assert np.max(np.abs(at_stop[:, 0] - rim * xi)) < 1e-9 and np.max(np.abs(at_stop[:, 1] - rim * eta)) < 1e-9


def test_aimed_and_paraxial_rays_agree_in_a_narrow_pencil():
    lens = replace(double_gauss(), aperture=Aperture("stop_semi_diameter", 1e-3))
    source, points = Source(inf, 1e-3, 0.6562725), disc(20)
    plain, aimed = (pupil_rays(with_aim(lens, aim), source, *points) for aim in ("paraxial", "stop"))
    assert np.max(np.hypot(plain.x - aimed.x, plain.y - aimed.y)) < 1e-3 * np.max(np.hypot(plain.x, plain.y))


def test_a_pupil_point_of_a_relay_is_upside_down_in_its_stop():
    """The relay's entrance pupil is a real image of the stop: aimed rays keep to their side of the pupil, both ways."""
    lens, (xi, eta) = with_aim(prescription_lens("relay", 587.5618), "stop"), (0.3, 0.5)
    rays = pupil_rays(lens, Source(150.0, 0.0, 0.5875618), [xi], [eta])
    assert rays.x[0] > 0 and rays.y[0] > 0
    at_stop = trace(lens, rays.origins, rays.directions, 0.5875618).points[lens.stop_surface, 0, :2]
    # 1e-9 of the rim is a hundred times what the aiming stops at.
    np.testing.assert_allclose(at_stop, [-lens.aperture.value * xi, -lens.aperture.value * eta], rtol=1e-9)


def test_rays_are_aimed_step_by_step_where_the_paraxial_pupil_is_no_start():
    """At 60° some aimed rays are lost when the search starts from the paraxial pupil, none by way of smaller fields."""
    lens, angle = with_aim(prescription_lens("asphere", 587.5618), "stop"), 2 * np.pi * np.arange(12) / 12
    xi, eta = np.sin(angle), np.cos(angle)
    rays = pupil_rays(lens, Source(inf, np.tan(np.deg2rad(60)), 0.5875618), xi, eta)
    at_stop = trace(lens, rays.origins, rays.directions, 0.5875618).points[lens.stop_surface]
    wanted = lens.aperture.value * np.stack([xi, eta], -1)
    np.testing.assert_allclose(at_stop[:, :2], wanted, atol=1e-9)  # mm; the search stops at 1e-11 of the rim


def test_a_ray_that_no_search_brings_onto_the_stop_is_nan_and_says_so():
    """At 40° through the meniscus many pupil points have no ray: not one may pass off as aimed."""
    lens, wavelength = with_aim(prescription_lens("landscape", 587.5618), "stop"), 0.5875618
    angle = 2 * np.pi * np.arange(24) / 24
    source, xi, eta = Source(inf, np.tan(np.deg2rad(40)), wavelength), np.sin(angle), np.cos(angle)
    rays = pupil_rays(lens, source, xi, eta)
    aimed = np.isfinite(rays.x)
    assert 0 < aimed.sum() < 24
    at_stop = trace(lens, rays.origins, rays.directions, wavelength).points[lens.stop_surface, :, :2]
    wanted = lens.aperture.value * np.stack([xi, eta], -1)
    np.testing.assert_allclose(at_stop[aimed], wanted[aimed], atol=1e-9 * lens.aperture.value)
    with pytest.raises(GeometryError, match="chief ray could not be aimed at its place in the stop, surface"):
        pencil(lens, replace(source, field_slope=np.tan(np.deg2rad(60))), xi, eta)


def test_a_pencil_says_which_of_its_rays_could_not_be_aimed():
    lens, angle = with_aim(prescription_lens("asphere", 587.5618), "stop"), 2 * np.pi * np.arange(24) / 24
    total = 0
    for field_deg in (68, 71, 73, 75):  # at which of these the search fails for how many rays is a matter of rounding
        source = Source(inf, np.tan(np.deg2rad(field_deg)), 0.5875618)
        rays = pencil(lens, source, np.sin(angle), np.cos(angle))
        lost = rays.status == Status.UNAIMED
        assert lost.sum() < 24 and (rays.failed_surface[lost] == lens.stop_surface).all()
        assert np.isnan(rays.path[lost]).all() and np.isfinite(rays.path[rays.passed]).all()
        total += lost.sum()
    assert total > 0


def test_rays_found_directly_are_kept_when_others_are_lost():
    """Only the lost go by way of smaller fields, where others may go astray."""
    lens, wavelength = with_aim(prescription_lens("petzval", 587.5618), "stop"), 0.5875618
    source = Source(inf, np.tan(np.deg2rad(20)), wavelength)
    angle = 2 * np.pi * np.arange(24) / 24
    alone = [pupil_rays(lens, source, [np.sin(a)], [np.cos(a)]) for a in angle]
    together = pupil_rays(lens, source, np.sin(angle), np.cos(angle))
    np.testing.assert_allclose(together.y, [one.y[0] for one in alone], atol=1e-9)


def test_opd_is_even_across_the_field_and_the_map_uses_it():
    lens, source = double_gauss(), Source(inf, 0.2, 0.6562725)
    values = opd_map(lens, source, 24)
    xi, eta, inside = pupil_grid(24)
    assert np.nanmax(np.abs(values[inside] - displayed_opd(lens, source, xi[inside], eta[inside]))) < 1e-8


@pytest.mark.parametrize(
    ("name", "field"), [("double_gauss_28", 0.15), ("cooke_triplet", 0.15), ("eye_navarro", 0.15), ("relay", 0.003)]
)
def test_small_apertures_and_fields_tend_to_seidel_at_sixth_order(name, field):
    """With aperture and field scaled by s, W is of order s⁴ and what Seidel leaves out is of order s⁶."""
    row = huygens_rows(name)[0][0]
    lens, source = case(name, row)
    lens = with_sensor(lens, float(image_distance(lens, source.depth_mm, source.wavelength_um)))
    scales = np.array([0.5, 0.35, 0.25])
    left = [_beyond_seidel(lens, replace(source, field_slope=field), s) for s in scales]
    slope = np.polyfit(np.log(scales), np.log(left), 1)[0]
    assert 5.5 < slope < 6.6


def _beyond_seidel(lens, source, scale):
    lens = replace(lens, aperture=Aperture("stop_semi_diameter", lens.aperture.value * scale))
    source = replace(source, field_slope=source.field_slope * scale)
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    xi, eta = disc()
    square = xi * xi + eta * eta
    seidel = c.w40 * square**2 + c.w31 * square * eta + c.w22 * eta * eta + (c.w20 + c.wd) * square
    return np.sqrt(np.mean((displayed_opd(lens, source, xi, eta) - seidel) ** 2))


def test_scaling_lens_and_wavelength_leaves_the_opd_alone():
    lens, (xi, eta) = one_surface(rim=4.0), disc(30)
    large = Lens((Surface(200.0, 600.0, GLASS),), Aperture("stop_semi_diameter", 40.0), 1)
    small_opd = displayed_opd(lens, Source(100.0, 0.1, 0.5), xi, eta)
    assert np.allclose(small_opd, displayed_opd(large, Source(1000.0, 0.1, 5.0), xi, eta), atol=1e-9)


def test_ray_errors_are_the_slope_of_the_opd():
    """Transverse error = λ ∂W/∂ξ / NA near the axis of a slow lens: two roads to the same fan (Welford 1986, §7.4)."""
    lens = with_sensor(one_surface(rim=1.0), 61.0)
    source = Source(inf, 0.0, 0.55)
    rays, waves = ray_fan(lens, source, 201), opd_fan(lens, source, 201)
    # The sphere is centred 61 mm behind the pupil, the cone's tip 60 mm; a real image has u' < 0.
    slope = -float(numerical_aperture(lens, inf, 0.55)) * 60 / 61
    expected = np.gradient(waves.tangential, waves.pupil) * 0.55 / slope
    # Real sines differ from paraxial slopes by (1.5·NA)²: below 1 per mille at f/20.
    assert np.allclose(rays.tangential[2:-2], expected[2:-2], rtol=0, atol=1e-3 * np.max(np.abs(expected)))
    assert np.allclose(rays.tangential, rays.sagittal)


def test_the_steepest_slopes_of_a_phase_are_those_of_its_formula():
    """W = a(ξ + η)², rays at −∂W/∂f: ρ∂W/∂ρ = 2a(ξ + η)² is 4a on the rim, ∂W/∂θ = 2a(ξ² − η²) at most 2a."""
    rho, theta = np.meshgrid(np.linspace(0.1, 1, 10), np.arange(16) * np.pi / 8)
    xi, eta, a, spread = (rho * np.sin(theta)).ravel(), (rho * np.cos(theta)).ravel(), 3.0, 0.25
    landed = -2 * a * (xi + eta) / spread
    found = steepness(made_rays(a * (xi + eta) ** 2, spread * xi, spread * eta, landed, landed), xi, eta)
    assert (found.radial, found.angular, found.spread) == pytest.approx((4 * a, 2 * a, spread), rel=1e-9)
