"""The paraxial blur of the axial point at every depth, and the range of depths within a tolerated blur.

In s = 1/(object to entrance pupil) the marginal ray is linear (handbook 7.1): its height on the sensor is h∞ + k·s, and
the diameter of the blur is twice its absolute value.
"""

from dataclasses import dataclass
from functools import cached_property
from math import inf, isfinite

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import Stop, paraxial_rays, pupils

ELSEWHERE_MM = 1000.0  # any depth except infinity: two points determine the line


@dataclass(frozen=True)
class AxialBlur:
    """The blur of the axial point on the sensor of a lens, at one wavelength and stop."""

    lens: Lens
    wavelength_um: float
    stop: Stop

    @cached_property
    def entrance_mm(self) -> float:
        """Return the position of the entrance pupil, mm from the first vertex."""
        return float(pupils(self.lens, self.wavelength_um, self.stop).entrance_from_first)

    def heights_mm(self, depths_mm: np.ndarray, sensor_mm: float | None = None) -> np.ndarray:
        """Return the height of the marginal ray of each depth on the sensor, or on another plane, mm."""
        sensor_mm = self.lens.sensor_mm if sensor_mm is None else sensor_mm
        rays = paraxial_rays(self.lens, np.asarray(depths_mm), self.wavelength_um, self.stop)
        heights: np.ndarray = rays.y[-1] + rays.nu[-1] / rays.index[-1] * sensor_mm
        return heights

    def sharp_mm(self, tolerated_um: float) -> tuple[float, float] | None:
        """Return the nearest and farthest depth with a blur within ``tolerated_um``; None if there is no real depth.

        The nearest is 0 if an object on the first surface is still sharp.
        """
        half_mm, pupil = tolerated_um / 2 / UM_PER_MM, self.entrance_mm
        roots = self._roots(half_mm)
        if not roots:  # the same blur everywhere
            return (0.0, inf) if abs(float(self.heights_mm(np.array([inf]))[0])) <= half_mm else None
        for low, high in _real_depths(pupil):
            far, near = max(low, min(roots)), min(high, max(roots))
            if far < near:
                return _depth(near, pupil), _depth(far, pupil)
        return None

    def hyperfocal_mm(self, tolerated_um: float) -> float:
        """Return the focus distance at which infinity has exactly the tolerated blur; infinite for an afocal lens.

        The sensor is then blur/(2|u′|) behind the rear focus.
        """
        focus = float(cardinal_points(self.lens, self.wavelength_um).back_focal_distance)
        at_focus, behind = (float(self.heights_mm(np.array([inf]), focus + step)[0]) for step in (0.0, 1.0))
        if not isfinite(focus) or behind == at_focus:
            return inf
        sensor = focus + self.lens.directions[-1] * tolerated_um / 2 / UM_PER_MM / abs(behind - at_focus)
        roots = self._roots(0.0, sensor)
        return 1 / roots[0] - self.entrance_mm if roots and roots[0] else inf

    def _roots(self, half_mm: float, sensor_mm: float | None = None) -> list[float]:
        """Return the two s at which |h| is ``half_mm``; none if the blur is the same at every depth."""
        far, one = self.heights_mm(np.array([inf, ELSEWHERE_MM]), sensor_mm)
        slope = (one - far) * (ELSEWHERE_MM + self.entrance_mm)
        return [float((side * half_mm - far) / slope) for side in (-1, 1)] if slope else []


def _real_depths(pupil: float) -> list[tuple[float, float]]:
    """Return the ranges of s in which the depth 1/s − pupil is positive, first the one that ends at infinity."""
    return [(0.0, 1 / pupil)] if pupil > 0 else [(0.0, inf), *([(-inf, 1 / pupil)] if pupil else [])]


def _depth(s: float, pupil: float) -> float:
    return max(0.0, 1 / s - pupil) if s else inf
