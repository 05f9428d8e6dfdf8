"""The error of interpolating kernels between nodes of field and depth, for each number of nodes."""

from collections.abc import Sequence

import numpy as np

from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.scene.study import DEPTH_COUNTS, NODE_COUNTS, Study, distance, widened

TRIED = (0.5, 0.5), (0.5, 0.2), (0.5, 0.8), (0.2, 0.5), (0.8, 0.5)  # down and right in a cell
CELLS = 3  # nearest to the axis, farthest from it and between
EVERY = 8  # up to so many intervals of depth are all tried

Cell = tuple[np.ndarray, np.ndarray]  # its two rows and its two columns, pixels


def field_counts(study: Study, number: int) -> tuple[int, int]:
    """Return node counts along rows and columns for an entry of NODE_COUNTS along the longer side."""
    count, sensor = NODE_COUNTS[number], study.scene.sensor
    longer = max(sensor.rows, sensor.columns)
    if count == 1:
        return 1, 1
    rows, columns = (max(2, 1 + round((count - 1) * n / longer)) for n in (sensor.rows, sensor.columns))
    return rows, columns


def field_places(study: Study) -> list[tuple[float, float, int]]:
    """Return (wavelength, vergence, cell) for `field_error`, those likeliest to fail first: sharp and far out."""
    sharp = study.sharpest(study.reference_um)
    places = [(wave, v, cell) for wave in study.waves for v in study.depths(wave) for cell in range(CELLS)]
    return sorted(places, key=lambda place: (abs(place[1] - sharp[1]), -place[2]))


def field_error(study: Study, number: int, wave: float, vergence: float, cell: int) -> float:
    """Return the worst error between nodes in one of CELLS cells."""
    counts = field_counts(study, number)
    cells = _cells(study, counts)
    return _cell_error(study, cells[min(cell, len(cells) - 1)], vergence, wave, counts == (1, 1))


def _cells(study: Study, counts: tuple[int, int]) -> list[Cell]:
    """Return CELLS cells: nearest to the axis, between and farthest from it."""
    sensor = study.scene.sensor
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), counts, strict=True))
    if len(rows) == 1:
        return [(np.array([0.0, sensor.rows - 1]), np.array([0.0, sensor.columns - 1]))]
    away = np.hypot(sensor.x_mm((columns[:-1] + columns[1:]) / 2), sensor.y_mm((rows[:-1] + rows[1:]) / 2)[:, None])
    order = away.argsort(axis=None, kind="stable")
    chosen = [np.unravel_index(order[n], away.shape) for n in sorted({0, order.size // 2, order.size - 1})]
    return [(rows[a : a + 2], columns[b : b + 2]) for a, b in chosen]


def _cell_error(study: Study, cell: Cell, vergence: float, wave: float, single: bool) -> float:
    """Return the worst error at TRIED points of a cell; with a ``single`` node, of its corners against the middle."""
    rows, columns = cell

    def kernel(down: float, right: float) -> np.ndarray:
        row, column = rows[0] + down * (rows[1] - rows[0]), columns[0] + right * (columns[1] - columns[0])
        x, y = float(study.scene.sensor.x_mm(column)), float(study.scene.sensor.y_mm(row))
        return study.kernel(vergence, x, y, wave)

    corners = [(a, b) for a in (0.0, 1.0) for b in (0.0, 1.0)]
    if single:
        return max(distance(kernel(0.5, 0.5), kernel(*corner)) for corner in corners)
    at_corners = [kernel(*corner) for corner in corners]
    return max(
        distance(weighted(at_corners, [abs(1 - a - d) * abs(1 - b - r) for a, b in corners]), kernel(d, r))
        for d, r in TRIED
    )


def weighted(kernels: Sequence[np.ndarray], weights: Sequence[float]) -> np.ndarray:
    """Return a weighted sum of kernels of different sizes."""
    size = max(kernel.shape[-1] for kernel in kernels)
    parts = [weight * widened(kernel, size) for kernel, weight in zip(kernels, weights, strict=True)]
    return sum(parts[1:], parts[0])


def depth_places(study: Study) -> list[tuple[float, float, float]]:
    """Return (wavelength, height, vergence) for `depth_error`."""
    heights = study.nearest_mm, (study.nearest_mm + study.farthest_mm) / 2, study.farthest_mm
    return [(wave, height, v) for wave in study.waves for height in heights for v in study.depths(wave)]


def depth_error(study: Study, number: int, wave: float, height: float, vergence: float) -> float:
    """Return the worst error midway between depth nodes: near one vergence, or in all intervals where they are few."""
    nodes = study.scene.vergences(DEPTH_COUNTS[number])
    return max(_between(study, ends, middle, height, wave) for ends, middle in _intervals(nodes, vergence))


def _intervals(nodes: np.ndarray, vergence: float) -> list[tuple[np.ndarray, float]]:
    """Return (nodes, vergence tried) pairs: the interval of a vergence and its neighbours, or all of a few."""
    if len(nodes) == 1:
        return [(nodes, vergence)]
    last = len(nodes) - 2
    about = np.clip(np.searchsorted(nodes, vergence) + np.array([-2, -1, 0]), 0, last)
    chosen = sorted(set(about.tolist()) | set(range(last + 1) if last < EVERY else ()))
    return [(nodes[n : n + 2], float(nodes[n : n + 2].mean())) for n in chosen]


def _between(study: Study, ends: np.ndarray, tried: float, height: float, wave: float) -> float:
    """Return the error at one vergence of the mean of the kernels at the ends of its interval."""
    *at_ends, kernel = (study.kernel(float(v), 0.6 * height, 0.8 * height, wave) for v in (*ends, tried))
    return distance(weighted(at_ends, [1 / len(ends)] * len(ends)), kernel)
