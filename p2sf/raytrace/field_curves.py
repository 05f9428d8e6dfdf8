"""Curves over the field and the spectrum: focal surfaces, distortion, chromatic shift; exact and to third order.

All focus positions are mm from the sensor, positive behind it; results have the shape of the field slopes.

See handbook 8.3.
"""

from dataclasses import dataclass
from math import atan, degrees, hypot, nan
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM, FloatOrArray
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.raytrace.aiming import Sources, pupil_rays, start
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import run

NEAR = 1e-3  # pupil radii from the chief ray to its neighbours: an error of its square, a rounding of 1e-16 over it


class Foci(NamedTuple):
    """Sagittal and tangential focus, mm behind the sensor along the axis; NaN where the chief ray is lost."""

    sagittal: np.ndarray
    tangential: np.ndarray


@dataclass(frozen=True)
class Heights:
    """Where chief rays land, mm on the sensor: by exact rays (NaN where lost), to third order, and paraxially.

    Along the direction of the field; ``aside`` is how far beside it a misaligned lens has them land. There the other
    two are those of the lens set straight.
    """

    real: np.ndarray
    third_order: np.ndarray
    paraxial: np.ndarray
    aside: FloatOrArray = 0.0

    @property
    def distortion(self) -> np.ndarray:
        """Return (real − paraxial)/paraxial, 0 on the axis."""
        return _share(self.real - self.paraxial, self.paraxial)

    @property
    def third_order_distortion(self) -> np.ndarray:
        """Return (third order − paraxial)/paraxial, 0 on the axis."""
        return _share(self.third_order - self.paraxial, self.paraxial)


