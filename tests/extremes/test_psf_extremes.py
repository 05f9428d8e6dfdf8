"""The PSF at the extremes: sampling, energy, precision, pitch, size and symmetry."""

from time import perf_counter

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import chord_rows, even_count, grid_rows
from p2sf.disc.transform import padded_fft
from p2sf.errors import GeometryError, SamplingError
from p2sf.lens.lens import with_f_number
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.seidel import (
    energy_fraction,
    fft_intensity,
    fft_samples,
    plain_intensity,
    seidel_psf,
    suitable_pixel_um,
)
from p2sf.psf.seidel_sum import intensities, wave_number
from tests.long.settled_sampling import PROMISE, error_of, random_case
from tests.support.reference import prescription_lens
from tests.support.tiers import in_tiers
from tests.support.waves import NA, WAVELENGTH_UM, relative_l2, waves

LAMBDA_NA = WAVELENGTH_UM / NA
RANDOM = np.random.default_rng(7)


@pytest.mark.parametrize("seed", range(50))
def test_settled_sampling_holds_its_promise(seed):
    """The first fifty of the two thousand cases of ``python -m tests.long.settled_sampling``."""
    words, *case = random_case(seed)
    assert error_of(*case) <= PROMISE, words


def test_settled_sampling_fails_where_the_slope_is_misjudged():
    """The measure can fail: too few nodes for a steep case are far from converged."""
    steep = waves(w40=40.0)
    few, fine = (intensities(steep, 16, 1.0, chord_rows(n, n), np.float64) for n in (150, 1600))
    assert relative_l2(few, fine) > 100 * PROMISE


@pytest.mark.parametrize("six", RANDOM.normal(size=(6, 6)) * [[0], [1e-3], [1], [10], [50], [200]])
@pytest.mark.parametrize("dtype, tolerance", [(np.float64, 1e-10), (np.float32, 1e-5)])
def test_energy_inside_and_outside_any_window_is_all_the_energy(six, dtype, tolerance):
    """Parseval: over a whole period of a uniform pupil grid, Σ|field|² = period²·Σ|weight|², whatever W."""
    grid, period = grid_rows(128), 160
    c = waves(*six)
    cycles = 128 / (2 * period)  # a grid of step 2/128 repeats after 64 cycles
    whole = intensities(c, period, cycles * LAMBDA_NA, grid, dtype).astype(float)
    # The folded weights count four nodes at once; each alone has a quarter.
    total = period**2 * 4 * np.sum((grid.weight / 4) ** 2)
    assert abs(whole.sum() / total - 1) <= tolerance
    window = np.zeros((period, period), bool)
    window[60:90, 71:97] = True
    assert abs((whole[window].sum() + whole[~window].sum()) / total - 1) <= tolerance


def test_the_padded_fft_has_the_energy_of_the_pupil():
    rng = np.random.default_rng(3)
    pupil = rng.normal(size=(24, 24)) * np.exp(2j * np.pi * rng.random((24, 24)))  # apodised at will
    pupil[5:9, 14:] = 0  # and vignetted
    plane = padded_fft(pupil, 96, 48)
    middle = np.fft.ifft2(np.pad(pupil, 36), norm="forward")
    assert abs((np.abs(middle) ** 2).sum() / (96**2 * (np.abs(pupil) ** 2).sum()) - 1) < 1e-12
    inside = (np.abs(plane) ** 2).sum()
    shown = np.fft.fftshift(np.abs(middle) ** 2)[24:72, 24:72]
    assert abs(inside / shown.sum() - 1) < 1e-12


@pytest.mark.parametrize("size", [1e-3, 1.0, 30.0, 200.0])
def test_float32_keeps_the_settled_promise(size):
    c = waves(*(size * np.array([0.4, -0.5, 0.3, 0.2, 0.0, -0.2])))
    single, double = (seidel_psf(c, 32, 1.0, dtype=dtype).values for dtype in (np.float32, np.float64))
    assert relative_l2(single, double) < PROMISE


@pytest.mark.parametrize("fraction", [0.01, 0.1, 1.0, 10.0])
def test_matrix_dft_is_the_plain_formula_at_any_pitch(fraction):
    c = waves(0.8, -1.2, 0.7, 0.3, 5.0, -0.4)
    pitch = fraction * LAMBDA_NA
    found = seidel_psf(c, 24, pitch)
    plain = plain_intensity(c, 24, pitch)
    # Two different rules, each of which promises 1e-4; at these small slopes they keep far more.
    assert relative_l2(found.values, plain / plain.sum()) < PROMISE / 100


@pytest.mark.parametrize("fraction", in_tiers([0.01, 0.1, 0.5], [0.1, 0.5]))
def test_fft_agrees_with_matrix_dft(fraction):
    """The FFT's pupil is a square grid with weighted edge cells: second order, 1e-2 at 64 samples per radius."""
    c = waves(0.3, 0.4, -0.2)
    pitch = fraction * LAMBDA_NA
    samples = int(2 * np.ceil(128 / fraction / 2))
    ours = fft_intensity(c, 16, pitch, min(samples, 4096))
    assert relative_l2(ours, plain_intensity(c, 16, pitch)) < 5e-3


