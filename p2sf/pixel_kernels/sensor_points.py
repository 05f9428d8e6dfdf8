"""Where the points of one object plane land: from sensor height to field, distortion, lateral colour."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebval2d

from p2sf.conventions import FloatOrArray, vergence
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, check_aligned
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.pupils import find_stop, pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import on_sensor, pencil

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

CHIEF_RAYS = 65  # between which slopes are splines of the height
OBLIQUE = 0.6, 0.8  # sine and cosine of a direction that no pixel grid shares
SMALLEST_MM = 1e-12  # keeps the slope over the height finite on the axis
REACHES = (1.35, 1.15, 1.04, 1.0, 0.9, 0.75)  # of the paraxial slope: the fields out to which chief rays are tried


class Fields(Protocol):
    """Which fields land where on the sensor, and which places share a pupil."""

    def orient(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the places whose pupils, turned, are those of (x, y), and by which angles, radians from +y towards +x.

        About an axis of symmetry all points of a circle share the pupil of the one above the axis.
        """

    def oblique(self, x_mm: float, y_mm: float) -> tuple[float, float]:
        """Return a place with the same pupil, if it can be in a direction that no pixel grid shares."""

    def slopes(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
        """Return the field slopes along x and y whose chief rays land at these places, mm."""

    def polar(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
        """Return their slopes, as `Source` has them, and their azimuths, degrees from +y towards +x."""

    def thinning(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> np.ndarray:
        """Return ∂(slopes)/∂(place), per mm²: how much of an even object's light falls on unit area."""


@dataclass(frozen=True, eq=False)
class RadialFields:
    """`Fields` about an axis of symmetry: real chief rays of ``along`` land at ``heights_mm``, increasing from 0."""

    along: np.ndarray
    heights_mm: np.ndarray

    def orient(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the places above the axis, and the angles of (x, y), radians from +y towards +x."""
        height = np.hypot(x_mm, y_mm)
        return np.zeros_like(height), height, np.arctan2(x_mm, y_mm)

    def oblique(self, x_mm: float, y_mm: float) -> tuple[float, float]:
        """Return a place at the same distance from the axis."""
        (across, along), height = OBLIQUE, float(np.hypot(x_mm, y_mm))
        return across * height, along * height

    def slopes(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
        """Return the field slopes along x and y whose chief rays land at these places, mm."""
        height = np.hypot(x_mm, y_mm)
        ratio = self._slope(height) / np.maximum(height, SMALLEST_MM)
        return ratio * x_mm, ratio * y_mm

    def polar(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
        """Return their slopes, negative where the image is upright, and the azimuths of the places, degrees."""
        return self._slope(np.hypot(x_mm, y_mm)), np.rad2deg(np.arctan2(x_mm, y_mm))

    def thinning(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> np.ndarray:
        """Return ∂(slopes)/∂(place) = d(slope²)/d(height²), per mm², which distortion changes over the field."""
        height = np.maximum(np.hypot(x_mm, y_mm), SMALLEST_MM)
        found: np.ndarray = self._slope(height) * self._slope(height, 1) / height
        return found

    @cached_property
    def _slope(self) -> "CubicSpline":
        """Return the slope over the height, an odd function: a spline that is not bent on the axis."""
        from scipy.interpolate import CubicSpline

        return CubicSpline(self.heights_mm, self.along, bc_type=((2, 0.0), "not-a-knot"))


@dataclass(frozen=True, eq=False)
class PlaneFields:
    """`Fields` without symmetry, as Chebyshev polynomials over the sensor.

    ``across``, ``up``: coefficients (y, x) of the slopes along x and y over the place on the sensor, which is
    ``middle_mm`` ± ``half_mm``.
    """

    across: np.ndarray
    up: np.ndarray
    middle_mm: tuple[float, float]
    half_mm: tuple[float, float]

    def orient(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the places themselves, and no angles."""
        x, y = np.broadcast_arrays(np.asarray(x_mm, float), y_mm)
        return x, y, np.zeros(x.shape)

    def oblique(self, x_mm: float, y_mm: float) -> tuple[float, float]:
        """Return the place itself."""
        return x_mm, y_mm

    def slopes(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
        """Return the field slopes along x and y whose chief rays land at these places, mm."""
        x, y = self._reduce(x_mm, y_mm)
        return chebval2d(y, x, self.across), chebval2d(y, x, self.up)

    def polar(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
        """Return their slopes and their own azimuths, degrees."""
        across, up = self.slopes(x_mm, y_mm)
        return np.hypot(across, up), np.rad2deg(np.arctan2(across, up))

    def thinning(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> np.ndarray:
        """Return ∂(slopes)/∂(place), per mm²."""
        x, y = self._reduce(x_mm, y_mm)
        tables = [chebder(table, axis=axis) for table in (self.across, self.up) for axis in (1, 0)]
        one, two, three, four = (chebval2d(y, x, table) for table in tables)
        thinned: np.ndarray = np.abs(one * four - two * three) / (self.half_mm[0] * self.half_mm[1])
        return thinned

    def _reduce(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
        x, y = np.broadcast_arrays(np.asarray(x_mm, float), y_mm)
        (across, up), (wide, high) = self.middle_mm, self.half_mm
        return (x - across) / wide, (y - up) / high


@dataclass(frozen=True, eq=False)
class SensorMap:
    """One object plane seen through one lens: which fields land where on the sensor at the reference wavelength.

    ``scale_mm``: paraxial height per unit slope, of the lens set straight, negative where the entrance pupil lies
    beyond the object, as a relay's does. ``clip``: whether rims clip the pencils of its points.
    """

    lens: Lens
    depth_mm: float
    wavelength_um: float
    fields: Fields
    scale_mm: float
    clip: bool = False

    @property
    def about_axis(self) -> bool:
        """Return whether all points of a circle about the axis have the same pupil, and the same light."""
        return self.lens.mask.round and not self.lens.misaligned

    def ideal_mm(self, x_mm: FloatOrArray, y_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
        """Return the undistorted (paraxial) places of what lands at these, mm."""
        across, up = self.fields.slopes(x_mm, y_mm)
        return self.scale_mm * across, self.scale_mm * up

    def source(self, x_mm: float, y_mm: float, wavelength_um: float) -> Source:
        """Return the object point that lands at a place in the reference wavelength, for another wavelength."""
        slope, azimuth = (float(value) for value in self.fields.polar(x_mm, y_mm))
        slope *= slope_ratio(self.lens, self.depth_mm, self.wavelength_um, wavelength_um)
        return Source(self.depth_mm, slope, float(wavelength_um), azimuth_deg=azimuth)

    def field_slopes(self, x_mm: np.ndarray, y_mm: np.ndarray, waves_um: np.ndarray) -> np.ndarray:
        """Return the field slopes of `source` at several places in wavelengths, (n,) each."""
        slopes, _ = self.fields.polar(x_mm, y_mm)
        waves, each = np.unique(waves_um, return_inverse=True)
        ratios = [slope_ratio(self.lens, self.depth_mm, self.wavelength_um, wave) for wave in waves.tolist()]
        found: np.ndarray = slopes * np.array(ratios)[each]
        return found

    def shift_mm(self, x_mm: float, y_mm: float, wavelength_um: float) -> tuple[float, float]:
        """Return lateral colour: how far from its place, along x and y, another wavelength lands, mm."""
        across, up = landing_mm(self.lens, self.source(x_mm, y_mm, wavelength_um))
        return across - float(x_mm), up - float(y_mm)


def slope_ratio(lens: Lens, depth_mm: float, reference_um: float, wavelength_um: float) -> float:
    """Return the slope to an object point in one wavelength over that in the reference, whose pupil is elsewhere."""
    close = float(vergence(depth_mm))
    if close == 0 or wavelength_um == reference_um:
        return 1.0
    here, there = (_entrance(lens, w) for w in (reference_um, wavelength_um))
    return (1 + close * here) / (1 + close * there)


def sensor_map(lens: Lens, depth_mm: float, wavelength_um: float, height_mm: float, clip: bool = False) -> SensorMap:
    """Return the map out to radial ``height_mm`` on the sensor; GeometryError where no chief ray lands that far."""
    return sensor_maps(lens, [depth_mm], wavelength_um, height_mm, clip)[0]


def sensor_maps(
    lens: Lens,
    depths_mm: Sequence[float],
    wavelength_um: float,
    height_mm: float,
    clip: bool = False,
) -> list[SensorMap]:
    """Return `sensor_map` of several depths, whose chief rays are traced together where that is possible."""
    check_aligned(lens, Message("the forming of images"))
    depths = np.array(depths_mm, float)
    scale = np.broadcast_to(coefficients(lens, depths, 1.0, wavelength_um).image_height, depths.shape)
    if not (np.isfinite(scale) & (scale != 0)).all():
        raise GeometryError("every chief ray meets the sensor on the axis, so it contains no picture; move the stop")
    for reach in REACHES:
        slopes = np.linspace(0, reach * height_mm / scale, CHIEF_RAYS, axis=-1)
        try:
            heights = chief_heights(lens, Sources(depths[:, None], slopes, wavelength_um))
        except GeometryError:
            continue
        if (heights[:, -1] >= height_mm).all() and (np.diff(heights) > 0).all():
            maps = zip(depths.tolist(), slopes, heights, scale.tolist(), strict=True)
            wave = float(wavelength_um)
            return [SensorMap(lens, d, wave, RadialFields(s, h), size, clip) for d, s, h, size in maps]
    if len(depths) > 1:  # some may need another reach than others
        return [sensor_maps(lens, [d], wavelength_um, height_mm, clip)[0] for d in depths.tolist()]
    raise GeometryError(
        "no chief ray of an object at {depth} lands {height:.4g} mm from the axis, where the sensor's "
        "corner is; take a smaller sensor",
        depth="∞" if np.isinf(depths[0]) else Message("{depth:g} mm", depth=float(depths[0])),
        height=height_mm,
    )


def chief_heights(lens: Lens, source: Source | Sources) -> np.ndarray:
    """Return where real chief rays land, mm from the axis along the field's direction, in the shape of the source."""
    heights: np.ndarray = pencil(lens, source, [0.0], [0.0]).chief_y[..., 0]
    return heights


def landings_mm(lens: Lens, sources: Sequence[Source]) -> np.ndarray:
    """Return where chief rays of sources in one azimuth land, (source, 2), x and y in the sensor's own axes, mm."""
    rays = on_sensor(lens, sources, np.zeros(1), np.zeros(1))
    return np.concatenate(np.broadcast_arrays(rays.chief_x, rays.chief_y), axis=1)


def landing_mm(lens: Lens, source: Source) -> tuple[float, float]:
    """Return where one chief ray lands, x and y in the sensor's own axes, mm."""
    x, y = landings_mm(lens, [source])[0].tolist()
    return x, y


@lru_cache(maxsize=256)
def _entrance(lens: Lens, wavelength_um: float) -> float:
    return float(pupils(lens, wavelength_um, find_stop(lens)).entrance_from_first)
