"""The rays of a source as they enter: through the paraxial entrance pupil, or aimed to fill the real stop.

See handbook 8.2.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf, sqrt
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import FloatOrArray, degrees_from_slope, slope_from_degrees, vergence
from p2sf.disc.basis import Terms
from p2sf.disc.disc_function import Counts, DiscFunction
from p2sf.disc.domain import ClearNodes, PupilDomain
from p2sf.disc.zernike import basis_by_powers
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, indices, message_if_misaligned
from p2sf.lens.source import Source
from p2sf.messages import Message, ParameterName
from p2sf.paraxial.first_order import check_depth
from p2sf.paraxial.pupils import Pupils, Stop, find_stop, pupils
from p2sf.raytrace.surface import Beam, Status
from p2sf.raytrace.trace import Index, launch, per_ray, run

AIM_STEPS = 12
STEPS_TOGETHER = 2  # of all rays at once; those that need more are fewer, and taken by themselves
AIM_ERROR = 1e-10  # of the pupil's radius: the most that an entrance point may be off
CHIEF_AIM_ERROR = 1e-6  # the same for the chief ray where other rays are only looked for from there
SUM_AIM_ERROR = 1e-6  # the same for rays whose phase and frequency are taken as they are, only their cell is off
DIFFERENCE = 1e-5  # of the pupil's radius: of central differences, good to its square and to rounding over it
MOST_CHANGE = 0.01  # of the gain over one `DIFFERENCE`; among rays of the pupil it changes by less than 1e-3
ROUNDING_STEP = 1e-8  # of the distances in the lens, for pupils so small that the step would meet their rounding
CONTINUATION = (0.2, 0.4, 0.6, 0.8, 1.0)
ROUGH_ORDER, ROUGH_NODES = 9, (6, 20)  # a guess to 1e-6 of the radius for most lenses, from 60 rays
PANEL_DEG = 2.0  # of field, over which rough maps are known from five to 1e-9 of the radius
FIELDS = np.cos((np.arange(5) + 0.5) * (np.pi / 5))  # of these, −1 … 1 over the panel (Chebyshev)
FINE = (9, 34), (12, 46)  # nodes of maps that may stand for aiming
GUESS = 16, 60  # of the map from which many rays take one step where none stands for aiming
NEARLY = 1e-6  # of the pupil's radius: a map that is farther off is not exact at the next order either
WEIGHT_ERROR = 1e-7  # the most that a launch weight by a map may be off, on the rim
RIM_RAYS = 9  # by which maps are judged
LAST_MOVE = 0.3  # of the root of the error allowed: a Newton step leaves its square, times the map's curvature
SEARCH_RADII, SEARCH_POINTS = 4.0, 33  # of the paraxial pupil, where the chief ray is looked for; points a side
RIDGE = 1e-12  # added to the normal equations, so that they can be solved however the points lie
FEW = 24  # rays, below which a map costs more than the steps of Newton's method it saves
MANY = 512  # rays, from which on a map that need not be confirmed ray by ray costs less than a Newton step
VERY_MANY = 1024  # rays, more than any map is laid through, that are guessed by that of GUESS

NO_DISC = Message(
    "parts of the lens are tilted or decentred, and its pupil is no paraxial disc; choose {parameter} stop",
    parameter=ParameterName("aim"),
)
Nodes: TypeAlias = np.ndarray  # (ray,)
Point: TypeAlias = tuple[np.ndarray, np.ndarray]  # x and y, mm
Slopes: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True, eq=False)
class Sources:
    """Several point sources traced at once: a `Source` of arrays that broadcast, the leading axes of every result."""

    depth_mm: FloatOrArray
    field_slope: FloatOrArray
    wavelength_um: FloatOrArray

    @classmethod
    def of(cls, sources: Sequence[Source]) -> "Sources":
        """Return sources of one azimuth, (n,), as one."""
        return cls(*np.array([(s.depth_mm, s.field_slope, s.wavelength_um) for s in sources]).T)


@dataclass(frozen=True, eq=False)
class PupilRays:
    """Rays where they cross the plane of the paraxial entrance pupil.

    ``x``, ``y``: (…, ray) mm in that plane, which lies ``plane`` mm behind the first vertex. ``slope_x``, ``slope_y``:
    dx/dz, dy/dz. ``path``: optical path from the source, mm, less that to the pupil's centre; for a source at
    infinity, from the plane wavefront through that centre. ``index``: per medium, object space first, at
    ``wavelength_um``, (…, 1) or a number.
    ``launch``: the light sent through unit area about (ξ, η), over that of the paraxial pupil's: the solid angle times
    the square of the distance, for a source at infinity an area; 1 for the paraxial pupil itself. ``stop_surface``: the
    stop at which rays were aimed, 0 if they were not; a ray that could not be aimed is NaN. ``reach`` and
    ``chief_slope``, (…, 1): as in `Entrance`, which is where the source stands.
    """

    x: np.ndarray
    y: np.ndarray
    slope_x: np.ndarray
    slope_y: np.ndarray
    path: np.ndarray
    plane: np.ndarray
    index: Index
    wavelength_um: FloatOrArray
    reach: FloatOrArray
    chief_slope: FloatOrArray
    launch: FloatOrArray = 1.0
    stop_surface: int = 0

    @property
    def origins(self) -> np.ndarray:
        """Return points (…, ray, 3) on the rays, mm from the first vertex."""
        return np.stack(np.broadcast_arrays(self.x, self.y, self.plane), -1)

    @property
    def directions(self) -> np.ndarray:
        """Return unit vectors (…, ray, 3) along the rays."""
        slopes = np.stack(np.broadcast_arrays(self.slope_x, self.slope_y, 1.0), -1)
        unit: np.ndarray = slopes / np.linalg.norm(slopes, axis=-1, keepdims=True)
        return unit


@dataclass(frozen=True, eq=False)
class Entrance:
    """The paraxial entrance pupil as a source sees it; every array ends in a ray axis of length one.

    ``plane`` mm from the first vertex, ``radius`` mm, ``reach`` = 1/(object to entrance pupil) per mm, ``slope`` of the
    chief ray, ``exit_plane`` mm from the last vertex, ``index`` per medium, object space first; ``upright`` is −1
    where the pupil is an inverted image of the stop, else 1. A single ``wavelength_um`` is a number.
    """

    plane: np.ndarray
    radius: np.ndarray
    reach: np.ndarray
    slope: np.ndarray
    exit_plane: np.ndarray
    index: Index
    stop: Stop
    upright: np.ndarray
    wavelength_um: FloatOrArray


def entrance(lens: Lens, source: Source | Sources, stop: Stop | None = None) -> Entrance:
    """Return the entrance pupil as the source sees it; GeometryError where it, or the cone of light, does not exist."""
    check_depth(source.depth_mm)
    pupil, index, stop = _first_order(lens, source.wavelength_um, stop)
    plane = np.asarray(pupil.entrance_from_first)
    if not np.isfinite(plane).all():
        raise GeometryError(
            "the entrance pupil is at infinity, so a field angle has no meaning; move the stop away from that focus"
        )
    nearness = vergence(source.depth_mm)
    gap = 1 + nearness * plane
    if np.any(gap == 0):
        raise GeometryError("the object lies in the entrance pupil, so no cone of light is defined; move the object")
    radius = np.asarray(pupil.entrance_diameter) / 2
    values = (plane, radius, nearness / gap, np.asarray(source.field_slope), np.asarray(pupil.exit_from_last))
    plane, radius, reach, slope, exit_plane = (value[..., None] for value in values)
    upright, wave = np.asarray(pupil.upright)[..., None], source.wavelength_um
    waves = wave if isinstance(wave, float) else np.asarray(wave)[..., None]
    return Entrance(plane, radius, reach, slope, exit_plane, index, stop, upright, waves)


def _first_order(lens: Lens, wavelength_um: FloatOrArray, stop: Stop | None) -> tuple[Pupils, Index, Stop]:
    """Return pupils, indices per medium and the stop; cached while only field and depth are dragged."""
    if stop is None and np.ndim(wavelength_um) == 0:
        return _cached_first_order(lens, float(wavelength_um))
    stop = stop or find_stop(lens)
    return pupils(lens, wavelength_um, stop), per_ray(indices(lens, wavelength_um)), stop


@lru_cache(maxsize=256)
def _cached_first_order(lens: Lens, wavelength_um: float) -> tuple[Pupils, Index, Stop]:
    return _first_order(lens, wavelength_um, find_stop(lens))


def pupil_rays(
    lens: Lens,
    source: Source | Sources,
    xi: ArrayLike,
    eta: ArrayLike,
    stop: Stop | None = None,
    aim_error: float = AIM_ERROR,
) -> PupilRays:
    """Return the rays of a source through points (ξ, η) of the pupil of unit radius, each (ray,).

    ``lens.aim`` "paraxial" fills the paraxial entrance pupil, "stop" sends every ray through (ξ, η) of the stop, to
    ``aim_error`` of the pupil's radius. The axes of `Sources` come first. A misaligned lens is taken as it stands, so
    that of a source with an azimuth has to be `seen_from` there. Raises GeometryError, GlassError.
    """
    _check_aim(lens)
    enter = entrance(lens, source, stop)
    xi, eta = np.asarray(xi, dtype=float), np.asarray(eta, dtype=float)
    if lens.aim == "paraxial":
        return _through(enter, enter.radius * xi, enter.radius * eta)
    found = _stop_map(lens, source, aim_error) if stop is None and xi.size >= MANY and _single(enter) else None
    if found is None:
        return _aim(lens, source, enter, stop, xi, eta, aim_error)
    x, y, launch = found.at(xi, eta)
    return replace(_through(enter, x, y), launch=launch, stop_surface=int(np.max(enter.stop.surface)))


def _check_aim(lens: Lens) -> None:
    """Raise GeometryError for an aim that takes the pupil of a misaligned or shading lens for an even disc."""
    if lens.aim != "paraxial":
        return
    if lens.shading:
        raise GeometryError("{shading}, which the paraxial pupil takes for even; aim at the stop", shading=lens.shading)
    if reason := message_if_misaligned(lens, NO_DISC):
        raise GeometryError(reason)


def arriving(
    lens: Lens,
    source: Source | Sources,
    xi: np.ndarray,
    eta: np.ndarray,
    stop: Stop | None = None,
    rims: np.ndarray | None = None,
    aim_error: float = AIM_ERROR,
) -> tuple[Beam, FloatOrArray, Index]:
    """Return the rays of `pupil_rays` at the sensor, their paths from the source, their weights, and the indices.

    ``rims``, one per surface, mm, clip all but the last ray, the chief ray, from which differences are taken.
    """
    _check_aim(lens)
    if lens.aim == "stop" and rims is None:
        found = None
        if aim_error > AIM_ERROR and xi.size >= FEW and stop is None and isinstance(source, Source):
            found = _mapped_to_sensor(lens, source, xi, eta, aim_error)
        if found is None and xi.size < MANY:
            found = _aimed_to_sensor(lens, source, stop, xi, eta)
        if found is not None:
            return found
    rays = pupil_rays(lens, source, xi, eta, stop, aim_error)
    beam = start(rays)
    beam.exempt = 1
    run(lens, beam, rays.index, rims)
    beam.path += rays.path
    return beam, rays.launch, rays.index


def _single(enter: Entrance) -> bool:
    """Return whether this is one source, without leading axes."""
    return max(enter.slope.ndim, enter.reach.ndim, enter.radius.ndim) == 1


def _through(enter: Entrance, x: np.ndarray, y: np.ndarray, slope: FloatOrArray | None = None) -> PupilRays:
    """Return the source's rays through points of the entrance-pupil plane.

    The path difference D·√(…) − D·√(1 + s²) is written with 1/D and without a subtraction, so that no digit is
    lost for an object at 10⁶ m or at infinity.
    """
    s = enter.slope if slope is None else slope
    slope_x, slope_y = enter.reach * x, enter.reach * y + s
    length = np.sqrt(1 + slope_x * slope_x + slope_y * slope_y) + np.sqrt(1 + s * s)
    path = enter.index[0] * (enter.reach * (x * x + y * y) + 2 * s * y) / length
    waves = enter.wavelength_um
    return PupilRays(x, y, slope_x, slope_y, path, enter.plane, enter.index, waves, enter.reach, s)


def start(rays: PupilRays) -> Beam:
    """Return a new beam of these rays, positions from the first vertex."""
    scale = 1 / np.sqrt(1 + rays.slope_x * rays.slope_x + rays.slope_y * rays.slope_y)
    along = rays.slope_x * scale, rays.slope_y * scale, scale
    beam = launch(rays.index[0], rays.wavelength_um, (rays.x, rays.y, rays.plane), along)
    # The chief ray's slope leads from the source to the pupil's centre, 1/reach along the axis.
    beam.source = 0.0, -rays.chief_slope, rays.reach * rays.plane - 1, rays.reach
    if rays.stop_surface:
        beam.fail(np.isnan(beam.x), Status.UNAIMED, rays.stop_surface)
    return beam


def _stop_points(enter: Entrance, xi: Nodes, eta: Nodes) -> Point:
    """Return the points of the stop, mm, that rays through (ξ, η) are to meet."""
    rim = float(np.max(enter.stop.semi_diameter))
    return rim * enter.upright * xi, rim * enter.upright * eta


def _aim(
    lens: Lens, source: Source | Sources, enter: Entrance, stop: Stop | None, xi: Nodes, eta: Nodes, aim_error: float
) -> PupilRays:
    """Solve for entrance points whose real rays meet the stop at (ξ, η) of its rim; wide fields by continuation."""
    goal = _stop_points(enter, xi, eta)
    found = _newton(lens, enter, goal, _guess(lens, source, enter, stop, xi, eta), _move_mm(enter, aim_error))
    chief = _known_chief(lens, source, stop) if found.missed.any() else None
    if chief is not None:
        found = _aim_outwards(lens, enter, goal, chief, found)
    elif found.missed.any():
        found = _aim_by_continuation(lens, enter, goal, _paraxial(enter, xi, eta), found)
        found.x[found.missed] = found.y[found.missed] = np.nan
    launch = _launch_weight(enter, found.x, found.y, found.gain)
    return replace(_through(enter, found.x, found.y), launch=launch, stop_surface=int(np.max(enter.stop.surface)))


def _launch_weight(enter: Entrance, x: np.ndarray, y: np.ndarray, gain: np.ndarray) -> np.ndarray:
    """Return the weights of aimed rays through these entrance points; ``gain`` = ∂(stop point)/∂(entrance point)."""
    area = (float(np.max(enter.stop.semi_diameter)) / enter.radius) ** 2 / gain
    launch: np.ndarray = area * _solid_angle(enter, x, y)
    return launch


def _solid_angle(enter: Entrance, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the solid angle of unit area of the pupil's plane about each ray, over that about the chief ray.

    dΩ = dx dy·cosθ/distance², with 1/cosθ = √(1 + slope²), which is also the distance over that along the axis.
    """
    across, along = enter.reach * x, enter.reach * y + enter.slope
    square: np.ndarray = (1 + enter.slope**2) / (1 + across * across + along * along)
    share: np.ndarray = square * np.sqrt(square)
    return share


