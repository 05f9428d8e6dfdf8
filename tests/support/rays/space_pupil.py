"""Wavefront and centre of light of a misaligned lens, by rays of `space_rays`.

The chief ray is aimed at the middle of the real stop. All others are launched over the entrance pupil that the lens
has when it is set straight, and where they met the stop is measured: what they carry is a polynomial over that.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import isinf

import numpy as np
from numpy.polynomial.legendre import leggauss

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from tests.support.rays.skew_rays import back_to_sphere, entrance_pupil, exit_pupil_mm, object_point, system_of
from tests.support.rays.space_rays import Flight, fly, poses
from tests.support.waves import rms_about_plane

RADII, ANGLES, DEGREE = 8, 18, 9  # of the rays, and of the polynomials: two degrees more change no RMS by 1e-8 waves
BEYOND = 1.05  # how much wider than the pupil rays are launched, so that it is nowhere extrapolated
BEFORE_MM = 5.0  # of the first vertex, where rays begin
AIMED = 1e-9  # of the stop's radius


@dataclass(frozen=True)
class SpacePupil:
    """Values at rays, and ``stop`` (2, ray): where in the stop these were, 1 at its rim.

    ``waves``: the path on the sphere about the chief ray's point on the sensor, through its point in the exit pupil of
    the aligned lens. ``place_um``: (2, ray) on the sensor from there, along its axes. ``slope``: (2, ray) its
    cosines along them. ``entered``: (2, ray) mm.
    """

    stop: np.ndarray
    waves: np.ndarray
    place_um: np.ndarray
    slope: np.ndarray
    entered: np.ndarray

    def at(self, values: np.ndarray, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the polynomial through values of the rays, at points of the stop."""
        found = np.linalg.lstsq(_powers(*self.stop), values.T, rcond=None)[0]
        return (_powers(xi, eta) @ found).T


