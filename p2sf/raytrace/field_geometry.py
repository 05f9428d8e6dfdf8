"""The geometry of a field: where the light that reaches the sensor comes from, and in what cone; for every lens.

The exit pupil of an aligned lens lies where first order puts it. Behind tilts, folds and decentres it is found by real
rays: its centre is where chief rays of fields beside the axis come closest to that of the axis, and its plane is at
right angles to that ray. For an aligned lens both are the same point and plane.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf, sqrt

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, indices, seen_from
from p2sf.lens.source import Source, source_at
from p2sf.paraxial.pupils import Stop, numerical_aperture
from p2sf.raytrace.aiming import arriving
from p2sf.raytrace.chief_ray import check_chief_ray
from p2sf.raytrace.surface import Status

NEIGHBOUR = 1e-3  # slope of neighbouring fields, and pupil radii of rays beside the chief ray; errors are its square
AT_INFINITY = 1e-9  # 1/mm: of a nearer exit pupil, 1e9 mm away, wavelets differ from plane waves by 1e-9 of a wave
PARALLEL = 1e-9  # of the sine of a half angle, some thousand times the rounding of rays: that of a parallel beam
EDGE_ON = 1e-3  # of the cosine between the axis of the surfaces and z: no field lies farther out


@dataclass(frozen=True)
class Cone:
    """The cone of light about the chief ray of a field, to first order.

    ``na_x``, ``na_y``: n' times the sine of its half angles along x and y of the sensor, turned with the azimuth of the
    source. ``na``: of the round cone with as much light; 0 of a beam that is parallel, in one direction or in both.
    """

    na_x: float
    na_y: float
    na: float


def cone(lens: Lens, source: Source, stop: Stop | None = None) -> Cone:
    """Return the cone of a source: of an aligned lens the paraxial one at its depth, else about the real chief ray.

    Raises GeometryError where the chief ray of a misaligned lens, or one beside it, does not reach the sensor.
    """
    return _own_cone(lens, source) if stop is None else _cone(lens, source, stop)


@lru_cache(maxsize=256)
def _own_cone(lens: Lens, source: Source) -> Cone:
    return _cone(lens, source, None)


def _cone(lens: Lens, source: Source, stop: Stop | None) -> Cone:
    if not lens.misaligned:
        na = float(numerical_aperture(lens, source.depth_mm, source.wavelength_um, stop))
        return Cone(na, na, na)
    xi, eta = NEIGHBOUR * np.array([1.0, -1, 0, 0, 0]), NEIGHBOUR * np.array([0.0, 0, 1, -1, 0])
    places, cosines = _at_sensor(lens, source, xi, eta, stop)
    index = abs(float(indices(lens, source.wavelength_um)[-1]))
    turn = tangent_axes(lens, *places[:2, -1])
    slopes = (turn.T @ (cosines[:, :4:2] - cosines[:, 1:4:2]))[:2] * (index / (2 * NEIGHBOUR))
    across, up = np.linalg.norm(slopes, axis=1).tolist()
    widest, narrowest = np.linalg.svd(slopes, compute_uv=False).tolist()
    return Cone(across, up, sqrt(widest * narrowest) if narrowest > PARALLEL * index else 0.0)


@dataclass(frozen=True, eq=False)
class ExitPupil:
    """The exit pupil: its ``axis`` is a ray that meets the sensor at ``place_mm``, ``distance_mm`` behind the pupil.

    ``place_mm`` and ``axis``, a unit vector, are (3,) in the axes of a plane sensor.
    """

    place_mm: np.ndarray
    axis: np.ndarray
    distance_mm: float

    def turned(self, azimuth_deg: float) -> "ExitPupil":
        """Return the pupil in the axes of a lens `seen_from` an azimuth."""
        sine, cosine = np.sin(np.deg2rad(azimuth_deg)), np.cos(np.deg2rad(azimuth_deg))
        turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        return ExitPupil(turn @ self.place_mm, turn @ self.axis, self.distance_mm)

    def radius_mm(self, place_mm: np.ndarray, chief: np.ndarray) -> np.ndarray:
        """Return the way of chief rays from the pupil's plane to where they meet the sensor, mm.

        ``place_mm``, ``chief``: points and unit vectors, (3, …).
        """
        beyond = self.axis @ (place_mm - self.place_mm.reshape(3, *[1] * (place_mm.ndim - 1)))
        radius: np.ndarray = (self.distance_mm + beyond) / (self.axis @ chief)
        return radius


def exit_pupil(lens: Lens, source: Source) -> ExitPupil:
    """Return the exit pupil of a misaligned lens at the wavelength of a source, in the axes that this sees.

    It is that of the field on the axis at infinity or, where its chief ray is lost, of the source. Raises GeometryError
    where that does not reach the sensor either.
    """
    try:
        found = pupil_about(lens, _on_axis(lens, source.wavelength_um) or source)
    except GeometryError:
        found = pupil_about(lens, source)
    return found.turned(source.azimuth_deg)


def _on_axis(lens: Lens, wavelength_um: float) -> Source | None:
    """Return the source at infinity on the axis, which is that of the surfaces where these are tilted as a whole.

    None where that axis is at right angles to z or points back, so that no field lies on it.
    """
    x, y, z = lens.frames[0].rotation[:, 2].tolist() if None not in lens.steps[1:] else (0.0, 0.0, 1.0)
    return source_at(inf, x / z, y / z, wavelength_um) if z > EDGE_ON else None


@lru_cache(maxsize=64)
def pupil_about(lens: Lens, source: Source) -> ExitPupil:
    """Return the exit pupil about the chief ray of a source, in the axes of the lens's own sensor, taken as a plane.

    Its centre is where chief rays of neighbouring fields come closest to that ray.
    """
    flat = replace(lens, sensor_radius=inf, sensor_conic=0.0)
    (slope_x, slope_y), rays = source.slopes_xy, []
    for x, y in ((0.0, 0.0), (NEIGHBOUR, 0.0), (-NEIGHBOUR, 0.0), (0.0, NEIGHBOUR), (0.0, -NEIGHBOUR)):
        rays.append(_chief(flat, source_at(source.depth_mm, slope_x + x, slope_y + y, source.wavelength_um)))
    places, cosines = (np.stack(column, -1) for column in zip(*rays, strict=True))
    place, chief = places[:, 0], cosines[:, 0]
    to_pupil, turn = closest(places[:, 1:] - place[:, None], cosines[:, 1:], chief)
    return ExitPupil(place, chief, to_pupil / turn if abs(turn) > AT_INFINITY * abs(to_pupil) else inf)


def closest(places: np.ndarray, cosines: np.ndarray, chief: np.ndarray) -> tuple[float, float]:
    """Return Σp·q and Σq² of rays whose distance from the chief ray is p + q·z at z along it, so that z = −Σp·q/Σq².

    ``places``: mm from the chief ray's point of the sensor, (3, ray).
    """
    along, axis = chief @ cosines, chief[:, None]
    q = cosines / along - axis
    p = places - (chief @ places) * cosines / along
    return float((p * q).sum()), float((q * q).sum())


def _chief(lens: Lens, source: Source) -> tuple[np.ndarray, np.ndarray]:
    """Return where the chief ray of a source meets the sensor, mm, and its unit vector, in the sensor's own axes."""
    places, cosines = _at_sensor(lens, source, np.zeros(1), np.zeros(1))
    sine, cosine = np.sin(np.deg2rad(source.azimuth_deg)), np.cos(np.deg2rad(source.azimuth_deg))
    back = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return back @ places[:, 0], back @ cosines[:, 0]


