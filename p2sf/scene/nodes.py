"""How many nodes in field and depth keep the error of interpolating kernels between them."""

import numpy as np

from p2sf.kernels.nodes import nodes_along
from p2sf.scene.study import DEPTH_COUNTS, NODE_COUNTS, Study, distance, widened

TRIED = (0.5, 0.5), (0.5, 0.2), (0.5, 0.8), (0.2, 0.5), (0.8, 0.5)  # down and right in a cell
EVERY = 8  # intervals of depth that are all tried


def field_counts(study: Study, number: int) -> tuple[int, int]:
    """Return node counts along rows and columns for an entry of NODE_COUNTS along the longer side."""
    count, sensor = NODE_COUNTS[number], study.scene.sensor
    longer = max(sensor.rows, sensor.columns)
    if count == 1:
        return 1, 1
    return tuple(max(2, 1 + round((count - 1) * n / longer)) for n in (sensor.rows, sensor.columns))


def field_error(study: Study, number: int) -> float:
    """Return the worst error between nodes: nearest to the axis, farthest from it and in the middle of the field."""
    counts = field_counts(study, number)
    return max(
        _cell_error(study, cell, v, wave, counts == (1, 1))
        for wave in study.waves
        for v in study.depths(wave)
        for cell in _cells(study, counts)
    )


def _cells(study: Study, counts):
    """Return the rows and columns between which three cells lie: nearest to the axis, farthest from it and between."""
    sensor = study.scene.sensor
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), counts, strict=True))
    if len(rows) == 1:
        return [(np.array([0.0, sensor.rows - 1]), np.array([0.0, sensor.columns - 1]))]
    cells = [(rows[a : a + 2], columns[b : b + 2]) for a in range(len(rows) - 1) for b in range(len(columns) - 1)]
    far = sorted(cells, key=lambda cell: np.hypot(sensor.x_mm(cell[1].mean()), sensor.y_mm(cell[0].mean())))
    return [far[n] for n in sorted({0, len(far) // 2, len(far) - 1})]


def _cell_error(study: Study, cell, vergence: float, wave: float, single: bool) -> float:
    """Return the worst error at TRIED points of a cell; with a ``single`` node, of its corners against the middle."""
    rows, columns = cell

    def kernel(down: float, right: float) -> np.ndarray:
        row, column = rows[0] + down * (rows[1] - rows[0]), columns[0] + right * (columns[1] - columns[0])
        return study.plain(vergence, float(study.scene.sensor.x_mm(column)), float(study.scene.sensor.y_mm(row)), wave)

    corners = [(a, b) for a in (0.0, 1.0) for b in (0.0, 1.0)]
    if single:
        return max(distance(kernel(0.5, 0.5), kernel(*corner)) for corner in corners)
    made = [kernel(*corner) for corner in corners]
    return max(
        distance(weighted(made, [abs(1 - a - d) * abs(1 - b - r) for a, b in corners]), kernel(d, r)) for d, r in TRIED
    )


def weighted(kernels: list[np.ndarray], weights) -> np.ndarray:
    """Return a weighted sum of kernels of different sizes."""
    size = max(kernel.shape[-1] for kernel in kernels)
    return sum(weight * widened(kernel, size) for kernel, weight in zip(kernels, weights, strict=True))


def depth_error(study: Study, number: int) -> float:
    """Return the worst error midway between depth nodes: at both ends and about every sharpest place."""
    nodes = study.scene.vergences(DEPTH_COUNTS[number])
    heights = study.nearest_mm, (study.nearest_mm + study.farthest_mm) / 2, study.farthest_mm
    return max(
        _between(study, ends, middle, (height, wave))
        for wave in study.waves
        for ends, middle in _intervals(nodes, study.depths(wave))
        for height in heights
    )


def _intervals(nodes: np.ndarray, depths: list[float]):
    """Return (nodes, vergence tried) pairs: every interval of a few, else the ends and those around ``depths``."""
    if len(nodes) == 1:
        return [(nodes, v) for v in depths]
    last = len(nodes) - 2
    about = {int(np.clip(np.searchsorted(nodes, v) + step, 0, last)) for v in depths for step in (-2, -1, 0)}
    chosen = sorted(about | set(range(last + 1) if last < EVERY else (0, last)))
    return [(nodes[n : n + 2], float(nodes[n : n + 2].mean())) for n in chosen]


def _between(study: Study, ends, middle: float, place) -> float:
    height, wave = place
    made = [study.plain(float(v), 0.6 * height, 0.8 * height, wave) for v in (*ends, middle)]
    return distance(weighted(made[:-1], [1 / len(ends)] * len(ends)), made[-1])
