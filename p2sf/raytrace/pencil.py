"""The pencil of one source through the pupil by exact skew rays: path differences, spots and fans."""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import sqrt

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM, FloatOrArray, protected
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import Stop
from p2sf.raytrace.aiming import AIM_ERROR, PupilRays, Sources, arriving, entrance, pupil_rays
from p2sf.raytrace.chief_ray import check_chief_ray, chief_ray_error
from p2sf.raytrace.surface import Beam, Status
from p2sf.raytrace.trace import Trace, lens_rims, status_message, trace

__all__ = [
    "Pencil",
    "PupilRays",
    "Sources",
    "Status",
    "Trace",
    "diffraction_phase",
    "displayed_opd",
    "pupil_rays",
    "trace",
]

MEAN_ROUNDING = 1e-14  # of the largest term: some fifty roundings, all that a mean over symmetric rays consists of
WEIGHT_ROUNDING = 1e-6  # of the largest term: the weights of aimed rays are differences, good to that


@dataclass(frozen=True)
class Pencil:
    """The rays of one source at the sensor plane, all relative to its chief ray; leading axes first, (…, ray).

    ``weight``: the light of unit pupil area about each ray, as in `PupilRays`; means over the pupil divide by its sum.
    ``dx``, ``dy``: mm from the chief ray's sensor point. ``kx``, ``ky``, ``kz``: direction cosines in image space.
    ``path``: optical path to the sensor less the chief ray's, mm. ``status``, ``failed_surface``: as in `Trace`.
    Of the chief ray: ``chief_x``, ``chief_y`` mm on the sensor, ``chief_kx``, ``chief_ky``, ``chief_kz``. ``index``: of
    image space. Of a misaligned lens all are in the sensor's own axes, turned with the source's azimuth.
    """

    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    dx: np.ndarray
    dy: np.ndarray
    kx: np.ndarray
    ky: np.ndarray
    kz: np.ndarray
    path: np.ndarray
    status: np.ndarray
    failed_surface: np.ndarray
    chief_y: np.ndarray
    chief_ky: np.ndarray
    chief_kz: np.ndarray
    index: FloatOrArray
    wavelength_um: np.ndarray
    chief_x: FloatOrArray = 0.0
    chief_kx: FloatOrArray = 0.0

    @property
    def passed(self) -> np.ndarray:
        """Return which rays reach the sensor."""
        passed: np.ndarray = self.status == Status.PASSED
        return passed


@dataclass(frozen=True)
class Spot:
    """Where rays meet the sensor, µm from the chief ray; ``rms_um`` about the centroid of their light."""

    x_um: np.ndarray
    y_um: np.ndarray
    rms_um: np.ndarray
    centroid_y_um: np.ndarray
    centroid_x_um: FloatOrArray = 0.0


@dataclass(frozen=True)
class Fan:
    """A quantity along one line of the pupil: ``pupil`` −1…1, ``tangential`` along η, ``sagittal`` along ξ.

    The axes of `Sources` come first.
    """

    pupil: np.ndarray
    tangential: np.ndarray
    sagittal: np.ndarray
    unit: str


def pencil(
    lens: Lens,
    source: Source | Sources,
    xi: ArrayLike,
    eta: ArrayLike,
    clip: bool = False,
    stop: Stop | None = None,
    aim_error: float = AIM_ERROR,
) -> Pencil:
    """Trace a source's rays through pupil points (ξ, η), each (ray,), to the sensor.

    ``clip`` applies the clear semi-diameters of every surface but the stop, whose rim the pupil already represents.
    ``aim_error``: as `pupil_rays` has it.
    The axes of `Sources` come first. Raises GeometryError where the chief ray does not reach the sensor, and for a
    misaligned lens where it runs beyond the rim of a surface.
    """
    if lens.misaligned:
        lens = seen_from(lens, getattr(source, "azimuth_deg", 0.0))
        check_chief_ray(lens, source, stop)
    # The chief ray is traced as the last ray, together with the others.
    xi, eta = np.append(np.ravel(xi), 0.0), np.append(np.ravel(eta), 0.0)
    rims = lens_rims(lens, keep_stop=False) if clip else None
    beam, weight, index = arriving(lens, source, xi, eta, stop, rims, aim_error)
    if beam.status.any():
        _blank(beam, lens)
    rays = _relative_to_chief(beam, weight, xi, eta, index[-1], source.wavelength_um)
    return _beside_chief(rays, beam) if lens.misaligned else rays


def _beside_chief(rays: Pencil, beam: Beam) -> Pencil:
    """Return the pencil with x and its cosine from those of the chief ray, which need not lie in the plane x = 0."""
    chief_x, chief_kx = beam.x[..., -1:], beam.p[..., -1:] / rays.index
    return replace(rays, dx=rays.dx - chief_x, chief_x=chief_x, chief_kx=chief_kx)


