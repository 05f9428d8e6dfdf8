"""Flat areas look the same through any lens: they take no kernels, and no pixel changes by more than is allowed."""

import numpy as np
import pytest
from scipy.ndimage import convolve, gaussian_filter, maximum_filter, minimum_filter

from p2sf.image import form
from p2sf.image.form import Forming, form_image
from p2sf.image.region import Region, whole
from p2sf.image.structure import centroid_px, change_of_shade, structured_parts
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from tests.benchmarks.content import CASES, run
from tests.support.per_pixel import per_pixel_picture

HALF = 5
SHAPE = 150, 190
COLOURS = tuple(Channel(name, (nm,), (1.0,)) for name, nm in (("green", 540.0), ("blue", 465.0)))
CHANNEL = 0


@pytest.fixture(scope="module")
def studio():
    """Return a picture and its depths: a ball with texture before an even background, which has a slight slope."""
    row, column = np.indices(SHAPE)
    values = np.broadcast_to((0.6 + 1e-5 * row)[..., None], (*SHAPE, 2)).astype(np.float32)
    ball = np.hypot(row - 70, column - 60) < 25
    values[ball] = np.random.default_rng(2).random((*SHAPE, 2))[ball]
    return values, np.where(ball, 4000.0, 12000.0)


@pytest.fixture(scope="module")
def planned(studio):
    """Return the plan of the Double Gauss at f/4 for the picture."""
    scene = Scene(Sensor(*SHAPE, 20.0), COLOURS, 4000.0, 12000.0, 0.05, focus_mm=6000.0, f_number=4.0)
    return plan(find_lens("double_gauss_28"), scene.at_depths(studio[1]))


def everywhere(monkeypatch) -> None:
    """Let no part count as flat."""
    monkeypatch.setattr(form, "FLAT", -1.0)


def test_a_pixel_and_its_blur_differ_by_no_more_than_the_range_within_reach():
    """By any kernels without negative values and of unit sum: the law that leaves flat areas as they are."""
    random = np.random.default_rng(0)
    values = gaussian_filter(random.random((60, 60)), 3)
    size = 2 * HALF + 1
    ranges = maximum_filter(values, size) - minimum_filter(values, size)
    for _ in range(4):
        kernel = random.random((size, size)) ** 8
        blurred = convolve(values, kernel / kernel.sum(), mode="nearest")
        assert (np.abs(blurred - values) <= ranges + 1e-12).all()
    flat = np.full((40, 40), 0.3)
    assert convolve(flat, kernel / kernel.sum(), mode="nearest") == pytest.approx(flat, abs=1e-12)


@pytest.mark.parametrize("corner", [(0, 0), (37, 21)])
def test_every_pixel_whose_reach_is_not_flat_is_in_a_part(corner):
    random = np.random.default_rng(1)
    values = np.full((300, 260, 2), 0.5, np.float32)
    for row, column in random.integers(0, 260, (9, 2)):
        values[row, column] = 0.6
    given = Region(corner[0], corner[0] + 300, corner[1], corner[1] + 260)
    tile, size = given.grown(-HALF), (2 * HALF + 1, 2 * HALF + 1, 1)
    low, high = minimum_filter(values, size), maximum_filter(values, size)
    busy = (high - low > 0.01 * low).any(-1)[tile.within(given)]
    parts, found = structured_parts(values, given, tile, HALF, 0.01), np.zeros(tile.shape, int)
    for part in parts:
        found[part.within(tile)] += 1
    assert found.max() == 1 and found[busy].all()
    assert busy.sum() < found.sum() < 0.4 * found.size


def test_all_of_a_texture_is_one_part_and_an_even_picture_has_none():
    values = np.random.default_rng(0).random((100, 90, 1))
    given = whole(values.shape)
    assert structured_parts(values, given, given.grown(-HALF), HALF, 0.1) == [given.grown(-HALF)]
    assert structured_parts(np.zeros_like(values), given, given, HALF, 0.0) == []
    assert structured_parts(np.full_like(values, 0.7), given, given, HALF, 0.0) == []


@pytest.mark.parametrize("half", [1, 3, 8])
def test_kernels_change_the_illumination_by_no_more_than_by_taylors_theorem(half):
    row, column = np.indices((120, 150))
    shade = 1 / (1 + ((row - 30) ** 2 + (column - 100) ** 2) / 200**2) ** 2
    random = np.random.default_rng(5)
    for lean in (0.0, 0.5, 3.0):
        kernel = random.random((2 * half + 1, 2 * half + 1)) ** 6 * np.exp(lean * np.linspace(0, 1, 2 * half + 1))
        kernel /= kernel.sum()
        off_px = centroid_px(kernel[None])
        change = np.abs(convolve(shade, kernel[::-1, ::-1]) - shade)[half:-half, half:-half] / shade.min()
        bound = change_of_shade(shade.astype(np.float32), half, off_px)
        assert change.max() <= bound * (1 + 1e-3)
    steepest = np.abs(np.diff(shade, axis=0)).max() / shade.min()
    assert change_of_shade(shade, half, 0.0) < 0.4 * half * steepest  # that of a kernel with its light at one end
    assert change_of_shade(shade[:2, :2], half, off_px) == np.inf


