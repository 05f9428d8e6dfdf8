"""Transfer function, line and edge spread from the pupil, against closed forms, Hopkins's integral and plain sums."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import roots_legendre

import p2sf
from p2sf.errors import Cancelled, GeometryError, SamplingError
from p2sf.figures.line_sums import END, end_weights, line_sums
from p2sf.figures.perfect import diffraction_mtf
from p2sf.figures.transfer import OtfSlice, columns_of, otf_slices, slice_along_y
from p2sf.lens.lens import with_aim, with_f_number
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.psf import measures
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.measures import PupilPart, mtf_of, spread_of
from p2sf.psf.methods import TRACED
from p2sf.pupil.fit import fit
from p2sf.pupil.frequency_pupil import pupil_of_coefficients, pupil_of_fit, pupil_of_rays
from tests.support.overlap import overlap
from tests.support.tiers import in_tiers
from tests.support.waves import NA, WAVELENGTH_UM, waves

CUT_OFF = 2 * NA / WAVELENGTH_UM


def contrast(per_um=None, **w):
    frequency = None if per_um is None else 1000 * per_um
    return mtf_of([PupilPart(pupil_of_coefficients(waves(**w)))], "seidel", frequency)


def defocused(nu: np.ndarray, waves_at_rim: float) -> np.ndarray:
    """Return the OTF of a defocused circular pupil by its integral over the overlap of two discs (Hopkins 1955).

    ``nu``: frequency over the cut-off. With δ = 2ν the difference of the two phases is 2Wδx at x from the middle.
    """
    node, weight = roots_legendre(4000)
    half = 1 - nu[:, None]
    x = half * node
    chord = np.sqrt(np.maximum(1 - (np.abs(x) + nu[:, None]) ** 2, 0))
    return (2 / np.pi * half * weight * chord * np.cos(8 * np.pi * waves_at_rim * nu[:, None] * x)).sum(1)


def test_a_perfect_pupil_has_the_closed_form():
    """1e-6 between the lags too, where a spline of fifth order meets the cusp at 0 and the power 3/2 at the cut-off."""
    found = contrast(np.linspace(0, CUT_OFF, 1201))
    exact = diffraction_mtf(found.frequency_per_mm, NA, WAVELENGTH_UM)
    np.testing.assert_allclose(found.tangential, exact, atol=2e-5)
    np.testing.assert_allclose(found.sagittal, exact, atol=2e-5)
    np.testing.assert_allclose(found.tangential, found.perfect_tangential, atol=1e-7)  # the rounding of float32


@pytest.mark.parametrize("defocus", in_tiers([0.3, 1.0, 7.0, 32.0, 200.0], (0.3, 7.0, 200.0)))
def test_defocus_is_hopkinss_integral(defocus):
    nu = np.linspace(0, 1, 801)
    found, exact = contrast(nu * CUT_OFF, wd=defocus), defocused(nu, defocus)
    for curve in (found.tangential, found.sagittal):
        assert np.abs(curve - np.abs(exact)).max() < 1e-3  # half of what is promised


@pytest.mark.parametrize(
    "w", [{"w40": 5.0}, {"w31": 6.0}, {"w22": 4.0}, {"w40": 3.0, "w31": 4.0, "w22": 3.0, "wd": -3.0}]
)
def test_it_is_the_autocorrelation_of_the_pupil(w):
    """Against the plain two-dimensional integral over the overlap, at a few frequencies: Gauss nodes on each chord."""
    c, found = waves(**w), contrast(CUT_OFF * np.array([0.03, 0.2, 0.5, 0.9]), **w)
    for nu, tangential, sagittal in zip((0.03, 0.2, 0.5, 0.9), found.tangential, found.sagittal, strict=True):
        assert abs(abs(overlap(c, 0.0, nu)) - tangential) < 5e-4
        assert abs(abs(overlap(c, nu, 0.0)) - sagittal) < 5e-4


def test_nothing_passes_the_cut_off():
    found = contrast(CUT_OFF * np.array([0.3, 0.999, 1.0, 1.001, 2.0, 4.0]), w40=2.0, w31=3.0)
    assert found.tangential[2:].tolist() == found.sagittal[2:].tolist() == [0, 0, 0, 0]


SLOW = {"relay", "telecentric_relay", "fast_gauss_f14"}  # which take seconds


@pytest.mark.parametrize("aim", ["stop", "paraxial"])
@pytest.mark.parametrize("name", in_tiers(sorted(set(shipped_lenses()) - SLOW)))
def test_nothing_is_better_than_the_same_pupil_without_phase(name, aim):
    """At the lags by the triangle inequality, to the rounding of float32, and between them; neither is cut to fit.

    Stopped down as well, where a curve comes closest to its bound.
    """
    for lens in (with_aim(find_lens(name), aim), with_f_number(with_aim(find_lens(name), aim), 22.0)):
        for field in lens.fields_deg[:2]:
            try:
                pupil = pupil_of_rays(lens, Source(field_deg=field))
            except GeometryError:  # a pupil that folds has no curve
                continue
            for one in otf_slices(pupil):
                count = 20  # behind a mask there is no table of lags, and a point takes ten times as long
                if isinstance(one, OtfSlice):
                    assert (np.abs(one.values) - one.perfect).max() < 2e-7
                    count = one.values.size
                own, perfect = one.at(np.linspace(0, one.cut_off, 5 * count + 1))
                assert (np.abs(own) - perfect).max() < 1e-6


@pytest.mark.parametrize("lines", [8, 20])
def test_the_bound_holds_for_sums_far_too_coarse(lines):
    """30 waves of coma by some lines of 40 samples: no figure is right, and none is above the bound."""
    pupil = pupil_of_coefficients(waves(w31=10.0, w22=8.0, wd=2.0))
    for one in (pupil, pupil.transposed):
        own, perfect = line_sums(one, columns_of(one, (lines, 40), [], []))
        assert (np.abs(own) <= perfect + 1e-6 * perfect[0]).all()


def test_the_perfect_curve_hardly_depends_on_the_sampling():
    """5e-5 with the fewest lines there are, against 500 of 1000 samples, of a pupil squeezed and weighted unevenly."""
    pupil = pupil_of_rays(find_lens("reverse_telephoto"), Source(field_deg=30)).without_phase()
    nu = np.linspace(0, 1, 301)
    for one in (pupil, pupil.transposed):
        few, many = (slice_along_y(one, columns_of(one, counts, [], []), True) for counts in ((48, 128), (500, 1000)))
        differ = np.abs(few.at(nu * few.cut_off)[1] - many.at(nu * few.cut_off)[1])
        assert differ.max() < 1e-4


def test_an_end_between_two_samples_is_integrated_exactly():
    ends = np.array([9.5, 9.77, 10.0, 10.31, 10.499])
    last, weight = end_weights(ends)
    for power in range(END):
        for end, at, own in zip(ends, last, weight.T, strict=True):
            places = np.arange(at, -400.0, -1)
            factor = np.ones(places.size)
            factor[: own.size] = own
            # With a smooth start the sum is the integral, so that only the end is tested.
            start = 1 / (1 + np.exp(-(places + 190) / 8))
            fine = np.linspace(-400, end, 400_001)
            exact = np.trapezoid((fine / 10) ** power / (1 + np.exp(-(fine + 190) / 8)), fine)
            assert factor @ ((places / 10) ** power * start) == pytest.approx(exact, abs=1e-6 * max(1, abs(exact)))


def test_a_line_and_an_edge_are_integrals_of_each_other():
    found = spread_of([PupilPart(pupil_of_coefficients(waves(w31=3.0, w40=1.0)))], "seidel", np.linspace(-60, 60, 6001))
    step = found.position_um[1] - found.position_um[0]
    for line, edge in ((found.line_x, found.edge_x), (found.line_y, found.edge_y)):
        np.testing.assert_allclose(np.gradient(edge, step), line, atol=2e-3 * line.max())
        assert line.min() > -1e-4 * line.max()
        assert edge[0] == pytest.approx(1 - edge[-1], abs=0.02)
    assert found.edge_x[3000] == pytest.approx(0.5, abs=1e-6)


def test_the_line_of_a_perfect_lens_is_struves():
    """LSF(0)/2f = 8/(3π): the mean of the overlap curve, ∫OTF dν (Born & Wolf 1999, §8.5)."""
    found = spread_of([PupilPart(pupil_of_coefficients(waves()))], "seidel", np.zeros(1))
    mean = 4 / (3 * np.pi)  # of (2/π)(acos ν − ν√(1−ν²)) over 0 … 1
    assert found.line_x[0] == pytest.approx(2 * CUT_OFF * mean, rel=1e-4)


def test_the_centroid_is_the_mean_landing_point_of_the_light():
    pupil = pupil_of_coefficients(waves(w31=2.0))
    assert pupil.centroid_um == pytest.approx(-2.0 * WAVELENGTH_UM / NA, rel=1e-9)


def test_every_ray_method_tells_of_the_same_pupil():
    lens = find_lens("cooke_triplet")
    source = Source(field_deg=14)
    exact = mtf_of([PupilPart(pupil_of_rays(lens, source))], "traced")
    fitted = mtf_of([PupilPart(pupil_of_fit(fit(lens, source, 119)))], "fitted", exact.frequency_per_mm)
    assert np.abs(fitted.tangential - exact.tangential).max() < 2e-3


def test_slices_have_unit_contrast_at_zero_and_none_at_the_cut_off():
    for one in otf_slices(pupil_of_coefficients(waves(w31=1.0))):
        assert one.values[0] == pytest.approx(1)
        assert abs(one.values[-1]) < 1e-6
        assert one.cut_off == pytest.approx(CUT_OFF, rel=1e-6)


def test_a_long_sum_ends_between_blocks_when_it_is_stopped():
    asked = []

    def after_three() -> bool:
        asked.append(1)
        return len(asked) > 3

    with pytest.raises(Cancelled):
        otf_slices(pupil_of_coefficients(waves(w40=100.0)), after_three)
    assert len(asked) == 4


@pytest.mark.parametrize(("name", "field"), [("cooke_triplet", 20.0), ("tessar", 20.5)])
def test_of_a_clipped_pupil_it_is_that_of_a_window_of_the_reference_up_to_the_light_beyond(name, field):
    """The reference sums the rays that the rims leave, one by one.

    What its window lacks of the OTF is the Fourier integral over the light beyond, nowhere above that light.
    """
    lens, source = find_lens(name), Source(field_deg=field)
    pupil, whole = pupil_of_rays(lens, source, clip=True), pupil_of_rays(lens, source)
    frequency = np.linspace(0, 2 * max(pupil.half_x, pupil.half_y), 40)
    psf = huygens_psf(lens, source, 320, 1 / (12 * max(pupil.half_x, pupil.half_y)), clip=True)
    lines = (psf.x_um, psf.values.sum(0)), (psf.y_um, psf.values.sum(1))
    expected = [np.abs(np.exp(-2j * np.pi * np.outer(frequency, at)) @ (psf.energy * line)) for at, line in lines]
    found, unclipped = (mtf_of([PupilPart(p)], "traced", 1000 * frequency) for p in (pupil, whole))
    beyond = 1 - psf.energy
    assert beyond < 0.01
    assert np.abs(found.sagittal - expected[0]).max() < beyond + 1e-4  # and what the pupil's polynomials miss
    assert np.abs(found.tangential - expected[1]).max() < beyond + 1e-4
    assert np.abs(unclipped.tangential - expected[1]).max() > 5 * beyond, "the rims matter here"


def test_contrast_in_daylight_is_refused_at_the_first_wavelength(monkeypatch):
    """The blur of this lens takes more samples than are summed at any wavelength."""
    pupils = []

    def counted(*given):
        pupils.append(pupil_of_rays(*given))
        return pupils[-1]

    monkeypatch.setattr(measures, "METHODS", (replace(TRACED, over_frequency=counted),))
    with pytest.raises(SamplingError) as caught:
        p2sf.Camera(find_lens("fast_gauss_f14")).at(Source(field_deg=15)).mtf(spectrum="d65", method="traced")
    assert caught.value.message.values["waves"] > 1000 and len(pupils) == 1
