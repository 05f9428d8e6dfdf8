"""Contrast, energy and colour of misaligned lenses: closed forms, sums over PSFs, laws of symmetry."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.colour.colorimetry import bands
from p2sf.colour.spectrum import spectrum_of
from p2sf.disc.domain import WHOLE
from p2sf.disc.mask import PupilMask
from p2sf.figures.energy import landing_energy
from p2sf.figures.perfect import circle_contrast
from p2sf.figures.transfer import otf_slices
from p2sf.glass.media import MIRROR
from p2sf.lens.lens import Surface, with_f_number, with_mask
from p2sf.lens.misalignment import displaced, folding
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.measures import PupilPart, energy_in, mtf_of, parts_of, spread_of
from p2sf.psf.polychromatic import chief_places_um, colour_psf, suitable_pitch_um
from p2sf.pupil.frequency_pupil import uniform_disc
from tests.support.airy import circle_energy

FREQUENCIES = np.array([0.0, 5.0, 10.0, 20.0, 40.0, 80.0])
POINT = Source(field_deg=(3.0, 4.0))
OUTSIDE = 3e-3  # of a transfer function: light that a finite window of a PSF loses is some 1 % of all, far from it
MASKS = (
    PupilMask(obscuration=0.3, vanes=3, vane_width=0.03, vane_angle_deg=20),
    PupilMask(blades=5, blade_angle_deg=10),
    PupilMask(apodisation=0.6, cubic_um=0.3),
)


@pytest.fixture(scope="module")
def gauss():
    return with_f_number(find_lens("double_gauss_28"), 4.0)


@pytest.fixture(scope="module")
def bad(gauss):
    return displaced(gauss, 3, 5, Placement(0.1, 0.2, 0.02, 0.3, 0.2))


@pytest.fixture(scope="module")
def psf(bad):
    return huygens_psf(bad, POINT, 257, 0.6)


def contrast(lens, source=POINT, **how):
    parts, used = parts_of(lens, source, turn_deg=how.pop("turn_deg", 0.0), **how)
    return mtf_of(parts, used, FREQUENCIES)


def test_a_disc_without_symmetry_is_the_disc():
    disc = replace(uniform_disc(0.2), domain=WHOLE)
    for one in otf_slices(disc):
        nu = np.linspace(0, 1, one.values.size)
        assert one.values == pytest.approx(circle_contrast(nu), abs=1e-6)  # what a calibrated rule leaves
    radius = np.linspace(0, 20, 9)
    found = landing_energy(disc, 0.0).within(radius)
    assert found == pytest.approx(circle_energy(0.2 * radius), abs=2e-5)


def transform_along(psf, turn_deg):
    """Return the contrast of a PSF's samples at FREQUENCIES beyond 0, along an axis."""
    axis = np.deg2rad(turn_deg)
    along = psf.x_um * np.sin(axis) + psf.y_um[:, None] * np.cos(axis)
    light = psf.values * psf.energy
    return [abs((light * np.exp(-2j * np.pi * f / 1000 * along)).sum()) for f in FREQUENCIES[1:]]


@pytest.mark.parametrize("turn", [0.0, 30.0, 90.0])
def test_contrast_along_any_axis_is_the_transform_of_the_psf(bad, psf, turn):
    found = contrast(bad, turn_deg=turn)
    assert found.tangential[1:] == pytest.approx(transform_along(psf, turn), abs=OUTSIDE)
    assert (found.tangential <= found.perfect_tangential + 1e-6).all()


