"""Depth in layers: what lies between two nodes is interpolated, what stands in front hides what is behind."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from p2sf.image.form import Forming, form_image
from p2sf.image.layers import map_depths
from p2sf.image.lowrank import _spline
from p2sf.image.preview import BY_RAYS, preview_plan
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.nodes import hats
from p2sf.scene.planning.verify import planned_kernel
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from tests.support.tiers import in_tiers
from tests.support.visibility import seen_through_pupil

GREEN = (Channel("green", (540.0,), (1.0,)),)
BLUR = Forming(geometry=False)


def planned(focus_mm: float, vergences: tuple[float, ...]):
    """Return the Double Gauss at f/4 on 41 × 41 pixels of 20 µm, nodes at these vergences."""
    scene = Scene(Sensor(41, 41, 20.0), GREEN, 4000.0, focus_mm=focus_mm, f_number=4.0)
    return replace(preview_plan(scene.camera(find_lens("double_gauss_28")), scene), vergences=vergences)


def layers(colours: np.ndarray, depth: np.ndarray, nodes: np.ndarray):
    """Return the layers of a picture blurred by kernels of 7 pixels."""
    return map_depths(depth, nodes, depth.shape, half=3).layers(colours)


def test_a_slope_has_no_edges_however_many_depth_nodes_there_are():
    """Of 57 nodes over 41 pixels each row lies 1.4 nodes beyond the next, but its blur changes by less than a pixel."""
    far, near = 1 / 12000.0, 1 / 4000.0
    depth = np.repeat(1 / np.linspace(far, near, 41)[:, None], 41, axis=1)
    values = gaussian_filter(np.random.default_rng(3).random((41, 41, 1)), (1, 1, 0)).astype(np.float32)
    few, many = (
        form_image(planned(6000.0, tuple(np.linspace(far, near, count).tolist())), values, depth, BLUR)
        for count in (19, 57)
    )
    assert (
        np.abs(many - few).max() < 0.1 * values.std()
    )  # by interpolation between 19 nodes; as edges the slope is off by ten times that


def test_layers_of_a_slope_add_up_and_those_beside_an_edge_reach_on():
    """The same five pixels, far from an edge of depth and beside one."""
    nodes = np.array([0.0, 1e-4, 3e-4])
    depth = 1 / np.array([[1e-14, 0.4e-4, 0.8e-4, 1e-4, 2e-4, 3e-4]])
    colours = np.arange(6.0).reshape(1, 6, 1)
    near, middle, far = layers(colours, depth, nodes)
    assert (near.number, middle.number, far.number) == (2, 1, 0)
    assert near.opacity[0] == pytest.approx([0, 0, 0, 0, 0.5, 1], abs=1e-6)
    assert middle.opacity[0] == pytest.approx([0, 0.4, 0.8, 1, 0.5, 0], abs=1e-6)
    assert near.opacity + middle.opacity + far.opacity == pytest.approx(np.ones((1, 6)), abs=1e-6)
    assert not near.hiding.any() and (far.colours == colours).all()
    depth[0, -1] = 1 / 0.5e-4  # a jump of one and a half nodes
    _, middle, far = layers(colours, depth, nodes)
    assert middle.opacity[0] == pytest.approx([0, 0.4, 0.8, 1, 0.5, 0.5], abs=1e-6)
    # Of two layers that share a pixel, the farther one hides what is behind both.
    assert middle.hiding[0] == pytest.approx([0, 0, 0, 1, 1, 0], abs=1e-6)
    assert far.opacity[0] == pytest.approx([1, 0.6, 0.2, 1, 1, 0.5], abs=1e-6)
    assert far.hiding[0] == pytest.approx(np.ones(6), abs=1e-6)


def test_what_is_hidden_takes_colour_and_depth_of_the_nearest_pixel_beside_it():
    """A post of two pixels, before a wall on its left and the sky on its right; and a picture of one depth."""
    depth = np.array([[2.0, 2.0, 1.0, 1.0, np.inf]]) * 1000
    nodes = np.array([0.0, 1 / 2000, 1 / 1000])
    near, middle, far = layers(np.arange(5.0).reshape(1, 5, 1), depth, nodes)
    assert near.opacity[0].tolist() == [0, 0, 1, 1, 0]
    assert middle.opacity[0].tolist() == [1, 1, 1, 0, 0] and middle.colours[0, :, 0].tolist() == [0, 1, 1, 4, 4]
    assert far.colours[0, :, 0].tolist() == [4, 4, 4, 4, 4]
    (only,) = layers(np.ones((2, 3, 1)), np.full((2, 3), 500.0), np.array([0.0, 1e-3]))
    assert only.number == 1 and (only.opacity == 1).all() and not only.hiding.any()


def test_what_is_hidden_between_two_nodes_is_divided_between_them_as_what_is_seen():
    """A wall 0.65 of the way from a node to the next, behind a post: both of its layers go on evenly, and add up."""
    depth = 1 / np.array([[0.65e-4, 0.65e-4, 3e-4, 3e-4, 0.65e-4]])
    near, *wall = layers(np.ones((1, 5, 1)), depth, np.array([1e-14, 1e-4, 2e-4, 3e-4]))
    assert near.opacity[0].tolist() == [0, 0, 1, 1, 0]
    for layer, number, opacity, hiding in zip(wall, (1, 0), (0.65, 0.35), (0, 1), strict=True):
        assert layer.number == number
        assert layer.opacity[0] == pytest.approx(np.full(5, opacity), abs=1e-6)
        assert layer.hiding[0] == pytest.approx(np.full(5, hiding), abs=1e-6)


def test_an_edge_is_the_same_whatever_nearer_edges_are_far_away():
    """Of two posts at two depths before a textured wall, the farther one is seen as if it stood alone."""
    made = planned(8000.0, tuple(np.linspace(1 / 12000.0, 1 / 4000.0, 3).tolist()))
    made = replace(made, scene=replace(made.scene, sensor=Sensor(21, 81, 20.0)), counts=(1, 1))
    values = np.random.default_rng(3).random((21, 81, 1)).astype(np.float32)
    depth = np.full((21, 81), 12000.0)
    depth[:, 60:66] = 6000.0
    alone = form_image(made, values, depth, BLUR)
    depth[:, 6:12] = 4000.0
    both = form_image(made, values, depth, BLUR)
    np.testing.assert_allclose(both[:, 45:], alone[:, 45:], atol=1e-5)


@pytest.mark.parametrize("as_layers", [False, True])
def test_even_light_stays_even_at_edges_of_depth_in_every_colour(as_layers):
    """A layer covers and hides as its light spreads: by each colour's own kernels, which axial colour tells apart."""
    scene = Scene(Sensor(31, 31, 20.0), near_mm=1000.0, far_mm=4000.0, focus_mm=4000.0)
    made = preview_plan(scene.camera(find_lens("singlet_f6")), scene)
    made = replace(made, counts=(1, 1), vergences=(1 / 4000.0, 1 / 1000.0))
    before = np.zeros((31, 31))
    before[:, 12:19] = 1
    if as_layers:
        stack = np.ones((2, 31, 31, 4), np.float32)
        stack[1] = before[..., None]
        found = form_image(made, stack, np.array([4000.0, 1000.0]), BLUR)
    else:
        found = form_image(made, np.ones((31, 31, 3), np.float32), np.where(before, 1000.0, 4000.0), BLUR)
    np.testing.assert_allclose(found, 1, atol=2e-5)  # kernels of float32 have unit sum to 1e-6 a pixel


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


