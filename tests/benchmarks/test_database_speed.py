"""How fast and how small databases are: run with `pytest tests/benchmarks --benchmark-only`.

Medians of CPU time on one BLAS thread decide, since a shared machine's wall clock says little; both are printed.
"""

import tracemalloc
from statistics import median
from time import perf_counter, process_time

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from p2sf.conventions import slope_from_degrees
from p2sf.database.build import INTERPOLANTS, build_database
from p2sf.database.departure import scatter
from p2sf.database.files.npz import database_bytes
from p2sf.database.render import Sampling, render_source
from p2sf.database.space import Space
from p2sf.lensfile.library import find_lens
from p2sf.spans import depth_nodes
from p2sf.threads import using_threads

FIELDS = slope_from_degrees(np.linspace(0, 14, 20))
WIDE = Space(depth_nodes(500), FIELDS, np.linspace(0.4, 0.7, 31))
NEAR_FOCUS = Space(depth_nodes(60_000), FIELDS, np.linspace(0.42, 0.7, 31))  # |Wd| ≤ 8.3 waves throughout
SAMPLING = Sampling(64, 1.0, "preview")
MIB = 1 << 20


@pytest.fixture(autouse=True)
def one_blas_thread():
    with threadpool_limits(1), using_threads(1):
        yield


@pytest.fixture(scope="module")
def lens():
    return find_lens("double_gauss_28")


def cpu_median(function, rounds: int = 200) -> tuple[float, float]:
    """Return median CPU and wall seconds of a call."""
    function()
    cpu, wall = [], []
    for _ in range(rounds):
        start = process_time(), perf_counter()
        function()
        cpu.append(process_time() - start[0])
        wall.append(perf_counter() - start[1])
    return median(cpu), median(wall)


def report(capsys, what: str, cpu: float, wall: float, more: str = ""):
    with capsys.disabled():
        print(f"\n{what}: CPU {1e3 * cpu:.4g} ms, wall {1e3 * wall:.4g} ms{more}")


@pytest.mark.parametrize("interpolant", INTERPOLANTS)
def test_build(benchmark, capsys, lens, interpolant):
    """20 × 20 × 31 points, the measured error included: ≤ 3 ms."""
    cpu, wall = cpu_median(lambda: build_database(lens, WIDE, interpolant))
    size = len(database_bytes(build_database(lens, WIDE, interpolant), lens))
    report(capsys, f"build {interpolant}", cpu, wall, f", file {size / 1e3:.1f} kB")
    benchmark.pedantic(build_database, (lens, WIDE, interpolant), rounds=20)


@pytest.mark.parametrize("interpolant", INTERPOLANTS)
def test_look_up(benchmark, capsys, lens, interpolant):
    """One point ≤ 20 µs, 10 000 scattered points ≤ 5 ms."""
    database = build_database(lens, WIDE, interpolant)
    cpu, wall = cpu_median(lambda: [database.coefficients(900.0, 0.1, 0.55) for _ in range(100)], 50)
    report(capsys, f"one look-up, {interpolant}", cpu / 100, wall / 100)
    points = scatter(WIDE, 10_000, getattr(database, "last_depth_mm", np.inf))
    report(capsys, f"10 000 look-ups, {interpolant}", *cpu_median(lambda: database.coefficients(*points)))
    benchmark(database.coefficients, 900.0, 0.1, 0.55)


def test_render_12_400(benchmark, capsys, lens):
    """12 400 PSFs 64 × 64 with |Wd| ≤ 10 waves: ≤ 2 s on one thread, faster on two, ≤ 8 MiB beyond the result."""
    database = build_database(lens, NEAR_FOCUS)
    assert np.abs(database.coefficients(*NEAR_FOCUS.axes).wd).max() <= 10
    for sampling in (SAMPLING, Sampling(64, 1.0, "settled")):
        cpu, wall = cpu_median(lambda sampling=sampling: render_source(database, NEAR_FOCUS.axes, sampling), 3)
        start = perf_counter()
        render_source(database, NEAR_FOCUS.axes, sampling, threads=2)
        two = perf_counter() - start
        tracemalloc.start()
        result = render_source(database, NEAR_FOCUS.axes, sampling)
        beyond = (tracemalloc.get_traced_memory()[1] - result.nbytes) / MIB
        tracemalloc.stop()
        more = f", two threads wall {1e3 * two:.4g} ms, {beyond:.1f} MiB beyond the result"
        report(capsys, f"12 400 PSFs, {sampling.quality}", cpu, wall, more)
    size = len(database_bytes(database, lens))
    assert result.nbytes >= 400 * size
    report(capsys, "coefficients are smaller than PSFs by", 0, 0, f" a factor {result.nbytes / size:.0f}")
    benchmark.pedantic(render_source, (database, NEAR_FOCUS.axes, SAMPLING), rounds=1)


def test_render_beyond_ten_waves(benchmark, capsys, lens):
    """Points of 10 to 60 waves, each with the sampling it needs, timed apart."""
    space = Space(depth_nodes(5000, count=20), FIELDS, np.linspace(0.42, 0.7, 31))
    database = build_database(lens, space)
    found = np.broadcast_to(np.abs(database.coefficients(*space.axes).wd), space.shape)
    points = [x[found > 10] for x in np.broadcast_arrays(*space.axes)]
    some = [x[::20] for x in points]
    cpu, wall = cpu_median(lambda: render_source(database, some, Sampling(64, 4.0)), 3)
    count = len(some[0])
    report(capsys, f"{count} PSFs of 10 to {found.max():.0f} waves", cpu, wall, f", {1e3 * cpu / count:.3g} ms each")
    benchmark.pedantic(render_source, (database, some, Sampling(64, 4.0)), rounds=1)
