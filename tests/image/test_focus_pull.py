"""A picture with depth that follows the lens: against sums over points, the exact picture, and laws of light."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from p2sf.image.components import KernelNodes, blur, components, over_picture
from p2sf.image.focus_pull import MOVING, focused_picture, keep
from p2sf.image.form import form_image
from p2sf.image.geometry import illumination
from p2sf.image.kernel_octaves import halved, octave_kernels, setting
from p2sf.image.octaves import block_means, enlarge, finest_octave, octave_weights
from p2sf.image.slabs import LEVELS, Slab, cut_into_slabs, cuts, depth_levels
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.landing_light import landing_kernels
from p2sf.raytrace.pencil import pencil
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

SHAPE = 96, 144
RNG = np.random.default_rng(5)
LENS = find_lens("cooke_triplet")
SCENE = Scene(Sensor(*SHAPE, 12.0), near_mm=900.0, far_mm=1500.0, rtol=0.05, focus_mm=1000.0)


def smooth_noise(shape, seed=1):
    noise = np.random.default_rng(seed).random((-(-shape[0] // 4) * 4, -(-shape[1] // 4) * 4, 3)).astype(np.float32)
    half = np.moveaxis(enlarge(enlarge(block_means(np.moveaxis(noise, -1, 0), 4))), 0, -1)
    return (0.5 * noise + 0.5 * half)[: shape[0], : shape[1]]


def disc(shape=SHAPE, radius=26):
    row, column = np.mgrid[: shape[0], : shape[1]]
    return np.hypot(row - shape[0] / 2, column - shape[1] / 2) < radius


TWO = np.where(disc(), 900.0, 1500.0)
SLOPE = 1 / np.repeat(np.linspace(1 / 1500, 1 / 900, SHAPE[0])[:, None], SHAPE[1], 1)


def set_for(scene):
    return setting(scene.camera(LENS), scene, MOVING)


def kept_of(values, depth_mm, scene=SCENE):
    return keep(values, depth_mm, set_for(scene))


def pulled(values, depth_mm, scene=SCENE):
    made = set_for(scene)
    return focused_picture(keep(values, depth_mm, made), made)


@pytest.fixture(scope="module")
def nodes():
    return octave_kernels(set_for(SCENE)).finer


def test_an_octave_and_what_is_coarser_are_the_picture():
    planes = RNG.random((3, 24, 36)).astype(np.float32)
    octave, half = finest_octave(planes)
    assert np.abs(enlarge(half) + octave - planes).max() < 1e-6  # float32
    assert np.allclose(block_means(planes, 4).mean(), planes.mean(), rtol=1e-5)
    assert np.array_equal(enlarge(np.ones((2, 3), np.float32)), np.ones((4, 6)))
    assert octave_weights(9, 2.0).sum() == pytest.approx(1.0) and octave_weights(9, 2.0)[0, 0] == 0


def test_depth_is_cut_between_the_sides_of_its_jumps_and_slopes_are_not_cut():
    stairs = np.repeat(np.array([0, 200, 500]), 20)[None].repeat(30, 0)
    low, high = cuts(stairs)
    assert 0 < low <= 200 < high <= 500
    assert cuts(np.arange(LEVELS)[None].repeat(8, 0)) == []
    levels = depth_levels(np.array([1 / 3000, 1 / 900]), 1 / 3000, 1 / 900)
    assert levels.tolist() == [0, LEVELS - 1]


def test_what_is_hidden_takes_colour_and_depth_of_what_is_beside_it():
    values = np.where(disc(), 0.9, 0.2)[None].repeat(3, 0).astype(np.float32)
    (far, near), (edge,) = cut_into_slabs(values, np.where(disc(), 511, 40), 2)
    assert (edge.behind, edge.before) == (40, 511)
    assert edge.share * disc().size == pytest.approx(8 * 26, rel=0.05)  # rows and columns that a circle crosses, twice
    assert np.allclose(far.planes, 0.2) and (far.level == 40).all() and len(far.planes) == 3
    assert np.allclose(near.planes[0], 0.9 * near.planes[3], atol=1e-6)  # premultiplied
    top, left = near.box[0].start, near.box[1].start
    share = block_means(disc(), 4)[near.box]
    assert np.allclose(near.planes[3], share) and top > 0 and left > 0


def test_halved_kernels_have_the_light_and_the_low_frequencies_of_the_others(nodes):
    half = halved(nodes.kernels)
    for fine, coarse in zip(nodes.kernels[1, ::3, 0, 0], half[1, ::3, 0, 0], strict=True):
        at, wide = (np.arange(len(k)) - len(k) // 2 for k in (coarse, fine))
        for f in (0.0, 0.1, 0.2):  # cycles per coarse pixel
            one, two = coarse.sum(0) @ np.cos(2 * np.pi * f * at), fine.sum(0) @ np.cos(np.pi * f * wide)
            assert one == pytest.approx(two, abs=0.01)  # interpolation between the frequencies of the transform
        assert coarse.sum() == pytest.approx(fine.sum(), abs=1e-5)


@pytest.mark.parametrize("rank", [0, 3, 40])
def test_components_keep_the_light_and_what_they_leave_is_what_they_say(nodes, rank):
    part = components(nodes, 1e-4, rank)
    assert len(part.kernels) <= rank + 1
    at = np.rint(nodes.depths).astype(int)
    kernels = np.tensordot(part.tables[..., at], part.kernels, (0, 0))  # rows, columns, depths, channels, y, x
    truth = np.moveaxis(nodes.kernels, 0, 3).transpose(1, 2, 0, 3, 4, 5)
    assert np.abs(kernels.sum((-2, -1)) - 1).max() < 1e-4
    left = np.linalg.norm(kernels - truth) / np.linalg.norm(truth)
    assert left <= part.left + 0.02  # depth nodes lie between two levels
    assert part.left <= 1e-4 or len(part.kernels) == rank + 1


def test_a_blur_is_the_sum_over_points_of_their_own_kernels():
    rows, columns, channels, size = 10, 14, 3, 5
    kernels = RNG.random((channels, 2, 2, 2, size, size)).astype(np.float32)
    nodes = KernelNodes(kernels, np.array([0.0, LEVELS - 1]), np.array([0.0, 9.0]), np.array([0.0, 13.0]))
    part = components(nodes, 0.0, 99)
    planes, level = RNG.random((channels, rows, columns)).astype(np.float32), RNG.integers(0, LEVELS, (rows, columns))
    found = blur(planes, level, part, (0, 0))
    expected = np.zeros((channels, rows + 8, columns + 8))
    for y in range(-2, rows + 2):
        for x in range(-2, columns + 2):
            r, c = min(max(y, 0), rows - 1), min(max(x, 0), columns - 1)
            near, down, right = level[r, c] / (LEVELS - 1), r / 9, c / 13
            weights = np.multiply.outer(np.multiply.outer([1 - near, near], [1 - down, down]), [1 - right, right])
            own = np.einsum("dab,cdabyx->cyx", weights, kernels)
            expected[:, y + 2 : y + 7, x + 2 : x + 7] += planes[:, r, c, None, None] * own
    assert np.abs(found - expected[:, 4:-4, 4:-4]).max() < 2e-4  # float32 transforms of sums of some 60


def test_quantities_over_the_picture_are_linear_between_nodes():
    table = np.arange(4, dtype=np.float32).reshape(1, 2, 2, 1).repeat(LEVELS, 3)
    found = over_picture(table, (np.array([0.0, 4.0]), np.array([0.0, 2.0])), np.zeros((5, 3), int), (0, 0))
    assert np.allclose(found[0], np.arange(5)[:, None] / 2 + np.arange(3) / 2)


@pytest.mark.parametrize("depth", [TWO, SLOPE], ids=["two planes", "slope"])
def test_an_even_scene_has_the_illumination_alone_whatever_its_depths(depth):
    found = pulled(np.full((*SHAPE, 3), 0.6, np.float32), depth)
    light = 0.6 * illumination(set_for(SCENE).seen, SCENE.sensor)
    assert np.abs(found.values - light[..., None]).max() < 2e-3  # coverage is that of one colour


@pytest.mark.parametrize(
    "depth", [TWO, *(pytest.param(d, marks=pytest.mark.slow) for d in (SLOPE, np.full(SHAPE, 1200.0)))]
)
@pytest.mark.parametrize("focus_mm", [1000.0, pytest.param(1400.0, marks=pytest.mark.slow)])
def test_the_moving_picture_is_as_near_the_exact_one_as_it_says(depth, focus_mm):
    scene, values = replace(SCENE, focus_mm=focus_mm), smooth_noise(SHAPE)
    exact = form_image(plan(LENS, scene), values, depth)
    found = pulled(values, depth, scene)
    assert float(np.sqrt(np.mean((found.values - exact) ** 2))) <= found.error < 0.1


def test_the_error_that_is_stated_counts_edges_of_depth_between_which_the_focus_is():
    """A black disc before white, whose octaves alone make 0.02 of it; the pupil that it cuts adds the rest."""
    scene, values = replace(SCENE, focus_mm=2 / (1 / 900 + 1 / 1500)), np.where(disc()[..., None], 0.0, np.ones(3))
    exact = form_image(plan(LENS, scene.at_depths(TWO)), values, TWO)
    found = pulled(values.astype(np.float32), TWO, scene)
    assert 0.02 < float(np.sqrt(np.mean((found.values - exact) ** 2))) <= found.error < 0.1


def test_a_sharp_object_hides_what_is_behind_it():
    one, two = smooth_noise(SHAPE, 1), smooth_noise(SHAPE, 2)
    two[disc()] = one[disc()]
    near, behind = (pulled(v, TWO).values for v in (one, two))
    inside = disc(radius=12)
    assert np.abs(near - behind)[inside].max() < 0.02 < np.abs(near - behind)[~disc()].max()


def test_a_slab_is_blurred_only_about_what_is_seen_of_it(monkeypatch):
    steps = np.repeat([[1500.0, 1200.0, 900.0]], SHAPE[0], 0).repeat(SHAPE[1] // 3, 1)
    kept = kept_of(smooth_noise(SHAPE), steps)
    # A third of 36 coarse pixels, two on either side that edges reach, and two more where the slab goes on.
    assert [slab.about_seen(2).level.shape[1] for slab in kept.slabs] == [12 + 2 + 2, 2 + 12 + 2 + 2, 2 + 12]
    found = focused_picture(kept, set_for(SCENE)).values
    monkeypatch.setattr(Slab, "about_seen", lambda slab, more: slab)
    assert np.abs(focused_picture(kept, set_for(SCENE)).values - found).max() < 1e-4  # transforms in float32


def test_rays_of_pupils_land_as_widely_as_their_waves(nodes):
    made = set_for(SCENE)
    y = made.study.area.y_mm[1]
    pupils, shifts = made.table.at(0.0, y, 1 / 1500, 0.54)
    (kernel,) = landing_kernels(pupils, np.zeros(1), 1e3 * shifts, np.array([90]), 4.0)
    at = np.arange(181) - 90
    waves = made.study.rendered([(0.0, y, 1 / 1500, 0.54)], pupils, shifts)[0]
    wide = 12.0 / 4.0 * (np.arange(len(waves)) - len(waves) // 2)
    for axis in (0, 1):
        moments = [(k.sum(1 - axis) @ x, k.sum(1 - axis) @ (x * x)) for k, x in ((kernel, at), (waves, wide))]
        assert moments[0][0] == pytest.approx(moments[1][0], abs=0.3)  # pixels of 4 µm
        assert moments[0][1] == pytest.approx(
            moments[1][1], rel=0.2
        )  # less diffraction, and pixels three times as wide


def test_pixels_that_are_no_whole_coarse_ones_are_kept():
    values = smooth_noise((50, 71))
    scene = replace(SCENE, sensor=Sensor(50, 71, 12.0))
    found = pulled(values, None, scene)
    assert found.values.shape == values.shape and isinstance(found.error, float)


def test_kernels_of_two_colours_lie_apart_as_their_chief_rays_do():
    """Blue of a landscape lens at f/22 lands farther out than red, here by 18 µm: coma and pixels make 2 % of it."""
    waves, depth = (0.45, 0.65), 900.0
    channels = tuple(Channel(f"{wave}", (1000 * wave,), (1.0,)) for wave in waves)
    scene = Scene(Sensor(24, 36, 200.0), channels, depth, rtol=0.05, focus_mm=depth, f_number=22.0)
    lens = scene.camera(find_lens("landscape"))
    made = setting(lens, scene, MOVING)
    x, y = float(made.coarse.x_mm(made.places[1][0])), float(made.coarse.y_mm(made.places[0][0]))

    def landing_mm(slope, wave):
        return abs(float(np.squeeze(pencil(lens, Source(depth, slope, wave), *np.zeros((2, 1))).chief_y)))

    slope = brentq(lambda slope: landing_mm(slope, waves[1]) - np.hypot(x, y), 1e-4, 0.04)
    away = 1000 * (landing_mm(slope, waves[0]) - np.hypot(x, y)) * np.array([x, y]) / np.hypot(x, y)
    kernels = octave_kernels(made).finer.kernels[:, 0, 0, 0]
    at = (np.arange(kernels.shape[-1]) - kernels.shape[-1] // 2) * 200.0 * 2 ** (MOVING.halvings - 1)
    blue, red = np.stack([kernels.sum(1) @ at, -(kernels.sum(2) @ at)], axis=1)
    assert blue - red == pytest.approx(away, rel=0.05) and np.hypot(*away) > 10
