"""Which field of a misaligned lens lands where on the sensor, by chief rays or by a database."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebval2d, chebvander2d

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source, source_at
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.sensor_points import slope_ratio
from p2sf.raytrace.pencil import pencil
from p2sf.scene.sensor import Sensor
from p2sf.threads import mapped

ORDER, FIELDS, REACH = 9, 13, 1.12  # of the polynomial that finds fields; fields along each axis; beyond the sensor
MOST_MISS_PX = 0.1  # by which that polynomial may miss

Field = tuple[float, float]
"""Slopes along x and y, or a place on the sensor, mm."""


@dataclass(frozen=True, eq=False)
class FieldMap:
    """Which field lands where on the sensor, at one depth and the reference wavelength.

    ``across``, ``up``: Chebyshev coefficients (y, x) of the slopes along x and y over the place on the sensor, which is
    ``middle_mm`` ± ``half_mm``. ``scale_mm``: paraxial height per slope of the lens set straight. ``clip``: whether
    rims clip the pencils of its points.
    """

    lens: Lens
    depth_mm: float
    wavelength_um: float
    middle_mm: tuple[float, float]
    half_mm: tuple[float, float]
    across: np.ndarray
    up: np.ndarray
    scale_mm: float
    clip: bool = False

    def slopes(self, x_mm: np.ndarray, y_mm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the field slopes along x and y whose chief rays land at these places."""
        x, y = self._reduced(x_mm, y_mm)
        return chebval2d(y, x, self.across), chebval2d(y, x, self.up)

    def thinning(self, x_mm: np.ndarray, y_mm: np.ndarray) -> np.ndarray:
        """Return ∂(slopes)/∂(place), per mm²: how much of the object's light falls on unit area."""
        x, y = self._reduced(x_mm, y_mm)
        tables = [chebder(table, axis=axis) for table in (self.across, self.up) for axis in (1, 0)]
        one, two, three, four = (chebval2d(y, x, table) for table in tables)
        found: np.ndarray = np.abs(one * four - two * three) / (self.half_mm[0] * self.half_mm[1])
        return found

    def source(self, x_mm: float, y_mm: float, wavelength_um: float) -> Source:
        """Return the object point that lands at a place in the reference wavelength, for another wavelength."""
        across, up = (float(slope) for slope in self.slopes(np.asarray(x_mm), np.asarray(y_mm)))
        ratio = slope_ratio(self.lens, self.depth_mm, self.wavelength_um, wavelength_um)
        return source_at(self.depth_mm, ratio * across, ratio * up, wavelength_um)

    def _reduced(self, x_mm: np.ndarray, y_mm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        (across, up), (wide, high) = self.middle_mm, self.half_mm
        return (x_mm - across) / wide, (y_mm - up) / high


def landing_mm(lens: Lens, source: Source) -> tuple[float, float]:
    """Return where a chief ray lands, x and y in the sensor's own axes, mm."""
    rays, turn = pencil(lens, source, np.zeros(1), np.zeros(1)), np.deg2rad(source.azimuth_deg)
    right, up = (float(np.ravel(place)[0]) for place in (rays.chief_x, rays.chief_y))
    return float(right * np.cos(turn) + up * np.sin(turn)), float(up * np.cos(turn) - right * np.sin(turn))


def field_map(lens: Lens, depth_mm: float, wavelength_um: float, sensor: Sensor, clip: bool = False) -> FieldMap:
    """Return the map of a sensor. Raises GeometryError where chief rays do not reach all of it in good order."""
    scale = _scale_mm(lens, depth_mm, wavelength_um)
    x, y = sensor_ends_mm(sensor)
    # A lens that is out of line moves the whole picture, by more than a small sensor's own width.
    middle_at = float(x.mean()), float(y.mean())
    landed = landing_mm(lens, source_at(depth_mm, middle_at[0] / scale, middle_at[1] / scale, wavelength_um))
    aside, above = (there - wanted for there, wanted in zip(landed, middle_at, strict=True))
    fields = [
        (across / scale, up / scale)
        for across in np.linspace(*_wider(x - aside), FIELDS)
        for up in np.linspace(*_wider(y - above), FIELDS)
    ]
    found = mapped(lambda field: _place(lens, depth_mm, wavelength_um, *field), fields)
    return fitted_map(lens, depth_mm, wavelength_um, sensor, (fields, found), clip)


def sensor_ends_mm(sensor: Sensor) -> tuple[np.ndarray, np.ndarray]:
    """Return where the sensor begins and ends along x and along y, (2,) mm each."""
    return sensor.x_mm([-0.5, sensor.columns - 0.5]), sensor.y_mm([sensor.rows - 0.5, -0.5])


def _scale_mm(lens: Lens, depth_mm: float, wavelength_um: float) -> float:
    return float(coefficients(lens, depth_mm, 1.0, wavelength_um).image_height)


def fitted_map(
    lens: Lens,
    depth_mm: float,
    wavelength_um: float,
    sensor: Sensor,
    landed: tuple[Sequence[Field], Sequence[Field | None]],
    clip: bool = False,
) -> FieldMap:
    """Return the map through fields and where they land, mm, None for those that do not; GeometryError as above."""
    (x, y), scale, (fields, found) = sensor_ends_mm(sensor), _scale_mm(lens, depth_mm, wavelength_um), landed
    slopes = np.array([field for field, place in zip(fields, found, strict=True) if place])
    places = np.array([place for place in found if place]).reshape(-1, 2)
    if not len(places) or not ((places.min(0) <= (x[0], y[0])) & (places.max(0) >= (x[1], y[1]))).all():
        raise GeometryError("chief rays do not reach all of the sensor; take a smaller sensor")
    low, high = places.min(0), places.max(0)
    middle, half = (low + high) / 2, (high - low) / 2
    reduced = (places - middle) / half
    terms = [(a, b) for a in range(ORDER + 1) for b in range(ORDER + 1 - a)]
    basis = chebvander2d(reduced[:, 1], reduced[:, 0], (ORDER, ORDER))
    columns = np.stack([basis[:, a * (ORDER + 1) + b] for a, b in terms], -1)
    solved = np.linalg.lstsq(columns, slopes, rcond=1e-12)[0]
    miss = np.abs(columns @ solved - slopes).max() * abs(scale) / sensor.pixel_mm
    if not miss < MOST_MISS_PX:
        raise GeometryError(
            "chief rays do not land in a smooth order on the sensor, by {miss:.2g} pixels; take a smaller "
            "sensor or align "
            "the lens better",
            miss=float(miss),
        )
    tables = np.zeros((2, ORDER + 1, ORDER + 1))
    for (a, b), values in zip(terms, solved, strict=True):
        tables[:, a, b] = values
    ends = (float(middle[0]), float(middle[1])), (float(half[0]), float(half[1]))
    return FieldMap(lens, depth_mm, wavelength_um, *ends, tables[0], tables[1], scale, clip)


def _wider(ends: np.ndarray) -> tuple[float, float]:
    middle, half = float(ends.mean()), float(np.ptp(ends)) / 2
    room = (REACH - 1) * float(np.abs(ends).max())
    return middle - half - room, middle + half + room


def _place(lens: Lens, depth_mm: float, wavelength_um: float, across: float, up: float) -> tuple[float, float] | None:
    try:
        return landing_mm(lens, source_at(depth_mm, across, up, wavelength_um))
    except GeometryError:  # beyond what the lens sees, which its sensor need not reach
        return None
