"""The set-up in space as numbers: volumes, areas, and light that goes where the lens sends it."""

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.lens.lens import Surface, with_sensor
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.compute.glass_outlines import clear_rims, sag, still, vertices
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.scene3d.meshes import (
    RINGS,
    STEPS,
    area,
    element,
    elements,
    masked_stop,
    plate,
    revolve,
    ring,
    volume,
)
from p2sf_explorer.scene3d.scene import scene
from p2sf_explorer.state.state import change, new_state

LENSES = ("double_gauss_28", "cooke_triplet", "eye_navarro", "achromat_f6")
# A polygon of `STEPS` sides over three quarters of a turn has this share of the circle's area.
SIDES = np.sin(1.5 * np.pi / STEPS) / (1.5 * np.pi / STEPS)


def cap(radius: float, rim: float) -> tuple[float, float]:
    """Return volume and curved area of a spherical cap: πh²(3R − h)/3 and 2πRh."""
    height = radius - np.sqrt(radius**2 - rim**2)
    return np.pi * height**2 * (3 * radius - height) / 3, 2 * np.pi * radius * height


def sphere(radius: float) -> Surface:
    return Surface(radius, 0.0)


def test_three_quarters_of_a_ball_lens_have_their_volume_and_area():
    radius, rim, thick = 50.0, 15.0, 8.0
    made = element((sphere(radius), 0.0, rim), (sphere(-radius), thick, rim))
    cap_volume, cap_area = cap(radius, rim)
    cylinder = np.pi * rim**2 * (thick - 2 * (radius - np.sqrt(radius**2 - rim**2)))
    # Straight lines between rings leave a share of 1/(2·11²) of a cap, 0.4 %, and less of the whole.
    assert volume(made) == pytest.approx(0.75 * SIDES * (2 * cap_volume + cylinder), rel=2e-3)
    sheet = slice(0, 2 * STEPS * (RINGS - 1))
    assert area(made, sheet) == pytest.approx(0.75 * cap_area, rel=2e-3)


def test_a_ring_and_a_plate_have_their_volume():
    assert volume(ring(3.0, 5.0, 1.0, 0.5)) == pytest.approx(0.75 * SIDES * np.pi * 16 * 0.5)
    assert volume(plate(4.0, 0.5, Surface())) == pytest.approx(64 * 0.5)
    assert volume(plate(4.0, 0.5, sphere(-20.0))) == pytest.approx(64 * 0.5)  # its back is its front, moved


def test_a_masked_stop_has_the_volume_of_its_parts():
    """Three quarters of the polygon's opening are left, to what the sweep's steps of a degree make of its corners."""
    iris = masked_stop(PupilMask(blades=4), 3.0, 5.0, 1.0, 0.5)
    assert volume(iris) == pytest.approx(0.75 * (np.pi * 25 - 2 * 9) * 0.5, rel=2e-3)
    spider = masked_stop(PupilMask(obscuration=0.4, vanes=3, vane_width=0.05), 3.0, 5.0, 1.0, 0.5)
    bare = masked_stop(PupilMask(), 3.0, 5.0, 1.0, 0.5)
    disc, vanes = 0.75 * SIDES * np.pi * 1.2**2 * 0.5, 3 * 3.0 * 0.3 * 0.5
    assert volume(spider) == pytest.approx(volume(bare) + disc + vanes)


MASKS = PupilMask(blades=5, roundness=0.3), PupilMask(vanes=1, vane_width=0.02)
IRISES = tuple(masked_stop(mask, 3.0, 5.0, 1.0, 0.5) for mask in MASKS)
SOLIDS = ring(3.0, 5.0, 1.0, 0.5), plate(4.0, 0.5, Surface()), plate(4.0, 0.5, Surface(-20.0)), *IRISES


@pytest.mark.parametrize("mesh", SOLIDS, ids=["ring", "plate", "curved plate", "iris", "spider"])
def test_a_solid_is_closed_and_faces_outwards(mesh):
    """Every edge is shared by two triangles that run along it in opposite directions."""
    _, same = np.unique(mesh.points.round(9), axis=0, return_inverse=True)
    faces = same[mesh.faces]
    ways = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    there, back = ({tuple(way) for way in set_} for set_ in (ways, ways[:, ::-1]))
    assert there == back and len(there) == len(ways)


@pytest.mark.parametrize("name", LENSES)
def test_glass_is_where_the_lens_has_it(name):
    lens = still(live(default_state(name), "preview").setup.lens)
    for piece in elements(lens):
        assert volume(piece.mesh) > 0
        x, y, z = piece.mesh.points.T
        assert not np.any((x < -1e-9) & (y > 1e-9)), "the quarter x < 0 < y is cut away"
        vertex = z[np.hypot(x, y) < 1e-9]
        assert np.abs(vertex[:, None] - vertices(lens)).min(axis=1).max() < 1e-9
        assert np.hypot(x, y).max() <= max(clear_rims(lens)) + 1e-9


