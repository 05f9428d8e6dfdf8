"""The parts of revolution whose sags add up to that of a surface: a conic, even terms, and further shapes.

Every part provides its sag and dz/d(r²) at squared radii r², mm², and its power series at the vertex, which determines
first and third order. Lengths are mm. `freeform` and `irregularity` contain the parts that are not of revolution.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import comb, fsum, sqrt
from typing import Any, ClassVar, Self, TypeAlias

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.messages import Message

SagAndSlope: TypeAlias = tuple[FloatOrArray, FloatOrArray]
Series: TypeAlias = tuple[float, float, float, float]
"""Coefficients of r, r², r³ and r⁴, mm⁰ … mm⁻³."""


class Part(ABC):
    """A term in the sag of a surface; ``curvature`` and ``conic`` are those of the conic to which parts are added."""

    radial: ClassVar[bool] = False
    """Whether the part is of revolution about the axis."""

    @property
    def addends_mm(self) -> float:
        """Return the magnitude of the addends of the sag, mm; 0 if the sag is about as large."""
        return 0.0

    @abstractmethod
    def sag_and_gradient(
        self, x: FloatOrArray, y: FloatOrArray, curvature: float = 0.0, conic: float = 0.0
    ) -> tuple[FloatOrArray, np.ndarray]:
        """Return the sag, mm, and ∂z/∂x and ∂z/∂y, (2, …), at places in mm."""

    @abstractmethod
    def turned(self, angle_deg: float) -> Self:
        """Return the part turned about the vertex, from x towards y."""

    @abstractmethod
    def scaled(self, factor: float) -> Self:
        """Return the part scaled from lengths in units of ``factor`` mm to mm."""


class RadialPart(Part):
    """A part of revolution: a function of r² alone."""

    radial = True

    @abstractmethod
    def sag_and_slope(self, square: FloatOrArray, curvature: float = 0.0, conic: float = 0.0) -> SagAndSlope:
        """Return the sag, mm, and dz/d(r²), per mm, at squared radii, mm²."""

    def sag_and_gradient(
        self, x: FloatOrArray, y: FloatOrArray, curvature: float = 0.0, conic: float = 0.0
    ) -> tuple[FloatOrArray, np.ndarray]:
        """Return the sag, mm, and ∂z/∂x and ∂z/∂y, (2, …), at places in mm."""
        sag, slope = self.sag_and_slope(x * x + y * y, curvature, conic)
        return sag, np.stack(np.broadcast_arrays(2 * slope * x, 2 * slope * y))

    def turned(self, angle_deg: float) -> Self:
        """Return the part itself."""
        return self


@dataclass(frozen=True)
class Conic(RadialPart):
    """A sphere, or another conic of revolution: cr²/(1 + √(1 − (1 + K)c²r²)).

    ``curvature``: c, per mm; ``constant``: K.
    """

    curvature: float
    constant: float = 0.0

    def sag_and_slope(self, square: FloatOrArray, curvature: float = 0.0, conic: float = 0.0) -> SagAndSlope:
        """Return the sag and dz/d(r²); NaN beyond the edge."""
        c = self.curvature
        root = np.sqrt(1 - (1 + self.constant) * (c * c) * square)
        return c * square / (1 + root), c / (2 * root)

    def scaled(self, factor: float) -> "Conic":
        """Return the conic ``factor`` times as large."""
        return Conic(self.curvature / factor, self.constant)


@dataclass(frozen=True)
class EvenTerms(RadialPart):
    """Terms A₄r⁴ + A₆r⁶ + …; ``coefficients``: A₄, A₆, … in mm⁻³, mm⁻⁵ and so on."""

    coefficients: tuple[float, ...]

    def sag_and_slope(self, square: FloatOrArray, curvature: float = 0.0, conic: float = 0.0) -> SagAndSlope:
        """Return the sag and dz/d(r²)."""
        value: FloatOrArray = self.coefficients[-1]
        slope: FloatOrArray = 0.0
        for coefficient in self.coefficients[-2::-1]:
            slope = slope * square + value
            value = value * square + coefficient
        fourth = square * value
        return square * fourth, 2 * fourth + square * square * slope

    def scaled(self, factor: float) -> "EvenTerms":
        """Return the terms ``factor`` times as large."""
        return EvenTerms(tuple(a * factor ** -(2 * k + 3) for k, a in enumerate(self.coefficients)))


class Shape(Part):
    """A part besides the conic and even terms: polynomials over a normalisation radius."""

    coefficients: tuple[float, ...]
    normalisation_mm: float
    endings: ClassVar[frozenset[str]] = frozenset()
    """Of the lens files that have a type for it; each class states its own, as files would hold another shape."""
    ends: ClassVar[bool] = False
    """Whether its polynomials describe a surface only up to the normalisation radius."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.endings = cls.__dict__.get("endings", frozenset())

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return all numbers of the shape."""
        return (*self.coefficients, self.normalisation_mm)

    @property
    @abstractmethod
    def kind(self) -> str:
        """Return the type in a lens file in TOML, one of `SHAPES`."""

    @property
    @abstractmethod
    def name(self) -> Message:
        """Return the name of the shape in OpticStudio."""

    @property
    def stated(self) -> tuple[float, ...]:
        """Return the coefficients as listed in files and descriptions."""
        return self.coefficients

    @property
    def words(self) -> Message:
        """Return the description of the shape with numbers."""
        return Message(
            "{kind}: normalisation radius {radius:g} mm, coefficients {numbers:.6g} mm",
            kind=self.name,
            radius=self.normalisation_mm,
            numbers=self.stated,
        )

    @property
    def powers(self) -> dict[int, float] | None:
        """Return the coefficients of the powers of r over the normalisation radius, mm; None for other polynomials."""
        return None

    @property
    @abstractmethod
    def mean(self) -> "RadialShape | None":
        """Return the azimuthal mean of the shape, which acts on paraxial rays; None for a plane."""

    @abstractmethod
    def series(self, curvature: float) -> Series:
        """Return the coefficients of r … r⁴ of the azimuthal mean, on a base of this curvature, per mm."""

    @abstractmethod
    def curvature_at(self, azimuth_deg: float) -> float:
        """Return what the shape adds to the curvature at the vertex, per mm, of the section at an azimuth.

        Azimuths count from +y towards +x.
        """


class RadialShape(RadialPart, Shape):
    """A shape of revolution."""

    @property
    def mean(self) -> "RadialShape | None":
        """Return the shape itself."""
        return self

    def curvature_at(self, azimuth_deg: float) -> float:
        """Return the curvature at the vertex, per mm, which is the same at every azimuth."""
        return 2 * self.series(0.0)[1]


@dataclass(frozen=True)
class RadialPolynomial(RadialShape):
    """Terms Σ aₖρᵏ, k = 1, 2, 3 …, of ρ = r/``normalisation_mm``, as in OpticStudio's odd and extended aspheres.

    ``coefficients``: a₁, a₂, …, mm. With a normalisation radius of 1 mm they are the coefficients of powers of r in mm.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float = 1.0
    endings = frozenset((".toml", ".zmx", ".seq", ".json"))

    @property
    def odd(self) -> tuple[float, ...]:
        """Return the coefficients of odd powers."""
        return self.coefficients[::2]

    @property
    def kind(self) -> str:
        """Return the type in a lens file in TOML: powers of r itself, of ρ, or of ρ²."""
        if self.normalisation_mm == 1:
            return ODD
        return EXTENDED_ODD if any(self.odd) or len(self.coefficients) % 2 else EXTENDED

    @property
    def name(self) -> Message:
        """Return the name of the shape in OpticStudio."""
        if self.kind == ODD:
            return Message("odd asphere")
        return Message("extended asphere") if self.kind == EXTENDED else Message("extended odd asphere")

    @property
    def stated(self) -> tuple[float, ...]:
        """Return the coefficients as listed in files: only even powers for an extended asphere."""
        return self.coefficients[1::2] if self.kind == EXTENDED else self.coefficients

    @property
    def words(self) -> Message:
        """Return the description of the shape with numbers."""
        if self.kind == ODD:
            return Message("odd asphere: coefficients of r, r², … in mm {numbers:.6g}", numbers=self.coefficients)
        return super().words

    @property
    def powers(self) -> dict[int, float] | None:
        """Return the coefficients of the powers of ρ, mm."""
        return dict(enumerate(self.coefficients, 1))

    def sag_and_slope(self, square: FloatOrArray, curvature: float = 0.0, conic: float = 0.0) -> SagAndSlope:
        """Return the sag and dz/d(r²); at the vertex a term in ρ has the azimuthal mean of its slope, 0."""
        scale = self.normalisation_mm**-2
        u = square * scale
        sag, slope = _even_terms(self.coefficients[1::2], u)
        if any(self.odd):
            rho = np.sqrt(u)
            odd, odd_slope = _horner(self.odd, u)
            sag = sag + rho * odd
            with np.errstate(divide="ignore", invalid="ignore"):  # the vertex of a cone
                slope = slope + np.where(u == 0, 0.0, odd / (2 * rho)) + rho * odd_slope
        return sag, slope * scale

    def series(self, curvature: float) -> Series:
        """Return the coefficients of r … r⁴."""
        first = (*self.coefficients, 0.0, 0.0, 0.0, 0.0)[:4]
        a, b, c, d = (value / self.normalisation_mm**power for power, value in enumerate(first, 1))
        return a, b, c, d

    def scaled(self, factor: float) -> "RadialPolynomial":
        """Return the shape ``factor`` times as large; powers of r in mm remain such."""
        if self.kind == ODD:
            return RadialPolynomial(tuple(a * factor ** (1 - k) for k, a in enumerate(self.coefficients, 1)))
        return RadialPolynomial(_times(self.coefficients, factor), self.normalisation_mm * factor)


