"""The blur as an operator is the sum over every pixel's own interpolated kernel, and its transpose is one."""

import numpy as np
import pytest

from p2sf.image import blur_operator
from p2sf.image.blur_operator import BlurOperator, best_blocks
from p2sf.image.lattice import Lattice
from p2sf.pixel_kernels.nodes import nodes_along
from tests.support.direct_sum import direct_sum

SHAPE = 37, 50
CASES = {
    "one node": ((1, 1), 3, 1),
    "one row of nodes": ((1, 4), 3, 1),
    "cells longer than kernels": ((2, 3), 2, 3),
    "cells shorter than kernels": ((12, 17), 9, 1),
    "almost as many nodes as pixels": ((30, 41), 1, 1),
    "kernels as large as the picture": ((3, 3), 20, 1),
}
FLOAT32 = 2e-6  # of the largest value: some ten roundings of 6e-8 in transforms of about 100²


def random_lattice(counts, half, channels, shape=SHAPE) -> Lattice:
    """Return kernels of random values and of sizes up to 2·half + 1, the largest at the first node."""
    random = np.random.default_rng(3)
    lines = [[_kernel(random, half if a + b == 0 else random.integers(half // 2, half + 1), channels)
              for b in range(counts[1])] for a in range(counts[0])]  # fmt: skip
    return Lattice(nodes_along(shape[0], counts[0]), nodes_along(shape[1], counts[1]), lines)


def _kernel(random, half, channels):
    kernel = random.random((channels, 2 * half + 1, 2 * half + 1)).astype(np.float32)
    return kernel / kernel.sum((1, 2), keepdims=True)


def kernel_between(lattice: Lattice, row: float, column: float) -> np.ndarray:
    """Return the kernel of a pixel: the sum of the nodes' own times 1 − distance in cells, where that is positive."""
    half = lattice.half
    found = np.zeros((lattice.channels, 2 * half + 1, 2 * half + 1))
    weights = [_hats(nodes, place) for nodes, place in ((lattice.row_nodes, row), (lattice.column_nodes, column))]
    for a, down in weights[0]:
        for b, right in weights[1]:
            kernel = lattice.kernels[a][b]
            edge = half - kernel.shape[-1] // 2
            size = kernel.shape[-1]
            found[:, edge : edge + size, edge : edge + size] += down * right * kernel
    return found


def _hats(nodes, place):
    if len(nodes) == 1:
        return [(0, 1.0)]
    weights = 1 - np.abs(nodes - place) / (nodes[1] - nodes[0])
    return [(int(n), weights[n]) for n in np.flatnonzero(weights > 0)]


@pytest.mark.parametrize("case", CASES)
def test_the_blur_is_the_direct_sum(case):
    counts, half, channels = CASES[case]
    lattice = random_lattice(counts, half, channels)
    picture = np.random.default_rng(5).random((*SHAPE, channels)).astype(np.float32)
    truth = direct_sum(picture, lambda row, column: kernel_between(lattice, row, column), half)
    found = BlurOperator(lattice, SHAPE).forward(picture)
    assert np.abs(found - truth[half:-half, half:-half]).max() <= FLOAT32 * truth.max()


@pytest.mark.parametrize("case", CASES)
def test_the_adjoint_is_one(case):
    """⟨Hx, y⟩ = ⟨x, Hᵀy⟩; x and y have random signs, so that the products do not add up to one large number."""
    counts, half, channels = CASES[case]
    blur = BlurOperator(random_lattice(counts, half, channels), SHAPE)
    random = np.random.default_rng(4)
    x, y = (random.normal(size=(*SHAPE, channels)).astype(np.float32) for _ in range(2))
    one, two = (blur.forward(x).astype(float) * y).sum(), (x * blur.transposed(y).astype(float)).sum()
    size = np.linalg.norm(x) * np.linalg.norm(y)
    assert abs(one - two) <= FLOAT32 * size
    assert abs(one) > 100 * FLOAT32 * size


def test_spectra_too_large_to_keep_and_other_threads_give_the_same_bits(monkeypatch):
    lattice, shape = random_lattice((12, 17), 9, 3, (150, 200)), (150, 200)
    picture = np.random.default_rng(5).random((*shape, 3)).astype(np.float32)
    monkeypatch.setattr(blur_operator, "TOGETHER", 2**12)  # so that a row of blocks is several jobs
    kept = BlurOperator(lattice, shape, threads=1)
    monkeypatch.setattr(blur_operator, "KEPT_BYTES", 0)
    again = BlurOperator(lattice, shape, threads=3)
    assert any(columns[0] for _, columns in kept._jobs)
    assert np.array_equal(kept.forward(picture), again.forward(picture))
    assert np.array_equal(kept.transposed(picture), again.transposed(picture))


@pytest.mark.parametrize(("counts", "more", "merges"), [((100, 150), 64, True), ((3, 4), 8, False), ((1, 1), 8, False)])
def test_blocks_suit_the_kernels(counts, more, merges):
    """Cells of 8 pixels are merged where kernels reach 64; those of 400 are split, to stay in the cache."""
    nodes = nodes_along(832, counts[0]), nodes_along(1248, counts[1])
    for axis, count in zip(best_blocks(nodes, (832, 1248), more), counts, strict=True):
        assert (len(axis.starts) < count - 1) == merges
        assert merges or axis.weights.shape[-1] <= blur_operator.LONGEST
        assert axis.weights.sum() == pytest.approx(axis.stops[-1], rel=1e-6)  # the hats of each pixel sum to one
