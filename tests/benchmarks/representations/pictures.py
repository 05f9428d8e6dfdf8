"""Pictures themselves: PSFs on nodes with interpolation between, and few pictures that all others are sums of (PCA)."""

from collections.abc import Iterator
from functools import partial
from itertools import product
from time import process_time

import numpy as np

from tests.benchmarks.representations.interpolation import RULES, Counts, Rule, node_weights
from tests.benchmarks.representations.representation import (
    ExactPsfs,
    Representation,
    clipped_to_unit_sum,
    mirror_halves,
    right_half,
)
from tests.benchmarks.representations.space import LensSpace, SpacePoints, axis_nodes

NODES = 1, 2, 3, 5, 9, 17  # of an axis
BUDGETS = 1, 2, 4, 8, 16, 32, 64, 128, 256, 450  # nodes; 450 half pictures of 64² in 8 bits are one megabyte
LINES = (0.5, 0.8, 0.5), (0.2, 0.4, 0.8)  # places through which axes are tried, along one after the other
TRIED, TRIED_SEED = 10, 7  # points on each line
RANKS = 1, 2, 4, 8, 16, 32, 64
SMALL_RANK = 2  # up to which scores on the largest grid would take most of the bytes
SMALL_BUDGET = 64  # nodes of the scores of such a rank
STEPS = {8: 127, 16: 32767}  # of a picture's values by the bits of each


def used_counts(space: LensSpace, counts: Counts) -> Counts:
    """Return the counts with one node along axes that do not vary."""
    depths, fields, waves = (n if varies else 1 for n, varies in zip(counts, space.spread, strict=True))
    return depths, fields, waves


def best_grids(space: LensSpace, exact: ExactPsfs, most: int = BUDGETS[-1]) -> list[Counts]:
    """Return grids of nodes for all budgets up to ``most``, divided among the axes as suits this lens.

    Along each axis alone the better of linear and cubic interpolation is tried; the squares of the axes' errors add.
    """
    errors = [[_line_error(space, exact, axis, count) for count in NODES] for axis in range(3)]
    grids = []
    for budget in (n for n in BUDGETS if n <= most):
        splits = [where for where in product(range(len(NODES)), repeat=3) if _size(where) <= budget]
        best = min(splits, key=lambda where: (sum(errors[axis][n] ** 2 for axis, n in enumerate(where)), _size(where)))
        grids.append(used_counts(space, (NODES[best[0]], NODES[best[1]], NODES[best[2]])))
    return list(dict.fromkeys(grids))


def _size(where: tuple[int, ...]) -> int:
    return int(np.prod([NODES[n] for n in where]))


def _line_error(space: LensSpace, exact: ExactPsfs, axis: int, count: int) -> float:
    """Return the RMS relative L2 error between so many nodes along one axis, on LINES."""
    if not space.spread[axis]:
        return 0.0
    tried = np.random.default_rng(TRIED_SEED).random(TRIED)
    found = []
    for line in LINES:
        nodes, places = (np.repeat(np.array([line]), n, 0) for n in (count, TRIED))
        nodes[:, axis], places[:, axis] = axis_nodes(count), tried
        table, wanted = exact.at(space.at(nodes)), exact.at(space.at(places))
        for rule in RULES[1:]:
            weights = node_weights((count, 1, 1), rule, np.stack([tried, tried, tried], 1))
            made = np.tensordot(weights, table, 1)
            error = np.linalg.norm(made - wanted, axis=(1, 2)) / np.linalg.norm(wanted, axis=(1, 2))
            found.append((rule, float(np.mean(error**2))))
    best = min(sum(square for one, square in found if one == rule) for rule in RULES[1:])
    return float(np.sqrt(best / len(LINES)))


def grid_representations(space: LensSpace, exact: ExactPsfs, quick: bool = False) -> Iterator[Representation]:
    """Yield grids of PSFs of growing size with every rule of interpolation."""
    grids = best_grids(space, exact, SMALL_BUDGET if quick else BUDGETS[-1])
    for counts, rule in product(grids[-1:] if quick else grids, RULES):
        kept, nbytes = quantise(exact.at(space.grid(counts)), 8)
        table = right_half(kept)
        psf = partial(_interpolate, space, counts, rule, table)
        words = f"{' × '.join(map(str, counts))} nodes, roots of half pictures in 8 bits, {rule}"
        yield Representation("PSF grid", words, table.size, nbytes, len(table) * exact.seconds, psf)


