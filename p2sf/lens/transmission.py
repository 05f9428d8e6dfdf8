"""The share of light that a surface passes, which may change with the height: a coating, a filter that is shaded."""

from dataclasses import dataclass, replace

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.messages import Message


@dataclass(frozen=True)
class Transmission:
    """What a surface passes, or a mirror reflects, of the energy of a ray that meets it at height h: t₀ + t₂h².

    Where that is negative nothing passes.

    Parameters
    ----------
    vertex : float
        t₀, from 0 to 1.
    per_mm2 : float
        t₂, per mm²; negative where less passes towards the rim.
    """

    vertex: float = 1.0
    per_mm2: float = 0.0

    @property
    def numbers(self) -> tuple[float, float]:
        """Return both numbers."""
        return self.vertex, self.per_mm2

    @property
    def words(self) -> Message:
        """Return it in numbers."""
        return Message("transmission {vertex:g} + {slope:g} mm⁻²·h²", vertex=self.vertex, slope=self.per_mm2)

    def at(self, square: FloatOrArray) -> FloatOrArray:
        """Return the share of energy that passes at squared heights, mm²."""
        share: FloatOrArray = np.maximum(self.vertex + self.per_mm2 * square, 0.0)
        return share

    def scaled(self, factor: float) -> "Transmission":
        """Return it with lengths in units ``factor`` mm long, in mm."""
        return replace(self, per_mm2=self.per_mm2 / factor**2)
