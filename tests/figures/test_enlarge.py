"""Enlarged pictures against finely computed ones, and what interpolation owes its samples."""

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.figures.enlarge import cosine_matrix, cubic_matrix, enlarge, is_band_limited
from p2sf.figures.perfect import airy_radius_um
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.methods import render
from p2sf.psf.seidel import AIRY_RADIUS

VISIBLE = 0.02  # relative L2 error, below which nobody sees a difference
TIMES, COARSE = 7, 64  # an odd factor: samples of the finer grid stand on those of the coarse one
CRITICAL = 1 / (4 * AIRY_RADIUS)  # Airy radii: λ/(4 NA)
SHIFT = TIMES // 2  # finer samples between the middles of the two grids


def light(name: str, field_deg: float, count: int, pitch_airy: float) -> np.ndarray:
    """Return samples, peak 1 of the light per area, at a pitch in Airy radii."""
    lens, source = find_lens(name), Source(np.inf, field_deg=field_deg)
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    psf = render(lens, source, "traced", count, pitch_airy * float(airy_radius_um(source.wavelength_um, c.na)))
    return psf.over_unaberrated


@pytest.mark.parametrize("name, field_deg", [("achromat_f6", 0.0), ("double_gauss_28", 0.0), ("telephoto", 2.0)])
def test_cosines_through_critical_samples_are_the_finely_computed_light(name, field_deg):
    coarse, fine = light(name, field_deg, COARSE, CRITICAL), light(name, field_deg, TIMES * COARSE, CRITICAL / TIMES)
    assert is_band_limited(coarse)
    drawn = enlarge(coarse, TIMES * COARSE)[SHIFT:, SHIFT:]
    true = fine[: -SHIFT or None, : -SHIFT or None]
    assert np.linalg.norm(drawn - true) <= VISIBLE * np.linalg.norm(true)


@pytest.mark.parametrize("matrix", [cosine_matrix, cubic_matrix])
def test_both_interpolations_pass_through_their_samples(matrix):
    assert matrix(16, 5 * 16)[2::5] == pytest.approx(np.eye(16), abs=1e-6)  # float32
    assert matrix(16, 64).sum(axis=1) == pytest.approx(1, abs=1e-5)


def test_cosines_mirrored_at_the_edges_are_exact():
    place = (np.arange(160) + 0.5) / 160
    finer = cosine_matrix(16, 160) @ np.cos(np.pi * 7 * (np.arange(16) + 0.5) / 16)
    assert finer == pytest.approx(np.cos(np.pi * 7 * place), abs=1e-5)


def test_cubic_convolution_is_exact_for_parabolas_within():
    def at(count):
        return centred_axis(count, 12 / count) + 6 / count

    inside = np.abs(at(120)) < 4
    assert (cubic_matrix(12, 120) @ at(12) ** 2)[inside] == pytest.approx(at(120)[inside] ** 2, abs=1e-4)


def test_light_stays_positive_and_differences_keep_their_sign():
    dot = np.zeros((8, 8))
    dot[4, 4] = 1.0
    assert enlarge(dot, 64).min() == 0
    assert enlarge(dot - 0.5, 64).min() < -0.5


def test_what_is_fine_enough_stays_as_it_is():
    values = np.random.default_rng(1).random((32, 32))
    assert enlarge(values, 32) is values


def test_coarse_samples_and_densities_of_rays_do_not_ring():
    coarse = light("achromat_f6", 0.0, COARSE, 4 * CRITICAL)
    disc = (np.hypot(*np.indices((64, 64)) - 32) < 20).astype(float)
    for picture in (coarse, disc):
        assert not is_band_limited(picture)
        rung = cosine_matrix(COARSE, 256) @ picture @ cosine_matrix(COARSE, 256).T
        assert enlarge(picture, 256).max() < rung.max()


def test_coarse_light_beside_a_bright_line_does_not_ring():
    """Light that only rises towards a line still does on finer samples, though the picture looks band-limited."""
    at = centred_axis(64, 1.0)
    picture = np.exp(-(np.hypot(at, at[:, None]) ** 2) / 200) + np.exp(-((at / 1.2) ** 2)) * np.ones((64, 1))
    assert is_band_limited(picture)
    falls = [-np.diff(enlarge(picture, 256, coarse)[128, : 4 * 26]).min() for coarse in (True, False)]
    assert falls[0] < 1e-6 < 1e-4 < falls[1]  # float32
