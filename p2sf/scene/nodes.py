"""How many nodes in field and depth keep the error of interpolating kernels between them."""

import numpy as np

from p2sf.kernels.nodes import nodes_along
from p2sf.scene.study import DEPTH_COUNTS, NODE_COUNTS, Study, distance, widened


def field_counts(study: Study, number: int) -> tuple[int, int]:
    """Return node counts along rows and columns for an entry of NODE_COUNTS along the longer side."""
    count, sensor = NODE_COUNTS[number], study.scene.sensor
    longer = max(sensor.rows, sensor.columns)
    if count == 1:
        return 1, 1
    return tuple(max(2, 1 + round((count - 1) * n / longer)) for n in (sensor.rows, sensor.columns))


def field_error(study: Study, number: int) -> float:
    """Return the worst error in the middle of a cell: nearest to the axis, farthest from it and between."""
    return max(
        _cell_error(study, cell, v) for v in study.depths() for cell in _cells(study, field_counts(study, number))
    )


def _cells(study: Study, counts):
    """Yield the corners (x, y) mm of three cells and the point tried in each."""
    sensor = study.scene.sensor
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), counts, strict=True))
    if len(rows) == 1:
        corner = (0, sensor.columns - 1) if sensor.centre_mm[0] >= 0 else (0, 0)
        return [([(rows[0], columns[0])], corner)]
    cells = [
        (
            [(r, c) for r in rows[a : a + 2] for c in columns[b : b + 2]],
            (rows[a : a + 2].mean(), columns[b : b + 2].mean()),
        )
        for a in range(len(rows) - 1)
        for b in range(len(columns) - 1)
    ]
    far = sorted(cells, key=lambda cell: np.hypot(sensor.x_mm(cell[1][1]), sensor.y_mm(cell[1][0])))
    return [far[n] for n in sorted({0, len(far) // 2, len(far) - 1})]


def _cell_error(study: Study, cell, vergence: float) -> float:
    corners, tried = cell
    sensor = study.scene.sensor
    made = [study.plain(vergence, float(sensor.x_mm(c)), float(sensor.y_mm(r))) for r, c in (*corners, tried)]
    return distance(mean_of(made[:-1]), made[-1])


def mean_of(kernels: list[np.ndarray]) -> np.ndarray:
    """Return the mean of kernels of different sizes."""
    size = max(kernel.shape[-1] for kernel in kernels)
    return sum(widened(kernel, size) for kernel in kernels) / len(kernels)


def depth_error(study: Study, number: int) -> float:
    """Return the worst error midway between depth nodes: at both ends and where the scene is sharpest."""
    nodes = study.scene.vergences(DEPTH_COUNTS[number])
    heights = study.nearest_mm, (study.nearest_mm + study.farthest_mm) / 2, study.farthest_mm
    if len(nodes) == 1:
        tried = [(nodes, v) for v in study.depths()]
    else:
        sharp = study.depths()[len(study.depths()) // 2]
        inside = np.clip(np.searchsorted(nodes, sharp) - 1, 0, len(nodes) - 2)
        tried = [(nodes[n : n + 2], nodes[n : n + 2].mean()) for n in sorted({0, int(inside), len(nodes) - 2})]
    return max(_between(study, ends, middle, height) for ends, middle in tried for height in heights)


def _between(study: Study, ends, middle: float, height_mm: float) -> float:
    made = [study.plain(float(v), 0.6 * height_mm, 0.8 * height_mm) for v in (*ends, middle)]
    return distance(mean_of(made[:-1]), made[-1])
