"""Fast image formation equals the definition, keeps the light, and has the contrast that the PSF has."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import Cancelled, RequestError
from p2sf.image import form
from p2sf.image.blur_operator import BlurOperator
from p2sf.image.charts import draw_chart
from p2sf.image.form import Forming, form_image
from p2sf.image.geometry import distort, distortion_px, illumination
from p2sf.image.lattice import NodeKernels, choose_step, computed_nodes, weights_between
from p2sf.image.lowrank import decompose, low_rank_blur
from p2sf.image.preview import preview, preview_plan
from p2sf.image.progress import Progress
from p2sf.image.region import whole
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.channel import Colour, Kernels, Recipe
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.pixel_kernels.sensor_points import sensor_map
from p2sf.psf.huygens import huygens_psf
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from p2sf.threads import using_threads
from tests.support.direct_sum import direct_sum
from tests.support.exact_lattice import build_lattice

SIDE, HALF = 128, 7
GREEN = (Channel("green", (540.0,), (1.0,)),)


def comet(row: float, column: float) -> np.ndarray:
    """Return a kernel that grows, turns and gets a tail with the field: what lenses do, in closed form."""
    y, x = np.mgrid[-HALF : HALF + 1, -HALF : HALF + 1]
    up, right = (SIDE / 2 - row) / SIDE, (column - SIDE / 2) / SIDE + 1e-9  # the axis has no direction
    field = np.hypot(up, right)
    along, across = (x * right - y * up) / field, (x * up + y * right) / field
    width, length = 1 + 2 * field**2, 1 + 5 * field**2
    kernel = np.exp(-(across**2) / (2 * width**2) - (along - 2 * field**2 * np.abs(along)) ** 2 / (2 * length**2))
    return (kernel / kernel.sum())[None].astype(np.float32)


@pytest.fixture(scope="module")
def by_definition():
    pictures = np.concatenate([draw_chart(name, SIDE, SIDE)[..., :1] for name in ("text", "landscape")], axis=-1)
    noise = np.random.default_rng(1).random((SIDE, SIDE, 1)).astype(np.float32)
    pictures = np.concatenate([pictures, noise], axis=-1)
    return pictures, direct_sum(pictures, lambda row, column: comet(row, column), HALF)


def blur(picture, lattice, method, tolerance):
    """Return the blurred picture with all light that leaves it, by patches or by low rank."""
    if method == "patches":
        return BlurOperator(lattice, picture.shape[:2]).spread(picture)
    return low_rank_blur(picture, [decompose(lattice, n, tolerance) for n in range(lattice.channels)])


def each(kernel_at):
    """Return the kernels of several nodes, one by one."""
    return lambda rows, columns: [kernel_at(row, column) for row, column in zip(rows, columns, strict=True)]


@pytest.mark.parametrize("method", ["patches", "lowrank"])
@pytest.mark.parametrize("channel", range(3), ids=["text", "landscape", "noise"])
def test_both_ways_equal_the_direct_sum_and_keep_the_light(by_definition, method, channel):
    """Linear interpolation over cells of 4 pixels leaves 3e-4 of this fast-changing kernel, splines over 8 less."""
    pictures, truth = by_definition
    count = 33 if method == "patches" else 17
    lattice = build_lattice(each(comet), (SIDE, SIDE), (count, count))
    picture = pictures[..., channel : channel + 1]
    found = blur(picture, lattice, method, 1e-4)
    good = truth[..., channel : channel + 1]
    assert np.linalg.norm(found - good) / np.linalg.norm(good) <= 1e-3
    assert found.sum(dtype=float) == pytest.approx(picture.sum(dtype=float), rel=1e-6)


@pytest.mark.slow
def test_a_real_lens_equals_its_direct_sum():
    """400 bright pixels anywhere in 128 × 128 at 18 mm of the Double Gauss, each sent out with its own kernel."""
    sensor = Sensor(SIDE, SIDE, 8.0, (0.0, 18.0))
    seen = sensor_map(find_lens("double_gauss_28"), np.inf, 0.5876, sensor.corners_mm()[1])
    kernels = Kernels(seen, Colour((0.5876,), (1.0,)), 8.0, Recipe("fitted"))

    def kernel_at(row, column):
        return kernels.at(float(sensor.x_mm(column)), float(sensor.y_mm(row)), 14)[None]

    random = np.random.default_rng(2)
    picture = np.zeros((SIDE, SIDE, 1), np.float32)
    picture.ravel()[random.choice(SIDE * SIDE, 400, replace=False)] = random.random(400)
    truth = direct_sum(picture, kernel_at, 14)
    for method in ("patches", "lowrank"):
        found = blur(picture, build_lattice(each(kernel_at), (SIDE, SIDE), (4, 4)), method, 1e-4)
        assert np.linalg.norm(found - truth) / np.linalg.norm(truth) <= 1e-3
        assert found.sum(dtype=float) == pytest.approx(picture.sum(dtype=float), rel=1e-6)


def test_a_low_rank_says_what_it_leaves_out():
    lattice = build_lattice(each(comet), (SIDE, SIDE), (9, 9))
    left = [decompose(lattice, 0, 0.0, rank).left for rank in (0, 2, 5, 20)]
    assert left == sorted(left, reverse=True) and left[-1] < 0.15 * left[0]
    assert np.abs(decompose(lattice, 0, 0.0, 5).kernels.sum((1, 2))).max() < 1e-5


def test_mirrored_quarters_are_the_whole():
    """`comet` is symmetric about pixel 64, so on 129 pixels its quarters are exact mirror images."""
    one, two = (build_lattice(each(comet), (129, 129), (5, 4), mirrored) for mirrored in (False, True))
    for line, other in zip(one.kernels, two.kernels, strict=True):
        for kernel, twin in zip(line, other, strict=True):
            assert np.allclose(kernel, twin, atol=1e-7)


@pytest.mark.parametrize("count", [2, 12, 33, 49])
@pytest.mark.parametrize("step", [1, 2, 3, 4])
def test_polynomials_of_fifth_degree_are_exact_between_computed_nodes(count, step):
    known = computed_nodes(count, step)
    assert {0, count - 1} <= set(known.tolist()) and (known == count - 1 - known[::-1]).all()
    assert len(known) == count or np.diff(known).max() <= step + 1  # a quotient rounded either way
    weights = weights_between(count, step, range(count))
    assert not np.delete(weights, known, axis=1).any()
    place = np.linspace(-1, 1, count)
    for degree in range(6 if len(known) < count else 10):
        np.testing.assert_allclose(weights @ place**degree, place**degree, atol=1e-13)  # of weights up to some ten


@pytest.mark.parametrize("allowed", [0.02, 0.002])
def test_kernels_between_computed_nodes_are_as_true_as_allowed(allowed):
    """Every kernel of a lattice against the closed form; the error was measured in the corner, where it is largest."""
    nodes = NodeKernels(each(comet), nodes_along(SIDE, 49), nodes_along(SIDE, 49))
    nodes.step = choose_step([nodes], allowed)
    assert nodes.step > 1
    lattice = nodes.over(whole((SIDE, SIDE)))
    assert len(nodes.computed) < 0.4 * 49**2
    off = [
        np.linalg.norm(lattice.kernels[a][b] - comet(row, column)) / np.linalg.norm(comet(row, column))
        for a, row in enumerate(lattice.row_nodes)
        for b, column in enumerate(lattice.column_nodes)
        if np.hypot(row - SIDE / 2, column - SIDE / 2) > SIDE / 8  # nearer the comet's direction is no polynomial
    ]
    assert max(off) <= allowed


def quick(sensor: Sensor, lens="double_gauss_28", f_number=None):
    scene = Scene(sensor, GREEN, f_number=f_number)
    return preview_plan(scene.camera(find_lens(lens)), scene)


def test_the_slanted_edge_has_the_psfs_contrast():
    """Edge: the formed picture, binned along the edge to an eighth of a pixel, differentiated (ISO 12233).

    PSF: the Huygens sum, its transform along the edge's normal. Between them stand two boxes a pixel wide,
    the chart's averaging and the sensor's, and the two of a bin.
    """
    size, pixel, angle, bins = 161, 5.0, np.deg2rad(5.0), 8
    sensor = Sensor(size, size, pixel, (0.0, 8.0))
    planned = quick(sensor, f_number=6.0)
    planned = replace(planned, recipe=Recipe("fitted", None, 4.0, 0.5))
    picture = form_image(planned, draw_chart("slanted_edge", size, size)[..., :1], how=Forming(geometry=False))
    inner = picture[30:-30, 20:-20, 0].astype(float)
    y, x = np.mgrid[30 : size - 30, 20 : size - 20] - size // 2
    distance = x * np.cos(angle) - y * np.sin(angle)
    index = np.floor(distance * bins).astype(int)
    used = np.abs(index) < 40 * bins
    total, count = (np.bincount(index[used] + 40 * bins, w) for w in (inner[used], np.ones(used.sum())))
    line = np.diff(total[1:] / count[1:])
    f = np.linspace(0.02, 0.45, 20)
    places = np.arange(len(line)) / bins
    edge = np.abs(np.exp(-2j * np.pi * np.outer(f, places)) @ line) / line.sum() / np.sinc(f / bins) ** 2
    seen = planned.sensor_map(0.0)
    psf = huygens_psf(seen.lens, seen.source(0.0, 8.0, 0.54), 256, 0.7)
    along = np.cos(angle) * psf.x_um + np.sin(angle) * psf.y_um[:, None]
    wave = np.exp(-2j * np.pi * f[:, None, None] / pixel * along)
    boxes = (np.sinc(f * np.cos(angle)) * np.sinc(f * np.sin(angle))) ** 2
    expected = np.abs((wave * psf.values).sum((1, 2))) * boxes
    assert expected.min() < 0.3 < 0.8 < expected.max()
    assert np.abs(edge - expected).max() <= 0.01


def test_distortion_puts_points_where_real_chief_rays_land():
    sensor = Sensor(400, 400, 80.0)
    seen = sensor_map(find_lens("double_gauss_28"), np.inf, 0.54, sensor.corners_mm()[1])
    assert 1 < distortion_px(seen, sensor) < 5
    row, column = np.mgrid[:400, :400]
    blob = np.exp(-((row - 40.0) ** 2 + (column - 330.0) ** 2) / 18)[..., None].astype(np.float32)
    found = distort(blob, seen, sensor)[..., 0]
    place = [(found * axis).sum() / found.sum() for axis in (row, column)]
    x, y = float(sensor.x_mm(330)), float(sensor.y_mm(40))
    from p2sf.lens.source import Source
    from p2sf.pixel_kernels.sensor_points import chief_heights

    ideal = np.hypot(x, y)
    real = float(chief_heights(seen.lens, Source(np.inf, ideal / seen.scale_mm, 0.54)))
    wanted = (y * real / ideal, x * real / ideal)
    assert float(sensor.y_mm(place[0])) == pytest.approx(wanted[0], abs=0.008)  # a tenth of a pixel
    assert float(sensor.x_mm(place[1])) == pytest.approx(wanted[1], abs=0.008)
    assert abs(real - ideal) > 0.05


def test_light_falls_off_as_the_cosines_fourth_power_for_a_thin_stop():
    """E ∝ cos⁴ for a stop that nothing magnifies; the landscape lens, whose stop stands before it, is close to that."""
    planned = quick(Sensor(100, 100, 60.0), "landscape")
    shade = illumination(planned.sensor_map(0.0), planned.scene.sensor)
    slope = planned.sensor_map(0.0).fields.slopes(0.0, planned.scene.sensor.corners_mm()[1])[1]
    assert shade[50, 50] == pytest.approx(1, abs=1e-3)
    assert shade[0, 0] == pytest.approx((1 + slope**2) ** -2, abs=0.03)


def test_an_even_object_stays_even_without_its_shading():
    planned = quick(Sensor(60, 80, 10.0))
    planned = replace(planned, scene=replace(planned.scene, near_mm=20000.0))
    for method in ("patches", "lowrank"):
        for depth in (None, np.where(np.arange(80) < 40, 20000.0, np.inf) * np.ones((60, 1))):
            out = form_image(planned, np.full((60, 80, 1), 0.5), depth, Forming(method, geometry=False))
            # Light is kept and not evenness: kernels that change hand a pixel a little more or less than it gave.
            assert np.abs(out - 0.5).max() < 2e-3


@pytest.mark.parametrize("method", ["patches", "lowrank"])
@pytest.mark.parametrize("depth", ["one", "slope", "edge"])
def test_tiles_join_without_a_seam(monkeypatch, method, depth):
    """Tiles as wide as a few kernels, against a single one: the same light to float32, with distortion and edges."""
    scene = Scene(Sensor(90, 120, 80.0, (0.0, 6.0)), GREEN, 3000.0, focus_mm=3000.0, f_number=5.6)
    planned = preview_plan(scene.camera(find_lens("double_gauss_28")), scene)
    planned = replace(planned, counts=(3, 4), vergences=(0.0, 1 / 6000, 1 / 3000))
    picture, slope = draw_chart("landscape", 90, 120)[..., :1], 1 / np.linspace(0, 1 / 3000, 90)[1:]
    depths = {
        "one": None,
        "slope": np.append(np.inf, slope)[:, None] * np.ones((1, 120)),
        "edge": np.where(np.hypot(*np.mgrid[-45:45, -60:60]) < 30, 3000.0, np.inf),
    }

    def by_tiles(side: int) -> np.ndarray:
        monkeypatch.setattr(form, "TILE", side)
        return form_image(planned, picture, depths[depth], Forming(method))

    allowed = form.FLAT * planned.allowed_error * picture.max()
    np.testing.assert_allclose(by_tiles(32), by_tiles(1024), atol=allowed)  # each has its own flat areas
    monkeypatch.setattr(form, "FLAT", -1.0)
    np.testing.assert_allclose(by_tiles(32), by_tiles(1024), atol=3e-6)  # some tens of roundings of white


def test_tiles_in_several_threads_share_one_low_rank(monkeypatch):
    planned, calls = quick(Sensor(40, 50, 10.0)), []
    monkeypatch.setattr(form, "TILE", 16)
    monkeypatch.setattr(form, "decompose", lambda *rest: calls.append(rest) or decompose(*rest))
    with using_threads(4):
        form_image(planned, np.random.default_rng(6).random((40, 50, 1)), None, Forming("lowrank"))
    assert len(calls) == 1


def test_a_preview_shows_the_same_picture():
    scene = Scene(Sensor(660, 660, 30.0))
    picture = draw_chart("landscape", 660, 660)
    small = preview(find_lens("double_gauss_28"), scene, picture)
    assert small.shape == (220, 220, 3)
    whole = form_image(preview_plan(find_lens("double_gauss_28"), scene), picture)
    blocks = whole.reshape(220, 3, 220, 3, 3).mean((1, 3))
    assert np.sqrt(np.mean((small - blocks) ** 2)) < 0.01


def test_progress_is_told_and_cancelling_is_heard():
    planned, told = quick(Sensor(40, 50, 10.0)), []
    picture = np.ones((40, 50, 1), np.float32)
    form_image(planned, picture, watch=Progress(told.append))
    assert told[-1] == 1 and all(0 < part <= 1 for part in told)
    with pytest.raises(Cancelled):
        form_image(planned, picture, watch=Progress(cancelled=lambda: len(told) > 0))


def test_what_does_not_fit_is_one_sentence():
    planned = quick(Sensor(40, 50, 10.0))
    with pytest.raises(RequestError, match="40 rows"):
        form_image(planned, np.ones((40, 40, 1)))
    with pytest.raises(RequestError, match="not finite"):
        form_image(planned, np.full((40, 50, 1), np.nan))
    with pytest.raises(RequestError, match="depth map"):
        form_image(planned, np.ones((40, 50, 1)), np.ones((3, 3)))
    with pytest.raises(RequestError, match="not positive"):
        form_image(planned, np.ones((40, 50, 1)), np.zeros((40, 50)))
    holes = np.full((40, 50), np.inf)
    holes[3, 4] = np.nan
    with pytest.raises(RequestError, match="the first nan mm at row 3, column 4 "):
        form_image(planned, np.ones((40, 50, 1)), holes)
    picture = np.ones((40, 50, 1))
    picture[7, 9] = np.nan
    with pytest.raises(RequestError, match="1 of them, the first at row 7, column 9 "):
        form_image(planned, picture)
    picture[7, 9], picture[8, 2] = -0.25, -3.0
    with pytest.raises(RequestError, match=r"light of -0.25 at row 7, column 9 .* in 2 values"):
        form_image(planned, picture)
    for wrong, words in (({"method": "svd"}, "choose patches or lowrank"), ({"surround": "white"}, "black or edge")):
        with pytest.raises(RequestError, match=words):
            Forming(**wrong)


@pytest.mark.parametrize("method", ["patches", "lowrank"])
@pytest.mark.parametrize("depths", [None, "even", "two"])
def test_black_surrounds_darken_the_border_with_a_map_of_depths_too(method, depths):
    """Of even light, the top row keeps what the kernel sends up from the rows below, and none of it comes from above.

    0.01: the kernel is that of the row itself, not of every row below, and a fit's illumination is 1 to 1e-3. A map of
    two depths a millimetre apart has the same kernels.
    """
    shape, depth_mm = (31, 41), 11000.0
    scene = Scene(Sensor(*shape, 28.0), GREEN, depth_mm - 1, depth_mm, rtol=0.1, focus_mm=22000.0, f_number=4)
    planned = plan(find_lens("double_gauss_28"), scene)
    known = None if depths is None else np.full(shape, depth_mm)
    if depths == "two":
        known[:, :20] -= 1
    how = Forming(method, "black")
    found = form_image(planned, np.ones((*shape, 1)), known, how)[..., 0]
    sensor = scene.sensor
    kernel = planned.kernels(0, 1 / depth_mm).at(float(sensor.x_mm(20)), float(sensor.y_mm(0)))
    assert kernel[: kernel.shape[0] // 2 + 1].sum() < 0.9  # else nothing is tested
    assert found[0, 20] == pytest.approx(kernel[: kernel.shape[0] // 2 + 1].sum(), abs=0.01)


@pytest.mark.parametrize("shape", [(20, 1), (1, 20), (1, 1), (2, 9)])
def test_sensors_of_one_column_or_one_row_have_pictures(shape):
    """An even scene stays even but for the illumination, 3e-3 on so small a sensor; a plan counts no node twice."""
    planned = plan(find_lens("double_gauss_28"), Scene(Sensor(*shape, 14.0), GREEN, rtol=0.1, f_number=4))
    assert all(count <= n for count, n in zip(planned.counts, shape, strict=True))
    for method in ("patches", "lowrank"):
        found = form_image(planned, np.ones((*shape, 1)), how=Forming(method))
        np.testing.assert_allclose(found, 1, atol=3e-3)
