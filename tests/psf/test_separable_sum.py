"""Separable sums: rows of equal frequency, and the exact rays that go through them, against the plain sums."""

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.errors import Cancelled, SamplingError
from p2sf.psf.compare import r_squared, relative_l2
from p2sf.psf.fitted import fit, fitted_intensity, fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.separable_sum import frequency_rows, rows_for, sum_across, sum_both_sides, sum_rows
from p2sf.psf.traced import traced_psf
from p2sf.pupil.quadrature import disc_nodes
from p2sf.pupil.transform import sum_plane_waves
from p2sf.pupil.zernike import basis, columns, evaluate
from tests.support.reference import LENSES, cases


@pytest.mark.parametrize("odd", [False, True])
@pytest.mark.parametrize("order", [1, 6, 24])
def test_powers_are_the_same_polynomials(order, odd):
    nodes = disc_nodes(9, 20)
    values = basis(order, nodes.xi, nodes.eta, odd)
    rng = np.random.default_rng(1)
    coefficients = rng.normal(size=len(values)) / (1 + np.arange(len(values))) ** 2
    found = evaluate(columns(coefficients, order, odd), nodes.xi**2, nodes.eta) * (nodes.xi if odd else 1)
    # The powers of degree 24 reach 1e8 and cancel: 1e-16 of that.
    assert np.allclose(found, coefficients @ values, atol=1e-7 if order == 24 else 1e-13)


def test_rows_have_one_frequency_each_and_the_area_of_the_disc():
    lens, source, _, _ = list(cases("double_gauss_28"))[2]
    found = fit(lens, source, 46)
    nodes = frequency_rows(found, 40, 40)
    _, _, fy = found.at(nodes.xi.ravel(), nodes.eta.ravel())
    assert np.max(np.abs(fy.reshape(nodes.xi.shape) - nodes.fy[:, None])) < 1e-9 * found.steepness.spread
    assert nodes.weight.sum() == pytest.approx(1.0, abs=1e-9)  # 40 rows carry the curvature of the map to that
    assert (nodes.weight * nodes.xi**2).sum() == pytest.approx(0.25, abs=1e-9)
    assert (nodes.weight * nodes.eta**2).sum() == pytest.approx(0.25, abs=1e-9)
    assert (nodes.xi**2 + nodes.eta**2).max() < 1


@pytest.mark.parametrize("name", ["double_gauss_28", "cooke_triplet"])
def test_a_few_nodes_of_each_row_tell_what_its_columns_carry(name):
    lens, source, pixel, _ = list(cases(name))[-1]
    found = fit(lens, source)
    few, every = (rows_for(found, 64, 4 * pixel, "settled", every=flag) for flag in (False, True))
    assert few.xi.shape[1] < every.xi.shape[1] and few.words == every.words
    sums = [nodes.intensity(*found.at_points(nodes.xi, nodes.eta), 64, 4 * pixel) for nodes in (few, every)]
    # Polynomials of ten orders more than the phase itself has: 1e-10 of the picture on every stored row.
    assert relative_l2(*sums) < 1e-8


def test_cosines_by_recurrence():
    angle = np.linspace(-40, 40, 501)
    multiples = np.cos(angle[:, None] * np.arange(200))
    sums = sum_across(np.full((angle.size, 1), 1 - 2j), angle[:, None], 200)
    assert np.max(np.abs(sums - multiples[:, None] * [[[1.0], [-2.0]]])) < 1e-10
    fine = sum_across(np.ones((angle.size, 1), np.complex64), angle[:, None], 40)
    assert fine.dtype == np.float32
    # Phases of up to 39π have float32's 4e-6; some ten of them, of either sign and twice over, make one sum.
    assert np.max(np.abs(fine[:, 0] - multiples[:, :40])) < 5e-5


@pytest.mark.parametrize(("dtype", "error"), [(complex, 1e-11), (np.complex64, 2e-4)])
def test_sines_and_cosines_give_the_waves_of_both_sides(dtype, error):
    """Σ cos ± i·sin are Σ exp(±i·m·angle): errors grow with m, up to 40 here, and with the angles, up to 40."""
    angle, count = np.linspace(-40, 40, 505).reshape(5, 101), 41
    even, odd = (np.random.default_rng(3).normal(size=(2, 5, 101, 2)) @ [1, 1j]).astype(dtype)
    turns = angle[:, None] * np.arange(count)[:, None]
    for sign, found in zip((1, -1), sum_both_sides(even, odd, angle, count), strict=True):
        expected = (even[:, None] * np.cos(turns) + sign * 1j * odd[:, None] * np.sin(turns)).sum(-1)
        assert found.dtype == np.zeros(1, dtype).real.dtype
        assert np.abs(found[:, 0] + 1j * found[:, 1] - expected).max() < error * np.abs(even).sum(-1).max()


