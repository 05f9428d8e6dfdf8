"""Clear apertures that are not centred circles: decentred and rectangular ones."""

from dataclasses import dataclass, replace
from math import cos, isfinite, radians, sin

import numpy as np

from p2sf.errors import GeometryError
from p2sf.messages import Message


@dataclass(frozen=True)
class Rim:
    """Position of a clear aperture and, if it is a rectangle, its size.

    It matters where rims clip. A circle has the surface's ``semi_diameter`` as its radius, a hole its ``inner_radius``.

    Parameters
    ----------
    decentre : (float, float)
        The centre, x and y in mm from the vertex.
    half_widths : (float, float), optional
        Half of a rectangle's sides along x and y, mm; a circle if not given.
    turn_deg : float
        Rotation of the rectangle about its centre, degrees from x towards y.
    """

    decentre: tuple[float, float] = (0.0, 0.0)
    half_widths: tuple[float, float] | None = None
    turn_deg: float = 0.0

    def about_centre(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return coordinates relative to the centre along the sides, mm."""
        across, up = x - self.decentre[0], y - self.decentre[1]
        if not self.turn_deg:
            return across, up
        cosine, sine = cos(radians(self.turn_deg)), sin(radians(self.turn_deg))
        return cosine * across + sine * up, cosine * up - sine * across

    def turned(self, angle_deg: float) -> "Rim":
        """Return the rim turned about the vertex, from x towards y."""
        cosine, sine, (x, y) = cos(radians(angle_deg)), sin(radians(angle_deg)), self.decentre
        centre = cosine * x - sine * y, cosine * y + sine * x
        return replace(self, decentre=centre, turn_deg=self.turn_deg + angle_deg if self.half_widths else 0.0)

    def scaled(self, factor: float) -> "Rim":
        """Return the rim scaled from lengths in units of ``factor`` mm to mm."""
        sides = (self.half_widths[0] * factor, self.half_widths[1] * factor) if self.half_widths else None
        return replace(self, decentre=(self.decentre[0] * factor, self.decentre[1] * factor), half_widths=sides)

    @property
    def words(self) -> Message:
        """Return the description of the rim with numbers."""
        if self.half_widths is None:
            return Message("rim about ({centre:g}) mm", centre=self.decentre)
        return Message(
            "rectangular rim about ({centre:g}) mm, half-widths {widths:g} mm, turned by {turn:g}°",
            centre=self.decentre,
            widths=self.half_widths,
            turn=self.turn_deg,
        )

    def check(self, surface: int) -> None:
        """Raise GeometryError for invalid numbers; ``surface`` counts from 1."""
        finite = all(map(isfinite, (*self.decentre, self.turn_deg)))
        if not (finite and all(side > 0 for side in self.half_widths or ())):
            raise GeometryError(
                "surface {surface}: its rim has the centre ({centre:g}) mm and the half-widths {widths}; give finite "
                "numbers, and positive widths",
                surface=surface,
                centre=self.decentre,
                widths=self.half_widths or "–",
            )
