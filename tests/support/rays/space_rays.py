"""A ray tracer in space: every surface stands somewhere in one set of axes, and light is a point and a direction.

It shares nothing with `p2sf` but the numbers of a `Lens`: poses by products of scipy's rotations, intersections by
a general root finder on z − sag(x, y), Snell's law for vectors with positive indices, one ray at a time.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from p2sf.lens.lens import Lens, Surface
from p2sf.lens.placement import Placement

HALF_FRINGE_MM = 0.54607e-3 / 4  # a fringe is half a wave of the green line of mercury, from peak to valley


@dataclass
class Pose:
    """Where axes stand: the origin, and a rotation from these axes to those of space."""

    origin: np.ndarray
    turn: Rotation

    def broken(self, by: Placement) -> "Pose":
        """Return axes behind a break, step by step as its words say."""
        shift, pivot, (a, b, c) = np.array(by.decentre), np.array(by.pivot), by.tilt_deg
        at = self.origin + self.turn.apply(pivot)
        if by.tilt_first:
            turn = self.turn * Rotation.from_euler("ZYX", [c, b, a], degrees=True)
            return Pose(at + turn.apply(shift) - turn.apply(pivot), turn)
        at = at + self.turn.apply(shift)
        turn = self.turn * Rotation.from_euler("XYZ", [a, b, c], degrees=True)
        return Pose(at - turn.apply(pivot), turn)

    def along(self, distance: float) -> "Pose":
        return Pose(self.origin + self.turn.apply([0.0, 0.0, distance]), self.turn)


def poses(lens: Lens) -> list[Pose]:
    """Return where all surfaces and the sensor stand."""
    here, out = Pose(np.zeros(3), Rotation.identity()), []
    for surface in lens.surfaces:
        for placement in surface.before:
            here = here.broken(placement)
        out.append(here)
        for placement in surface.after:
            here = here.broken(placement)
        here = here.along(surface.thickness)
    for placement in lens.sensor_before:
        here = here.broken(placement)
    return [*out, here]


def _sag(surface: Surface, x: float, y: float) -> float:
    square, c = x * x + y * y, 0.0 if abs(surface.radius) == inf else 1 / surface.radius
    conic = c * square / (1 + np.sqrt(max(1 - (1 + surface.conic) * c * c * square, 0.0)))
    return conic + sum(a * square ** (2 + k) for k, a in enumerate(surface.aspheric)) + _uneven(surface, x, y)[0]


def _uneven(surface: Surface, x: float, y: float) -> tuple[float, np.ndarray]:
    """Return the sag of an irregularity of A·ρ² cos 2(θ − θ₀), θ from +y towards +x, and its gradient."""
    one = surface.irregularity
    if one is None:
        return 0.0, np.zeros(2)
    highest, theta0 = HALF_FRINGE_MM * one.peak_to_valley, np.arctan2(one.fringes_45, one.fringes) / 2
    r, theta = np.hypot(x, y), np.arctan2(x, y)
    scale = highest / one.normalisation_mm**2
    along, around = 2 * scale * r * np.cos(2 * (theta - theta0)), -2 * scale * r * np.sin(2 * (theta - theta0))
    outward, turning = np.array([np.sin(theta), np.cos(theta)]), np.array([np.cos(theta), -np.sin(theta)])
    return scale * r * r * np.cos(2 * (theta - theta0)), along * outward + around * turning


def _normal(surface: Surface, x: float, y: float) -> np.ndarray:
    square, c = x * x + y * y, 0.0 if abs(surface.radius) == inf else 1 / surface.radius
    steep = c / np.sqrt(1 - (1 + surface.conic) * c * c * square)
    steep += sum(2 * (2 + k) * a * square ** (1 + k) for k, a in enumerate(surface.aspheric))
    gradient = steep * np.array([x, y]) + _uneven(surface, x, y)[1]
    normal = np.array([*-gradient, 1.0])
    return normal / np.linalg.norm(normal)


@dataclass
class Flight:
    """One ray: where it met every surface and the sensor (surfaces + 1, 3), its last direction, its optical path.

    ``grazing`` is the smallest cosine of its angles of incidence and refraction.
    """

    points: np.ndarray
    direction: np.ndarray
    path: float
    grazing: float


def fly(lens: Lens, point: np.ndarray, direction: np.ndarray, wavelength_um: float) -> Flight:
    """Return a ray from a point of object space; `RuntimeError` where it meets no surface or no root is found."""
    places, media = poses(lens), lens.media
    here, way, path, points = np.array(point, float), np.array(direction) / np.linalg.norm(direction), 0.0, []
    grazing = 1.0
    for number, pose in enumerate(places):
        surface = lens.surfaces[number] if number < len(lens.surfaces) else Surface()
        index = float(media[number].index(wavelength_um))
        start, along = pose.turn.inv().apply(here - pose.origin), pose.turn.inv().apply(way)

        def height(t: float, start=start, along=along, surface=surface) -> float:
            x, y, z = start + t * along
            return z - _sag(surface, x, y)

        step = _root(height, -start[2] / along[2])
        here, path = here + step * way, path + index * step
        points.append(here)
        if number == len(lens.surfaces):
            return Flight(np.array(points), way, path, grazing)
        x, y, _ = start + step * along
        normal = pose.turn.apply(_normal(surface, x, y))
        bent = _bent(way, normal, index, float(media[number + 1].index(wavelength_um)), surface.reflects)
        grazing = min(grazing, abs(way @ normal), abs(bent @ normal))
        way = bent
    raise AssertionError


def _root(height: Callable[[float], float], near: float) -> float:
    """Return where a function vanishes, in the smallest interval tried about ``near`` with a change of sign."""
    for reach in 0.25 * 2.0 ** np.arange(8):
        low, high = height(near - reach), height(near + reach)
        if low * high < 0:
            return brentq(height, near - reach, near + reach, xtol=1e-15, rtol=4 * np.finfo(float).eps)
    raise RuntimeError("the ray misses the surface")


def _bent(way: np.ndarray, normal: np.ndarray, before: float, after: float, reflects: bool) -> np.ndarray:
    if reflects:
        return way - 2 * (way @ normal) * normal
    normal = normal if way @ normal > 0 else -normal
    ratio, cosine = before / after, way @ normal
    square = 1 - ratio**2 * (1 - cosine**2)
    if square < 0:
        raise RuntimeError("total reflection")
    return ratio * way + (np.sqrt(square) - ratio * cosine) * normal
