"""Kernels of single pixels against the reference, and the laws they must keep."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.disc.zernike import basis, basis_by_powers
from p2sf.errors import GeometryError
from p2sf.lens.lens import with_f_number, with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.channel import Colour, Kernels, Recipe, own_light, wave_kernels
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.pixels import (
    PixelWindow,
    _sums_over_pixels,
    half_width,
    half_widths,
    pixel_kernel,
    pixel_kernels,
    transform_side,
)
from p2sf.pixel_kernels.pupil_stack import stack_pupils, with_reach
from p2sf.pixel_kernels.pupil_table import chebyshev, lagrange, pupil_table
from p2sf.pixel_kernels.sensor_points import sensor_map
from p2sf.psf.huygens import huygens_psf
from p2sf.pupil.fit import levels
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import pencil, to_the_rim
from p2sf.scene.planning.reference import exact_pixels
from p2sf.scene.scene import Channel
from p2sf.scene.spectrum import reduce_spectrum
from tests.support.binning import bin_samples

WAVE, PIXEL = 0.5876, 6.0
FINE = Recipe("fitted", levels(find_lens("double_gauss_28").aim)[1].numbers, 4.0, 1.0)
GOOD = FINE.numbers


def source(degrees: float) -> Source:
    return Source(np.inf, float(np.tan(np.deg2rad(degrees))), WAVE)


def relative(kernel, good) -> float:
    return float(np.linalg.norm(kernel - good) / np.linalg.norm(good))


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0, 14])
def test_the_fft_of_a_fitted_pupil_is_the_huygens_sum_of_exact_rays(degrees):
    """46 numbers leave 2e-4 waves here, 4πσ = 2.5e-3; the rim's linear share of a cell adds as much."""
    lens = find_lens("double_gauss_28")
    pupil = pupil_map(lens, source(degrees), "fitted", GOOD)
    half = half_width(pupil, PIXEL)
    wide = pixel_kernel(pupil, 0.0, PixelWindow(2 * half, PIXEL, 14))
    kernel = wide[half:-half, half:-half] / wide[half:-half, half:-half].sum()
    assert relative(kernel, exact_pixels(lens, source(degrees), 0.0, half, PIXEL)) < 5e-3


def test_the_reference_of_pixels_is_the_reference_of_the_house_added_up():
    """9 × 9 samples a pixel instead of Gauss points: a pixel's rim falls a twentieth of it beside the truth."""
    lens = find_lens("double_gauss_28")
    fine = huygens_psf(lens, source(10), 25 * 9, PIXEL / 9).values.reshape(25, 9, 25, 9).sum((1, 3))[::-1]
    assert relative(exact_pixels(lens, source(10), 0.0, 12, PIXEL), fine / fine.sum()) < 5e-3


@pytest.mark.parametrize("method", ["seidel", "fitted"])
def test_a_field_to_the_right_is_the_field_upwards_turned(method):
    pupil = pupil_map(find_lens("cooke_triplet"), source(12), method)
    window = PixelWindow(12, 4.0, 5)
    up = pixel_kernel(pupil, 0.0, window)
    for quarter in (1, 2, 3):
        turned = pixel_kernel(pupil, quarter * np.pi / 2, window)
        assert np.abs(np.rot90(up, -quarter) - turned).max() < 2e-6 * up.max() + 1e-9  # float32


@pytest.mark.parametrize("dark", [PupilMask(vanes=3, vane_width=0.03), PupilMask(blades=5, blade_angle_deg=11)])
def test_light_behind_a_mask_reaches_as_far_as_its_farthest_ray(dark):
    """Polynomials mean nothing beyond the rim, where no light is: by rounding it seemed to reach three times as far."""
    for lens in (find_lens("phone_f28"), displaced(find_lens("phone_f28"), 1, 2, Placement(0.02, -0.03))):
        oblique = Source(field_deg=0.7 * max(lens.fields_deg))
        rays = pencil(lens, oblique, *to_the_rim(24))
        farthest = np.hypot(rays.x_um, rays.y_um).max()
        reach = pupil_map(with_mask(lens, dark), oblique, "fitted").reach_um
        assert 0.6 * farthest < reach < 1.02 * farthest  # the outermost nodes lie within the rim


