"""The rays of a source as they enter: through the paraxial entrance pupil, or aimed to fill the real stop.

See handbook 8.2.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import FloatOrArray, vergence
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, indices
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import check_depth
from p2sf.paraxial.pupils import Pupils, Stop, find_stop, pupils
from p2sf.pupil.quadrature import disc_nodes
from p2sf.pupil.zernike import basis, basis_by_powers, columns, evaluate
from p2sf.raytrace.surface import Beam, Status
from p2sf.raytrace.trace import Index, launch, per_ray, run

AIM_STEPS = 12
AIM_MOVE = 1e-6  # of the pupil's radius: a last Newton step this small leaves its square, far below 1e-9 of the rim
DIFFERENCE = 1e-6  # of the pupil's radius: the determinant, and so the weight, is good to that
ROUNDING_STEP = 1e-8  # of the distances in the lens, for pupils so small that the step would meet their rounding
CONTINUATION = (0.2, 0.4, 0.6, 0.8, 1.0)
ROUGH_ORDER, ROUGH_NODES = 9, (6, 20)  # a guess to 1e-6 of the radius for most lenses, from 60 rays
FINE_ORDER, FINE_NODES = 15, (9, 34)
FINE_ERROR = 1e-10  # of the pupil's radius, on the rim: the most that an entrance point by the fine map may be off
FINE_WEIGHT_ERROR = 1e-5
RIM_RAYS = 9  # by which the fine map is judged
RIDGE = 1e-12  # added to the normal equations, so that they can be solved however the points lie
FEW = 24  # rays, below which a map costs more than the steps of Newton's method it saves
MANY = 512  # rays, from which on a fine map costs less than a step of Newton's method

Nodes: TypeAlias = np.ndarray  # (ray,)
Point: TypeAlias = tuple[np.ndarray, np.ndarray]  # x and y, mm
Form: TypeAlias = list[list[float]]  # a polynomial as `zernike.evaluate` takes it


@dataclass(frozen=True, eq=False)
class Sources:
    """Several point sources traced at once: a `Source` of arrays that broadcast, the leading axes of every result."""

    depth_mm: FloatOrArray
    field_slope: FloatOrArray
    wavelength_um: FloatOrArray


@dataclass(frozen=True)
class PupilRays:
    """Rays where they cross the plane of the paraxial entrance pupil.

    ``x``, ``y``: (…, ray) mm in that plane, which lies ``plane`` mm behind the first vertex. ``slope_x``, ``slope_y``:
    dx/dz, dy/dz. ``path``: optical path from the source, mm, less that to the pupil's centre; for a source at
    infinity, from the plane wavefront through that centre. ``index``: per medium, object space first.
    ``weight``: the light sent through unit area about (ξ, η), over that of the paraxial pupil's: the solid angle times
    the square of the distance, for a source at infinity an area; 1 for the paraxial pupil itself. ``stop_surface``: the
    stop at which rays were aimed, 0 if they were not; a ray that could not be aimed is NaN.
    """

    x: np.ndarray
    y: np.ndarray
    slope_x: np.ndarray
    slope_y: np.ndarray
    path: np.ndarray
    plane: np.ndarray
    index: Index
    weight: FloatOrArray = 1.0
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


@dataclass(frozen=True)
class Entrance:
    """The paraxial entrance pupil as a source sees it; every array ends in a ray axis of length one.

    ``plane`` mm from the first vertex, ``radius`` mm, ``reach`` = 1/(object to entrance pupil) per mm, ``slope`` of the
    chief ray, ``exit_plane`` mm from the last vertex, ``index`` per medium, object space first; ``upright`` is −1
    where the pupil is an inverted image of the stop, else 1.
    """

    plane: np.ndarray
    radius: np.ndarray
    reach: np.ndarray
    slope: np.ndarray
    exit_plane: np.ndarray
    index: Index
    stop: Stop
    upright: np.ndarray


def entrance(lens: Lens, source: Source | Sources, stop: Stop | None = None) -> Entrance:
    """Return the entrance pupil as the source sees it; GeometryError where it, or the cone of light, does not exist."""
    check_depth(source.depth_mm)
    pupil, index, stop = _first_order(lens, source.wavelength_um, stop)
    plane = np.asarray(pupil.entrance_from_first)
    if not np.isfinite(plane).all():
        raise GeometryError(
            "the entrance pupil is at infinity, so a field angle says nothing; move the stop off that focus"
        )
    nearness = vergence(source.depth_mm)
    gap = 1 + nearness * plane
    if np.any(gap == 0):
        raise GeometryError("the object lies in the entrance pupil, so no cone of light is defined; move the object")
    radius = np.asarray(pupil.entrance_diameter) / 2
    values = (plane, radius, nearness / gap, np.asarray(source.field_slope), np.asarray(pupil.exit_from_last))
    plane, radius, reach, slope, exit_plane = (value[..., None] for value in values)
    return Entrance(plane, radius, reach, slope, exit_plane, index, stop, np.asarray(pupil.upright)[..., None])


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
) -> PupilRays:
    """Return the rays of a source through points (ξ, η) of the pupil of unit radius, each (ray,).

    ``lens.aim`` "paraxial" fills the paraxial entrance pupil, "stop" sends every ray through (ξ, η) of the stop.
    The axes of `Sources` come first. Raises GeometryError, GlassError.
    """
    enter = entrance(lens, source, stop)
    xi, eta = np.asarray(xi, dtype=float), np.asarray(eta, dtype=float)
    if lens.aim == "paraxial":
        return _through(enter, enter.radius * xi, enter.radius * eta)
    found = _stop_map(lens, source) if stop is None and xi.size >= MANY and _single(enter) else None
    if found is None:
        return _aimed(lens, source, enter, stop, xi, eta)
    x, y, weight = found.at(xi, eta)
    return replace(_through(enter, x, y), weight=weight, stop_surface=int(np.max(enter.stop.surface)))


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
    return PupilRays(x, y, slope_x, slope_y, path, enter.plane, enter.index)


def start(rays: PupilRays) -> Beam:
    """Return a new beam of these rays, positions from the first vertex."""
    scale = 1 / np.sqrt(1 + rays.slope_x * rays.slope_x + rays.slope_y * rays.slope_y)
    beam = launch(rays.index[0], rays.x, rays.y, rays.plane, rays.slope_x * scale, rays.slope_y * scale, scale)
    if rays.stop_surface:
        beam.fail(np.isnan(beam.x), Status.UNAIMED, rays.stop_surface)
    return beam


def _aimed(
    lens: Lens, source: Source | Sources, enter: Entrance, stop: Stop | None, xi: Nodes, eta: Nodes
) -> PupilRays:
    """Solve for entrance points whose real rays meet the stop at (ξ, η) of its rim; wide fields by continuation."""
    rim = float(np.max(enter.stop.semi_diameter))
    goal = rim * enter.upright * xi, rim * enter.upright * eta
    found = _newton(lens, enter, goal, _guess(lens, source, enter, stop, xi, eta))
    if found.missed.any():
        found = _by_continuation(lens, enter, goal, _paraxial(enter, xi, eta), found)
        found.x[found.missed] = found.y[found.missed] = np.nan
    rays = _through(enter, found.x, found.y)
    area = (rim / enter.radius) ** 2 / found.gain
    # dΩ = dx dy·cosθ/distance², with 1/cosθ = √(1 + slope²), which is also the distance over that along the axis.
    oblique = (1 + enter.slope**2) / (1 + rays.slope_x * rays.slope_x + rays.slope_y * rays.slope_y)
    return replace(rays, weight=area * oblique**1.5, stop_surface=int(np.max(enter.stop.surface)))


@dataclass(frozen=True, eq=False)
class _Aim:
    """Entrance points (…, ray), mm; ``gain`` = ∂(stop point)/∂(entrance point); which rays ``missed`` their goal."""

    x: np.ndarray
    y: np.ndarray
    gain: np.ndarray
    missed: np.ndarray


def _newton(lens: Lens, enter: Entrance, goal: Point, guess: Point, part: float = 1.0, steps: int = AIM_STEPS) -> _Aim:
    """Return the entrance points whose rays, at this part of the field slope, meet the stop at ``goal``."""
    radius, step = float(np.max(enter.radius)), _difference_mm(enter)
    beam = _at_stop(lens, enter, _beside(*guess, step), part)
    move_x, move_y, gain = _newton_step(beam, (goal[0] - beam.x[0], goal[1] - beam.y[0]), step)
    far = np.hypot(move_x, move_y)
    # A gain that is not positive belongs to another sheet, where rays of the pupil have crossed.
    found = _Aim(guess[0] + move_x, guess[1] + move_y, gain, ~((far <= AIM_MOVE * radius) & (gain > 0)))
    again = (far > AIM_MOVE * radius).any(tuple(range(far.ndim - 1)))
    if steps > 1 and again.any():
        some = (goal[0][..., again], goal[1][..., again]), (found.x[..., again], found.y[..., again])
        better = _newton(lens, enter, *some, part, steps - 1)
        for column, new in zip(vars(found).values(), vars(better).values(), strict=True):
            column[..., again] = new
    return found


def _by_continuation(lens: Lens, enter: Entrance, goal: Point, start_at: Point, found: _Aim) -> _Aim:
    """Return ``found`` with the rays that missed aimed anew, by way of smaller fields."""
    lost = np.flatnonzero(found.missed.any(tuple(range(found.missed.ndim - 1))))
    some = goal[0][..., lost], goal[1][..., lost]
    guess = start_at[0][..., lost], start_at[1][..., lost]
    for part in CONTINUATION:
        again = _newton(lens, enter, some, guess, part)
        guess = again.x, again.y
    better = found.missed[..., lost] & ~again.missed
    for old, new in zip(vars(found).values(), vars(again).values(), strict=True):
        old[..., lost] = np.where(better, new, old[..., lost])
    return found


def _difference_mm(enter: Entrance) -> float:
    """Return the step of the differences: far above the rounding of positions, far below where the map bends."""
    return DIFFERENCE * float(np.max(enter.radius)) + ROUNDING_STEP * float(np.max(np.abs(enter.plane)))


def _beside(x: np.ndarray, y: np.ndarray, step: float) -> Point:
    """Return each point and its neighbours ``step`` mm away in x and in y, on a new first axis."""
    return np.stack([x, x + step, x]), np.stack([y, y, y + step])


def _at_stop(lens: Lens, enter: Entrance, points: Point, part: float = 1.0) -> Beam:
    """Return the rays through points of the entrance-pupil plane where they meet the stop."""
    rays = start(_through(enter, *points, enter.slope * part))
    return run(lens, rays, enter.index, last=int(np.max(enter.stop.surface)))


def _newton_step(beam: Beam, miss: Point, step: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return Newton's step from the landing points of a ray and its two neighbours, and the determinant there."""
    a, c = (beam.x[1] - beam.x[0]) / step, (beam.y[1] - beam.y[0]) / step
    b, d = (beam.x[2] - beam.x[0]) / step, (beam.y[2] - beam.y[0]) / step
    area: np.ndarray = a * d - b * c
    with np.errstate(invalid="ignore", divide="ignore"):
        return (d * miss[0] - b * miss[1]) / area, (a * miss[1] - c * miss[0]) / area, area


