"""Sharpening side by side: ``python -m tests.benchmarks.deblurring``, about a minute of one core.

Every method gets the same pictures, noise and kernels, and its own setting is the one with the best PSNR: rounds of
Richardson-Lucy; the noise told to Wiener's filter, as a multiple of the true one; and where there is one kernel, that
of the picture's middle or the mean of all. Beside its best stands Wiener's filter as the program runs it, told the
noise as stated and as estimated. The pictures are blurred with sixteen times as many kernels as are known of
them, so that no method gets back what it put in. One thread; CPU seconds, and the peak of the arrays that a call makes.
"""

import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from time import process_time

import numpy as np

from p2sf.colour.colorimetry import srgb_from_linear
from p2sf.image.blur_operator import BlurOperator
from p2sf.image.charts import draw_chart
from p2sf.image.deblur import photo_statistics, psnr, richardson_lucy, wiener
from p2sf.image.form import plan_lattice
from p2sf.image.lattice import Lattice
from p2sf.image.similarity import ssim
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

SIDE, BORDER = 256, 24  # pixels; beyond the border all is black, which only Richardson-Lucy knows, so it does not count
CHARTS = ("landscape", "text"), ("siemens_star", "checkerboard")
GREEN = (Channel("green", (540.0,), (1.0,)),)
SENSORS = {
    "double_gauss_28": Sensor(SIDE, SIDE, 30.0, (0.0, 10.5)),  # 7 to 15 mm from the axis
    "landscape": Sensor(SIDE, SIDE, 40.0, (0.0, 6.0)),  # 1 to 12 mm
}
NODES = {"double_gauss_28": 3, "landscape": 9}  # of kernels along a side; figures of methods do not follow plans
NOISES = 0.002, 0.01  # standard deviation, white at 1
ROUNDS = 3, 5, 8, 12, 20, 30, 50, 80, 120, 200, 350, 600
TOLD = 0.06, 0.12, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0
WORSE_DB = 0.5
FINER = 4  # times as many kernels each way blur the picture
RING = (
    "Ring deconvolution is not installed: what pip finds under the name rdmpy is another program; RDMPy is installed "
    "from its authors' repository and needs PyTorch."
)

Sharpen = Callable[[], np.ndarray]


@dataclass(frozen=True)
class Case:
    """A picture, and what the lens and the noise made of it; the kernels known of it."""

    lens: str
    noise: float
    truth: np.ndarray
    blurred: np.ndarray
    lattice: Lattice


@dataclass(frozen=True)
class Row:
    """What a method reached with its best setting, in CPU seconds and MiB."""

    method: str
    setting: str
    db: float
    similarity: float
    seconds: float
    mebibytes: float


