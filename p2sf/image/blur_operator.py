"""The blur of a lattice as a linear operator, and its transpose.

A source pixel's light is spread by the weighted kernels of the four nodes around it, so that its sum is kept: kernels
are interpolated linearly between nodes (overlap-add, Nagy & O'Leary 1998, §3). The picture is cut into blocks between
the nodes. A block's blur is the sum over its corner nodes n of K_n ⊛ (w_n·x) with hat weights w_n, which is added up in
the spectrum: four forward transforms and one inverse, one and four for the transpose. Blocks without light take none.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product
from math import ceil, log2

import numpy as np

from p2sf.image.lattice import Lattice
from p2sf.image.progress import Progress
from p2sf.pixel_kernels.nodes import hats
from p2sf.threads import for_each, one_blas_thread

SHORTEST, LONGEST = (
    16,
    256,
)  # pixels along a block, except for kernels over half as large; longer ones exceed the cache
TOGETHER = 2**17  # pixels of the blocks that one thread transforms at a time: some milliseconds of work, some megabytes
KEPT_BYTES = 2**28  # of the kernels' spectra; larger ones are computed at each use, which takes about twice as long


@dataclass(frozen=True, eq=False)
class Blocks:
    """Blocks along one axis: where they start and stop, their first nodes, and the nodes' weights in them.

    ``weights``: (blocks, nodes, longest block) float32, zero beyond a block's end. ``fast`` is the transform's length.
    """

    starts: np.ndarray
    stops: np.ndarray
    first: np.ndarray
    weights: np.ndarray
    fast: int


@dataclass(frozen=True, eq=False)
class BlurOperator:
    """The blur H of a lattice on pictures (rows, columns, planes) of one shape, black beyond their edge.

    ``channels``: the channel whose kernels blur each plane; by default there are as many planes as channels. ``kind``:
    float32, whose rounding is some 1e-7 of the brightest pixel, or float64.
    ``sources``: which plane each of the channels blurs, where one is blurred by several, by `spread` alone.
    ``threads`` (`p2sf.threads`) share the blocks; the result is identical to the last bit for any number.
    """

    lattice: Lattice
    shape: tuple[int, int]
    threads: int | None = None
    channels: tuple[int, ...] | None = None
    sources: tuple[int, ...] | None = None
    kind: type[np.floating] = np.float32

    def forward(self, values: np.ndarray) -> np.ndarray:
        """Return the blurred picture H·values on its own pixels, float32."""
        half = self.lattice.half
        return self.spread(values)[half : half + self.shape[0], half : half + self.shape[1]]

    @one_blas_thread
    def spread(self, values: np.ndarray, watch: Progress | None = None) -> np.ndarray:
        """Return the blurred picture with all light that leaves it, (rows + 2·half, columns + 2·half, planes).

        ``watch`` is asked for cancellation at every block.
        """
        half, planes = self.lattice.half, np.moveaxis(np.asarray(values, self.kind), -1, 0)
        out = np.zeros((len(self.sources or planes), *(n + 2 * half for n in self.shape)), self.kind)

        def take(found: tuple[int, np.ndarray, np.ndarray]) -> None:
            row, columns, blurred = found
            for column, block in zip(columns, blurred, strict=True):
                down, right = self._extent(row, column, 2 * half)
                out[:, down, right] += block[:, : down.stop - down.start, : right.stop - right.start]
            if watch is not None:
                watch.check()

        for_each(lambda job: (job[0], *self._blur_blocks(planes, *job)), self._jobs, take, self.threads)
        return np.moveaxis(out, 0, -1)

    @one_blas_thread
    def transposed(self, values: np.ndarray) -> np.ndarray:
        """Return Hᵀ·values, float32: each pixel is the picture weighted with the kernel of that pixel."""
        half = self.lattice.half
        planes = np.pad(np.moveaxis(np.asarray(values, np.float32), -1, 0), ((0, 0), (half, half), (half, half)))
        out = np.empty((len(planes), *self.shape), np.float32)

        def take(found: tuple[int, np.ndarray, np.ndarray]) -> None:
            row, columns, weighted = found
            for column, block in zip(columns, weighted, strict=True):
                down, right = self._extent(row, column)
                out[:, down, right] = block[:, : down.stop - down.start, : right.stop - right.start]

        for_each(lambda job: (*job, self._correlate_blocks(planes, *job)), self._jobs, take, self.threads)
        return np.moveaxis(out, 0, -1)

    def _blur_blocks(self, planes: np.ndarray, row: int, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return Σ K_n ⊛ (w_n·x) of those of a row of blocks that have light: their columns, (blocks, planes, *fast).

        The weights are products of one along rows and one along columns, so that the transform along the columns' axis
        is done before the weights of the other are applied.
        """
        import scipy.fft

        rows, across = self._axes
        blocks = self._gather(planes, row, columns, 0)
        lit = blocks.any((1, 2, 3))
        blocks, columns = blocks[lit], columns[lit]
        if not len(columns):
            return columns, blocks
        weighted = blocks[:, None] * across.weights[columns, :, None, None]
        half_done = scipy.fft.rfft(weighted, across.fast)
        total: np.ndarray | None = None
        for node, weight in enumerate(rows.weights[row]):
            spectra = scipy.fft.fft(half_done * weight[:, None], rows.fast, axis=-2, overwrite_x=True)
            if self.sources:
                spectra = spectra[:, :, list(self.sources)]
            self._times_kernels(spectra, row, node, columns)
            part = spectra.sum(1)
            total = part if total is None else np.add(total, part, out=total)
        blurred: np.ndarray = scipy.fft.irfft2(total, (rows.fast, across.fast), overwrite_x=True)
        return columns, blurred

    def _correlate_blocks(self, planes: np.ndarray, row: int, columns: np.ndarray) -> np.ndarray:
        """Return Σ w_n·(K_n ⋆ y) of some blocks of a row, (blocks, planes, longest row, longest column)."""
        import scipy.fft

        rows, across = self._axes
        spectra = scipy.fft.rfft2(
            self._gather(planes, row, columns, 2 * self.lattice.half), (rows.fast, across.fast), overwrite_x=True
        )
        # conj(x)·K is the conjugate of x·conj(K).
        conjugate, total = np.conj(spectra, out=spectra), None
        for node, weight in enumerate(rows.weights[row]):
            products = np.repeat(conjugate[:, None], across.weights.shape[1], axis=1)
            self._times_kernels(products, row, node, columns)
            np.conj(products, out=products)
            part = scipy.fft.ifft(products, axis=-2, overwrite_x=True)[..., : len(weight), :] * weight[:, None]
            total = part if total is None else np.add(total, part, out=total)
        length = across.weights.shape[-1]
        both = scipy.fft.irfft(total, across.fast, overwrite_x=True)[..., :length]
        weighted: np.ndarray = (both * across.weights[columns, :, None, None]).sum(1)
        return weighted

    def _gather(self, planes: np.ndarray, row: int, columns: np.ndarray, more: int) -> np.ndarray:
        """Return blocks of a row, each ``more`` pixels longer each way, (blocks, planes, rows, columns)."""
        longest = (axis.weights.shape[-1] + more for axis in self._axes)
        out = np.zeros((len(columns), len(planes), *longest), planes.dtype)
        for block, column in zip(out, columns, strict=True):
            down, right = self._extent(row, column, more)
            block[:, : down.stop - down.start, : right.stop - right.start] = planes[:, down, right]
        return out

    def _extent(self, row: int, column: int, more: int = 0) -> tuple[slice, slice]:
        rows, columns = self._axes
        return (
            slice(int(rows.starts[row]), int(rows.stops[row]) + more),
            slice(int(columns.starts[column]), int(columns.stops[column]) + more),
        )

    def _times_kernels(self, spectra: np.ndarray, row: int, node: int, columns: np.ndarray) -> None:
        """Multiply spectra of a row of blocks, (blocks, nodes, planes, frequencies), by those of a line of nodes."""
        rows, across = self._axes
        last = len(self.lattice.row_nodes) - 1, len(self.lattice.column_nodes) - 1
        a = min(rows.first[row] + node, last[0])  # a node beyond the last one has no weight
        for block, first in zip(spectra, across.first[columns].tolist(), strict=True):
            for number, planes in enumerate(block):
                kernels = self._spectrum(a, min(first + number, last[1]))
                for plane, channel in zip(planes, self.channels or range(len(planes)), strict=True):
                    plane *= kernels[channel]

    @cached_property
    def _axes(self) -> tuple[Blocks, Blocks]:
        return best_blocks((self.lattice.row_nodes, self.lattice.column_nodes), self.shape, 2 * self.lattice.half)

    @cached_property
    def _jobs(self) -> list[tuple[int, np.ndarray]]:
        """Return which blocks are transformed together: the row, and their columns."""
        rows, columns = self._axes
        together = max(1, TOGETHER // (rows.fast * columns.fast * len(self.channels or range(self.lattice.channels))))
        count = len(columns.starts)
        starts = range(0, count, ceil(count / ceil(count / together)))
        parts = [np.arange(s, min(s + starts.step, count)) for s in starts]
        return [(row, part) for row in range(len(rows.starts)) for part in parts]

    @cached_property
    def _kept(self) -> dict[tuple[int, int], np.ndarray] | None:
        """Return where the kernels' spectra are kept from use to use, None if they are large."""
        a, b = (len(nodes) for nodes in (self.lattice.row_nodes, self.lattice.column_nodes))
        rows, columns = self._axes
        if 8 * a * b * self.lattice.channels * rows.fast * (columns.fast // 2 + 1) > KEPT_BYTES:
            return None
        return {}

    def _spectrum(self, a: int, b: int) -> np.ndarray:
        """Return the spectra of a node's kernels, (channels, frequencies), complex of the kind."""
        import scipy.fft

        if self._kept is not None and (a, b) in self._kept:
            return self._kept[a, b]
        size, kernel = 2 * self.lattice.half + 1, self.lattice.kernels[a][b]
        padded, edge = np.zeros((len(kernel), size, size), self.kind), (size - kernel.shape[-1]) // 2
        padded[:, edge : size - edge, edge : size - edge] = kernel
        rows, across = self._axes
        spectrum: np.ndarray = scipy.fft.rfft2(padded, (rows.fast, across.fast))
        if self._kept is not None:
            self._kept[a, b] = spectrum
        return spectrum


def best_blocks(nodes: tuple[np.ndarray, np.ndarray], shape: tuple[int, int], more: int) -> tuple[Blocks, Blocks]:
    """Return the blocks of rows and of columns that cost least, for kernels of ``more`` + 1 pixels."""
    rows, columns = (list(_options(n, pixels, more)) for n, pixels in zip(nodes, shape, strict=True))
    return min(product(rows, columns), key=lambda both: _cost(*both))


def _cost(rows: Blocks, columns: Blocks) -> float:
    """Return the estimated operations of a blur: transforms of n values take n·log₂(n)."""
    (count, a, length), (times, b, _) = rows.weights.shape, columns.weights.shape
    half_done = (b * length + rows.fast) * columns.fast * log2(columns.fast) / 2
    complete = (a * b + 1) * rows.fast * (columns.fast / 2 + 1) * log2(rows.fast)
    products = a * b * rows.fast * columns.fast
    return float(count * times * (half_done + complete + products))


def _options(nodes: np.ndarray, pixels: int, more: int) -> Iterator[Blocks]:
    """Yield ways to cut an axis: for several lengths, the cells between nodes merged up to it, or split down to it."""
    cells = np.unique([0, *np.clip(np.ceil(nodes[1:-1]).astype(int), 0, pixels), pixels])
    cell, length = int(np.diff(cells).max()), SHORTEST
    while length <= max(LONGEST, 2 * more):
        if length >= cell:
            edges = np.append(cells[: -1 : length // cell], pixels)
        else:
            pieces = [np.linspace(*ends, ceil(cell / length) + 1).round() for ends in pairwise(cells)]
            edges = np.unique(pieces).astype(int)
        yield _blocks(edges, nodes, more)
        length += length // 2


def _blocks(edges: np.ndarray, nodes: np.ndarray, more: int) -> Blocks:
    """Return the blocks between these edges, with the nodes whose hats reach into them."""
    import scipy.fft

    weights = hats(nodes, np.arange(edges[-1]))
    used = [np.flatnonzero(weights[:, start:stop].any(1)) for start, stop in pairwise(edges)]
    count, length = max(int(np.ptp(u)) + 1 for u in used), int(np.diff(edges).max())
    own = np.zeros((len(used), count, length), np.float32)
    for block, (start, stop), inside in zip(own, pairwise(edges), used, strict=True):
        found = weights[inside[0] : inside[0] + count, start:stop]
        block[: len(found), : stop - start] = found
    first, fast = np.array([u[0] for u in used]), scipy.fft.next_fast_len(length + more, real=True)
    return Blocks(edges[:-1], edges[1:], first, own, fast)
