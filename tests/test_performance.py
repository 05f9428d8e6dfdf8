"""The table of figures over the field: what the library says of each point, and what another tracer finds."""

from math import isnan, nan

import numpy as np
import pytest

import p2sf
from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.performance import PerformanceTable, growing_table, performance_of
from tests.support.pupil_sums import sums
from tests.support.rays.skew_rays import system_of, through_stop

LENS = p2sf.load_lens("cooke_triplet")
FIELDS, FREQUENCIES = (0.0, 10.0, 20.0), (10.0, 30.0)
SOURCES = [p2sf.Source(np.inf, field_deg=angle, wavelength_nm=550.0) for angle in FIELDS]
ROUNDING = 1e-12  # relative: the same sums in the same order, over rays that are shared or traced anew


@pytest.fixture(scope="module")
def table() -> PerformanceTable:
    return [*growing_table(LENS, SOURCES, FREQUENCIES)][-1]


def test_figures_are_those_of_the_library(table):
    for source, found in zip(SOURCES, table.found, strict=True):
        contrast = p2sf.Camera(LENS).at(source).mtf(FREQUENCIES)
        energy = p2sf.Camera(LENS).at(source).energy()
        same = pytest.approx
        assert found.rms_waves == same(p2sf.Camera(LENS).at(source).zernike().rms, rel=ROUNDING)
        assert found.strehl == same(p2sf.render(LENS, source, "traced").strehl, rel=1e-6)  # of the search for the peak
        np.testing.assert_allclose(found.tangential, contrast.tangential, rtol=ROUNDING)
        np.testing.assert_allclose(found.sagittal, contrast.sagittal, rtol=ROUNDING)
        assert found.radius_80_um == same(energy.radius_80_um, rel=ROUNDING)


def test_shown_digits_are_those_of_the_library(table):
    for source, row in zip(SOURCES, table.rows(), strict=True):
        contrast = p2sf.Camera(LENS).at(source).mtf(FREQUENCIES)
        pairs = zip(contrast.sagittal, contrast.tangential, strict=True)
        expected = [
            f"{source.field_deg:.4g}",
            f"{p2sf.Camera(LENS).at(source).zernike().rms:.3f}",
            f"{p2sf.render(LENS, source, 'traced').strehl:.3f}",
            *(f"{value:.3f}" for pair in pairs for value in pair),
            f"{p2sf.Camera(LENS).at(source).energy().radius_80_um:.2f}",
        ]
        assert list(row[: len(expected)]) == expected


@pytest.mark.parametrize("number", [1, 2])
def test_contrast_energy_and_chief_rays_are_another_tracers(table, number):
    """The referee's grid leaves 1e-4 of a contrast and of a radius; chief rays agree to their aim, 1e-9 mm."""
    source, found = SOURCES[number], table.found[number]
    referee = sums(LENS, source)
    for axis, values in ((referee.y, found.tangential), (referee.x, found.sagittal)):
        np.testing.assert_allclose(np.interp(FREQUENCIES, referee.frequency, np.abs(axis)), values, atol=2e-3)
    assert found.radius_80_um == pytest.approx(referee.radius(0.8), rel=1e-3)

    def height(nm: float) -> float:
        of_colour = p2sf.Source(np.inf, field_deg=source.field_deg, wavelength_nm=nm)
        chief = through_stop(system_of(LENS, nm / NM_PER_UM), of_colour, np.zeros(1), np.zeros(1))
        return float(chief.y[0])

    colour = UM_PER_MM * (height(min(LENS.wavelengths_nm)) - height(max(LENS.wavelengths_nm)))
    assert found.lateral_colour_um == pytest.approx(colour, abs=1e-4)
    paraxial = float(p2sf.Camera(LENS).at(source).coefficients().image_height)
    assert found.distortion == pytest.approx(height(550.0) / paraxial - 1, abs=1e-8)


def test_in_the_middle_of_the_field_there_is_no_distortion_colour_or_shade(table):
    middle = table.found[0]
    assert (middle.distortion, middle.illumination) == (0.0, 1.0)
    assert middle.lateral_colour_um == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(middle.tangential, middle.sagittal, rtol=1e-6)  # rows along x and y: 2e-8 apart


def test_points_have_the_same_figures(table):
    found = p2sf.Camera(LENS).at(field_deg=FIELDS, wavelength_nm=550.0).performance(FREQUENCIES)
    for name in ("rms_waves", "strehl", "radius_80_um", "distortion", "illumination", "lateral_colour_um"):
        np.testing.assert_array_equal(found[name], [getattr(one, name) for one in table.found], err_msg=name)
    np.testing.assert_array_equal(found["sagittal"], [one.sagittal for one in table.found])
    assert found.arrays["tangential"][0] == ("field_deg", "frequency_per_mm")


def test_a_lens_of_one_wavelength_has_no_lateral_colour_and_says_a_dash():
    eye = p2sf.load_lens("eye_navarro")
    table = [*growing_table(eye, [p2sf.Source(np.inf, field_deg=5.0, wavelength_nm=543.0)])][-1]
    assert isnan(table.found[0].lateral_colour_um)
    assert table.rows()[0][-1] == "–" and table.rows_of_data()[1][-1] == "" and not table.reasons


def test_where_no_ray_can_be_trusted_nothing_is_printed_and_the_reason_is_told():
    table = [*growing_table(LENS, [p2sf.Source(np.inf, field_deg=60.0, wavelength_nm=550.0)])][-1]  # no ray arrives
    assert set(table.rows()[0][1:]) == {"–"}
    assert len(table.reasons) == 1


def test_one_refused_figure_takes_no_other_with_it():
    phone = p2sf.load_lens("phone_f28")  # its pupil folds at 30°, so that it has no contrast as a sum
    found = performance_of(phone, p2sf.Source(np.inf, field_deg=30.0, wavelength_nm=587.5618))
    assert np.isnan(found.tangential).all() and isnan(found.radius_80_um) and found.reason
    assert found.rms_waves > 0 and found.distortion != 0 and found.illumination > 0


def test_rows_of_data_keep_ten_digits(table):
    heads, *rows = table.rows_of_data()
    assert heads[:2] == ["field, °", "RMS, λ"] and heads[3:7] == [f"{s}, {f:g}/mm" for f in FREQUENCIES for s in "ST"]
    assert [float(row[1]) for row in rows] == pytest.approx([one.rms_waves for one in table.found], rel=1e-9)
    assert nan not in [float(cell) for row in rows for cell in row]
