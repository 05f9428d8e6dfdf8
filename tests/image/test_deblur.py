"""Knowing the PSF sharpens the picture, and knowing a wrong one does so less."""

import numpy as np
import pytest
from scipy.ndimage import convolve

from p2sf.errors import RequestError
from p2sf.image import deblur
from p2sf.image.blur_operator import BlurOperator
from p2sf.image.charts import draw_chart
from p2sf.image.deblur import (
    KERNEL_ERROR,
    estimated_noise,
    photo_statistics,
    psnr,
    richardson_lucy,
    wiener,
    wiener_by_depth,
    with_one_kernel,
)
from p2sf.image.form import plan_lattice
from p2sf.image.lattice import Lattice
from p2sf.image.layers import DepthMap
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from tests.benchmarks import deblurring
from tests.long.sharpening import SIDE, plain_filters, texture
from tests.support.tiers import in_tiers

NOISE, SIZE = 0.002, 160
INNER = (slice(20, -20), slice(20, -20))


@pytest.fixture(scope="module")
def blurred():
    """10 mm off the axis of the Double Gauss at f/3, pixels of 16 µm, noise of a five-hundredth of white."""
    scene = Scene(Sensor(SIZE, SIZE, 16.0, (0.0, 10.0)), (Channel("green", (540.0,), (1.0,)),), rtol=0.05)
    planned = plan(find_lens("double_gauss_28"), scene)
    lattice = plan_lattice(planned, planned.vergences[0])
    chart = draw_chart("siemens_star", SIZE, SIZE)[..., 1:2]
    noise = np.random.default_rng(1).normal(0, NOISE, chart.shape).astype(np.float32)
    on_axis = with_one_kernel(lattice, planned.kernels(0, 0.0).at(0.0, 0.0)[None])
    return chart, BlurOperator(lattice, (SIZE, SIZE)).forward(chart) + noise, lattice, on_axis


def gain(found, chart, picture) -> float:
    return psnr(found[INNER], chart[INNER]) - psnr(picture[INNER], chart[INNER])


def test_wiener_gains_three_decibels_and_the_axis_psf_less(blurred):
    chart, picture, lattice, on_axis = blurred
    right, wrong = (gain(wiener(picture, known, NOISE), chart, picture) for known in (lattice, on_axis))
    assert right >= 3 and wrong < right - 3


def test_richardson_lucy_gains_three_decibels_and_the_axis_psf_less(blurred):
    chart, picture, lattice, on_axis = blurred
    right, wrong = (gain(richardson_lucy(picture, known, 60), chart, picture) for known in (lattice, on_axis))
    assert right >= 3 and wrong < right


@pytest.mark.parametrize("noise", in_tiers([0.001, 0.004, 0.016], (0.001,)))
def test_stated_noise_is_near_the_best_that_can_be_told(monkeypatch, noise):
    """The kernels that blurred the picture are four times as dense: those at hand are wrong, which is noise as well.

    The best of the multiples ½ to 8 of the noise, in dB; the filter that took the noise alone lost 2.2 dB at 0.001.
    """
    monkeypatch.setattr(deblurring, "SENSORS", {"double_gauss_28": deblurring.SENSORS["double_gauss_28"]})
    monkeypatch.setattr(deblurring, "NOISES", (noise,))
    (case,) = deblurring.cases()
    reached = [
        psnr(*(deblurring._inner(x) for x in (wiener(case.blurred, case.lattice, times * noise), case.truth)))
        for times in (0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 8.0)
    ]
    assert reached[2] > max(reached) - 0.3


@pytest.mark.parametrize(
    "sharpen", [lambda *a: richardson_lucy(*a[:2], 3, threads=a[2]), lambda *a: wiener(*a[:2], NOISE, threads=a[2])]
)
def test_any_number_of_threads_gives_the_same_bits(blurred, sharpen):
    _, picture, lattice, _ = blurred
    assert np.array_equal(sharpen(picture, lattice, 1), sharpen(picture, lattice, 3))


@pytest.mark.parametrize("sigma", [0.003, 0.02])
def test_noise_is_estimated_beside_slopes_edges_and_fine_structure(sigma):
    """10 %: of 10⁵ pixels noise alone leaves 0.5 %, and the chart's own structure, blurred by two pixels, the rest."""
    from scipy.ndimage import gaussian_filter

    picture = gaussian_filter(draw_chart("landscape", 256, 384), (1.5, 1.5, 0))
    noisy = picture + np.random.default_rng(0).normal(0, sigma, picture.shape)
    assert estimated_noise(noisy) == pytest.approx(sigma, rel=0.1)
    rows, columns = np.mgrid[:40, :50]
    assert estimated_noise((0.1 * rows - 0.2 * columns)[..., None]) < 1e-12
    with pytest.raises(RequestError, match="at least 3 × 3"):
        estimated_noise(np.zeros((2, 9, 1)))


