"""Curves over the field and the spectrum: focal surfaces, distortion, chromatic shift; exact and to third order.

All focus positions are mm from the sensor, positive behind it; results have the shape of the field slopes.

See handbook 8.3.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens, check_aligned
from p2sf.lens.source import Source
from p2sf.messages import Message
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
    """Where chief rays land, mm on the sensor: by exact rays (NaN where lost), to third order, and paraxially."""

    real: np.ndarray
    third_order: np.ndarray
    paraxial: np.ndarray

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
    where two rays `NEAR` above and below it cross. ``field_slope`` replaces that of ``source``.
    """
    check_aligned(lens, Message("a curve over the field"))
    slopes = np.asarray(field_slope, dtype=float)
    xi, eta = np.array([NEAR, 0.0, 0.0]), np.array([0.0, NEAR, -NEAR])
    rays = pupil_rays(lens, Sources(source.depth_mm, slopes, source.wavelength_um), xi, eta, stop=stop)
    beam = run(lens, start(rays), rays.index)
    lost = (beam.status != Status.PASSED).any(-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        across, up = beam.p / beam.r, beam.q / beam.r
        sagittal = -beam.x[..., 0] / across[..., 0]
        tangential = -(beam.y[..., 1] - beam.y[..., 2]) / (up[..., 1] - up[..., 2])
    return Foci(np.where(lost, np.nan, sagittal), np.where(lost, np.nan, tangential))


def seidel_foci(c: Coefficients) -> Foci:
    """Return where W20 + Wd and W20 + W22 + Wd vanish: Δz = −2n′λW/NA² (Welford 1986, §7.7), mm."""
    scale = -2 * c.image_index * c.wavelength_um / c.na**2 / UM_PER_MM
    return Foci(scale * (c.w20 + c.wd), scale * (c.w20 + c.w22 + c.wd))


def heights(lens: Lens, source: Source, field_slope: ArrayLike, stop: Stop | None = None) -> Heights:
    """Return where the chief rays of these fields land; W11 moves the paraxial point by λW11/(n′u′).

    ``field_slope`` replaces that of ``source``.
    """
    check_aligned(lens, Message("a curve over the field"))
    slopes = np.asarray(field_slope, dtype=float)
    sources = Sources(source.depth_mm, slopes, source.wavelength_um)
    rays = pupil_rays(lens, sources, np.zeros(1), np.zeros(1), stop=stop)
    beam = run(lens, start(rays), rays.index)
    real = np.where(beam.status != Status.PASSED, np.nan, beam.y)[..., 0]
    c = coefficients(lens, source.depth_mm, slopes, source.wavelength_um, stop)
    third = c.image_height + c.w11 * c.wavelength_um / c.reduced_slope / UM_PER_MM
    return Heights(real, third, c.image_height)


def colour_shift(
    lens: Lens, depth_mm: float, wavelength_um: ArrayLike, zones: ArrayLike, stop: Stop | None = None
) -> np.ndarray:
    """Return where rays of each zone of the pupil cross the axis, mm behind the sensor, (zones, wavelengths).

    Zone 0 is the paraxial image; another zone is an exact ray at that fraction of the pupil's radius, NaN if lost.
    """
    check_aligned(lens, Message("the focus of each zone"))
    waves, zones = np.asarray(wavelength_um, dtype=float), np.asarray(zones, dtype=float)
    rays = pupil_rays(lens, Sources(depth_mm, 0.0, waves), np.zeros_like(zones), zones, stop=stop)
    beam = run(lens, start(rays), rays.index)
    with np.errstate(invalid="ignore", divide="ignore"):
        crossing = np.where(beam.status != Status.PASSED, np.nan, -beam.y * beam.r / beam.q).T
    paraxial = image_distance(lens, depth_mm, waves) - lens.sensor_mm
    return np.where(zones[:, None] == 0, paraxial, crossing)
