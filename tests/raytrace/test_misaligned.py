"""Tilts and decentres: breaks of the coordinates, rays in space, and the chief ray of a misaligned lens."""

from dataclasses import replace
from math import inf, tan

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.glass.media import MIRROR
from p2sf.lens.lens import Surface, seen_from
from p2sf.lens.misalignment import displaced, folding, with_tilted_sensor
from p2sf.lens.placement import Motion, Placement, placement_of
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.pencil import hexapolar, pencil
from p2sf.raytrace.trace import trace
from tests.long.misalignment import POINT_MM, compare
from tests.support.lenses.misaligned import random_placement

RINGS = hexapolar(4)
TILTED = Placement(0.1, 0.2, 0.05, 0.3, -0.2, 10.0, False, (0.0, 0.0, 4.0))


@pytest.fixture(scope="module")
def gauss():
    return find_lens("double_gauss_28")


def test_rays_equal_those_of_a_tracer_in_space():
    """200 systems are tried by ``python -m tests.long.misalignment``."""
    worst = compare(range(12))
    assert worst.rays > 50 and worst.folded > 5
    assert worst.point <= POINT_MM and worst.path <= 1


def test_a_break_and_its_inverse_do_nothing():
    rng = np.random.default_rng(1)
    for _ in range(20):
        one = random_placement(rng, 5.0, 60.0)
        for there_and_back in (one.motion.then(one.inverse.motion), one.inverse.motion.then(one.motion)):
            assert np.abs(there_and_back.rotation - np.eye(3)).max() < 1e-14
            assert np.abs(there_and_back.origin).max() < 1e-13


def test_any_motion_is_a_break():
    rng = np.random.default_rng(2)
    for _ in range(20):
        motion = random_placement(rng, 5.0, 80.0).motion
        again = placement_of(motion).motion
        assert np.abs(again.rotation - motion.rotation).max() < 1e-14
        assert np.abs(again.origin - motion.origin).max() < 1e-13


def test_angles_are_right_handed_and_the_order_is_that_of_opticstudio():
    """Its coordinate break: x′ = x cos γ + y sin γ … about the axes in the right-hand sense, x, then y, then z."""
    about_x = Placement(tilt_x_deg=30.0).motion.rotation
    assert about_x[:, 2] == pytest.approx([0.0, -0.5, np.sqrt(3) / 2])  # z turns towards −y, as y turns towards z
    both = Placement(tilt_x_deg=30.0, tilt_y_deg=20.0).motion.rotation
    about_y = Placement(tilt_y_deg=20.0).motion.rotation
    assert both == pytest.approx(about_x @ about_y)
    moved = Placement(decentre_y=2.0, tilt_x_deg=30.0)
    assert moved.motion.origin == pytest.approx([0.0, 2.0, 0.0])
    assert replace(moved, tilt_first=True).motion.origin == pytest.approx([0.0, np.sqrt(3), 1.0])


def test_a_tilt_about_a_pivot_leaves_the_pivot_where_it_is():
    motion = Placement(tilt_x_deg=3.0, tilt_y_deg=-2.0, pivot=(1.0, 2.0, 30.0)).motion
    seen = motion.rotation.T @ (np.array([1.0, 2.0, 30.0]) - motion.origin)
    assert seen == pytest.approx([1.0, 2.0, 30.0])


def test_a_sphere_turned_about_its_centre_stays_the_same(gauss):
    radius = gauss.surfaces[0].radius
    turned = displaced(gauss, 1, 1, Placement(tilt_x_deg=2.0, tilt_y_deg=1.0, pivot=(0.0, 0.0, radius)))
    source = Source(field_deg=8)
    one, two = (pencil(lens, source, *RINGS) for lens in (gauss, turned))
    assert two.dx == pytest.approx(one.dx, abs=1e-12) and two.dy == pytest.approx(one.dy, abs=1e-12)
    assert two.path == pytest.approx(one.path, abs=1e-12)