@pytest.mark.parametrize("shape", [(24, 30, 1), (80, 80, 1), (500, 700, 3)])
def test_noise_alone_is_estimated_without_bias(shape):
    """The mean of many pictures to 2 %, whatever their size, and where a part of them is clipped."""
    random = np.random.default_rng(0)
    several = [random.normal(0, 0.01, shape) for _ in range(200 if shape[0] < 100 else 4)]
    assert np.mean([estimated_noise(one) for one in several]) == pytest.approx(0.01, rel=0.02)
    several[0][: shape[0] // 4] = 1.0
    assert estimated_noise(several[0]) == pytest.approx(0.01, rel=0.3 if shape[0] < 100 else 0.03)


def test_texture_is_no_noise():
    """Three quarters of random texture of twenty times the noise, which the median of all took for noise: 20 %."""
    random = np.random.default_rng(0)
    noisy = random.normal(0, 0.005, (256, 256, 1))
    noisy[:, 64:] += random.normal(0, 0.1, (256, 192, 1))
    assert estimated_noise(noisy) == pytest.approx(0.005, rel=0.2)


@pytest.mark.parametrize(("lens", "noise"), [("double_gauss_28", 0.002), ("landscape", 0.01)])
def test_estimated_noise_sharpens_nearly_as_stated_noise_does(monkeypatch, lens, noise):
    """Within 0.3 dB, and 0.3 dB better than the median over the whole picture (Immerkær's mask), edges and all."""
    monkeypatch.setattr(deblurring, "SENSORS", {lens: deblurring.SENSORS[lens]})
    monkeypatch.setattr(deblurring, "NOISES", (noise,))
    (case,) = deblurring.cases()
    second = np.array([1.0, -2.0, 1.0])
    mask = np.abs(convolve(case.blurred, np.multiply.outer(second, second)[..., None])).ravel()
    estimated, stated, by_median = (
        psnr(*(deblurring._inner(x) for x in (wiener(case.blurred, case.lattice, told), case.truth)))
        for told in (photo_statistics(case.blurred, case.lattice), noise, 1.4826 * np.median(mask) / 6)
    )
    assert estimated > stated - 0.3 and estimated > by_median + 0.3


def test_without_noise_stated_wiener_refuses(blurred):
    _, picture, lattice, _ = blurred
    with pytest.raises(RequestError, match="noise"):
        wiener(picture, lattice, 0.0)
    with pytest.raises(RequestError, match="at least 1"):
        richardson_lucy(picture, lattice, 0)


def one_kernel(kernel: np.ndarray) -> Lattice:
    middle = np.array([(SIDE - 1) / 2])
    return Lattice(middle, middle, [[kernel[None].astype(np.float32)]])


def disc(radius: float) -> np.ndarray:
    """Return the blur of a defocused point, edges averaged over a tenth of a pixel."""
    half = int(radius) + 1
    fine = (np.arange(10 * (2 * half + 1)) + 0.5) / 10 - half - 0.5
    inside = (np.hypot(fine, fine[:, None]) <= radius).reshape(2 * half + 1, 10, 2 * half + 1, 10).mean((1, 3))
    return inside / inside.sum()


def gaussian(sigma: float) -> np.ndarray:
    x = np.arange(-5, 6)
    kernel = np.exp(-(x**2 + x[:, None] ** 2) / (2 * sigma**2))
    return kernel / kernel.sum()


def photographed(scene: np.ndarray, kernel: np.ndarray, noise: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the middle of a larger scene, and its photo: what lies beyond the border is real, and nobody knows it."""
    from scipy.signal import fftconvolve

    more = (len(scene) - SIDE) // 2
    inner = np.s_[more : more + SIDE, more : more + SIDE]
    photo = fftconvolve(scene, kernel, mode="same")[inner]
    photo = photo + np.random.default_rng(4).normal(0, noise, photo.shape)
    return scene[inner][..., None], photo[..., None].astype(np.float32)


SCENES = {
    "1/f": texture(2 * SIDE),
    "bimodal": 0.1 + 0.8 * (texture(2 * SIDE, 3) > 0.5),
    "chart": np.pad(draw_chart("landscape", SIDE, SIDE)[..., 0].astype(float), SIDE // 2, mode="symmetric"),
}


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("kernel", [gaussian(0.3), gaussian(0.5), gaussian(1.0), disc(6.3), disc(20.3)])
@pytest.mark.parametrize("noise", [0.001, 0.02])
def test_no_sharpened_picture_is_farther_from_its_scene(scene, kernel, noise):
    """0.05 dB: one draw of noise in 160² pixels.

    A filter that took texture for noise lost 4 to 11 dB at 0.001, one that knew nothing of borders 3 to 13 dB, and one
    that took a part of the chart's spectrum for noise beyond what is stated 0.3 dB.
    """
    truth, photo = photographed(SCENES[scene], kernel, noise)
    lattice = one_kernel(kernel)
    for told in (photo_statistics(photo, lattice), noise):
        assert psnr(wiener(photo, lattice, told), truth) > psnr(photo, truth) - 0.05


@pytest.mark.parametrize("kernel", [gaussian(0.5), gaussian(1.0), disc(2.4), disc(6.3)])
def test_bimodal_pictures_are_as_sharp_as_a_plain_filter_makes_them(kernel):
    """The plain filter has the constant that serves best, which nobody knows: half a decade beside it is allowed.

    The kernels are wrong by what the filter allows for, random numbers of that norm. With kernels that are right it is
    up to 2 dB below the plain filter, and equal to 0.05 dB if it allows for nothing.
    """
    truth, photo = photographed(SCENES["bimodal"], kernel, 0.001)
    wrong = np.random.default_rng(0).normal(size=kernel.shape)
    lattice = one_kernel(kernel + KERNEL_ERROR * np.linalg.norm(kernel) * wrong / np.linalg.norm(wrong))
    plain = plain_filters(photo, lattice, truth)
    best = int(np.argmax(plain))
    found = psnr(wiener(photo, lattice, photo_statistics(photo, lattice)), truth)
    assert found > max(plain[best - 1], plain[best + 1])


def test_without_allowances_the_filter_is_the_plain_one_of_the_best_constant(monkeypatch):
    """A Gaussian blur, in which borders matter little: 0.05 dB, one draw of noise."""
    monkeypatch.setattr(deblur, "KERNEL_ERROR", 0.0)
    monkeypatch.setattr(deblur, "BORDER_ERROR", 0.0)
    for kernel in (gaussian(0.5), gaussian(1.0)):
        truth, photo = photographed(SCENES["bimodal"], kernel, 0.001)
        lattice = one_kernel(kernel)
        found = psnr(wiener(photo, lattice, photo_statistics(photo, lattice)), truth)
        assert found > max(plain_filters(photo, lattice, truth)) - 0.05


def test_each_depth_is_sharpened_by_its_own_kernels():
    """The half in focus was 29 dB worse by the kernels of the other half, which gains; beside the jump all stays."""
    truth, near = photographed(SCENES["1/f"], gaussian(0.5), 0.001)
    _, far = photographed(SCENES["1/f"], disc(4.3), 0.001)
    place, beside = np.zeros((SIDE, SIDE), np.float32), np.zeros((SIDE, SIDE), bool)
    place[:, SIDE // 2 :], beside[:, SIDE // 2 - 6 : SIDE // 2 + 6] = 1, True
    photo = np.where(place[..., None] == 1, near, far)
    lattices = one_kernel(disc(4.3)), one_kernel(gaussian(0.5))
    for noise in (None, 0.001):
        found = wiener_by_depth(photo, DepthMap(place, beside, beside), lattices.__getitem__, noise)
        np.testing.assert_array_equal(found[beside], photo[beside])
        gains = [
            psnr(found[:, part], truth[:, part]) - psnr(photo[:, part], truth[:, part])
            for part in (np.s_[: SIDE // 2 - 6], np.s_[SIDE // 2 + 6 :])
        ]
        assert gains[0] > 1 and gains[1] > -0.05


@pytest.mark.parametrize("shape", [(1, 1, 1), (1, 64, 3), (64, 2, 1), (3, 3, 1)])
@pytest.mark.parametrize("noise", [None, 0.01])
def test_a_picture_of_a_few_pixels_has_no_spectrum(blurred, shape, noise):
    _, _, lattice, _ = blurred
    with pytest.raises(RequestError, match="at least 4 × 4"):
        photo_statistics(np.ones(shape, np.float32), lattice, noise)
    assert photo_statistics(np.ones((4, 4, 1), np.float32), lattice, noise).high > 0