@dataclass(frozen=True)
class Qcon(RadialShape):
    """Forbes's u⁴Σ aₘQₘ(u²), the departure of the sag from a conic, u = r/``normalisation_mm`` (Forbes 2007).

    ``coefficients``: a₀, a₁, …, mm. Qₘ(x) = P⁽⁰⁴⁾ₘ(2x − 1), Jacobi polynomials.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float
    endings = frozenset((".toml", ".zmx", ".seq", ".json"))
    ends = True
    kind = "Qcon"
    name = Message("Qcon asphere")

    @property
    def powers(self) -> dict[int, float] | None:
        """Return the coefficients of ρ⁴, ρ⁶, …, mm."""
        return {4 + 2 * k: a for k, a in enumerate(self.scaled_terms())}

    def sag_and_slope(self, square: FloatOrArray, curvature: float = 0.0, conic: float = 0.0) -> SagAndSlope:
        """Return the sag and dz/d(r²)."""
        x = square / self.normalisation_mm**2
        value, derivative = clenshaw(self.coefficients, jacobi_steps(len(self.coefficients), 4), x)
        return x * x * value, x * (2 * value + x * derivative) / self.normalisation_mm**2

    def series(self, curvature: float) -> Series:
        """Return the coefficients of r … r⁴."""
        return 0.0, 0.0, 0.0, (*self.even_terms(), 0.0)[0]

    def scaled_terms(self) -> tuple[float, ...]:
        """Return the coefficients of u⁴, u⁶, …, mm, of the same surface; rounding errors grow with each term."""
        columns = _jacobi_powers(len(self.coefficients))
        return tuple(fsum(a * c for a, c in zip(self.coefficients, column, strict=True)) for column in columns)

    def even_terms(self) -> tuple[float, ...]:
        """Return A4, A6, …, mm⁻³, mm⁻⁵, …, of the same surface."""
        return tuple(a / self.normalisation_mm ** (4 + 2 * k) for k, a in enumerate(self.scaled_terms()))

    def scaled(self, factor: float) -> "Qcon":
        """Return the shape ``factor`` times as large."""
        return Qcon(_times(self.coefficients, factor), self.normalisation_mm * factor)


@dataclass(frozen=True)
class Qbfs(RadialShape):
    """Forbes's u²(1 − u²)/cos·Σ aₘQₘ(u²) over the best-fit sphere or conic, u = r/``normalisation_mm`` (Forbes 2007).

    cos is that of the angle between the base's normal and the axis, √(1 − c²r²) for a sphere, so that the departure is
    along the normal; OpticStudio applies it to a conic too. ``coefficients``: a₀, a₁, …, mm: the sum of their squares
    is the mean square slope of that departure, which vanishes at the vertex and at r = ``normalisation_mm``. All terms
    contain r², so that the curvature at the vertex differs from that of the base.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float
    endings = frozenset((".toml", ".zmx"))
    ends = True
    kind = "Qbfs"
    name = Message("Qbfs asphere")

    def sag_and_slope(self, square: FloatOrArray, curvature: float = 0.0, conic: float = 0.0) -> SagAndSlope:
        """Return the sag and dz/d(r²) over a conic of this curvature, per mm; NaN beyond its edge."""
        scale, bend = self.normalisation_mm**-2, curvature * curvature
        x = square * scale
        value, derivative = _slope_orthogonal(self.coefficients, x)
        # cos² = above/below: the slope of a conic is cr/√below.
        below, above = 1 - (1 + conic) * bend * square, 1 - conic * bend * square
        departure, change = x * (1 - x) * value, (1 - 2 * x) * value + x * (1 - x) * derivative
        secant = np.sqrt(above / below)
        steeper = bend / 2 * ((1 + conic) / below - conic / above)
        return departure * secant, (change * scale + departure * steeper) * secant

    def series(self, curvature: float) -> Series:
        """Return the coefficients of r … r⁴ over a sphere or any other conic of this curvature, per mm."""
        value, derivative = (float(v) for v in _slope_orthogonal(self.coefficients, 0.0))
        square = self.normalisation_mm**2
        fourth = (derivative - value) / square + value * curvature * curvature / 2
        return 0.0, value / square, 0.0, fourth / square

    def scaled(self, factor: float) -> "Qbfs":
        """Return the shape ``factor`` times as large."""
        return Qbfs(_times(self.coefficients, factor), self.normalisation_mm * factor)