def _share(part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Return part/whole; 0 where the whole is 0, NaN where the part is."""
    share: np.ndarray = np.divide(part, whole, out=np.where(np.isnan(part), np.nan, 0.0), where=whole != 0)
    return share


def real_foci(lens: Lens, source: Source, field_slope: ArrayLike, stop: Stop | None = None) -> Foci:
    """Return the foci of exact rays close to the chief ray, the same as Coddington's equations.

    The sagittal focus is where a ray `NEAR` beside the chief ray crosses the plane of symmetry, the tangential one
    where two rays `NEAR` above and below it cross. ``field_slope`` replaces that of ``source``. Of a misaligned lens
    they are the two places where neighbours of the chief ray cross it, along the normal of the sensor; tangential is
    the one whose neighbours lie nearer to the direction of the field.
    """
    slopes = np.asarray(field_slope, dtype=float)
    if lens.misaligned:
        return _skew_foci(lens, source, slopes, stop)
    xi, eta = np.array([NEAR, 0.0, 0.0]), np.array([0.0, NEAR, -NEAR])
    rays = pupil_rays(lens, Sources(source.depth_mm, slopes, source.wavelength_um), xi, eta, stop=stop)
    beam = run(lens, start(rays), rays.index)
    lost = (beam.status != Status.PASSED).any(-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        across, up = beam.p / beam.r, beam.q / beam.r
        sagittal = -beam.x[..., 0] / across[..., 0]
        tangential = -(beam.y[..., 1] - beam.y[..., 2]) / (up[..., 1] - up[..., 2])
    return Foci(np.where(lost, np.nan, sagittal), np.where(lost, np.nan, tangential))


def _skew_foci(lens: Lens, source: Source, slopes: np.ndarray, stop: Stop | None) -> Foci:
    """Return the foci without symmetry: where neighbours of the chief ray in some direction of the pupil cross it.

    At a distance z such neighbours lie (M + zN)·(ξ, η) beside it, M and N the derivatives of place and slope: these
    vanish where −z is an eigenvalue of N⁻¹M.
    """
    xi, eta = np.array([NEAR, -NEAR, 0.0, 0.0]), np.array([0.0, 0.0, NEAR, -NEAR])
    turned = seen_from(lens, source.azimuth_deg)
    rays = pupil_rays(turned, Sources(source.depth_mm, slopes, source.wavelength_um), xi, eta, stop=stop)
    beam = run(turned, start(rays), rays.index)
    lost = (beam.status != Status.PASSED).any(-1)
    places, along = (
        np.where(lost[..., None, None], np.eye(2), np.stack([part[..., ::2] - part[..., 1::2] for part in pair], -2))
        for pair in ((beam.x, beam.y), (beam.p / beam.r, beam.q / beam.r))
    )
    values, directions = np.linalg.eig(np.linalg.solve(along, places))
    upright = np.abs(directions[..., 1, :]) / np.abs(directions).max(-2)
    second = upright[..., 1] > upright[..., 0]
    tangential, sagittal = (-np.where(one, values[..., 1], values[..., 0]).real for one in (second, ~second))
    return Foci(np.where(lost, np.nan, sagittal), np.where(lost, np.nan, tangential))


@dataclass(frozen=True)
class FocalSurface:
    """Where a lens is sharp over a grid of fields (x, y), in the axes of the sensor, mm.

    ``points``: (ny, nx, 3), halfway between both foci of each field, z > 0 behind the sensor; NaN where rays are lost.
    ``tilt_deg``: the tilts about x and y, right-handed, that a sensor needs to lie along the plane of least squares
    through them, degrees; ``shift_mm``: where that plane crosses the middle of the points.
    """

    points: np.ndarray
    tilt_deg: tuple[float, float]
    shift_mm: float


def focal_surface(lens: Lens, source: Source, x_deg: ArrayLike, y_deg: ArrayLike) -> FocalSurface:
    """Return where the points of a plane object are sharp, at all fields (x, y), and the plane nearest to that.

    Raises GeometryError where fewer than three fields pass.
    """
    rows = [[_focal_point(lens, source, float(x), float(y)) for x in np.ravel(x_deg)] for y in np.ravel(y_deg)]
    points = np.array(rows)
    known = points[np.isfinite(points).all(-1)]
    if len(known) < 3:
        raise GeometryError(
            "only {count} fields have a focus, but a plane needs three; choose smaller fields", count=len(known)
        )
    centre = known.mean(0)
    across, up = np.linalg.lstsq((known - centre)[:, :2], known[:, 2] - centre[2], rcond=None)[0].tolist()
    # The normal (−across, −up, 1) is R_x(a)·R_y(b)·z = (sin b, −sin a·cos b, cos a·cos b).
    tilt = degrees(atan(up)), degrees(-atan(across / hypot(1.0, up)))
    return FocalSurface(points, tilt, float(centre[2]))


def _focal_point(lens: Lens, source: Source, x_deg: float, y_deg: float) -> list[float]:
    """Return the point (x, y, z) halfway between the foci of a field, in the axes of the sensor, mm."""
    point = Source(source.depth_mm, wavelength_um=source.wavelength_um, field_deg=(x_deg, y_deg))
    foci = real_foci(lens, point, point.field_slope)
    turned = seen_from(lens, point.azimuth_deg)
    rays = pupil_rays(turned, point, np.zeros(1), np.zeros(1))
    beam = run(turned, start(rays), rays.index)
    if beam.status.any():
        return [nan, nan, nan]
    z = float(foci.sagittal + foci.tangential) / 2
    across, up = (float((place + z * part / beam.r)[0]) for place, part in ((beam.x, beam.p), (beam.y, beam.q)))
    turn = np.deg2rad(point.azimuth_deg)
    return [float(across * np.cos(turn) + up * np.sin(turn)), float(up * np.cos(turn) - across * np.sin(turn)), z]


def seidel_foci(c: Coefficients) -> Foci:
    """Return where W20 + Wd and W20 + W22 + Wd vanish: Δz = −2n′λW/NA² (Welford 1986, §7.7), mm."""
    scale = -2 * c.image_index * c.wavelength_um / c.na**2 / UM_PER_MM
    return Foci(scale * (c.w20 + c.wd), scale * (c.w20 + c.w22 + c.wd))


def heights(lens: Lens, source: Source, field_slope: ArrayLike, stop: Stop | None = None) -> Heights:
    """Return where the chief rays of these fields land; W11 moves the paraxial point by λW11/(n′u′).

    ``field_slope`` replaces that of ``source``.
    """
    slopes = np.asarray(field_slope, dtype=float)
    sources, turned = Sources(source.depth_mm, slopes, source.wavelength_um), seen_from(lens, source.azimuth_deg)
    rays = pupil_rays(turned, sources, np.zeros(1), np.zeros(1), stop=stop)
    beam = run(turned, start(rays), rays.index)
    aside, real = (np.where(beam.status != Status.PASSED, np.nan, place)[..., 0] for place in (beam.x, beam.y))
    c = coefficients(lens, source.depth_mm, slopes, source.wavelength_um, stop)
    third = c.image_height + c.w11 * c.wavelength_um / c.reduced_slope / UM_PER_MM
    return Heights(real, third, c.image_height, aside if lens.misaligned else 0.0)


def colour_shift(
    lens: Lens, depth_mm: float, wavelength_um: ArrayLike, zones: ArrayLike, stop: Stop | None = None
) -> np.ndarray:
    """Return where rays of each zone of the pupil cross the axis, mm behind the sensor, (zones, wavelengths).

    Zone 0 is the paraxial image; another zone is an exact ray at that fraction of the pupil's radius, NaN if lost. Of a
    misaligned lens it is where rays through opposite points of the zone, above and below its middle, cross.
    """
    waves, zones = np.asarray(wavelength_um, dtype=float), np.asarray(zones, dtype=float)
    height, slope = _in_meridian(lens, depth_mm, waves, zones, stop)
    if lens.misaligned:
        low, other = _in_meridian(lens, depth_mm, waves, -zones, stop)
        height, slope = height - low, slope - other
    with np.errstate(invalid="ignore", divide="ignore"):
        crossing = -(height / slope).T
    paraxial = image_distance(lens, depth_mm, waves) - lens.sensor_mm
    return np.where(zones[:, None] == 0, paraxial, crossing)


def _in_meridian(
    lens: Lens, depth_mm: float, waves: np.ndarray, zones: np.ndarray, stop: Stop | None
) -> tuple[np.ndarray, np.ndarray]:
    """Return y and dy/dz at the sensor of rays through η = ``zones``, (wavelengths, zones); NaN where lost."""
    rays = pupil_rays(lens, Sources(depth_mm, 0.0, waves), np.zeros_like(zones), zones, stop=stop)
    beam = run(lens, start(rays), rays.index)
    with np.errstate(invalid="ignore", divide="ignore"):
        height, slope = (np.where(beam.status != Status.PASSED, np.nan, part) for part in (beam.y, beam.q / beam.r))
    return height, slope
