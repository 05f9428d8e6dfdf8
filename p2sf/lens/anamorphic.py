"""Shapes with a radius of their own in x and in y: biconics, toroids, and cylinders, whose one radius is infinite.

They are whole surfaces, added to a plane: a cylinder is wider than the sphere of its radius, so that a difference from
that sphere would end too early.
"""

from abc import abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from math import cos, inf, radians, sin
from typing import Any, ClassVar, Self

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.lens.shapes import Conic, RadialPolynomial, RadialShape, Series, Shape
from p2sf.messages import Message

MEAN_TERMS = 12  # of the azimuthal mean: r² to r²⁴
CIRCLE = np.exp(2j * np.pi * np.arange(64) / 64)  # of squared radii; terms beyond r¹²⁸ alias, some 4⁻⁶⁴
SMALLER = 4.0  # the circle of convergence over that of the samples
NO_TERMS: tuple[float, ...] = ()


def _curvature(radius: float) -> float:
    return 1 / radius if radius else inf


@dataclass(frozen=True, kw_only=True)
class Anamorphic(Shape):
    """A shape that is even in x and in y of its own axes, which stand at ``turn_deg``, from x towards y.

    ``radius_x``, ``radius_y``: radii of curvature at the vertex in the planes xz and yz, mm; ``conic_y``: the conic
    constant in yz. ``zemax``: the type in a .zmx and the names of its parameters from 1, after curvature and conic
    constant in yz; ``code_v``: the command in a .seq and those of its numbers, after the radius in yz.
    Coefficients follow the parameters of Zemax, and are A, B, … of CODE V, from y⁴ on.
    """

    radius_x: float = inf
    radius_y: float = inf
    conic_y: float = 0.0
    turn_deg: float = 0.0

    zemax: ClassVar[tuple[str, tuple[str, ...]]]
    code_v: ClassVar[tuple[str, dict[str, str]]]
    coefficients = NO_TERMS
    normalisation_mm = 1.0

    def __getstate__(self) -> dict:
        return {key: value for key, value in vars(self).items() if key in type(self).__dataclass_fields__}

    @property
    def curvatures(self) -> tuple[float, float]:
        """Return the curvatures at the vertex in xz and in yz, per mm."""
        return _curvature(self.radius_x), _curvature(self.radius_y)

    def curvature_at(self, azimuth_deg: float) -> float:
        """Return the curvature at the vertex, per mm, of the section at an azimuth, from +y towards +x (Euler)."""
        across, up = self.curvatures
        up += 2 * sum(self.coefficients[:1])  # of y²
        angle = radians(azimuth_deg + self.turn_deg)
        return across * sin(angle) ** 2 + up * cos(angle) ** 2

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return all numbers of the shape."""
        return (*self.curvatures, self.conic_y, self.turn_deg)

    @abstractmethod
    def sag_and_slopes(self, square_x: Any, square_y: Any) -> tuple[Any, Any, Any]:
        """Return the sag, mm, and dz/d(x²) and dz/d(y²), per mm, at squared coordinates of its own axes, mm²."""

    @property
    @abstractmethod
    def nearest_mm2(self) -> float:
        """Return a squared radius, mm², below which the sag is a power series in x² and y²."""

    def sag_and_gradient(
        self, x: FloatOrArray, y: FloatOrArray, curvature: float = 0.0, conic: float = 0.0
    ) -> tuple[FloatOrArray, np.ndarray]:
        """Return the sag, mm, and ∂z/∂x and ∂z/∂y, (2, …), at places in mm; NaN beyond its edge."""
        cosine, sine = cos(radians(self.turn_deg)), sin(radians(self.turn_deg))
        u, v = cosine * x + sine * y, cosine * y - sine * x
        sag, by_u, by_v = self.sag_and_slopes(u * u, v * v)
        across, up = 2 * by_u * u, 2 * by_v * v
        return sag, np.stack(np.broadcast_arrays(cosine * across - sine * up, sine * across + cosine * up))

    @cached_property
    def mean(self) -> RadialShape | None:
        """Return the azimuthal mean as a polynomial in r; None for a plane.

        Its coefficients are integrals over a circle of complex r² about the vertex (Cauchy), summed over azimuths.
        """
        if not any((*self.curvatures, *self.coefficients)):
            return None
        azimuth = np.pi * np.arange(len(CIRCLE))[:, None] / len(CIRCLE)
        square = self.nearest_mm2 / SMALLER
        sag, _, _ = self.sag_and_slopes(square * CIRCLE * np.cos(azimuth) ** 2, square * CIRCLE * np.sin(azimuth) ** 2)
        terms = np.fft.fft(sag.mean(axis=0)).real[1 : MEAN_TERMS + 1] / len(CIRCLE)
        return RadialPolynomial(tuple(x for term in terms.tolist() for x in (0.0, term)), float(np.sqrt(square)))

    def series(self, curvature: float) -> Series:
        """Return the coefficients of r … r⁴ of the azimuthal mean."""
        return self.mean.series(curvature) if self.mean else (0.0, 0.0, 0.0, 0.0)

    def turned(self, angle_deg: float) -> Self:
        """Return the shape turned about the vertex, from x towards y."""
        return replace(self, turn_deg=self.turn_deg + angle_deg)

    def scaled(self, factor: float) -> Self:
        """Return the shape ``factor`` times as large."""
        return replace(self, radius_x=self.radius_x * factor, radius_y=self.radius_y * factor)

    @property
    def words(self) -> Message:
        """Return the description of the shape with numbers."""
        return Message(
            "{kind}: radii {x:g} mm in x and {y:g} mm in y, conic constants {conics:g}, turned by {angle:g}°",
            kind=self.name,
            x=self.radius_x,
            y=self.radius_y,
            conics=self.conics,
            angle=self.turn_deg,
        )

    @property
    def conics(self) -> tuple[float, ...]:
        """Return the conic constants."""
        return (self.conic_y,)


@dataclass(frozen=True, kw_only=True)
class Biconic(Anamorphic):
    """A conic in xz and another in yz (Ansys Zemax 2024, "Biconic").

    z = (c_x x² + c_y y²)/(1 + √(1 − (1 + K_x)c_x²x² − (1 + K_y)c_y²y²)), ``conic_x``: K_x.
    """

    conic_x: float = 0.0
    endings = frozenset((".toml", ".zmx", ".seq"))
    zemax = "BICONICX", ("radius_x", "conic_x")
    code_v = "AAS", {"RDX": "radius_x", "KX": "conic_x", "KY": "conic_y"}
    kind = "biconic"
    name = Message("biconic")

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return all numbers of the shape."""
        return (self.conic_x, *super().numbers)

    @property
    def conics(self) -> tuple[float, ...]:
        """Return the conic constants."""
        return self.conic_x, self.conic_y

    @property
    def nearest_mm2(self) -> float:
        """Return the squared radius of the nearest edge, mm²; of paraboloids that of their curvature."""
        squares = [(c * c, k) for c, k in zip(self.curvatures, self.conics, strict=True)]
        return 1 / max(square * max(abs(1 + k), 1.0) for square, k in squares)

    def sag_and_slopes(self, square_x: Any, square_y: Any) -> tuple[Any, Any, Any]:
        """Return the sag and dz/d(x²), dz/d(y²)."""
        a, b = self.curvatures
        steep_x, steep_y = (1 + self.conic_x) * a * a, (1 + self.conic_y) * b * b
        rise = a * square_x + b * square_y
        root = np.sqrt(1 - steep_x * square_x - steep_y * square_y)
        below = 1 + root
        bend = rise / (2 * root * below * below)
        return rise / below, a / below + bend * steep_x, b / below + bend * steep_y