def _aimed_to_sensor(
    lens: Lens, source: Source | Sources, stop: Stop | None, xi: Nodes, eta: Nodes
) -> tuple[Beam, FloatOrArray, Index] | None:
    """Aim rays by a step or two of Newton's method, and carry them on; None where these do not do.

    The ray of each guess and its neighbours, by which the step is found, go on to the sensor. So small a step changes
    what arrives there in proportion, and the aimed ray itself need not be traced.
    """
    enter = entrance(lens, source, stop)
    at, step = int(np.max(enter.stop.surface)), _difference_mm(enter)
    (x, y), goal = _guess(lens, source, enter, stop, xi, eta), _stop_points(enter, xi, eta)
    for _ in range(STEPS_TOGETHER):
        launched = _through(enter, *_beside(x, y, step))
        beam = run(lens, start(launched), enter.index, last=at)
        move_x, move_y, (a, b, c, d), sound = _newton_step(beam, (goal[0] - beam.x[0], goal[1] - beam.y[0]), step)
        if ((np.hypot(move_x, move_y) <= _move_mm(enter, AIM_ERROR)) & sound).all():
            run(lens, beam, enter.index, first=at + 1)
            beam.path += launched.path
            x, y = x + move_x, y + move_y
            return (
                _interpolate_rays(beam, move_x / step, move_y / step),
                _launch_weight(enter, x, y, a * d - b * c),
                enter.index,
            )
        x, y = x + move_x, y + move_y
    return None


