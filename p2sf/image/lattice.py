"""Kernels at the nodes of a lattice over a picture; between the nodes they are interpolated."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from p2sf.image.progress import Progress
from p2sf.pixel_kernels.nodes import nodes_along

WORKERS = 2
# Pixels of a kernel in all channels, such as three of 74²: NumPy's calls on smaller ones are so short that two threads
# mostly wait for the interpreter's lock. The kernels are the same either way.
THREADED = 2**14


@dataclass(frozen=True, eq=False)
class Lattice:
    """Nodes by row and column position in pixels, and the kernels at them, ``kernels[a][b]`` (channels, size, size).

    Sizes are odd and may differ; row 0 of a kernel is its top; each kernel of each channel has unit sum.
    """

    row_nodes: np.ndarray
    column_nodes: np.ndarray
    kernels: list[list[np.ndarray]]

    @property
    def half(self) -> int:
        """Return the largest half width of all kernels."""
        return max(int(kernel.shape[-1]) // 2 for line in self.kernels for kernel in line)

    @property
    def channels(self) -> int:
        """Return how many channels every kernel has."""
        return int(self.kernels[0][0].shape[0])


def build_lattice(
    kernel_at: Callable[[float, float], np.ndarray],
    shape: tuple[int, int],
    counts: tuple[int, int],
    mirrored: bool = False,
    watch: Progress | None = None,
) -> Lattice:
    """Return the lattice of ``kernel_at(row, column)`` over a picture of this shape.

    ``mirrored``: the picture is centred on the axis of a lens, so that one quarter of the kernels gives the others.
    """
    rows, columns = (nodes_along(n, c) for n, c in zip(shape, counts, strict=True))
    down, right = ((len(n) + 1) // 2 if mirrored else len(n) for n in (rows, columns))
    wanted = [(a, b) for a in range(down) for b in range(right)]
    watch = watch or Progress()
    watch.expect(len(wanted))

    def one(node: tuple[int, int]) -> np.ndarray:
        watch.advance()
        return kernel_at(float(rows[node[0]]), float(columns[node[1]]))

    first = one(wanted[0])
    rest = _each(one, wanted[1:], first.size >= THREADED)
    computed = dict(zip(wanted, (first, *rest), strict=True))
    lines = [
        [_mirrored(computed, a, b, len(rows), len(columns)) for b in range(len(columns))] for a in range(len(rows))
    ]
    return Lattice(rows, columns, lines)


def _each(
    make: Callable[[tuple[int, int]], np.ndarray], nodes: list[tuple[int, int]], threaded: bool
) -> list[np.ndarray]:
    """Return ``make(node)`` of every node, by WORKERS threads or one after the other."""
    if not threaded:
        return [make(node) for node in nodes]
    with ThreadPoolExecutor(WORKERS) as pool:
        return list(pool.map(make, nodes))


def _mirrored(computed: dict[tuple[int, int], np.ndarray], a: int, b: int, rows: int, columns: int) -> np.ndarray:
    """Return the kernel of a node, or the mirror image of the one across the axis."""
    if (a, b) in computed:
        return computed[a, b]
    down, right = a >= (rows + 1) // 2, b >= (columns + 1) // 2
    kernel = computed[rows - 1 - a if down else a, columns - 1 - b if right else b]
    mirror: np.ndarray = kernel[:, :: -1 if down else 1, :: -1 if right else 1]
    return mirror


def common_size(lattice: Lattice, channel: int) -> np.ndarray:
    """Return one channel's kernels padded with zeros to the largest size, (row nodes, column nodes, size, size)."""
    size = 2 * lattice.half + 1
    out = np.zeros((len(lattice.row_nodes), len(lattice.column_nodes), size, size), np.float32)
    for a, line in enumerate(lattice.kernels):
        for b, kernel in enumerate(line):
            edge = (size - kernel.shape[-1]) // 2
            out[a, b, edge : size - edge, edge : size - edge] = kernel[channel]
    return out
