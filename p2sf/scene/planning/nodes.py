"""The error of interpolating kernels between nodes of field and depth, for each number of nodes."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.scene.field_area import Point
from p2sf.scene.planning.study import Place, Study, distance, weighted_sum

NODE_COUNTS = (1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49)
DEPTH_COUNTS = (1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193)
TRIED = (0.5, 0.5), (0.5, 0.2), (0.2, 0.5)  # down and right in a cell
CELLS = 3  # nearest to the axis, between, and farthest from it; without symmetry also those in the corners
EVERY = 8  # up to this many intervals of depth are all tried


@dataclass(frozen=True)
class Between:
    """A kernel, and those from which it is interpolated with these weights."""

    true: Place
    nodes: tuple[Place, ...]
    weights: tuple[float, ...]


def worst_errors(study: Study, groups: Sequence[Sequence[Between]]) -> list[float]:
    """Return the worst error of interpolation in each group; all kernels are computed together."""
    places = [place for group in groups for one in group for place in (one.true, *one.nodes)]
    kernels = dict(zip(places, study.kernels(places), strict=True))
    return [
        max(distance(weighted_sum([kernels[n] for n in one.nodes], one.weights), kernels[one.true]) for one in group)
        for group in groups
    ]


def field_counts(study: Study, number: int) -> tuple[int, int]:
    """Return node counts along rows and columns for an entry of NODE_COUNTS along the longer side."""
    count, sensor = NODE_COUNTS[number], study.scene.sensor
    longer = max(sensor.rows, sensor.columns)
    if count == 1:
        return 1, 1
    rows, columns = (max(2, 1 + round((count - 1) * n / longer)) for n in (sensor.rows, sensor.columns))
    return rows, columns


FieldPlace = tuple[float, float, int]  # wavelength, vergence, cell


def field_places(study: Study) -> list[FieldPlace]:
    """Return the points where field nodes are tried, the likeliest to fail first: sharp, blue and far out."""
    blue, *others = study.waves_um
    axis, _, corner = study.sharpest(blue)
    far, between, near = CELLS - 1, CELLS // 2, 0
    places = [(blue, corner, far), (blue, corner, between), (blue, corner, near), (blue, axis, near), (blue, axis, far)]
    if not study.sensor_map(corner).about_axis:
        places += [(blue, corner, CELLS + quarter) for quarter in range(4)]
    places += [(blue, v, far) for v in study.scan] + [(wave, study.sharpest(wave)[-1], far) for wave in others]
    return list(dict.fromkeys(places))


def between_field_nodes(study: Study, number: int, place: FieldPlace) -> list[Between]:
    """Return the interpolation at a point by an entry of NODE_COUNTS."""
    counts, sensor, (wave, vergence, cell) = field_counts(study, number), study.scene.sensor, place
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), counts, strict=True))
    if len(rows) == 1:
        return _about_one(study, wave, vergence)
    away = np.hypot(sensor.x_mm((columns[:-1] + columns[1:]) / 2), sensor.y_mm((rows[:-1] + rows[1:]) / 2)[:, None])
    order = away.argsort(axis=None, kind="stable")[[0, away.size // 2, -1]].tolist()
    last = away.size - 1
    order += [0, away.shape[1] - 1, last - away.shape[1] + 1, last]
    a, b = np.unravel_index(order[cell], away.shape)
    return _in_cell(study, rows[a : a + 2], columns[b : b + 2], wave, vergence)


def _pixel(study: Study, row: float, column: float, wave: float, vergence: float) -> Place:
    sensor = study.scene.sensor
    return Place(float(sensor.x_mm(column)), float(sensor.y_mm(row)), vergence, wave)


def _about_one(study: Study, wave: float, vergence: float) -> list[Between]:
    """Return the corners of the sensor, approximated by a single node in the middle."""
    last_row, last_column = study.scene.sensor.rows - 1.0, study.scene.sensor.columns - 1.0
    middle = _pixel(study, last_row / 2, last_column / 2, wave, vergence)
    corners = [_pixel(study, row, column, wave, vergence) for row in (0.0, last_row) for column in (0.0, last_column)]
    return [Between(corner, (middle,), (1.0,)) for corner in corners]


def _in_cell(study: Study, rows: np.ndarray, columns: np.ndarray, wave: float, vergence: float) -> list[Between]:
    """Return TRIED points of a cell, interpolated from its corners."""
    corners = tuple(_pixel(study, row, column, wave, vergence) for row in rows for column in columns)
    found = []
    for down, right in TRIED:
        row, column = rows[0] + down * (rows[1] - rows[0]), columns[0] + right * (columns[1] - columns[0])
        weights = tuple(y * x for y in (1 - down, down) for x in (1 - right, right))
        found.append(Between(_pixel(study, row, column, wave, vergence), corners, weights))
    return found


DepthPlace = tuple[float, Point, float]  # wavelength, point of the area, vergence


def depth_places(study: Study) -> list[DepthPlace]:
    """Return the points where depth nodes are tried: first the sharpest corner in blue, then the axis and both ends."""
    blue, *others = study.waves_um
    axis, middle, corner = study.sharpest(blue)
    far, *others_far, near = study.area.corners
    places = [(blue, far, v) for v in (corner, middle, *study.scan)]
    places += [(blue, near, v) for v in (axis, *study.scan)]
    places += [(blue, point, v) for point in others_far for v in study.scan]
    places += [(wave, far, study.sharpest(wave)[-1]) for wave in others]
    return list(dict.fromkeys(places))


def between_depth_nodes(study: Study, number: int, place: DepthPlace) -> list[Between]:
    """Return the interpolation midway by an entry of DEPTH_COUNTS: near a point's vergence, or everywhere if few."""
    wave, point, vergence = place
    nodes = study.scene.vergences(DEPTH_COUNTS[number])
    if len(nodes) == 1:
        return [Between(study.place(point, vergence, wave), (study.place(point, float(nodes[0]), wave),), (1.0,))]
    last = len(nodes) - 2
    about = np.clip(np.searchsorted(nodes, vergence) + np.array([-2, -1, 0]), 0, last)
    chosen = sorted(set(about.tolist()) | set(range(last + 1) if last < EVERY else ()))
    return [
        Between(
            study.place(point, float(nodes[n : n + 2].mean()), wave),
            tuple(study.place(point, float(v), wave) for v in nodes[n : n + 2]),
            (0.5, 0.5),
        )
        for n in chosen
    ]