ODD, EXTENDED_ODD, EXTENDED = "odd asphere", "extended odd asphere", "extended asphere"


@dataclass(frozen=True)
class Diffraction:
    """The phase m·Σ Aⱼρ²ʲ of a diffractive surface of revolution, OpticStudio's binary 2.

    ``coefficients``: A₁, A₂, …, radians, of powers of ρ = r/``normalisation_mm``; ``order``: m, the order of
    diffraction. The phase added to a ray is the same at every wavelength, so that its path grows by λ/2π times the
    phase; all light goes into this one order.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float
    order: float = 1.0

    radial = True
    name = Message("diffractive")

    @property
    def mean(self) -> "Diffraction":
        """Return the phase itself, which is of revolution."""
        return self

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return all numbers of the phase."""
        return (*self.coefficients, self.normalisation_mm, self.order)

    @property
    def words(self) -> Message:
        """Return the description of the phase with numbers."""
        return Message(
            "diffracts in order {order:g}: normalisation radius {radius:g} mm, phase in rad of ρ², ρ⁴, … {numbers:.6g}",
            order=self.order,
            radius=self.normalisation_mm,
            numbers=self.coefficients,
        )

    def phase_and_slope(self, square: FloatOrArray) -> SagAndSlope:
        """Return the phase in radians and its derivative with respect to r², per mm², at squared radii in mm²."""
        scale = self.normalisation_mm**-2
        phase, slope = _even_terms(self.coefficients, square * scale)
        return phase * self.order, slope * (self.order * scale)

    def phase_and_gradient(self, x: FloatOrArray, y: FloatOrArray) -> tuple[FloatOrArray, np.ndarray]:
        """Return the phase in radians and its derivatives in x and y, (2, …), per mm, at places in mm."""
        phase, slope = self.phase_and_slope(x * x + y * y)
        return phase, np.stack(np.broadcast_arrays(2 * slope * x, 2 * slope * y))

    def path_terms(self, wavelength_um: FloatOrArray) -> tuple[FloatOrArray, FloatOrArray]:
        """Return the coefficients of r² and r⁴ of the added path, mm⁻¹ and mm⁻³."""
        second, fourth = (*self.coefficients, 0.0, 0.0)[:2]
        unit = wavelength_um * (self.order * WAVES_MM)
        return unit * (second / self.normalisation_mm**2), unit * (fourth / self.normalisation_mm**4)

    def turned(self, angle_deg: float) -> "Diffraction":
        """Return the phase itself."""
        return self

    def scaled(self, factor: float) -> "Diffraction":
        """Return the phase stretched to ``factor`` times the radius."""
        return replace(self, normalisation_mm=self.normalisation_mm * factor)