def _mapped_to_sensor(
    lens: Lens, source: Source, xi: Nodes, eta: Nodes, aim_error: float
) -> tuple[Beam, FloatOrArray, Index] | None:
    """Carry rays to the sensor that only the rough map aims; None where one meets the stop too far from its place."""
    found, enter = _map_with_launch(lens, source), entrance(lens, source)
    if found is None:
        return None
    at, rim = int(np.max(enter.stop.surface)), float(np.max(enter.stop.semi_diameter))
    x, y, launch = found.at(xi, eta)
    rays = _through(enter, x, y)
    beam, goal = run(lens, start(rays), enter.index, last=at), _stop_points(enter, xi, eta)
    if not np.hypot(goal[0] - beam.x, goal[1] - beam.y).max() <= aim_error * rim:
        return None
    run(lens, beam, enter.index, first=at + 1)
    beam.path += rays.path
    return beam, launch, enter.index


def _interpolate_rays(beam: Beam, share_x: np.ndarray, share_y: np.ndarray) -> Beam:
    """Return rays by linear interpolation between those of `_beside`; one fails if it or a neighbour does."""

    def interpolate(rows: np.ndarray) -> np.ndarray:
        here, right, left, up, down, _ = rows
        between: np.ndarray = right - left
        between *= share_x / 2
        between += share_y / 2 * (up - down)
        between += here
        return between

    place, ray = (interpolate(rows.swapaxes(0, 1)) for rows in (beam.place, beam.ray))
    out = Beam(place, ray, beam.wavelength_um)
    out.path = interpolate(beam.path)
    if isinstance(beam.transmission, np.ndarray):
        out.transmission, out.dimmed = interpolate(beam.transmission), beam.dimmed
    if beam.status.any():
        for status, surface in zip(beam.status, beam.failed_surface, strict=True):
            fresh = (out.status == Status.PASSED) & (status != Status.PASSED)
            out.status[fresh], out.failed_surface[fresh] = status[fresh], surface[fresh]
    return out