SHAPES = {"edge": lambda x: x < 20, "wire": lambda x: abs(x - 20) <= 1, "fence": lambda x: x % 12 < 3}
NEAR_MM, BETWEEN_MM, FAR_MM = 2000.0, 3500.0, 8000.0
AT_NODES = [(shape, focus, False) for shape in SHAPES for focus in (NEAR_MM, BETWEEN_MM, FAR_MM)]
BETWEEN_NODES = [("edge", focus, True) for focus in (NEAR_MM, FAR_MM)]  # finer things show the kernels interpolated
KEPT = AT_NODES[0], AT_NODES[1], AT_NODES[5], BETWEEN_NODES[0]


@pytest.mark.parametrize(("shape", "focus_mm", "between"), in_tiers([*AT_NODES, *BETWEEN_NODES], KEPT))
def test_every_part_of_the_pupil_sees_what_lies_on_its_ray(shape, focus_mm, between):
    """Rays of both depths, each looked up in the scene by itself; depths at nodes, or halfway between two."""
    scene = Scene(Sensor(41, 41, 20.0), GREEN, NEAR_MM, FAR_MM, focus_mm=focus_mm, f_number=4.0)
    made = preview_plan(scene.camera(find_lens("double_gauss_28")), scene)
    made = replace(made, recipe=BY_RAYS, counts=(1, 1), vergences=(1 / FAR_MM, 1 / NEAR_MM))
    nodes = tuple(each * factor for each in made.vergences for factor in (0.998, 1.002)) if between else made.vergences
    near = np.broadcast_to(SHAPES[shape](np.arange(41)), (41, 41))
    texture = gaussian_filter(np.random.default_rng(3).normal(size=(41, 41)), 3)
    picture = np.where(near, 0.7, 0.3) + 0.15 * texture / texture.std()
    found = form_image(replace(made, vergences=nodes), picture[..., None], np.where(near, NEAR_MM, FAR_MM), BLUR)[
        ..., 0
    ]
    seen = seen_through_pupil(made, near, picture)
    assert np.sqrt(np.mean((found - seen)[10:-10, 10:-10] ** 2)) < 0.01


