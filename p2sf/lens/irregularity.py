"""A surface that was ground as a cylinder by mistake: Zernike's astigmatism, added to its sag."""

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
    """How far a surface is from one of revolution: Zernike's Z(2, ±2), astigmatism, on top of its sag.

    z = (F/2)·(N·(y² − x²) + N₄₅·2xy)/R² with fringes F of 273 nm: over the disc of radius R, √(N² + N₄₅²) fringes from
    its highest to its lowest points.

    Parameters
    ----------
    fringes : float
        N: along +y and −y the surface is raised towards +z, along x lowered; where negative the other way round.
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
        """Return every number of it."""
        return self.fringes, self.fringes_45, self.normalisation_mm

    @property
    def words(self) -> Message:
        """Return it in numbers."""
        return Message(
            "irregular: {fringes:g} fringes, at 45° {turned:g}, over a radius of {radius:g} mm",
            fringes=self.fringes,
            turned=self.fringes_45,
            radius=self.normalisation_mm,
        )

    @property
    def idle(self) -> bool:
        """Return whether there is none."""
        return not (self.fringes or self.fringes_45)

    @property
    def peak_to_valley(self) -> float:
        """Return how many fringes the highest point is above the lowest."""
        return hypot(self.fringes, self.fringes_45)

    def sag_and_gradient(
        self, x: FloatOrArray, y: FloatOrArray, curvature: float = 0.0, conic: float = 0.0
    ) -> tuple[FloatOrArray, np.ndarray]:
        """Return what it adds to the sag, mm, and to ∂z/∂x and ∂z/∂y, (2, …), at places in mm."""
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
        """Return it with its radius in units ``factor`` mm long, in mm."""
        return replace(self, normalisation_mm=self.normalisation_mm * factor)

    def added(self, fringes: float, fringes_45: float, normalisation_mm: float) -> "Irregularity":
        """Return this one and another over a disc of its own, as one."""
        share = (self.normalisation_mm / normalisation_mm) ** 2
        return replace(self, fringes=self.fringes + share * fringes, fringes_45=self.fringes_45 + share * fringes_45)