def test_a_decentre_of_all_surfaces_and_the_sensor_moves_nothing_but_the_axis(gauss):
    """Light from infinity does not know where the axis is."""
    everything = displaced(gauss, 1, len(gauss.surfaces), Placement(0.3, -0.2))
    everything = with_tilted_sensor(everything, Placement(0.3, -0.2))
    source = Source(field_deg=10)
    one, two = (pencil(lens, source, *RINGS) for lens in (gauss, everything))
    assert two.dx == pytest.approx(one.dx, abs=1e-11) and two.dy == pytest.approx(one.dy, abs=1e-11)
    assert two.chief_y == pytest.approx(one.chief_y, abs=1e-11) and two.chief_x == pytest.approx(0.0, abs=1e-11)
    assert two.phase == pytest.approx(one.phase, abs=1e-7)


def test_the_whole_camera_turned_sees_what_another_field_shows(gauss):
    """A tilt of everything about x by +5° turns the axis down: light along z then is that of a field of 5°."""
    turned = displaced(gauss, 1, len(gauss.surfaces), Placement(tilt_x_deg=5.0))
    length = sum(surface.thickness for surface in gauss.surfaces)
    turned = with_tilted_sensor(turned, Placement(tilt_x_deg=5.0, pivot=(0.0, 0.0, -length)))
    one, two = pencil(gauss, Source(field_deg=5), *RINGS), pencil(turned, Source(), *RINGS)
    assert two.chief_y == pytest.approx(one.chief_y, rel=1e-12)
    assert two.dx == pytest.approx(one.dx, abs=1e-11) and two.dy == pytest.approx(one.dy, abs=1e-11)


def test_a_tilted_sensor_cuts_the_same_rays_elsewhere(gauss):
    """Scheimpflug: the chief ray of height h meets a sensor tilted by τ about x at y/(cos τ − slope·sin τ)."""
    tilt = np.deg2rad(4.0)
    tilted = with_tilted_sensor(gauss, Placement(tilt_x_deg=4.0))
    source = Source(field_deg=10)
    straight, cut = (pencil(lens, source, *RINGS) for lens in (gauss, tilted))
    slope = straight.chief_ky / straight.chief_kz
    assert cut.chief_y == pytest.approx(straight.chief_y / (np.cos(tilt) - slope * np.sin(tilt)), rel=1e-12)


def test_a_fold_leaves_rays_as_they_are_behind_an_upright_mirror(gauss):
    """In the axes that follow the reflected axis everything is as if the mirror stood upright."""
    before = 0.4 * gauss.sensor_mm
    last = replace(gauss.surfaces[-1], thickness=before)
    source = Source(field_deg=7)
    found = []
    for tilt in (None, Placement(tilt_x_deg=45.0), Placement(tilt_x_deg=-20.0, tilt_y_deg=30.0, tilt_z_deg=15.0)):
        mirror = Surface(inf, before - gauss.sensor_mm, MIRROR, **(folding(tilt) if tilt else {}))
        found.append(pencil(replace(gauss, surfaces=(*gauss.surfaces[:-1], last, mirror)), source, *RINGS))
    for folded in found[1:]:
        assert folded.dx == pytest.approx(found[0].dx, abs=1e-12) and folded.dy == pytest.approx(found[0].dy, abs=1e-12)
        assert folded.chief_y == pytest.approx(found[0].chief_y, abs=1e-12)
        assert folded.path == pytest.approx(found[0].path, abs=1e-12)


def test_the_chief_ray_goes_through_the_centre_of_the_stop_and_the_rim_is_filled(gauss):
    tilted = displaced(gauss, 1, 4, TILTED)
    number, rim = gauss.stop_surface, pencil(gauss, Source(), [0.0], [1.0])
    assert rim.passed.all()
    xi, eta = np.array([0.0, 0.6, -1.0, 0.0]), np.array([0.0, 0.8, 0.0, -1.0])
    aligned, found = (pupil_rays(lens, Source(field_deg=12), xi, eta) for lens in (gauss, tilted))
    met = trace(tilted, found.origins, found.directions, Source().wavelength_um).points[number]
    frame = tilted.frames[number - 1]
    local = (met - frame.origin) @ frame.rotation
    there = trace(gauss, aligned.origins, aligned.directions, Source().wavelength_um).points[number]
    assert local[:, :2] == pytest.approx(there[:, :2], abs=1e-9)


