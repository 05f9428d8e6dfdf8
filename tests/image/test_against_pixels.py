"""Pictures with depth against sums over single pixels and over the pupil: short versions of two long jobs."""

import numpy as np
import pytest

from tests.benchmarks.image_simulation import CAMERAS
from tests.long.depth_edges import GOAL, PANE, configurations, edge_errors
from tests.long.picture_crops import crop_errors
from tests.support.depth_scenes import SCENES

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


def test_a_picture_with_edges_keeps_its_tolerance():
    found = crop_errors(0, (60, 80), (6, 8))
    assert found["light"] <= 1


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
