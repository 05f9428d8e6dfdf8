"""Real rays where tracing usually breaks: grazing, missing, total reflection, several intersections, Δn = 0."""

import numpy as np
import pytest
from mpmath import mp, mpf
from mpmath import sqrt as root

from p2sf.errors import GeometryError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.source import Source
from p2sf.raytrace.pencil import Status, displayed_opd, opd_on_sphere, pencil, trace
from tests.support.reference import LENSES, prescription_lens, reference

mp.dps = 50
GLASS = ConstantIndex(1.5)


def one(radius, medium=GLASS, conic=0.0, aspheric=(), before=1.0, thickness=10.0) -> Lens:
    surface = Surface(radius, thickness, medium, conic, tuple(aspheric))
    return Lens((surface,), Aperture("stop_semi_diameter", 1.0), 1, object_medium=ConstantIndex(before))


def shoot(lens, heights, slope=0.0, from_z=-5.0):
    """Trace rays in the meridian plane from a plane before the lens."""
    heights = np.atleast_1d(np.asarray(heights, float))
    origins = np.stack([0 * heights, heights, 0 * heights + from_z], -1)
    return trace(lens, origins, np.array([0.0, slope, 1.0]), 0.5)


def conic_height(radius, conic, y, figure=()):
    """Return the sag of the sheet through the vertex in 50 digits, or None where there is none."""
    c, y = 1 / mpf(radius), mpf(y)
    inside = 1 - (1 + mpf(conic)) * c * c * y * y
    if inside < 0:
        return None
    return c * y * y / (1 + root(inside)) + sum(mpf(a) * y ** (4 + 2 * i) for i, a in enumerate(figure))


@pytest.mark.parametrize("conic", [-1e6, -100.0, -2.0, -1.0, -0.5, 0.0, 1.0, 10.0, 1e3])
@pytest.mark.parametrize("radius", [20.0, -20.0, 0.5, -1e6])
def test_a_ray_parallel_to_the_axis_meets_the_sheet_through_the_vertex(radius, conic):
    """Ellipsoids and hyperboloids are met twice; the right point is the one on the vertex's sheet."""
    heights = np.array([0.0, 1e-9, 0.01, 0.1, 0.4, 0.6, 5.0])
    found = shoot(one(radius, conic=conic), heights)
    for j, y in enumerate(heights):
        sag = conic_height(radius, conic, y)
        if sag is None:
            assert (found.status[j], found.failed_surface[j]) == (Status.MISSED, 1)
        else:
            # mm; the rounding of a height, magnified where the sheet is steep; air into glass reflects nothing
            flat = 1 - (1 + mpf(conic)) * (mpf(y) / mpf(radius)) ** 2
            steep = float(max(1, 1 / max(mpf("1e-12"), flat)))
            assert found.status[j] == Status.PASSED
            assert abs(found.points[1, j, 2] - float(sag)) <= 1e-14 * (1 + abs(float(sag))) * steep


def test_grazing_rays_pass_just_inside_and_miss_just_outside():
    edge = 10.0
    found = shoot(one(10.0), [edge * (1 - 1e-9), edge * (1 - 1e-15), edge, edge * (1 + 1e-15), edge * (1 + 1e-9)])
    assert found.status[0] == Status.PASSED and found.status[-1] == Status.MISSED
    assert set(found.status) <= {Status.PASSED, Status.MISSED}
    passed = found.status == Status.PASSED
    assert np.isfinite(found.points[1, passed]).all() and np.isfinite(found.cosines[passed]).all()
    np.testing.assert_allclose(np.linalg.norm(found.cosines[passed], axis=-1), 1, rtol=1e-14)


def test_a_ray_of_grazing_incidence_leaves_at_the_critical_angle():
    slope = 1e9
    found = shoot(one(np.inf), [0.0], slope, from_z=-1e-9)
    assert found.status[0] == Status.PASSED
    assert found.cosines[0, 1] == pytest.approx(1 / 1.5, rel=1e-12)


@pytest.mark.parametrize("excess", [1e-3, 1e-9, 1e-12])
def test_total_reflection_begins_at_the_critical_angle(excess):
    lens = one(np.inf, ConstantIndex(1.0), before=1.5)
    sine = 1 / 1.5
    for factor, status in ((1 - excess, Status.PASSED), (1 + excess, Status.REFLECTED)):
        y = sine * factor
        found = shoot(lens, [0.0], y / np.sqrt(1 - y * y))
        assert found.status[0] == status
        assert np.isnan(found.path[0]) == (status == Status.REFLECTED)


def test_refraction_without_a_step_changes_no_direction():
    """Δn = 0, on a plane, a sphere, a conic and an asphere, from air to air and from glass to glass."""
    for radius, conic, figure in ((np.inf, 0, ()), (15.0, 0, ()), (-15.0, -3.0, ()), (15.0, 0.4, (1e-5, -1e-8))):
        for n in (1.0, 1.7):
            found = shoot(one(radius, ConstantIndex(n), conic, figure, before=n), np.linspace(-6, 6, 13), 0.2)
            assert (found.status == Status.PASSED).all()
            straight = np.array([0, 0.2, 1]) / np.hypot(0.2, 1)
            np.testing.assert_allclose(found.cosines, np.broadcast_to(straight, (13, 3)), rtol=0, atol=2e-16 * 3)


@pytest.mark.parametrize("step", [1e-9, -1e-9, 1e-15])
def test_a_billionth_of_an_index_bends_by_a_billionth(step):
    """In first order of Δn a ray at height y is bent by −y·c·Δn/n (small angles)."""
    found = shoot(one(50.0, ConstantIndex(1.5 + step), before=1.5), [1e-3])
    exact = (1.5 + step) - 1.5
    assert found.cosines[0, 1] == pytest.approx(-1e-3 / 50 * exact / 1.5, rel=1e-6, abs=1e-21)


