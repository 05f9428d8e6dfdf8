"""Mirrors: closed forms, laws of reflection, and another program's rays through a telescope of three."""

from math import inf, sqrt

import numpy as np
import pytest

from p2sf.glass.media import MIRROR
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import abcd, cardinal_points, image_distance
from p2sf.paraxial.pupils import numerical_aperture, pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace.pencil import displayed_opd, opd_map, pencil
from p2sf.raytrace.trace import trace
from tests.support.lenses.mirrors import TELESCOPE, aplanatic, classical, mangin, mirror, telescope, two_mirrors

UM = 0.5876


def test_a_mirror_has_half_its_radius_for_focal_length_and_its_image_in_front():
    found = cardinal_points(mirror(-200.0, -100.0), UM)
    assert found.effective_focal_length == pytest.approx(100.0) and found.back_focal_distance == pytest.approx(-100.0)
    assert image_distance(mirror(-200.0, -100.0), 300.0, UM) == pytest.approx(-150.0)  # 1/s + 1/s′ = 2/R
    assert np.linalg.det(abcd(two_mirrors(classical()), UM)) == pytest.approx(1.0, abs=1e-14)


def test_a_paraboloid_images_a_star_on_its_axis_without_aberration_and_an_ellipsoid_one_focus_into_the_other():
    assert np.nanmax(np.abs(opd_map(mirror(-200.0, -100.0, -1.0), Source()))) < 1e-9
    # Foci at 100 and 300 mm: R = 2·100·300/400, K = −((300 − 100)/(300 + 100))².
    ellipsoid = mirror(-150.0, -300.0, -0.25)
    assert np.nanmax(np.abs(opd_map(ellipsoid, Source(depth_mm=100.0)))) < 1e-8


def test_a_spherical_mirror_has_the_closed_form_of_spherical_aberration():
    """W40 = h⁴/(4R³), and the exact OPD tends to it at small apertures."""
    lens = mirror(-2000.0, -1000.0)
    c = coefficients(lens, inf, 0.0, UM)
    assert c.w40 == pytest.approx(50.0**4 / (4 * 2000.0**3) * 1e3 / UM, rel=1e-12)
    slow = mirror(-2000.0, -1000.0, rim=5.0)
    edge = displayed_opd(slow, Source(wavelength_nm=1e3 * UM), [0.0], [1.0])[0]
    assert edge == pytest.approx(float(coefficients(slow, inf, 0.0, UM).w40), rel=1e-4)


def test_two_mirrors():
    lens = two_mirrors(classical())
    assert cardinal_points(lens, UM).effective_focal_length == pytest.approx(1600.0)
    assert image_distance(lens, inf, UM) == pytest.approx(lens.sensor_mm)
    assert np.nanmax(np.abs(opd_map(lens, Source()))) < 1e-8
    c = coefficients(two_mirrors(aplanatic()), inf, 0.01, UM)
    assert abs(c.w40) < 1e-12 and abs(c.w31) < 1e-12
    assert abs(coefficients(lens, inf, 0.01, UM).w31) > 0.1, "a paraboloid and hyperboloid have coma"


def test_two_concentric_spheres_of_schwarzschild_are_free_of_three_aberrations():
    """Stop at the common centre and r₂/r₁ = (√5 + 1)/(√5 − 1): S_I, S_II and S_III are zero (Schwarzschild 1905)."""
    ratio = (sqrt(5) + 1) / (sqrt(5) - 1)
    first, second = 100.0, 100.0 * ratio
    surfaces = (Surface(thickness=-first), Surface(first, first - second, MIRROR), Surface(second, 0.0, MIRROR))
    lens = Lens(surfaces, Aperture("stop_semi_diameter", 5.0), 1)
    c = coefficients(with_sensor(lens, float(image_distance(lens, inf, UM))), inf, 0.05, UM)
    assert max(abs(c.w40), abs(c.w31), abs(c.w22)) < 1e-11


def test_rays_obey_the_law_of_reflection():
    """Angle in equals angle out about the normal, which is that of the conic by its equation; behind glass as well."""
    lens = mangin(-0.4)
    found = trace(lens, [[3.0, 15.0, -10.0]], [[0.02, -0.05, 1.0]], UM)
    _, front, on, out, sensor = found.points[:, 0]
    before, after = (v / np.linalg.norm(v) for v in (on - front, out - on))
    x, y, z = on - (0.0, 0.0, 6.0)
    normal = np.array([x, y, (1 - 0.4) * z + 220.0])  # ∇(x² + y² + (1 + K)z² − 2Rz)/2
    normal /= np.linalg.norm(normal)
    assert after == pytest.approx(before - 2 * (before @ normal) * normal, abs=1e-14)
    assert found.cosines[0] == pytest.approx((sensor - out) / np.linalg.norm(sensor - out), abs=1e-14)
    lengths = [np.linalg.norm(b - a) for a, b in zip(found.points[:-1, 0], found.points[1:, 0], strict=True)]
    index = float(lens.media[1].index(UM))
    assert found.path[0] == pytest.approx(np.dot(lengths, [1, index, index, 1]), rel=1e-15)


def test_real_rays_tend_to_the_seidel_wavefront_at_small_aperture_and_field():
    lens = two_mirrors((-0.9, -2.0))
    lens = Lens(lens.surfaces, Aperture("stop_semi_diameter", 8.0), 1, aim="paraxial")
    source = Source(field_deg=0.05, wavelength_nm=1e3 * UM)
    c = coefficients(lens, inf, source.field_slope, UM)
    line = np.linspace(-1, 1, 9)
    found = displayed_opd(lens, source, np.zeros(9), line)
    six = c.w40 * line**4 + c.w31 * line**3 + (c.w22 + c.w20 + c.wd) * line**2
    assert found - found[4] == pytest.approx(six, abs=1e-3 * np.abs(six).max() + 1e-9)


def test_another_programs_rays_through_a_telescope_of_three_mirrors_and_three_lenses():
    """Its listing ends at ten digits: 5e-8 mm of metres, and 5e-11 of a cosine."""
    lens, rim = telescope(), TELESCOPE["stop_semi_diameter"]
    for ray in TELESCOPE["rays"]:
        start = [ray["px"] * rim, ray["py"] * rim, 0.0]
        found = trace(lens, [start], [ray["direction_in"]], TELESCOPE["wavelength_um"])
        places = found.points[1:, 0] + (0.0, 0.0, TELESCOPE["surfaces"][0]["thickness"] * -1)
        names = [*(s["name"] for s in TELESCOPE["surfaces"]), "sensor"]
        for row in ray["rows"]:
            assert places[names.index(row["surface"])] == pytest.approx(row["point"], abs=5e-8), row["surface"]
        assert found.cosines[0] == pytest.approx(ray["rows"][-1]["direction"], abs=1e-10)


def test_first_order_and_chief_rays_of_the_telescope():
    lens = telescope()
    exit_pupil = pupils(lens, 0.5).exit_from_last - lens.sensor_mm
    assert abs(exit_pupil) == pytest.approx(abs(TELESCOPE["exit_pupil_from_sensor_mm"]), rel=1e-10)
    assert numerical_aperture(lens, inf, 0.5) == pytest.approx(0.4052, abs=1e-3)
    for field in TELESCOPE["fields"][:3]:
        source = Source(field_deg=field["theta_y_deg"], wavelength_nm=500.0)
        landing = pencil(lens, source, [0.0], [0.0]).chief_y.item()
        assert landing == pytest.approx(field["chief_ray_landing_exact_mm"][1], abs=1e-9)
