"""The error of interpolating kernels between nodes of field and depth, for each number of nodes."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from p2sf.pixel_kernels.channel import Colour
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.scene.field_area import Point
from p2sf.scene.planning.study import SEEN_AT, Study, distance, weighted_sum

NODE_COUNTS = (*range(1, 10), 11, 13, 15, 17, 21, 25, 29, 33, 41, 49, 57, 65, 81, 97)
DEPTH_COUNTS = (*NODE_COUNTS, 113, 129, 161, 193)
FIRST_TRIED = 3  # of these counts
NEAR, FAR = 0, 1  # cells: nearest to the axis and farthest from it; then, without symmetry, those in the corners
EVERY = 8  # up to this many intervals of depth are all tried


def spans(counts: Sequence[int]) -> list[float]:
    """Return into how many parts nodes cut the field or the depths: errors fall with its square.

    A single node stands in the middle, and nothing is interpolated there.
    """
    return [max(count - 1, 0.5) for count in counts]


Spot = tuple[float, float, float]
"""A point of the sensor, x and y, mm, and a vergence."""


@dataclass(frozen=True)
class Between:
    """The kernel of a channel at a spot, and the spots from which it is interpolated with these weights."""

    colour: Colour
    true: Spot
    nodes: tuple[Spot, ...]
    weights: tuple[float, ...]


def worst_errors(study: Study, groups: Sequence[Sequence[Between]]) -> list[float]:
    """Return the worst error of interpolation in each group, 0 in none; all kernels are computed together."""
    each = list(dict.fromkeys(one for group in groups for one in group))
    spots = list(dict.fromkeys((one.colour, spot) for one in each for spot in (one.true, *one.nodes)))
    kernels = dict(zip(spots, study.channel_kernels(spots), strict=True))

    def error(one: Between) -> float:
        between = weighted_sum([kernels[one.colour, spot] for spot in one.nodes], one.weights)
        return distance(between, kernels[one.colour, one.true])

    errors = {one: error(one) for one in each}
    return [max((errors[one] for one in group), default=0.0) for group in groups]


def field_counts(study: Study, number: int) -> tuple[int, int]:
    """Return node counts along rows and columns for an entry of NODE_COUNTS along the longer side."""
    count, sensor = NODE_COUNTS[number], study.scene.sensor
    longer = max(sensor.rows, sensor.columns)
    if count == 1:
        return 1, 1
    rows, columns = (min(n, max(2, 1 + round((count - 1) * n / longer))) for n in (sensor.rows, sensor.columns))
    return rows, columns


FieldPlace = tuple[Colour, float, int]  # channel, vergence, cell


def field_places(study: Study, colours: Sequence[Colour]) -> list[FieldPlace]:
    """Return where field nodes are tried: at all depths in the bluest channel, at the sharpest and midway in others.

    First where blurs are widest: there they change most from field to field.
    """
    blue, *others = sorted(colours, key=lambda colour: min(colour.wavelengths_um))
    axis, _, corner = study.sharpest(blue.wavelengths_um[0])
    far, middle, near = study.scan[0], study.scan[len(study.scan) // 2], study.scan[-1]
    widest = study.ends[int(study.of_corner[0].reach_um[: len(study.ends)].argmax())]
    places = [(blue, v, FAR) for v in (widest, corner, *study.scan)]
    places += [(blue, v, NEAR) for v in (axis, far, middle, near)]
    if not study.sensor_map(study.ends[0]).about_axis:
        places += [(blue, corner, FAR + 1 + quarter) for quarter in range(4)]
    for colour in others:
        axis, _, corner = study.sharpest(colour.wavelengths_um[0])
        places += [(colour, corner, FAR), (colour, middle, FAR), (colour, axis, NEAR), (colour, middle, NEAR)]
    return list(dict.fromkeys(places))


def between_field_nodes(study: Study, number: int, place: FieldPlace) -> list[Between]:
    """Return the interpolation at a point by an entry of NODE_COUNTS."""
    counts, sensor, (colour, vergence, cell) = field_counts(study, number), study.scene.sensor, place
    if counts == (1, 1):
        return _about_one(study, colour, vergence)
    axes = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), counts, strict=True))
    # Along a side of one pixel a cell begins and ends at the same node.
    rows, columns = (np.repeat(nodes, 2) if len(nodes) == 1 else nodes for nodes in axes)
    away = np.hypot(sensor.x_mm((columns[:-1] + columns[1:]) / 2), sensor.y_mm((rows[:-1] + rows[1:]) / 2)[:, None])
    order = away.argsort(axis=None, kind="stable")[[0, -1]].tolist()
    last = away.size - 1
    order += [0, away.shape[1] - 1, last - away.shape[1] + 1, last]
    a, b = np.unravel_index(order[cell], away.shape)
    return _in_cell(study, rows[a : a + 2], columns[b : b + 2], colour, vergence)


def _pixel(study: Study, row: float, column: float, vergence: float) -> Spot:
    sensor = study.scene.sensor
    return float(sensor.x_mm(column)), float(sensor.y_mm(row)), vergence


def _about_one(study: Study, colour: Colour, vergence: float) -> list[Between]:
    """Return the corners of the sensor, approximated by a single node in the middle."""
    last_row, last_column = study.scene.sensor.rows - 1.0, study.scene.sensor.columns - 1.0
    middle = _pixel(study, last_row / 2, last_column / 2, vergence)
    corners = [_pixel(study, row, column, vergence) for row in (0.0, last_row) for column in (0.0, last_column)]
    return [Between(colour, corner, (middle,), (1.0,)) for corner in corners]


def _in_cell(study: Study, rows: np.ndarray, columns: np.ndarray, colour: Colour, vergence: float) -> list[Between]:
    """Return the middle of a cell, interpolated from its corners: nowhere else is the error larger by a twentieth."""
    corners = tuple(_pixel(study, row, column, vergence) for row in rows for column in columns)
    middle = _pixel(study, float(rows.mean()), float(columns.mean()), vergence)
    return [Between(colour, middle, corners, (0.25,) * 4)]


DepthPlace = tuple[Colour, Point, float]  # channel, point of the area, vergence


def depth_places(study: Study, colours: Sequence[Colour]) -> list[DepthPlace]:
    """Return the points where depth nodes are tried: the sharpest corner in blue first, the axis, and between the two.

    Where the image is curved, the kernels between axis and corner may be the sharpest, and change most with depth.
    """
    blue, *others = sorted(colours, key=lambda colour: min(colour.wavelengths_um))
    axis, middle, corner = study.sharpest(blue.wavelengths_um[0])
    far, *others_far, near = study.area.corners
    places = [(blue, far, v) for v in (corner, middle, *study.scan)]
    places += [(blue, near, v) for v in (axis, *study.scan)]
    places += [(blue, study.area.outwards(SEEN_AT[1]), v) for v in (middle, *study.scan)]
    places += [(blue, point, v) for point in others_far for v in study.scan]
    for colour in others:
        axis, _, corner = study.sharpest(colour.wavelengths_um[0])
        places += [(colour, far, v) for v in (corner, *study.ends)] + [(colour, near, v) for v in (axis, *study.ends)]
    return list(dict.fromkeys(places))


def between_depth_nodes(study: Study, number: int, place: DepthPlace) -> list[Between]:
    """Return the interpolation midway by an entry of DEPTH_COUNTS: near a point's vergence, or everywhere if few."""
    (colour, point, vergence), spot = place, study.spot
    parts = study.scene.depth_parts(DEPTH_COUNTS[number])
    nodes = np.concatenate(parts)
    if len(nodes) == 1:
        return [Between(colour, spot(point, vergence), (spot(point, float(nodes[0])),), (1.0,))]
    last = len(nodes) - 2
    about = np.clip(np.searchsorted(nodes, vergence) + np.array([-2, -1, 0]), 0, last)
    gaps = set((np.cumsum([len(part) for part in parts]) - 1).tolist())  # nothing is interpolated across them
    chosen = sorted((set(about.tolist()) | set(range(last + 1) if last < EVERY else ())) - gaps)
    return [
        Between(
            colour,
            spot(point, float(nodes[n : n + 2].mean())),
            tuple(spot(point, float(v)) for v in nodes[n : n + 2]),
            (0.5, 0.5),
        )
        for n in chosen
    ]