def test_a_window_of_one_sample():
    for six in ((0.0,), (3.0, 1.0, -2.0)):
        found = seidel_psf(waves(*six), 1, 1.0)
        assert found.values.shape == (1, 1) and found.values[0, 0] == 1.0
        assert found.sum_over_peak == pytest.approx(float(plain_intensity(waves(*six), 1, 1.0)[0, 0]), rel=PROMISE / 10)


def test_a_window_of_a_thousand_samples():
    c = waves(0.5, 1.0, -0.5)
    found = seidel_psf(c, 1023, 0.05 * LAMBDA_NA)
    assert abs(found.values.sum() - 1) < 1e-12 and np.isfinite(found.values).all()
    # Its middle is the PSF of a small window.
    small = plain_intensity(c, 31, 0.05 * LAMBDA_NA)
    middle = found.values[511 - 15 : 511 + 16, 511 - 15 : 511 + 16]
    assert relative_l2(middle / middle.sum(), small / small.sum()) < 1e-8
    np.testing.assert_allclose(found.values, found.values[:, ::-1], atol=1e-13)


def test_no_wavefront_at_all_is_airy_to_ten_digits():
    """(2J1(v)/v)², Airy 1835, with J1 as its integral: W exactly 0, peak exactly 1."""
    pitch = 0.07 * LAMBDA_NA
    values = intensities(waves(), 33, pitch, chord_rows(64, 64), np.float64)
    v = 2 * np.pi * 0.07 * np.hypot(*np.meshgrid(centred_axis(33), centred_axis(33)))
    angle = (np.arange(400) + 0.5) * (np.pi / 400)
    bessel = np.cos(angle - v[..., None] * np.sin(angle)).mean(-1)
    airy = np.divide(2 * bessel, v, out=np.ones_like(v), where=v > 0) ** 2
    np.testing.assert_allclose(values, airy, atol=1e-12)
    assert abs(values[16, 16] - 1) < 1e-14


def test_a_lens_on_axis_gives_a_picture_symmetric_to_rounding():
    lens = prescription_lens("double_gauss_28", 587.5618)
    values = seidel_psf(coefficients(lens, np.inf, 0.0, 0.5875618), 65).values
    for turned in (values[::-1], values[:, ::-1], values[::-1, ::-1]):
        np.testing.assert_allclose(values, turned, rtol=0, atol=1e-13)


def double_gauss_at(number: float):
    lens = with_f_number(prescription_lens("double_gauss_28", 587.5618), number)
    return coefficients(lens, np.inf, 0.0, 0.5875618)


def test_a_ten_thousandth_aperture_has_a_picture():
    found = double_gauss_at(1e4)
    psf = seidel_psf(found, 16, 0.2 / abs(float(wave_number(found))))
    assert abs(psf.values.sum() - 1) < 1e-12 and np.isfinite(psf.values).all() and 0 < psf.strehl <= 1 + 1e-12


def test_a_half_aperture_of_ten_thousand_waves_is_refused_in_words():
    found = double_gauss_at(0.5)
    with pytest.raises(SamplingError, match=r"phase slope of \d+ waves"):
        seidel_psf(found, 16, 0.2 / abs(float(wave_number(found))))


def test_scaling_lens_and_wavelength_leaves_the_picture_alone():
    six = (0.5, -1.0, 0.8, 0.0, 0.0, 0.3)
    first = seidel_psf(waves(*six), 24, 0.3 * LAMBDA_NA).values
    for k in (1e-6, 1e6):
        again = seidel_psf(waves(*six, wavelength_um=WAVELENGTH_UM * k), 24, 0.3 * LAMBDA_NA * k).values
        np.testing.assert_allclose(again, first, rtol=0, atol=1e-13)


@pytest.mark.parametrize("six", [(np.inf,), (0.0, np.nan), (1e308, 1e308, 0.0)])
def test_a_wavefront_without_numbers_is_refused_in_words(six):
    with np.errstate(over="ignore", invalid="ignore"), pytest.raises(GeometryError, match="not finite"):
        seidel_psf(waves(*six), 8, 1.0)


def test_a_psf_says_how_it_was_made():
    one = seidel_psf(waves(w40=0.5), 16, 1.0)
    quick = seidel_psf(waves(w40=0.5), 16, 1.0, "preview")
    exact = seidel_psf(waves(w40=0.5), 16, 1.0, "preview", dtype=np.float64)
    assert [psf.sampling.values["precision"] for psf in (one, quick, exact)] == ["float64", "float32", "float64"]
    assert (one.numbers, one.rays, one.method, one.pixel_um) == (6, 2, "seidel", 1.0)
    assert isinstance(one.wavelength_um, float) and isinstance(one.strehl, float) and one.wavelength_um == WAVELENGTH_UM
    stack = seidel_psf(waves(w40=np.zeros(3), wavelength_um=np.array([0.4, 0.5, 0.6])), 8, 1.0)
    np.testing.assert_array_equal(stack.wavelength_um, [0.4, 0.5, 0.6])
    assert stack.strehl.shape == stack.energy.shape == (3,)


