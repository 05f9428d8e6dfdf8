"""Light in space: rays, the wavefront behind the lens, the PSF as a surface. No Qt and no pyvista in here."""

from dataclasses import dataclass
from functools import lru_cache
from math import isfinite

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import seen_from
from p2sf.lens.placement import Placement
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.result import Psf
from p2sf.raytrace.pencil import Rays, exit_radius, opd_on_sphere, pencil, pupil_rays, to_the_rim, trace
from p2sf_explorer.compute.layout import Drawing
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.scene3d.meshes import Mesh, grid_faces
from p2sf_explorer.state.scales import nice

RINGS = 2  # of rays in the bundle, 19 in all
FRONT = (10, 48)  # rings and directions of the wavefront
SAMPLES = 64  # across the PSF surface
BEFORE = 0.45  # of the drawing's length, before the lens: where rays from a far object begin
DEPTH, RIM = 0.3, 0.96  # of the wavefront's radius: its exaggerated depth; of the way to the last surface: its radius
SHORTEST = 0.05  # least radius, of the drawing's half height
SPREAD, HEIGHT = 0.9, 0.6  # width of the PSF surface over half the sensor, its height over its width


@dataclass(frozen=True)
class Front:
    """The wavefront's surface, W in waves at its points, and the factor by which W is exaggerated along the rays."""

    mesh: Mesh
    waves: np.ndarray
    factor: float


@dataclass(frozen=True)
class PsfSurface:
    """The PSF as a surface on the sensor, brightness 0 to 1 at its points, and the magnification of its width."""

    mesh: Mesh
    values: np.ndarray
    factor: float


def ray_bundle(setup: ParaxialSetup, drawn: Drawing, clip: bool = False) -> np.ndarray:
    """Return the source's rays, (ray, place, 3) mm, the chief ray first: origin, every surface, sensor.

    A lost ray stays where it last was, with ``clip`` on the surface whose rim stops it. Raises GeometryError.
    """
    xi, eta = to_the_rim(RINGS)
    azimuth = setup.source.azimuth_deg
    lens = seen_from(setup.lens, azimuth)
    rays = pupil_rays(lens, setup.source, xi, eta)
    before = min(setup.source.depth_mm, BEFORE * (drawn.right - drawn.left) - drawn.left)
    origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
    starts = origins - directions * ((origins[..., 2:] + before) / directions[..., 2:])
    points = trace(lens, starts, directions, setup.source.wavelength_um).points
    ended = pencil(setup.lens, setup.source, xi, eta, clip).failed_surface
    for number in range(1, len(points)):
        behind = (ended > 0) & (number > ended)
        points[number] = np.where(behind[:, None] | np.isnan(points[number]), points[number - 1], points[number])
    if azimuth:
        points = points @ Placement(tilt_z_deg=-azimuth).motion.rotation.T
    return points.swapaxes(0, 1)


def front(setup: ParaxialSetup, drawn: Drawing, last_z: float) -> Front:
    """Return the wavefront behind the lens: the sphere about the image point, W·λ·factor ahead of it along the rays.

    A positive W is a shorter path, so the light is ahead. ``last_z``: the end of the last surface, mm; the wavefront is
    drawn at the exit pupil, or behind the lens where the pupil lies inside. Coefficients altered by hand have no rays:
    W is then that of the six coefficients. Raises GeometryError.
    """
    rays = pencil(setup.lens, setup.source, *_polar())
    exact = None if setup.altered else opd_on_sphere(rays, exit_radius(setup.lens, setup.source, rays, setup.stop))
    waves = np.asarray(wavefront(setup.coefficients, *_polar())) if exact is None else np.nan_to_num(exact)
    kx, ky, kz = (np.where(rays.passed, k, chief) for k, chief in _cosines(rays))
    radius = _drawn_radius(setup, drawn, last_z, float(rays.chief_kz[0]))
    deepest = DEPTH * radius * float(np.hypot(kx, ky - rays.chief_ky).max())
    wave_mm = setup.source.wavelength_um / UM_PER_MM
    factor = _round_down(deepest / max(float(np.ptp(waves)) * wave_mm, 1e-9)) if deepest else 1.0  # 0: no ray passes
    along = (radius - factor * wave_mm * waves)[:, None]
    image = np.array([0.0, 0.0, drawn.sensor_z])
    along *= setup.lens.directions[-1]  # cosines of light that runs to the left are those of its way back
    return Front(Mesh(image - along * np.stack([kx, ky, kz], -1), grid_faces(*FRONT_GRID)), waves, factor)


