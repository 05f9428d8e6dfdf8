"""Pupils with a dark disc beside the middle: two Airy amplitudes, circles that overlap, shadows out of focus."""

from math import pi

import numpy as np
import pytest
from scipy.special import j1

import p2sf
from p2sf.conventions import centred_axis
from p2sf.disc.mask import PupilMask
from p2sf.errors import RequestError
from p2sf.figures.transfer import otf_slices
from p2sf.lens.lens import Aperture, Lens, Surface, with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.geometric import geometric_psf
from p2sf.psf.measures import PupilPart, energy_in
from p2sf.psf.methods import PsfOptions, render
from p2sf.psf.seidel import seidel_psf
from p2sf.pupil.frequency_pupil import pupil_of_coefficients
from p2sf.pupil.landing import landing
from tests.pupil.test_open_part import circles_apart
from tests.support.masked_sum import masked_sum
from tests.support.tiers import in_tiers
from tests.support.waves import NA, WAVELENGTH_UM, r_squared, waves

RATIO, X, Y = 0.4, 0.3, -0.4
MASK = PupilMask(obscuration=RATIO, obscuration_x=X, obscuration_y=Y)
WAVE_NUMBER = 2 * pi * NA / WAVELENGTH_UM  # of pupil radii, per µm


def besinc(v: np.ndarray) -> np.ndarray:
    return np.divide(2 * j1(v), v, out=np.ones_like(v), where=v > 0)


