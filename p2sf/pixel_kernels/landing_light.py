"""Kernels of pixels far wider than λ/2NA from where the rays of fitted pupils land: no wave is summed."""

from functools import lru_cache

import numpy as np

from p2sf.pixel_kernels.pupil_stack import PupilStack, turned_powers

NODES = 40, 96  # rings and directions


def landing_kernels(
    pupils: PupilStack, angles: np.ndarray, shifts_um: np.ndarray, halves: np.ndarray, pixel_um: float
) -> list[np.ndarray]:
    """Return the share of light per pixel of points, each (2·half + 1,)² float32 of unit sum, row 0 the top.

    A ray lands at −∂w/∂f (Hamilton) and is shared by the four pixels about it in proportion to their nearness. The
    fields lie ``angles`` radians from +y towards +x, and ``shifts_um``, (pupils, 2), displace them, x and y up. Pupil
    masks are left out.
    """
    value, by_u, by_v = _powers(pupils.order)
    phase, maps = (form.reshape(*form.shape[:-2], -1) for form in turned_powers(pupils, angles))
    (xi_u, eta_u), (xi_v, eta_v) = maps[:2] @ by_u, maps[:2] @ by_v
    xi, eta, *others = maps @ value
    light = np.where(xi**2 + eta**2 <= 1, (xi_u * eta_v - xi_v * eta_u) ** 2, 0.0)  # nodes have equal areas
    if pupils.weight.size:
        light *= others.pop() ** 2
    for rim in others:
        light *= rim > 0
    x, y = (
        shift[:, None] - phase @ slope / pupils.radius[:, None]
        for shift, slope in zip(shifts_um.T, (by_u, by_v), strict=True)
    )
    points = zip(halves.tolist(), x / pixel_um, y / pixel_um, light, strict=True)
    return [_shared(half - up, half + across, share, 2 * half + 1) for half, across, up, share in points]


@lru_cache(maxsize=8)
def _powers(order: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return uⁱ·vʲ and its slopes by u and v, (terms, nodes) each, at nodes of equal areas over the unit disc."""
    rings, directions = NODES
    radius = np.sqrt((np.arange(rings) + 0.5) / rings)
    angle = 2 * np.pi * (np.arange(directions) + np.arange(rings)[:, None] / rings) / directions
    u, v = (radius[:, None] * np.cos(angle)).ravel(), (radius[:, None] * np.sin(angle)).ravel()
    exponent = np.arange(order + 1)[:, None]
    (of_u, slope_u), (of_v, slope_v) = (
        (x**exponent, exponent * x ** np.maximum(exponent - 1, 0)) for x in (u, v)
    )  # fmt: skip
    value, by_u, by_v = (
        (one[:, None] * two).reshape(-1, u.size) for one, two in ((of_u, of_v), (slope_u, of_v), (of_u, slope_v))
    )
    return value, by_u, by_v


def _shared(row: np.ndarray, column: np.ndarray, light: np.ndarray, size: int) -> np.ndarray:
    """Return the light of points among the pixels of a window, float32 of unit sum; that beyond it is dropped."""
    kept = (light > 0) & (row > 0) & (row < size - 1) & (column > 0) & (column < size - 1)
    row, column, light = row[kept], column[kept], light[kept]
    top, left = row.astype(int), column.astype(int)
    down, across = row - top, column - left
    first = top * size + left
    corners = {
        0: (1 - down) * (1 - across),
        1: (1 - down) * across,
        size: down * (1 - across),
        size + 1: down * across,
    }
    total = sum(np.bincount(first + step, light * share, size * size) for step, share in corners.items())
    kernel: np.ndarray = (total / np.sum(total)).reshape(size, size).astype(np.float32)
    return kernel
