"""Kernels over place and depth as a few components: a picture whose depth changes from pixel to pixel, by few sums.

K(place, depth, channel) = Σ_k s_k(place, depth)·C_k(channel), C_0 the mean and the others the strongest deviations from
it (`lowrank.principal_kernels`). Between depth nodes and places strengths are linear, as kernels
between the nodes of a lattice are.
"""

from dataclasses import dataclass

import numpy as np

from p2sf.image.lowrank import principal_kernels
from p2sf.image.octaves import octave_weights
from p2sf.image.slabs import LEVELS
from p2sf.pixel_kernels.nodes import hats
from p2sf.threads import for_each


@dataclass(frozen=True, eq=False)
class KernelNodes:
    """Kernels (channels, depths, rows, columns, size, size) at ``depths``, in levels from far, and places in pixels."""

    kernels: np.ndarray
    depths: np.ndarray
    row_nodes: np.ndarray
    column_nodes: np.ndarray


@dataclass(frozen=True, eq=False)
class KernelComponents:
    """``kernels`` (rank, channels, size, size), and ``tables`` (rank, rows, columns, LEVELS) of their strengths.

    ``left``: the relative L2 norm of what the components leave of all kernels.
    """

    kernels: np.ndarray
    tables: np.ndarray
    row_nodes: np.ndarray
    column_nodes: np.ndarray
    left: float


def components(nodes: KernelNodes, tolerance: float, most: int) -> KernelComponents:
    """Return the fewest components that leave ``tolerance`` of all kernels in relative L2, ``most`` at most."""
    channels, *count, size, _ = nodes.kernels.shape
    flat = np.moveaxis(nodes.kernels, 0, -3).reshape(-1, channels * size * size)
    found = principal_kernels(flat, tolerance, most)
    shapes = np.concatenate([found.mean[None], found.shapes]).reshape(-1, channels, size, size)
    strengths = np.concatenate([np.ones((1, len(flat)), np.float32), found.strengths]).reshape(-1, *count)
    return KernelComponents(
        shapes, over_levels(strengths, nodes.depths), nodes.row_nodes, nodes.column_nodes, found.left
    )


def octave_responses(kernels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean response of kernels, (…, size, size), in the finest octave, and its error, (…) each.

    The error is the mean square of the difference, in noise or in what most pictures have, whichever is more.
    """
    import scipy.fft

    usual, noise = (octave_weights(kernels.shape[-1], falloff) for falloff in (2.0, 0.0))
    spectra = scipy.fft.fft2(scipy.fft.ifftshift(kernels, (-2, -1)))
    gains = np.tensordot(spectra.real, usual, 2)
    power = spectra.real**2 + spectra.imag**2
    off = [
        np.tensordot(power, weights, 2) - 2 * gains * np.tensordot(spectra.real, weights, 2) + gains**2
        for weights in (usual, noise)
    ]
    return gains, np.maximum(*off)


def over_levels(values: np.ndarray, depths: np.ndarray) -> np.ndarray:
    """Return (…, depths, rows, columns) interpolated linearly at every level, (…, rows, columns, LEVELS) float32."""
    levels = np.arange(LEVELS)
    weights = np.stack([np.interp(levels, depths, row) for row in np.eye(len(depths))])
    found: np.ndarray = np.tensordot(values, weights.astype(np.float32), (-3, 0)).astype(np.float32)
    return found


def over_picture(
    tables: np.ndarray, nodes: tuple[np.ndarray, np.ndarray], level: np.ndarray, corner: tuple[int, int]
) -> np.ndarray:
    """Return quantities tabulated over places and depth at every pixel, (quantities, rows, columns) float32.

    ``tables``: (quantities, row nodes, column nodes, LEVELS); ``level``: (rows, columns), the first pixel at ``corner``
    of those in which nodes are counted; beyond the outer nodes these hold.
    """
    out = np.zeros((len(tables), *level.shape), np.float32)
    down, across = (hats(n, np.arange(c) + at) for n, c, at in zip(nodes, level.shape, corner, strict=True))
    for a, row in enumerate(down.astype(np.float32)):
        rows = _support(row)
        for b, column in enumerate(across.astype(np.float32)):
            columns = _support(column)
            weight, at = np.outer(row[rows], column[columns]), level[rows, columns]
            for total, table in zip(out, tables, strict=True):
                total[rows, columns] += weight * table[a, b][at]
    return out


def _support(weight: np.ndarray) -> slice:
    inside = np.flatnonzero(weight)
    return slice(int(inside[0]), int(inside[-1]) + 1) if inside.size else slice(0, 0)


def blur(planes: np.ndarray, level: np.ndarray, part: KernelComponents, corner: tuple[int, int]) -> np.ndarray:
    """Return planes, one or more of each channel in turn, blurred by its kernels, (planes, rows, columns).

    Beyond the edge its pixels repeat. ``corner`` as in `over_picture`. What wraps around in
    the transforms stays in a border as wide as the kernels reach.
    """
    import scipy.fft

    border, channels = part.kernels.shape[-1] // 2, part.kernels.shape[1]
    wide = [(border, border)] * 2
    padded, deep = np.pad(planes, [(0, 0), *wide], mode="edge"), np.pad(level, wide, mode="edge")
    shape = tuple(scipy.fft.next_fast_len(n, real=True) for n in deep.shape)
    chosen = np.arange(len(planes)) % channels
    nodes, first = (part.row_nodes, part.column_nodes), (corner[0] - border, corner[1] - border)
    total = np.zeros((len(planes), shape[0], shape[1] // 2 + 1), np.complex64)

    def of_component(pair: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        table, kernels = pair
        strength = over_picture(table[None], nodes, deep, first)
        spectra: np.ndarray = scipy.fft.rfft2(strength * padded, shape, overwrite_x=True)
        rows = scipy.fft.rfft(kernels, shape[1])  # of the few rows of kernels only
        spectra *= scipy.fft.fft(rows, shape[0], axis=-2, overwrite_x=True)[chosen]
        return spectra

    for_each(of_component, zip(part.tables, part.kernels, strict=True), lambda found: np.add(total, found, out=total))
    full: np.ndarray = scipy.fft.irfft2(total, shape, overwrite_x=True)
    inner = tuple(slice(2 * border, 2 * border + n) for n in level.shape)
    return full[:, *inner]
