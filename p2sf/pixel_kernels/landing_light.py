"""Kernels of pixels far wider than λ/2NA from where the rays of fitted pupils land: no wave is summed."""

import numpy as np

from p2sf.pixel_kernels.pupil_stack import PupilStack
from p2sf.pupil.basis import at_nodes
from p2sf.pupil.domain import HALF

NODES = 40, 80


def landing_kernels(
    pupils: PupilStack, angles: np.ndarray, shifts_um: np.ndarray, halves: np.ndarray, pixel_um: float
) -> list[np.ndarray]:
    """Return the share of light per pixel of points, each (2·half + 1,)² float32 of unit sum, row 0 the top.

    A ray lands at −∂w/∂f (Hamilton) and is shared by the four pixels about it in proportion to their nearness. The
    fields lie ``angles`` radians from +y towards +x, and ``shifts_um``, (pupils, 2), displace them, x and y up. Pupil
    masks are left out.
    """
    at = at_nodes(pupils.basis, NODES)
    of_xi, of_eta = at.map_slopes  # the phase has the terms of η
    (right, up), (eta_u, eta_v), (xi_u, xi_v) = (
        (form @ across, form @ along)
        for form, (across, along) in ((pupils.phase, of_eta), (pupils.eta, of_eta), (pupils.xi, of_xi))
    )
    area = np.abs(xi_u * eta_v - xi_v * eta_u)
    inside = (pupils.eta @ at.values.fy) ** 2 + (pupils.xi @ at.values.fx) ** 2 <= 1
    light = np.where(inside & (pupils.rims @ at.values.fy > 0).all(1), at.nodes.weight * area**2, 0.0)
    if pupils.weight.size:
        light *= (pupils.weight @ at.values.fy) ** 2
    right, up = (-slope / pupils.radius[:, None] for slope in (right, up))
    if pupils.basis.domain is HALF:  # the other half is its mirror image
        right, up, light = np.concatenate([right, -right], 1), np.tile(up, 2), np.tile(light, 2)
    cosine, sine = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x = right * cosine + up * sine + shifts_um[:, :1]
    y = up * cosine - right * sine + shifts_um[:, 1:]
    return [
        _shared(half - y_k / pixel_um, half + x_k / pixel_um, light_k, 2 * half + 1)
        for half, x_k, y_k, light_k in zip(halves.tolist(), x, y, light, strict=True)
    ]


def _shared(row: np.ndarray, column: np.ndarray, light: np.ndarray, size: int) -> np.ndarray:
    """Return the light of points among the pixels of a window, float32 of unit sum; that beyond it is dropped."""
    kept = (light > 0) & (row > 0) & (row < size - 1) & (column > 0) & (column < size - 1)
    row, column, light = row[kept], column[kept], light[kept]
    top, left = row.astype(int), column.astype(int)
    down, across = row - top, column - left
    first = top * size + left
    corners = (
        (0, (1 - down) * (1 - across)), (1, (1 - down) * across), (size, down * (1 - across)), (size + 1, down * across)
    )  # fmt: skip
    total = sum(np.bincount(first + step, light * share, size * size) for step, share in corners)
    kernel: np.ndarray = (total / np.sum(total)).reshape(size, size).astype(np.float32)
    return kernel
