"""Kernels at the nodes of a lattice over a picture; between the nodes they are interpolated."""

from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Lock

import numpy as np

from p2sf.image.progress import Progress
from p2sf.image.region import Region, whole
from p2sf.pixel_kernels.nodes import nodes_along
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


@dataclass(eq=False)
class NodeKernels:
    """The kernels of a picture's nodes, each computed when it is first needed.

    ``mirrored``: the picture is centred on the axis of a lens, so that one quarter of the kernels determines the
    others. Several threads may ask for kernels; one at a time computes.
    """

    kernels_at: KernelsAt
    row_nodes: np.ndarray
    column_nodes: np.ndarray
    mirrored: bool = False
    computed: dict[tuple[int, int], np.ndarray] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._lock = Lock()

    @property
    def bytes(self) -> int:
        """Return the memory that the kernels take."""
        return sum(kernel.nbytes for kernel in list(self.computed.values()))

    def over(self, region: Region, watch: Progress | None = None) -> Lattice:
        """Return the lattice over a part of the picture, its nodes in pixels from the first of that part.

        Beyond the picture's edge kernels are those of the edge.
        """
        rows = _about(self.row_nodes, region.top, region.bottom - 1)
        columns = _about(self.column_nodes, region.left, region.right - 1)
        with self._lock:
            self._compute([(a, b) for a in rows for b in columns], watch or Progress())
            lines = [[self._kernel(a, b) for b in columns] for a in rows]
        nodes = self.row_nodes[rows.start : rows.stop], self.column_nodes[columns.start : columns.stop]
        return Lattice(nodes[0] - region.top, nodes[1] - region.left, lines)

    def _compute(self, nodes: list[tuple[int, int]], watch: Progress) -> None:
        """Compute those kernels of nodes that are missing; threads (`p2sf.threads`) share them."""
        wanted = dict.fromkeys(self._computed_at(a, b) for a, b in nodes)
        missing = [node for node in wanted if node not in self.computed]
        if not missing:
            return
        watch.expect(len(missing))

        def some(nodes: list[tuple[int, int]]) -> list[tuple[tuple[int, int], np.ndarray]]:
            a, b = np.array(nodes).T
            return list(zip(nodes, self.kernels_at(self.row_nodes[a], self.column_nodes[b]), strict=True))

        def take(found: list[tuple[tuple[int, int], np.ndarray]]) -> None:
            self.computed.update(found)
            watch.advance(len(found))

        take(some(missing[:FIRST]))
        step = max(1, min(TOGETHER // self.computed[missing[0]].size, MOST_NODES))
        for_each(some, [missing[start : start + step] for start in range(FIRST, len(missing), step)], take, ahead=None)

    def _computed_at(self, a: int, b: int) -> tuple[int, int]:
        """Return the node whose kernel determines that of a node: itself, or its mirror image across the axis."""
        if not self.mirrored:
            return a, b
        return min(a, len(self.row_nodes) - 1 - a), min(b, len(self.column_nodes) - 1 - b)

    def _kernel(self, a: int, b: int) -> np.ndarray:
        """Return the kernel of a node, or the mirror image of the one across the axis."""
        at = self._computed_at(a, b)
        kernel: np.ndarray = self.computed[at][:, :: 1 if at[0] == a else -1, :: 1 if at[1] == b else -1]
        return kernel


def known_kernels(lattice: Lattice) -> NodeKernels:
    """Return the kernels of a lattice over the whole picture as if they had been needed."""

    def none_missing(rows: np.ndarray, columns: np.ndarray) -> list[np.ndarray]:
        raise AssertionError("the lattice has all kernels")

    nodes = {(a, b): kernel for a, line in enumerate(lattice.kernels) for b, kernel in enumerate(line)}
    return NodeKernels(none_missing, lattice.row_nodes, lattice.column_nodes, computed=nodes)


def _about(nodes: np.ndarray, first: float, last: float) -> range:
    """Return the numbers of the nodes between which these positions lie."""
    start = int(np.searchsorted(nodes, first, "right")) - 1
    stop = int(np.searchsorted(nodes, last, "left"))
    final = len(nodes) - 1
    return range(min(max(start, 0), final), min(max(stop, 0), final) + 1)


def build_lattice(
    kernels_at: KernelsAt,
    shape: tuple[int, int],
    counts: tuple[int, int],
    mirrored: bool = False,
    watch: Progress | None = None,
) -> Lattice:
    """Return the lattice of ``kernels_at(rows, columns)`` over a picture of this shape; ``mirrored`` as above."""
    rows, columns = (nodes_along(n, c) for n, c in zip(shape, counts, strict=True))
    return NodeKernels(kernels_at, rows, columns, mirrored).over(whole(shape), watch)


def common_size(lattice: Lattice, channel: int) -> np.ndarray:
    """Return one channel's kernels padded with zeros to the largest size, (row nodes, column nodes, size, size)."""
    size = 2 * lattice.half + 1
    out = np.zeros((len(lattice.row_nodes), len(lattice.column_nodes), size, size), np.float32)
    for a, line in enumerate(lattice.kernels):
        for b, kernel in enumerate(line):
            edge = (size - kernel.shape[-1]) // 2
            out[a, b, edge : size - edge, edge : size - edge] = kernel[channel]
    return out
