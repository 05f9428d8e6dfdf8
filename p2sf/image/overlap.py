"""Space-variant blur by patches: hat windows that sum to one, each convolved with its node's kernel, added up.

This is exactly the linear interpolation of kernels between nodes: a source pixel's light is spread by the weighted
kernels of the four nodes around it, so that its sum is kept (overlap-add, Nagy & O'Leary 1998, §3).
"""

import numpy as np

from p2sf.image.lattice import Lattice
from p2sf.image.progress import Progress
from p2sf.pixel_kernels.nodes import hats
from p2sf.threads import for_each


def overlap_add(values: np.ndarray, lattice: Lattice, watch: Progress | None = None, border: int = 0) -> np.ndarray:
    """Return the blurred picture with all light that leaves it, (rows + 2·half, columns + 2·half, channels) float32.

    ``values``: (rows, columns, channels) float32, whose outer ``border`` pixels lie outside the lattice's picture and
    take the kernels of its edge. Threads (`p2sf.threads`) share the patches, which are added in order, so that the
    result is the same for any number. Additional memory is a few patches for each thread.
    """
    values, half = np.asarray(values, np.float32), lattice.half
    planes = np.moveaxis(values, -1, 0)
    positions = (np.arange(n) - border for n in values.shape[:2])
    by_row, by_column = (
        hats(nodes, place) for nodes, place in zip((lattice.row_nodes, lattice.column_nodes), positions, strict=True)
    )
    out = np.zeros((len(planes), values.shape[0] + 2 * half, values.shape[1] + 2 * half), np.float32)
    jobs = [(a, b) for a in range(len(by_row)) for b in range(len(by_column))]
    watch = watch or Progress()
    watch.expect(len(jobs))

    def convolve_patch(job: tuple[int, int]) -> tuple[int, int, np.ndarray]:
        a, b = job
        rows, columns = support(by_row[a]), support(by_column[b])
        weight = np.outer(by_row[a][rows], by_column[b][columns]).astype(np.float32)
        kernel = lattice.kernels[a][b]
        edge = half - kernel.shape[-1] // 2
        return rows.start + edge, columns.start + edge, convolve(planes[:, rows, columns] * weight, kernel)

    def take(patch: tuple[int, int, np.ndarray]) -> None:
        _add(out, *patch)
        watch.advance()

    for_each(convolve_patch, jobs, take)
    return np.moveaxis(out, 0, -1)


def _add(out: np.ndarray, top: int, left: int, patch: np.ndarray) -> None:
    out[:, top : top + patch.shape[1], left : left + patch.shape[2]] += patch


def support(weight: np.ndarray) -> slice:
    """Return the range in which a window is not zero."""
    inside = np.flatnonzero(weight)
    return slice(int(inside[0]), int(inside[-1]) + 1) if inside.size else slice(0, 1)


def convolve(planes: np.ndarray, kernels: np.ndarray) -> np.ndarray:
    """Return full convolutions of (channels, rows, columns) with (channels, size, size), float32, by real FFTs."""
    import scipy.fft

    shape = tuple(n + k - 1 for n, k in zip(planes.shape[1:], kernels.shape[1:], strict=True))
    fast = tuple(scipy.fft.next_fast_len(n, real=True) for n in shape)
    spectra = scipy.fft.rfft2(planes, fast)
    spectra *= scipy.fft.rfft2(np.ascontiguousarray(kernels), fast)
    full: np.ndarray = scipy.fft.irfft2(spectra, fast, overwrite_x=True)[:, : shape[0], : shape[1]]
    return full
