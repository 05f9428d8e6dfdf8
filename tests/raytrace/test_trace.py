"""Exact rays through surfaces: the laws that any ray obeys, and what becomes of one that fails."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.glass.media import AIR
from p2sf.lens.lens import Aperture, Lens, Surface, with_aim, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.messages import Message
from p2sf.paraxial.first_order import image_distance
from p2sf.raytrace.pencil import Status, pencil, pupil_rays, trace
from p2sf.raytrace.trace import out_of_order, status_message
from tests.support.rays.pencils import GLASS, disc, double_gauss, one_surface


def test_points_lie_on_their_surfaces_and_directions_obey_snell():
    lens, (xi, eta) = double_gauss(), disc()
    rays = pupil_rays(lens, Source(inf, 0.2, 0.6562725), xi, eta)
    result = trace(lens, rays.origins, rays.directions, 0.6562725)
    assert not result.status.any()
    vertex = np.cumsum([0.0, *(s.thickness for s in lens.surfaces)])
    steps = np.diff(result.points, axis=0)
    unit = steps / np.linalg.norm(steps, axis=-1, keepdims=True) * np.sign(steps[..., 2:])
    for j, surface in enumerate(lens.surfaces):
        point = result.points[j + 1] - [0, 0, vertex[j]]
        c = surface.curvature
        # The implicit equation in mm, to the rounding of 40 mm heights.
        assert np.max(np.abs(c * (point**2).sum(-1) - 2 * point[..., 2])) < 1e-13
        normal = np.array([0, 0, 1.0]) - c * point
        bend = rays.index[j] * np.cross(unit[j], normal) - rays.index[j + 1] * np.cross(unit[j + 1], normal)
        assert np.max(np.abs(bend)) < 1e-12
    assert np.allclose(np.linalg.norm(result.cosines, axis=-1), 1, atol=1e-14)


def test_optical_path_is_the_sum_of_lengths_times_indices():
    lens, (xi, eta) = double_gauss(), disc(50)
    rays = pupil_rays(lens, Source(500.0, 0.1, 0.6562725), xi, eta)
    result = trace(lens, rays.origins, rays.directions, 0.6562725)
    steps = np.diff(result.points, axis=0)
    lengths = np.linalg.norm(steps, axis=-1) * np.sign(steps[..., 2])
    assert np.allclose(result.path, np.array(rays.index) @ lengths, atol=1e-12)


def test_aplanatic_conic_focuses_every_ray():
    lens = one_surface(conic=-((1 / 1.5) ** 2))
    focus = with_sensor(lens, float(image_distance(lens, inf, 0.55)))
    rays = pencil(focus, Source(inf, 0.0, 0.55), *disc())
    # 60 mm of path hold 1e-14 mm: 2e-11 waves.
    assert np.max(np.abs(rays.phase)) < 1e-9
    assert np.max(np.hypot(rays.dx, rays.dy)) < 1e-13


def test_newton_on_an_asphere_without_figure_repeats_the_closed_form():
    source, points = Source(inf, 0.1, 0.55), disc()
    closed, newton = (pencil(one_surface(-0.7, a), source, *points) for a in ((), (1e-300,)))
    assert np.max(np.abs(closed.path - newton.path)) < 1e-13
    assert np.max(np.abs(closed.ky - newton.ky)) < 1e-14


def test_a_failing_ray_says_why_and_where_and_leaves_its_neighbours_alone():
    lens = one_surface(radius=10.0, rim=5.0)
    origins = np.array([[0.0, 12.0, -5.0], [0.0, 3.0, -5.0]])
    missed = trace(lens, origins, [0, 0, 1.0], 0.55)
    assert missed.status.tolist() == [Status.MISSED, Status.PASSED]
    assert missed.failed_surface.tolist() == [1, 0]
    assert np.isnan(missed.path).tolist() == [True, False]
    assert np.isnan(missed.points[1:, 0]).all() and not np.isnan(missed.points[:, 1]).any()


def test_total_reflection_is_found_on_the_surface_where_it_happens():
    back = Surface(-10.0, 10.0, AIR)
    lens = Lens((Surface(inf, 3.0, GLASS), back), Aperture("stop_semi_diameter", 2.0), 1)
    result = trace(lens, [[0, 8.0, 0], [0, 1.0, 0]], [0, 0, 1.0], 0.55)
    assert result.status.tolist() == [Status.REFLECTED, Status.PASSED]
    assert result.failed_surface.tolist() == [2, 0]
    assert np.isfinite(result.points[2, 0]).all() and np.isnan(result.points[3, 0]).all()


def test_rims_clip_only_when_asked():
    lens = replace(one_surface(), surfaces=(Surface(20.0, 5.0, GLASS, semi_diameter=2.0), Surface(-20.0, 30.0)))
    lens = replace(lens, stop_surface=2)
    assert trace(lens, [[0, 3.0, 0]], [0, 0, 1.0], 0.55).status[0] == Status.PASSED
    result = trace(lens, [[0, 3.0, 0]], [0, 0, 1.0], 0.55, clip=True)
    assert (result.status[0], result.failed_surface[0]) == (Status.CLIPPED, 1)


def test_an_asphere_that_newton_cannot_solve_is_refused():
    wild = one_surface(radius=inf, aspheric=(0.02,))
    result = trace(wild, [[0, y, -5.0] for y in np.linspace(0, 6, 25)], [0, 0.6, 1.0], 0.55)
    assert Status.REFUSED in result.status
    z = 0.02 * result.points[1, :, 1] ** 4
    good = result.status == Status.PASSED
    assert np.allclose(z[good], result.points[1, good, 2], atol=1e-12)


@pytest.mark.parametrize("status", [status for status in Status if status != Status.PASSED])
def test_every_failure_has_a_message_with_its_surface(status):
    message = status_message(find_lens("double_gauss_28"), status, 7)
    assert message.values == {"surface": 7} and str(message).count("surface 7") == 1


def test_a_chief_ray_that_misses_a_curved_sensor_is_said_to():
    """The sensor has no number among the surfaces: a ball of 5 mm about a point before it, and a chief ray beside."""
    lens = replace(find_lens("cooke_triplet"), sensor_radius=-5.0)
    with pytest.raises(GeometryError) as refused:
        pencil(lens, Source(field_deg=20), [0.0], [0.5])
    assert refused.value.message.values["outcome"] == Message("misses the sensor, which is curved or tilted")


def test_rays_that_meet_surfaces_out_of_order_are_told():
    """At 1.3 times its field the f/1.4 lens is traced beyond the edges of its glass; at its middle field nobody is."""
    for name, angle, told in (("fast_gauss_f14", 28.6, True), ("double_gauss_28", 14.0, False), ("relay", 0.1, False)):
        lens = with_aim(find_lens(name), "stop")
        source = Source(150.0 if name == "relay" else inf, np.tan(np.deg2rad(angle)), 0.5876)
        rays = pupil_rays(lens, source, [0, 0], [1, -1])
        z = trace(lens, rays.origins, rays.directions, 0.5876).points[1:-1, :, 2]
        assert bool(out_of_order(lens, z)) == told
        assert (np.diff(z, axis=0) < 0).any() == told
    behind = Lens((Surface(inf, 5.0), Surface(inf, -2.0), Surface(inf, 1.0)), Aperture("stop_semi_diameter", 1.0), 1)
    assert out_of_order(behind, np.array([[0.0], [5.0], [3.0]])) is None  # so it is written
    warning = out_of_order(behind, np.array([[0.0], [-1.0], [3.0]]))
    assert warning and warning.values["surface"] == 2
