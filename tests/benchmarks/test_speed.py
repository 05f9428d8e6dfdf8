"""How fast the slider path and the batch path are: `pytest tests/benchmarks/test_speed.py --benchmark-only -s`.

Double Gauss f/3 at 10°, d line, catalogue glass. Each row is a median of at least 200 calls (batches: fewer, said), CPU
and wall, and prints its error against the converged PSF at those very settings. A miss is printed, not hidden.
"""

import subprocess
import sys

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from p2sf.disc.quadrature import cell_areas
from p2sf.figures.compare import r_squared, relative_l2
from p2sf.lens.lens import with_sensor
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.opd_array import opd_intensity
from p2sf.psf.seidel import plain_intensity, seidel_psf
from p2sf.psf.seidel_sum import wave_number
from tests.benchmarks.timing import timed

LENS = find_lens("double_gauss_28")
SLOPE, WAVE = float(np.tan(np.deg2rad(10))), 0.5875618
PIXELS, PIXEL_UM = 64, 0.88  # λ/(4 NA)


@pytest.fixture(autouse=True)
def one_blas_thread():
    with threadpool_limits(1):
        yield


@pytest.fixture
def report(benchmark, capsys):
    """Return a function that times, prints and notes a row."""

    def row(limit_ms: float | None, work, score: str = "", rounds: int = 200):
        found = timed(work, rounds)
        verdict = "" if limit_ms is None else f", {'within' if found.cpu_ms <= limit_ms else 'MISSES'} {limit_ms:g} ms"
        with capsys.disabled():
            print(f"\n{benchmark.name}: CPU {found.cpu_ms:.3g} ms, wall {found.wall_ms:.3g} ms{verdict}{score}")
        benchmark.pedantic(work, rounds=3)

    return row


def six(slope=SLOPE) -> Coefficients:
    return coefficients(LENS, np.inf, slope, WAVE)


def error_of(values, c=None) -> str:
    wanted = plain_intensity(c or six(), PIXELS, PIXEL_UM)
    return (
        f"; R² {r_squared(values, wanted):.6f}, relative L2 {relative_l2(values, wanted):.1e} against the converged sum"
    )


@pytest.mark.parametrize(("dtype", "limit"), [(np.float32, 0.35), (np.float64, 0.6)])
def test_lens_to_psf(report, dtype, limit):
    """Lens → Seidel → 128² pupil → 64×64 PSF, the drag preview."""

    def work():
        return seidel_psf(six(), PIXELS, PIXEL_UM, "preview", dtype=dtype)

    report(limit, work, error_of(work().values))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_lens_to_settled_psf(report, dtype):
    """The settled picture, relative L2 ≤ 1e-4."""

    def work():
        return seidel_psf(six(), PIXELS, PIXEL_UM, "settled", dtype=dtype)

    report(None, work, error_of(work().values))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_matrix_dft_of_an_opd_array(report, dtype):
    """Matrix DFT 128 → 64 from an OPD array."""
    cell = (2 * np.arange(128) + 1 - 128) / 128
    area, opd = cell_areas(cell, cell, 2 / 128), wavefront(six(), cell, cell[:, None])
    cycles = float(wave_number(six())) * PIXEL_UM

    def work():
        return opd_intensity(opd, area, cycles, PIXELS, dtype)

    report(0.2 if dtype == np.float32 else None, work, error_of(work()))


def grid(depth_mm=None):
    """Return depth, field and wavelength axes of 20 × 20 × 31 points that broadcast."""
    depth = np.linspace(500, 5000, 20)[:, None, None] if depth_mm is None else depth_mm
    return depth, np.linspace(0, 0.25, 20)[:, None], np.linspace(0.45, 0.65, 31)


def test_coefficients_of_a_grid(report):
    """20×20×31 points; the witness's 1e-12 holds as in tests/paraxial/test_seidel.py."""
    axes = grid()
    report(1.5, lambda: coefficients(LENS, *axes))


@pytest.mark.parametrize("quality", ["preview", "settled"])
def test_a_stack_of_12400_psfs(report, quality):
    """12 400 PSFs 64×64 with |Wd| ≤ 10 λ; two calls."""
    focused = with_sensor(LENS, float(coefficients(LENS, 20000.0, 0.0, 0.55).image_distance))
    near = 1 / np.linspace(1 / 22000, 1 / 18000, 20)[:, None, None]
    c = coefficients(focused, *grid(near))
    assert np.abs(c.wd).max() <= 10, np.abs(c.wd).max()

    def work():
        return seidel_psf(c, PIXELS, 1.5, quality, dtype=np.float32)

    report(2000, work, f"; |Wd| ≤ {np.abs(c.wd).max():.1f} λ", rounds=2)


def test_info_as_a_whole_process(report):
    """`p2sf info`; wall time of the process, 9 runs."""
    command = [sys.executable, "-m", "p2sf", "info", "double_gauss_28"]
    report(None, lambda: subprocess.run(command, check=True, capture_output=True), "; wall ≤ 700 ms wanted", rounds=9)
