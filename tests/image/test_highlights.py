"""Halos: bright points as sums of exact rays have them, down to a millionth of the peak."""

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.errors import RequestError
from p2sf.figures.tails import FAINTEST
from p2sf.image.form import Forming, form_image
from p2sf.image.highlights import BrightLight, add_halo, groups_of
from p2sf.lens.lens import with_f_number, with_mask
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.pixels import rim_gain
from p2sf.scene.files import read_scene
from p2sf.scene.planning.plan import plan
from p2sf.scene.planning.reference import reference_kernel
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from tests.benchmarks import faint_tails, forming
from tests.support.tiers import in_tiers

GREEN, RED = Channel("green", (540.0,), (1.0,)), Channel("red", (590.0, 620.0, 650.0), (1.0, 2.0, 1.0))
BLUR = Forming(geometry=False)
MASKS = PupilMask(), PupilMask(blades=6), PupilMask(vanes=4)
CASES = [(mask, channel) for channel in (GREEN, RED) for mask in MASKS]


def rings(values: np.ndarray) -> np.ndarray:
    """Return the mean of an odd square in rings a pixel wide about its middle."""
    half = len(values) // 2
    ring = np.hypot(*np.mgrid[-half : half + 1, -half : half + 1]).astype(int).ravel()
    return (np.bincount(ring, values.ravel()) / np.bincount(ring))[: half + 1]


@pytest.mark.parametrize(("mask", "channel"), in_tiers(CASES, (CASES[1],)), ids=str)
def test_the_halo_of_a_bright_point_is_that_of_every_ray(mask, channel):
    """The mean of every ring to 2 %, of which edges counted by their open part take 1 % far out; a tenth is asked.

    A single pixel is off by at most 3e-5 of the peak, where spikes are finer than pixels.
    """
    half, at = (40, 46) if channel is RED else (20, 30)
    lens = with_mask(find_lens("double_gauss_28"), mask)
    sensor = Sensor(2 * at + 1, 2 * at + 1, 6.0, (0.0, 8.0))
    planned = plan(lens, Scene(sensor, (channel,), f_number=5.6, tail_error=0.1))
    picture = np.full((2 * at + 1, 2 * at + 1, 1), 0.01, np.float32)
    picture[at, at] = 1e4
    found = form_image(planned, picture, how=BLUR).astype(float)[..., 0] - 0.01
    part = found[at - half : at + half + 1, at - half : at + half + 1] / 1e4
    place = float(sensor.x_mm(at)), float(sensor.y_mm(at))
    exact = reference_kernel(planned.sensor_map(0.0), channel, *place, half, 6.0)
    exact *= part.sum() / exact.sum()  # in this window
    promised = rings(exact) >= FAINTEST * exact.max()
    np.testing.assert_allclose(rings(part)[promised], rings(exact)[promised], rtol=0.02)
    assert rings(exact)[-1] < 5e-5 * exact.max()  # spikes of vanes are the brightest
    far = np.hypot(*np.mgrid[-half : half + 1, -half : half + 1]) > 6
    assert np.abs(part - exact)[far].max() < 3e-5 * exact.max()


@pytest.mark.slow
def test_samples_finer_than_fringes_have_the_tails_of_every_ray_out_to_200_airy_radii():
    """A tenth is asked, and here 4 % are kept."""
    lens = with_mask(with_f_number(find_lens("fast_gauss_f14"), 1.4), PupilMask(vanes=4))
    np.testing.assert_allclose(faint_tails.tails(lens, (50, 200)), 1, atol=0.04)


@pytest.mark.slow
def test_the_benchmark_of_forming_runs_on_few_pixels():
    found = forming.measure(forming.Case(megapixels=0.02))
    assert found["gib"] >= found["inputs"] > 0
    assert 0 < sum(found[part] for part in forming.PARTS) < found["cpu"] - found["plan"]


def test_points_add_up_each_with_its_own_depth_and_halo():
    """Two headlamps at two depths: their picture is the sum of those of each, to the light that counts as dark."""
    sensor = Sensor(60, 90, 6.0)
    planned = plan(find_lens("double_gauss_28"), Scene(sensor, (GREEN,), 9000.0, f_number=8.0, tail_error=0.3))
    depth, pictures = np.full((60, 90), 1e5), np.zeros((2, 60, 90, 1), np.float32)
    depth[:, 45:] = 9000.0
    pictures[0, 20, 20], pictures[1, 40, 70] = 1e4, 3e3
    one, other, both = (form_image(planned, each, depth, BLUR) for each in (*pictures, pictures.sum(0)))
    np.testing.assert_allclose(both, one + other, rtol=1e-5, atol=1e-6 * both.max())
    assert one[20, 40, 0] > 1e-6 * one.max()  # a small kernel ends at 9 pixels