def test_a_centroid_is_the_mean_place_of_the_light():
    kernels = np.zeros((2, 5, 5))
    kernels[0, 2, 2], kernels[1, 2, 4], kernels[1, 0, 2] = 1.0, 0.5, 0.5
    assert centroid_px(kernels) == pytest.approx(np.sqrt(2))
    assert centroid_px(kernels[:1]) == 0


@pytest.mark.parametrize(("step", "parts"), [(0.0099, 0), (0.0101, 1)])
def test_a_step_is_flat_up_to_what_is_allowed(step, parts):
    values = np.full((80, 80, 1), 0.5)
    values[:, 40:] *= 1 + step
    given = whole(values.shape)
    assert len(structured_parts(values, given, given, HALF, 0.01)) == parts


def test_what_is_flat_changes_by_no_more_than_allowed_and_takes_no_kernels(studio, planned, monkeypatch):
    values, depth = studio
    blurred = form._Former._blurred
    areas: list[int] = []

    def counted(former, part, placed):
        areas.append(part.shape[0] * part.shape[1])
        return blurred(former, part, placed)

    monkeypatch.setattr(form._Former, "_blurred", counted)
    few, area = form_image(planned, values, depth), sum(areas)
    areas.clear()
    everywhere(monkeypatch)
    true = form_image(planned, values, depth)
    assert area < 0.4 * sum(areas)
    assert np.abs(few - true).max() <= planned.allowed_error / 3 * values.max()
    assert np.abs(few - true).max() > 0


def test_where_kernels_change_the_illumination_by_all_that_is_allowed_nothing_is_flat(studio, planned, monkeypatch):
    values, depth = np.full_like(studio[0], 0.5), np.full(SHAPE, 12000.0)
    few = form_image(planned, values, depth)
    monkeypatch.setattr(form, "change_of_shade", lambda *given: planned.allowed_error / 3)
    every = form_image(planned, values, depth)
    assert np.abs(few - every).max() > 0
    everywhere(monkeypatch)
    assert np.array_equal(every, form_image(planned, values, depth))


def test_beside_a_black_surround_nothing_is_flat(planned, studio, monkeypatch):
    values = np.full_like(studio[0], 0.5)
    far = np.full(SHAPE, 12000.0)
    how = Forming(surround="black", geometry=False)
    few = form_image(planned, values, far, how)
    everywhere(monkeypatch)
    assert few == pytest.approx(form_image(planned, values, far, how), abs=1e-6)


@pytest.mark.slow
def test_a_studio_keeps_its_tolerance_against_the_kernel_of_every_pixel(planned, studio):
    """About the rim of the ball, and in the part that has no kernels."""
    values, depth = studio
    found = form_image(planned, values, depth, Forming(geometry=False))[..., CHANNEL]
    for region in ((slice(60, 72), slice(80, 96)), (slice(60, 72), slice(130, 146))):
        true = per_pixel_picture(planned, values[..., CHANNEL], depth, region, CHANNEL)
        assert np.linalg.norm(found[region] - true) <= planned.allowed_error * np.linalg.norm(true)


@pytest.mark.slow
@pytest.mark.parametrize("case", [CASES[0], CASES[5]], ids=lambda case: case.name)
def test_content_saves_depth_nodes_and_changes_the_picture_by_no_more_than_two_tolerances(case):
    """Both pictures keep the tolerance, so that they differ by twice that at most."""
    (rote, every), (held, few) = (run(case, (160, 240), content) for content in (False, True))
    assert held.nodes < rote.nodes and held.kernels <= rote.kernels
    assert np.linalg.norm(few - every) < 2 * case.rtol * np.linalg.norm(every)


def test_the_bound_of_a_change_of_illumination_is_reached_by_its_worst_kernel():
    """1 + c·xy times two halves of light at opposite corners of a kernel: a change of c·half² everywhere."""
    half, c = 3, 1e-4
    row, column = np.indices((40, 50))
    shade = 1 + c * row * column
    assert change_of_shade(shade, half, 0.0) == pytest.approx(c * half**2, rel=1e-6)
