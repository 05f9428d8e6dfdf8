"""The distances between PSFs, and the Gaussian baseline, on PSFs whose distance is known beforehand."""

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.errors import SamplingError
from p2sf.figures.compare import compare, r_squared, relative_l2
from p2sf.figures.psf_data import PsfFigures
from p2sf.psf.gaussian_fit import gaussian, gaussian_psf
from p2sf.psf.result import Psf
from tests.support.reference import huygens_rows
from tests.support.waves import mirrored

AXIS = centred_axis(64, 0.5)


def made(values, strehl=0.5, pixel=0.5) -> Psf:
    return Psf(np.asarray(values) / np.sum(values), pixel, 0.55, "test", PsfFigures(strehl=strehl))


def test_a_psf_equals_itself_whatever_its_scale():
    psf = gaussian(AXIS, AXIS, 2.0, 3.0, 1.0)
    assert r_squared(7 * psf, psf) == pytest.approx(1, abs=1e-15)
    assert relative_l2(7 * psf, psf) < 1e-15


def test_the_mean_itself_has_r_squared_zero_and_worse_is_negative():
    psf = gaussian(AXIS, AXIS, 2.0, 3.0, 1.0)
    assert r_squared(np.ones_like(psf), psf) == pytest.approx(0, abs=1e-15)
    assert r_squared(psf[:, ::-1] * 0 + psf.T[::-1], np.roll(psf, 25, 0)) < 0


def test_r_squared_and_relative_l2_are_the_same_distance_in_two_units():
    """1 − R² = L2²·Σref²/Σ(ref − mean)²."""
    _, reference, _ = huygens_rows("double_gauss_28")[2]
    other = mirrored(reference)
    wanted = reference / reference.sum()
    ratio = np.square(wanted).sum() / np.square(wanted - wanted.mean()).sum()
    expected = relative_l2(other, reference) ** 2 * ratio
    assert 1 - r_squared(other, reference) == pytest.approx(expected, rel=1e-12)


def test_a_shift_is_a_centroid_distance_and_changes_no_radius():
    first, second = made(gaussian(AXIS, AXIS, 2.0, 2.0, 0.0), 0.5), made(gaussian(AXIS, AXIS, 2.0, 2.0, 1.5), 0.4)
    errors = compare(second, first)
    assert errors.centroid_um == pytest.approx(1.5, abs=1e-9)
    assert errors.strehl == pytest.approx(-0.1, abs=1e-15)
    # radii are read off samples: a shift by whole pixels changes no more than what the window cuts off
    assert abs(errors.radius_50_um) < 1e-6 and abs(errors.radius_80_um) < 1e-6


def test_a_wider_gaussian_has_radii_that_grow_with_its_width():
    """The 50 % radius of a round Gaussian is σ√(2 ln 2)."""
    narrow, wide = (made(gaussian(AXIS, AXIS, s, s, 0.0)) for s in (2.0, 3.0))
    # samples of 0.5 µm: the curve is exact to a tenth of a pixel
    assert compare(wide, narrow).radius_50_um == pytest.approx(np.sqrt(2 * np.log(2)), abs=0.05)


def test_grids_must_agree():
    values = gaussian(AXIS, AXIS, 2.0, 2.0, 0.0)
    with pytest.raises(SamplingError, match="same grid"):
        compare(made(values), made(values, pixel=0.6))
    with pytest.raises(SamplingError, match=r"64 × 64 samples at 0\.5 µm with 32 × 32"):
        compare(made(values), made(values[:32, :32]))


@pytest.mark.parametrize(("sigma_x", "sigma_y", "centre"), [(2.0, 3.0, 1.0), (0.7, 6.0, -4.0), (5.0, 0.6, 0.0)])
def test_a_gaussian_is_fitted_exactly(sigma_x, sigma_y, centre):
    reference = made(gaussian(AXIS, AXIS, sigma_x, sigma_y, centre))
    found = gaussian_psf(reference)
    # the solver stops at a relative step of 1e-8, quadratic in R²
    assert compare(found, reference).r_squared > 1 - 1e-9
    assert (found.method, found.numbers) == ("gaussian", 3)


def test_a_fitted_gaussian_has_no_strehl_ratio():
    """Scaled as its reference it could peak above 1, which no pupil can."""
    (_, values, _), *_ = huygens_rows("double_gauss_28")
    found = gaussian_psf(made(values))
    assert found.strehl is None
    assert compare(found, made(values)).strehl is None


@pytest.mark.parametrize("name", ["double_gauss_28", "eye_navarro", "tessar"])
def test_no_neighbouring_gaussian_fits_a_real_psf_better(name):
    """The fit is a minimum: 2 % wider, narrower or shifted is never better."""
    for row, values, _ in huygens_rows(name):
        reference = made(values, pixel=row["pixel_um"])
        found = gaussian_psf(reference)
        best = r_squared(found.values, values)
        along = found.values.sum(1)
        centre = (along * found.y_um).sum()
        for factor in (0.98, 1.02):
            other = gaussian(found.x_um * factor, centre + (found.y_um - centre) * factor, *_sigmas(found), centre)
            assert r_squared(other, values) <= best + 1e-9


def _sigmas(found: Psf):
    return found.sampling.values["sigma_x"], found.sampling.values["sigma_y"]
