"""The pupil function A(ξ, η): the open part of the stop, its transmission and its phase.

All quantities are in stop coordinates: (ξ, η) on the unit disc of the stop's rim, angles from +η towards +ξ, as
azimuths of sources are. Phases are path lengths in µm, so that the wavelength scales them.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache
from math import acos, atan2, cos, hypot, inf, pi, radians, sin, sqrt
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_fields, real_array
from p2sf.conventions import FloatOrArray, write_protect
from p2sf.disc.domain import PupilDomain, domain_of
from p2sf.errors import RequestError
from p2sf.parameters import LONGEST_PATH_UM, MASK_PARAMETERS, check_between, check_finite, check_values

if TYPE_CHECKING:
    from scipy.interpolate import RectBivariateSpline

FEWEST_CELLS, MOST_CELLS, SAMPLED = 4, 1024, 129
SAME_ANGLE_DEG = 1e-9
SAME_PLACE = 1e-12  # of the rim's radius: smaller values are rounding
EDGE_HARMONICS = 0.5  # phase slope in waves equivalent to an amplitude slope of 1 per radius
PROBE = 65  # points across the pupil at which slopes are evaluated


def check_map_shape(shape: tuple[int, ...]) -> None:
    """Raise RequestError unless an array of this shape can be a map of the pupil."""
    if len(shape) != 2 or shape[0] != shape[1] or not FEWEST_CELLS <= shape[0] <= MOST_CELLS:
        raise RequestError(
            "a map of the pupil has the shape {shape}; give a square of {low} to {high} cells a side",
            shape=str(shape),
            low=FEWEST_CELLS,
            high=MOST_CELLS,
        )


class PupilMap:
    """A phase or an amplitude over the stop as samples, with a cubic spline through them (Dierckx 1993, ch. 5).

    ``values``: (size, size) at cell centres (2k + 1 − size)/size of the rim's radius, rows towards +η, columns
    towards +ξ; cells outside the disc matter too, since they shape the spline near the rim. Frozen and hashable.
    """

    def __init__(self, values: ArrayLike):
        from hashlib import sha256

        table = real_array("values", values)
        check_map_shape(table.shape)
        if not np.isfinite(table).all():
            raise RequestError("a map of the pupil has cells that are not finite; give every cell a finite number")
        self.values = write_protect(table)
        self._digest = sha256(table.tobytes()).digest()

    @classmethod
    def sampled(cls, function: Callable[[np.ndarray, np.ndarray], ArrayLike], size: int = SAMPLED) -> "PupilMap":
        """Return the map of a function of (ξ, η), which is called once for the whole square |ξ|, |η| < 1."""
        centre = (2 * np.arange(size) + 1 - size) / size
        xi, eta = np.meshgrid(centre, centre)
        return cls(np.broadcast_to(real_array("function", function(xi, eta)), xi.shape))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, PupilMap) and self._digest == other._digest

    def __hash__(self) -> int:
        return int.from_bytes(self._digest[:8], "big", signed=True)

    def __repr__(self) -> str:
        return f"<PupilMap: {len(self.values)} × {len(self.values)} cells>"

    def __getstate__(self) -> dict:
        return {"values": self.values, "_digest": self._digest}

    @property
    def even(self) -> bool:
        """Return whether the map is its own mirror image, ξ → −ξ."""
        return bool(np.array_equal(self.values, self.values[:, ::-1]))

    @cached_property
    def _spline(self) -> "RectBivariateSpline":
        from scipy.interpolate import RectBivariateSpline

        size = len(self.values)
        centre = (2 * np.arange(size) + 1 - size) / size
        return RectBivariateSpline(centre, centre, self.values)

    def at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the spline at points of any shape; beyond the centres of the outermost cells it stays constant."""
        values: np.ndarray = self._spline.ev(eta, xi)
        return values


