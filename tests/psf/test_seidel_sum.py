"""The fast arrangement is the plain formula, in both precisions, batched or not, from any thread."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from p2sf.disc.quadrature import chord_rows, grid_rows
from p2sf.disc.transform import matrix_dft
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf import seidel_sum as _seidel_sum
from p2sf.psf.seidel import plain_intensity
from p2sf.psf.seidel_stack import stack_parts
from p2sf.psf.seidel_sum import BATCH, intensities, kernels_for, shape_terms
from tests.support.waves import relative_l2, waves

MIXED = waves(w40=2.0, w31=3.0, w22=-1.5, w20=0.5, w11=7.0, wd=-1.0)


def grid_by_matrix_dft(c, size, pixels, pixel_um):
    """Return the whole grid, unfolded, by two complex products."""
    rows = grid_rows(size)
    axis = np.concatenate([-rows.eta[::-1], rows.eta])
    weight = np.block([[rows.weight[::-1, ::-1], rows.weight[::-1]], [rows.weight[:, ::-1], rows.weight]]) / 4
    pupil = weight * np.exp(2j * np.pi * wavefront(c, axis, axis[:, None]))
    k, x = 0.2 * axis, (np.arange(pixels) - pixels // 2) * pixel_um
    return np.abs(matrix_dft(pupil, k, k, x, x)) ** 2


@pytest.mark.parametrize("pixels", [1, 2, 7, 16])
def test_the_folded_grid_is_the_whole_grid(pixels):
    ours = intensities(MIXED, pixels, 1.1, grid_rows(64), np.float64)
    np.testing.assert_allclose(ours, grid_by_matrix_dft(MIXED, 64, pixels, 1.1), atol=1e-13)


@pytest.mark.parametrize("pixels", [16, 17])
@pytest.mark.parametrize("sign", [-1, 1])
def test_chords_are_the_plain_formula(pixels, sign):
    c = waves(w40=2.0, w31=3.0, w22=-1.5, wd=-1.0, sign=sign)
    plain = plain_intensity(c, pixels, 1.1)
    double = intensities(c, pixels, 1.1, chord_rows(96, 96), np.float64)
    np.testing.assert_allclose(double, plain, atol=1e-11)
    single = intensities(c, pixels, 1.1, chord_rows(96, 96))
    assert single.dtype == np.float32
    # Thousands of float32 terms of random phase: some 1e-6 of the whole.
    assert relative_l2(single, plain) < 5e-6


def test_single_precision_keeps_the_settled_promise_at_two_hundred_waves():
    c = waves(wd=200.0)
    [(_, rows)] = stack_parts(shape_terms(c)[None], 16, 100.0, "settled")
    assert relative_l2(intensities(c, 16, 100.0, rows), intensities(c, 16, 100.0, rows, np.float64)) < 2e-5


def test_a_batch_is_its_members_in_any_order_of_apertures():
    rng = np.random.default_rng(5)
    na = np.array([0.1, 0.2, 0.1])[:, None]
    c = waves(w40=rng.normal(size=(3, 1)), w31=rng.normal(size=(3, BATCH + 3)), na=na)
    stack = intensities(c, 12, 0.7, grid_rows(32))
    assert stack.shape == (3, BATCH + 3, 12, 12)
    for i, j in ((0, 0), (1, BATCH), (2, BATCH + 2)):
        one = waves(w40=c.w40[i, 0], w31=c.w31[i, j], na=na[i, 0])
        np.testing.assert_allclose(stack[i, j], intensities(one, 12, 0.7, grid_rows(32)), atol=1e-6)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_blocks_of_rows_add_up(monkeypatch, dtype):
    whole = intensities(MIXED, 16, 1.1, chord_rows(48, 48), dtype)
    _seidel_sum._blocks.cache_clear()
    monkeypatch.setattr(_seidel_sum, "KERNEL_BYTES", 10_000)
    blocks = intensities(MIXED, 16, 1.1, chord_rows(48, 48), dtype)
    assert len(_seidel_sum._blocks(chord_rows(48, 48), 16, np.dtype(dtype))) > 1
    _seidel_sum._blocks.cache_clear()
    np.testing.assert_allclose(blocks, whole, atol=1e-6 if dtype == np.float32 else 1e-14)


def test_chebyshevs_recurrence_is_the_cosine():
    kernels = kernels_for(chord_rows(20, 20), 0.37, 257, np.dtype(float))
    expected = np.cos(2 * np.pi * 0.37 * np.arange(129) * chord_rows(20, 20).xi[..., None])
    # The recurrence multiplies round-off by at most the square of its length.
    np.testing.assert_allclose(kernels.across, expected, atol=129**2 * 2e-16)


def test_threads_may_render_at_the_same_time():
    cases = [waves(w31=float(i), na=0.1 + 0.01 * i) for i in range(8)]
    alone = [intensities(c, 16, 1.0, grid_rows(64)) for c in cases]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda c: intensities(c, 16, 1.0, grid_rows(64)), cases * 4))
    for i, picture in enumerate(together):
        np.testing.assert_array_equal(picture, alone[i % 8])