@dataclass(frozen=True, eq=False)
class _Aim:
    """Entrance points (…, ray), mm; ∂(stop point)/∂(entrance point) = ((a, b), (c, d)); which rays ``missed``."""

    x: np.ndarray
    y: np.ndarray
    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    missed: np.ndarray

    @property
    def gain(self) -> np.ndarray:
        """Return the determinant of the derivatives: area on the stop over that at the entrance."""
        gain: np.ndarray = self.a * self.d - self.b * self.c
        return gain


def _newton(
    lens: Lens,
    enter: Entrance,
    goal: Point,
    guess: Point,
    enough: float,
    part: float = 1.0,
    steps: int = AIM_STEPS,
) -> _Aim:
    """Return the entrance points whose rays, at this part of the field slope, meet the stop at ``goal``.

    A step of at most ``enough`` mm is the last one.
    """
    step = _difference_mm(enter)
    beam = _at_stop(lens, enter, _beside(*guess, step), part)
    move_x, move_y, slopes, sound = _newton_step(beam, (goal[0] - beam.x[0], goal[1] - beam.y[0]), step)
    far = np.hypot(move_x, move_y)
    found = _Aim(guess[0] + move_x, guess[1] + move_y, *slopes, ~((far <= enough) & sound))
    again = (far > enough).any(tuple(range(far.ndim - 1)))
    if steps > 1 and again.any():
        some = (goal[0][..., again], goal[1][..., again]), (found.x[..., again], found.y[..., again])
        better = _newton(lens, enter, *some, enough, part, steps - 1)
        for column, new in zip(vars(found).values(), vars(better).values(), strict=True):
            column[..., again] = new
    return found


