"""How fast exact rays and every method are: run with `pytest tests/benchmarks/test_rays_speed.py --benchmark-only -s`.

Double Gauss f/3 at 14°, 656.27 nm, the witness's indices, one BLAS thread. Every row prints its R² against the
converged reference at those very settings; settled settings have rows of their own. Medians of CPU time count,
since a shared machine's wall clock says little; both are printed.
"""

from statistics import median
from time import perf_counter, process_time

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from p2sf.figures.compare import r_squared
from p2sf.lens.lens import indices
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.choosing import choose
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import render
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.psf.traced import traced_psf
from p2sf.raytrace import trace as raytrace
from p2sf.raytrace.pencil import opd_map, trace
from p2sf_explorer.compute.meridional import path
from tests.support.reference import case, huygens_rows

ROUNDS = 200
ROW, STORED, _ = huygens_rows("double_gauss_28")[2]
LENS, SOURCE = case("double_gauss_28", ROW)
PIXEL = ROW["pixel_um"]
WIDE = float(suitable_pixel_um(coefficients(LENS, SOURCE.depth_mm, SOURCE.field_slope, SOURCE.wavelength_um), 64))


@pytest.fixture(autouse=True)
def one_blas_thread():
    # Once a process has freed megabytes it keeps them, as an app's does; before, every array costs page faults.
    np.ones(1 << 20)
    with threadpool_limits(1):
        yield


def report(benchmark, capsys, limit_ms: float | None, work, score: str = ""):
    """Measure, print and note a row; a miss is printed, not hidden."""
    work()
    cpu, wall = [], []
    for _ in range(ROUNDS):
        start = process_time(), perf_counter()
        work()
        cpu.append(1e3 * (process_time() - start[0]))
        wall.append(1e3 * (perf_counter() - start[1]))
    found = median(cpu)
    verdict = "" if limit_ms is None else f", {'within' if found <= limit_ms else 'MISSES'} {limit_ms:g} ms"
    with capsys.disabled():
        print(f"\n{benchmark.name}: CPU {found:.2f} ms, wall {median(wall):.2f} ms{verdict}{score}")
    benchmark.pedantic(work, rounds=20)


def against(psf, reference) -> str:
    how = f"{psf.sampling}, {psf.numbers} numbers, {psf.rays} rays"
    return f"; 1 − R² = {1 - r_squared(psf.values, reference):.1e} ({how})"


@pytest.fixture(scope="module")
def references():
    return {pixel: huygens_psf(LENS, SOURCE, 64, pixel).values for pixel in (PIXEL, WIDE)}


def test_trace_to_opd_128(benchmark, capsys):
    """Exact trace to the displayed OPD on 128², half the disc by symmetry: ≤ 2.5 ms."""
    witness = huygens_rows("double_gauss_28")[2][2]
    worst = np.nanmax(np.abs(opd_map(LENS, SOURCE, 32) - witness))
    report(benchmark, capsys, 2.5, lambda: opd_map(LENS, SOURCE, 128), f"; {worst:.0e} waves from the witness")


def test_trace_100_000_rays(benchmark, capsys):
    """Recorded points of every surface, for drawing."""
    origins = np.random.default_rng(1).uniform(-10, 10, (100_000, 3)) * [1, 1, 0]
    report(benchmark, capsys, None, lambda: trace(LENS, origins, [0, 0, 1.0], SOURCE.wavelength_um))


@pytest.mark.parametrize("window", ["core", "whole"])
@pytest.mark.parametrize("quality", ["preview", "settled"])
@pytest.mark.parametrize("numbers", [26, 46])
def test_fitted_64(benchmark, capsys, references, numbers, quality, window):
    """Coefficients from 64 rays and the 64 × 64 PSF: ≤ 2 ms."""
    pixel = PIXEL if window == "core" else WIDE
    limit = 2.0 if quality == "preview" else None
    score = against(fitted_psf(LENS, SOURCE, 64, pixel, numbers, quality), references[pixel])
    report(benchmark, capsys, limit, lambda: fitted_psf(LENS, SOURCE, 64, pixel, numbers, quality), score)


@pytest.mark.parametrize("window", ["core", "whole"])
@pytest.mark.parametrize("quality", ["preview", "settled"])
def test_traced_64(benchmark, capsys, references, quality, window):
    """Thousands of exact rays and the 64 × 64 PSF: ≤ 4 ms."""
    pixel = PIXEL if window == "core" else WIDE
    score = against(traced_psf(LENS, SOURCE, 64, pixel, quality), references[pixel])
    limit = 4.0 if quality == "preview" else None
    report(benchmark, capsys, limit, lambda: traced_psf(LENS, SOURCE, 64, pixel, quality), score)


def test_huygens_32_from_as_many_rays_as_128_squared(benchmark, capsys):
    """The live reference, trace included: ≤ 6 ms."""
    score = against(huygens_psf(LENS, SOURCE, 32, PIXEL, None), STORED)
    report(benchmark, capsys, 6.0, lambda: huygens_psf(LENS, SOURCE, 32, PIXEL, None), score)


def test_huygens_32_settled(benchmark, capsys):
    """The reference with its convergence proved."""
    score = against(huygens_psf(LENS, SOURCE, 32, PIXEL), STORED)
    report(benchmark, capsys, None, lambda: huygens_psf(LENS, SOURCE, 32, PIXEL), score)


@pytest.mark.parametrize("tolerance", [0.99, 0.9999])
def test_choose(benchmark, capsys, tolerance):
    """Which method, without the reference: ≤ 1 ms."""
    score = f"; {choose(LENS, SOURCE, tolerance).reason}"
    report(benchmark, capsys, 1.0, lambda: choose(LENS, SOURCE, tolerance), score)


def test_auto_64(benchmark, capsys, references):
    """Choose and render, as a slider at rest does."""
    score = against(render(LENS, SOURCE, pixel_um=WIDE), references[WIDE])
    report(benchmark, capsys, None, lambda: render(LENS, SOURCE, pixel_um=WIDE), score)


@pytest.mark.parametrize("way", ["plain numbers", "arrays"])
def test_five_rays_of_the_layout(benchmark, capsys, way):
    """Why the layout has a tracer of its own: five meridional rays to the sensor, from where they enter."""
    wave, slope = SOURCE.wavelength_um, SOURCE.field_slope
    index, height = indices(LENS, wave).tolist(), 0.1 * LENS.surfaces[0].semi_diameter
    starts = [(-1.0, part * height) for part in (-2, -1, 1, 2, 0)]
    origins = np.array([[0.0, y, z] for z, y in starts])
    direction = np.array([0.0, slope, 1.0])

    def plain():
        return [path(LENS, index, wave, start, (1.0, slope)) for start in starts]

    def arrays():
        return raytrace.trace(LENS, origins, np.broadcast_to(direction, origins.shape), wave)

    heights, landed = [ray[1][-1] for ray in plain()], arrays().points[-1][:, 1]
    np.testing.assert_allclose(landed, heights, rtol=1e-9)
    report(benchmark, capsys, None, plain if way == "plain numbers" else arrays)
