"""The Seidel PSF against the witness, against closed forms, and against the laws of its own physics."""

import numpy as np
import pytest
from scipy.special import j1

from p2sf.conventions import slope_from_degrees
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.errors import GeometryError, SamplingError
from p2sf.lens.lens import with_sensor
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.seidel import (
    AIRY_RADIUS,
    check_window,
    energy_fraction,
    fft_intensity,
    fft_samples,
    plain_intensity,
    seidel_psf,
    suitable_pixel_um,
)
from p2sf.psf.seidel_stack import stack_parts
from p2sf.psf.seidel_sum import shape_terms
from tests.support.reference import LENSES, huygens_rows, prescription_lens
from tests.support.tiers import in_tiers
from tests.support.waves import NA, WAVELENGTH_UM, mirrored, r_squared, relative_l2, rms, waves

SYMMETRY = 1e-13
# The stored R² come from the witness's own converged sums; ours agree to 1.5e-8 at worst (short sum of a bright core).
R2_TOLERANCE = 1e-6


def stored_rows():
    return [pytest.param(name, i, id=f"{name}-{i}") for name in LENSES for i in range(len(huygens_rows(name)))]


def row_coefficients(name, row):
    lens = with_sensor(prescription_lens(name, row["wavelength_nm"]), row["sensor_mm"])
    depth = np.inf if row["depth_mm"] is None else row["depth_mm"]
    return coefficients(lens, depth, slope_from_degrees(row["field_deg"]), row["wavelength_nm"] / 1000)


@pytest.mark.parametrize(("name", "number"), stored_rows())
def test_r2_against_huygens_is_the_witnesss(name, number):
    """The right sign gives the stored figure, the picture turned upside down the other one."""
    row, huygens, _ = huygens_rows(name)[number]
    values = seidel_psf(row_coefficients(name, row), 32, row["pixel_um"]).values
    assert r_squared(values, huygens) == pytest.approx(row["r2_seidel_vs_huygens"], abs=R2_TOLERANCE)
    assert r_squared(mirrored(values), huygens) == pytest.approx(row["r2_of_mirrored_seidel"], abs=R2_TOLERANCE)


def test_no_wavefront_error_gives_the_airy_pattern():
    psf = seidel_psf(waves(), 96)
    v = 2 * np.pi * NA / WAVELENGTH_UM * np.hypot(psf.x_um, psf.y_um[:, None])
    airy = np.square(2 * j1(v) / np.where(v == 0, 1, v), where=v > 0, out=np.ones_like(v))
    np.testing.assert_allclose(psf.values / psf.values.max(), airy, atol=1e-9)
    assert psf.strehl == pytest.approx(1, abs=1e-12)


def test_the_airy_radius_is_where_the_pattern_is_dark():
    assert abs(j1(2 * np.pi * AIRY_RADIUS)) < 1e-7


@pytest.mark.parametrize("six", [(0.5, 1.0, -0.7, 0.3, 9.0, 1.1), (3.0, -8, 5, 0, 0, -6), (0, 0, 0, 0, 0, 40.0)])
@pytest.mark.parametrize("pixels", [24, 25])
def test_settled_keeps_its_promise_against_the_plain_formula(six, pixels):
    c = waves(*six)
    psf = seidel_psf(c, pixels)
    plain = plain_intensity(c, pixels, psf.pixel_um)
    assert psf.error == SETTLED_TOLERANCE
    assert relative_l2(psf.values, plain / plain.sum()) < SETTLED_TOLERANCE / 10
    assert psf.over_unaberrated.max() == pytest.approx(plain.max(), rel=SETTLED_TOLERANCE)


@pytest.mark.parametrize("sign", [-1, 1], ids=["real image", "virtual image"])
def test_three_samplings_show_one_picture(sign):
    """At 1e-2, which is what grids with a rim of squares are worth; both senses of the signed slope."""
    c = waves(w40=0.4, w31=1.2, w22=0.8, wd=0.3, sign=sign)
    settled = seidel_psf(c, 32, 0.9)
    for other in (seidel_psf(c, 32, 0.9, quality="preview"), seidel_psf(c, 32, 0.9, sampling="fft")):
        assert relative_l2(other.values, settled.values) < 1e-2
        assert other.strehl == pytest.approx(settled.strehl, rel=1e-2)
        assert other.error is None


@pytest.mark.parametrize("pixel_um", in_tiers([0.3, 1.0, 4.0], (1.0, 4.0)))
def test_the_papers_fft_works_at_any_pitch(pixel_um):
    """Above λ/(2 NA) = 2.5 µm the pupil is wider than the FFT's period and is folded onto itself."""
    c = waves(w31=1.0, wd=1.0)
    samples = fft_samples(c, 16, pixel_um, "settled")
    assert samples % 2 == 0
    assert samples >= 32
    assert relative_l2(fft_intensity(c, 16, pixel_um, samples), plain_intensity(c, 16, pixel_um)) < 2e-3