@dataclass(frozen=True, kw_only=True)
class Toroid(Anamorphic):
    """A curve in yz that is turned about an axis along y at z = ``radius_x`` (Ansys Zemax 2024, "Toroidal").

    The curve is g(y) = c_y y²/(1 + √(1 − (1 + K_y)c_y²y²)) + α₁y² + α₂y⁴ + …, ``coefficients``: α₁, α₂, … in mm⁻¹,
    mm⁻³ and so on. An infinite ``radius_x`` makes it a cylinder.
    """

    coefficients: tuple[float, ...] = ()
    endings = frozenset((".toml", ".zmx", ".seq"))
    zemax = "TOROIDAL", ("radius_x",)
    code_v = "YTO", {"RDX": "radius_x", "K": "conic_y"}
    kind = "toroid"
    name = Message("toroid")

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return all numbers of the shape."""
        return (*self.coefficients, *super().numbers)

    @property
    def nearest_mm2(self) -> float:
        """Return a squared radius, mm², where neither the curve nor the circle about the axis is near its edge."""
        (a, b), k = self.curvatures, self.conic_y
        square = 1 / max(abs(1 + k) * b * b, a * a, b * b, 1e-30) / 4
        while abs(a) * sum(abs(alpha) * square**power for power, alpha in enumerate(self.coefficients, 1)) > 0.1:
            square /= 2
        return square

    def sag_and_slopes(self, square_x: Any, square_y: Any) -> tuple[Any, Any, Any]:
        """Return the sag and dz/d(x²), dz/d(y²): z = (2g − ρg² + ρx²)/(1 + √((1 − ρg)² − ρ²x²)), ρ = 1/radius_x."""
        rho, curve = self.curvatures[0], Conic(self.curvatures[1], self.conic_y)
        g, slope = curve.sag_and_slope(square_y)
        for power, alpha in enumerate(self.coefficients, 1):
            g, slope = g + alpha * square_y**power, slope + power * alpha * square_y ** (power - 1)
        near = 1 - rho * g
        root = np.sqrt(near * near - rho * rho * square_x)
        return (2 * g - rho * g * g + rho * square_x) / (1 + root), rho / (2 * root), slope * near / root

    def scaled(self, factor: float) -> "Toroid":
        """Return the shape ``factor`` times as large."""
        terms = tuple(alpha * factor ** (1 - 2 * power) for power, alpha in enumerate(self.coefficients, 1))
        return replace(super().scaled(factor), coefficients=terms)

    @property
    def words(self) -> Message:
        """Return the description of the shape with numbers."""
        if not self.coefficients:
            return super().words
        return Message("{shape}, terms in y², y⁴, … {terms:.6g}", shape=super().words, terms=self.coefficients)
