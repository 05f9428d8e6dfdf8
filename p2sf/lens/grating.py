"""Gratings in straight lines, whose rays go into one order of diffraction."""

from dataclasses import dataclass, replace
from math import cos, pi, radians, sin
from typing import TypeAlias

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.lens.shapes import Diffraction
from p2sf.messages import Message


@dataclass(frozen=True)
class Grating:
    """Lines parallel to x, evenly spaced in y of the plane at the vertex, also where the surface is curved.

    Rays go into ``order`` m: the optical cosine along y grows by mλ·``lines_per_mm`` (Welford 1986, §5.3; Ansys Zemax
    2024, "Diffraction Grating": n₂ sin θ₂ − n₁ sin θ₁ = mλT), that of a reflected ray as well. All light goes into this
    order. ``turn_deg``: the angle of the lines' own axes, from x towards y.
    """

    lines_per_mm: float
    order: float = 1.0
    turn_deg: float = 0.0

    radial = False
    normalisation_mm = 1.0
    mean = None
    """What paraxial rays see: the mean slope over all azimuths is 0."""

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return all numbers of the grating."""
        return self.lines_per_mm, self.order, self.turn_deg

    @property
    def name(self) -> Message:
        """Return its name in a word."""
        return Message("grating")

    @property
    def words(self) -> Message:
        """Return the description of the grating with numbers."""
        return Message(
            "grating: {lines:g} lines per mm, order {order:g}, turned by {angle:z.6g}°",
            lines=self.lines_per_mm,
            order=self.order,
            angle=self.turn_deg,
        )

    def phase_and_gradient(self, x: FloatOrArray, y: FloatOrArray) -> tuple[FloatOrArray, np.ndarray]:
        """Return the phase in radians and its derivatives in x and y, (2, …), per mm, at places in mm."""
        slope = 2 * pi * self.order * self.lines_per_mm
        across, up = -slope * sin(radians(self.turn_deg)), slope * cos(radians(self.turn_deg))
        phase = across * x + up * y
        flat = np.zeros_like(phase)
        return phase, np.stack([flat + across, flat + up])

    def path_terms(self, wavelength_um: FloatOrArray) -> tuple[FloatOrArray, FloatOrArray]:
        """Return the coefficients of r² and r⁴ of the added path, which has none."""
        return 0.0 * wavelength_um, 0.0 * wavelength_um

    def scaled(self, factor: float) -> "Grating":
        """Return the grating stretched ``factor`` times."""
        return replace(self, lines_per_mm=self.lines_per_mm / factor)

    def turned(self, angle_deg: float) -> "Grating":
        """Return the grating turned about the vertex, from x towards y."""
        return replace(self, turn_deg=self.turn_deg + angle_deg)


Phase: TypeAlias = Diffraction | Grating