def _guess(lens: Lens, source: Source | Sources, enter: Entrance, stop: Stop | None, xi: Nodes, eta: Nodes) -> Point:
    """Return entrance points from which Newton's method starts: by the pupil map, or for few rays the paraxial ones."""
    if xi.size < FEW or not _single(enter):
        return _paraxial(enter, xi, eta)
    form = _rough_map(lens, enter) if stop else _cached_rough_map(lens, source)
    if form is None:
        return _paraxial(enter, xi, eta)
    square = xi * xi
    return xi * evaluate(form[0], square, eta), evaluate(form[1], square, eta)


def _paraxial(enter: Entrance, xi: Nodes, eta: Nodes) -> Point:
    """Return points of the paraxial entrance pupil, of every source: (…, ray)."""
    x, y, *_ = np.broadcast_arrays(enter.radius * xi, enter.radius * eta, enter.slope, enter.reach)
    return x, y


@lru_cache(maxsize=64)
def _cached_rough_map(lens: Lens, source: Source) -> tuple[Form, Form] | None:
    return _rough_map(lens, entrance(lens, source))


def _rough_map(lens: Lens, enter: Entrance) -> tuple[Form, Form] | None:
    """Return entrance points x/ξ and y (mm) as polynomials of the stop point, for `evaluate`; None if rays are lost.

    Rays through the paraxial pupil land on the stop at scattered points; a least-squares fit over those gives the map
    from the stop back to the pupil without a search.
    """
    nodes, rim = disc_nodes(*ROUGH_NODES), float(np.max(enter.stop.semi_diameter))
    x, y = (float(enter.radius.item()) * v for v in (nodes.xi, nodes.eta))
    beam = _at_stop(lens, enter, (x, y))
    scale = float(enter.upright.item()) / rim
    if not np.isfinite(beam.x + beam.y).all():
        return None
    even, odd = basis_by_powers(ROUGH_ORDER, *(scale * v.ravel() for v in (beam.x, beam.y)))
    across, along = _least_squares(odd, x), _least_squares(even, y)
    return columns(across, ROUGH_ORDER, odd=True), columns(along, ROUGH_ORDER)