def _move_mm(enter: Entrance, aim_error: float) -> float:
    """Return the longest last step of Newton's method, mm: it leaves a point off by about its square, in radii."""
    return LAST_MOVE * sqrt(aim_error) * float(np.max(enter.radius))


def _aim_by_continuation(lens: Lens, enter: Entrance, goal: Point, start_at: Point, found: _Aim) -> _Aim:
    """Return ``found`` with the rays that missed aimed anew, by way of smaller fields."""
    lost = np.flatnonzero(found.missed.any(tuple(range(found.missed.ndim - 1))))
    some = goal[0][..., lost], goal[1][..., lost]
    guess = start_at[0][..., lost], start_at[1][..., lost]
    for part in CONTINUATION:
        again = _newton(lens, enter, some, guess, _move_mm(enter, AIM_ERROR), part)
        guess = again.x, again.y
    better = found.missed[..., lost] & ~again.missed
    for old, new in zip(vars(found).values(), vars(again).values(), strict=True):
        old[..., lost] = np.where(better, new, old[..., lost])
    return found


def _difference_mm(enter: Entrance) -> float:
    """Return the step of the differences: far above the rounding of positions, far below where the map bends."""
    return DIFFERENCE * float(np.max(enter.radius)) + ROUNDING_STEP * float(np.max(np.abs(enter.plane)))


def _beside(x: np.ndarray, y: np.ndarray, step: float) -> Point:
    """Return each point and its neighbours to the right, left, top, bottom and top right, on a new first axis.

    They are ``step`` mm away in x and in y.
    """
    beside = np.empty((2, 6, *x.shape))
    beside[0], beside[1] = x, y
    beside[0, 1] += step
    beside[0, 2] -= step
    beside[1, 3] += step
    beside[1, 4] -= step
    beside[:, 5] += step
    return beside[0], beside[1]


def _at_stop(lens: Lens, enter: Entrance, points: Point, part: float = 1.0) -> Beam:
    """Return the rays through points of the entrance-pupil plane where they meet the stop."""
    rays = start(_through(enter, *points, enter.slope * part))
    return run(lens, rays, enter.index, last=int(np.max(enter.stop.surface)))