def _at_sensor(
    lens: Lens, source: Source, xi: np.ndarray, eta: np.ndarray, stop: Stop | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return where rays through pupil points meet the sensor, mm, and their direction cosines, (3, ray), as `Rays` do.

    The index of light that runs to the left is negative, so that its cosines are turned round. Raises GeometryError
    where one is lost.
    """
    lens = seen_from(lens, source.azimuth_deg)
    check_chief_ray(lens, source)
    beam, _, index = arriving(lens, source, xi, eta, stop)
    if (beam.status != Status.PASSED).any():
        raise GeometryError("rays beside the chief ray do not reach the sensor; reduce the field")
    return beam.place, beam.ray / index[-1]


def tangent_axes(lens: Lens, x_mm: FloatOrArray, y_mm: FloatOrArray) -> np.ndarray:
    """Return the axes of the plane that touches the sensor at a point of its own, (3, 3, …), as columns.

    They are the sensor's, turned by the angle between both normals about the line that is at right angles to these, so
    that directions towards the axis remain so (Rodrigues 1840).
    """
    x, y = np.broadcast_arrays(np.asarray(x_mm, float), y_mm)
    _, slope = lens.sensor_surface.sag_and_slope(x * x + y * y)
    axial = 1 / np.sqrt(1 + 4 * slope * slope * (x * x + y * y))
    across, up = -2 * slope * x * axial, -2 * slope * y * axial
    share = 1 / (1 + axial)
    return np.array(
        [
            [1 - across * across * share, -across * up * share, across],
            [-across * up * share, 1 - up * up * share, up],
            [-across, -up, axial],
        ]
    )