STRONG = [
    (20.0, 0.0, (1e-3,)),
    (20.0, -5.0, (-1e-3, 1e-5)),
    (-15.0, 1.0, (5e-4, -2e-5, 1e-7)),
    (np.inf, 0.0, (1e-2,)),
    (8.0, 0.0, (-2e-2,)),
    (5.0, 3.0, (0.1, -0.05)),
]


@pytest.mark.parametrize("surface", STRONG)
@pytest.mark.parametrize("slope", [0.0, 0.3, -0.8, 3.0])
def test_a_strong_asphere_is_met_or_refused_but_never_guessed(surface, slope):
    """A ray that passes lies on the surface and on its own line; any other has a reason; Newton never hangs."""
    radius, conic, figure = surface
    heights = np.linspace(-7, 7, 141)
    found = shoot(one(radius, conic=conic, aspheric=figure), heights, slope)
    passed = found.status == Status.PASSED
    assert set(found.status[~passed]) <= {Status.MISSED, Status.REFLECTED, Status.REFUSED}
    assert (found.failed_surface[~passed] == 1).all() and np.isnan(found.cosines[~passed]).all()
    for point, height in zip(found.points[1, passed], heights[passed], strict=True):
        sag = conic_height(radius, conic, abs(point[1]), figure) if np.isfinite(radius) else mpf(0)
        if not np.isfinite(radius):
            sag = sum(mpf(a) * mpf(point[1]) ** (4 + 2 * i) for i, a in enumerate(figure))
        assert sag is not None
        assert abs(float(sag) - point[2]) <= 1e-12 * (1 + abs(point[2]) + abs(float(sag)))
        assert point[1] == pytest.approx(height + slope * (point[2] + 5.0), rel=1e-12, abs=1e-11)


def test_of_several_intersections_the_first_ray_order_is_kept():
    """A wavy sheet can be met up to three times by one ray; neighbours never jump between the sheets unannounced."""
    found = shoot(one(5.0, conic=3.0, aspheric=(0.1, -0.05)), np.linspace(0, 1.2, 400))
    z = found.points[1, :, 2]
    steps = np.abs(np.diff(z[found.status == Status.PASSED]))
    assert steps.max() < 20 * np.median(steps) + 1e-3


def test_rays_parallel_to_a_surface_or_running_backwards_are_told():
    plane = one(np.inf)
    found = trace(plane, np.array([[0.0, 0.0, -5.0]]), np.array([[0.0, 1.0, 0.0]]), 0.5)
    assert found.status[0] != Status.PASSED or np.isfinite(found.cosines).all()
    assert not np.isnan(found.cosines[found.status == Status.PASSED]).any()


@pytest.mark.parametrize("radius", [np.inf, 20.0])
def test_what_is_no_ray_is_told_and_harms_no_other(radius):
    origins = np.array([[0, 0, -5.0], [np.nan, 0, -5.0], [0, 0, -5.0], [0, np.inf, -5.0]])
    directions = np.array([[0, 0, 1.0], [0, 0, 1.0], [0, 0, 0.0], [0, 0, 1.0]])
    found = trace(one(radius), origins, directions, 0.5)
    assert found.status.tolist() == [Status.PASSED, *[Status.MISSED] * 3]
    assert found.failed_surface.tolist() == [0, 1, 1, 1]
    assert np.isfinite(found.cosines[0]).all() and np.isnan(found.cosines[1:]).all() and np.isnan(found.path[1:]).all()


@pytest.mark.parametrize("name", LENSES)
def test_no_nan_without_a_reason_at_the_widest_fields(name):
    wavelength = prescription_lens_wavelength(name)
    lens = prescription_lens(name, wavelength)
    xi, eta = (x.ravel() for x in np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9)))
    for depth in (np.inf, 1e15, 100.0):
        for slope in (0.0, 0.5, 2.0, 50.0, 573.0):
            try:
                rays = pencil(lens, Source(depth, slope, wavelength / 1000), xi, eta)
            except GeometryError as error:
                assert "surface" in str(error) or "pupil" in str(error)
                continue
            for column in (rays.dx, rays.dy, rays.kx, rays.ky, rays.path):
                assert np.isnan(column).any(-1).sum() == 0 or (np.isnan(column) == ~rays.passed).all()
            assert ((rays.failed_surface > 0) == ~rays.passed).all()


def test_a_ray_that_misses_the_reference_sphere_has_no_opd_and_no_warning():
    """A sphere of 1 µm about the chief ray's point is met by no ray that lands tens of µm away."""
    lens = prescription_lens("double_gauss_28", 587.5618)
    rays = pencil(lens, Source(np.inf, 0.2, 0.5875618), np.array([0.0, 0.0, 0.5]), np.array([0.0, 1.0, 0.5]))
    with np.errstate(all="raise"):
        found = opd_on_sphere(rays, 1e-3)
    assert found[0] == pytest.approx(0, abs=1e-9) and np.isnan(found[1:]).all()


def prescription_lens_wavelength(name):
    return float(next(iter(reference(name)["indices"])))


def test_far_objects_converge_on_infinity_without_losing_a_digit():
    lens = prescription_lens("double_gauss_28", 587.5618)
    xi, eta = np.array([0.0, 0.5, 0.7]), np.array([1.0, -0.5, 0.7])
    infinite = displayed_opd(lens, Source(np.inf, 0.1, 0.5875618), xi, eta)
    far = displayed_opd(lens, Source(1e15, 0.1, 0.5875618), xi, eta)
    # 1e15 mm away the object's own sag over the pupil is 1e-13 mm
    np.testing.assert_allclose(far, infinite, rtol=0, atol=1e-8)