def test_the_halo_of_a_point_is_that_of_its_own_row_and_column():
    """Exchanging both mirrors the picture on a sensor whose middle lies on the mirror, to what kernels round."""
    sensor = Sensor(80, 80, 12.0, (6.0, -6.0))
    planned = plan(find_lens("double_gauss_28"), Scene(sensor, (GREEN,), f_number=5.6, tail_error=0.1))
    pictures = np.zeros((2, 80, 80, 1), np.float32)
    pictures[0, 8, 70], pictures[1, 70, 8] = 1e4, 1e4
    one, other = (form_image(planned, each, how=BLUR)[..., 0] for each in pictures)
    halo = other.T[:20, 50:]
    np.testing.assert_allclose(one[:20, 50:], halo, rtol=1e-2, atol=1e-7 * halo.max())
    assert (halo > 1e-5 * halo.max()).sum() > 100


def test_a_halo_is_that_of_a_larger_picture_where_a_node_of_depth_has_a_wider_blur():
    """Of 4 × 4 pixels, fewer than their kernels have, in the middle of 44 × 44; a tenth is asked of each."""
    lens, counts, pictures, plans = find_lens("double_gauss_28"), (4, 44), [], []
    for count in counts:
        scene = Scene(Sensor(count, count, 6.0), (GREEN,), 3000.0, 12000.0, f_number=5.6, tail_error=0.1, focus_mm=3e3)
        plans.append(plan(lens, scene))
        pictures.append(np.zeros((count, count, 1), np.float32))
        pictures[-1][count // 2, count // 2] = 1e4
    middles = [slice(count // 2 - 2, count // 2 + 2) for count in counts]
    for depth in (3323.4, 3338.5, 4589.8, 4732.9, 9546.9):
        small, large = (
            form_image(planned, each, np.full(each.shape[:2], depth), BLUR)[middle, middle]
            for planned, each, middle in zip(plans, pictures, middles, strict=True)
        )
        np.testing.assert_allclose(small, large, rtol=0.1)


def test_a_group_is_spread_as_the_sum_of_its_points_and_cut_at_the_edge():
    random = np.random.default_rng(4)
    rows, columns = random.integers(0, 12, 5), random.integers(0, 15, 5)
    bright = BrightLight(rows, columns, np.zeros(5), random.random((5, 2)))
    kernel, out, wanted = random.normal(size=(2, 9, 9)), np.zeros((12, 15, 2)), np.zeros((20, 23, 2))
    add_halo(out, bright, kernel)
    for row, column, light in zip(rows, columns, bright.light, strict=True):
        wanted[row : row + 9, column : column + 9] += light * np.moveaxis(kernel, 0, -1)
    np.testing.assert_allclose(out, wanted[4:-4, 4:-4], atol=1e-14)
    split = list(groups_of(BrightLight(rows, columns, np.arange(5.0), bright.light), (800, 800)))
    assert len(split) == 5 and sum(float(each.light.sum()) for each in split) == pytest.approx(bright.light.sum())


def test_the_gain_of_a_rim_is_that_of_a_mean_over_a_cell():
    """A slit whose outer cells count in part has the light of the slit itself, up to a quarter of the period."""
    count, wide = 256, np.linspace(30, 32, 41)[:-1]  # of many, so that edges meet cells everywhere
    cells = np.clip(wide / 2 + 0.5 - np.abs(np.arange(-32, 33))[:, None], 0, 1)
    x = np.arange(-100, 101)
    found = (np.abs(np.exp(-2j * np.pi * np.outer(x, np.arange(-32, 33)) / count) @ cells) ** 2).sum(1)
    true = (np.sinc(x[:, None] * wide / count) ** 2 * wide**2).sum(1)
    gain = rim_gain(100, 1.0, count, 0.0)[100]
    bands = [np.abs(x) // 20 == k for k in (1, 2)]
    for band in bands:
        assert (found * gain)[band].sum() == pytest.approx(true[band].sum(), rel=0.02)  # of the copies a period away
    assert found[bands[1]].sum() < 0.95 * true[bands[1]].sum()


def test_a_scene_states_faint_light_in_two_ways(tmp_path):
    lines = "[sensor]\nrows = 4\ncolumns = 6\npixel_um = 9\n"
    for name, head in (("new", "tail_error = 0.1\n"), ("old", 'measure = "hdr"\ntolerance = 0.1\n')):
        (tmp_path / f"{name}.toml").write_text(head + lines)
    new, old = (read_scene(tmp_path / f"{name}.toml") for name in ("new", "old"))
    assert new.measure == old.measure == "hdr" and new.limit == old.limit == new.relative_tolerance == 0.1
    planned = plan(find_lens("double_gauss_28"), new)
    with pytest.raises(RequestError, match="patches"):
        form_image(planned, np.ones((4, 6, 3)), how=Forming("lowrank"))
