"""Depth in layers: what lies between two nodes is interpolated, what stands in front hides what is behind."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.image import Forming, form_image
from p2sf.image.layers import layer_weights, merge
from p2sf.image.lowrank import _spline
from p2sf.image.preview import preview_plan
from p2sf.lensfile.library import find_lens
from p2sf.scene import Channel, Scene, Sensor
from p2sf.scene.planning.verify import planned_kernel

GREEN = (Channel("green", (540.0,), (1.0,)),)
BLUR = Forming(geometry=False)


def planned(focus_mm: float, vergences: tuple[float, ...]):
    """Return the Double Gauss at f/4 on 41 × 41 pixels of 20 µm, nodes at these vergences."""
    scene = Scene(Sensor(41, 41, 20.0), GREEN, 4000.0, focus_mm=focus_mm, f_number=4.0)
    return replace(preview_plan(scene.camera(find_lens("double_gauss_28")), scene), vergences=vergences)


def test_shares_are_linear_in_one_over_the_distance_and_the_ends_beyond_the_nodes():
    nodes = np.array([0.0, 1e-4, 3e-4])
    depth = np.array([[np.inf, 20000.0, 10000.0, 5000.0, 1000.0]])
    shares = layer_weights(depth, nodes, (1, 5))[0]
    assert shares == pytest.approx(np.array([[1, 0, 0], [0.5, 0.5, 0], [0, 1, 0], [0, 0.5, 0.5], [0, 0, 1]]), abs=1e-6)


def test_a_point_between_two_depths_is_the_interpolated_kernel_of_the_plan():
    made = planned(8000.0, (0.0, 1 / 8000.0, 1 / 4000.0))
    picture = np.zeros((41, 41, 1), np.float32)
    picture[18, 23] = 1.0
    found = form_image(made, picture, np.full((41, 41), 5000.0), BLUR)[..., 0]
    sensor = made.scene.sensor
    kernel = planned_kernel(made, float(sensor.x_mm(23)), float(sensor.y_mm(18)), 1 / 5000.0, 0)
    half = kernel.shape[-1] // 2
    part = found[18 - half : 19 + half, 23 - half : 24 + half]
    assert np.linalg.norm(part - kernel) <= 1e-3 * np.linalg.norm(kernel)
    assert found.sum() == pytest.approx(
        1, abs=1e-3
    )  # layers keep evenness; kernels that change with field then give a little


@pytest.mark.parametrize("near_is_sharp", [True, False])
def test_light_from_behind_does_not_spill_over_a_sharp_edge_in_front_but_a_blurred_edge_spills(near_is_sharp):
    """The right half is bright; it is behind a black sharp left half, or a blurred one before a sharp left half."""
    made = planned(4000.0 if near_is_sharp else 1e9, (0.0, 1 / 8000.0, 1 / 4000.0))
    right = np.arange(41) >= 21
    depth = np.where(right == near_is_sharp, np.inf, 4000.0) * np.ones((41, 1))
    picture = np.where(right, 1.0, 0.0)[None, :, None] * np.ones((41, 1, 1))
    row = form_image(made, picture, depth, BLUR)[20, :, 0]
    beside = row[15:19]  # dark pixels 2 to 6 from the edge
    assert beside.max() < 0.03 if near_is_sharp else beside.max() > 0.1
    assert row[35] == pytest.approx(1, abs=0.02) and row[5] == pytest.approx(0, abs=0.02)


def test_a_layer_hides_all_but_its_neighbour():
    ones = np.ones((1, 1, 2), np.float32)  # light 1, coverage 1
    dark = np.array([[[0.0, 1.0]]], np.float32)
    assert merge([ones, dark], [0, 2])[0, 0, 0] == 0  # hidden
    assert merge([ones, dark], [0, 1])[0, 0, 0] == pytest.approx(0.5)  # shares the pixel


def test_weights_between_nodes_add_up_to_one_and_are_straight_between_two():
    positions = np.linspace(-1.0, 5.0, 13)
    for nodes in ([2.0], [0.0, 4.0], [0.0, 1.0, 4.0]):
        weights = _spline(np.array(nodes), positions)
        np.testing.assert_allclose(weights.sum(1), 1, atol=1e-14)  # rounding of the few that add up
        np.testing.assert_allclose(weights[positions == nodes[-1]][0], np.eye(len(nodes))[-1], atol=1e-14)
    halfway = _spline(np.array([0.0, 4.0]), np.array([-1.0, 1.0, 9.0]))
    np.testing.assert_allclose(halfway, [[1, 0], [0.75, 0.25], [0, 1]], rtol=1e-15)