def _relative_to_chief(
    beam: Beam,
    weight: FloatOrArray,
    xi: np.ndarray,
    eta: np.ndarray,
    index: FloatOrArray,
    wavelength_um: FloatOrArray,
) -> Pencil:
    """Return a beam at the sensor as differences from its last ray, the chief ray."""
    chief_y = beam.y[..., -1:]
    return Pencil(
        xi=xi[:-1],
        eta=eta[:-1],
        weight=np.broadcast_to(weight, beam.x.shape)[..., :-1],
        dx=beam.x[..., :-1],
        dy=beam.y[..., :-1] - chief_y,
        kx=beam.p[..., :-1] / index,
        ky=beam.q[..., :-1] / index,
        kz=beam.r[..., :-1] / index,
        path=beam.path[..., :-1] - beam.path[..., -1:],
        status=beam.status[..., :-1],
        failed_surface=beam.failed_surface[..., :-1],
        chief_y=chief_y,
        chief_ky=beam.q[..., -1:] / index,
        chief_kz=beam.r[..., -1:] / index,
        index=index,
        wavelength_um=np.asarray(wavelength_um)[..., None],
    )


def _blank(beam: Beam, lens: Lens) -> None:
    """Make failed rays NaN throughout, and refuse a pencil whose chief ray failed."""
    bad = beam.status != Status.PASSED
    if bad[..., -1].any():
        status, surface = (int(a[..., -1][bad[..., -1]].ravel()[0]) for a in (beam.status, beam.failed_surface))
        raise chief_ray_error(lens, status_message(status, surface), surface)
    for column in (beam.x, beam.y, beam.p, beam.q, beam.r, beam.path):
        column[bad] = np.nan


def diffraction_phase(rays: Pencil) -> np.ndarray:
    """Return w = (OPL ray − OPL chief − n'K·(I − C))/λ in waves, (…, ray): the phase over direction cosines (K)."""
    shift: np.ndarray = rays.kx * rays.dx
    shift += rays.ky * rays.dy
    shift *= rays.index
    phase: np.ndarray = (rays.path - shift) * (UM_PER_MM / rays.wavelength_um)
    return phase


def displayed_opd(
    lens: Lens,
    source: Source | Sources,
    xi: ArrayLike,
    eta: ArrayLike,
    stop: Stop | None = None,
) -> np.ndarray:
    """Return (OPL chief − OPL ray)/λ in waves at pupil points, on the sphere about the chief ray's sensor point.

    The sphere passes through the chief ray's point in the paraxial exit-pupil plane; for a telecentric lens it is a
    plane. NaN for failed rays. For display only; diffraction integrals use `diffraction_phase`.
    """
    rays = pencil(lens, source, xi, eta, stop=stop)
    return opd_on_sphere(rays, exit_radius(lens, source, rays, stop))


def opd_on_sphere(rays: Pencil, radius: FloatOrArray) -> np.ndarray:
    """Return the displayed OPD in waves for a reference sphere of signed radius (mm, positive before the sensor).

    The ray's path back from the sensor to the sphere is written as a difference from the chief ray's, so that no
    digits are lost at any radius: t − t_chief = −b − (b² − d²)/(R(1 + √(1 + (b² − d²)/R²))), b = K·(I − C),
    d = |I − C|. NaN for a ray that does not meet the sphere.
    """
    b = rays.kx * rays.dx + rays.ky * rays.dy
    bend = b * b - rays.dx * rays.dx - rays.dy * rays.dy
    with np.errstate(invalid="ignore"):
        back = bend / (radius * (1 + np.sqrt(1 + bend / radius**2)))
    opd: np.ndarray = (rays.index * (b + back) - rays.path) * (UM_PER_MM / rays.wavelength_um)
    return opd


def exit_radius(lens: Lens, source: Source | Sources, rays: Pencil, stop: Stop | None = None) -> np.ndarray:
    """Return the sphere's radius: from the paraxial exit-pupil plane to the sensor along the chief ray, mm."""
    along = rays.chief_kz
    if lens.misaligned:  # the cosine about the axis behind the last surface, which a tilted sensor does not share
        turn = seen_from(lens, getattr(source, "azimuth_deg", 0.0)).motions[-1].rotation[2]
        along = turn[0] * rays.chief_kx + turn[1] * rays.chief_ky + turn[2] * rays.chief_kz
    radius: np.ndarray = (lens.sensor_mm - entrance(lens, source, stop).exit_plane) / along
    return radius