def _newton_step(beam: Beam, miss: Point, step: float) -> tuple[np.ndarray, np.ndarray, Slopes, np.ndarray]:
    """Return Newton's step from the landing points of a ray and its neighbours, and ((a, b), (c, d)) of `_Aim` there.

    Then whether a small step leads to a ray of the pupil: a gain that is not positive belongs to another sheet, where
    rays have crossed, and one that changes steeply to a ray that grazes a surface.

    Second derivatives carry these along the step: those at the guess would make launch weights depend on what was
    guessed, and so on how many rays are asked for together.
    """
    (a, b, along_x), (c, d, along_y) = (_derivatives(landed, step) for landed in (beam.x, beam.y))
    area: np.ndarray = a * d - b * c
    with np.errstate(invalid="ignore", divide="ignore"):
        move_x, move_y = (d * miss[0] - b * miss[1]) / area, (a * miss[1] - c * miss[0]) / area
        more = [second[0] * move_x + second[1] * move_y for second in (*along_x, *along_y)]
    a, b, c, d = a + more[0], b + more[1], c + more[2], d + more[3]
    change = np.abs(a * d - b * c - area) * step
    return move_x, move_y, (a, b, c, d), (area > 0) & (change <= MOST_CHANGE * area * np.hypot(move_x, move_y))


def _derivatives(landed: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray, tuple[Point, Point]]:
    """Return the derivatives in x and in y from values at the points of `_beside`, and the derivatives of each."""
    here, right, left, up, down, corner = landed
    by_x, by_y, square = (right - left) / (2 * step), (up - down) / (2 * step), step * step
    xx, yy, xy = (
        (right + left - 2 * here) / square,
        (up + down - 2 * here) / square,
        (corner - right - up + here) / square,
    )
    return by_x, by_y, ((xx, xy), (xy, yy))


def _guess(lens: Lens, source: Source | Sources, enter: Entrance, stop: Stop | None, xi: Nodes, eta: Nodes) -> Point:
    """Return entrance points from which Newton's method starts: by a pupil map, or for few rays by first order."""
    chief = _known_chief(lens, source, stop)
    known = stop is None and isinstance(source, Source)
    fine = _guessing_map(lens, source) if known and xi.size >= VERY_MANY else None
    if fine is not None:
        x, y, _ = fine.at(xi, eta)
        return x, y
    if xi.size >= FEW:
        found = _cached_rough_map(lens, source) if known else _rough_map(lens, enter, chief)
        if found is not None:
            x, y = np.moveaxis(found.at(xi, eta), -2, 0)
            return x, y
    return _first_order_points(enter, chief, xi, eta)


def _first_order_points(enter: Entrance, chief: "_Aim | None", xi: Nodes, eta: Nodes) -> Point:
    """Return points of the paraxial entrance pupil, without symmetry those about the chief ray."""
    return _paraxial(enter, xi, eta) if chief is None else _about_chief(chief, _stop_points(enter, xi, eta))


def _paraxial(enter: Entrance, xi: Nodes, eta: Nodes) -> Point:
    """Return points of the paraxial entrance pupil, of every source: (…, ray)."""
    x, y, *_ = np.broadcast_arrays(enter.radius * xi, enter.radius * eta, enter.slope, enter.reach)
    return x, y