@pytest.mark.parametrize("name", LENSES)
def test_rays_meet_every_surface_and_end_at_the_image(name):
    answer = live(change(default_state(name), method="seidel"), "preview")
    shown, lens = scene(answer).found, answer.setup.lens
    for number, (surface, vertex) in enumerate(zip(lens.surfaces, vertices(lens), strict=False), 1):
        x, y, z = shown.rays[:, number].T
        assert z == pytest.approx(vertex + sag(surface, np.hypot(x, y)), abs=1e-9)
    ends = shown.rays[:, -1]
    assert ends[:, 2] == pytest.approx(answer.layout.drawing.sensor_z)
    chief = next(ray for ray in answer.layout.rays if ray.kind == "chief")
    assert shown.rays[0, -1, 1] == pytest.approx(chief.y[-1], abs=1e-9)  # the same ray by another tracer
    blur = 1e-3 * answer.psf.values.shape[0] * answer.psf.pixel_um  # all light lands in the window that shows it
    assert np.abs(ends[:, :2] - ends[0, :2]).max() < blur


@pytest.mark.parametrize("shift_um", [-300.0, 300.0])
def test_the_wavefront_is_a_sphere_about_the_image_that_defocus_bends(shift_um):
    """A sensor moved away by Δz: W = NA²Δz/2λ > 0 at the rim, so the rim runs ahead and the front is more curved."""
    state = new_state(method="seidel", field_deg=0.0, f_number=16.0, sensor_shift_um=shift_um)
    shown = scene(live(state, "preview")).found
    away = np.linalg.norm(shown.front.mesh.points - shown.rays[0, -1], axis=1)
    wave_mm = 1e-3 * 0.5875618
    assert away[0] - away == pytest.approx(shown.front.factor * wave_mm * shown.front.waves, abs=1e-9)
    expected = (0.5 / 16) ** 2 * shift_um / (2 * 0.5875618)
    assert shown.front.waves[-1] == pytest.approx(expected, rel=0.03)  # f/16: W40 is a hundredth of that


def test_the_relief_stands_on_the_image_point_and_peaks_where_the_psf_does():
    answer = live(new_state(method="seidel", field_deg=0.0, f_number=11.0, psf_scale="linear"), "preview")
    shown = scene(answer).found
    highest = shown.psf_surface.mesh.points[shown.psf_surface.values.argmax()]
    assert highest[:2] == pytest.approx(shown.rays[0, -1, :2], abs=1e-9)
    assert highest[2] < answer.layout.drawing.sensor_z
    width = answer.psf.values.shape[0] * answer.psf.pixel_um * 1e-3 * shown.psf_surface.factor
    assert np.ptp(shown.psf_surface.mesh.points[:, 0]) == pytest.approx(width * 63 / 64)


def test_a_strip_that_crosses_itself_ends_where_it_does():
    made = element((sphere(20.0), 0.0, 15.0), (sphere(-20.0), 1.0, 15.0))
    assert volume(made) > 0


def test_revolving_about_a_hole_needs_no_axis():
    made = revolve(np.array([1.0, 2.0]), np.zeros(2), np.ones(2), sweep=(0.0, np.pi), steps=180)
    assert volume(made) == pytest.approx(np.pi * 3 / 2, rel=1e-4)


@pytest.mark.parametrize("sensor_mm", [0.0, -8.0, 1e-6])
def test_a_sensor_that_touches_the_glass_or_stands_in_it_has_a_wavefront_too(sensor_mm):
    """Found by random hands: the wavefront was drawn between last glass and sensor, where there was no room."""
    lens = with_sensor(find_lens("double_gauss_28"), sensor_mm)
    found = scene(live(change(default_state("double_gauss_28"), lens_text=lens_to_toml(lens)))).found
    assert found.front.factor > 0 and np.isfinite(found.front.mesh.points).all()
    assert np.ptp(found.front.mesh.points, axis=0).max() > 0.01


def test_a_lens_tilted_by_next_to_nothing_stands_where_the_straight_one_does():
    """The parts of a misaligned lens are placed by its frames, those of a straight one along its axis."""
    straight, tilted = (
        scene(live(new_state(errors=errors), "preview")).found for errors in ((), (("tilt_x", 12, 12, 1e-7),))
    )
    for name in ("stop", "sensor"):
        assert getattr(tilted, name).points == pytest.approx(getattr(straight, name).points, abs=1e-6)
    assert tilted.front.mesh.points == pytest.approx(straight.front.mesh.points, abs=1e-5)
    for one, other in zip(tilted.glass, straight.glass, strict=True):
        assert one.mesh.points == pytest.approx(other.mesh.points, abs=1e-9)


def test_the_psf_stands_where_the_chief_ray_meets_a_tilted_sensor():
    errors = ("decentre_y", 3, 5, 0.1), ("tilt_x", 12, 12, 5.0)
    found = scene(live(new_state(errors=errors, field_deg=5.0, field_x_deg=4.0), "preview")).found
    middle = found.psf_surface.mesh.points.reshape(64, 64, 3)[32, 32]
    ended, normal = found.rays[0, -1], np.array([0.0, -np.sin(np.deg2rad(5.0)), np.cos(np.deg2rad(5.0))])
    away = middle - ended
    assert np.cross(away, normal) == pytest.approx(np.zeros(3), abs=1e-6)  # it rises at right angles to the sensor