def test_oblique_directions_are_turned_as_the_reference_is():
    lens, angle = find_lens("cooke_triplet"), 0.7
    pupil = pupil_map(lens, source(12), "fitted", GOOD)
    half = half_width(pupil, PIXEL)
    wide = pixel_kernel(pupil, angle, PixelWindow(2 * half, PIXEL, 8))[half:-half, half:-half]
    good = exact_pixels(lens, source(12), angle, half, PIXEL)
    assert relative(wide / wide.sum(), good) < 1e-2
    assert relative(wide[:, ::-1] / wide.sum(), good) > 0.1  # and the mirror image, a wrong sense of turning, is not


def test_pupils_of_a_misaligned_lens_are_turned_too():
    """Fitted in the axes of an oblique field, to PHASE_RESIDUAL: 4πσ = 2.5e-3 of a kernel."""
    lens = displaced(with_f_number(find_lens("double_gauss_28"), 5.6), 3, 5, Placement(0.15, 0.1, 0.02, 0.2, 0.3))
    oblique = Source(np.inf, field_deg=(5.0, 7.0), wavelength_um=WAVE)
    pupil, angle = pupil_map(lens, oblique, "fitted"), np.deg2rad(oblique.azimuth_deg)
    half = half_width(pupil, PIXEL)
    wide = pixel_kernel(pupil, angle, PixelWindow(2 * half, PIXEL, 8))[half:-half, half:-half]
    good = exact_pixels(lens, oblique, angle, half, PIXEL)
    assert relative(wide / wide.sum(), good) < 2.5e-3
    for other in (0.0, -angle):
        assert relative(pixel_kernel(pupil, other, PixelWindow(half, PIXEL, 8)), good) > 0.1


def test_a_shift_moves_the_kernel_by_that_much():
    pupil = pupil_map(find_lens("cooke_triplet"), source(0), "fitted")
    centre = np.arange(-12, 13)
    for shift in ((0.0, 0.0), (3.0, -2.0)):  # the rings' wings, cut on one side sooner, weigh a tenth of a µm or so
        kernel = pixel_kernel(pupil, 0.0, PixelWindow(12, 4.0, 6), shift)
        x, y = (kernel.sum(0) @ centre) * 4, (kernel.sum(1) @ -centre) * 4
        assert np.allclose((x, y), shift, atol=0.2)
        assert kernel.sum(dtype=float) == pytest.approx(1, abs=1e-6)


def test_a_view_finds_the_field_that_lands_where_it_says():
    lens = find_lens("double_gauss_28")
    seen = sensor_map(lens, np.inf, WAVE, 24.0)
    from p2sf.pixel_kernels.sensor_points import chief_heights

    heights = np.linspace(0.1, 23.9, 40)
    landed = chief_heights(lens, Sources(np.inf, seen.fields.slopes(0.0, heights)[1], WAVE))
    assert np.allclose(landed, heights, rtol=0, atol=1e-8)  # a spline's error falls as the fourth power of its steps
    assert seen.ideal_mm(0.0, 0.0) == (0, 0) and -0.02 < 24.0 / seen.ideal_mm(0.0, 24.0)[1] - 1 < -0.005
    assert seen.shift_mm(0.0, 10.0, WAVE) == pytest.approx((0, 0), abs=1e-5) != seen.shift_mm(0.0, 10.0, 0.45)
    with pytest.raises(GeometryError, match="sensor's corner"):
        sensor_map(lens, np.inf, WAVE, 500.0)


def test_fewer_wavelengths_keep_the_spectrums_moments():
    channel = Channel("wide", (480.0, 510.0, 550.0, 600.0, 640.0), (1.0, 3.0, 2.0, 0.5, 1.0))
    waves, shares = channel.wavelengths_um, channel.shares
    for count in (1, 2, 3):
        few = reduce_spectrum(channel, count)
        for power in range(2 * count):
            moment = np.array(few.weights) @ np.array(few.wavelengths_um) ** power
            assert moment == pytest.approx(shares @ waves**power, rel=1e-12)
    assert reduce_spectrum(channel, 5).wavelengths_um == tuple(waves)


