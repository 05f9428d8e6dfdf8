"""Pictures with depth against sums over single pixels and over the pupil: short versions of two long jobs."""

from itertools import product

import numpy as np
import pytest
from numpy.lib.stride_tricks import sliding_window_view

from p2sf.image.form import DepthKernels, form_image
from p2sf.image.progress import Progress
from p2sf.pixel_kernels.nodes import hats
from p2sf.scene.planning.study import distance, weighted_sum
from tests.benchmarks.image_simulation import BLUR, CAMERAS, for_reference
from tests.long.depth_edges import GOAL, PANE, configurations, edge_errors, random_stack
from tests.long.picture_crops import PLANS, crop_errors
from tests.support.depth_scenes import SCENES
from tests.support.per_pixel import per_pixel_picture, widest_half

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("shape", "focus", "better"),
    [
        ("near over far, left", "far", 50),
        ("fence", "near", 10),
        ("far through a window", "between", 4),
        (PANE, "near", 30),
    ],
)
def test_edges_are_right_to_a_hundredth_where_coverage_was_far_off(shape, focus, better):
    """With the focus between, the parts of the pupil see other parts of both depths: a product of means will not do."""
    former, now = edge_errors(shape, focus)
    assert now.rms < GOAL and now.largest < 3 * GOAL and former.rms > better * now.rms
    assert len(configurations()) == 20


def test_three_layers_of_an_aberrated_lens_are_right_to_a_hundredth():
    """Of the random stacks the one that was farthest off, by 0.017, by moments that knew nothing of aberrations."""
    about, now = random_stack(32)
    assert about == "tessar, 3 layers" and now.rms < GOAL


@pytest.mark.parametrize("number", range(len(PLANS)))
def test_a_picture_with_edges_keeps_its_tolerance(number):
    found = crop_errors(number, (60, 80), (6, 8))
    assert found["plan"] == PLANS[number] and found["light"] <= 1


def test_the_error_of_a_picture_is_what_the_error_of_its_kernels_allows():
    """White noise at one depth: Cauchy and Schwarz bound each pixel; the variance is that of the kernels' errors."""
    camera, shape, region, green = CAMERAS[0], (60, 80), (slice(20, 36), slice(26, 46)), 1
    values = np.random.default_rng(5).random((*shape, 3)).astype(np.float32)
    made, exact, depth = camera.plan(0.2, shape), for_reference(camera, shape), np.full(shape, 1 / camera.middle)
    truth = per_pixel_picture(exact, values[..., green], depth, region, green)
    off = form_image(made, values, depth, BLUR)[region][..., green] - truth

    sensor, vergence, shares, norms = made.scene.sensor, camera.middle, [], []
    depths = hats(np.array(made.vergences), np.array([vergence]))[:, 0]
    of_picture = DepthKernels(made, Progress())  # also between nodes that are not computed
    for row, column in product(range(20, 36, 5), range(26, 46, 5)):
        true = exact.kernels(green, vergence).at(float(sensor.x_mm(column)), float(sensor.y_mm(row)))
        near = [of_picture.at(number, row, column)[green] for number in np.flatnonzero(depths).tolist()]
        shares.append(distance(weighted_sum(near, depths[depths > 0].tolist()), true))
        norms.append(float(np.linalg.norm(true)))
    # 320 pixels, a few of them independent of each other: their variance is known to a third
    assert off.std() / truth.std() == pytest.approx(np.sqrt(np.mean(np.square(shares))), rel=0.3)
    half = widest_half(exact, np.array([vergence]))
    around = values[
        region[0].start - half : region[0].stop + half, region[1].start - half : region[1].stop + half, green
    ]
    windows = sliding_window_view(around, (2 * half + 1, 2 * half + 1))
    contrast = windows.std((2, 3)) * (2 * half + 1)
    assert (np.abs(off) <= max(shares) * max(norms) * contrast).all()
    assert max(shares) <= 0.2


@pytest.mark.parametrize("name", SCENES)
def test_scenes_have_few_depths_and_linear_light(name):
    values, place = SCENES[name]((60, 90), 3)
    assert values.shape == (60, 90, 3) and values.dtype == np.float32 and values.min() >= 0
    assert 0 < place.min() and place.max() < 1 and 2 <= np.unique(place).size <= 12
    assert (values.max() > 10) == (name == "lamps")


def test_cameras_are_a_wave_out_of_focus_at_either_end():
    """Wd of the six coefficients, against the formula of the thin lens that sets the depths.

    Their distances differ by that of the pupil from the first vertex, a tenth of the shortest depth at most.
    """
    from p2sf.lensfile.library import find_lens
    from p2sf.paraxial.seidel import coefficients

    for camera in CAMERAS:
        scene = camera.scene()
        lens = scene.camera(find_lens(camera.lens))
        ends = [float(coefficients(lens, depth, 0.0, 0.54).wd) for depth in (scene.near_mm, scene.far_mm)]
        assert np.ptp(ends) == pytest.approx(2, rel=0.2) and min(map(abs, ends)) > 0.5
