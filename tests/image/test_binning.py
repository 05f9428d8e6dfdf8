"""A picture at the resolution of a screen: pixels joined before it is formed."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.image.binning import block_means, fit_screen, times_to_fit
from p2sf.image.form import Forming, form_image
from p2sf.image.preview import preview_plan
from p2sf.lensfile.library import find_lens
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

GREEN = (Channel("green", (540.0,), (1.0,)),)
LENS = find_lens("double_gauss_28")
SCENE = Scene(Sensor(62, 92, 20.0), GREEN, f_number=4.0, focus_mm=6000.0)
BLUR = Forming(geometry=False)


def of_plan(scene: Scene):
    """Return kernels by a fit of the pupil, without a search."""
    return preview_plan(scene.camera(LENS), scene)


def test_a_kernel_of_joined_pixels_is_the_sum_of_the_kernel_over_each():
    """Three by three: the middle of a joined pixel is that of one of them."""
    times, half = 3, 5
    scene, _, _ = fit_screen(SCENE, np.zeros((62, 92, 1), np.float32), None, 31)
    x, y = 0.36, -0.48
    coarse = of_plan(scene).kernels(0, 0.0).at(x, y, half)
    fine = of_plan(SCENE).kernels(0, 0.0).at(x, y, times * half + 1)
    joined = fine.reshape(2 * half + 1, times, 2 * half + 1, times).sum((1, 3))
    assert np.linalg.norm(joined - coarse) < 2e-3 * np.linalg.norm(coarse)  # transforms in windows of two sizes


def test_joined_pixels_lie_amid_those_that_they_join():
    sensor = Sensor(60, 90, 20.0, (1.0, -2.0))
    for times in (2, 3, 5):
        joined = sensor.bin_pixels(times)
        assert joined.x_mm(np.arange(joined.columns)) == pytest.approx(
            sensor.x_mm(np.arange(90)).reshape(-1, times).mean(1)
        )
        assert joined.y_mm(np.arange(joined.rows)) == pytest.approx(
            sensor.y_mm(np.arange(60)).reshape(-1, times).mean(1)
        )


def test_the_noise_of_joined_pixels_is_that_of_a_mean():
    sensor = Sensor(60, 90, 20.0, full_well=1000.0, read_noise=5.0, fill_factor=0.8)
    light = np.array([0.0, 0.1, 1.0])
    assert sensor.bin_pixels(4).noise(light) == pytest.approx(sensor.noise(light) / 4)
    with pytest.raises(RequestError):
        replace(sensor, mosaic="rggb").bin_pixels(2)


def test_depths_are_those_of_pixels_and_the_longer_side_fits():
    values = np.random.default_rng(0).random((62, 92, 1)).astype(np.float32)
    depth = np.where(np.arange(92) < 40, 4000.0, 9000.0) * np.ones((62, 1))
    for longest in (10, 31, 45, 91, 92, 500):
        scene, joined, places = fit_screen(SCENE, values, depth, longest)
        assert max(joined.shape) <= longest and joined.shape[:2] == places.shape
        assert (scene.sensor.rows, scene.sensor.columns) == places.shape
        assert set(np.unique(places)) == {4000.0, 9000.0}
        assert joined.mean() == pytest.approx(values.mean(), abs=0.01)
    with pytest.raises(RequestError):  # it has as many blocks as the picture
        fit_screen(SCENE, values, depth[:-1, :-1], 31)
    ends = np.abs(np.arange(92) - 45.5) * np.ones((62, 1))
    assert np.ptp(block_means(ends[..., None], 5)[:, [0, -1]]) == 0  # what is left over is cut off at both ends
    assert times_to_fit(Sensor(3, 5000, 5.0), 100) == 3  # no side is left without pixels


def test_joined_pixels_are_right_for_light_in_the_middle_of_each_and_a_little_sharp_for_other():
    """Where in a joined pixel its light comes from is what larger kernels cannot tell."""
    random, times = np.random.default_rng(2), 3
    middles = np.zeros((60, 90, 1), np.float32)
    middles[1::3, 1::3] = random.random((20, 30, 1))
    even = np.repeat(np.repeat(middles[1::3, 1::3], times, 0), times, 1) / times**2
    scene = replace(SCENE, sensor=Sensor(60, 90, 20.0))
    smaller, joined, _ = fit_screen(scene, even, None, 30)
    few = form_image(of_plan(smaller), joined, how=BLUR)
    of_middles, of_even = (block_means(form_image(of_plan(scene), v, how=BLUR), times) for v in (middles, even))
    contrast = np.linalg.norm(of_middles - of_middles.mean())
    inside = np.s_[4:-4, 4:-4]  # beyond the edge, its outermost pixels are repeated, and those are dark in one of them
    assert np.linalg.norm((few - of_middles)[inside]) < 0.01 * contrast
    assert few[inside].std() > of_even[inside].std()
