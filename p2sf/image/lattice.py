"""Kernels at the nodes of a lattice over a picture; between the nodes they are interpolated."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from p2sf.image.progress import Progress
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.scene.planning.pricing import computed_counts
from p2sf.threads import for_each

# Numbers of nodes whose kernels are requested at once: first a few, to find their size; then by pixels, or nodes.
FIRST, TOGETHER, MOST_NODES = 4, 2**16, 32


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
        """Return the number of channels of every kernel."""
        return int(self.kernels[0][0].shape[0])


KernelsAt = Callable[[np.ndarray, np.ndarray], list[np.ndarray]]
"""From rows and columns of some nodes, (nodes,) each, to their kernels, (channels, size, size) each."""


def build_lattice(
    kernels_at: KernelsAt,
    shape: tuple[int, int],
    counts: tuple[int, int],
    mirrored: bool = False,
    watch: Progress | None = None,
    beside: Callable[[], object] | None = None,
) -> Lattice:
    """Return the lattice of ``kernels_at(rows, columns)`` over a picture of this shape.

    ``mirrored``: the picture is centred on the axis of a lens, so that one quarter of the kernels determines the
    others. Threads (`p2sf.threads`) share the kernels; the first one calls ``beside``. NumPy's calls on small kernels
    are so short that two threads mostly wait for the interpreter's lock: other work on large arrays keeps both busy.
    """
    rows, columns = (nodes_along(n, c) for n, c in zip(shape, counts, strict=True))
    down, right = computed_counts((len(rows), len(columns)), mirrored)
    wanted = [(a, b) for a in range(down) for b in range(right)]
    watch = watch or Progress()
    watch.expect(len(wanted))
    computed: dict[tuple[int, int], np.ndarray] = {}

    def some(nodes: list[tuple[int, int]]) -> list[tuple[tuple[int, int], np.ndarray]]:
        if nodes:
            a, b = np.array(nodes).T
            return list(zip(nodes, kernels_at(rows[a], columns[b]), strict=True))
        if beside is not None:
            beside()
        return []

    def take(found: list[tuple[tuple[int, int], np.ndarray]]) -> None:
        computed.update(found)
        watch.advance(len(found))

    take(some(wanted[:FIRST]))
    step = max(1, min(TOGETHER // computed[wanted[0]].size, MOST_NODES))
    parts = [wanted[start : start + step] for start in range(FIRST, len(wanted), step)]
    for_each(some, [[], *parts], take, ahead=None)
    lines = [
        [_kernel_of_node(computed, a, b, len(rows), len(columns)) for b in range(len(columns))]
        for a in range(len(rows))
    ]
    return Lattice(rows, columns, lines)


def _kernel_of_node(computed: dict[tuple[int, int], np.ndarray], a: int, b: int, rows: int, columns: int) -> np.ndarray:
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
