"""What changes over the field and the spectrum: focal surfaces, distortion, colour; exact rays beside the third order.

All focus positions are mm from the sensor, positive behind it; all arrays follow the field slopes they are asked for.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.raytrace.aiming import pupil_rays, start
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import run

NEAR = 1e-3  # pupil radii: a neighbour of the chief ray; the error is its square, the rounding 1e-16 over it


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
        """Return the same to third order."""
        return _share(self.third_order - self.paraxial, self.paraxial)


def _share(part, whole):
    return np.divide(part, whole, out=np.where(np.isnan(part), np.nan, 0.0), where=whole != 0)


def real_foci(lens: Lens, source: Source, field_slope, stop: Stop | None = None) -> Foci:
    """Return where exact rays close to the chief ray come to focus, as Coddington's equations do.

    Two rays at ±`NEAR` of the pupil beside the chief ray, and two above and below it, cross at that focus.
    """
    slopes = np.asarray(field_slope, dtype=float)
    xi, eta = np.array([NEAR, 0.0, 0.0]), np.array([0.0, NEAR, -NEAR])
    rays = pupil_rays(lens, replace(source, field_slope=slopes), xi, eta, stop=stop)
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


def heights(lens: Lens, source: Source, field_slope, stop: Stop | None = None) -> Heights:
    """Return where the chief rays of these fields land; W11 moves the paraxial point by λW11/(n′u′)."""
    slopes = np.asarray(field_slope, dtype=float)
    rays = pupil_rays(lens, replace(source, field_slope=slopes), np.zeros(1), np.zeros(1), stop=stop)
    beam = run(lens, start(rays), rays.index)
    real = np.where(beam.status != Status.PASSED, np.nan, beam.y)[..., 0]
    c = coefficients(lens, source.depth_mm, slopes, source.wavelength_um, stop)
    third = c.image_height + c.w11 * c.wavelength_um / c.reduced_slope / UM_PER_MM
    return Heights(real, third, c.image_height)


def colour_shift(lens: Lens, depth_mm: float, wavelength_um, zones, stop: Stop | None = None) -> np.ndarray:
    """Return where rays of each zone of the pupil cross the axis, mm behind the sensor, (zones, wavelengths).

    Zone 0 is the paraxial image, others exact rays from that part of the pupil's radius; NaN where a ray is lost.
    """
    waves, zones = np.asarray(wavelength_um, dtype=float), np.asarray(zones, dtype=float)
    rays = pupil_rays(lens, Source(depth_mm, 0.0, waves), np.zeros_like(zones), zones, stop=stop)
    beam = run(lens, start(rays), rays.index)
    with np.errstate(invalid="ignore", divide="ignore"):
        crossing = np.where(beam.status != Status.PASSED, np.nan, -beam.y * beam.r / beam.q).T
    paraxial = image_distance(lens, depth_mm, waves) - lens.sensor_mm
    return np.where(zones[:, None] == 0, paraxial, crossing)