WAVES_MM = 1e-3 / (2 * np.pi)  # path in mm of one radian at 1 µm


def _times(values: tuple[float, ...], factor: float) -> tuple[float, ...]:
    return tuple(value * factor for value in values)


def _horner(coefficients: tuple[float, ...], x: FloatOrArray) -> SagAndSlope:
    """Return Σ cⱼxʲ, j = 0, 1, …, and its derivative."""
    value: FloatOrArray = 0.0 * x
    slope: FloatOrArray = 0.0 * x
    for coefficient in reversed(coefficients):
        slope = slope * x + value
        value = value * x + coefficient
    return value, slope


def _even_terms(coefficients: tuple[float, ...], x: FloatOrArray) -> SagAndSlope:
    """Return Σ cⱼxʲ, j = 1, 2, …, and its derivative."""
    value, slope = _horner(coefficients, x)
    return x * value, value + x * slope


Steps: TypeAlias = tuple[tuple[float, float, float], ...]
"""(α, β, γ) of the recurrences Pₘ = (α + βx)Pₘ₋₁ + γPₘ₋₂, m = 1, 2, …"""


def clenshaw(coefficients: Sequence[complex], steps: Steps, x: FloatOrArray) -> tuple[Any, Any]:
    """Return Σ cₘPₘ(x), P₀ = 1, and its derivative by Clenshaw's recurrence, which is stable on 0 ≤ x ≤ 1.

    Both are complex where the coefficients are.
    """
    none: Any = 0.0 * x
    value, value_next, slope, slope_next = none, none, none, none
    after = 0.0
    for coefficient, (alpha, beta, gamma) in zip(reversed(coefficients), reversed(steps), strict=True):
        factor = alpha + beta * x
        slope, slope_next = factor * slope + beta * value + after * slope_next, slope
        value, value_next = coefficient + factor * value + after * value_next, value
        after = gamma
    return value, slope