@lru_cache(maxsize=64)
def _cached_rough_map(lens: Lens, source: Source) -> DiscFunction | None:
    """Return the rough map of a source: by those of a few fields near it, else, where one of these loses rays, its own.

    Which of the two never depends on what was asked before, so neither does a result. Rays of five fields are traced
    together for two thirds more time than those of one, and serve a field that moves. Where first order does not tell
    where chief rays enter, a search for five of them would cost more than they save.
    """
    angle, chief = float(degrees_from_slope(source.field_slope)), _known_chief(lens, source, None)
    known = _maps_over_field(lens, source.depth_mm, source.wavelength_um, angle // PANEL_DEG) if chief is None else None
    if known is None:
        return _rough_map(lens, entrance(lens, source), chief)
    powers = (2 * (angle % PANEL_DEG) / PANEL_DEG - 1) ** np.arange(FIELDS.size)
    return replace(known, values=np.tensordot(powers, known.values, 1))


@lru_cache(maxsize=64)
def _maps_over_field(lens: Lens, depth_mm: float, wavelength_um: float, panel: float) -> DiscFunction | None:
    """Return the rough maps in powers of the place in a panel of fields, of an aligned lens, values (powers, 2, nodes).

    None where one of the fields loses rays.
    """
    slopes = slope_from_degrees(PANEL_DEG * (panel + (1 + FIELDS) / 2))
    found = _rough_map(lens, entrance(lens, Sources(depth_mm, slopes, wavelength_um)), None, each=True)
    if found is None:
        return None
    rows = np.vander(FIELDS, increasing=True)
    return replace(found, values=np.tensordot(np.linalg.inv(rows), found.values, 1))


@lru_cache(maxsize=16)
def _map_with_launch(lens: Lens, source: Source) -> DiscFunction | None:
    """Return the rough map, with launch weights by its own areas."""
    found = _cached_rough_map(lens, source)
    return None if found is None else _with_launch(entrance(lens, source), found)


def _rough_map(lens: Lens, enter: Entrance, chief: "_Aim | None", each: bool = False) -> DiscFunction | None:
    """Return the entrance points x and y over the stop, confirmed by no ray; None if rays are lost.

    Rays through first-order points land on the stop at scattered points; a least-squares fit over those gives the map
    from the stop back to the pupil without a search. Of several sources, those that lose a ray keep the paraxial map,
    unless ``each`` has to have its own.
    """
    domain, rim = lens.pupil_domain, float(np.max(enter.stop.semi_diameter))
    nodes, terms, at_nodes = _rough_terms(domain)
    points = _first_order_points(enter, chief, nodes.xi, nodes.eta)
    beam = _at_stop(lens, enter, points)
    scale = enter.upright / rim
    landed = scale * beam.x, scale * beam.y
    if beam.status.any():
        met = np.isfinite(beam.x + beam.y).all(-1, keepdims=True)
        if not (met.all() if each else met.any()):
            return None
        landed = np.where(met, landed[0], nodes.xi), np.where(met, landed[1], nodes.eta)
    kinds = basis_by_powers(ROUGH_ORDER, *landed)  # even, odd
    x, y = (
        _least_squares(of.of(kinds), values) @ there for of, values, there in zip(terms, points, at_nodes, strict=True)
    )
    return _map_of(x, y, ROUGH_NODES, domain)


@lru_cache(maxsize=4)
def _rough_terms(domain: PupilDomain) -> tuple[ClearNodes, tuple[Terms, Terms], Point]:
    """Return the nodes of rough maps, and the terms of x, odd in ξ by symmetry, and of y, with their values there."""
    nodes = domain.nodes(ROUGH_NODES)
    of_x, of_y = (Terms(ROUGH_ORDER, domain.parities(odd)) for odd in (True, False))
    return nodes, (of_x, of_y), (of_x.values(nodes.xi, nodes.eta), of_y.values(nodes.xi, nodes.eta))


def _map_of(x: np.ndarray, y: np.ndarray, counts: Counts, domain: PupilDomain) -> DiscFunction:
    """Return the map through entrance points at the nodes of counts, each (…, nodes)."""
    return DiscFunction(np.stack([x, y], -2), counts, (True, False), domain)


def _with_launch(enter: Entrance, found: DiscFunction) -> DiscFunction:
    """Return a map of one source, with launch weights by its own areas as a third function."""
    (x_xi, y_xi), (x_eta, y_eta) = found.gradient()
    launch = (x_xi * y_eta - x_eta * y_xi) / enter.radius**2 * _solid_angle(enter, *found.values)
    return replace(found, values=np.append(found.values, launch[None], axis=0), odd=(*found.odd, False))


@lru_cache(maxsize=64)
def _stop_map(lens: Lens, source: Source, aim_error: float) -> DiscFunction | None:
    """Return the map through aimed rays that stands for aiming itself; None where rays on the rim disprove it."""
    for counts in FINE:
        found, off, off_weight = _map_through_rays(lens, source, counts)
        if off <= aim_error and off_weight <= WEIGHT_ERROR:
            return found
        if not off <= NEARLY:
            break
    return None


@lru_cache(maxsize=16)
def _guessing_map(lens: Lens, source: Source) -> DiscFunction | None:
    """Return a map through aimed rays, close enough for one step of Newton's method; None where rays are lost."""
    return _map_through_rays(lens, source, GUESS)[0]


def _map_through_rays(lens: Lens, source: Source, counts: Counts) -> tuple[DiscFunction | None, float, float]:
    """Return a map, and how far points, in radii, and weights are off on the rim; None where rays are lost."""
    domain, enter, turn = lens.pupil_domain, entrance(lens, source), np.linspace(0, np.pi, RIM_RAYS)
    nodes, held = domain.nodes(counts), domain.points(np.sin(turn), np.cos(turn))
    rays = _aim(lens, source, enter, None, np.append(nodes.xi, held[0]), np.append(nodes.eta, held[1]), AIM_ERROR)
    if not np.isfinite(rays.x).all():
        return None, inf, inf
    count = nodes.xi.size
    found = _with_launch(enter, _map_of(rays.x[:count], rays.y[:count], counts, domain))
    return found, *_errors_on_rim(found.at(*held), (rays.x, rays.y, np.asarray(rays.launch)), enter)


def _errors_on_rim(
    mapped: np.ndarray, true: tuple[np.ndarray, np.ndarray, np.ndarray], enter: Entrance
) -> tuple[float, float]:
    """Return the largest errors of points, in radii, and of weights by a map at the last of the rays."""
    off_x, off_y, off = (one - column[-one.size :] for one, column in zip(mapped, true, strict=True))
    return float(np.hypot(off_x, off_y).max()) / enter.radius.item(), float(np.abs(off).max())


def _least_squares(rows: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the solutions (…, rows) by the normal equations, which lose digits that a guess does not need."""
    normal = rows @ rows.swapaxes(-1, -2)
    np.einsum("...ii->...i", normal)[...] *= 1 + RIDGE  # a view of the diagonal
    solution: np.ndarray = np.linalg.solve(normal, rows @ values[..., None])[..., 0]
    return solution


# Without symmetry. What is known of the pupil before rays are traced is that of the aligned lens, which may be far
# from where light enters; so all starts at the chief ray, which a search finds if it must.


def chief_rays(lens: Lens, source: Source | Sources, stop: Stop | None = None) -> PupilRays | None:
    """Return the chief rays of a misaligned lens, (…, 1), found to `CHIEF_AIM_ERROR`; NaN where there is none.

    None for another lens: there first order tells where rays enter.
    """
    chief = _known_chief(lens, source, stop)
    if chief is None:
        return None
    _check_aim(lens)
    enter = entrance(lens, source, stop)
    return replace(_through(enter, chief.x, chief.y), stop_surface=int(np.max(enter.stop.surface)))


def _known_chief(lens: Lens, source: Source | Sources, stop: Stop | None) -> _Aim | None:
    """Return how the chief ray, which goes through the stop's centre, enters, (…, 1), NaN if not found.

    Others are looked for from there; None where first order tells where they enter.
    """
    if not lens.misaligned:
        return None
    if stop is None and isinstance(source, Source):
        return _cached_chief_aim(lens, source)
    return _find_chief_aim(lens, entrance(lens, source, stop))


@lru_cache(maxsize=64)
def _cached_chief_aim(lens: Lens, source: Source) -> _Aim:
    return _find_chief_aim(lens, entrance(lens, source))


def _find_chief_aim(lens: Lens, enter: Entrance) -> _Aim:
    centre = np.zeros(1), np.zeros(1)
    guess, enough = _paraxial(enter, *centre), _move_mm(enter, CHIEF_AIM_ERROR)
    found = _newton(lens, enter, centre, guess, enough)
    if found.missed.any():
        found = _newton(lens, enter, centre, _nearest(lens, enter), enough)
    found.x[found.missed] = found.y[found.missed] = np.nan
    return found


def _nearest(lens: Lens, enter: Entrance) -> Point:
    """Return the entrance points, of a square of them, whose rays meet the stop closest to its centre."""
    line = np.linspace(-SEARCH_RADII, SEARCH_RADII, SEARCH_POINTS)
    x, y = _paraxial(enter, *(part.ravel() for part in np.meshgrid(line, line)))
    beam = _at_stop(lens, enter, (x, y))
    away = np.hypot(beam.x, beam.y)
    best = np.where(np.isfinite(away), away, np.inf).argmin(-1)[..., None]
    return np.take_along_axis(x, best, -1), np.take_along_axis(y, best, -1)


def _about_chief(chief: _Aim, goal: Point) -> Point:
    """Return entrance points of rays that meet the stop at ``goal``, to first order about the chief ray."""
    area = chief.a * chief.d - chief.b * chief.c
    x: np.ndarray = chief.x + (chief.d * goal[0] - chief.b * goal[1]) / area
    y: np.ndarray = chief.y + (chief.a * goal[1] - chief.c * goal[0]) / area
    return x, y


def _aim_outwards(lens: Lens, enter: Entrance, goal: Point, chief: _Aim, found: _Aim) -> _Aim:
    """Return ``found`` with the rays that missed aimed anew, from the chief ray outwards."""
    lost = np.flatnonzero(found.missed.any(tuple(range(found.missed.ndim - 1))))
    some = goal[0][..., lost], goal[1][..., lost]
    guess = _about_chief(chief, (CONTINUATION[0] * some[0], CONTINUATION[0] * some[1]))
    for part, following in zip(CONTINUATION, (*CONTINUATION[1:], 1.0), strict=True):
        again = _newton(lens, enter, (part * some[0], part * some[1]), guess, _move_mm(enter, AIM_ERROR))
        guess = tuple(
            at + (found_at - at) * (following / part)
            for at, found_at in zip((chief.x, chief.y), (again.x, again.y), strict=True)
        )
    better = found.missed[..., lost] & ~again.missed
    for old, new in zip(vars(found).values(), vars(again).values(), strict=True):
        old[..., lost] = np.where(better, new, old[..., lost])
    return found
