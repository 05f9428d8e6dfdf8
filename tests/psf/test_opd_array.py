"""The PSF of a wavefront array against the plain matrix DFT and against the six coefficients it stands for."""

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import cell_areas
from p2sf.disc.transform import matrix_dft
from p2sf.errors import SamplingError
from p2sf.psf.opd_array import opd_intensity

SIZE = 128
CELL = (2 * np.arange(SIZE) + 1 - SIZE) / SIZE
AREA = cell_areas(CELL, CELL, 2 / SIZE)


def wave(seed=0):
    """Return a wavefront even in ξ, some waves high, with every parity in η."""
    a, b, c, d = np.random.default_rng(seed).normal(size=4)
    xi, eta = np.meshgrid(CELL, CELL)
    return 3 * a * (xi**2 + eta**2) ** 2 + b * eta * (xi**2 + eta**2) + c * eta**2 + d * eta**5


def plain(opd, cycles, pixels):
    axis = centred_axis(pixels)
    k = cycles * CELL
    return np.abs(matrix_dft(AREA * np.exp(2j * np.pi * opd), k, k, axis, axis) / AREA.sum()) ** 2


# float64: rounding of 16384 terms; float32: 128 products of 24 bits each way
@pytest.mark.parametrize(("dtype", "limit"), [(np.float64, 1e-12), (np.float32, 3e-6)])
@pytest.mark.parametrize("pixels", [64, 33, 1])
@pytest.mark.parametrize("cycles", [0.25, -0.4])
def test_it_is_the_plain_matrix_dft(dtype, limit, pixels, cycles):
    for seed in range(3):
        wanted = plain(wave(seed), cycles, pixels)
        found = opd_intensity(wave(seed), AREA, cycles, pixels, dtype)
        assert found.dtype == dtype
        assert np.linalg.norm(found - wanted) <= limit * np.linalg.norm(wanted) + 1e-14


def test_no_wavefront_peaks_at_one_and_a_tilt_moves_the_peak_up():
    assert opd_intensity(np.zeros((SIZE, SIZE)), AREA, 0.25, 64, np.float64)[32, 32] == pytest.approx(1, abs=1e-13)
    _, eta = np.meshgrid(CELL, CELL)
    tilted = opd_intensity(-0.25 * 4 * eta, AREA, 0.25, 64, np.float64)
    assert np.unravel_index(tilted.argmax(), tilted.shape) == (36, 32)


@pytest.mark.parametrize("shape", [(128, 64), (127, 127)])
def test_a_grid_that_is_no_even_square_is_refused(shape):
    with pytest.raises(SamplingError, match="equal even squares"):
        opd_intensity(np.zeros(shape), np.ones(shape), 0.25, 64)