def test_one_sample_is_as_wide_as_the_whole_picture():
    c = waves(w40=1.0)
    assert suitable_pixel_um(c, 1) == pytest.approx(2 * suitable_pixel_um(c, 2), rel=1e-15)
    assert suitable_pixel_um(c, 0) == suitable_pixel_um(c, 1) == 64 * suitable_pixel_um(c)


def test_the_padded_fft_takes_what_window_blur_and_rim_ask_for():
    """NA·pixel/λ is 0.2 at 1 µm: a rim of 64 or 256 samples, a blur of |∇W|/0.2 on both sides, or twice the window."""
    assert (fft_samples(waves(), 16, 1.0), fft_samples(waves(), 16, 1.0, "settled")) == (
        even_count(320),
        even_count(1280),
    )
    assert fft_samples(waves(), 400, 1.0) == even_count(800)
    assert fft_samples(waves(w40=100.0), 16, 1.0) == even_count(2 * 2000 + 16)
    assert fft_samples(waves(w40=249.0), 16, 2.5) == even_count(4000)  # its pupil is as wide and just fits
    with pytest.raises(SamplingError, match="too large; use mdft or change the pixel"):
        fft_samples(waves(w40=256.0), 16, 2.5)
    for quality, count in (("settled", 1280), ("preview", 320)):
        assert seidel_psf(waves(), 16, 1.0, quality, "fft").sampling.values == {"samples": even_count(count)}


def test_a_stack_by_the_padded_fft_is_its_members():
    stack = seidel_psf(waves(w40=np.array([0.2, 0.4]), wd=np.array([[0.0], [0.3], [0.6]])), 16, 1.0, sampling="fft")
    assert stack.values.shape == (3, 2, 16, 16)
    one = seidel_psf(waves(w40=0.4, wd=0.6), 16, 1.0, sampling="fft").values
    np.testing.assert_allclose(stack.values[2, 1], one, rtol=0, atol=1e-15)


def test_a_stack_of_no_psfs_is_empty_and_needs_a_pixel():
    nothing = waves(w40=np.zeros((2, 0)))
    for sampling, words in (("mdft", "no nodes, float64"), ("fft", "FFT of 0 × 0 pupil samples")):
        found = seidel_psf(nothing, 16, 1.0, sampling=sampling)
        assert (found.values.shape, found.strehl.shape, found.energy.shape) == ((2, 0, 16, 16), (2, 0), (2, 0))
        assert str(found.sampling) == words
    with pytest.raises(SamplingError, match=r"^an empty stack of PSFs has no width of its own; give the pixel in µm$"):
        seidel_psf(nothing, 16)


@pytest.mark.parametrize("pixels", [1, 40, 64])
def test_the_window_is_twice_the_blur_and_five_airy_radii_wide(pixels):
    """Half of it: |∇W| λ/NA for the farthest ray, 4 waves of slope for W40 = 1, and 5 of 0.60983 λ/NA for the rest."""
    width = 2 * (4.0 + 5 * 0.60983494563325) * LAMBDA_NA
    assert pixels * float(suitable_pixel_um(waves(w40=1.0), pixels)) == pytest.approx(width, rel=1e-6)
    assert seidel_psf(waves(w40=1.0), pixels).pixel_um == pytest.approx(width / pixels, rel=1e-6)


def test_a_psf_has_64_samples_unless_told_and_tells_its_time():
    begun = perf_counter()
    found = seidel_psf(waves(w40=0.5))
    assert found.values.shape == (64, 64)
    assert 0 < found.seconds <= perf_counter() - begun
    assert type(found.energy) is float and type(seidel_psf(waves(w40=np.zeros(2)), 8).energy) is not float


def test_an_fft_too_large_by_its_samples_or_by_its_pupil_is_refused():
    """Either alone is enough: a blur asks for many samples, a wide pixel for a wide pupil."""
    for six, pixel in (({"w40": 120.0}, 1.0), ({}, 400.0)):
        with pytest.raises(SamplingError, match="too large"):
            fft_samples(waves(**six), 16, pixel)


def test_half_a_cycle_a_sample_is_still_an_integral():
    """At λ/(2 NA) a sample the intensity is just resolved (Shannon): the energy is known there, and not beyond."""
    for share, known in ((0.5, True), (0.5 + 1e-9, False)):
        assert (energy_fraction(waves(), np.ones(()), share * LAMBDA_NA) is not None) == known


@pytest.mark.parametrize("name", ["w40", "w31", "w22", "w20", "wd"])
def test_the_coefficient_that_is_no_number_is_named(name):
    with pytest.raises(GeometryError, match=f"^{name} is not finite, so there is no wavefront"):
        seidel_psf(waves(**{name: np.nan}), 8, 1.0)


def test_coefficients_too_large_to_add_are_told_together():
    for name in ("w31", "w22", "w20", "wd", "na"):
        with np.errstate(over="ignore"), pytest.raises(GeometryError, match=r"^their sum is not finite"):
            seidel_psf(waves(w40=1.7e308, **{name: 1.7e308}, sign=1), 8, 1.0)
