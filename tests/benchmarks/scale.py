"""What very many PSFs cost, measured from 10³ to 10⁶ and extrapolated to 10⁹: `python -m tests.benchmarks.scale`.

First a PSF against its blur: the products of its sum as `pupil.cost` counts them, and the time of one in a batch.
Then stacks of 10³, 10⁴ … PSFs of one and the same space, the Double Gauss f/3 from 60 m to infinity, 0 to 14° and 420
to 700 nm, 64² samples as far apart as the finest PSF needs, on ever more nodes; beside each the bytes of the same space
as coefficients. A stack that would take longer than `--most-s` is estimated from chunks drawn at random, which are
rendered and written one by one. One thread; CPU time.
"""

import argparse
import shutil
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil, inf
from pathlib import Path
from time import process_time

import numpy as np

from p2sf.conventions import slope_from_degrees
from p2sf.database.build import build_database
from p2sf.database.files.npz import database_bytes
from p2sf.database.files.place import size_bytes
from p2sf.database.files.stack import Stack
from p2sf.database.files.stack_work import StackProgress, chunk_costs, psf_count, write_chunk
from p2sf.database.files.stack_write import write_stack
from p2sf.database.render import Sampling
from p2sf.database.space import Space
from p2sf.figures.pixel_light import critical_pixel_um
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.seidel_stack import stack_of
from p2sf.pupil.cost import separable_products
from p2sf.spans import depth_nodes
from p2sf.threads import one_blas_thread

LENS = "double_gauss_28"
NODES = {1_000: (10, 10, 10), 10_000: (20, 20, 25), 100_000: (40, 50, 50), 1_000_000: (100, 100, 100)}
DRAWN = 60  # chunks of a stack that is estimated
BLURS = 0.25, 1, 3, 10, 30  # waves of defocus at the pupil's rim
BATCH = 10
SAMPLING = Sampling(64)


@dataclass(frozen=True)
class Scale:
    """What a stack of ``psfs`` PSFs takes; ``share`` of its chunks were rendered."""

    psfs: int
    share: float
    seconds: float
    stack_bytes: float
    products: float
    coefficient_bytes: int
    coefficient_seconds: float


def blur_rows() -> Iterator[tuple[float, int, float, float]]:
    """Yield blur radius in λ/NA, samples a side that hold it, products and milliseconds of one PSF."""
    lens = find_lens(LENS)
    sharp = coefficients(lens, inf, np.zeros(BATCH), lens.reference_wavelength_um)
    pitch = float(np.min(critical_pixel_um(sharp.wavelength_um, sharp.na)))
    for waves in BLURS:
        blurred = replace(sharp, w40=0 * sharp.wd, wd=waves + 0 * sharp.wd)
        radius = 2 * waves  # |∂W/∂ρ| of W20ρ² at the rim: waves, and radius of the blur in λ/NA
        pixels = max(64, 16 * ceil(8 * 1.25 * radius / 16))
        start = process_time()
        rounds = 0
        while process_time() - start < 0.5 or rounds < 2:
            stack_of(blurred, pixels, pitch, "settled", np.float32)
            rounds += 1
        seconds = (process_time() - start) / rounds / BATCH
        yield radius, pixels, float(separable_products(blurred, pixels, pitch)[0]), 1e3 * seconds


def measured(nodes: tuple[int, int, int], folder: Path, most_s: float) -> Scale:
    """Return what a stack on so many depths, fields and wavelengths takes."""
    lens = find_lens(LENS)
    fields, colours = slope_from_degrees(np.linspace(0, 14, nodes[1])), np.linspace(0.42, 0.7, nodes[2])
    start = process_time()
    database = build_database(lens, Space(depth_nodes(60_000, count=nodes[0]), fields, colours))
    built = process_time() - start
    path = folder / "stack.zarr"
    stack = write_stack(database, lens, path, SAMPLING, StackProgress(cancelled=lambda: True))
    costs = chunk_costs(stack, stack.chunks)
    order = np.random.default_rng(0).permutation(len(stack.chunks))
    done, seconds, empty = 0, 0.0, size_bytes(path)
    while done < len(order):
        if done == DRAWN and seconds / costs[order[:done]].sum() * costs.sum() > most_s:
            break
        start = process_time()
        write_chunk(stack, stack.chunks[order[done]])
        seconds += process_time() - start
        done += 1
    psfs = _psfs(stack, order)
    share = costs[order[:done]].sum() / costs.sum()
    written = (size_bytes(path) - empty) / _psfs(stack, order[:done]) * psfs
    shutil.rmtree(path)
    return Scale(psfs, share, seconds / share, written, costs.sum(), len(database_bytes(database, lens)), built)


def _psfs(stack: Stack, some: np.ndarray) -> int:
    chunks = stack.chunks
    return sum(psf_count(stack, chunks[k]) for k in some)


def main(arguments: list[str] | None = None) -> int:
    asked = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    asked.add_argument("--most", type=int, default=max(NODES), help="PSFs of the largest stack")
    asked.add_argument("--most-s", type=float, default=60.0, help="CPU seconds from which a stack is estimated")
    options = asked.parse_args(arguments)
    print("| blur radius, λ/NA | samples | products | ms | products/s |\n|---|---|---|---|---|")
    with one_blas_thread:
        for radius, pixels, count, ms in blur_rows():
            print(f"| {radius:g} | {pixels}² | {count:.2g} | {ms:.3g} | {count / ms * 1e3:.1e} |", flush=True)
        print("\n| PSFs | rendered | CPU s | PSFs/s | products | stack | bytes/PSF | as coefficients | built |")
        print("|---|---|---|---|---|---|---|---|---|")
        with tempfile.TemporaryDirectory() as name:
            for psfs, nodes in NODES.items():
                if psfs <= options.most:
                    found = measured(nodes, Path(name), options.most_s)
                    print(row(found), flush=True)
    larger = 1e9 / found.psfs
    print(
        row(
            replace(
                found,
                psfs=10**9,
                share=0,
                seconds=found.seconds * larger,
                products=found.products * larger,
                stack_bytes=found.stack_bytes * larger,
            )
        ),
        "extrapolated",
    )
    return 0


def row(found: Scale) -> str:
    """Return a row of the table."""
    each = found.stack_bytes / found.psfs
    return (
        f"| {found.psfs:.0e} | {found.share:.1%} | {found.seconds:.3g} | {found.psfs / found.seconds:.3g} "
        f"| {found.products:.2g} | {found.stack_bytes:.3g} B | {each:.0f} "
        f"| {found.coefficient_bytes} B | {found.coefficient_seconds:.3g} s |"
    )


if __name__ == "__main__":
    sys.exit(main())
