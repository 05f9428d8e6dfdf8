"""Where rims end the pupil: rays beside them, corners, and polynomials against bisection on rays."""

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest

from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.rim import Rim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pupil import clear_curves
from p2sf.pupil.clear_curves import ClearRegion, clear_curve, curve_of, hole_curves, smooth_rooms, trace_rooms
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.surface import Status


@pytest.mark.parametrize(("name", "angle"), [("fast_gauss_f14", 22.0), ("wide_angle_35", 31.5)])
def test_the_clearance_of_rays_is_the_room_at_the_rim_that_stops_them(name, angle):
    """It is negative just where rims stop rays, and grows with their distance, by hand from where rays land."""
    eta = np.linspace(-1, 1, 201)
    lens = find_lens(name)
    rays = pencil(lens, Source(inf, field_deg=angle), 0 * eta, eta, clip=True)
    stopped = rays.status == Status.CLIPPED
    assert 10 < stopped.sum() < 150
    assert (rays.clearance[stopped] < 0).all() and (rays.clearance[rays.passed] >= 0).all()
    edges = np.flatnonzero(np.diff(stopped.astype(int)))
    for edge in edges:  # continuous: no step at the edge but that from one ray to the next
        steps = np.abs(np.diff(rays.clearance[edge - 2 : edge + 4]))
        assert steps.max() < 2 * np.median(steps) + 1e-3


FRAME = Surface(thickness=0.0, rim=Rim((0.4, -0.6), (4.5, 3.0), 25.0))
RECTANGLE = Lens(
    (Surface(thickness=20.0), FRAME, Surface(thickness=100.0, ideal_focal_length=100.0)),
    Aperture("stop_semi_diameter", 5.0),
    1,
)


@pytest.fixture(autouse=True)
def _forgetful():
    """Curves are kept for a lens and a source, whatever finds them."""
    curve_of.cache_clear()
    yield
    curve_of.cache_clear()


IDEAL = Surface(thickness=95.0, ideal_focal_length=100.0)


def lens_of(name: str) -> Lens:
    tilted = displaced(find_lens("tessar"), 3, 4, Placement(0.03, 0.07, 0.0, 0.5, 0.2))
    return {"rectangle": RECTANGLE, "tilted": tilted}.get(name) or find_lens(name)


@pytest.mark.parametrize(
    ("name", "angle", "count", "smooth"),
    [
        ("double_gauss_28", 14.0, 3, True),
        ("cooke_triplet", 20.0, 3, True),
        ("maksutov", 0.5, 1, True),
        ("rectangle", 2.0, None, True),
        ("tilted", 15.0, 2, True),
        ("petzval", 7.0, 3, False),
        ("fast_gauss_f14", 15.0, 3, False),
    ],
)
def test_curves_are_those_that_bisection_on_rays_finds(name, angle, count, smooth, monkeypatch):
    """Just inside them every ray passes, and just outside none does; corners are where labels of rays change."""
    lens, source = lens_of(name), Source(field_deg=angle)
    assert (smooth_rooms(ClearRegion(lens, source, True)) is not None) == smooth
    found = clear_curve(lens, source)
    theta = np.linspace(found.corners[0], found.corners[-1], 331)
    sides = []
    for part in (1 - 1e-8, 1 + 1e-8):
        radius = part * found.radius(theta)
        xi, eta = found.middle[0] + radius * np.sin(theta), found.middle[1] + radius * np.cos(theta)
        sides.append(pencil(lens, source, xi, eta, True).passed & (np.hypot(xi, eta) < 1))
    assert sides[0].all() and not sides[1].any()
    monkeypatch.setattr(clear_curves, "smooth_rooms", lambda _: None)
    monkeypatch.setattr(clear_curves, "_crossings", lambda *_: None)
    curve_of.cache_clear()
    searched = clear_curve(lens, source)
    assert len(found.corners) - 2 == count or (count is None and len(found.corners) > 4)
    # Radii of 2e-11, where rims cross at some hundredths of a radian.
    assert found.corners == pytest.approx(searched.corners, abs=2e-9)
    assert found.middle == pytest.approx(searched.middle, abs=1e-12)


def test_a_corner_at_a_rim_that_no_ray_reaches_is_searched_for():
    theta, label = np.array([0.1, 0.5]), np.array([1, 999])
    region = ClearRegion(find_lens("petzval"), Source(field_deg=7.0), True)
    assert clear_curves._crossings(region.rooms, (0.0, 0.01), theta, np.ones(2), label) is None


def test_polynomials_are_not_taken_where_rays_are_lost_or_they_depart():
    assert smooth_rooms(ClearRegion(find_lens("petzval"), Source(field_deg=11.0), True)) is None
    assert not trace_rooms(find_lens("petzval"), Source(field_deg=11.0), *np.array([[0.0, 0.0], [0.0, -1.0]])).whole


def test_a_hole_is_the_circle_that_collimated_light_sees():
    """A shadow 20 mm before the stop of 10 mm moves by distance times slope."""
    rows = (
        Surface(thickness=20.0, inner_radius=4.0),
        Surface(thickness=10.0),
        Surface(thickness=95.0, ideal_focal_length=1e2),
    )
    lens, slope = Lens(rows, Aperture("stop_semi_diameter", 10.0), 2, aim="paraxial"), np.tan(np.deg2rad(3.0))
    (hole,) = hole_curves(lens, Source(field_deg=3.0))
    xi, eta = hole.points(64)
    assert np.hypot(xi, eta - 2 * slope * np.sign(eta.mean())) == pytest.approx(0.4 + 0 * xi, abs=1e-9)
    assert clear_curve(lens, Source(field_deg=3.0)).nodes((8, 16)).share == pytest.approx(1, abs=1e-12)


def test_a_misaligned_lens_is_seen_from_any_azimuth():
    lens = lens_of("tilted")
    first, *others = lens.surfaces
    lens = replace(lens, surfaces=(replace(first, inner_radius=0.3 * first.semi_diameter), *others))
    for azimuth in (0.0, 250.0):
        source = Source(field_deg=15, azimuth_deg=azimuth)
        rim, (hole,) = clear_curve(lens, source), hole_curves(lens, source)
        assert rim.corners[-1] - rim.corners[0] == pytest.approx(2 * pi)
        assert (rim.depth(*hole.points(64)) > -1e-8).all()
