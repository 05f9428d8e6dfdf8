"""What is read off a PSF, against the closed forms of the perfect pupil."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import j0, j1, jn_zeros

from p2sf.errors import SamplingError
from p2sf.figures.perfect import airy_radius_um, diffraction_mtf
from p2sf.figures.psf_data import PsfFigures
from p2sf.figures.window import centroid, encircled_energy, mtf, peak, profiles, radius_of_energy, resolved
from p2sf.psf.result import Psf
from p2sf.psf.seidel import seidel_psf
from tests.support.waves import NA, WAVELENGTH_UM, waves

AIRY = seidel_psf(waves(), 255, 0.5)


def gaussian(sigma_um=3.0, x0=0.0, y0=0.0, pixels=64, pixel_um=1.0):
    blank = Psf(np.empty((pixels, pixels)), pixel_um, 0.5, "test", PsfFigures(strehl=1.0))
    square = (blank.x_um - x0) ** 2 + (blank.y_um[:, None] - y0) ** 2
    values = np.exp(-square / (2 * sigma_um**2))
    return replace(blank, values=values / values.sum())


def test_airy_radius_is_the_first_zero_of_j1():
    assert airy_radius_um(0.5, 0.1) == pytest.approx(jn_zeros(1, 1)[0] / (2 * np.pi) * 5, rel=1e-7)


def test_encircled_energy_of_the_airy_pattern_is_rayleighs():
    """1 − J0² − J1²; 2e-3 is what flat samples of a sixth of the Airy radius leave (measured 1.3e-3)."""
    curve = encircled_energy(AIRY, centre=(0, 0))
    inside = curve.radius_um < 60
    v = 2 * np.pi * NA / WAVELENGTH_UM * curve.radius_um[inside]
    np.testing.assert_allclose(curve.fraction[inside] * AIRY.energy, 1 - j0(v) ** 2 - j1(v) ** 2, atol=2e-3)


@pytest.mark.parametrize("x0", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("sigma", [1.0, 3.0])
def test_radius_of_energy_of_a_gaussian_wherever_it_falls_between_the_pixels(sigma, x0):
    """σ√(−2 ln(1 − f)) to a few hundredths of a pixel even at σ = 1 pixel; whole pixels err by half of one."""
    psf = gaussian(sigma, x0, -0.2)
    for fraction in (0.5, 0.8):
        exact = sigma * np.sqrt(-2 * np.log(1 - fraction))
        assert float(radius_of_energy(psf, fraction)) == pytest.approx(exact, abs=0.03)


def test_radius_and_curve_agree():
    psf = seidel_psf(waves(w31=1.0, w22=1.0), 64)
    curve = encircled_energy(psf, radius_um=np.array([float(radius_of_energy(psf, f)) for f in (0.2, 0.5, 0.8)]))
    np.testing.assert_allclose(curve.fraction, (0.2, 0.5, 0.8), atol=1e-9)


def test_all_the_windows_light_is_within_its_corner_and_none_within_nothing():
    curve = encircled_energy(gaussian())
    assert curve.fraction[0] == 0
    assert curve.fraction[-1] == pytest.approx(1, abs=1e-12)
    assert np.diff(curve.fraction).min() > -1e-12


@pytest.mark.parametrize("fraction", [0, -1, 1.01])
def test_impossible_fractions_are_refused(fraction):
    with pytest.raises(SamplingError, match="between 0 and 1"):
        radius_of_energy(AIRY, fraction)


def test_centroid_is_where_the_light_balances():
    x, y = centroid(gaussian(2.0, 0.7, -1.3))
    assert (x, y) == (pytest.approx(0.7, abs=1e-9), pytest.approx(-1.3, abs=1e-9))


@pytest.mark.parametrize("pixels", [31, 32])
def test_the_centroid_of_a_symmetric_psf_is_its_centre_in_any_window(pixels):
    """Airy's wings fall as 1/r³: the unpaired row and column of an even window alone would draw it to one side."""
    symmetric = seidel_psf(waves(), pixels, 1.0)
    assert centroid(symmetric) == (0.0, 0.0)
    coma = seidel_psf(waves(w31=0.5), pixels, 1.0)
    assert centroid(coma)[0] == 0.0 and abs(centroid(coma)[1]) > 0.1


