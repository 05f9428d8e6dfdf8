"""Rays as they enter: through the paraxial entrance pupil, or aimed so that the real stop is filled."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from p2sf.conventions import vergence
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, indices
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import check_depth
from p2sf.paraxial.pupils import Stop, find_stop, pupils
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import launch, per_ray, run

AIM_STEPS = 12
AIM_RESIDUAL = 1e-11  # of the stop's rim: the path error is its square, far below any wave
AIM_ACCEPTED = 1e-9  # of the rim: what rounding leaves where the search cannot reach the residual
CONTINUATION = (0.2, 0.4, 0.6, 0.8, 1.0)


@dataclass(frozen=True)
class PupilRays:
    """Rays where they cross the plane of the paraxial entrance pupil.

    ``x``, ``y``: (…, ray) mm in that plane, which lies ``plane`` mm behind the first vertex. ``slope_x``, ``slope_y``:
    dx/dz, dy/dz. ``path``: optical path from the source, mm, less that to the pupil's centre; from
    infinity, from the plane wavefront through that centre. ``index``: per surface, object space first.
    ``stop_surface``: the stop at which rays were aimed, 0 where they were not; one that no search brought there is NaN.
    """

    x: np.ndarray
    y: np.ndarray
    slope_x: np.ndarray
    slope_y: np.ndarray
    path: np.ndarray
    plane: np.ndarray
    index: list
    stop_surface: int = 0

    @property
    def origins(self) -> np.ndarray:
        """Return points (…, ray, 3) on the rays, mm from the first vertex."""
        return np.stack(np.broadcast_arrays(self.x, self.y, self.plane), -1)

    @property
    def directions(self) -> np.ndarray:
        """Return unit vectors (…, ray, 3) along the rays."""
        slopes = np.stack(np.broadcast_arrays(self.slope_x, self.slope_y, 1.0), -1)
        return slopes / np.linalg.norm(slopes, axis=-1, keepdims=True)


@dataclass(frozen=True)
class Entrance:
    """What the first order says about how light enters, every array with a trailing ray axis of one.

    ``plane`` mm from the first vertex, ``radius`` mm, ``reach`` = 1/(object to entrance pupil) per mm, ``slope`` of the
    chief ray, ``exit_plane`` mm from the last vertex, ``index`` per surface.
    """

    plane: np.ndarray
    radius: np.ndarray
    reach: np.ndarray
    slope: np.ndarray
    exit_plane: np.ndarray
    index: list
    stop: Stop


def entrance(lens: Lens, source: Source, stop: Stop | None = None) -> Entrance:
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
    return Entrance(*(value[..., None] for value in values), index, stop)


def _first_order(lens: Lens, wavelength_um, stop: Stop | None):
    """Return pupils, indices per surface and the stop; remembered while only field and depth are dragged."""
    if stop is None and np.ndim(wavelength_um) == 0:
        return _remembered(lens, float(wavelength_um))
    stop = stop or find_stop(lens)
    return pupils(lens, wavelength_um, stop), per_ray(indices(lens, wavelength_um)), stop


@lru_cache(maxsize=256)
def _remembered(lens: Lens, wavelength_um: float):
    return _first_order(lens, wavelength_um, find_stop(lens))


def pupil_rays(lens: Lens, source: Source, xi, eta, aim: str = "paraxial", stop: Stop | None = None) -> PupilRays:
    """Return the rays of a source through points (ξ, η) of the pupil, each (ray,), unit radius.

    ``aim="paraxial"`` fills the paraxial entrance pupil; ``aim="real"`` sends every ray through (ξ, η) of the stop.
    Fields of ``source`` may be arrays that broadcast; they come first. Raises GeometryError, GlassError.
    """
    enter = entrance(lens, source, stop)
    xi, eta = np.asarray(xi, dtype=float), np.asarray(eta, dtype=float)
    if aim == "paraxial":
        return _through(enter, enter.radius * xi, enter.radius * eta)
    if aim != "real":
        raise GeometryError('aim "{aim}" is unknown; choose "paraxial" or "real"', aim=aim)
    return _aimed(lens, enter, xi, eta)


def _through(enter: Entrance, x, y, slope=None) -> PupilRays:
    """Return the source's rays through points of the entrance-pupil plane.

    The path difference D·√(…) − D·√(1 + s²) is written with 1/D and without subtracting, so that an object at
    10⁶ m, or at infinity, costs no digit.
    """
    s = enter.slope if slope is None else slope
    slope_x, slope_y = enter.reach * x, enter.reach * y + s
    length = np.sqrt(1 + slope_x * slope_x + slope_y * slope_y) + np.sqrt(1 + s * s)
    path = enter.index[0] * (enter.reach * (x * x + y * y) + 2 * s * y) / length
    return PupilRays(x, y, slope_x, slope_y, path, enter.plane, enter.index)


def start(rays: PupilRays):
    """Return a fresh beam of these rays, positions from the first vertex."""
    scale = 1 / np.sqrt(1 + rays.slope_x * rays.slope_x + rays.slope_y * rays.slope_y)
    beam = launch(rays.x, rays.y, rays.plane, rays.slope_x * scale, rays.slope_y * scale, scale, rays.index[0])
    if rays.stop_surface:
        beam.fail(np.isnan(beam.x), Status.UNAIMED, rays.stop_surface)
    return beam


def _aimed(lens: Lens, enter: Entrance, xi, eta) -> PupilRays:
    """Solve for entrance points whose real rays meet the stop at (ξ, η) of its rim; wide fields by continuation."""
    rim, surface = float(np.max(enter.stop.semi_diameter)), int(np.max(enter.stop.surface))
    # The stop is upright or upside down in the entrance pupil: a paraxially thin ray tells.
    thin = run(lens, start(_through(enter, 0 * xi, 0 * xi + 1e-6 * enter.radius, 0.0)), enter.index, last=surface)
    goal = rim * np.sign(thin.y) * xi, rim * np.sign(thin.y) * eta
    guess = enter.radius * xi + 0 * enter.slope, enter.radius * eta + 0 * enter.slope
    found, missed = _newton(lens, enter, goal, guess, 1.0)
    if missed.any():
        for part in CONTINUATION:
            guess, still = _newton(lens, enter, goal, guess, part)
        found = [np.where(missed, late, early) for late, early in zip(guess, found, strict=True)]
        missed &= still
    aimed = _through(enter, *(np.where(missed, np.nan, part) for part in found))
    return replace(aimed, stop_surface=surface)


def _newton(lens: Lens, enter: Entrance, goal, guess, part: float):
    """Return entrance points (x, y), mm, whose rays at this part of the field slope meet the stop at ``goal``.

    Beside them, which rays do not come to within AIM_ACCEPTED of the rim.
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
        x, y = (now + move for now, move in zip((x, y), _move(beam, miss, step), strict=True))
    return (x, y), ~(far <= AIM_ACCEPTED * rim)


def _move(beam, miss, step: float):
    """Return Newton's step (x, y), mm, from the landing points of a ray and its two neighbours ``step`` away."""
    a, c = (beam.x[1] - beam.x[0]) / step, (beam.y[1] - beam.y[0]) / step
    b, d = (beam.x[2] - beam.x[0]) / step, (beam.y[2] - beam.y[0]) / step
    with np.errstate(invalid="ignore", divide="ignore"):
        return (d * miss[0] - b * miss[1]) / (a * d - b * c), (a * miss[1] - c * miss[0]) / (a * d - b * c)