def _interpolate(space: LensSpace, counts: Counts, rule: Rule, table: np.ndarray, points: SpacePoints) -> np.ndarray:
    weights = node_weights(counts, rule, points.cube).astype(np.float32)
    return clipped_to_unit_sum(mirror_halves(weights @ table, space.window.pixels))


def pca_representations(space: LensSpace, exact: ExactPsfs, quick: bool = False) -> Iterator[Representation]:
    """Yield principal components of growing rank, their scores splined over nodes."""
    small, large = best_grids(space, exact, SMALL_BUDGET)[-1], best_grids(space, exact, BUDGETS[-1])[-1]
    if quick:
        large = small
    pictures = exact.at(space.grid(large))
    started = process_time()
    basis = principal(pictures, max(RANKS))
    seconds = len(pictures) * exact.seconds + process_time() - started
    for rank in RANKS[2:3] if quick else RANKS:
        counts = small if rank <= SMALL_RANK else large
        if rank < len(pictures):
            yield _components(space, counts, exact.at(space.grid(counts)), basis[: rank + 1], seconds)


def principal(pictures: np.ndarray, rank: int) -> np.ndarray:
    """Return the mean of pictures (n, y, x) and their first principal components, strongest first (Lauer 2002)."""
    flat = pictures.reshape(len(pictures), -1)
    mean = flat.mean(0)
    deviation = flat - mean
    # The pictures are fewer than the pixels, so the small Gram matrix has all the singular values.
    vectors = np.linalg.eigh(deviation @ deviation.T)[1][:, : -1 - rank : -1]
    components = np.linalg.qr(deviation.T @ vectors)[0].T
    return np.concatenate([mean[None], components]).reshape(-1, *pictures.shape[1:])


def _components(
    space: LensSpace, counts: Counts, pictures: np.ndarray, basis: np.ndarray, seconds: float
) -> Representation:
    started = process_time()
    kept, nbytes = quantise(basis, 8)
    scores = scores_of(pictures, kept).astype(np.float16)
    seconds += process_time() - started
    grid = " × ".join(map(str, counts))
    words = f"rank {len(basis) - 1}, roots of half pictures in 8 bits, scores on {grid} nodes, cubic"
    psf = partial(_compose, space, counts, right_half(kept), scores.astype(np.float32))
    numbers = right_half(kept).size + scores.size
    return Representation("PCA", words, numbers, nbytes + scores.nbytes, seconds, psf)


def quantise(pictures: np.ndarray, bits: int) -> tuple[np.ndarray, int]:
    """Return pictures (n, y, x) as ``bits`` keep the roots of their values, and the bytes that half of each takes.

    Steps that are even in the root follow the skirts, which even steps in the value would lose. Signs are kept, and
    each picture has its own scale.
    """
    scale = np.abs(pictures).max((1, 2), keepdims=True)
    roots = np.sign(pictures) * np.sqrt(np.abs(pictures) / scale)
    rounded = np.rint(roots * STEPS[bits]) / STEPS[bits]
    nbytes = right_half(pictures).size * bits // 8 + 4 * len(pictures)
    return (np.sign(rounded) * rounded**2 * scale).astype(np.float32), nbytes


def scores_of(pictures: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Return how much of each component, (n, rank), comes nearest to the pictures; the first of ``kept`` is the mean.

    By least squares, since rounded components are not quite orthogonal.
    """
    flat, components = (pictures - kept[0]).reshape(len(pictures), -1), kept[1:].reshape(len(kept) - 1, -1)
    found: np.ndarray = np.linalg.lstsq(components.T, flat.T, rcond=None)[0].T
    return found


def _compose(
    space: LensSpace, counts: Counts, halves: np.ndarray, scores: np.ndarray, points: SpacePoints
) -> np.ndarray:
    weights = node_weights(counts, "cubic", points.cube).astype(np.float32)
    found = halves[0] + (weights @ scores) @ halves[1:]
    return clipped_to_unit_sum(mirror_halves(found, space.window.pixels))