def _powers(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.stack([x**a * y**b for a in range(DEGREE + 1) for b in range(DEGREE + 1 - a)], -1)


def open_nodes(lens: Lens) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ξ, η and weights of a rule over the unit disc outside the obscuration, of sum 1."""
    node, weight = leggauss(12)
    angle = 2 * np.pi * (np.arange(32) + 0.5) / 32
    dark = lens.mask.obscuration**2
    rho = np.sqrt((1 + dark + (1 - dark) * node) / 2)[:, None]
    return (rho * np.sin(angle)).ravel(), (rho * np.cos(angle)).ravel(), np.repeat(weight / 2, 32) / 32


@lru_cache(maxsize=64)
def space_pupil(lens: Lens, source: Source) -> SpacePupil:
    """Return the rays of a lens whose pupil is the image of its stop."""
    assert lens.aim == "stop" and not source.azimuth_deg
    rays = _Launch(lens, source)
    middle, chief = rays.chief()
    rho = np.sqrt((np.arange(RADII) + 0.5) / RADII)[:, None] * BEYOND
    angle = 2 * np.pi * np.arange(ANGLES) / ANGLES + 0.1 * np.arange(RADII)[:, None]
    entered = middle + np.stack([rho * np.sin(angle), rho * np.cos(angle)], -1).reshape(-1, 2)
    flown = [rays.flown(point) for point in entered]
    stop = np.array([rays.in_stop(flight) for flight, _ in flown])
    assert np.hypot(*stop.T).max() > 1, "the rays do not fill the stop"
    paths = np.array([start + _to_sphere(flight, chief[0], rays) for flight, start in flown])
    axes = poses(lens)[-1].turn.inv()
    place = axes.apply(np.array([flight.points[-1] - chief[0].points[-1] for flight, _ in flown]))
    slope = axes.apply(np.array([flight.direction for flight, _ in flown]))
    return SpacePupil(
        stop.T,
        paths / (source.wavelength_um / 1000),
        1000 * place[:, :2].T,
        slope[:, :2].T,
        rays.radius * entered.T,
    )


def _to_sphere(flight: Flight, chief: Flight, rays: "_Launch") -> float:
    """Return a ray's path as it crosses the reference sphere, mm, from the first point of `fly`."""
    away = flight.points[-1] - chief.points[-1]
    radius = (rays.lens.sensor_mm - exit_pupil_mm(rays.system)) / rays.chief_cosine(chief)
    return flight.path - abs(rays.system.last) * float(back_to_sphere(away @ flight.direction, away @ away, radius))


class _Launch:
    """Rays from a source towards points of the entrance pupil that the lens has without its tilts and decentres."""

    def __init__(self, lens: Lens, source: Source):
        self.lens, self.source = lens, source
        straight = replace(lens, surfaces=tuple(replace(s, before=(), after=()) for s in lens.surfaces))
        self.system = system_of(straight, source.wavelength_um)
        self.plane, self.radius = entrance_pupil(self.system)
        self.where = object_point(self.system, source)

    def chief_cosine(self, chief: Flight) -> float:
        """Return the cosine of the chief ray about the axis behind the last surface."""
        pose = poses(self.lens)[-2]
        for placement in self.lens.surfaces[-1].after:
            pose = pose.broken(placement)
        return float(pose.turn.inv().apply(chief.direction)[2])

    def flown(self, entered: np.ndarray) -> tuple[Flight, float]:
        """Return a ray through a point of the entrance pupil, in its radii, and its path from the source to `fly`."""
        point = np.array([*(self.radius * entered), self.plane])
        if self.where is None:
            way = np.array([0.0, self.source.field_slope, 1.0])
        else:
            way = point - self.where[:, 0]
        way = way / np.linalg.norm(way) * np.sign(way[2])
        start = point - (point[2] + BEFORE_MM) / way[2] * way
        index = self.system.index[0]
        path = start @ way if self.where is None else np.linalg.norm(start - self.where[:, 0])
        return fly(self.lens, start, way, self.source.wavelength_um), index * float(path)

    def in_stop(self, flight: Flight) -> np.ndarray:
        """Return where a ray met the stop, along the axes of its surface, in its radii."""
        pose = poses(self.lens)[self.system.stop]
        return pose.turn.inv().apply(flight.points[self.system.stop] - pose.origin)[:2] / self.system.rim

    def chief(self) -> tuple[np.ndarray, tuple[Flight, float]]:
        """Return where the ray through the middle of the stop enters, and the ray: by Newton's method."""
        place = np.zeros(2)
        for _ in range(10):
            ray = self.flown(place)
            miss = self.in_stop(ray[0])
            if np.hypot(*miss) < AIMED:
                return place, ray
            steps = [self.in_stop(self.flown(place + step)[0]) - miss for step in 1e-4 * np.eye(2)]
            place = place - 1e-4 * np.linalg.solve(np.transpose(steps), miss)
        raise RuntimeError("no ray goes through the middle of the stop")


def rms_waves(lens: Lens, source: Source) -> float:
    """Return the RMS of the wavefront without piston and tilt over the stop."""
    pupil, (xi, eta, share) = space_pupil(lens, source), open_nodes(lens)
    return rms_about_plane(pupil.at(pupil.waves, xi, eta), xi, eta, share)


def centroid_um(lens: Lens, source: Source) -> np.ndarray:
    """Return (x, y) of the centre of light of a source at infinity, from the chief ray, µm.

    What lands there is the light of the plane waves: |da/df|² df = (da/ds)²/(df/ds) ds, with a the entrance pupil's
    area, f that of directions at the sensor and s that of the stop.
    """
    assert isinf(source.depth_mm)
    pupil, (xi, eta, share) = space_pupil(lens, source), open_nodes(lens)
    entered, directions = (_jacobian(pupil, values, xi, eta) for values in (pupil.entered, pupil.slope))
    light = share * entered**2 / directions
    return pupil.at(pupil.place_um, xi, eta) @ light / light.sum()


def _jacobian(pupil: SpacePupil, values: np.ndarray, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return how much area of ``values`` (2, ray) an area of the stop makes, by central differences."""
    step = 1e-5
    (ax, bx), (ay, by) = (
        (pupil.at(values, xi + step * i, eta + step * j) - pupil.at(values, xi - step * i, eta - step * j)) / (2 * step)
        for i, j in ((1, 0), (0, 1))
    )
    return np.abs(ax * by - bx * ay)
