"""Pictures through misaligned lenses: the PSF at a place, mirror images, and the road of symmetric lenses."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.image import Forming, form_image
from p2sf.image.geometry import illumination
from p2sf.image.misaligned import channel_kernels, form_misaligned
from p2sf.lens.lens import with_f_number
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml import lens_to_toml
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.scene.field_points import field_map, landing_mm
from p2sf.scene.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

WAVE = 0.54
SENSOR = Sensor(25, 37, 20.0, (0.0, 9.0))  # around a field of 5°, where misalignment turns the PSF
SCENE = Scene(SENSOR, (Channel("green", (540.0,), (1.0,)),), tolerance=0.05)
WIDE = Sensor(64, 96, 150.0)  # distorted by more than pictures of symmetric lenses leave out


@pytest.fixture(scope="module")
def gauss():
    return with_f_number(find_lens("double_gauss_28"), 8.0)


@pytest.fixture(scope="module")
def bad(gauss):
    return displaced(gauss, 3, 5, Placement(0.15, 0.1, 0.02, 0.2, 0.2))


@pytest.fixture(scope="module")
def seen(bad):
    return field_map(bad, inf, WAVE, SENSOR)


def test_a_chief_ray_lands_where_the_map_has_it(seen):
    for row, column in ((0.0, 0.0), (3.7, 30.2), (24.0, 36.0)):
        place = float(SENSOR.x_mm(column)), float(SENSOR.y_mm(row))
        assert landing_mm(seen.lens, seen.source(*place, WAVE)) == pytest.approx(place, abs=0.01 * SENSOR.pixel_mm)


def test_the_picture_of_a_point_is_the_psf_there(gauss, bad, seen):
    """At a node of the lattice; the reference is turned by the azimuth of its field, a degree at most."""
    point = np.zeros((25, 37, 1), np.float32)
    row, column = 12, 18
    point[row, column] = 1.0
    made = form_misaligned(bad, SCENE, point, Forming(geometry=False, surround="black"))
    found, lattice = made.values[..., 0], made.lattice
    assert made.error <= made.allowed
    corner = channel_kernels(seen, SCENE, float(lattice.row_nodes[0]), float(lattice.column_nodes[-1]))
    assert lattice.kernels[0][-1] == pytest.approx(corner, abs=1e-7)
    source = seen.source(float(SENSOR.x_mm(column)), float(SENSOR.y_mm(row)), WAVE)
    assert abs(source.azimuth_deg) < 1.0
    psf = render_integrated(bad, source, "huygens", 9, SENSOR.pixel_um)
    expected = psf.values[::-1] * psf.energy
    near = found[row - 4 : row + 5, column - 4 : column + 5]
    assert np.linalg.norm(near - expected) < 0.01 * np.linalg.norm(expected)
    assert found.sum() == pytest.approx(1.0, abs=1e-3)
    # Of the aligned lens it is another.
    straight = render_integrated(gauss, source, "huygens", 9, SENSOR.pixel_um)
    assert np.linalg.norm(near - straight.values[::-1]) > 0.02 * np.linalg.norm(expected)


def test_kernels_of_a_mirrored_lens_are_mirrored(gauss, bad, seen):
    mirrored = displaced(gauss, 3, 5, Placement(-0.15, 0.1, 0.02, 0.2, -0.2))
    other = field_map(mirrored, inf, WAVE, SENSOR)
    one, two = (channel_kernels(m, SCENE, 5.0, column) for m, column in ((seen, 8.0), (other, 28.0)))
    assert np.linalg.norm(one - two[..., ::-1]) < 1e-3 * np.linalg.norm(one)
    assert np.linalg.norm(one - one[..., ::-1]) > 0.02 * np.linalg.norm(one)


@pytest.mark.slow
def test_without_misalignment_it_is_the_picture_of_the_symmetric_lens(gauss):
    """A sphere turned about its own centre takes the other road; a plan's kernels are fits, good to its prediction."""
    lens = with_f_number(gauss, 11.0)
    turned = displaced(lens, 1, 1, Placement(tilt_x_deg=2.0, pivot=(0.0, 0.0, lens.surfaces[0].radius)))
    scene = replace(SCENE, sensor=WIDE, tolerance=0.1)
    values = np.random.default_rng(0).random((64, 96, 1)).astype(np.float32)
    planned = plan(lens, scene)
    found, expected = form_misaligned(turned, scene, values), form_image(planned, values)
    assert np.linalg.norm(found.values - expected) < 0.01 * np.linalg.norm(expected)
    own = illumination(field_map(turned, inf, WAVE, WIDE), WIDE)
    assert own == pytest.approx(illumination(planned.sensor_map(0.0), WIDE), abs=1e-4)
    assert own.min() < 0.99


def test_several_depths_are_refused(bad):
    with pytest.raises(RequestError, match="give near_mm and far_mm the same value"):
        form_misaligned(bad, replace(SCENE, near_mm=1000.0), np.zeros((25, 37, 1)))


@pytest.mark.slow
def test_the_command_line_plans_and_forms_it(bad, tmp_path, answer, refused):
    lens, scene, out = tmp_path / "bad.toml", tmp_path / "scene.toml", tmp_path / "out.png"
    lens.write_text(lens_to_toml(bad), encoding="utf-8")
    scene.write_text(
        "tolerance = 0.5\nf_number = 11\nclip = true\n[sensor]\nrows = 8\ncolumns = 8\npixel_um = 20\n[[channel]]\n"
        "name = 'green'\nwavelengths_nm = [540]\nweights = [1]\n",
        encoding="utf-8",
    )
    found = answer("image", lens, scene, "chart:text", "-o", out)
    assert found["measured_error"] <= 0.5 and out.exists()
    assert "--preview of a scene whose rims clip needs a lens of rotational symmetry" in refused(
        "image", lens, scene, "chart:text", "-o", out, "--preview"
    )
    assert "clip needs a lens of rotational symmetry" in refused("plan", lens, scene)
    scene.write_text(scene.read_text(encoding="utf-8").replace("clip = true\n", ""), encoding="utf-8")
    assert answer("plan", lens, scene, "--check", "1")["measured"]["kept"]
    assert answer("image", lens, scene, "chart:text", "-o", out)["predicted_error"] <= 0.5