def test_light_inside_and_outside_the_window_is_all_the_light():
    """Airy 1835: the rings outside radius r hold J0² + J1², 2/(πv) of it on average; a window loses about that."""
    wide = seidel_psf(waves(), 256, 1.0)
    v = 2 * np.pi * NA / WAVELENGTH_UM * 128
    assert 1 - wide.energy == pytest.approx(2 / (np.pi * v), rel=0.2)
    for six in ((1.0, 0, 0), (0, 2.0, 0), (0, 0, 3.0)):
        assert seidel_psf(waves(*six), 256, 1.0).energy == pytest.approx(wide.energy, abs=0.003)


def test_energy_is_not_told_where_samples_are_no_integral():
    assert seidel_psf(waves(), 16, 2.6).energy is None
    assert energy_fraction(waves(), 1.0, 2.4) == pytest.approx(np.pi * 0.48**2)


def test_strehl_of_small_errors_is_marechals():
    """1 − (2πσ)² to its own order: the rest is (2πσ)⁴, whichever term it is made of.

    The pitch puts coma's peak, 2/3·W31·λ/NA below the chief ray, on a sample.
    """
    pixel_um = 0.08 * 2 / 3 * WAVELENGTH_UM / NA / 5
    for six in ((0.06, 0, 0, 0, 0, -0.06), (0, 0.08), (0, 0, 0.05, -0.025), (0, 0, 0, 0, 0, 0.04)):
        c = waves(*six)
        loss = (2 * np.pi * float(rms(c))) ** 2
        assert seidel_psf(c, 65, pixel_um).strehl == pytest.approx(1 - loss, abs=loss**2)


def test_defocus_of_either_sign_is_the_same_picture():
    before, after = (seidel_psf(waves(w22=0.0, wd=wd), 32, 1.0).values for wd in (-1.3, 1.3))
    np.testing.assert_allclose(before, after, atol=SYMMETRY)


def test_coma_of_the_other_sign_is_the_mirrored_picture():
    up, down = (seidel_psf(waves(w31=w31), 33, 1.0).values for w31 in (-1.3, 1.3))
    np.testing.assert_allclose(up, down[::-1], atol=SYMMETRY)
    assert np.abs(up - up[::-1]).max() > 0.001


def test_positive_coma_flares_away_from_the_field():
    """W31 > 0 with a real image: rays land at −λ∇W/|n'u'|·(−1) = below for −, so the flare's side proves the sign."""
    psf = seidel_psf(waves(w31=3.0), 64)
    flare = (psf.values.sum(1) * psf.y_um).sum()
    # The mean ray lands at λ/(n'u')·mean ∂W/∂η = λ/(n'u')·W31, as Parseval's first moment says.
    assert flare == pytest.approx(-3.0 * WAVELENGTH_UM / NA, rel=0.1)


@pytest.mark.parametrize("pixels", [32, 33])
def test_what_physics_makes_symmetric_is_symmetric(pixels):
    values = seidel_psf(waves(w40=1.0, w31=2.0, w22=-1.0, wd=0.5), pixels, 1.0).values
    inner = values[:, 1 - pixels % 2 :]
    np.testing.assert_allclose(inner, inner[:, ::-1], atol=SYMMETRY)
    even = seidel_psf(waves(w40=1.0, w22=-1.0, wd=0.5), pixels, 1.0).values[1 - pixels % 2 :]
    np.testing.assert_allclose(even, even[::-1], atol=SYMMETRY)
    # Settled nodes favour no axis, yet rows and columns are different rules: they agree to what they promise.
    round_ = seidel_psf(waves(w40=1.0, wd=0.5), pixels, 1.0).values
    np.testing.assert_allclose(round_, round_.T, atol=1e-9)


def test_astigmatism_turned_by_a_right_angle_changes_sign_and_focus():
    """W22η² = W22ρ² − W22ξ²: the picture of W22 = a is that of −a with focus + a, transposed."""
    one, other = seidel_psf(waves(w22=1.5), 33, 1.0), seidel_psf(waves(w22=-1.5, wd=1.5), 33, 1.0)
    np.testing.assert_allclose(one.values, other.values.T, atol=1e-9)


def test_scaling_wavelength_and_pixel_together_changes_nothing():
    one = seidel_psf(waves(w40=1.0, w31=1.0), 32, 1.0)
    for k in (2.0, 10.0):
        other = seidel_psf(waves(w40=1.0, w31=1.0, wavelength_um=k * WAVELENGTH_UM), 32, k)
        np.testing.assert_allclose(other.values, one.values, atol=SYMMETRY)
        slower = seidel_psf(waves(w40=1.0, w31=1.0, na=NA / k), 32, k)
        np.testing.assert_allclose(slower.values, one.values, atol=SYMMETRY)