@pytest.mark.parametrize("mask", MASKS, ids=("spider", "iris", "filter"))
def test_behind_a_mask_contrast_and_energy_are_those_of_the_psf(bad, mask):
    masked = with_mask(bad, mask)
    psf = huygens_psf(masked, POINT, 257, 0.6)
    for turn in (0.0, 30.0):
        found = contrast(masked, turn_deg=turn)
        assert found.tangential[1:] == pytest.approx(transform_along(psf, turn), abs=OUTSIDE)
        for own, perfect in (
            (found.tangential, found.perfect_tangential),
            (found.sagittal, found.perfect_sagittal),
        ):
            assert (own <= perfect + 1e-12).all()
        # Without phase fewer lines are enough, to 1e-5.
        assert found.clear_tangential == pytest.approx(contrast(bad, turn_deg=turn).perfect_tangential, abs=2e-5)
        fitted = contrast(masked, method="fitted", turn_deg=turn)
        assert fitted.tangential == pytest.approx(found.tangential, abs=1e-3)
    parts, used = parts_of(masked, POINT)
    energy, spread = energy_in(parts, used), spread_of(parts, used, np.linspace(-20, 20, 5))
    light = psf.values * psf.energy
    radius = np.hypot(psf.x_um - energy.centroid_x_um, psf.y_um[:, None] - energy.centroid_um)
    for within in (10.0, 20.0, 40.0):
        # Whole samples on the circle, as of the clear lens below.
        assert np.interp(within, energy.radius_um, energy.fraction) == pytest.approx(
            light[radius < within].sum(), abs=2e-3
        )
    assert energy.centroid_x_um == pytest.approx((psf.values.sum(0) * psf.x_um).sum(), abs=0.15)  # light outside
    across = np.interp(spread.position_um + energy.centroid_x_um, psf.x_um, light.sum(0) / psf.pixel_um)
    assert spread.line_x == pytest.approx(across, abs=1e-4)


def test_sagittal_is_tangential_of_an_axis_turned_by_90_degrees(bad, gauss):
    for lens in (bad, gauss):
        assert contrast(lens).sagittal == pytest.approx(contrast(lens, turn_deg=90.0).tangential, abs=1e-4)
    plain, turned = contrast(gauss, Source()), contrast(gauss, Source(), turn_deg=37.0)
    assert turned.tangential == pytest.approx(plain.tangential, abs=1e-4)  # on the axis of a round lens


def test_energy_and_line_spread_are_about_the_centroid_in_x_and_y(bad, psf):
    parts, used = parts_of(bad, POINT)
    energy, spread = energy_in(parts, used), spread_of(parts, used, np.linspace(-20, 20, 5))
    light = psf.values * psf.energy
    radius = np.hypot(psf.x_um - energy.centroid_x_um, psf.y_um[:, None] - energy.centroid_um)
    for within in (10.0, 20.0, 40.0):
        # Whole samples on the circle: half the light of its outermost ring of samples.
        assert np.interp(within, energy.radius_um, energy.fraction) == pytest.approx(
            light[radius < within].sum(), abs=2e-3
        )
    assert energy.centroid_x_um == pytest.approx((psf.values.sum(0) * psf.x_um).sum(), abs=0.15)  # light outside
    across = np.interp(spread.position_um + energy.centroid_x_um, psf.x_um, light.sum(0) / psf.pixel_um)
    assert spread.line_x == pytest.approx(across, abs=1e-4)


def test_the_fit_describes_the_same_pupil(bad):
    assert contrast(bad, method="fitted").tangential == pytest.approx(contrast(bad).tangential, abs=5e-3)


def test_what_misalignment_adds_is_linear_where_it_is_small(gauss):
    still = contrast(gauss).tangential
    full, half = (
        contrast(displaced(gauss, 3, 5, Placement(0.02 * s, 0.01 * s, 0, 0.02 * s))).tangential - still
        for s in (1, 0.5)
    )
    assert np.abs(full).max() > 1e-3
    assert np.abs(half - full / 2).max() < 0.05 * np.abs(full).max()


def test_a_decentre_to_the_other_side_mirrors_light_and_keeps_contrast(gauss):
    left, right = (displaced(gauss, 3, 5, Placement(x, 0.1, 0, 0.2, y)) for x, y in ((-0.2, -0.3), (0.2, 0.3)))
    (one, used), (two, _) = parts_of(left, Source(field_deg=10)), parts_of(right, Source(field_deg=10))
    assert energy_in(one, used).centroid_x_um == pytest.approx(-energy_in(two, used).centroid_x_um, rel=1e-4)
    assert abs(energy_in(one, used).centroid_x_um) > 0.5
    first, second = (mtf_of(parts, used, FREQUENCIES) for parts in (one, two))
    assert first.sagittal == pytest.approx(second.sagittal, abs=1e-5)