def test_a_source_in_another_azimuth_sees_the_lens_turned(gauss):
    """The lens turned with the source about the axis gives the same rays."""
    bad = displaced(gauss, 3, 5, TILTED)
    source = Source(field_deg=(3, 4))
    turned = seen_from(bad, source.azimuth_deg)
    one = pencil(bad, source, *RINGS)
    two = pencil(turned, Source(field_slope=source.field_slope), *RINGS)
    assert one.dx == pytest.approx(two.dx, abs=1e-13)
    # Traced in the axes of the lens: the chief ray of angles (3, 4)° lands at (x, y), seen turned.
    x, y = tan(np.deg2rad(3)), tan(np.deg2rad(4))
    rays = pupil_rays(turned, Source(field_slope=source.field_slope), np.zeros(1), np.zeros(1))
    azimuth = np.deg2rad(source.azimuth_deg)
    back = np.array([[np.cos(azimuth), np.sin(azimuth), 0], [-np.sin(azimuth), np.cos(azimuth), 0], [0, 0, 1]])
    along = rays.directions[0] @ back.T
    assert along[:2] / along[2] == pytest.approx([x, y], abs=1e-12)
    there = trace(bad, rays.origins @ back.T, rays.directions @ back.T, source.wavelength_um).points[-1, 0]
    seen = there @ back
    assert seen[:2] == pytest.approx([one.chief_x.item(), one.chief_y.item()], abs=1e-10)


def test_axial_coma_is_linear_in_a_decentre(gauss):
    """The phase odd in the pupil doubles with the decentre, but for terms of third order."""
    xi, eta = RINGS
    odd = []
    for amount in (0.01, 0.02, -0.01):
        rays = pencil(displaced(gauss, 3, 5, Placement(decentre_y=amount)), Source(), np.r_[xi, xi], np.r_[eta, -eta])
        phase = rays.phase
        odd.append(phase[: xi.size] - phase[xi.size :])
    assert np.abs(odd[0]).max() > 0.01
    assert odd[1] == pytest.approx(2 * odd[0], abs=1e-4 * np.abs(odd[0]).max())
    assert odd[2] == pytest.approx(-odd[0], abs=1e-6 * np.abs(odd[0]).max())


@pytest.mark.parametrize(
    ("placement", "said"),
    [
        (Placement(tilt_x_deg=90.0), "surface 3: a tilt of 90° about x"),
        (Placement(tilt_y_deg=-135.0), "surface 3: a tilt of -135° about y"),
        (Placement(decentre_x=inf), "surface 3: a tilt or decentre is not finite"),
    ],
)
def test_a_tilt_that_cannot_be_is_refused(gauss, placement, said):
    with pytest.raises(GeometryError, match=said):
        displaced(gauss, 3, 4, placement)


def test_a_decentre_beyond_the_rim_and_a_chief_ray_that_misses_are_named(gauss):
    with pytest.raises(GeometryError, match=r"rim of .* mm; surface 3 is decentred by \(0, 25, 0\) mm"):
        pencil(displaced(gauss, 3, 3, Placement(decentre_y=25.0)), Source(), [0.0], [0.0])
    rimless = replace(gauss, surfaces=tuple(replace(s, semi_diameter=inf) for s in gauss.surfaces))
    with pytest.raises(GeometryError, match=r"the chief ray .* surface .*; surface 3 is decentred by \(0, 300, 0\) mm"):
        pencil(displaced(rimless, 3, 3, Placement(decentre_y=300.0)), Source(), [0.0], [0.0])


def test_an_aligned_lens_has_no_frames_to_go_through(gauss):
    idle = replace(gauss, surfaces=tuple(replace(s, before=(Placement(),)) for s in gauss.surfaces))
    assert not gauss.misaligned and not idle.misaligned
    assert displaced(gauss, 2, 3, TILTED).misaligned
    with pytest.raises(GeometryError, match="surfaces 3 to 99 do not exist"):
        displaced(gauss, 3, 99, TILTED)


def test_motions_chain():
    one, two = Placement(1.0, 2.0, 3.0, 10.0, 20.0, 30.0).motion, Placement(tilt_x_deg=5.0).motion
    point = np.array([1.0, -2.0, 0.5])
    both = one.then(two)
    inner = two.origin + two.rotation @ point
    assert both.origin + both.rotation @ point == pytest.approx(one.origin + one.rotation @ inner)
    assert isinstance(both, Motion)
