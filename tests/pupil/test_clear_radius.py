"""Where rays end along directions: against roots by formula, with kinks, steps and stretches of unknown room."""

from math import inf

import numpy as np
import pytest

from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.rim import Rim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pupil import vignetting
from p2sf.pupil.clear_radius import BISECTIONS, clear_radius
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.surface import Status

CLOSE = 2.0**-BISECTIONS  # of the outer radius: what the function promises
ROOTS = np.array([0.03, 0.2, 1 / 3, 0.5, 0.77, 1 - 1e-9])


def smooth(radius, root):
    return 1 - (radius / root) ** 2


def kinked(radius, root):
    """Another rim takes over 0.002 beyond the edge."""
    return np.minimum(root - radius, 2 * (root - radius) + 0.002)


def kinked_at_the_edge(radius, root):
    return np.minimum(root - radius, 6 * (root - radius))


def unknown_outside(radius, root):
    return np.where(radius > root, np.nan, smooth(radius, root))


def unknown(radius, root):
    return np.full(radius.shape, np.nan)


@pytest.mark.parametrize(
    ("room_of", "most"),
    [
        (smooth, 14),
        (kinked, 20),
        (kinked_at_the_edge, 2 * BISECTIONS),
        (unknown_outside, BISECTIONS + 2),
        (unknown, BISECTIONS + 2),
    ],
)
def test_it_ends_where_the_formula_says(room_of, most):
    """``most``: calls; a root by interpolation takes few, one without any room a bisection."""
    calls = []

    def clearance(radius, some):
        calls.append(some.size)
        passed = radius <= ROOTS[some]
        return passed, room_of(radius, ROOTS[some]), np.where(passed, 0, some + 5)

    radius, ended = clear_radius(clearance, np.ones(ROOTS.size))
    assert (radius <= ROOTS).all() and (ROOTS - radius <= CLOSE).all()
    assert ended.tolist() == [5, 6, 7, 8, 9, 10] and len(calls) <= most


@pytest.mark.parametrize(("off", "most"), [(1e-5, 6), (-1e-5, 6), (0.1, 14), (-0.1, 14)])
def test_a_good_guess_saves_calls_and_a_bad_one_costs_none(off, most):
    calls = []

    def clearance(radius, some):
        calls.append(some.size)
        passed = radius <= ROOTS[some]
        return passed, smooth(radius, ROOTS[some]), np.where(passed, 0, np.where(radius < 1, 3, 4))

    radius, ended = clear_radius(clearance, np.ones(ROOTS.size), ROOTS + off)
    assert (radius <= ROOTS).all() and (ROOTS - radius <= CLOSE).all() and len(calls) <= most
    assert (ended[:-1] == 3).all()  # what ends rays next to the edge, not those at the outer radius


def test_directions_that_nothing_ends_keep_the_outer_radius():
    outer = np.array([0.4, 0.9, 1.3])

    def clearance(radius, some):
        return radius <= 0.8, 0.8 - radius, np.full(radius.shape, 7)

    radius, ended = clear_radius(clearance, outer)
    assert radius == pytest.approx([0.4, 0.8, 0.8], abs=2 * CLOSE) and radius[0] == 0.4
    assert ended.tolist() == [0, 7, 7]


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


@pytest.mark.parametrize(
    ("lens", "angle", "count"),
    [("petzval", 7.0, 3), ("fast_gauss_f14", 15.0, 3), ("double_gauss_28", 14.0, 3), (RECTANGLE, 2.0, None)],
)
def test_corners_by_newtons_method_are_those_that_a_search_finds(lens, angle, count, monkeypatch):
    """The search tells from the labels of rays on either side alone where one rim takes over from another."""
    lens = find_lens(lens) if isinstance(lens, str) else lens
    source, centre = Source(field_deg=angle), (0.0, 0.01)
    theta = (np.arange(vignetting.SCAN) + 0.5) * (np.pi / vignetting.SCAN)
    edge = vignetting._edge(lens, source, True, centre, theta)
    assert vignetting._crossings(lens, source, centre, theta, *edge) is not None
    corners, (angles, radii) = vignetting._corners(lens, source, True, centre)
    assert radii == pytest.approx(vignetting._edge(lens, source, True, centre, angles)[0], abs=2e-9)
    assert len(corners) == count or (count is None and len(corners) >= 4)
    monkeypatch.setattr(vignetting, "_crossings", lambda *_: None)
    searched, _ = vignetting._corners(lens, source, True, centre)
    # Radii of 2e-11, where rims cross at some hundredths of a radian.
    assert corners == pytest.approx(searched, abs=2e-9)


def test_where_rays_are_lost_the_corners_are_searched_for():
    """A rim that no ray reaches has no room to speak of."""
    lens, source = find_lens("petzval"), Source(field_deg=7.0)
    theta = np.array([0.1, 0.5])
    radius, rim = vignetting._edge(lens, source, True, (0.0, 0.01), theta)
    assert rim[0] != rim[1]
    missing = np.array([rim[0], 999])
    assert vignetting._crossings(lens, source, (0.0, 0.01), theta, radius, missing) is None
