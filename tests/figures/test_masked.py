"""Transfer function and energy behind masks: closed forms of rings, and the transform of the picture itself."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j1

from p2sf.disc.domain import WHOLE
from p2sf.disc.mask import PupilMask
from p2sf.figures.transfer import otf_slices
from p2sf.lens.lens import with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.measures import PupilPart, energy_in, mtf_of, parts_of, spread_of
from p2sf.psf.seidel import seidel_psf
from p2sf.pupil.frequency_pupil import pupil_of_coefficients, pupil_of_rays
from tests.pupil.test_open_part import circles_apart
from tests.support.waves import NA, WAVELENGTH_UM, waves

MASKS = (
    PupilMask(blades=6),
    PupilMask(obscuration=0.2, blades=5, blade_angle_deg=10),
    PupilMask(obscuration=0.3, vanes=3, vane_width=0.03, vane_angle_deg=20),
    PupilMask(apodisation=0.6, cubic_um=0.3),
)


@pytest.mark.parametrize(("ratio", "error"), [(0.1, 1e-4), (0.5, 1e-4), (0.9, 5e-4), (0.99, 1.5e-3)])
def test_the_transfer_function_of_a_ring(ratio, error):
    """The autocorrelation of two circles, by the areas that circles share (O'Neill 1956)."""
    moved = np.linspace(0, 0.999, 24)
    pairs = ((1, 1, 1), (1, ratio, -2), (ratio, ratio, 1))
    wanted = np.array([sum(s * circles_apart(a, b, 2 * m) for a, b, s in pairs) for m in moved]) / (pi * (1 - ratio**2))
    for one in otf_slices(pupil_of_coefficients(waves(), PupilMask(obscuration=ratio))):
        for found in one.at(moved * one.cut_off):
            assert found == pytest.approx(wanted, abs=error)


def test_the_energy_of_a_ring():
    ratio, radii = 0.5, [1.0, 3.0, 10.0]
    found = energy_in([PupilPart(pupil_of_coefficients(waves(), PupilMask(obscuration=ratio)))], "seidel", radii)

    def ring(v):
        return (2 * j1(v) / v - ratio**2 * 2 * j1(ratio * v) / (ratio * v)) ** 2 / (1 - ratio**2) ** 2

    scale = 2 * pi * NA / WAVELENGTH_UM
    wanted = [quad(lambda v: v * ring(v), 1e-9, scale * r, limit=500)[0] * (1 - ratio**2) / 2 for r in radii]
    assert found.fraction == pytest.approx(wanted, abs=1e-4)  # cells on edges count by 8 lines through each


@pytest.mark.parametrize("mask", MASKS, ids=repr)
def test_the_transfer_function_is_the_transform_of_the_picture(mask):
    six = waves(w40=0.5, w31=0.4, w22=0.3, wd=-0.3)
    parts = [PupilPart(pupil_of_coefficients(six, mask))]
    psf = seidel_psf(six, 384, 1.2, mask=mask)
    assert psf.values.sum() == pytest.approx(1)
    given = np.array([30.0, 90.0, 200.0])
    found = mtf_of(parts, "seidel", given)
    kernel = np.exp(-2j * np.pi * np.outer(given / 1000, psf.x_um))
    lines = np.abs(kernel @ psf.values.sum(0)), np.abs(kernel @ psf.values.sum(1))
    # The window lacks 1 − energy of the light, spread over all frequencies.
    for mine, line in zip((found.sagittal, found.tangential), lines, strict=True):
        assert mine == pytest.approx(line * psf.energy, abs=2 * (1 - psf.energy))
    assert (found.sagittal <= found.perfect_sagittal + 2e-7).all()  # the rounding of float32
    assert (found.tangential <= found.perfect_tangential + 2e-7).all()
    energy = energy_in(parts, "seidel", [10.0])
    away = np.hypot(psf.x_um, psf.y_um[:, None] - energy.centroid_um)
    assert energy.fraction[0] == pytest.approx(psf.energy * psf.values[away <= 10.0].sum(), abs=0.01)


def test_the_line_of_a_cubic_plate_lies_on_its_side():
    """Its tail points along +x and +y or against both: in the measures as in the picture."""
    lens, source = with_mask(find_lens("telephoto"), PupilMask(cubic_um=0.6)), Source(field_deg=3)
    parts, _ = parts_of(lens, source)
    found, psf = spread_of(parts, "traced"), huygens_psf(lens, source, 96, 1.0)
    # The tallest point lies off the chief ray towards the corner of the plate's tails, the centroid farther out.
    mine = found.position_um[found.line_x.argmax()] + found.centroid_x_um
    picture = psf.x_um[psf.values.sum(0).argmax()]
    assert abs(picture) > 1.5 and mine == pytest.approx(picture, abs=1.0)
    # The window lacks 2 % of the light, far out on the tails.
    assert found.centroid_x_um == pytest.approx(psf.values.sum(0) @ psf.x_um, abs=0.3)


def test_a_masked_lens_by_every_method():
    lens, source = with_mask(find_lens("double_gauss_28"), MASKS[1]), Source(field_deg=5)
    frequency = np.array([10.0, 40.0, 100.0])
    traced, fitted = (mtf_of(*parts_of(lens, source, method), frequency) for method in ("traced", "fitted"))
    assert traced.tangential == pytest.approx(fitted.tangential, abs=5e-3)
    assert traced.perfect_sagittal == pytest.approx(fitted.perfect_sagittal, abs=1e-3)
    plain = mtf_of(*parts_of(find_lens("double_gauss_28"), source), frequency)
    assert traced.clear_sagittal == pytest.approx(plain.perfect_sagittal, abs=1e-6)
    assert plain.clear_tangential == pytest.approx(plain.perfect_tangential, abs=0)


def test_an_obscuration_without_size_leaves_the_centroid():
    """Even where the box about the pupil has corners far beyond its edge, where polynomials run away."""
    lens, source = find_lens("petzval"), Source(field_deg=4.2)
    plain, dotted = (pupil_of_rays(one, source) for one in (lens, with_mask(lens, PupilMask(obscuration=1e-6))))
    assert dotted.centroid_um == pytest.approx(plain.centroid_um, abs=0.02)  # cells of a grid


@pytest.mark.parametrize("mask", [PupilMask(), PupilMask(obscuration=0.3, vanes=4)], ids=["clear", "spider"])
def test_half_of_the_columns_make_the_sum_of_all(mask):
    pupil = pupil_of_coefficients(waves(w40=1.0, w31=2.0), mask)
    for half, whole in zip(otf_slices(pupil), otf_slices(replace(pupil, domain=WHOLE)), strict=True):
        np.testing.assert_allclose(half.values, whole.values, atol=3e-7)  # single precision