@pytest.mark.parametrize("focus_mm", [NEAR_MM, 4000.0])
def test_a_slanted_wall_has_no_seams(focus_mm):
    """No part hides another: the light of the layers adds up, over what they cover, so that even walls stay even."""
    scene = Scene(Sensor(41, 41, 20.0), GREEN, NEAR_MM, FAR_MM, focus_mm=focus_mm, f_number=8.0)
    made = preview_plan(scene.camera(find_lens("double_gauss_28")), scene)
    made = replace(made, counts=(1, 1), vergences=tuple(np.linspace(1 / FAR_MM, 1 / NEAR_MM, 7)))
    wall = np.broadcast_to(1 / np.linspace(1 / NEAR_MM, 1 / FAR_MM, 41), (41, 41))
    picture = np.maximum(0.5 + gaussian_filter(np.random.default_rng(4).normal(size=(41, 41, 1)), (1, 1, 0)), 0)
    shares = hats(np.array(made.vergences), 1 / wall.ravel()).reshape(7, 41, 41, 1)

    def added(values: np.ndarray) -> np.ndarray:
        layers = zip(made.vergences, shares, strict=True)
        return sum(form_image(replace(made, vergences=(v,)), values * share, None, BLUR) for v, share in layers)

    found, even = form_image(made, picture, wall, BLUR), added(np.ones_like(picture))
    np.testing.assert_allclose(found, added(picture) / even, atol=1e-5)  # of float32 transforms
    assert np.ptp(even) > 0.02


def test_weights_between_nodes_add_up_to_one_and_are_straight_between_two():
    positions = np.linspace(-1.0, 5.0, 13)
    for nodes in ([2.0], [0.0, 4.0], [0.0, 1.0, 4.0]):
        weights = _spline(np.array(nodes), positions)
        np.testing.assert_allclose(weights.sum(1), 1, atol=1e-14)  # rounding of the few that add up
        np.testing.assert_allclose(weights[positions == nodes[-1]][0], np.eye(len(nodes))[-1], atol=1e-14)
    halfway = _spline(np.array([0.0, 4.0]), np.array([-1.0, 1.0, 9.0]))
    np.testing.assert_allclose(halfway, [[1, 0], [0.75, 0.25], [0, 1]], rtol=1e-15)
