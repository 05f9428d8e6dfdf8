"""Kernels at the nodes of a lattice over a picture; between the nodes they are interpolated."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cached_property
from threading import Lock

import numpy as np

from p2sf.image.progress import Progress
from p2sf.image.region import Region
from p2sf.pixel_kernels.nodes import hats
from p2sf.threads import for_each

# Numbers of nodes whose kernels are requested at once: first a few, to find their size; then by pixels, or nodes.
FIRST, TOGETHER, MOST_NODES = 4, 2**16, 32
POINTS = 6  # computed nodes through which those between are interpolated
STEPS = 4, 3, 2  # of nodes, one of which is computed

Node = tuple[int, int]
"""Numbers of a node along rows and along columns."""


@dataclass(frozen=True, eq=False)
class Lattice:
    """Nodes by row and column position in pixels, and the kernels at them, ``kernels[a][b]`` (channels, size, size).

    Sizes are odd and may differ; row 0 of a kernel is its top; each kernel of each channel has unit sum.
    """

    row_nodes: np.ndarray
    column_nodes: np.ndarray
    kernels: list[list[np.ndarray]]

    @cached_property
    def half(self) -> int:
        """Return the largest half width of all kernels."""
        return max(int(kernel.shape[-1]) // 2 for line in self.kernels for kernel in line)

    @property
    def channels(self) -> int:
        """Return the number of channels of every kernel."""
        return int(self.kernels[0][0].shape[0])

    def at(self, row: float, column: float) -> np.ndarray:
        """Return the kernels that blur a pixel, (channels, size, size): those of the nodes about it, by their hats."""
        places = (self.row_nodes, row), (self.column_nodes, column)
        down, right = (hats(nodes, np.array([at]))[:, 0] for nodes, at in places)
        size = 2 * self.half + 1
        total = np.zeros((self.channels, size, size))
        for a, b in zip(*np.nonzero(np.outer(down, right)), strict=True):
            total += down[a] * right[b] * pad_kernel(self.kernels[a][b], size)
        return total


KernelsAt = Callable[[np.ndarray, np.ndarray], list[np.ndarray]]
"""From rows and columns of some nodes, (nodes,) each, to their kernels, (channels, size, size) each."""


@dataclass(eq=False)
class NodeKernels:
    """The kernels of a picture's nodes, each computed when it is first needed.

    ``mirrored``: the picture is centred on the axis of a lens, so that one quarter of the kernels determines the
    others. ``step``: of so many nodes along each axis one is computed, and those between are interpolated by
    polynomials through POINTS of them (`choose_step`). Several threads may ask for kernels; one at a time computes.
    """

    kernels_at: KernelsAt
    row_nodes: np.ndarray
    column_nodes: np.ndarray
    mirrored: bool = False
    step: int = 1
    computed: dict[Node, np.ndarray] = field(default_factory=dict)

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
        weights = (
            weights_between(len(self.row_nodes), self.step, rows),
            weights_between(len(self.column_nodes), self.step, columns),
        )
        with self._lock:
            down, right = (np.flatnonzero(each.any(0)).tolist() for each in weights)
            at = self.exact([(a, b) for a in down for b in right], watch)
        nodes = self.row_nodes[rows.start : rows.stop], self.column_nodes[columns.start : columns.stop]
        lines = [at[n : n + len(right)] for n in range(0, len(at), len(right))]
        if self.step > 1:
            lines = _between(lines, weights[0][:, down], weights[1][:, right])
        return Lattice(nodes[0] - region.top, nodes[1] - region.left, lines)

    def exact(self, nodes: list[Node], watch: Progress | None = None) -> list[np.ndarray]:
        """Return the kernels of nodes, themselves; threads (`p2sf.threads`) share those that are missing."""
        watch = watch or Progress()
        missing = [node for node in dict.fromkeys(map(self._computed_at, nodes)) if node not in self.computed]
        watch.expect(len(missing))

        def some(nodes: list[Node]) -> list[tuple[Node, np.ndarray]]:
            a, b = np.array(nodes).T
            return list(zip(nodes, self.kernels_at(self.row_nodes[a], self.column_nodes[b]), strict=True))

        def take(found: list[tuple[Node, np.ndarray]]) -> None:
            self.computed.update(found)
            watch.advance(len(found))

        if missing:
            take(some(missing[:FIRST]))
            step = max(1, min(TOGETHER // self.computed[missing[0]].size, MOST_NODES))
            parts = [missing[start : start + step] for start in range(FIRST, len(missing), step)]
            for_each(some, parts, take, ahead=None)
        return [self._kernel(*node) for node in nodes]

    def _computed_at(self, node: Node) -> Node:
        """Return the node whose kernel determines that of a node: itself, or its mirror image across the axis."""
        a, b = node
        if not self.mirrored:
            return node
        return min(a, len(self.row_nodes) - 1 - a), min(b, len(self.column_nodes) - 1 - b)

    def _kernel(self, a: int, b: int) -> np.ndarray:
        """Return the kernel of a node, or the mirror image of the one across the axis."""
        at = self._computed_at((a, b))
        kernel: np.ndarray = self.computed[at][:, :: 1 if at[0] == a else -1, :: 1 if at[1] == b else -1]
        return kernel


def computed_nodes(count: int, step: int) -> np.ndarray:
    """Return the numbers of the nodes along an axis that are computed: all where too few would be left, sorted.

    The last is among them, and they are symmetric, so that mirror images are too.
    """
    fewer = -(-(count - 1) // step) + 1
    if step == 1 or fewer < POINTS:
        return np.arange(count)
    lower = np.floor(np.arange((fewer + 1) // 2) * (count - 1) / (fewer - 1)).astype(int)
    return np.unique([*lower, *(count - 1 - lower)])


def weights_between(count: int, step: int, wanted: range) -> np.ndarray:
    """Return the weights of all nodes along an axis in those ``wanted``, (wanted, count).

    Lagrange's polynomials through the POINTS nearest computed nodes (Abramowitz & Stegun 1964, 25.2.1).
    """
    known = computed_nodes(count, step)
    weights = np.zeros((len(wanted), count))
    for row, node in zip(weights, wanted, strict=True):
        first = int(np.clip(np.searchsorted(known, node, "right") - POINTS // 2, 0, max(len(known) - POINTS, 0)))
        near = known[first : first + POINTS]
        if node in near:
            row[node] = 1.0
            continue
        for k in near.tolist():
            others = near[near != k]
            row[k] = np.prod((node - others) / (k - others))
    return weights


def _between(lines: list[list[np.ndarray]], down: np.ndarray, right: np.ndarray) -> list[list[np.ndarray]]:
    """Return kernels as weighted sums of others along both axes, by weights (wanted, given) of rows and columns."""
    size = max(kernel.shape[-1] for line in lines for kernel in line)
    given = np.stack([np.stack([pad_kernel(kernel, size) for kernel in line]) for line in lines])
    rows = np.tensordot(down.astype(np.float32), given, 1)
    both = np.moveaxis(np.tensordot(right.astype(np.float32), rows, (1, 1)), 0, 1)
    return [list(line) for line in both]


def choose_step(several: Iterable[NodeKernels], allowed: float, watch: Progress | None = None) -> int:
    """Return the largest of STEPS at which kernels between computed nodes are true to ``allowed``, relative L2; else 1.

    Measured along both edges of the picture that meet in a corner, where kernels change most: in the interval at
    the corner, where the polynomial is worst, and in one in the middle.
    """
    return next((step for step in STEPS if all(_error_between(nodes, step, watch) <= allowed for nodes in several)), 1)


def _error_between(kernels: NodeKernels, step: int, watch: Progress | None) -> float:
    """Return the relative L2 error of kernels between those computed at a step, the rows' and columns' together."""
    worst = []
    for axis, count in enumerate((len(kernels.row_nodes), len(kernels.column_nodes))):
        known, errors = computed_nodes(count, step), [0.0]
        for interval in {0, len(known) // 2 - 1} if len(known) < count else ():
            node = int(known[interval] + known[interval + 1]) // 2
            weights = weights_between(count, step, range(node, node + 1))[0]
            near = np.flatnonzero(weights)
            true, *others = kernels.exact([(n, 0) if axis == 0 else (0, n) for n in (node, *near.tolist())], watch)
            true, *others = pad_to_largest([true, *others])
            found = np.tensordot(weights[near].astype(np.float32), np.stack(others), 1)
            off, whole_light = (np.square(values).sum((1, 2)) for values in (found - true, true))
            errors.append(float(np.sqrt(off / whole_light).max()))
        worst.append(max(errors))
    return float(np.hypot(worst[0], worst[1]))


def pad_kernel(kernel: np.ndarray, size: int) -> np.ndarray:
    """Return a kernel, (channels, rows, columns), with zeros around it, to an odd size."""
    edge = (size - kernel.shape[-1]) // 2
    return np.pad(kernel, ((0, 0), (edge, edge), (edge, edge))) if edge else kernel


def pad_to_largest(kernels: list[np.ndarray]) -> list[np.ndarray]:
    """Return kernels, each (channels, size, size), with zeros around them, all as large as the largest."""
    size = max(kernel.shape[-1] for kernel in kernels)
    return [pad_kernel(kernel, size) for kernel in kernels]


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


def common_size(lattice: Lattice, channel: int) -> np.ndarray:
    """Return one channel's kernels padded with zeros to the largest size, (row nodes, column nodes, size, size)."""
    size = 2 * lattice.half + 1
    return np.stack([np.concatenate([pad_kernel(k[[channel]], size) for k in line]) for line in lattice.kernels])
