"""The part of the field of a lens on a sensor that symmetry does not determine."""

from dataclasses import dataclass
from itertools import product
from math import hypot

import numpy as np

from p2sf.pixel_kernels.sensor_points import Fields
from p2sf.scene.sensor import Sensor

DIGITS = 12  # of coordinates in mm, so that a point has one pupil however it was computed

Point = tuple[float, float]
"""x and y (up) on the sensor, mm."""


@dataclass(frozen=True, eq=False)
class FieldArea:
    """The area of a sensor over which pupils differ, points (x, y up) in mm.

    ``x_mm``, ``y_mm``: its limits; with rotational symmetry a line above the axis. ``near``: nearest to the axis
    of the sensor, and ``corners``: where pupils differ most, the farthest first, and ``near``, the last.
    """

    fields: Fields
    x_mm: Point
    y_mm: Point
    near: Point
    corners: tuple[Point, ...]

    @property
    def far(self) -> Point:
        """Return the point farthest from the axis."""
        return self.corners[0]

    def points_of(self, x_mm: np.ndarray, y_mm: np.ndarray) -> tuple[list[float], list[float]]:
        """Return x and y of the points of the area whose pupils, rotated, are those of points on the sensor."""
        x, y, _ = self.fields.orient(x_mm, y_mm)
        return x.round(DIGITS).tolist(), y.round(DIGITS).tolist()

    def outwards(self, part: float) -> Point:
        """Return the point at a fraction of the way from the nearest to the farthest."""
        (x, y), (across, up) = self.near, self.far
        return x + part * (across - x), y + part * (up - y)


def field_area(fields: Fields, sensor: Sensor) -> FieldArea:
    """Return the area of a sensor."""
    x, y = sensor.ends_mm()
    beside, below = (float(np.clip(0.0, *ends)) for ends in (x, y))
    places = np.array([(beside, below), *product(x, y)]).T
    across, up, _ = fields.orient(*places)
    near = float(across[0]), float(up[0])
    left, right, low, high = (float(end) for side in (across, up) for end in (side.min(), side.max()))
    corners = sorted(set(product((left, right), (low, high))) - {near}, key=lambda corner: (-hypot(*corner), corner))
    return FieldArea(fields, (left, right), (low, high), near, (*corners, near))
