"""Astigmatic figure error of a surface: Zernike astigmatism added to its sag."""

from dataclasses import dataclass, replace
from math import cos, hypot, radians, sin

import numpy as np

from p2sf.conventions import UM_PER_MM, FloatOrArray
from p2sf.lens.shapes import Part
from p2sf.messages import Message

# A fringe is a deviation of the surface that changes the reflected wavefront by one wavelength (ISO 14999-4): half a
# wave of sag, here of the green line of mercury.
FRINGE_MM = 0.54607 / 2 / UM_PER_MM


@dataclass(frozen=True)
class Irregularity(Part):
    """Departure of a surface from rotational symmetry: Zernike's Z(2, ±2), astigmatism, added to its sag.

    z = (F/2)·(N·(y² − x²) + N₄₅·2xy)/R² with fringes F of 273 nm: peak to valley over the disc of radius R it is √(N² +
    N₄₅²) fringes.

    Parameters
    ----------
    fringes : float
        N: the surface is raised towards +z along +y and −y and lowered along x; the reverse if negative.
    fringes_45 : float
        N₄₅: the same along x = y and x = −y.
    normalisation_mm : float
        R, usually the clear radius, mm.
    """

    fringes: float
    fringes_45: float
    normalisation_mm: float

    @property
    def numbers(self) -> tuple[float, float, float]:
        """Return all its numbers."""
        return self.fringes, self.fringes_45, self.normalisation_mm

    @property
    def words(self) -> Message:
        """Return its description with numbers."""
        return Message(
            "irregular: {fringes:g} fringes, at 45° {turned:g}, over a radius of {radius:g} mm",
            fringes=self.fringes,
            turned=self.fringes_45,
            radius=self.normalisation_mm,
        )

    @property
    def idle(self) -> bool:
        """Return whether it has no effect."""
        return not (self.fringes or self.fringes_45)

    @property
    def peak_to_valley(self) -> float:
        """Return the peak-to-valley value in fringes."""
        return hypot(self.fringes, self.fringes_45)

    def sag_and_gradient(
        self, x: FloatOrArray, y: FloatOrArray, curvature: float = 0.0, conic: float = 0.0
    ) -> tuple[FloatOrArray, np.ndarray]:
        """Return the added sag, mm, and ∂z/∂x and ∂z/∂y, (2, …), at points in mm."""
        upright, turned = self.terms
        gradient = 2 * np.stack([turned * y - upright * x, upright * y + turned * x])
        return upright * (y * y - x * x) + 2 * turned * x * y, gradient

    @property
    def terms(self) -> tuple[float, float]:
        """Return the coefficients of y² − x² and of 2xy, per mm."""
        unit = FRINGE_MM / 2 / self.normalisation_mm**2
        return unit * self.fringes, unit * self.fringes_45

    def turned(self, angle_deg: float) -> "Irregularity":
        """Return it turned about the vertex, from x towards y."""
        cosine, sine = cos(radians(2 * angle_deg)), sin(radians(2 * angle_deg))
        upright = cosine * self.fringes + sine * self.fringes_45
        return replace(self, fringes=upright, fringes_45=cosine * self.fringes_45 - sine * self.fringes)

    def scaled(self, factor: float) -> "Irregularity":
        """Return it scaled from lengths in units of ``factor`` mm to mm."""
        return replace(self, normalisation_mm=self.normalisation_mm * factor)

    def added(self, fringes: float, fringes_45: float, normalisation_mm: float) -> "Irregularity":
        """Return the sum of this and another irregularity over a disc of its own."""
        share = (self.normalisation_mm / normalisation_mm) ** 2
        return replace(self, fringes=self.fringes + share * fringes, fringes_45=self.fringes_45 + share * fringes_45)