@lru_cache(maxsize=8)
def pupil_grid(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return cell-centre coordinates (ξ, η) of a count × count grid over the pupil, and which lie in the disc."""
    axis = (2 * np.arange(count) + 1 - count) / count
    xi, eta = np.meshgrid(axis, axis)
    inside = xi * xi + eta * eta <= 1
    return protected(xi), protected(eta), protected(inside)


def opd_map(lens: Lens, source: Source, count: int = 64) -> np.ndarray:
    """Return the displayed OPD over the pupil, (count, count) waves, row = η, NaN outside.

    Half the disc is traced, of a misaligned lens all of it.
    """
    xi, eta, inside = pupil_grid(count)
    values = np.full((count, count), np.nan)
    if lens.misaligned:
        values[inside] = displayed_opd(lens, source, xi[inside], eta[inside])
        return values
    right = slice(None), slice(count // 2, None)
    half = inside[right]
    values[right][half] = displayed_opd(lens, source, xi[right][half], eta[right][half])
    values[:, : (count + 1) // 2] = values[:, : -((count + 1) // 2) - 1 : -1]
    return values


def spot(
    lens: Lens, source: Source | Sources, rings: int = 8, clip: bool = False, passing: np.ndarray | None = None
) -> Spot:
    """Return the spot diagram of ``rings`` hexapolar rings, and its RMS radius about the centroid; µm.

    A ray stands for the light of its cell, so both are means weighted with `Pencil.weight`, to the first power: the
    energy of rays that are launched evenly into the solid angle is proportional to it. ``passing``: the share of the
    light that what stands in the stop lets through at each ray of `hexapolar`, (ray,); NaN is the place of rays with
    none. Raises GeometryError where no ray reaches the sensor.
    """
    xi, eta = hexapolar(rings)
    rays = pencil(lens, source, xi, eta, clip)
    x, y = rays.dx * UM_PER_MM, rays.dy * UM_PER_MM
    light = np.where(rays.passed, rays.weight, 0.0)
    if passing is not None:
        light, x, y = light * passing, np.where(passing > 0, x, np.nan), np.where(passing > 0, y, np.nan)
    if not light.any():
        raise GeometryError(
            "no ray reaches the sensor; choose a smaller field or leave {parameter} off", parameter="clip"
        )
    rounding = WEIGHT_ROUNDING if lens.aim == "stop" else MEAN_ROUNDING
    centre_x, centre_y = _centroid(x, light, rounding), _centroid(y, light, rounding)
    square = _mean((x - centre_x) ** 2 + (y - centre_y) ** 2, light)[..., 0]
    return Spot(x, y, np.sqrt(square), centre_y[..., 0], centre_x[..., 0])


def _mean(values: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return the mean by light over the rays that have any, (…, 1); NaN where none has."""
    with np.errstate(invalid="ignore"):
        share = light / light.sum(-1, keepdims=True)
    mean: np.ndarray = (np.where(light > 0, values, 0.0) * share).sum(-1, keepdims=True)
    return mean


def _centroid(values: np.ndarray, light: np.ndarray, rounding: float) -> np.ndarray:
    """Return the mean, (…, 1); 0 where it is nothing but rounding, a share of the largest value."""
    mean = _mean(values, light)
    return np.where(np.abs(mean) > rounding * np.nanmax(np.abs(values), -1, keepdims=True), mean, 0.0)


def hexapolar(rings: int) -> tuple[np.ndarray, np.ndarray]:
    """Return pupil points (ξ, η): the centre, then rings of 6, 12, 18 … points, equal area per point.

    Inside ring k there are 1 + 3k(k − 1) of all 1 + 3n(n + 1) points and its own are 6k, so the middle of its share of
    the area lies at ρ² = (1 + 3k²)/(1 + 3n(n + 1)). No point lies on the rim.
    """
    square = [(1 + 3 * k * k) / (1 + 3 * rings * (rings + 1)) for k in range(1, rings + 1)]
    radius = np.concatenate([[0.0], *(np.full(6 * k, sqrt(s)) for k, s in enumerate(square, 1))])
    angle = np.concatenate([[0.0], *(2 * np.pi * np.arange(6 * k) / (6 * k) for k in range(1, rings + 1))])
    return radius * np.sin(angle), radius * np.cos(angle)


def ray_fan(lens: Lens, source: Source | Sources, count: int = 65, clip: bool = False) -> Fan:
    """Return the transverse ray errors at the sensor along η (their y) and along ξ (their x); µm, NaN where clipped."""
    line, tangential, sagittal = _two_lines(lens, source, count, clip)
    return Fan(line, tangential.dy * UM_PER_MM, sagittal.dx * UM_PER_MM, "µm")


def opd_fan(lens: Lens, source: Source | Sources, count: int = 65, clip: bool = False) -> Fan:
    """Return the displayed OPD along η and along ξ; waves, NaN where clipped."""
    line, tangential, sagittal = _two_lines(lens, source, count, clip)
    along, across = (opd_on_sphere(rays, exit_radius(lens, source, rays)) for rays in (tangential, sagittal))
    return Fan(line, along, across, "waves")


def _two_lines(lens: Lens, source: Source | Sources, count: int, clip: bool) -> tuple[np.ndarray, Pencil, Pencil]:
    """Return ``count`` points from −1 to 1, and the pencils through those points of η and of ξ."""
    line, zero = np.linspace(-1, 1, count), np.zeros(count)
    return line, pencil(lens, source, zero, line, clip), pencil(lens, source, line, zero, clip)
