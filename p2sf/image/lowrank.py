"""Space-variant blur by few kernels: the mean, and the strongest deviations from it with maps of their strength.

The deviations of a set of unit-sum kernels from their mean have zero sum, and so have the singular vectors:
light is conserved for any rank (PCA of PSFs, Lauer 2002; singular values as in Eckart & Young 1936).
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from p2sf.image.lattice import Lattice, common_size
from p2sf.image.progress import Progress
from p2sf.image.region import Region, whole
from p2sf.threads import for_each

TILE = 256

Corner = tuple[int, int]
"""Row and column of a tile's first pixel."""


@dataclass(frozen=True, eq=False)
class LowRank:
    """One channel: ``mean`` (size, size), ``kernels`` (rank, size, size), ``strengths`` (rank, *nodes).

    ``left`` is the relative L2 norm of the remainder over all nodes.
    """

    mean: np.ndarray
    kernels: np.ndarray
    strengths: np.ndarray
    row_nodes: np.ndarray
    column_nodes: np.ndarray
    left: float


class PrincipalKernels(NamedTuple):
    """Flat kernels as ``mean`` (pixels,) plus ``strengths`` (rank, kernels) of ``shapes`` (rank, pixels).

    ``left``: the relative L2 norm of the remainder of all of them.
    """

    mean: np.ndarray
    shapes: np.ndarray
    strengths: np.ndarray
    left: float


def principal_kernels(flat: np.ndarray, tolerance: float, most: int | None = None) -> PrincipalKernels:
    """Return the fewest deviations from the mean that leave ``tolerance`` of kernels, (kernels, pixels), or ``most``.

    Arrays have the dtype of the kernels.
    """
    mean = flat.mean(0)
    deviation = flat - mean
    # The kernels are fewer than the pixels, so the small Gram matrix has all the singular values.
    values, vectors = np.linalg.eigh((deviation @ deviation.T).astype(float))
    values, vectors = np.maximum(values[::-1], 0), vectors[:, ::-1]
    whole_light = np.square(flat).sum(dtype=float) or 1.0
    left = np.sqrt(np.append(values[::-1].cumsum()[::-1], 0) / whole_light)
    rank = int(np.argmax(left <= tolerance))
    rank = rank if most is None else min(rank, most)
    strengths = vectors[:, :rank].T.astype(flat.dtype)
    return PrincipalKernels(mean, strengths @ deviation, strengths, float(left[rank]))


def decompose(lattice: Lattice, channel: int, tolerance: float = 1e-3, most: int | None = None) -> LowRank:
    """Return the fewest kernels that approximate the whole set to ``tolerance`` in relative L2, ``most`` at most."""
    kernels = common_size(lattice, channel)
    nodes, size = kernels.shape[:2], kernels.shape[-1]
    found = principal_kernels(kernels.reshape(nodes[0] * nodes[1], -1).astype(float), tolerance, most)
    mean, shapes = (each.astype(np.float32).reshape(-1, size, size) for each in (found.mean, found.shapes))
    strengths = found.strengths.reshape(-1, *nodes)
    return LowRank(mean[0], shapes, strengths, lattice.row_nodes, lattice.column_nodes, found.left)


def low_rank_blur(
    values: np.ndarray, parts: list[LowRank], watch: Progress | None = None, region: Region | None = None
) -> np.ndarray:
    """Return the blurred picture with all light that leaves it, (rows + 2·half, columns + 2·half, channels) float32.

    ``values`` are the pixels of a ``region``, by default all, each channel with its own of the ``parts``. Strengths are
    cubic splines between the nodes. Tiles bound the memory; ``watch`` is asked for cancellation at each of them.
    """
    values, size = np.asarray(values, np.float32), parts[0].mean.shape[0]
    region = region or whole(values.shape)
    rows, columns, channels = values.shape
    out = np.zeros((rows + size - 1, columns + size - 1, channels), np.float32)
    for channel, part in enumerate(parts):
        for_each(
            _tiles_blur(values[..., channel], part, region),
            product(range(0, rows, TILE), range(0, columns, TILE)),
            _adding(out[..., channel], watch or Progress()),
        )
    return out


def _tiles_blur(plane: np.ndarray, part: LowRank, region: Region) -> Callable[[Corner], tuple[Corner, np.ndarray]]:
    """Return the function that blurs the tile at a corner (top, left) of one channel and returns both."""
    (rows, columns), size = plane.shape, part.mean.shape[0]
    maps = [_spline(n, at) for n, at in ((part.row_nodes, region.rows), (part.column_nodes, region.columns))]
    fast, spectra = _spectra(part, min(TILE, rows), min(TILE, columns))

    def blur_at(corner: Corner) -> tuple[Corner, np.ndarray]:
        down, right = (slice(start, start + TILE) for start in corner)
        tile = plane[down, right]
        height, width = (n + size - 1 for n in tile.shape)
        return corner, _blur_tile(tile, part, (maps[0][down], maps[1][right]), fast, spectra)[:height, :width]

    return blur_at


def _adding(out: np.ndarray, watch: Progress) -> Callable[[tuple[Corner, np.ndarray]], None]:
    """Return the function that adds a blurred tile to one channel of the picture."""

    def take(found: tuple[Corner, np.ndarray]) -> None:
        (top, left), tile = found
        out[top : top + tile.shape[0], left : left + tile.shape[1]] += tile
        watch.check()

    return take


def _spectra(part: LowRank, rows: int, columns: int) -> tuple[tuple[int, ...], np.ndarray]:
    import scipy.fft

    size = part.mean.shape[0]
    fast = tuple(scipy.fft.next_fast_len(n + size - 1, real=True) for n in (rows, columns))
    return fast, scipy.fft.rfft2(np.concatenate([part.mean[None], part.kernels]), fast)


def _blur_tile(
    tile: np.ndarray, part: LowRank, maps: tuple[np.ndarray, np.ndarray], fast: tuple[int, ...], spectra: np.ndarray
) -> np.ndarray:
    """Return Σ_k (strength_k·tile) ⊛ kernel_k of one tile, summed in the spectrum."""
    import scipy.fft

    total = scipy.fft.rfft2(tile, fast) * spectra[0]
    for number, strength in enumerate(part.strengths, 1):
        weight = (maps[0] @ strength @ maps[1].T).astype(np.float32)
        total += scipy.fft.rfft2(tile * weight, fast) * spectra[number]
    blurred: np.ndarray = scipy.fft.irfft2(total, fast, overwrite_x=True)
    return blurred


def _spline(nodes: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Return the matrix (positions, nodes) of cubic-spline interpolation, constant beyond the outer nodes."""
    from scipy.interpolate import CubicSpline

    if len(nodes) == 1:
        return np.ones((len(positions), 1))
    inside = np.clip(positions, nodes[0], nodes[-1])
    if len(nodes) == 2:
        return np.stack([np.interp(inside, nodes, row) for row in np.eye(2)], axis=1)
    weights: np.ndarray = CubicSpline(nodes, np.eye(len(nodes)))(inside)
    return weights
