"""The three ways from pupil to image plane are one sum, with one sign."""

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import disc_nodes
from p2sf.disc.transform import (
    BLOCK,
    COARSE_ERROR,
    MANY_SAMPLES,
    MOST_PRODUCTS,
    NUFFT_ERROR,
    matrix_dft,
    newton_step,
    padded_fft,
    sum_plane_waves,
)
from p2sf.errors import SamplingError

ROUND_OFF = 1e-12


def direct(amplitude, kx, ky, x, y):
    return np.array([[(amplitude * np.exp(2j * np.pi * (kx * a + ky * b))).sum() for a in x] for b in y])


@pytest.fixture
def pupil():
    rng = np.random.default_rng(3)
    return rng.normal(size=(10, 10)) + 1j * rng.normal(size=(10, 10))


def test_a_plane_wave_sum_is_the_double_loop():
    rng = np.random.default_rng(0)
    amplitude = rng.normal(size=50) + 1j * rng.normal(size=50)
    kx, ky = rng.normal(size=(2, 50))
    x, y = centred_axis(7, 0.3), centred_axis(4, 0.5)
    ours = sum_plane_waves(amplitude, kx, ky, x, y, even=False)
    np.testing.assert_allclose(ours, direct(amplitude, kx, ky, x, y), atol=ROUND_OFF * 50)


