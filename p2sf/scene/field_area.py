"""The part of a lens's field that a sensor shows, as far as symmetry leaves it to be described."""

from dataclasses import dataclass

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.pixel_kernels.sensor_points import oriented
from p2sf.scene.sensor import Sensor

OBLIQUE = 0.6, 0.8  # sine and cosine of a direction that no pixel grid shares
DIGITS = 12  # of places in mm, so that the same place is one pupil however it was computed

Point = tuple[float, float]
"""x and y (up) on the sensor, mm."""


@dataclass(frozen=True)
class FieldArea:
    """Where on a sensor the pupils differ, places (x, y up) in mm.

    About an axis of symmetry all points of a circle share the pupil of the one above the axis, so that these are the
    area: a line. ``x_mm``, ``y_mm``: its least and greatest. ``near``: nearest to the ``centre`` of the field, where
    pictures are sharpest, and ``far``: farthest from it. ``corners``: where pupils differ most, and in between.
    ``turn``: sine and cosine of the angle at which places are taken to the sensor.
    """

    lens: Lens
    x_mm: tuple[float, float]
    y_mm: tuple[float, float]
    centre: Point
    near: Point
    far: Point
    corners: tuple[Point, ...]
    turn: tuple[float, float]

    def on_sensor(self, point: Point) -> Point:
        """Return a place of the sensor that has the pupil of a point of the area, turned."""
        (x, y), (sine, cosine) = point, self.turn
        return x * cosine + y * sine, y * cosine - x * sine

    def point_of(self, x_mm: float, y_mm: float) -> Point:
        """Return the point of the area whose pupil, turned, is that of a place on the sensor."""
        x, y, _ = oriented(self.lens, x_mm, y_mm)
        return round(float(x), DIGITS), round(float(y), DIGITS)

    def outwards(self, part: float) -> Point:
        """Return the point at a part of the way from the field's centre to the farthest point."""
        (x, y), (across, up) = self.centre, self.far
        return x + part * (across - x), y + part * (up - y)


def field_area(lens: Lens, sensor: Sensor) -> FieldArea:
    """Return the area of a sensor behind a lens."""
    if not lens.misaligned:
        nearest, farthest = sensor.corners_mm()
        near, far = (0.0, nearest), (0.0, farthest)
        return FieldArea(lens, (0.0, 0.0), (nearest, farthest), (0.0, 0.0), near, far, (far, near), OBLIQUE)
    x, y = (tuple(map(float, ends)) for ends in sensor.ends_mm())
    corners = sorted(((a, b) for a in x for b in y), key=lambda corner: -np.hypot(*corner))
    middle = sensor.centre_mm
    return FieldArea(lens, (x[0], x[1]), (y[0], y[1]), middle, middle, corners[0], (*corners, middle), (0.0, 1.0))
