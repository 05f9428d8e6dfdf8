"""Other programs' samplings of the pupil: how far from the converged sum they are, and that they converge to it."""

import numpy as np
import pytest

import p2sf
from p2sf.disc.domain import WHOLE
from p2sf.errors import RequestError
from p2sf.lensfile.library import find_lens
from p2sf.psf.huygens import huygens_psf
from p2sf.raytrace.pencil import on_sensor
from p2sf.studies.listings.singlet import LENS, POINTS
from p2sf.studies.other_sampling import SAMPLED, fft_intensity, huygens_amplitude, pupil_grid, sampled_psf
from p2sf.studies.tradeoff import TradeoffTable, error, table

WINDOW = 64, 0.6827813958190476  # the samples of the listings


def gap(one: np.ndarray, other: np.ndarray) -> float:
    """Return 1 − R² of pictures of unit sum."""
    one, other = one / one.sum(), other / other.sum()
    return float(((one - other) ** 2).sum() / ((other - other.mean()) ** 2).sum())


@pytest.mark.parametrize(("place", "size"), [("axis", 4.36e-4), ("skew", 1.056)])
def test_the_default_is_good_on_the_axis_and_worthless_at_the_skew_field(place, size):
    """1 − R² of the converged sum against the default of 64² points, which is what a listing's user takes for truth."""
    found = np.abs(huygens_amplitude(LENS, POINTS[place], 64, *WINDOW)) ** 2
    assert gap(converged_sum(place), found) == pytest.approx(size, rel=2e-3)


def converged_sum(place: str) -> np.ndarray:
    """Return a sum of plane waves over Gauss–Legendre nodes in the axes of the sensor."""
    nodes = WHOLE.nodes((40, 160))
    rays = on_sensor(LENS, [POINTS[place]], nodes.xi, nodes.eta).of_source(0)
    axis = (np.arange(WINDOW[0]) - WINDOW[0] // 2) * WINDOW[1]
    waves = nodes.weight * np.exp(2j * np.pi * (rays.phase + np.outer(axis, rays.fy)))
    return np.abs(waves @ np.exp(2j * np.pi * np.outer(rays.fx, axis))) ** 2


def test_the_grid_converges_as_its_rim_and_its_fall_do():
    """The pupil is short by 1.5 steps, and the fall-off reaches 1.22 λF·N/2: both are of first order in 1/N."""
    converged = huygens_psf(LENS, POINTS["axis"], *WINDOW).values
    errors = [
        np.linalg.norm(sampled_psf("OpticStudio's Huygens", n, LENS, POINTS["axis"], WINDOW).values - converged)
        for n in (64, 256)
    ]
    assert 3 < errors[0] / errors[1] < 8


def test_an_fft_has_the_sum_at_its_samples():
    """On the axis the FFT is the sum of plane waves over its own grid, but for sines taken as proportional to ξ."""
    intensity, pitch = fft_intensity(LENS, POINTS["axis"], 64)
    here = intensity[64 - 8 : 64 + 8, 64 - 8 : 64 + 8]
    converged = huygens_psf(LENS, POINTS["axis"], 16, pitch).values
    assert gap(here, converged) < 2e-3


def test_grids_hold_the_points_that_they_should():
    grid = pupil_grid(32, 14.5)
    assert grid.across.size == sum(i * i + j * j <= 210 for i in range(-16, 16) for j in range(-16, 16))


def test_the_tradeoff_measures_them_beside_the_methods():
    lens = find_lens("landscape")
    rows = p2sf.tradeoff(lens, fields_deg=[0], methods=["seidel"], pixels=16, samplings=[16, 32, 128], aim="paraxial")
    assert [(row.method, row.quality) for row in rows[2:]] == [
        *(("OpticStudio's Huygens", f"{n}²") for n in (16, 32, 128)),
        *(("plain FFT", f"{n}²") for n in (16, 32, 128)),
        *(("the paper's FFT", f"{n}²") for n in (32, 128)),
    ]
    for name in list(SAMPLED)[:2]:
        errors = [error(row) for row in rows if row.method == name]
        assert errors[0] > errors[-1]
    assert len(table(TradeoffTable(rows))) == len(rows) + 1


@pytest.mark.parametrize("count", [15, 8, 2048])
def test_a_sampling_that_is_none_is_refused(count):
    with pytest.raises(RequestError) as caught:
        p2sf.tradeoff(find_lens("landscape"), fields_deg=[0], methods=["seidel"], pixels=16, samplings=[count])
    assert caught.value.message.values["value"] == count