def folded(lens):
    before = 0.4 * lens.sensor_mm
    last = replace(lens.surfaces[-1], thickness=before)
    mirror = Surface(inf, before - lens.sensor_mm, MIRROR, **folding(Placement(tilt_x_deg=45.0)))
    return replace(lens, surfaces=(*lens.surfaces[:-1], last, mirror))


def test_a_fold_changes_neither_contrast_nor_colour(gauss, bad):
    for lens in (gauss, bad):
        assert contrast(folded(lens)).tangential == pytest.approx(contrast(lens).tangential, abs=1e-5)
        waves = np.array([0.45, 0.55, 0.65])
        places = chief_places_um(folded(lens), POINT, waves)
        assert places == pytest.approx(chief_places_um(lens, POINT, waves), abs=1e-7)


def test_rims_end_a_pupil_without_symmetry(bad):
    """By the PSF of rays that the rims let through, 79 % of the pupil, with a corner to one side."""
    rim = replace(bad.surfaces[0], semi_diameter=13.0)
    narrow = replace(bad, surfaces=(rim, *bad.surfaces[1:]))
    psf = huygens_psf(narrow, POINT, 129, 0.9, 3e-3, clip=True)
    direct = np.exp(-2j * np.pi * FREQUENCIES[1:, None] / 1000 * psf.y_um) @ (psf.values * psf.energy).sum(1)
    found = contrast(narrow, clip=True)
    assert found.tangential[1:] == pytest.approx(np.abs(direct), abs=OUTSIDE)
    assert np.abs(found.tangential - contrast(bad).tangential).max() > 0.1


def test_a_colour_psf_adds_wavelengths_where_their_chief_rays_land(gauss):
    """Centroid of each: that of its own PSF, moved by its chief ray; decentres in x move it in x."""
    bad, spectrum = displaced(gauss, 3, 3, Placement(0.3, 0.0)), spectrum_of("lines:450,640")
    window = 97, suitable_pitch_um(bad, Source(), spectrum, 97)  # finer than λ/2NA: their shares of light are known
    found = colour_psf(bad, Source(), spectrum, window, "traced")
    waves, weights = bands(spectrum, 21)
    assert np.abs(found.aside_um).min() > 1.0 and np.abs(found.shift_um).max() < 1e-6
    expected = light = 0.0
    for wave, weight, aside in zip(waves, weights[:, 1], found.aside_um, strict=True):
        one = huygens_psf(bad, Source(wavelength_um=float(wave)), *window)
        expected += weight * one.energy * (one.values.sum(0) @ one.x_um + aside)
        light += weight * one.energy
    centre = found.xyz[..., 1].sum(0) @ found.x_um / found.xyz[..., 1].sum()
    assert centre == pytest.approx(expected / light, abs=0.02)
    # In y the same, by the other axis.
    other = colour_psf(displaced(gauss, 3, 3, Placement(0.0, 0.3)), Source(), spectrum, window, "traced")
    assert other.shift_um == pytest.approx(found.aside_um, abs=1e-6)
    assert np.abs(other.xyz - found.xyz.transpose(1, 0, 2)).max() < 1e-3 * found.xyz.max()


def test_contrast_of_a_spectrum_is_about_one_centroid(gauss):
    """Two wavelengths whose light is moved apart along x lose contrast there by cos(2πν·half the distance)."""
    parts, used = parts_of(gauss, Source(), "seidel")
    (part,) = parts
    apart = [PupilPart(part.pupil, 0.5, 0.0, shift) for shift in (-4.0, 4.0)]
    one, two = mtf_of(parts, used, FREQUENCIES), mtf_of(apart, used, FREQUENCIES)
    assert two.sagittal == pytest.approx(np.abs(one.sagittal * np.cos(2 * np.pi * FREQUENCIES * 4e-3)), abs=1e-6)
    assert two.tangential == pytest.approx(one.tangential, abs=1e-9)
