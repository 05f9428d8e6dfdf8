"""Shapes of surfaces of revolution beyond a conic with even terms: each is sag to be added to that of the conic.

Every shape knows its sag and dz/d(r²) at squared radii r², mm², and its power series at the vertex, which is what first
and third order see. Lengths are mm.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import comb, fsum, sqrt
from typing import TypeAlias

import numpy as np

from p2sf.conventions import FloatOrArray

SagAndSlope: TypeAlias = tuple[FloatOrArray, FloatOrArray]
Series: TypeAlias = tuple[float, float, float, float]
"""Coefficients of r, r², r³ and r⁴, mm⁰ … mm⁻³."""


@dataclass(frozen=True)
class RadialPolynomial:
    """Terms Σ aₖρᵏ, k = 1, 2, 3 …, of ρ = r/``normalisation_mm``, as OpticStudio's odd and extended aspheres have them.

    ``coefficients``: a₁, a₂, …, mm. With a normalisation radius of 1 mm they are those of powers of r in mm.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float = 1.0

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return every number of the shape."""
        return (*self.coefficients, self.normalisation_mm)

    @property
    def even(self) -> bool:
        """Return whether all terms are even."""
        return not any(self.coefficients[::2])

    def sag_and_slope(self, square: FloatOrArray, curvature: float, conic: float = 0.0) -> SagAndSlope:
        """Return the sag and dz/d(r²); at the vertex itself a term in ρ has the slope of its mean, 0."""
        scale = self.normalisation_mm**-2
        u = square * scale
        sag, slope = _even_terms(self.coefficients[1::2], u)
        if not self.even:
            rho = np.sqrt(u)
            odd, odd_slope = _horner(self.coefficients[::2], u)
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
        """Return the shape ``factor`` times as large."""
        return RadialPolynomial(_times(self.coefficients, factor), self.normalisation_mm * factor)


@dataclass(frozen=True)
class Qcon:
    """Forbes's u⁴Σ aₘQₘ(u²) over a conic, u = r/``normalisation_mm`` (Forbes 2007): what sag departs from it.

    ``coefficients``: a₀, a₁, …, mm. Qₘ(x) = P⁽⁰⁴⁾ₘ(2x − 1), Jacobi's polynomials.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return every number of the shape."""
        return (*self.coefficients, self.normalisation_mm)

    def sag_and_slope(self, square: FloatOrArray, curvature: float, conic: float = 0.0) -> SagAndSlope:
        """Return the sag and dz/d(r²)."""
        x = square / self.normalisation_mm**2
        value, derivative = _clenshaw(self.coefficients, _jacobi_steps(len(self.coefficients)), x)
        return x * x * value, x * (2 * value + x * derivative) / self.normalisation_mm**2

    def series(self, curvature: float) -> Series:
        """Return the coefficients of r … r⁴."""
        return 0.0, 0.0, 0.0, (*self.even_terms(), 0.0)[0]

    def scaled_terms(self) -> tuple[float, ...]:
        """Return the coefficients of u⁴, u⁶, …, mm: the same surface but for rounding, more with each term."""
        columns = _jacobi_powers(len(self.coefficients))
        return tuple(fsum(a * c for a, c in zip(self.coefficients, column, strict=True)) for column in columns)

    def even_terms(self) -> tuple[float, ...]:
        """Return A4, A6, …, mm⁻³, mm⁻⁵, …, of the same surface."""
        return tuple(a / self.normalisation_mm ** (4 + 2 * k) for k, a in enumerate(self.scaled_terms()))

    def scaled(self, factor: float) -> "Qcon":
        """Return the shape ``factor`` times as large."""
        return Qcon(_times(self.coefficients, factor), self.normalisation_mm * factor)


@dataclass(frozen=True)
class Qbfs:
    """Forbes's u²(1 − u²)/cos·Σ aₘQₘ(u²) over the best-fit sphere or conic, u = r/``normalisation_mm`` (Forbes 2007).

    cos is that of the angle between the base's normal and the axis, √(1 − c²r²) for a sphere, so that the departure is
    along the normal; OpticStudio has it for a conic too. ``coefficients``: a₀, a₁, …, mm: their squares add to the mean
    square slope of that departure, which is none at the vertex and at r = ``normalisation_mm``. a₀ and the others have
    an r² term, so that the curvature at the vertex is not the base's.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return every number of the shape."""
        return (*self.coefficients, self.normalisation_mm)

    def sag_and_slope(self, square: FloatOrArray, curvature: float, conic: float = 0.0) -> SagAndSlope:
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