@dataclass(frozen=True)
class StopMap:
    """Polynomials over the stop: entrance points x/ξ and y (mm), and weights."""

    x: Form
    y: Form
    weight: Form

    def at(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return entrance points and weights at points of the stop."""
        square = xi * xi
        return xi * evaluate(self.x, square, eta), evaluate(self.y, square, eta), evaluate(self.weight, square, eta)


@lru_cache(maxsize=64)
def _stop_map(lens: Lens, source: Source) -> StopMap | None:
    """Return the map through aimed rays that stands for aiming itself; None where rays on the rim disprove it."""
    nodes, turn = disc_nodes(*FINE_NODES), np.linspace(0, np.pi, RIM_RAYS)
    held = np.sin(turn), np.cos(turn)
    rays = pupil_rays(lens, source, np.append(nodes.xi, held[0]), np.append(nodes.eta, held[1]))
    if not np.isfinite(rays.x).all():
        return None
    count, weights = nodes.xi.size, np.asarray(rays.weight)
    even, odd = _projections()
    found = StopMap(
        columns(odd @ rays.x[:count], FINE_ORDER, odd=True),
        columns(even @ rays.y[:count], FINE_ORDER),
        columns(even @ weights[:count], FINE_ORDER),
    )
    true = rays.x[count:], rays.y[count:], weights[count:]
    x, y, light = (mapped - traced for mapped, traced in zip(found.at(*held), true, strict=True))
    radius = float(entrance(lens, source).radius.item())
    exact = np.hypot(x, y).max() <= FINE_ERROR * radius and np.abs(light).max() <= FINE_WEIGHT_ERROR
    return found if exact else None


@lru_cache(maxsize=1)
def _projections() -> tuple[np.ndarray, np.ndarray]:
    """Return the matrices from values at the fine map's nodes to coefficients of the even and of the odd terms."""
    nodes = disc_nodes(*FINE_NODES)
    even, odd = (basis(FINE_ORDER, nodes.xi, nodes.eta, flag) * nodes.weight for flag in (False, True))
    return even, odd


def _least_squares(rows: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the solution by the normal equations, which lose digits that a guess does not need."""
    normal = rows @ rows.T
    normal[np.diag_indices_from(normal)] *= 1 + RIDGE
    return np.linalg.solve(normal, rows @ values)
