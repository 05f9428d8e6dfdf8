"""Light per pixel against plain sums over rays at many points of a pixel."""

import numpy as np
import pytest

from p2sf.database.build import build_database
from p2sf.database.render import Sampling, critical_pixel_um, rendered, rendered_light
from p2sf.database.space import Space
from p2sf.lens.lens import with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf import pixel_integrals
from p2sf.psf.methods import render
from p2sf.psf.pixel_integrals import render_integrated, samples_across
from tests.support.pupil_sums import ray_sum


def light_by_rays(lens, source: Source, count: int, pixel_um: float, points: int) -> np.ndarray:
    """Return the light in the chief ray's pixel and those beside it, over their sum: Gauss points in each pixel."""
    node, weight = np.polynomial.legendre.leggauss(points)
    x = (np.arange(count)[:, None] * pixel_um + node * pixel_um / 2).ravel()
    field = ray_sum(lens, source, lens.aim, x, node * pixel_um / 2, 300).field
    light = np.einsum("i,ijk,k->j", weight, (np.abs(field) ** 2).reshape(points, count, points), weight)
    return light / light.sum()


@pytest.mark.parametrize(("name", "share"), [("fast_gauss_f14", 0.164), ("petzval", 0.090)])
def test_a_wide_pixel_receives_the_light_between_its_samples(name, share):
    """4 µm pixels at f/1.4: of the points of 65² pixels the middle one has 0.66 and 0.53."""
    lens, source = with_aim(find_lens(name), "paraxial"), Source()
    psf = render_integrated(lens, source, "traced", 65, 4.0)
    assert psf.integrated and psf.values.sum() == pytest.approx(1, abs=1e-12)
    middle = psf.values[32, 32:37]
    np.testing.assert_allclose(middle / middle.sum(), light_by_rays(lens, source, 5, 4.0, 20), atol=2e-3)
    assert psf.values[32, 32] == pytest.approx(share, abs=1e-3)
    assert render(lens, source, "traced", 65, 4.0).values[32, 32] > 3 * share


@pytest.mark.parametrize("pixels", [16, 17])
def test_the_chief_rays_pixel_is_the_middle_one_of_any_size(pixels):
    """An Airy pattern on the axis: even about its pixel, row and column."""
    psf = render_integrated(find_lens("achromat_f6"), Source(), "traced", pixels, 6.0)
    middle = pixels // 2
    line = psf.values[middle, middle - 6 : middle + 7]
    np.testing.assert_allclose(line, line[::-1], atol=1e-6)
    np.testing.assert_allclose(line, psf.values[middle - 6 : middle + 7, middle], atol=1e-6)
    assert line.argmax() == 6


def test_pixels_that_resolve_it_all_are_left_alone():
    lens, source = find_lens("achromat_f6"), Source()
    fine = render_integrated(lens, source, "traced", 32, 1.0)
    assert not fine.integrated
    np.testing.assert_array_equal(fine.values, render(lens, source, "traced", 32, 1.0).values)


def test_the_light_of_wide_pixels_is_that_of_the_narrow_ones_inside():
    """3 × 3 of a third of the width, each integrated itself; and as much of all light."""
    lens, source = find_lens("cooke_triplet"), Source(field_deg=14)
    wide, narrow = (render_integrated(lens, source, "traced", n, um) for n, um in ((15, 9.0), (45, 3.0)))
    sums = narrow.values.reshape(15, 3, 15, 3).sum((1, 3))
    np.testing.assert_allclose(wide.values, sums, atol=3e-4 * sums.max())
    assert wide.energy == pytest.approx(narrow.energy, abs=1e-4)


def test_samples_across_are_odd_and_close_enough():
    assert [samples_across(9, um, 1.0) for um in (0.5, 1.0, 1.1, 2.9, 3.0, 3.1, 6.0)] == [1, 1, 3, 7, 7, 7, 13]
    assert [samples_across(256, um, 1.0) for um in (2.9, 4.0, 6.0, 9.0)] == [7, 5, 7, 1]


def test_what_takes_too_many_samples_stays_at_points_and_says_so(monkeypatch):
    monkeypatch.setattr(pixel_integrals, "LARGEST", 100)
    psf = render_integrated(find_lens("fast_gauss_f14"), Source(), "traced", 33, 4.0)
    assert not psf.integrated
    assert psf.values.shape == (33, 33)


def test_a_databases_wide_pixels_hold_the_light_of_narrow_ones():
    lens = find_lens("achromat_f6")
    database = build_database(lens, Space(np.array([1000.0, np.inf]), np.array([0.0, 0.06]), np.array([0.55, 0.6])))
    points = database.space.axes
    pitch = critical_pixel_um(database)
    wide = rendered_light(database, points, Sampling(9, 5 * pitch), np.float64)
    fine = rendered(database, points, Sampling(135, pitch / 3), np.float64)
    sums = fine.reshape(*fine.shape[:-2], 9, 15, 9, 15).sum((-3, -1))
    np.testing.assert_allclose(wide, sums / sums.sum((-2, -1), keepdims=True), atol=5e-4 * sums.max())