@pytest.mark.parametrize("pixels", [1, 16, 17])
def test_the_separable_sum_equals_the_sum_over_plane_waves(pixels):
    rng = np.random.default_rng(2)
    amplitude = rng.normal(size=(6, 5)) + 1j * rng.normal(size=(6, 5))
    fx, fy = rng.random((6, 5)), rng.normal(size=6)
    axis = centred_axis(pixels, 0.7)
    plain = sum_plane_waves(amplitude.ravel(), fx.ravel(), np.repeat(fy, 5), axis, axis)
    assert np.allclose(sum_rows(amplitude, fx, fy, pixels, 0.7), plain[:, pixels // 2 :: -1], atol=1e-12)


@pytest.mark.parametrize("name", ["double_gauss_28", "cooke_triplet", "telephoto", "eye_navarro", "relay"])
def test_rows_settle_to_what_the_plain_sum_over_the_disc_gives(name):
    lens, source, pixel, _ = list(cases(name))[1]
    found = fit(lens, source)
    nodes = rows_for(found, 32, pixel, "settled")
    found_values = nodes.intensity(*found.at_points(nodes.xi, nodes.eta), 32, pixel)
    plain = fitted_intensity(found, (250, 800), 32, pixel)
    assert relative_l2(found_values, plain) < 1e-4


@pytest.mark.parametrize("name", LENSES)
def test_traced_equals_the_witness(name):
    for lens, source, pixel, stored in cases(name):
        settled, preview = (traced_psf(lens, source, 32, pixel, quality) for quality in ("settled", "preview"))
        assert r_squared(settled.values, stored) >= 0.9999
        assert r_squared(preview.values, stored) >= 0.999


def test_a_map_too_curved_for_rows_is_summed_node_by_node(monkeypatch):
    lens, source, pixel, stored = list(cases("double_gauss_28"))[1]
    monkeypatch.setattr("p2sf.psf.disc_rows.rows_for", lambda *a: None)
    assert r_squared(fitted_psf(lens, source, 32, pixel, 46).values, stored) > 0.9999
    assert r_squared(traced_psf(lens, source, 32, pixel).values, stored) > 0.9999


def test_rows_refuse_a_map_that_folds():
    lens, source, _, _ = next(cases("tessar"))
    found = fit(lens, source)
    folded = type(found)(**{**vars(found), "fy": found.fy * 0 + np.eye(len(found.fy))[3]})
    assert frequency_rows(folded, 20, 20) is None


def test_clipped_rays_take_the_references_nodes():
    lens, source, pixel, _ = list(cases("double_gauss_28"))[2]
    clip = True
    traced, reference = (
        traced_psf(lens, source, 32, pixel, "settled", clip),
        huygens_psf(lens, source, 32, pixel, clip=clip),
    )
    assert r_squared(traced.values, reference.values) > 0.9999


@pytest.mark.parametrize("quality", ["settled", "preview"])
def test_rays_one_by_one_can_be_stopped(quality):
    lens, source, pixel, _ = list(cases("double_gauss_28"))[2]
    with pytest.raises(Cancelled):
        traced_psf(lens, source, 32, pixel, quality, True, cancelled=lambda: True)


def test_a_blur_beyond_all_nodes_is_refused_in_words():
    lens, source, _, _ = next(cases("double_gauss_28"))
    with pytest.raises(SamplingError, match="bring the sensor nearer"):
        rows_for(fit(lens, source), 64, 1e4, "settled")


@pytest.mark.parametrize("nodes", [None, 24])
def test_rows_are_summed_in_blocks_of_bounded_memory(monkeypatch, nodes):
    """Blocks of five rows, the last one smaller, add up to the sum of all, to round-off."""
    lens, source, _, _ = list(cases("double_gauss_28"))[2]
    found = fit(lens, source)
    rows = frequency_rows(found, 64, 80, nodes)
    phase, fx = found.at_points(rows.xi, rows.eta)
    whole = rows.intensity(phase, fx, 32, 0.7)
    monkeypatch.setattr("p2sf.psf.separable_sum.IN_MEMORY", 5 * 80)
    np.testing.assert_allclose(rows.intensity(phase, fx, 32, 0.7), whole, atol=1e-13 * whole.max())
