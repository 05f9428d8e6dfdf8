"""The paraxial blur of the axial point at every depth, and the depths between which it stays within what is tolerated.

In s = 1/(object to entrance pupil) the marginal ray is linear (handbook 7.1): its height on the sensor is h∞ + k·s, and
the blur's diameter is twice that.
"""

from dataclasses import dataclass
from functools import cached_property
from math import inf, isfinite

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import Stop, paraxial_rays, pupils

ELSEWHERE_MM = 1000.0  # any depth but infinity: two points make the line


@dataclass(frozen=True)
class AxialBlur:
    """The blur of the axial point behind a lens, its sensor where it stands, at one wavelength and stop."""

    lens: Lens
    wavelength_um: float
    stop: Stop

    @cached_property
    def entrance_mm(self) -> float:
        """Return the place of the entrance pupil, mm from the first vertex."""
        return float(pupils(self.lens, self.wavelength_um, self.stop).entrance_from_first)

    def heights_mm(self, depths_mm: np.ndarray, sensor_mm: float | None = None) -> np.ndarray:
        """Return where the marginal ray of each depth meets the sensor, or a plane elsewhere, mm."""
        sensor_mm = self.lens.sensor_mm if sensor_mm is None else sensor_mm
        rays = paraxial_rays(self.lens, np.asarray(depths_mm), self.wavelength_um, self.stop)
        heights: np.ndarray = rays.y[-1] + rays.nu[-1] / rays.index[-1] * sensor_mm
        return heights

    def sharp_mm(self, tolerated_um: float) -> tuple[float, float] | None:
        """Return nearest and farthest depth with a blur within ``tolerated_um``; None if no real depth has one.

        The nearest is 0 where an object on the first surface is still sharp.
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
        """Return the depth to focus on so that infinity has just the tolerated blur; infinite for an afocal lens.

        The sensor then stands blur/(2|u′|) behind the rear focus.
        """
        focus = float(cardinal_points(self.lens, self.wavelength_um).back_focal_distance)
        at_focus, behind = (float(self.heights_mm(np.array([inf]), focus + step)[0]) for step in (0.0, 1.0))
        if not isfinite(focus) or behind == at_focus:
            return inf
        sensor = focus + self.lens.directions[-1] * tolerated_um / 2 / UM_PER_MM / abs(behind - at_focus)
        roots = self._roots(0.0, sensor)
        return 1 / roots[0] - self.entrance_mm if roots and roots[0] else inf

    def _roots(self, half_mm: float, sensor_mm: float | None = None) -> list[float]:
        """Return the two s at which |h| is ``half_mm``; none where the blur is the same at every depth."""
        far, one = self.heights_mm(np.array([inf, ELSEWHERE_MM]), sensor_mm)
        slope = (one - far) * (ELSEWHERE_MM + self.entrance_mm)
        return [float((side * half_mm - far) / slope) for side in (-1, 1)] if slope else []


def _real_depths(pupil: float) -> list[tuple[float, float]]:
    """Return the ranges of s in which the depth 1/s − pupil is positive, the one that ends at infinity first."""
    return [(0.0, 1 / pupil)] if pupil > 0 else [(0.0, inf), *([(-inf, 1 / pupil)] if pupil else [])]


def _depth(s: float, pupil: float) -> float:
    return max(0.0, 1 / s - pupil) if s else inf
