"""Pictures through misaligned lenses: the PSF at a place, mirror images, and the pictures of symmetric lenses."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.image.form import Forming, form_image
from p2sf.image.geometry import illumination
from p2sf.lens.lens import with_f_number
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import source_at
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.pixel_kernels.illumination import light_collected
from p2sf.pixel_kernels.sensor_points import landing_mm
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.scene.planning.field_points import scene_maps
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

WAVE = 0.54
SENSOR = Sensor(25, 37, 20.0, (0.0, 9.0))  # around a field of 5°, where misalignment turns the PSF
SCENE = Scene(SENSOR, (Channel("green", (540.0,), (1.0,)),), rtol=0.05)
WIDE = Sensor(64, 96, 150.0)  # distorted by more than pictures leave out


@pytest.fixture(scope="module")
def gauss():
    return with_f_number(find_lens("double_gauss_28"), 8.0)


@pytest.fixture(scope="module")
def bad(gauss):
    return displaced(gauss, 3, 5, Placement(0.15, 0.1, 0.02, 0.2, 0.2))


@pytest.fixture(scope="module")
def planned(bad):
    return plan(bad, SCENE)


@pytest.mark.parametrize("sensor", [SENSOR, WIDE, replace(WIDE, centre_mm=(-3.0, 5.0))], ids=repr)
def test_a_chief_ray_lands_where_the_map_has_it(bad, sensor):
    """At depths between those traced too, in the corners and between."""
    seen = scene_maps(bad, replace(SCENE, sensor=sensor, near_mm=800.0), [0.0, 1 / 1900.0], WAVE)
    for view in seen:
        for row, column in ((0.0, 0.0), (0.15 * sensor.rows, 0.8 * sensor.columns), (sensor.rows - 1.0, 0.0)):
            place = float(sensor.x_mm(column)), float(sensor.y_mm(row))
            assert landing_mm(bad, view.source(*place, WAVE)) == pytest.approx(place, abs=0.01 * sensor.pixel_mm)


def test_the_picture_of_a_point_is_the_psf_there(gauss, bad, planned):
    """The reference is turned by the azimuth of its field, a degree at most."""
    point = np.zeros((25, 37, 1), np.float32)
    row, column = 12, 18
    point[row, column] = 1.0
    found = form_image(planned, point, how=Forming(geometry=False, surround="black"))[..., 0]
    assert planned.meets
    source = planned.sensor_map(0.0).source(float(SENSOR.x_mm(column)), float(SENSOR.y_mm(row)), WAVE)
    assert abs(source.azimuth_deg) < 1.0
    psf = render_integrated(bad, source, "huygens", 9, SENSOR.pixel_um)
    expected = psf.values[::-1] * psf.energy
    near = found[row - 4 : row + 5, column - 4 : column + 5]
    assert np.linalg.norm(near - expected) < planned.predicted_error * np.linalg.norm(expected)
    assert found.sum() == pytest.approx(1.0, abs=1e-3)
    # Of the aligned lens it is another.
    straight = render_integrated(gauss, source, "huygens", 9, SENSOR.pixel_um)
    assert np.linalg.norm(near - straight.values[::-1]) > 0.02 * np.linalg.norm(expected)


def test_kernels_of_a_mirrored_lens_are_mirrored(gauss, planned):
    """To what interpolation between fitted pupils leaves of either."""
    mirrored = plan(displaced(gauss, 3, 5, Placement(-0.15, 0.1, 0.02, 0.2, -0.2)), SCENE)
    one, two = (made.kernels(0, 0.0).at(x, 9.05, 4) for made, x in ((planned, -0.2), (mirrored, 0.2)))
    left = sum(
        decision.error for made in (planned, mirrored) for decision in made.decisions if decision.kind == "pupils"
    )
    assert np.linalg.norm(one - two[:, ::-1]) < max(left, 1e-5) * np.linalg.norm(one)  # float32
    assert np.linalg.norm(one - one[:, ::-1]) > 0.02 * np.linalg.norm(one)


def test_light_falls_where_it_is_collected(bad):
    """The irradiance over the sensor, against differences of landing chief rays: ∂(slopes)/∂(place)."""
    seen, step = scene_maps(bad, replace(SCENE, sensor=WIDE), [0.0], WAVE)[0], 1e-4

    def irradiance(source) -> float:
        across, up = source.slopes_xy
        ends = (
            [landing_mm(bad, source_at(inf, across + a, up + b, WAVE)) for a, b in ((-x, -y), (x, y))]
            for x, y in ((step, 0.0), (0.0, step))
        )
        (one, two), (three, four) = (np.subtract(*pair[::-1]) / (2 * step) for pair in ends)
        return light_collected(bad, source) / abs(one * four - two * three)

    shade, place = illumination(seen, WIDE), (7, 90)
    source = seen.source(float(WIDE.x_mm(place[1])), float(WIDE.y_mm(place[0])), WAVE)
    assert shade[place] == pytest.approx(irradiance(source) / irradiance(source_at(inf, 0.0, 0.0, WAVE)), abs=1e-5)
    assert shade[place] < 0.993


@pytest.mark.slow
def test_without_misalignment_it_is_the_picture_of_the_symmetric_lens(gauss):
    """A sphere turned about its own centre is no other lens, but no symmetry is known of it; clipped and not."""
    lens = with_f_number(gauss, 11.0)
    turned = displaced(lens, 1, 1, Placement(tilt_x_deg=2.0, pivot=(0.0, 0.0, lens.surfaces[0].radius)))
    values = np.random.default_rng(0).random((64, 96, 1)).astype(np.float32)
    for clip in (False, True):
        scene = replace(SCENE, sensor=WIDE, rtol=0.1, clip=clip)
        both = plan(turned, scene), plan(lens, scene)
        found, expected = (form_image(made, values) for made in both)
        assert np.linalg.norm(found - expected) < 0.01 * np.linalg.norm(expected)
        own, other = (illumination(made.sensor_map(0.0), WIDE) for made in both)
        assert own == pytest.approx(other, abs=2e-3 if clip else 1e-4)  # linear between places where rims clip
        assert own.min() < 0.99


@pytest.mark.slow
def test_the_command_line_plans_and_forms_it(bad, tmp_path, answer):
    lens, scene, out = tmp_path / "bad.toml", tmp_path / "scene.toml", tmp_path / "out.png"
    lens.write_text(lens_to_toml(bad), encoding="utf-8")
    scene.write_text(
        "tolerance = 0.5\nf_number = 11\nclip = true\n[sensor]\nrows = 8\ncolumns = 8\npixel_um = 20\n[[channel]]\n"
        "name = 'green'\nwavelengths_nm = [540]\nweights = [1]\n",
        encoding="utf-8",
    )
    for _ in range(2):
        assert answer("plan", lens, scene, "--check", "1")["measured"]["kept"]
        assert answer("image", lens, scene, "chart:text", "-o", out)["predicted_error"] <= 0.5
        assert answer("image", lens, scene, "chart:text", "-o", out, "--preview")["method"] == "preview"
        scene.write_text(scene.read_text(encoding="utf-8").replace("clip = true\n", ""), encoding="utf-8")