@lru_cache(maxsize=64)
def jacobi_steps(count: int, beta: int) -> Steps:
    """Return the coefficients of the recurrence of P⁽⁰ᵝ⁾ₘ(2x − 1) (Abramowitz and Stegun 1964, ch. 22)."""
    steps = [(-(beta + 1.0), beta + 2.0, 0.0)]
    for m in range(2, count + 1):
        s, scale = 2 * m + beta, 1 / (2 * m * (m + beta) * (2 * m + beta - 2))
        along = scale * (s - 1) * s * (s - 2)
        steps.append((-along - beta**2 * scale * (s - 1), 2 * along, -2 * scale * (m - 1) * (m + beta - 1) * s))
    return tuple(steps[:count])


@lru_cache(maxsize=32)
def _jacobi_powers(count: int) -> tuple[tuple[int, ...], ...]:
    """Return for each power k of x the integers (−1)^(m+k)·C(m, k)·C(m + k + 4, m) in P⁽⁰⁴⁾ₘ(2x − 1), m < count."""
    return tuple(tuple((-1) ** (m + k) * comb(m, k) * comb(m + k + 4, m) for m in range(count)) for k in range(count))


SLOPE_STEPS = (3.0, -4.0, 0.0), (2.0, -4.0, -1.0)  # of the first and of every later auxiliary polynomial


def _slope_orthogonal(coefficients: tuple[float, ...], x: FloatOrArray) -> SagAndSlope:
    """Return Σ aₘQₘ(x) of Qbfs and its derivative, by auxiliary polynomials (Forbes 2010, appendix A).

    P₀ = 2, P₁ = 6 − 8x, Pₘ = (2 − 4x)Pₘ₋₁ − Pₘ₋₂; Clenshaw's sum takes P₀ = 1.
    """
    count = len(coefficients)
    steps = tuple(SLOPE_STEPS[min(m, 1)] for m in range(count))
    return clenshaw(_auxiliary(coefficients), steps, x)


@lru_cache(maxsize=256)
def _auxiliary(coefficients: tuple[float, ...]) -> tuple[float, ...]:
    """Return the coefficients of half the auxiliary polynomials: fₘQₘ = Pₘ − gₘ₋₁Qₘ₋₁ − hₘ₋₂Qₘ₋₂ solved for Σ bₘPₘ."""
    f, g, h = _slope_norms(len(coefficients))
    found: list[float] = []
    one = two = 0.0
    for m in reversed(range(len(coefficients))):
        one, two = (coefficients[m] - g[m] * one - h[m] * two) / f[m], one
        found.append(2 * one)
    return tuple(reversed(found))


@lru_cache(maxsize=32)
def _slope_norms(count: int) -> tuple[list[float], list[float], list[float]]:
    """Return fₘ, gₘ and hₘ, m < count, by which the slopes of Qbfs are orthonormal (Forbes 2010, appendix A)."""
    f, g, h = [2.0, sqrt(19) / 2], [-0.5], []
    for m in range(2, count + 2):
        h.append(-m * (m - 1) / (2 * f[m - 2]))
        g.append(-(1 + g[m - 2] * h[m - 2]) / f[m - 1])
        f.append(sqrt(m * (m + 1) + 3 - g[m - 1] ** 2 - h[m - 2] ** 2))
    return f, g, h
