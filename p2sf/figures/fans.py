"""Ray errors and path differences along the two axes of the pupil, behind the mask in the stop."""

from dataclasses import dataclass, replace

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.landing import mask_of_rays
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import Rays, exit_radius, opd_on_sphere, pencil


@dataclass(frozen=True, eq=False)
class Fan:
    """A quantity along one line of the pupil: ``pupil`` −1…1, ``tangential`` along η, ``sagittal`` along ξ.

    NaN where rays are lost or clipped, and where the mask covers the pupil; but for its vanes, one of which may lie
    along a whole line. The axes of `Sources` come first.
    """

    pupil: np.ndarray
    tangential: np.ndarray
    sagittal: np.ndarray
    unit: str


def ray_fan(lens: Lens, source: Source | Sources, count: int = 65, clip: bool = False) -> Fan:
    """Return the transverse ray errors at the sensor along η (their y) and along ξ (their x), µm.

    Raises GeometryError for a mask that bends rays.
    """
    line, tangential, sagittal = _two_lines(lens, source, count, clip)
    return _behind_mask(lens, source, Fan(line, tangential.dy * UM_PER_MM, sagittal.dx * UM_PER_MM, "µm"))


def opd_fan(lens: Lens, source: Source | Sources, count: int = 65, clip: bool = False) -> Fan:
    """Return the displayed OPD along η and along ξ, waves. Raises GeometryError for a mask that bends rays."""
    line, tangential, sagittal = _two_lines(lens, source, count, clip)
    along, across = (opd_on_sphere(rays, exit_radius(lens, source, rays)) for rays in (tangential, sagittal))
    return _behind_mask(lens, source, Fan(line, along, across, "waves"))


def _two_lines(lens: Lens, source: Source | Sources, count: int, clip: bool) -> tuple[np.ndarray, Rays, Rays]:
    """Return ``count`` points from −1 to 1, and the pencils through those points of η and of ξ."""
    line, zero = np.linspace(-1, 1, count), np.zeros(count)
    return line, pencil(lens, source, zero, line, clip), pencil(lens, source, line, zero, clip)


def _behind_mask(lens: Lens, source: Source | Sources, fan: Fan) -> Fan:
    mask, zero = mask_of_rays(lens, source).without_vanes, np.zeros_like(fan.pupil)
    along, across = mask.opens(zero, fan.pupil), mask.opens(fan.pupil, zero)
    tangential, sagittal = np.where(along, fan.tangential, np.nan), np.where(across, fan.sagittal, np.nan)
    return replace(fan, tangential=tangential, sagittal=sagittal)