Shape: TypeAlias = RadialPolynomial | Qcon | Qbfs


@dataclass(frozen=True)
class Diffraction:
    """A diffractive surface of revolution, OpticStudio's binary 2, which adds the phase m·Σ Aⱼρ²ʲ.

    ``coefficients``: A₁, A₂, …, radians, of powers of ρ = r/``normalisation_mm``; ``order``: m, that of diffraction.
    The phase of a ray is added at every wavelength alike, so that its path grows by λ/2π times it; all light goes
    into this one order.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float
    order: float = 1.0

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return every number of the surface's phase."""
        return (*self.coefficients, self.normalisation_mm, self.order)

    def phase_and_slope(self, square: FloatOrArray) -> SagAndSlope:
        """Return the phase in radians and its derivative with respect to r², per mm², at squared radii in mm²."""
        scale = self.normalisation_mm**-2
        phase, slope = _even_terms(self.coefficients, square * scale)
        return phase * self.order, slope * (self.order * scale)

    def path_terms(self, wavelength_um: FloatOrArray) -> tuple[FloatOrArray, FloatOrArray]:
        """Return the coefficients of r² and r⁴ of the path that is added, mm⁻¹ and mm⁻³."""
        second, fourth = (*self.coefficients, 0.0, 0.0)[:2]
        unit = wavelength_um * (self.order * WAVES_MM)
        return unit * (second / self.normalisation_mm**2), unit * (fourth / self.normalisation_mm**4)

    def scaled(self, factor: float) -> "Diffraction":
        """Return the phase spread over ``factor`` times the radius."""
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


def _clenshaw(coefficients: tuple[float, ...], steps: Steps, x: FloatOrArray) -> SagAndSlope:
    """Return Σ cₘPₘ(x), P₀ = 1, and its derivative by Clenshaw's recurrence, which is stable on 0 ≤ x ≤ 1."""
    none: FloatOrArray = 0.0 * x
    value, value_next, slope, slope_next = none, none, none, none
    after = 0.0
    for coefficient, (alpha, beta, gamma) in zip(reversed(coefficients), reversed(steps), strict=True):
        factor = alpha + beta * x
        slope, slope_next = factor * slope + beta * value + after * slope_next, slope
        value, value_next = coefficient + factor * value + after * value_next, value
        after = gamma
    return value, slope


@lru_cache(maxsize=32)
def _jacobi_steps(count: int) -> Steps:
    """Return the recurrence of P⁽⁰⁴⁾ₘ(2x − 1) (Abramowitz and Stegun 1964, ch. 22)."""
    steps = []
    for m in range(1, count + 1):
        s, scale = 2 * m + 4, 1 / (2 * m * (m + 4) * (2 * m + 2))
        along = scale * (s - 1) * s * (s - 2)
        steps.append((-along - 16 * scale * (s - 1), 2 * along, -2 * scale * (m - 1) * (m + 3) * s))
    return tuple(steps)


@lru_cache(maxsize=32)
def _jacobi_powers(count: int) -> tuple[tuple[int, ...], ...]:
    """Return for each power k of x the integers (−1)^(m+k)·C(m, k)·C(m + k + 4, m) in P⁽⁰⁴⁾ₘ(2x − 1), m < count."""
    return tuple(tuple((-1) ** (m + k) * comb(m, k) * comb(m + k + 4, m) for m in range(count)) for k in range(count))


SLOPE_STEPS = (3.0, -4.0, 0.0), (2.0, -4.0, -1.0)  # of the first and of every later auxiliary polynomial


def _slope_orthogonal(coefficients: tuple[float, ...], x: FloatOrArray) -> SagAndSlope:
    """Return Σ aₘQₘ(x) of Qbfs and its derivative, by auxiliary polynomials (Forbes 2010, appendix A).

    P₀ = 2, P₁ = 6 − 8x, Pₘ = (2 − 4x)Pₘ₋₁ − Pₘ₋₂, which Clenshaw's sum has with P₀ = 1.
    """
    count = len(coefficients)
    steps = tuple(SLOPE_STEPS[min(m, 1)] for m in range(count))
    return _clenshaw(_auxiliary(coefficients), steps, x)


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