@pytest.mark.parametrize(("rows", "columns"), [(8, 11), (9, 6), (1, 1)])
def test_the_fold_replaces_the_mirror_half(rows, columns):
    """Also for windows that are not centred, and across the block size of the sum."""
    nodes = disc_nodes(60, 2 * (BLOCK // 40))
    amplitude = nodes.weight * np.exp(2j * np.pi * (nodes.xi**2 + 2 * nodes.eta**3))
    x, y = centred_axis(columns, 0.7) + 0.1, centred_axis(rows, 0.4) - 0.2
    halves = [sum_plane_waves(amplitude / 2, s * nodes.xi, nodes.eta, x, y, even=False) for s in (1, -1)]
    folded = sum_plane_waves(amplitude, nodes.xi, nodes.eta, x, y)
    np.testing.assert_allclose(folded, halves[0] + halves[1], atol=ROUND_OFF)


def test_leading_axes_are_a_batch():
    nodes = disc_nodes(5, 8)
    amplitude = np.stack([nodes.weight, 2j * nodes.weight])
    kx = np.stack([nodes.xi, 3 * nodes.xi])
    axis = centred_axis(4, 0.5)
    both = sum_plane_waves(amplitude, kx, nodes.eta, axis, axis)
    for one, a, k in zip(both, amplitude, kx, strict=True):
        np.testing.assert_allclose(one, sum_plane_waves(a, k, nodes.eta, axis, axis), atol=ROUND_OFF)


def test_single_precision_stays_single_and_accurate_at_a_hundred_waves():
    nodes, axis = disc_nodes(40, 64), centred_axis(16, 6.0)
    exact = sum_plane_waves(nodes.weight.astype(complex), nodes.xi, nodes.eta, axis, axis)
    n = nodes.astype(np.float32)
    single = sum_plane_waves(n.weight.astype(np.complex64), n.xi, n.eta, axis, axis)
    assert single.dtype == np.complex64
    # float32 keeps 2^-24 of 48 waves: 2e-5 rad per node.
    assert np.abs(single - exact).max() < 2e-5


def test_a_tilt_moves_the_peak_towards_plus_y():
    """An amplitude exp(−i2π·0.9η) cancels the wave at y = +0.9, rows running to +y."""
    nodes, axis = disc_nodes(12, 32), centred_axis(9, 0.3)
    field = sum_plane_waves(nodes.weight * np.exp(-2j * np.pi * 0.9 * nodes.eta), nodes.xi, nodes.eta, axis, axis)
    row, column = np.unravel_index(np.abs(field).argmax(), field.shape)
    assert (axis[row], axis[column]) == (pytest.approx(0.9), 0)


@pytest.mark.parametrize(("rows", "columns"), [(5, 6), (8, 3)])
def test_matrix_dft_is_the_double_loop(pupil, rows, columns):
    k, x, y = centred_axis(10, 0.2), centred_axis(columns, 0.3), centred_axis(rows, 0.9)
    kx, ky = np.meshgrid(k, k)
    expected = direct(pupil.ravel(), kx.ravel(), ky.ravel(), x, y)
    np.testing.assert_allclose(matrix_dft(pupil, k, k, x, y), expected, atol=ROUND_OFF * 100)


@pytest.mark.parametrize("samples", [16, 18, 8], ids=["padded", "padded, uneven", "folded: coarse pitch"])
def test_fft_and_matrix_agree(pupil, samples):
    pitch, pixels = 0.7, 4
    k, x = centred_axis(10, 1 / (samples * pitch)), centred_axis(pixels, pitch)
    np.testing.assert_allclose(padded_fft(pupil, samples, pixels), matrix_dft(pupil, k, k, x, x), atol=ROUND_OFF)


@pytest.mark.parametrize(("samples", "pixels", "words"), [(32, 7, "even"), (14, 8, "at least 16"), (17, 8, "16")])
def test_an_fft_of_an_odd_or_too_small_size_is_refused(pupil, samples, pixels, words):
    with pytest.raises(SamplingError, match=words):
        padded_fft(pupil, samples, pixels)


def test_a_line_is_a_row_of_the_picture():
    rng = np.random.default_rng(6)
    amplitude, kx, ky = rng.normal(size=(3, MOST_PRODUCTS // 400))
    x, zero = centred_axis(513, 0.31), np.zeros(1)
    across = sum_plane_waves(amplitude + 0j, kx, ky, x, zero, even=False)
    up = sum_plane_waves(amplitude + 0j, kx, ky, zero, x, even=False)
    for found, k in ((across[0], kx), (up[:, 0], ky)):
        exact = np.exp(2j * np.pi * np.outer(x, k)) @ amplitude
        assert np.abs(found - exact).max() < 100 * NUFFT_ERROR[np.dtype(float)] * np.linalg.norm(exact)


@pytest.mark.parametrize("even", [True, False])
@pytest.mark.parametrize(
    ("rows", "columns", "apart"),
    [(40, 41, 0.0), (33, 64, 0.0), (33, 64, 0.37), (182, 190, 0.0), (182, 190, 0.37), (513, 1, 0.0), (513, 1, 0.37)],
)
def test_many_nodes_are_the_same_sum_as_few(even, rows, columns, apart):
    """The non-uniform FFT against sums of parts so small that each is a product of matrices."""
    rng = np.random.default_rng(4)
    nodes = 2 * MOST_PRODUCTS // (rows * columns)
    amplitude = rng.normal(size=(2, nodes)) + 1j * rng.normal(size=(2, nodes))
    kx, ky = rng.normal(size=(2, nodes))
    x, y = centred_axis(columns, 0.3) + apart, centred_axis(rows, 0.7) - 2 * apart
    parts = [slice(start, start + nodes // 4) for start in range(0, nodes, nodes // 4)]
    few = sum(sum_plane_waves(amplitude[:, some], kx[some], ky[some], x, y, even) for some in parts)
    many = sum_plane_waves(amplitude, kx, ky, x, y, even)
    error = NUFFT_ERROR[np.dtype(float)] if rows * columns <= MANY_SAMPLES else COARSE_ERROR[np.dtype(float)]
    # Errors are stated relative to the root of the sum of squares.
    assert np.abs(many - few).max() < 30 * error * np.linalg.norm(few)
    single = sum_plane_waves(amplitude, kx.astype(np.float32), ky.astype(np.float32), x, y, even)
    assert single.dtype == np.complex64


def test_uneven_axes_are_summed_as_they_are():
    rng = np.random.default_rng(5)
    x = np.sort(rng.normal(size=30))
    amplitude, kx, ky = rng.normal(size=(3, 2 * MOST_PRODUCTS // x.size**2))
    field = sum_plane_waves(amplitude + 0j, kx, ky, x, x, even=False)
    one = (amplitude * np.exp(2j * np.pi * (kx * x[3] + ky * x[20]))).sum()
    assert abs(field[20, 3] - one) < ROUND_OFF * np.abs(amplitude).sum()


@pytest.mark.parametrize("place", [(0.05, -0.03), (0.4, 0.3)])
def test_a_step_to_the_peak_is_by_the_slopes_and_bends_of_the_light(place):
    """Newton's of |E|², and its gain −gᵀH⁻¹g/2, by differences; where |E|² is not concave, along its gradient."""
    rng = np.random.default_rng(4)
    amplitude, f = np.exp(1j * rng.normal(0, 0.3, 60)), rng.uniform(-1, 1, (2, 60))

    def light(x, y):
        return abs((amplitude * np.exp(2j * np.pi * (f[0] * x + f[1] * y))).sum()) ** 2

    def sums(x, y):
        waves = amplitude * np.exp(2j * np.pi * (f[0] * x + f[1] * y))
        return np.array([(waves * part).sum() for part in (1, *f, f[0] ** 2, f[0] * f[1], f[1] ** 2)])

    d, at, e = 1e-4, np.array(place), np.eye(2)
    slope = np.array([(light(*(at + d * k)) - light(*(at - d * k))) / (2 * d) for k in e])
    bend = np.array(
        [[sum(s * t * light(*(at + d * (s * i + t * k))) for s in (1, -1) for t in (1, -1)) for i in e] for k in e]
    )
    newton = -np.linalg.solve(bend / (4 * d * d), slope)
    value, step, gain = newton_step(sums(*at))
    assert value == pytest.approx(light(*at), rel=1e-12)
    if np.linalg.eigvalsh(bend).max() < 0:
        assert step == pytest.approx(newton, rel=1e-4) and gain == pytest.approx(slope @ newton / 2, rel=1e-4)
    else:
        assert step @ slope == pytest.approx(np.hypot(*step) * np.hypot(*slope), rel=1e-6)
        assert light(*(at + step)) > value