def cases() -> Iterator[Case]:
    """Yield every lens with every noise."""
    parts = [[draw_chart(name, SIDE // 2, SIDE // 2)[..., 1:2] for name in line] for line in CHARTS]
    truth = np.concatenate([np.concatenate(line, axis=1) for line in parts])
    for lens, sensor in SENSORS.items():
        planned = replace(plan(find_lens(lens), Scene(sensor, GREEN)), counts=2 * (NODES[lens],))
        lattice = plan_lattice(planned, planned.vergences[0])
        finer = replace(planned, counts=tuple(FINER * n for n in planned.counts))
        light = BlurOperator(plan_lattice(finer, planned.vergences[0]), (SIDE, SIDE)).forward(truth)
        for noise in NOISES:
            random = np.random.default_rng(1)
            yield Case(lens, noise, truth, light + random.normal(0, noise, light.shape).astype(np.float32), lattice)


def rows(case: Case) -> Iterator[Row]:
    """Yield every method's best."""
    yield _row(case, "as blurred", "", lambda: case.blurred)
    yield _best(case, "Richardson–Lucy, one kernel", _lucy(case, one_kernel(case.lattice)))
    yield _best(case, "Wiener, one kernel", _wiener(case, one_kernel(case.lattice)))
    yield _best(case, "Wiener, kernels of the field", _wiener(case, {"": case.lattice}))
    for told, noise in (("as stated", case.noise), ("as estimated", photo_statistics(case.blurred, case.lattice))):
        sharpen = partial(wiener, case.blurred, case.lattice, noise, threads=1)
        yield _row(case, "Wiener, kernels of the field", f"noise {told}", sharpen)
    yield _best(case, "Richardson–Lucy, kernels of the field", _lucy(case, {"": case.lattice}))


def one_kernel(lattice: Lattice) -> dict[str, Lattice]:
    """Return lattices of one node: with the kernel of the middle, and with the mean of all kernels."""
    a, b = (len(nodes) // 2 for nodes in (lattice.row_nodes, lattice.column_nodes))
    middle, half = np.array([(SIDE - 1) / 2]), lattice.half
    padded = [
        np.pad(kernel, ((0, 0), *2 * ((half - kernel.shape[-1] // 2,) * 2,)))
        for line in lattice.kernels
        for kernel in line
    ]
    kernels = {"kernel of the middle, ": lattice.kernels[a][b], "mean kernel, ": np.mean(padded, axis=0)}
    return {name: Lattice(middle, middle, [[kernel]]) for name, kernel in kernels.items()}


def _lucy(case: Case, lattices: dict[str, Lattice]) -> Iterator[list[tuple[str, Sharpen]]]:
    """Yield for each lattice Richardson and Lucy's method with more and more rounds."""
    for name, known in lattices.items():
        yield [
            (f"{name}{n} rounds", lambda n=n, known=known: richardson_lucy(case.blurred, known, n, threads=1))
            for n in ROUNDS
        ]


def _wiener(case: Case, lattices: dict[str, Lattice]) -> Iterator[list[tuple[str, Sharpen]]]:
    """Yield for each lattice Wiener's filter told more and more noise."""
    for name, known in lattices.items():
        yield [
            (f"{name}noise × {n:g}", lambda n=n, known=known: wiener(case.blurred, known, n * case.noise, threads=1))
            for n in TOLD
        ]


def _best(case: Case, method: str, settings: Iterator[list[tuple[str, Sharpen]]]) -> Row:
    """Return the row of the best setting; each line of settings is tried until it gets clearly worse."""
    found: list[tuple[float, str, Sharpen]] = []
    for line in settings:
        best = -np.inf
        for setting, sharpen in line:
            now = psnr(_inner(sharpen()), _inner(case.truth))
            found.append((now, setting, sharpen))
            if now < best - WORSE_DB:
                break
            best = max(best, now)
    _, setting, sharpen = max(found, key=lambda one: one[0])
    return _row(case, method, setting, sharpen)


def _row(case: Case, method: str, setting: str, sharpen: Sharpen) -> Row:
    start = process_time()
    picture = sharpen()
    seconds = process_time() - start
    tracemalloc.start()
    sharpen()
    peak = tracemalloc.get_traced_memory()[1] / 2**20
    tracemalloc.stop()
    levels = (srgb_from_linear(np.clip(_inner(values), 0, 1)) for values in (picture, case.truth))
    return Row(method, setting, psnr(_inner(picture), _inner(case.truth)), ssim(*levels), seconds, peak)


def _inner(values: np.ndarray) -> np.ndarray:
    return values[BORDER:-BORDER, BORDER:-BORDER]


def main() -> None:
    """Print the table in Markdown, as the handbook has it."""
    print("| lens, noise | method | setting | PSNR | SSIM | CPU | memory |")
    print("|---|---|---|---|---|---|---|")
    for case in cases():
        for row in rows(case):
            about = f"{case.lens}, {case.noise:g} | {row.method} | {row.setting}"
            taken = f" {_milliseconds(row.seconds)} | {row.mebibytes:.0f} MiB |" if row.mebibytes >= 0.5 else "  |  |"
            print(f"| {about} | {row.db:.1f} dB | {row.similarity:.3f} |{taken}", flush=True)
    print(f"| all | ring deconvolution (RDMPy) | not installed |  |  |  |  |\n\n{RING}")


def _milliseconds(seconds: float) -> str:
    return f"{round(100 * seconds) * 10} ms" if seconds >= 0.01 else "under 10 ms"


if __name__ == "__main__":
    main()