def airy(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return |2J₁(v)/v − ε²·2J₁(εv)/(εv)·exp(i k(x₀x + y₀y))|²: the small disc has the phase of its shift."""
    v = WAVE_NUMBER * np.hypot(x, y)
    small = RATIO**2 * besinc(RATIO * v) * np.exp(1j * WAVE_NUMBER * (X * x + Y * y))
    return np.abs(besinc(v) - small) ** 2


def ideal() -> Lens:
    """Return an ideal lens at its stop: sharp, of numerical aperture NA to 1 %."""
    front = Surface(thickness=50.0, ideal_focal_length=50.0)
    return Lens((front,), Aperture("stop_semi_diameter", 50.0 * NA), 1, wavelengths_nm=(500.0,))


@pytest.mark.parametrize(("quality", "rounding"), [("settled", 1e-9), ("preview", 1e-4)])
def test_two_airy_amplitudes_by_six_coefficients(quality, rounding):
    psf = seidel_psf(waves(), 65, 0.9, quality, mask=MASK)
    axis = centred_axis(65, 0.9)
    wanted = airy(axis, axis[:, None])
    assert psf.values / psf.values.max() == pytest.approx(wanted / wanted.max(), abs=rounding)


@pytest.mark.parametrize("method", ["seidel", "fitted", "traced", "huygens"])
def test_two_airy_amplitudes_by_every_method(method):
    """The lens fills direction cosines as tangents: 1 − R² is the square of that, some 1e-5."""
    psf = p2sf.render(with_mask(ideal(), MASK), Source(wavelength_um=WAVELENGTH_UM), method, pixels=64, pixel_um=0.6)
    x, y = np.meshgrid(psf.x_um, psf.y_um)
    assert r_squared(psf.values, airy(x, y)) > 0.9999
    centred = (
        airy(*np.meshgrid(psf.x_um, psf.y_um)) * 0
        + np.abs(besinc(v := WAVE_NUMBER * np.hypot(x, y)) - RATIO**2 * besinc(RATIO * v)) ** 2
    )
    assert r_squared(psf.values, centred) < 0.99


def test_energy_is_that_of_the_pattern():
    """Gauss–Legendre in radius and even directions; the whole is 4π(1 − ε²)/k² by Parseval."""
    radii = [1.0, 3.0, 6.0]
    found = energy_in([PupilPart(pupil_of_coefficients(waves(), MASK))], "seidel", radii)
    node, share = np.polynomial.legendre.leggauss(100)
    angle = (np.arange(96) + 0.5) * (2 * pi / 96)
    wanted = []
    for radius in radii:
        rho = radius * (node[:, None] + 1) / 2
        inside = (
            (share[:, None] * airy(rho * np.sin(angle), rho * np.cos(angle)) * rho).sum() * radius / 2 * 2 * pi / 96
        )
        wanted.append(inside / (4 * pi * (1 - RATIO**2) / WAVE_NUMBER**2))
    assert found.fraction == pytest.approx(wanted, abs=2e-4)  # cells on edges count by 8 lines through each


def test_contrast_is_the_area_that_circles_share():
    """|rim ∩ rim| − |rim ∩ disc| at s − c and at s + c + |disc ∩ disc|, over the open area."""
    moved = np.linspace(0, 0.999, 24)
    found = otf_slices(pupil_of_coefficients(waves(), MASK))
    for one, way in zip(found, ((1.0, 0.0), (0.0, 1.0)), strict=True):
        wanted = []
        for shift in 2 * moved:
            s, c = shift * np.array(way), np.array([X, Y])
            crossed = sum(circles_apart(1, RATIO, float(np.hypot(*(s + sign * c)))) for sign in (-1, 1))
            wanted.append(circles_apart(1, 1, shift) - crossed + circles_apart(RATIO, RATIO, shift))
        wanted = np.array(wanted) / (pi * (1 - RATIO**2))
        for values in one.at(moved * one.cut_off):
            assert values == pytest.approx(wanted, abs=2e-4)


def test_a_shadow_out_of_focus_lies_on_its_own_side():
    """Behind the focus the pupil is upside down, and the light's centroid is −ε²c/(1 − ε²) of that, for rays and waves.

    With the lens 5 mm out of 50 the pupil's radius of 5 mm makes a spot of 0.5 mm.
    """
    lens = with_mask(ideal(), MASK)
    for shift_mm in (-5.0, 5.0):
        far = p2sf.lens.lens.with_sensor(lens, 50.0 + shift_mm)
        found, source = landing(far, Source(wavelength_um=WAVELENGTH_UM)), Source(wavelength_um=WAVELENGTH_UM)
        wanted = -1e3 * NA * shift_mm * np.array([X, Y]) * -(RATIO**2) / (1 - RATIO**2)
        assert np.array(found.centroid_um).ravel() == pytest.approx(wanted, rel=1e-6)
        density = geometric_psf(far, source, (100, 12.0), "settled")
        middle = [density.values.sum(0) @ density.x_um, density.values.sum(1) @ density.y_um]
        assert np.array(middle) / density.values.sum() == pytest.approx(
            wanted, abs=1.0
        )  # cells of the pupil at the edge


def test_the_farthest_ray_is_sought_on_both_edges():
    """Out of focus the ideal lens shows its pupil: points without area lie on the rim or on the edge of the disc."""
    far, shift = p2sf.lens.lens.with_sensor(with_mask(ideal(), MASK), 45.0), 5.0
    found = landing(far, Source(wavelength_um=WAVELENGTH_UM))
    edge, scale = np.asarray(found.light) == 0, 1e3 * NA * shift
    xi, eta = np.asarray(found.x_um)[edge] / scale, np.asarray(found.y_um)[edge] / scale
    on_rim, on_disc = np.abs(np.hypot(xi, eta) - 1) < 1e-6, np.abs(np.hypot(xi - X, eta - Y) - RATIO) < 1e-6
    assert (on_rim | on_disc).all() and on_rim.sum() > 12 < on_disc.sum()


CASES = {
    "open": (MASK, "", False),
    "crossing vanes": (
        PupilMask(obscuration=0.3, obscuration_x=0.2, obscuration_y=0.3, vanes=3, vane_width=0.06),
        "",
        0,
    ),
    "behind blades": (PupilMask(obscuration=0.3, obscuration_x=0.5, blades=5), "", False),
    "clipped": (MASK, "", True),
    "clipped vanes": (
        PupilMask(obscuration=0.3, obscuration_x=0.2, obscuration_y=0.3, vanes=3, vane_width=0.06),
        "",
        1,
    ),
    "tilted": (MASK, "tilted", False),
}


@pytest.mark.parametrize("case", in_tiers(CASES, ["crossing vanes", "clipped vanes", "tilted"]), ids=str)
def test_every_method_is_the_sum_over_a_grid(case):
    """The grid of 1.8e5 points is good to some 3e-4, by its edges."""
    mask, change, clip = CASES[case]
    lens, source = find_lens("double_gauss_28"), Source(field_deg=14 if clip else 10)
    lens = displaced(lens, 3, 4, Placement(decentre_y=0.05, tilt_x_deg=0.1)) if change else lens
    known = masked_sum(lens, source, mask, 32, 1.4, 480, bool(clip))
    for method in ("huygens", "traced", *(() if clip else ("fitted",))):
        found = render(with_mask(lens, mask), source, method, 32, 1.4, PsfOptions(clip=bool(clip)))
        assert r_squared(known, found.values) > 0.9993, method


def test_a_source_around_the_axis_sees_it_turned():
    """At 90° from +y towards +x the field runs along x: (x, y) of the stop is (−y, x) as that source sees it."""
    lens = find_lens("double_gauss_28")
    seen = p2sf.render(with_mask(lens, MASK), Source(field_deg=(8.0, 0.0)), "huygens", pixels=32, pixel_um=1.4)
    own = PupilMask(obscuration=RATIO, obscuration_x=-Y, obscuration_y=X)
    wanted = p2sf.render(with_mask(lens, own), Source(field_deg=8.0), "huygens", pixels=32, pixel_um=1.4)
    assert seen.values == pytest.approx(wanted.values, abs=1e-12)
    other = p2sf.render(with_mask(lens, MASK), Source(field_deg=8.0), "huygens", pixels=32, pixel_um=1.4)
    assert r_squared(seen.values, other.values) < 0.99


def test_what_reaches_beyond_the_rim_is_refused():
    with pytest.raises(RequestError) as caught:
        PupilMask(obscuration=0.5, obscuration_x=0.6)
    assert caught.value.message.values["parameter"] == "obscuration"
    assert PupilMask(obscuration_x=0.6).clear
    for name in ("obscuration_x", "obscuration_y"):
        with pytest.raises(RequestError):
            PupilMask(**{name: np.inf})
