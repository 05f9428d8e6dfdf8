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
from p2sf.raytrace.surface import Beam, Status
from p2sf.raytrace.trace import Index, launch, per_ray, run

AIM_STEPS = 12
AIM_RESIDUAL = 1e-11  # of the stop's rim: the path error is its square, far below any wavelength
AIM_ACCEPTED = 1e-9  # of the rim: the rounding left where the search cannot reach the residual
CONTINUATION = (0.2, 0.4, 0.6, 0.8, 1.0)

Point: TypeAlias = tuple[np.ndarray, np.ndarray]  # x and y, mm


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
    ``stop_surface``: the stop at which rays were aimed, 0 if they were not; a ray that could not be aimed is NaN.
    """

    x: np.ndarray
    y: np.ndarray
    slope_x: np.ndarray
    slope_y: np.ndarray
    path: np.ndarray
    plane: np.ndarray
    index: Index
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
    chief ray, ``exit_plane`` mm from the last vertex, ``index`` per medium, object space first.
    """

    plane: np.ndarray
    radius: np.ndarray
    reach: np.ndarray
    slope: np.ndarray
    exit_plane: np.ndarray
    index: Index
    stop: Stop


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
    return Entrance(plane, radius, reach, slope, exit_plane, index, stop)


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
    return _aimed(lens, enter, xi, eta)


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


def _aimed(lens: Lens, enter: Entrance, xi: np.ndarray, eta: np.ndarray) -> PupilRays:
    """Solve for entrance points whose real rays meet the stop at (ξ, η) of its rim; wide fields by continuation."""
    rim, surface = float(np.max(enter.stop.semi_diameter)), int(np.max(enter.stop.surface))
    # A ray close to the axis tells whether the entrance pupil is an upright or an inverted image of the stop.
    thin = run(lens, start(_through(enter, 0 * xi, 0 * xi + 1e-6 * enter.radius, 0.0)), enter.index, last=surface)
    goal = rim * np.sign(thin.y) * xi, rim * np.sign(thin.y) * eta
    guess = enter.radius * xi + 0 * enter.slope, enter.radius * eta + 0 * enter.slope
    (x, y), missed = _newton(lens, enter, goal, guess, 1.0)
    if missed.any():
        for part in CONTINUATION:
            guess, still = _newton(lens, enter, goal, guess, part)
        x, y = np.where(missed, guess[0], x), np.where(missed, guess[1], y)
        missed &= still
    aimed = _through(enter, np.where(missed, np.nan, x), np.where(missed, np.nan, y))
    return replace(aimed, stop_surface=surface)


def _newton(lens: Lens, enter: Entrance, goal: Point, guess: Point, part: float) -> tuple[Point, np.ndarray]:
    """Return the entrance points whose rays, at this part of the field slope, meet the stop at ``goal``.

    The second result flags the rays that miss the goal by more than AIM_ACCEPTED of the rim.
    """
    rim, surface = float(np.max(enter.stop.semi_diameter)), int(np.max(enter.stop.surface))
    step = 1e-5 * float(np.max(enter.radius))
    x, y = guess
    for _ in range(AIM_STEPS):
        trial = _through(enter, np.stack([x, x + step, x]), np.stack([y, y, y + step]), enter.slope * part)
        beam = run(lens, start(trial), enter.index, last=surface)
        miss = goal[0] - beam.x[0], goal[1] - beam.y[0]
        far = np.hypot(*miss)
        if not np.nanmax(far, initial=0.0) > AIM_RESIDUAL * rim:
            break
        move_x, move_y = _newton_step(beam, miss, step)
        x, y = x + move_x, y + move_y
    return (x, y), ~(far <= AIM_ACCEPTED * rim)


def _newton_step(beam: Beam, miss: Point, step: float) -> Point:
    """Return Newton's step from the landing points of a ray and its two neighbours ``step`` mm away."""
    a, c = (beam.x[1] - beam.x[0]) / step, (beam.y[1] - beam.y[0]) / step
    b, d = (beam.x[2] - beam.x[0]) / step, (beam.y[2] - beam.y[0]) / step
    with np.errstate(invalid="ignore", divide="ignore"):
        return (d * miss[0] - b * miss[1]) / (a * d - b * c), (a * miss[1] - c * miss[0]) / (a * d - b * c)