@dataclass(frozen=True, kw_only=True)
class MaskSettings:
    """The numbers of the mask that a camera and the window may set; None means the value of the lens file.

    Attributes
    ----------
    obscuration : float, optional
        Radius of a dark disc in the stop, as a share of the rim's, 0 to 0.99.
    vanes : int, optional
        Number of vanes that run from the middle of the stop to its rim.
    vane_width : float, optional
        Width of a vane, as a share of the stop's diameter.
    vane_angle_deg : float, optional
        Direction of the first vane, degrees from +y towards +x.
    blades : int, optional
        Number of blades of the iris; 0 for a round one.
    roundness : float, optional
        Curvature of the blades' edges, as a share of the rim's: 0 straight, 1 a circle.
    blade_angle_deg : float, optional
        Direction of the iris's first corner, degrees from +y towards +x.
    apodisation : float, optional
        Radius where the amplitude has fallen to 1/e, as a share of the rim's; inf for none.
    apodisation_power : int, optional
        2 for a Gaussian, a larger even number for a super-Gaussian.
    cubic_um : float, optional
        α of the path α(ξ³ + η³) that a cubic phase plate adds, µm.
    """

    obscuration: float | None = None
    vanes: int | None = None
    vane_width: float | None = None
    vane_angle_deg: float | None = None
    blades: int | None = None
    roundness: float | None = None
    blade_angle_deg: float | None = None
    apodisation: float | None = None
    apodisation_power: int | None = None
    cubic_um: float | None = None