def test_kernels_of_a_channel_have_unit_sum_and_carry_lateral_colour():
    seen = sensor_map(find_lens("landscape"), np.inf, WAVE, 15.0)
    colours = Colour((0.45, 0.65), (0.5, 0.5))
    kernel = Kernels(seen, colours, 8.0, Recipe()).at(0.0, 12.0)
    assert kernel.sum(dtype=float) == pytest.approx(1, abs=1e-6)
    single = Kernels(seen, Colour((WAVE,), (1.0,)), 8.0, Recipe()).at(0.0, 12.0)

    def spread(k):
        axis = np.arange(len(k)) - len(k) // 2
        line = k.sum(1)
        return line @ axis**2 - (line @ axis) ** 2

    assert spread(kernel) > spread(single)


def test_pupils_between_a_few_are_the_ones_that_rays_give():
    """Four heights, three depths and colours: phase RMS 2e-4 waves, 4πσ = 2.5e-3 of a kernel; at nodes, the fit."""
    lens, recipe = find_lens("double_gauss_28"), Recipe("fitted", GOOD)
    heights, depths, waves = chebyshev(2.0, 15.0, 4), 1 / chebyshev(1e-5, 2e-4, 3), (0.54, 0.55, 0.56)
    seen = {1 / d: sensor_map(lens, d, WAVE, 16.0) for d in (*depths, 9000.0)}
    nodes = heights, list(seen)[:3], waves
    fits = [own_light(seen[v], 0.0, h, w, recipe) for h in heights for v in nodes[1] for w in waves]
    pupils, landings = zip(*fits, strict=True)
    table = pupil_table(((0.0,), *nodes), stack_pupils(pupils), np.array(landings)[:, 1:])
    between, landed = table.at(0.0, [3.1, 11.7], 1 / 9000.0, 0.545)
    for k, height in enumerate((3.1, 11.7)):
        made, (own, shift) = between.some([k]), own_light(seen[1 / 9000.0], 0.0, height, 0.545, recipe)
        assert np.linalg.norm(made.phase[:, 1:] - own.phase[:, 1:]) < 1e-3
        assert np.abs(made.eta - own.eta).max() < 1e-4 and landed[k] == pytest.approx(shift[1:], abs=2e-5)
        assert made.reach_um == pytest.approx(own.reach_um, rel=0.02)
    node = own_light(seen[1 / depths[1]], 0.0, 15.0, 0.56, recipe)[0]
    assert np.allclose(table.at(0.0, 15.0, 1 / depths[1], 0.56)[0].phase, node.phase, atol=1e-9)
    for place in ((0.0, 15.1, 1e-4, 0.55), (0.1, 5.0, 1e-4, 0.55), (0.0, 5.0, 1e-3, 0.55), (0.0, 5.0, 1e-4, 0.57)):
        with pytest.raises(GeometryError, match="outside the pupils fitted"):  # it never extrapolates
            table.at(*place)


def test_kernels_made_together_are_those_made_alone():
    """With shifts, in windows wider than the chunks of `pixel_kernels` and narrower."""
    lens = find_lens("cooke_triplet")
    pupils = [pupil_map(lens, source(degrees), "fitted") for degrees in (0.0, 7.0, 12.0, 16.0, 20.0)]
    angles, shifts = np.linspace(0.0, 2.0, 5), np.random.default_rng(0).uniform(-3, 3, (5, 2))
    for window in (PixelWindow(8, PIXEL, 5), PixelWindow(30, PIXEL, 6)):
        together = pixel_kernels(stack_pupils(pupils), angles, window, shifts)
        for kernel, pupil, angle, shift in zip(together, pupils, angles, shifts, strict=True):
            alone = pixel_kernel(pupil, float(angle), window, tuple(shift))
            # float32; the pupils' grids are as wide as the widest of those made together
            assert relative(kernel, alone) < 2e-6


