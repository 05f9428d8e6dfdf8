"""Figures of a PSF by its samples, and what its window may hide of them."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from scipy.special import j0, j1

import p2sf
from p2sf.errors import P2SFError, SamplingError

NA, NM = 0.1, 500.0
PER_UM = NA / (NM / 1000)
AIRY = p2sf.psf_of_opd(np.zeros((256, 256)), NA, NM, pixels=128, pixel_um=0.5)
LENS = p2sf.load_lens("double_gauss_28")


def test_contrast_is_that_of_airy_within_the_error_of_its_window():
    nu = np.linspace(0, 0.99, 34)
    exact = 2 / pi * (np.arccos(nu) - nu * np.sqrt(1 - nu * nu))
    for pixels in (24, 48, 128):
        psf = p2sf.psf_of_opd(np.zeros((256, 256)), NA, NM, pixels=pixels, pixel_um=0.5)
        found = psf.mtf(nu * 2000 * PER_UM)
        off = max(np.abs(curve - exact).max() for curve in (found.tangential, found.sagittal))
        assert 0.1 * found.predicted_error < off < found.predicted_error == pytest.approx(2 * (1 - psf.energy))


def test_energy_is_that_of_airy():
    """By samples of half a µm, and by those of λ/(4 NA), which hold as much; the wings beyond the window ring: 5e-4."""
    radius = np.array([1.0, 2.0, 3.05, 8.0])
    v = 2 * pi * PER_UM * radius
    coarse = p2sf.psf_of_opd(np.zeros((256, 256)), NA, NM, pixels=96)
    for psf in (AIRY, coarse):
        found = psf.encircled_energy(radius)
        np.testing.assert_allclose(found.fraction, 1 - j0(v) ** 2 - j1(v) ** 2, atol=5e-4)
    assert found.predicted_error == 0 and AIRY.encircled_energy([40.0]).predicted_error == 1 - AIRY.energy
    assert found.radius_80_um == pytest.approx(
        p2sf.Pupil.from_opd(np.zeros((256, 256)), NA, NM).encircled_energy().radius_80_um, rel=5e-3
    )


def test_what_the_window_does_not_hold_has_no_radius():
    with pytest.warns(p2sf.P2SFWarning):
        small = p2sf.psf_of_opd(np.zeros((64, 64)), NA, NM, pixels=4, pixel_um=0.5)
    assert np.isnan(small.encircled_energy([1.0]).radius_80_um)


def test_lines_are_the_sums_of_columns():
    found = AIRY.line_spread()
    np.testing.assert_allclose(found.line_x, AIRY.values.sum(0) / 0.5 / np.trapezoid(AIRY.values.sum(0)), rtol=2e-2)
    odd = p2sf.psf_of_opd(np.zeros((256, 256)), NA, NM, pixels=127, pixel_um=0.5)
    assert odd.line_spread([0.0, 100.0]).edge_x == pytest.approx([0.5, 1.0], abs=1e-9)
    exact = p2sf.Pupil.from_opd(np.zeros((256, 256)), NA, NM).line_spread([0.0, 2.0])
    np.testing.assert_allclose(AIRY.line_spread([0.0, 2.0]).line_x, exact.line_x, atol=0.03 * exact.line_x[0])


def test_figures_of_a_lens_by_samples_are_near_those_of_its_pupil():
    source = p2sf.Source(3000, field_deg=5, wavelength_nm=550)
    psf = p2sf.render(LENS, source, "traced", pixels=256, focus_mm=3000, f_number=8, integrated=False)
    own, of_pupil = psf.mtf([20, 60]), p2sf.Camera(LENS, focus_mm=3000, f_number=8).at(source).mtf([20, 60])
    np.testing.assert_allclose(own.tangential, of_pupil.tangential, atol=own.predicted_error + 1e-3)
    light = p2sf.Camera(LENS, focus_mm=3000, f_number=8).at(source).energy([10.0])
    assert psf.encircled_energy([10.0]).fraction == pytest.approx(light.fraction, abs=5e-3)


def test_a_psf_is_an_array_a_picture_and_a_file(tmp_path):
    assert np.asarray(AIRY) is not None and np.array_equal(np.asarray(AIRY), AIRY.values)
    assert np.asarray(AIRY, np.float32).dtype == np.float32
    axes = AIRY.plot()
    assert axes.images and AIRY.plot(axes) is axes
    again, _ = p2sf.read_psf(AIRY.save(tmp_path / "airy.npz"))
    assert np.array_equal(again.values, AIRY.values) and again.mtf([100]).tangential == AIRY.mtf([100]).tangential


def test_a_stack_is_refused():
    stack = replace(AIRY, values=np.stack([AIRY.values] * 2))
    for call in (stack.mtf, stack.encircled_energy, stack.line_spread):
        with pytest.raises(SamplingError):
            call()


@pytest.mark.parametrize("integrated", [True, False])
def test_a_psf_tells_its_coefficients(integrated):
    lens, source = p2sf.load_lens("achromat_f6"), p2sf.Source(5000, field_deg=1, wavelength_nm=550)
    point = p2sf.Camera(lens, focus_mm=4500).at(source)
    six, psf = point.coefficients(), point.psf("seidel", integrated=integrated)
    found = p2sf.fit_psf(psf.values, float(six.na), 550, psf.pixel_um, integrated=integrated)
    expected = np.array([six.w40, six.w31, six.w22, six.w20 + six.wd])
    solutions = np.array([found.numbers, *found.others])
    off = np.abs(solutions - expected).max(1).min()
    assert off < 0.02 and found.r2[0] > 0.9999


@pytest.mark.parametrize("wrong", [{"na": 0.0}, {"pixel_um": -1.0}, {"values": np.zeros(5)}, {"model": "27"}])
def test_what_is_no_picture_of_a_point_is_refused(wrong):
    asked = {"values": AIRY.values, "na": NA, "wavelength_nm": NM, "pixel_um": 0.5} | wrong
    with pytest.raises(P2SFError):
        p2sf.fit_psf(**asked)