def test_distortion_does_not_touch_the_picture():
    values = [seidel_psf(waves(w31=1.0, w11=w11), 32, 1.0).values for w11 in (0.0, 30.0)]
    np.testing.assert_array_equal(*values)


def test_a_stack_is_its_members():
    c = waves(w40=np.array([[0.0], [1.0]]), w31=np.array([0.0, 1.0, 2.0]), na=np.array([[0.1], [0.2]]))
    stack = seidel_psf(c, 16, 0.8)
    assert stack.values.shape == (2, 3, 16, 16)
    assert stack.strehl.shape == stack.energy.shape == (2, 3)
    for i, j in np.ndindex(2, 3):
        one = seidel_psf(waves(w40=float(i), w31=float(j), na=0.1 * (i + 1)), 16, 0.8)
        np.testing.assert_allclose(stack.values[i, j], one.values, atol=1e-9)
        assert stack.strehl[i, j] == pytest.approx(one.strehl)


def test_the_suitable_window_shows_the_whole_picture():
    for six in ((), (5.0,), (0, 5.0), (0, 0, 5.0), (0, 0, 0, 0, 0, 50.0)):
        c = waves(*six)
        wider = seidel_psf(c, 128, float(suitable_pixel_um(c, 64)))
        # Five Airy radii hold 97 % of a perfect picture; nothing aberrated may fare worse.
        assert wider.values[32:-32, 32:-32].sum() > 0.965


def test_a_steep_phase_gets_more_samples_and_says_so():
    """A preview grid repeats the picture every N/2 cycles: 70 waves of slope on 128² would overlap."""
    c = waves(wd=60.0)
    [(_, rows)] = stack_parts(shape_terms(c)[None], 32, 10.0, "preview")
    assert len(rows.eta) > 64
    psf = seidel_psf(c, 32, 20.0, quality="preview")
    plain = plain_intensity(c, 32, 20.0)
    assert relative_l2(psf.values, plain / plain.sum()) < 0.1
    assert "uniform grid" in str(psf.sampling)
    assert "Chebyshev" in str(seidel_psf(c, 32, 20.0).sampling)


@pytest.mark.parametrize("pixels", [0, -4, 2.5, True, "64"])
def test_bad_sizes_are_refused(pixels):
    with pytest.raises(SamplingError, match="whole number"):
        seidel_psf(waves(), pixels)


@pytest.mark.parametrize("pixel_um", [0.0, -1.0, np.nan, np.inf])
def test_bad_pitches_are_refused(pixel_um):
    with pytest.raises(SamplingError, match="positive"):
        seidel_psf(waves(), 16, pixel_um)


def test_what_no_computer_holds_is_refused_before_it_is_tried():
    assert check_window(waves(), 2**12, 1.0) == 1.0  # the most samples a side
    with pytest.raises(SamplingError, match="100000"):
        seidel_psf(waves(), 100_000, 1.0)
    with pytest.raises(SamplingError, match="pupil samples"):
        seidel_psf(waves(wd=1e6), 16, 1.0)
    with pytest.raises(SamplingError, match="too large"):
        seidel_psf(waves(wd=1e6), 16, 1.0, sampling="fft")


def test_an_image_at_infinity_is_refused():
    with pytest.raises(
        GeometryError, match=r"^the image of this object lies at infinity \(NA 0\), .* no PSF; .* refocus$"
    ):
        seidel_psf(waves(na=0.0))
    with pytest.raises(GeometryError, match="w40 is not finite"):
        seidel_psf(waves(w40=np.nan))


@pytest.mark.parametrize("words", [{"quality": "good"}, {"sampling": "dft"}])
def test_unknown_options_are_answered_with_the_known_ones(words):
    with pytest.raises(SamplingError, match="choose"):
        seidel_psf(waves(), 16, **words)


def test_an_odd_size_by_fft_is_refused():
    with pytest.raises(SamplingError, match="even"):
        seidel_psf(waves(), 33, sampling="fft")


def test_one_steep_picture_leaves_those_of_its_stack_as_they_are():
    """It takes a sum of its own only where it is alone: two quadratures of one pupil, each to the settled promise."""
    steep = waves(w40=np.array([0.0, 60.0]), wd=np.array([0.5, 90.0]))
    both = seidel_psf(steep, 256, 0.8)
    assert "Gauss–Chebyshev" in str(both.sampling)
    alone = [seidel_psf(waves(w40=w40, wd=wd), 256, 0.8) for w40, wd in ((0.0, 0.5), (60.0, 90.0))]
    assert "directions" in str(alone[1].sampling)
    for values, one in zip(both.values, alone, strict=True):
        assert np.linalg.norm(values - one.values) < 1e-4 * np.linalg.norm(one.values)