def test_centroid_of_coma_is_the_mean_ray():
    """The PSF's first moment is λ/(n'u') times the mean of ∂W/∂η, which is W31; the window keeps most of it."""
    c = waves(w31=-2.0)
    x, y = centroid(seidel_psf(c, 256, 2.0))
    assert abs(x) < 0.05
    assert y == pytest.approx(2.0 * WAVELENGTH_UM / NA, rel=0.05)


def test_the_peak_is_the_highest_sample():
    psf = seidel_psf(waves(w31=-1.0), 65, 0.5)
    x, y = peak(psf)
    assert x == 0
    assert y > 0
    assert psf.values[np.flatnonzero(psf.y_um == y)[0], 32] == psf.values.max()


def test_profiles_run_through_the_point_they_name():
    psf = gaussian(3.0, 4.0, -6.0)
    chief, top = profiles(psf), profiles(psf, "peak")
    np.testing.assert_array_equal(chief.along_x, psf.values[32])
    np.testing.assert_array_equal(top.along_x, psf.values[26])
    np.testing.assert_array_equal(top.along_y, psf.values[:, 36])
    with pytest.raises(SamplingError, match="chief"):
        profiles(psf, "middle")


def test_mtf_of_the_perfect_pupil_is_the_closed_form():
    """Up to the light that the window misses, 0.7 % here."""
    curve = mtf(AIRY)
    exact = diffraction_mtf(curve.frequency_per_mm, NA, WAVELENGTH_UM)
    for contrast in (curve.tangential, curve.sagittal):
        np.testing.assert_allclose(contrast, exact, atol=1.1 * (1 - AIRY.energy))
    assert curve.tangential[0] == pytest.approx(1, abs=1e-12)


def test_nothing_passes_beyond_the_cutoff():
    assert diffraction_mtf(2 * NA / WAVELENGTH_UM * 1000 * np.array([0, 1, 1.5]), NA, WAVELENGTH_UM).tolist() == [
        1,
        0,
        0,
    ]


def test_a_line_blurred_along_y_loses_tangential_contrast():
    """Straight lines of light along y: patterns that vary along y vanish, those along x stay."""
    values = np.zeros((16, 16))
    values[:, 8] = 1 / 16
    curve = mtf(replace(gaussian(), values=values), np.array([1000 / 16]))
    assert (curve.tangential[0], curve.sagittal[0]) == (pytest.approx(0, abs=1e-12), pytest.approx(1))


def test_every_measure_takes_a_stack():
    stack = seidel_psf(waves(w31=np.array([[0.0, 1.0, 2.0]])), 32)
    assert centroid(stack)[1].shape == peak(stack)[0].shape == radius_of_energy(stack).shape == (1, 3)
    assert encircled_energy(stack).fraction.shape == (1, 3, 64)
    assert mtf(stack).tangential.shape == (1, 3, 33)
    assert profiles(stack, "peak").along_y.shape == (1, 3, 32)
    one = replace(stack, values=stack.values[0, 2])
    assert radius_of_energy(stack)[0, 2] == pytest.approx(float(radius_of_energy(one)))
    np.testing.assert_array_equal(profiles(stack, "peak").along_y[0, 2], profiles(one, "peak").along_y)


def test_contrast_beyond_the_nyquist_frequency_is_unknown_and_not_a_mirror_image():
    psf = seidel_psf(waves(w40=1.0), 64, 2.0)
    curve = mtf(psf, np.array([0.0, 249.0, 250.0, 251.0, 500.0]))  # Nyquist 250 per mm
    assert np.isnan(curve.tangential).tolist() == np.isnan(curve.sagittal).tolist() == [False] * 3 + [True] * 2


def test_samples_hold_a_psf_up_to_a_pitch_of_a_quarter_of_lambda_over_na():
    limit = WAVELENGTH_UM / (4 * NA)
    assert resolved(seidel_psf(waves(), 16, limit), NA) and not resolved(seidel_psf(waves(), 16, 1.01 * limit), NA)


def test_contrast_of_samples_too_far_apart_for_the_aperture_is_refused():
    psf = seidel_psf(waves(), 16, 1.01 * WAVELENGTH_UM / (4 * NA))
    with pytest.raises(SamplingError, match=r"16 samples .* apart hold no contrast"):
        mtf(psf, na=NA)
    assert mtf(psf).tangential[0] == pytest.approx(1)  # an aperture that nobody states cannot be judged
