"""The spot diagram: where exact rays meet the sensor, and means over all of their light (handbook 8.3)."""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.landing import landing, mask_of_rays
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import hexapolar, pencil

DRAWN_RINGS = 12


@dataclass(frozen=True, eq=False)
class Spot:
    """Where rays meet the sensor, µm from the chief ray, and figures of all the light, in µm.

    ``x_um``, ``y_um``: of `hexapolar` rays, (…, ray), evenly spread over the pupil; NaN where none arrives. Centroid
    and RMS distances from it are means by light over the pupil, and ``farthest_um`` is the largest distance from the
    centroid of a ray that arrives, those of the rim among them: (…,), whatever rays are drawn.
    """

    x_um: np.ndarray
    y_um: np.ndarray
    rms_x_um: np.ndarray
    rms_y_um: np.ndarray
    centroid_y_um: np.ndarray
    farthest_um: np.ndarray
    centroid_x_um: FloatOrArray = 0.0

    @property
    def rms_um(self) -> np.ndarray:
        """Return the RMS distance from the centroid, µm."""
        rms: np.ndarray = np.hypot(self.rms_x_um, self.rms_y_um)
        return rms


def spot(
    lens: Lens, source: Source | Sources, rings: int = DRAWN_RINGS, clip: bool = False, follow_rims: bool = True
) -> Spot:
    """Return the spot diagram of ``rings`` hexapolar rings, behind the mask in the stop, and its figures.

    ``follow_rims``: as `landing` has it. Raises GeometryError as `landing` does.
    """
    found, (xi, eta) = landing(lens, source, clip, follow_rims), hexapolar(rings)
    rays, mask = pencil(lens, source, xi, eta, clip), mask_of_rays(lens, source)
    shown = rays.passed & mask.opens(xi, eta) & (mask.amplitude(xi, eta) > 0)
    x, y = (np.where(shown, place, np.nan) for place in (rays.x_um, rays.y_um))
    centre_x, centre_y = found.centroid_um
    return Spot(x, y, *found.rms_um, centre_y, found.farthest_um, centre_x)
