"""Depths that occur in a scene: nodes where they are, none in the gaps between them."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.conventions import vergence
from p2sf.errors import RequestError
from p2sf.image.form import Forming, form_image
from p2sf.image.layers import map_depths
from p2sf.image.preview import preview_plan
from p2sf.lensfile.library import find_lens
from p2sf.scene.depth_gaps import BINS, LEAST_GAP
from p2sf.scene.planning.plan import plan
from p2sf.scene.planning.verify import verify
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

GREEN = (Channel("green", (540.0,), (1.0,)),)
RANGE = Scene(Sensor(48, 64, 20.0), GREEN, 4000.0, np.inf, 0.05, focus_mm=8000.0, f_number=4.0)
LENS = find_lens("double_gauss_28")
BLUR = Forming(geometry=False)


def between(far: float, near: float, count: int = 500) -> np.ndarray:
    """Return depths, mm, at equal steps of 1/depth."""
    with np.errstate(divide="ignore"):
        return 1 / np.linspace(vergence(far), vergence(near), count)


@pytest.mark.parametrize("count", [2, 3, 7, 12])
def test_few_depths_are_nodes_themselves_and_nothing_is_interpolated(count):
    depths = between(np.inf, 4000.0, count)
    scene = RANGE.at_depths(np.tile(depths, 9))
    assert len(scene.gaps_mm) == count - 1
    assert np.concatenate(scene.depth_parts(count)) == pytest.approx(vergence(depths))
    assert {len(part) for part in scene.depth_parts(193)} == {1}


def test_a_range_without_gaps_has_the_nodes_that_it_had():
    scene = RANGE.at_depths(between(np.inf, 4000.0, 2 * BINS))
    assert scene == RANGE
    for count in (1, 2, 5, 49):
        assert np.concatenate(scene.depth_parts(count)).tolist() == RANGE.vergences(count).tolist()


@pytest.mark.parametrize("depths", [[5000.0, 8000.0], [[5000], [8000]], np.array([8000.0, np.nan, 5000.0])])
def test_depths_may_be_lists(depths):
    assert RANGE.at_depths(depths).gaps_mm == ((5000.0, 8000.0),)
    assert RANGE.at_depths(5000.0).far_mm == RANGE.at_depths(5000.0).near_mm == 5000.0


@pytest.mark.parametrize("depths", ["near", [[5000.0], [5000.0, 6000.0]], [5000j]])
def test_depths_that_are_no_numbers_are_refused(depths):
    with pytest.raises(RequestError):
        RANGE.at_depths(depths)


def test_nodes_in_ranges_are_no_farther_apart_than_without_gaps_and_hold_every_depth():
    depths = np.concatenate([between(np.inf, 20000.0), between(5000.0, 4600.0), [4000.0]])
    scene = RANGE.at_depths(depths)
    assert [tuple(round(end) for end in gap) for gap in scene.gaps_mm] == [(4000, 4600), (5000, 20000)]
    for count in (9, 33, 97):
        parts = scene.depth_parts(count)
        assert len(parts) == 3
        assert max(np.diff(part).max(initial=0) for part in parts) <= np.diff(RANGE.vergences(count))[0] * (1 + 1e-9)
        inside = [(part[0] <= vergence(depths)) & (vergence(depths) <= part[-1]) for part in parts]
        assert np.any(inside, axis=0).all()
        assert sum(map(len, parts)) < count


def test_a_gap_narrower_than_a_step_is_none_and_steps_of_eight_bits_are_no_gaps():
    scene = RANGE.at_depths(np.concatenate([between(np.inf, 8100.0), between(7900.0, 4000.0)]))
    assert len(scene.gaps_mm) == 1 and len(scene.depth_parts(9)) == 1 and len(scene.depth_parts(193)) == 2
    assert RANGE.at_depths(between(np.inf, 4000.0, 256)).gaps_mm == ()
    assert LEAST_GAP < 1 / 96


def test_a_plan_of_two_depths_has_two_nodes_and_keeps_its_tolerance():
    scene = RANGE.at_depths(np.array([4000.0, 8000.0]))
    found = plan(LENS, scene)
    depth = next(each for each in found.decisions if each.kind == "depth")
    assert len(found.vergences) == 2 and depth.error == 0
    assert verify(found, points=1, seed=3).kept


def test_a_picture_of_few_depths_is_that_by_more_nodes_which_hold_them():
    """Depths of 1, 2.5 and 3 parts of 1/12 m are among five nodes at equal steps, and beside the same edges."""
    depth = np.full((41, 41), 12000.0)
    depth[:, 20:], depth[10:20, 5:12] = 4800.0, 4000.0
    scene = replace(RANGE, sensor=Sensor(41, 41, 20.0)).at_depths(depth)
    made = preview_plan(scene.camera(LENS), scene)
    values = np.random.default_rng(3).random((41, 41, 1)).astype(np.float32)
    own = replace(made, vergences=tuple(np.concatenate(scene.depth_parts(5)).tolist()))
    more = replace(made, vergences=tuple(scene.vergences(5).tolist()))
    few, many = (form_image(each, values, depth, BLUR) for each in (own, more))
    assert len(own.vergences) == 3
    assert many == pytest.approx(few, abs=1e-5)
    together = replace(made, vergences=tuple(scene.vergences(2).tolist()))
    assert np.abs(form_image(together, values, depth, BLUR) - few).max() > 0.01


def test_an_edge_across_a_gap_hides_what_is_behind_it():
    """From the last node of one range to the first of the next is one node, and yet a jump in depth."""
    nodes = vergence([12000.0, 11000.0, 10000.0, 4200.0, 4100.0, 4000.0])
    depth = np.repeat(np.array([[10000.0, 10000.0, 4200.0, 4200.0]]), 4, axis=0)
    assert map_depths(depth, nodes, depth.shape, half=1, fold=0.1).hiding.any()
    slope = np.repeat(np.array([[12000.0, 11400.0, 10700.0, 10000.0]]), 4, axis=0)
    assert not map_depths(slope, nodes, slope.shape, half=1, fold=0.1).hiding.any()
    gentle = np.repeat(np.array([[11000.0, 10800.0, 10600.0, 10400.0]]), 4, axis=0)  # a fifth of a node a pixel
    assert not map_depths(gentle, nodes, gentle.shape, half=1).hiding.any()


def test_depths_in_a_gap_or_beyond_the_ends_are_refused():
    scene = replace(RANGE, gaps_mm=((5000.0, 9000.0),))
    scene.check_depths(np.array([0.0, 4000.0, 5000.0, 9000.0, np.inf, np.float32(4999.9999)]))
    with pytest.raises(RequestError) as refused:
        scene.check_depths(np.array([4500.0, 7000.0]))
    assert refused.value.message.values["depth"] == 7000.0
    with pytest.raises(RequestError) as refused:
        scene.check_depths(np.array([3000.0, 7000.0]))
    assert refused.value.message.values["depth"] == 7000.0
    with pytest.raises(RequestError) as refused:
        scene.check_depths(np.array([3000.0, 9000.0]))
    assert refused.value.message.values["near"] == 4000.0


@pytest.mark.parametrize("gaps", [((3000.0, 5000.0),), ((9000.0, 5000.0),), ((5000.0, 7000.0), (6000.0, 8000.0))])
def test_gaps_that_do_not_fit_are_refused(gaps):
    with pytest.raises(RequestError) as refused:
        replace(RANGE, gaps_mm=gaps)
    assert refused.value.message.values["parameter"] == "gaps_mm"
