"""Scenes given as layers: premultiplied alpha, what is behind each being known."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.image import form
from p2sf.image.form import Forming, form_image
from p2sf.image.preview import BY_RAYS, preview_plan
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor
from tests.image.test_layers import BLUR, GREEN, planned

NODES = (1 / 8000.0, 1 / 4000.0)
SHAPE = 41, 41


def scene_of(focus_mm: float = 8000.0):
    """Return the Double Gauss from 4 to 8 m with the same kernel everywhere."""
    made = planned(focus_mm, NODES)
    return replace(made, scene=replace(made.scene, far_mm=8000.0), counts=(1, 1))


def rgba(colour: np.ndarray | float, alpha: np.ndarray | float) -> np.ndarray:
    """Return a layer, (rows, columns, 2), of one colour and its alpha, premultiplied."""
    colour, alpha = np.broadcast_to(colour, SHAPE), np.broadcast_to(alpha, SHAPE)
    return np.stack([colour * alpha, alpha], axis=-1)


def texture(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).random(SHAPE)


def test_an_opaque_layer_is_the_picture_of_its_depth_and_hides_what_is_behind():
    made = scene_of()
    alone = form_image(replace(made, vergences=NODES[1:]), texture(1)[..., None], None, BLUR)
    two = np.stack([rgba(texture(2), 1.0), rgba(texture(1), 1.0)])
    found = form_image(made, two, np.array([8000.0, 4000.0]), BLUR)
    np.testing.assert_allclose(found, alone, atol=2e-5)  # kernels of float32 have unit sum to 1e-6 a pixel


def test_a_layer_is_the_picture_of_its_depth_where_the_middle_blurs_more_than_the_corner():
    scene = Scene(Sensor(161, 5, 60.0), near_mm=250.0, far_mm=250.0, focus_mm=2000.0)
    made = preview_plan(scene.camera(find_lens("achromat_f6")), scene)
    picture = np.random.default_rng(1).random((161, 5, 3)).astype(np.float32)
    stack = np.concatenate([picture, np.ones((161, 5, 1), np.float32)], axis=-1)[None]
    alone, found = form_image(made, picture, None, BLUR), form_image(made, stack, np.array([250.0]), BLUR)
    np.testing.assert_allclose(found, alone, atol=2e-5)


def test_layers_take_no_time_for_halos_that_they_do_not_have(monkeypatch):
    monkeypatch.setattr(form._Placing, "lit", None)
    assert form_image(scene_of(), rgba(texture(1), 1.0)[None], np.array([4000.0]), BLUR).any()


@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0])
def test_an_even_veil_mixes_the_pictures_of_both_depths(alpha):
    """Even alpha has no silhouette: the picture is α of the near one and 1 − α of the far one, whatever their blur."""
    made = scene_of(5000.0)
    near, far = texture(1), texture(2)
    pictures = [
        form_image(replace(made, vergences=(node,)), each[..., None], None, BLUR)
        for node, each in zip(NODES, (far, near), strict=True)
    ]
    stack = np.stack([rgba(near, alpha), rgba(far, 1.0)])
    found = form_image(made, stack, np.array([4000.0, 8000.0]), BLUR)
    np.testing.assert_allclose(found, alpha * pictures[1] + (1 - alpha) * pictures[0], atol=2e-5)


def test_light_is_linear_and_what_no_layer_covers_is_dark():
    made = scene_of()
    alpha = (texture(3) > 0.5).astype(float)
    one = form_image(made, rgba(texture(1), alpha)[None], np.array([4000.0]), BLUR)
    twice = rgba(texture(1), alpha)[None].copy()
    twice[..., 0] *= 2
    np.testing.assert_allclose(form_image(made, twice, np.array([4000.0]), BLUR), 2 * one, atol=1e-5)
    empty = form_image(made, np.zeros((2, *SHAPE, 2)), np.array([4000.0, 8000.0]), BLUR)
    assert not empty.any()
    covered = form_image(made, rgba(1.0, alpha)[None], np.array([4000.0]), BLUR)
    # Nothing is divided by what is covered: the light that arrives is that which was sent.
    assert covered[12:-12, 12:-12].mean() == pytest.approx(alpha[12:-12, 12:-12].mean(), abs=0.02)


def test_a_black_surround_is_an_empty_margin_of_every_layer():
    """A near layer that ends at the edge of the picture hides nothing of what shines past it."""
    made, black, margin = scene_of(5000.0), replace(BLUR, surround="black"), ((0, 0), (10, 10), (10, 10), (0, 0))
    stack = np.stack([rgba(0.3, np.arange(41) < 20), rgba(texture(2), 1.0)])
    sensor = replace(made.scene.sensor, rows=61, columns=61)
    wide = replace(made, scene=replace(made.scene, sensor=sensor))
    depths = np.array([4000.0, 8000.0])
    found, around = form_image(made, stack, depths, black), form_image(wide, np.pad(stack, margin), depths, black)
    np.testing.assert_allclose(found, around[10:-10, 10:-10], atol=2e-5)


def test_the_order_in_which_layers_are_given_does_not_matter_but_at_one_depth():
    made = scene_of()
    layers = np.stack([rgba(texture(1), 0.3), rgba(texture(2), 1.0)])
    depths = np.array([4000.0, 8000.0])
    one, other = (form_image(made, layers[k], depths[k], BLUR) for k in ([0, 1], [1, 0]))
    assert (one == other).all()
    front = form_image(made, np.stack([rgba(0.2, 1.0), rgba(0.9, 1.0)]), np.array([4000.0, 4000.0]), BLUR)
    np.testing.assert_allclose(front, 0.2, atol=1e-4)


def test_distortion_moves_a_layer_as_it_moves_a_picture():
    made = scene_of()
    alone = form_image(replace(made, vergences=NODES[:1]), texture(1)[..., None], None, Forming())
    found = form_image(made, rgba(texture(1), 1.0)[None], np.array([8000.0]), Forming())
    np.testing.assert_allclose(found, alone, atol=2e-5)


@pytest.mark.parametrize(
    ("layers", "depths", "words"),
    [
        (np.zeros((2, *SHAPE, 2)), np.array([4000.0]), "there are 2 layers"),
        (np.zeros((1, *SHAPE, 2)), None, "there are 1 layers"),
        (np.full((1, *SHAPE, 2), 1.5), np.array([4000.0]), "alpha reaches from 1.5 to 1.5"),
        (np.zeros((1, *SHAPE, 4)), np.array([4000.0]), "1 channels"),
        (np.zeros((1, *SHAPE, 2)), np.array([100.0]), "reaches from 100 mm"),
        (np.zeros((1, *SHAPE, 2)), np.array([-4000.0]), "not positive"),
    ],
)
def test_layers_that_do_not_fit_are_one_sentence(layers, depths, words):
    with pytest.raises(RequestError, match=words):
        form_image(scene_of(), layers, depths, BLUR)


@pytest.mark.parametrize("focus_mm", [3500.0, 1500.0])
def test_a_silhouette_cuts_the_pupil_through_which_a_ramp_is_seen(focus_mm):
    """Black before a ramp, blurred on opposite sides of focus and on one: the mean over the disc, by paraxial blurs.

    The product of the means is off by 0.02 and more. W40, which the paraxial blurs leave out, is 1 % of them at f/16.
    """
    scene = Scene(Sensor(41, 41, 10.0), GREEN, 2000.0, 8000.0, focus_mm=focus_mm, f_number=16.0)
    made = replace(preview_plan(scene.camera(find_lens("double_gauss_28")), scene), recipe=BY_RAYS, counts=(1, 1))
    column = np.arange(41)
    pane, ramp = np.broadcast_to(column < 20, (41, 41)), np.broadcast_to(column / 40, (41, 41))
    stack = np.stack([np.stack([0 * ramp, pane], -1), np.stack([ramp, np.ones_like(ramp)], -1)])
    row = form_image(made, stack, np.array([2000.0, 8000.0]), BLUR)[20, :, 0]
    x, y = np.mgrid[-1:1:201j, -1:1:201j]
    disc, blurs = x[np.hypot(x, y) <= 1], []
    for depth in (2000.0, 8000.0):
        paraxial = coefficients(made.lens, depth, 0.0, 0.54)
        blurs.append(float(2 * paraxial.wd * 0.54 / paraxial.reduced_slope) / 10)  # at the rim, pixels
    near, far = (column[:, None] + blur * disc for blur in blurs)
    truth, apart = ((near > 19.5) * far / 40).mean(1), (near > 19.5).mean(1) * far.mean(1) / 40
    assert np.abs(apart - truth)[17:24].max() > 0.02
    assert row[17:24] == pytest.approx(truth[17:24], abs=0.004)
