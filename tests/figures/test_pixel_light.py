"""Light on pixels from samples between them, against integrals in closed form."""

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.special import j1

from p2sf.conventions import centred_axis
from p2sf.figures import pixel_light
from p2sf.figures.pixel_light import LARGEST, fine_grid

FINEST_UM = 1.0  # λ/(4 NA): frequencies up to 1/2 cycle per µm, the highest of an incoherent image
PIXELS = [(6, 5.3), (7, 5.3), (9, 1.2), (64, 1.51)]


def samples(grid, intensity) -> np.ndarray:
    """Return an intensity at the samples of a grid, rows along y."""
    axis = centred_axis(grid.side, grid.pitch_um)
    return intensity(axis, axis[:, None])


def airy(x, y):
    """Return the Airy pattern whose λ/(4 NA) is FINEST_UM (Born & Wolf 1999, 8.5.2)."""
    v = 2 * np.pi / (4 * FINEST_UM) * np.hypot(x, y) + 1e-12
    return (2 * j1(v) / v) ** 2


@pytest.mark.parametrize(("pixels", "pixel_um"), PIXELS)
def test_even_light_falls_evenly_and_none_is_lost(pixels, pixel_um):
    grid = fine_grid(pixels, pixel_um, FINEST_UM)
    light = grid.light(samples(grid, lambda x, y: 1 + 0 * x + 0 * y))
    # 1e-5: what a windowed sinc lets through of the frequency of the samples themselves, −100 dB.
    np.testing.assert_allclose(light, grid.per_pixel**2, rtol=1e-5)


@pytest.mark.parametrize(("pixels", "pixel_um"), PIXELS)
@pytest.mark.parametrize("cycles_per_um", [0.05, 0.31, 0.45])
def test_a_wave_is_integrated_in_closed_form(pixels, pixel_um, cycles_per_um):
    """∫cos over a pixel is its width times sin(πfw)/(πfw) times the cosine in its middle; rows are twice as coarse."""
    grid = fine_grid(pixels, pixel_um, FINEST_UM)

    def wave(x, y):
        return (1 + np.cos(2 * np.pi * cycles_per_um * x + 0.3)) * (1 + np.sin(np.pi * cycles_per_um * y))

    middles = centred_axis(pixels, pixel_um)
    across = 1 + np.sinc(cycles_per_um * pixel_um) * np.cos(2 * np.pi * cycles_per_um * middles + 0.3)
    up = 1 + np.sinc(cycles_per_um * pixel_um / 2) * np.sin(np.pi * cycles_per_um * middles)
    light = grid.light(samples(grid, wave)) / grid.per_pixel**2
    # Of the brightest, 4: 2e-5, and 2e-4 where a frequency is near the end of the band, which images hardly reach.
    assert np.abs(light - up[:, None] * across).max() < 4 * (2e-4 if cycles_per_um > 0.4 else 2e-5)


def test_an_airy_pattern_on_pixels_is_what_quadrature_finds():
    """In the middle pixel, one beside it, and one off both axes (Born & Wolf 1999, 8.5.2)."""
    pixel_um = 3.7
    grid = fine_grid(41, pixel_um, FINEST_UM)

    light = grid.light(samples(grid, airy)) * grid.pitch_um**2
    for row, column in ((20, 20), (20, 21), (22, 21)):
        low_x, low_y = (column - 20.5) * pixel_um, (row - 20.5) * pixel_um
        wanted = dblquad(airy, low_y, low_y + pixel_um, low_x, low_x + pixel_um, epsabs=1e-12)[0]
        assert light[row, column] == pytest.approx(wanted, abs=5e-5 * light.max())


def test_single_precision_stays_single():
    grid = fine_grid(16, 4.0, FINEST_UM)
    assert grid.light(np.ones((2, grid.side, grid.side), np.float32)).dtype == np.float32


def test_samples_are_closer_than_the_band_asks_and_points_stay_points():
    for pixel_um in (1.01, 2.9, 5.54):
        grid = fine_grid(9, pixel_um, FINEST_UM)
        assert 1.2 * pixel_um <= grid.per_pixel <= 1.28 * pixel_um
        assert grid.side * grid.pitch_um > 10 * pixel_um
    assert fine_grid(9, 1.0, FINEST_UM) is None and fine_grid(9, 0.5, FINEST_UM) is None
    assert fine_grid(9, 0.5, FINEST_UM, narrow_too=True).side < 41
    assert fine_grid(256, 6.0, FINEST_UM).per_pixel >= 1.2 * 6.0 and fine_grid(256, 6.0, FINEST_UM).side <= LARGEST
    widest = fine_grid(64, 30.0, FINEST_UM)
    assert 30.0 <= widest.per_pixel < 36.0 and widest.side <= LARGEST and fine_grid(256, 9.0, FINEST_UM) is None


def test_the_widest_windows_are_as_exact_as_is_said(monkeypatch):
    """Samples hardly closer than λ/(4 NA): up to 4e-3 for an Airy pattern, where there are enough of them 4e-5."""
    enough = fine_grid(40, 1.5, FINEST_UM)
    monkeypatch.setattr(pixel_light, "LARGEST", 84)
    widest = fine_grid(40, 1.5, FINEST_UM)
    assert 1.5 <= widest.per_pixel < 1.1 * 1.5
    one, other = (grid.light(samples(grid, airy)) * grid.pitch_um**2 for grid in (enough, widest))
    assert 1e-4 < np.linalg.norm(one - other) / np.linalg.norm(one) < 4e-3