@dataclass(frozen=True)
class PupilMask:
    """The pupil mask in the stop: all parts apply together, and the default is the clear disc.

    Parameters
    ----------
    obscuration : float
        Radius of the dark disc, as a share of the rim's, 0 to 0.99.
    vanes : int
        Number of vanes from the middle to the rim, evenly spaced.
    vane_width : float
        Width of a vane, as a share of the rim's diameter.
    vane_angle_deg : float
        Direction of the first vane, degrees from +η towards +ξ.
    blades : int
        Number of blades of the iris, their corners on the rim's circle; 0 for a round stop.
    roundness : float
        Curvature of the blades' edges times the rim's radius: 0 for straight ones, 1 for a circle.
    blade_angle_deg : float
        Direction of the first corner, degrees from +η towards +ξ.
    apodisation : float
        Radius at which the amplitude is 1/e and the intensity 1/e², as a share of the rim's; inf for none.
    apodisation_power : int
        2 for a Gaussian, exp(−(ρ/width)²), a larger even number for a super-Gaussian.
    zernike_um : tuple of float
        Added optical path by Noll's terms from the first, µm RMS (Noll 1976).
    cubic_um : float
        α of the added path α(ξ³ + η³), µm: the cubic phase plate for extended depth of field (Dowski & Cathey 1995).
    phase_map : PupilMap, optional
        Additional path, µm.
    amplitude_map : PupilMap, optional
        Transmitted amplitude, as a factor.
    turn_deg : float
        Rotation of the whole mask, degrees from +η towards +ξ.
    obscuration_x, obscuration_y : float
        Centre of the dark disc in ξ and η, as shares of the rim's radius; the whole disc must lie within the rim.

    Raises
    ------
    RequestError
        For an impossible value.
    """

    obscuration: float = 0.0
    vanes: int = 0
    vane_width: float = 0.02
    vane_angle_deg: float = 0.0
    blades: int = 0
    roundness: float = 0.0
    blade_angle_deg: float = 0.0
    apodisation: float = inf
    apodisation_power: int = 2
    zernike_um: tuple[float, ...] = ()
    cubic_um: float = 0.0
    phase_map: PupilMap | None = None
    amplitude_map: PupilMap | None = None
    turn_deg: float = 0.0
    obscuration_x: float = 0.0
    obscuration_y: float = 0.0

    def __post_init__(self) -> None:
        from p2sf.disc.zernike_terms import MOST_TERMS

        check_fields(self)
        check_values(self, MASK_PARAMETERS)
        _check_within(self.obscuration, self.obscuration_x, self.obscuration_y)
        for value in self.zernike_um:
            check_between("zernike_um", value, -LONGEST_PATH_UM, LONGEST_PATH_UM)
        check_finite("turn_deg", self.turn_deg)
        if len(self.zernike_um) > MOST_TERMS["noll"]:
            raise RequestError(
                "{parameter} has {count} terms; give up to {most} numbers",
                parameter="zernike_um",
                count=len(self.zernike_um),
                most=MOST_TERMS["noll"],
            )

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash(tuple(getattr(self, field.name) for field in fields(self)))

    def __getstate__(self) -> dict:
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def clear(self) -> bool:
        """Return whether this is the clear disc."""
        return not (self.edged or self.shaded or self.phased)

    @property
    def edged(self) -> bool:
        """Return whether the mask has hard edges within the disc."""
        return bool(self.obscured or self.spider or self.iris)

    @property
    def obscured(self) -> bool:
        """Return whether there is an obscuration."""
        return self.obscuration > 0

    @cached_property
    def disc(self) -> "Disc":
        """Return the obscuration, of radius 0 at the centre if there is none."""
        if not self.obscured:
            return Disc(0.0, 0.0, 0.0)
        place = np.array(self.obscuration_x), np.array(self.obscuration_y)
        xi, eta = map(float, _turned_points(*place, self.turn_deg))
        return Disc(xi, eta, self.obscuration)

    @property
    def spider(self) -> bool:
        """Return whether there are vanes of any width."""
        return bool(self.vanes and self.vane_width)

    @property
    def iris(self) -> bool:
        """Return whether there are blades that do not form a circle."""
        return bool(self.blades and self.roundness < 1)

    @property
    def annular(self) -> bool:
        """Return whether the mask is only a central obscuration, so that the pupil is a ring."""
        return self.obscured and self.round and not (self.iris or self.shaded or self.phased)

    @property
    def shaded(self) -> bool:
        """Return whether the transmission of the open part varies."""
        return self.apodisation < inf or self.amplitude_map is not None

    @property
    def phased(self) -> bool:
        """Return whether there is a phase."""
        return bool(any(self.zernike_um) or self.cubic_um or self.phase_map is not None)

    @cached_property
    def even(self) -> bool:
        """Return whether the mask is its own mirror image, ξ → −ξ, as a lens with a source in the plane ξ = 0 is."""
        upright = _multiple_of(self.turn_deg, 180)
        maps = [part for part in (self.phase_map, self.amplitude_map) if part is not None]
        terms = [t for t, waves in zip(_terms(len(self.zernike_um)), self.zernike_um, strict=True) if waves]
        return (
            abs(self.disc.xi) <= SAME_PLACE
            and not (self.spider and not _mirrored(self.vane_angle_deg + self.turn_deg, self.vanes))
            and not (self.iris and not _mirrored(self.blade_angle_deg + self.turn_deg, self.blades))
            and not self.cubic_um
            and all(upright and part.even for part in maps)
            and all(term.m == 0 or (upright and term.even) for term in terms)
        )

    @property
    def domain(self) -> PupilDomain:
        """Return the part of the disc that determines the whole mask."""
        return domain_of(self.even)

    @cached_property
    def round(self) -> bool:
        """Return whether the mask is rotationally symmetric."""
        terms = [t for t, waves in zip(_terms(len(self.zernike_um)), self.zernike_um, strict=True) if waves]
        maps = self.phase_map is not None or self.amplitude_map is not None
        straight = self.spider or self.iris or self.cubic_um or maps
        return self.disc.centred and not straight and all(term.m == 0 for term in terms)

    @cached_property
    def quartered(self) -> bool:
        """Return whether the mask is its own mirror image across both axes."""
        return self.even and self.turned(90.0).even

    @cached_property
    def round_part(self) -> "PupilMask":
        """Return the rotationally symmetric part of the mask without its phase: a central obscuration, apodisation."""
        middle = self.obscuration if self.disc.centred else 0.0
        return replace(self.without_phase(), vanes=0, blades=0, amplitude_map=None, obscuration=middle)

    @cached_property
    def without_vanes(self) -> "PupilMask":
        """Return the mask without its vanes, for what takes few points or one line of the pupil.

        So thin are they that they cover hardly any of its area, but all of a line that lies along one.
        """
        return replace(self, vanes=0) if self.vanes else self

    def turned(self, angle_deg: float) -> "PupilMask":
        """Return the mask rotated by an angle, degrees from +η towards +ξ; the same object if it is unchanged."""
        return self if self.round or not angle_deg else replace(self, turn_deg=self.turn_deg + angle_deg)

    def without_phase(self) -> "PupilMask":
        """Return the same mask without its phase."""
        return replace(self, zernike_um=(), cubic_um=0.0, phase_map=None) if self.phased else self

    def path_um(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the optical path that the mask adds at pupil points of any shape, µm."""
        from p2sf.disc.zernike_terms import zernike_values

        xi, eta = map(np.asarray, _turned_points(xi, eta, -self.turn_deg))
        path = np.zeros(xi.shape)
        if any(self.zernike_um):
            values = zernike_values(_terms(len(self.zernike_um)), np.ravel(xi), np.ravel(eta))
            path += np.reshape(np.asarray(self.zernike_um) @ values, path.shape)
        if self.cubic_um:
            path += self.cubic_um * (xi**3 + eta**3)
        return path if self.phase_map is None else path + self.phase_map.at(xi, eta)

    def amplitude(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the transmitted amplitude at points of the open part, of any shape."""
        amplitude = np.ones(np.shape(xi))
        if self.apodisation < inf:
            square = np.square(xi / self.apodisation) + np.square(eta / self.apodisation)
            amplitude *= np.exp(-(square ** (self.apodisation_power // 2)))
        if self.amplitude_map is not None:
            amplitude *= self.amplitude_map.at(*map(np.asarray, _turned_points(xi, eta, -self.turn_deg)))
        return amplitude

    def opens(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return which points of the disc are not covered by obscuration, vanes or blades, bool."""
        xi, eta = np.asarray(xi, float), np.asarray(eta, float)
        open_: np.ndarray = self.disc.depth(xi, eta) <= 0
        for edge in self.edges:
            open_ &= edge.lies_inside(xi, eta)
        if self.spider:
            for angle in self.vane_angles:
                along, aside = eta * cos(angle) + xi * sin(angle), xi * cos(angle) - eta * sin(angle)
                open_ &= ~((along >= 0) & (np.abs(aside) < self.vane_width))
        return open_

    @property
    def vane_angles(self) -> tuple[float, ...]:
        """Return the directions of the vanes, radians from +η towards +ξ."""
        first = self.vane_angle_deg + self.turn_deg
        return tuple(radians(first + 360 * k / self.vanes) for k in range(self.vanes if self.spider else 0))

    @property
    def corner_angles(self) -> tuple[float, ...]:
        """Return the directions of the iris's corners, radians from +η towards +ξ, ascending over one turn."""
        first = self.blade_angle_deg + self.turn_deg
        return tuple(radians(first + 360 * k / self.blades) for k in range(self.blades if self.iris else 0))

    @property
    def edges(self) -> "tuple[BladeEdge, ...]":
        """Return the edges of the blades; empty for a round stop."""
        return tuple(BladeEdge(angle + pi / self.blades, self.blades, self.roundness) for angle in self.corner_angles)

    @property
    def bounds(self) -> "tuple[Inside, ...]":
        """Return within what the mask is open but for obscuration and vanes: the blades, or the stop's rim."""
        return self.edges or (WHOLE_STOP,)


class Inside(Protocol):
    """A part of the stop within an edge, all of which is seen from the points asked about."""

    def depth(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return how far inside the edge points lie, negative outside."""

    def distance(self, xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray) -> np.ndarray:
        """Return the distance of inner points (ξ, η) from the edge along the directions (sine, cosine)."""


@dataclass(frozen=True)
class Disc:
    """A disc about (ξ, η) of this radius, all in radii of the rim."""

    xi: float
    eta: float
    radius: float

    @property
    def middle(self) -> tuple[float, float]:
        """Return its centre."""
        return self.xi, self.eta

    @property
    def centred(self) -> bool:
        """Return whether it is centred on the stop."""
        return not (self.xi or self.eta)

    def depth(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the depth of points inside the disc, negative outside."""
        depth: np.ndarray = self.radius - np.hypot(xi - self.xi, eta - self.eta)
        return depth

    def chord(
        self, xi: np.ndarray, eta: np.ndarray, sine: FloatOrArray, cosine: FloatOrArray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the distances at which lines from points enter and leave the disc along the directions (sine, cosine).

        For a line that misses the disc both are that of its nearest point.
        """
        across, up = xi - self.xi, eta - self.eta
        along = across * sine + up * cosine
        half = np.sqrt(np.maximum(along**2 + self.radius**2 - across * across - up * up, 0))
        return -half - along, half - along

    def distance(self, xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray) -> np.ndarray:
        """Return the distance of inner points (ξ, η) from its edge along the directions (sine, cosine)."""
        return self.chord(xi, eta, sine, cosine)[1]

    def outline(self, theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η of its edge in directions from its centre, radians from +η towards +ξ."""
        return self.xi + self.radius * np.sin(theta), self.eta + self.radius * np.cos(theta)


@dataclass(frozen=True)
class BladeEdge:
    """The edge of one blade, a straight line or an arc of curvature ``roundness`` through two corners on the rim.

    ``angle``: that of its middle, radians from +η towards +ξ. Inside it, with n the direction of its middle, d and c
    the distance and half length of its chord and m = √(1 − κ²c²), κ(|p|² + d² − c²)/2 − (κd − m)p·n − dm ≤ 0: the disc
    of radius 1/κ through both corners, which is the half plane p·n ≤ d where κ = 0.
    """

    angle: float
    blades: int
    roundness: float

    def _numbers(self) -> tuple[float, float, float]:
        """Return κ/2, κd − m and the constant term."""
        half, distance, kappa = sin(pi / self.blades), cos(pi / self.blades), self.roundness
        m = sqrt(1 - (kappa * half) ** 2)
        return kappa / 2, kappa * distance - m, kappa / 2 * (distance**2 - half**2) - distance * m

    def depth(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the depth of points inside the edge, negative outside: to first order near the edge."""
        square, linear, constant = self._numbers()
        across = xi * sin(self.angle) + eta * cos(self.angle)
        depth: np.ndarray = linear * across - square * (xi * xi + eta * eta) - constant
        return depth

    def lies_inside(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return which points the blade leaves open."""
        return self.depth(xi, eta) >= 0

    def distance(self, xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray) -> np.ndarray:
        """Return the distance of inner points (ξ, η) from the edge along the directions (sine, cosine), inf if none.

        The larger root of a quadratic equation, written without cancellation for a nearly straight edge.
        """
        square, linear, constant = self._numbers()
        normal_xi, normal_eta = sin(self.angle), cos(self.angle)
        b = 2 * square * (xi * sine + eta * cosine) - linear * (sine * normal_xi + cosine * normal_eta)
        c = square * (xi * xi + eta * eta) - linear * (xi * normal_xi + eta * normal_eta) + constant
        below = b + np.sqrt(np.maximum(b * b - 4 * square * np.minimum(c, 0), 0))
        inner = -2 * np.minimum(c, 0)
        distance: np.ndarray = np.divide(inner, below, where=below > 0, out=np.full(np.shape(below), inf))
        return distance

    @property
    def half_length(self) -> float:
        """Return half the length of the chord between the corners."""
        return sin(pi / self.blades)

    def points(self, place: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return ξ and η of the edge above the point of its chord at ``place`` from the middle towards larger angles.

        Also returns their derivatives with respect to ``place``. The edge lies κ(c² − u²)/(√(1 − κ²u²) + √(1 − κ²c²))
        above its chord, which is the difference of both roots over κ.
        """
        kappa, half = self.roundness, self.half_length
        root, end = np.sqrt(1 - (kappa * place) ** 2), sqrt(1 - (kappa * half) ** 2)
        out = cos(pi / self.blades) + kappa * (half**2 - place**2) / (root + end)
        rise = -kappa * place / root
        sine, cosine = sin(self.angle), cos(self.angle)
        return (
            out * sine + place * cosine,
            out * cosine - place * sine,
            rise * sine + cosine,
            rise * cosine - sine,
        )

    def crossings(self, disc: Disc) -> tuple[float, ...]:
        """Return the directions from the centre of a disc in which its edge crosses that of the blade, radians.

        On the circle the depth inside the edge is a constant plus a cosine of the angle from one direction. Only
        crossings between the corners of the blade count.
        """
        square, linear, constant = self._numbers()
        normal_xi, normal_eta = sin(self.angle), cos(self.angle)
        across, up = linear * normal_xi - 2 * square * disc.xi, linear * normal_eta - 2 * square * disc.eta
        swing = disc.radius * hypot(across, up)
        mean = linear * (disc.xi * normal_xi + disc.eta * normal_eta) - constant
        mean -= square * (disc.xi**2 + disc.eta**2 + disc.radius**2)
        if not abs(mean) < swing:
            return ()
        middle, apart = atan2(across, up), acos(-mean / swing)
        found = (middle - apart, middle + apart)
        places = np.stack(disc.outline(np.array(found)))
        along = places[0] * normal_eta - places[1] * normal_xi  # from the middle of the chord
        return tuple(angle for angle, at in zip(found, along, strict=True) if abs(at) < self.half_length)


@dataclass(frozen=True)
class MaskSlopes:
    """Steepest slopes of the smooth parts of a mask per rim radius or radian: path in µm, amplitude as a factor."""

    path_radial_um: float
    path_angular_um: float
    amplitude: float


@lru_cache(maxsize=64)
def mask_slopes(mask: PupilMask) -> MaskSlopes:
    """Return the steepest slopes over the disc, from differences on a polar grid."""
    rho = np.linspace(0, 1, PROBE)[:, None]
    theta = np.linspace(0, 2 * pi, 2 * PROBE)
    xi, eta = rho * np.sin(theta), rho * np.cos(theta)
    path, amplitude = mask.path_um(xi, eta), mask.amplitude(xi, eta)
    steps = rho[1, 0], theta[1]
    slopes = [float(np.abs(np.gradient(path, step, axis=axis)).max()) for axis, step in enumerate(steps)]
    fall = max(float(np.abs(np.gradient(amplitude, step, axis=axis)).max()) for axis, step in enumerate(steps))
    return MaskSlopes(slopes[0], slopes[1], fall)


def _terms(count: int) -> tuple:
    from p2sf.disc.zernike_terms import zernike_terms

    return zernike_terms("noll", count) if count else ()


def _turned_points(xi: np.ndarray, eta: np.ndarray, angle_deg: float) -> tuple[np.ndarray, np.ndarray]:
    """Return points rotated from +η towards +ξ."""
    if not angle_deg:
        return xi, eta
    sine, cosine = sin(radians(angle_deg)), cos(radians(angle_deg))
    return xi * cosine + eta * sine, eta * cosine - xi * sine


def _mirrored(first_deg: float, count: int) -> bool:
    """Return whether ``count`` evenly spaced directions from ``first_deg`` are their own mirror image."""
    return _multiple_of(2 * first_deg, 360 / count)


def _multiple_of(angle_deg: float, step_deg: float) -> bool:
    rest = angle_deg % step_deg
    return min(rest, step_deg - rest) < SAME_ANGLE_DEG


def _check_within(radius: float, x: float, y: float) -> None:
    if radius and (x or y) and not radius + hypot(x, y) <= 1 + SAME_PLACE:
        raise RequestError(
            "{parameter} is {value:g} about ({x:g}, {y:g}), which extends beyond the rim of the stop; make it smaller "
            "or move it towards the centre",
            parameter="obscuration",
            value=radius,
            x=x,
            y=y,
        )


CLEAR = PupilMask()
WHOLE_STOP = Disc(0.0, 0.0, 1.0)