FRONT_GRID = FRONT[0] + 1, FRONT[1] + 1


@lru_cache(maxsize=1)
def _polar() -> tuple[np.ndarray, np.ndarray]:
    radius, turn = np.linspace(0, 1, FRONT_GRID[0])[:, None], np.linspace(0, 2 * np.pi, FRONT_GRID[1])
    return (radius * np.sin(turn)).ravel(), (radius * np.cos(turn)).ravel()


def _cosines(rays: Rays) -> tuple[tuple[np.ndarray, float], ...]:
    """Return the direction cosines in the image of the rays and of the chief ray."""
    return (rays.kx, float(np.squeeze(rays.chief_kx))), (rays.ky, rays.chief_ky[0]), (rays.kz, rays.chief_kz[0])


def _drawn_radius(setup: ParaxialSetup, drawn: Drawing, last_z: float, chief_kz: float) -> float:
    """Return the radius with which the wavefront is drawn, mm: to the exit pupil, or to just behind the lens.

    Where the sensor touches the last glass or lies in it, to just before the image.
    """
    forward = setup.lens.directions[-1]
    longest = max(RIM * forward * (drawn.sensor_z - last_z), SHORTEST * drawn.half_height) / chief_kz
    pupil = forward * (setup.lens.sensor_mm - float(setup.pupils.exit_from_last)) / chief_kz
    return min(longest, pupil) if isfinite(pupil) and pupil > 0 else longest


def psf_surface(psf: Psf, brightness: np.ndarray, drawn: Drawing, sensor_half: float, forward: int) -> PsfSurface:
    """Return the PSF as a surface that rises from the sensor towards the lens about the chief ray's point.

    ``brightness``: of the PSF's samples, 0 to 1, (y, x); ``forward``: 1 where light meets the sensor from the left,
    else −1.
    """
    count = brightness.shape[0]
    width = count * psf.pixel_um / UM_PER_MM
    factor = _round_down(SPREAD * sensor_half / width)
    weight = _resampling(count)
    values = np.clip(weight @ brightness @ weight.T, 0.0, 1.0)
    axis = (np.arange(SAMPLES) - SAMPLES // 2) * (width * factor / SAMPLES)
    x, y = np.meshgrid(axis, axis)
    z = drawn.sensor_z - forward * (HEIGHT * width * factor * values + 2e-3 * sensor_half)
    return PsfSurface(
        Mesh(np.stack([x, y, z], -1).reshape(-1, 3), grid_faces(SAMPLES, SAMPLES)), values.ravel(), factor
    )


@lru_cache(maxsize=16)
def _resampling(count: int) -> np.ndarray:
    """Return the linear map (SAMPLES, count) that keeps sample N/2 in its place, and averages where there are more."""
    wide = max(1.0, count / SAMPLES)
    at = (np.arange(SAMPLES) - SAMPLES // 2) * (count / SAMPLES) + count // 2
    weight = np.maximum(0.0, 1 - np.abs(at[:, None] - np.arange(count)) / wide)
    return weight / weight.sum(axis=1, keepdims=True)


def _round_down(value: float) -> float:
    """Return the largest of 1, 2 or 5 times a power of ten that does not exceed a value."""
    return 1 / nice(1 / value)