@pytest.mark.parametrize("times", [0.7, 1.3])
def test_one_pupil_with_more_or_less_light_than_its_polynomials_give_is_refused_among_good_ones(times):
    """Where they fold, light is counted twice; the refusal says how much of it."""
    good = stack_pupils([pupil_map(find_lens("cooke_triplet"), source(degrees), "fitted") for degrees in (0.0, 7.0)])
    with_reach(good)
    with pytest.raises(GeometryError, match=f"{times:g}\\d* times"):
        with_reach(replace(good, energy=good.energy / [1.0, times]))


def test_interpolation_is_exact_for_polynomials():
    nodes = tuple(chebyshev(-1.0, 3.0, 4).tolist())
    assert lagrange(nodes, 0.7) @ np.power(nodes, 3) == pytest.approx(0.7**3)


def test_a_node_but_for_rounding_is_that_node():
    """Of a polynomial through 200 even nodes nothing is left 1e-10 beside one of them."""
    nodes = tuple(np.linspace(0.0, 3.0, 200).tolist())
    np.testing.assert_array_equal(lagrange(nodes, nodes[7] + 1e-10), np.eye(200)[7])
    assert lagrange(nodes[:5], nodes[2] + 1e-3).sum() == pytest.approx(1)


@pytest.mark.parametrize(("samples", "width"), [(1, 1.0), (2, 1.0), (3, 0.5), (4, 1.0)])
def test_frequencies_that_samples_hold_are_integrated_over_pixels(samples, width):
    """∫cos over the middle of each pixel in closed form, of every frequency below half of the samples' own."""
    window = PixelWindow(3, 6.0, samples)
    side = transform_side(window)
    sums = _sums_over_pixels(window, width)
    edges = np.arange(window.size) * samples + samples / 2 - 0.5 + samples * width / 2 * np.array([[-1.0], [1.0]])
    for turns in range(1, (side + 1) // 2):
        rate = 2 * np.pi * turns / side
        low, high = np.sin(rate * edges + 0.3) / rate
        np.testing.assert_allclose(sums @ np.cos(rate * np.arange(side) + 0.3), high - low, atol=1e-5)
    np.testing.assert_allclose(sums.sum(1), samples * width, rtol=1e-5)


@pytest.mark.parametrize("f_number", [5.6, 16.0])
def test_few_samples_and_a_small_margin_are_enough(f_number):
    """Against 2 samples in λ/2NA and five times the window; wings that were too weak made the rest 1 % brighter."""
    lens = with_f_number(find_lens("double_gauss_28"), f_number)
    pupils = stack_pupils([pupil_map(lens, source(degrees), "fitted") for degrees in (0, 10)])
    halves, turn = half_widths(pupils, PIXEL), np.zeros(2)
    found, good = (
        wave_kernels(pupils, turn, halves, PIXEL, Recipe("fitted", None, *sampling), np.zeros((2, 2)))
        for sampling in ((1.5, 0.5), (2.0, 4.0))
    )
    for one, other in zip(found, good, strict=True):
        assert relative(one / one.sum(), other / other.sum()) < 2.5e-3  # below `SAMPLING_ERRORS` of plans


def test_samples_of_a_cubic_are_summed_over_inner_pixels_without_error():
    """The midpoint rule alone is off by h³/24 of the second derivative in each sample; edges' slopes mend it."""
    place = (np.arange(15) + 0.5) / 3
    values = np.repeat((place**3).astype(np.float32)[:, None], 15, axis=1)
    pixels = bin_samples(values, 5, 3)[1:-1, 2] / 9
    start = np.arange(1, 4)
    np.testing.assert_allclose(pixels, ((start + 1.0) ** 4 - start**4.0) / 4, rtol=1e-5)
    assert bin_samples(values, 5, 3).sum() == pytest.approx(values.sum(), rel=1e-6)


def test_powers_give_the_same_terms():
    points = np.random.default_rng(0).uniform(-0.7, 0.7, (2, 50))
    for order, close in ((6, 1e-12), (18, 1e-8)):
        even, odd = basis_by_powers(order, *points)
        np.testing.assert_allclose(even, basis(order, *points), atol=close)
        np.testing.assert_allclose(odd, basis(order, *points, odd=True), atol=close)
