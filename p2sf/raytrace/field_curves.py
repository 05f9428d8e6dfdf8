"""Curves over the field and the spectrum: focal surfaces, distortion, chromatic shift; exact and to third order.

All focus positions are mm from the sensor, positive behind it; results have the shape of the field slopes.

See handbook 8.3.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM, FloatOrArray
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.paraxial.balance import depth_of_focus_um
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.raytrace.aiming import Sources, pupil_rays, start
from p2sf.raytrace.surface import Status, to_plane
from p2sf.raytrace.trace import run

NEAR = 1e-3  # pupil radii, or slope, from the chief ray to its neighbours: the error is its square plus 1e-16 over it


class Foci(NamedTuple):
    """Sagittal and tangential focus, mm behind the sensor along the axis; NaN where the chief ray is lost."""

    sagittal: np.ndarray
    tangential: np.ndarray


@dataclass(frozen=True, eq=False)
class Heights:
    """Heights of chief rays on the sensor, mm: by exact rays (NaN where lost), to third order, and paraxially.

    They are measured along the direction of the field; ``aside`` is the component across it, for a misaligned lens.
    ``middle`` is where the chief ray of the axis lands. Of a misaligned lens it is not 0, ``paraxial`` follows from
    the real chief rays beside that of the axis, and the third order is what the aligned lens adds to it.
    """

    real: np.ndarray
    third_order: np.ndarray
    paraxial: np.ndarray
    aside: FloatOrArray = 0.0
    middle: FloatOrArray = 0.0

    @property
    def distortion(self) -> np.ndarray:
        """Return (real − paraxial)/(paraxial − middle), 0 on the axis."""
        return _share(self.real - self.paraxial, self.paraxial - self.middle)

    @property
    def third_order_distortion(self) -> np.ndarray:
        """Return (third order − paraxial)/(paraxial − middle), 0 on the axis."""
        return _share(self.third_order - self.paraxial, self.paraxial - self.middle)


def _share(part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Return part/whole; 0 where the whole is 0, NaN where the part is NaN."""
    share: np.ndarray = np.divide(part, whole, out=np.where(np.isnan(part), np.nan, 0.0), where=whole != 0)
    return share


def real_foci(lens: Lens, source: Source, field_slope: ArrayLike, stop: Stop | None = None) -> Foci:
    """Return the foci of exact rays close to the chief ray, equivalent to Coddington's equations.

    They are the two distances at which neighbours of the chief ray in some direction of the pupil, `NEAR` from it,
    cross it; the tangential focus is the one whose neighbours are closer to the direction of the field. Distances are
    measured along the normal of the sensor; of a curved sensor along its axis, from the point where the chief ray
    lands. ``field_slope`` replaces that of ``source``.
    """
    # At a distance z the neighbours are displaced by (M + zN)·(ξ, η), M and N the derivatives of position and slope:
    # this vanishes where −z is an eigenvalue of N⁻¹M.
    slopes = np.asarray(field_slope, dtype=float)
    xi, eta = np.array([NEAR, -NEAR, 0.0, 0.0, 0.0]), np.array([0.0, 0.0, NEAR, -NEAR, 0.0])
    turned = seen_from(lens, source.azimuth_deg)
    rays = pupil_rays(turned, Sources(source.depth_mm, slopes, source.wavelength_um), xi, eta, stop=stop)
    beam = run(turned, start(rays), rays.index)
    lost, chief_z = (beam.status != Status.PASSED).any(-1), beam.z[..., -1].copy()
    to_plane(beam, rays.index[-1])
    places, along = (
        np.where(lost[..., None, None], np.eye(2), np.stack([part[..., :4:2] - part[..., 1:4:2] for part in pair], -2))
        for pair in ((beam.x, beam.y), (beam.p / beam.r, beam.q / beam.r))
    )
    ((a, b), (c, d)) = np.moveaxis(np.linalg.solve(along, places), (-2, -1), (0, 1))
    half = (a - d) / 2
    apart = np.copysign(np.sqrt(np.maximum(half * half + b * c, 0.0)), half)
    return Foci(*(np.where(lost, np.nan, -((a + d) / 2 + side * apart) - chief_z) for side in (1, -1)))


def seidel_foci(c: Coefficients) -> Foci:
    """Return the foci where W20 + Wd and W20 + W22 + Wd vanish: Δz = −2n′λW/NA² (Welford 1986, §7.7), mm."""
    scale = -2 * depth_of_focus_um(c.image_index, c.wavelength_um, c.na) / UM_PER_MM
    return Foci(scale * (c.w20 + c.wd), scale * (c.w20 + c.w22 + c.wd))


def heights(lens: Lens, source: Source, field_slope: ArrayLike, stop: Stop | None = None) -> Heights:
    """Return where the chief rays of these fields land; W11 moves the paraxial point by λW11/(n′u′).

    ``field_slope`` replaces that of ``source``.
    """
    slopes, turned = np.asarray(field_slope, dtype=float), seen_from(lens, source.azimuth_deg)
    aside, real = _landing(turned, source, slopes, stop)
    c = coefficients(lens, source.depth_mm, slopes, source.wavelength_um, stop)
    more = c.w11 * c.wavelength_um / c.reduced_slope / UM_PER_MM
    if not lens.misaligned:
        return Heights(real, c.image_height + more, c.image_height, aside)
    near, middle, far = _landing(turned, source, np.array([-NEAR, 0.0, NEAR]), stop)[1]
    paraxial = middle + (far - near) / (2 * NEAR) * slopes
    return Heights(real, paraxial + more, paraxial, aside, middle)


def _landing(lens: Lens, source: Source, slopes: np.ndarray, stop: Stop | None) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y of the chief rays of fields on the sensor, mm; NaN where they are lost."""
    rays = pupil_rays(lens, Sources(source.depth_mm, slopes, source.wavelength_um), np.zeros(1), np.zeros(1), stop=stop)
    beam = run(lens, start(rays), rays.index)
    x, y = (np.where(beam.status != Status.PASSED, np.nan, place)[..., 0] for place in (beam.x, beam.y))
    return x, y


def colour_shift(
    lens: Lens, depth_mm: float, wavelength_um: ArrayLike, zones: ArrayLike, stop: Stop | None = None
) -> np.ndarray:
    """Return where rays of each zone of the pupil cross the axis, mm behind the sensor, (zones, wavelengths).

    Zone 0 is the paraxial image; for other zones it is the crossing of exact rays through opposite points, above and
    below the centre at that fraction of the pupil's radius; NaN if one is lost.
    """
    waves, zones = np.asarray(wavelength_um, dtype=float), np.asarray(zones, dtype=float)
    rays = pupil_rays(
        lens, Sources(depth_mm, 0.0, waves), np.zeros(2 * zones.size), np.append(zones, -zones), stop=stop
    )
    beam = run(lens, start(rays), rays.index)
    with np.errstate(invalid="ignore", divide="ignore"):
        pairs = (np.where(beam.status != Status.PASSED, np.nan, part) for part in (beam.y, beam.q / beam.r))
        height, slope = (part[:, : zones.size] - part[:, zones.size :] for part in pairs)
        crossing = -(height / slope).T
    paraxial = image_distance(lens, depth_mm, waves) - lens.sensor_mm
    return np.where(zones[:, None] == 0, paraxial, crossing)
