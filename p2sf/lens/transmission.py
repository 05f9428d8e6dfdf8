"""Transmission of a surface, which may vary with the height: a coating or a graded filter."""

from dataclasses import dataclass, replace

from p2sf.conventions import FloatOrArray
from p2sf.messages import Message


@dataclass(frozen=True)
class Transmission:
    """Share of a ray's energy that a surface transmits, or a mirror reflects, at height h: t₀ + t₂h².

    Where that is negative, it stops rays as a rim does.

    Parameters
    ----------
    vertex : float
        t₀, from 0 to 1.
    per_mm2 : float
        t₂, per mm²; negative if the transmission decreases towards the rim.
    """

    vertex: float = 1.0
    per_mm2: float = 0.0

    @property
    def numbers(self) -> tuple[float, float]:
        """Return both numbers."""
        return self.vertex, self.per_mm2

    @property
    def words(self) -> Message:
        """Return its description with numbers."""
        return Message("transmission {vertex:g} + {slope:g} mm⁻²·h²", vertex=self.vertex, slope=self.per_mm2)

    def at(self, square: FloatOrArray) -> FloatOrArray:
        """Return the transmitted share of energy at squared heights, mm²; it is negative where rays are stopped."""
        return self.vertex + self.per_mm2 * square

    @property
    def opaque(self) -> bool:
        """Return whether no ray passes at any height."""
        return self.vertex <= 0 and self.per_mm2 <= 0

    def scaled(self, factor: float) -> "Transmission":
        """Return it scaled from lengths in units of ``factor`` mm to mm."""
        return replace(self, per_mm2=self.per_mm2 / factor**2)
