"""A megapixel through the Double Gauss, its preview, and what cost grows with; skipped unless benchmarks are asked for.

``python -m pytest tests/benchmarks/test_image_speed.py --benchmark-only -s`` prints the figures and draws cost against
pixels, field nodes and rank as ``image_cost.png`` in the folder it runs in. Two threads; wall time on two free cores is
between half the CPU time and all of it.
"""

import resource
from dataclasses import replace
from statistics import median
from time import perf_counter, process_time

import pytest

from p2sf.image.blur_operator import BlurOperator
from p2sf.image.charts import draw_chart
from p2sf.image.deblur import richardson_lucy
from p2sf.image.form import Forming, form_image, plan_lattice
from p2sf.image.lowrank import decompose, low_rank_blur
from p2sf.image.preview import preview
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

ROWS, COLUMNS, WIDTH_UM = 832, 1248, 36000.0
WHOLE_S, PREVIEW_S, MEMORY_GIB = 6.0, 0.2, 1.5
SHARPEN_S, SHARPEN_GIB, SHARPEN_ROUNDS = 3.0, 0.5, 20
GREEN = (Channel("green", (540.0,), (1.0,)),)


def scene(columns: int = COLUMNS) -> Scene:
    """Return full frame, 36 mm wide, at this many columns."""
    return Scene(Sensor(columns * ROWS // COLUMNS, columns, WIDTH_UM / columns))


def timed(work, rounds: int = 1):
    """Return the last result, and the median wall and CPU seconds."""
    wall, cpu = [], []
    for _ in range(rounds):
        start = perf_counter(), process_time()
        result = work()
        wall.append(perf_counter() - start[0])
        cpu.append(process_time() - start[1])
    return result, median(wall), median(cpu)


@pytest.fixture(scope="module")
def planned():
    return plan(find_lens("double_gauss_28"), scene())


def test_richardson_lucy_of_a_megapixel(benchmark):
    """Comes first, while the process's peak of memory is its own."""
    planned = plan(find_lens("double_gauss_28"), replace(scene(), channels=GREEN))
    lattice = plan_lattice(planned, planned.vergences[0])
    picture = draw_chart("landscape", ROWS, COLUMNS)[..., 1:2]

    def work(threads: int = 2):
        return richardson_lucy(picture, lattice, SHARPEN_ROUNDS, threads=threads)

    _, wall, cpu = timed(work)
    _, wall_of_one, _ = timed(lambda: work(1))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(
        f"\n{SHARPEN_ROUNDS} rounds of Richardson-Lucy, {ROWS * COLUMNS / 1e6:.2f} megapixels of one channel: "
        f"wall {wall:.2f} s on two threads, {wall_of_one:.2f} s on one, CPU {cpu:.2f} s, peak {peak:.2f} GiB"
    )
    benchmark.pedantic(work, rounds=1)
    assert min(wall, cpu) <= SHARPEN_S and peak <= SHARPEN_GIB


@pytest.mark.parametrize("method", ["patches", "lowrank"])
def test_a_megapixel_in_colour(benchmark, planned, method):
    picture = draw_chart("landscape", ROWS, COLUMNS)

    def work():
        return form_image(planned, picture, how=Forming(method))

    _, wall, cpu = timed(work, 3)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(
        f"\n{method}: {ROWS * COLUMNS / 1e6:.2f} megapixels RGB, "
        f"wall {wall:.2f} s, CPU {cpu:.2f} s, peak {peak:.2f} GiB"
    )
    benchmark.pedantic(work, rounds=1)
    assert min(wall, cpu) <= WHOLE_S and peak <= MEMORY_GIB


def test_the_preview(benchmark):
    lens, asked, picture = find_lens("double_gauss_28"), scene(), draw_chart("landscape", ROWS, COLUMNS)
    _, wall, cpu = timed(lambda: preview(lens, asked, picture), 21)
    print(f"\npreview: wall {1e3 * wall:.0f} ms, CPU {1e3 * cpu:.0f} ms")
    benchmark.pedantic(lambda: preview(lens, asked, picture), rounds=3)
    assert min(wall, cpu) <= PREVIEW_S


def test_what_cost_grows_with(benchmark, planned):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    picture = draw_chart("landscape", ROWS, COLUMNS)
    lattice = plan_lattice(planned, 0.0)
    ranks = 2, 8, 32
    nodes = (3, 4), (6, 9), (12, 17)
    sides = 312, 624, 1248
    curves = {
        "low rank": [(n, timed(lambda n=n: _by_rank(picture, lattice, n))[2]) for n in ranks],
        "field nodes": [(a * b, timed(lambda c=(a, b): _by_nodes(planned, picture, c))[2]) for a, b in nodes],
        "megapixels": [(c * c * ROWS / COLUMNS / 1e6, timed(lambda c=c: _by_pixels(c, planned))[2]) for c in sides],
    }
    figure = Figure(figsize=(10, 3.2), dpi=120, layout="constrained")
    for axes, (name, points) in zip(figure.subplots(1, 3), curves.items(), strict=True):
        axes.loglog(*zip(*points, strict=True), "o-")
        axes.set(xlabel=name, ylabel="CPU seconds")
        axes.grid(alpha=0.3, which="both")
        print(f"{name}: " + ", ".join(f"{x:g} → {t:.2f} s" for x, t in points))
    FigureCanvasAgg(figure).print_png("image_cost.png")
    benchmark.pedantic(lambda: BlurOperator(lattice, (ROWS, COLUMNS)).spread(picture), rounds=1)


def _by_rank(picture, lattice, rank: int):
    return low_rank_blur(picture, [decompose(lattice, channel, 0.0, rank) for channel in range(3)])


def _by_nodes(planned, picture, counts):
    return form_image(replace(planned, counts=counts), picture)


def _by_pixels(columns: int, planned):
    asked = replace(planned, scene=scene(columns))
    return form_image(asked, draw_chart("landscape", asked.scene.sensor.rows, columns))
