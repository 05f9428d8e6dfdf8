"""Parts of a surface that are not of revolution: polynomials in x and y, and Zernike polynomials.

Terms and normalisation are those of OpticStudio (Ansys Zemax 2024, "Extended Polynomial", "Zernike Standard Sag",
"Zernike Fringe Sag"): heights over a normalisation radius, so that coefficients are lengths, and angles from +x
towards +y.
"""

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import cos, factorial, radians, sin
from typing import ClassVar, Self

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.disc.zernike_terms import ZernikeOrder, ZernikeTerm, zernike_terms
from p2sf.lens.shapes import RadialPolynomial, RadialShape, Series, Shape, clenshaw, jacobi_steps
from p2sf.messages import Message

Monomials = dict[tuple[int, int], float]  # coefficients by the exponents of x and y


@dataclass(frozen=True)
class Freeform(Shape):
    """A shape that is not of revolution; its mean over all azimuths has even powers of r only.

    ``coefficients``, mm, are of polynomials of x and y over ``normalisation_mm``.
    """

    coefficients: tuple[float, ...]
    normalisation_mm: float

    def __getstate__(self) -> dict:
        return {"coefficients": self.coefficients, "normalisation_mm": self.normalisation_mm}

    @property
    def addends_mm(self) -> float:
        """Return the sum of the absolute values of all coefficients, mm."""
        return sum(map(abs, self.coefficients))

    @cached_property
    def mean(self) -> RadialShape | None:
        """Return the azimuthal mean of the shape without its piston, as a polynomial in r; None for a plane."""
        terms = self.mean_powers
        top = max((power for power, a in terms.items() if a and power), default=0)
        numbers = tuple(terms.get(power, 0.0) for power in range(1, top + 1))
        return RadialPolynomial(numbers, self.normalisation_mm) if numbers else None

    @property
    @abstractmethod
    def mean_powers(self) -> dict[int, float]:
        """Return the coefficients of the azimuthal mean in powers of r over the normalisation radius, mm."""

    def series(self, curvature: float) -> Series:
        """Return the coefficients of r … r⁴ of the azimuthal mean."""
        return self.mean.series(curvature) if self.mean else (0.0, 0.0, 0.0, 0.0)

    @property
    @abstractmethod
    def vertex_terms(self) -> tuple[float, float, float]:
        """Return the coefficients of x², xy and y² over the normalisation radius at the vertex, mm."""

    def curvature_at(self, azimuth_deg: float) -> float:
        """Return what the shape adds to the curvature of a section: its second derivative along it."""
        sine, cosine = sin(radians(azimuth_deg)), cos(radians(azimuth_deg))
        xx, xy, yy = self.vertex_terms
        return 2 * (xx * sine * sine + xy * sine * cosine + yy * cosine * cosine) / self.normalisation_mm**2


@lru_cache(maxsize=4)
def xy_exponents(count: int) -> tuple[tuple[int, int], ...]:
    """Return the exponents of x and y of the first terms: x, y, x², xy, y², x³ and so on."""
    order = ((degree - b, b) for degree in range(1, count + 1) for b in range(degree + 1))
    return tuple(exponents for exponents, _ in zip(order, range(count), strict=False))


@dataclass(frozen=True)
class XYPolynomial(Freeform):
    """Terms a₁x + a₂y + a₃x² + a₄xy + a₅y² + a₆x³ + … of x and y over the normalisation radius."""

    normalisation_mm: float = 1.0
    most: ClassVar[int] = 230
    """Terms up to degree 20."""
    endings = frozenset((".toml", ".zmx", ".seq"))
    kind = "XY polynomial"
    name = Message("XY polynomial")

    def sag_and_gradient(
        self, x: FloatOrArray, y: FloatOrArray, curvature: float = 0.0, conic: float = 0.0
    ) -> tuple[FloatOrArray, np.ndarray]:
        """Return the sag, mm, and ∂z/∂x and ∂z/∂y, (2, …), by nested Horner schemes in x and y."""
        u, v = x / self.normalisation_mm, y / self.normalisation_mm
        sag = across = up = 0.0 * (u + v)
        for row in reversed(self._rows):
            value = slope = 0.0 * u
            for coefficient in reversed(row):
                slope = slope * u + value
                value = value * u + coefficient
            up = up * v + sag
            sag, across = sag * v + value, across * v + slope
        return sag, np.stack([across, up]) / self.normalisation_mm

    @cached_property
    def _rows(self) -> list[list[float]]:
        """Return the coefficients of xᵃ, a = 0, 1, …, for each power of y."""
        terms = self._monomials
        top = max((a + b for (a, b), value in terms.items() if value), default=0)
        return [[terms.get((a, b), 0.0) for a in range(top - b + 1)] for b in range(top + 1)]

    @property
    def _monomials(self) -> Monomials:
        return dict(zip(xy_exponents(len(self.coefficients)), self.coefficients, strict=True))

    @property
    def vertex_terms(self) -> tuple[float, float, float]:
        """Return the coefficients of x², xy and y², mm."""
        terms = self._monomials
        return terms.get((2, 0), 0.0), terms.get((1, 1), 0.0), terms.get((0, 2), 0.0)

    @property
    def mean_powers(self) -> dict[int, float]:
        """Return the mean in powers of r: that of x²ᵃy²ᵇ is (2a)!(2b)!/(4ᵃ⁺ᵇa!b!(a + b)!)·r²ᵃ⁺²ᵇ."""
        found: dict[int, float] = {}
        for (a, b), value in self._monomials.items():
            if a % 2 == b % 2 == 0:
                i, j = a // 2, b // 2
                share = factorial(a) * factorial(b) / (4 ** (i + j) * factorial(i) * factorial(j) * factorial(i + j))
                found[a + b] = found.get(a + b, 0.0) + share * value
        return found

    def turned(self, angle_deg: float) -> Self:
        """Return the polynomial turned about the vertex, from x towards y."""
        cosine, sine = cos(radians(angle_deg)), sin(radians(angle_deg))
        x, y = np.poly1d([cosine, sine]), np.poly1d([-sine, cosine])  # of tₓ/t_y: both are homogeneous
        found: Monomials = {}
        for (a, b), value in self._monomials.items():
            for power, share in enumerate((x**a * y**b).coeffs[::-1]):
                key = power, a + b - power
                found[key] = found.get(key, 0.0) + value * float(share)
        order = xy_exponents(_complete_term_count(len(self.coefficients)))
        return type(self)(tuple(found.get(key, 0.0) for key in order), self.normalisation_mm)

    def scaled(self, factor: float) -> Self:
        """Return the shape ``factor`` times as large."""
        return type(self)(tuple(a * factor for a in self.coefficients), self.normalisation_mm * factor)


def _complete_term_count(count: int) -> int:
    """Return the number of terms up to and including the degree of term ``count``."""
    degree = next(n for n in range(1, count + 2) if n * (n + 3) // 2 >= count)
    return degree * (degree + 3) // 2


class ZernikeSag(Freeform):
    """Zernike polynomials of x and y over the normalisation radius; the first coefficient is piston."""

    order: ClassVar[ZernikeOrder]
    most: ClassVar[int]
    ends = True

    @classmethod
    def _norm(cls, term: ZernikeTerm) -> float:
        """Return the factor of R(ρ)·cos mθ or sin |m|θ, with R(1) = 1: of unit mean square in Noll's order."""
        return term.norm if cls.order == "noll" else 1.0

    def sag_and_gradient(
        self, x: FloatOrArray, y: FloatOrArray, curvature: float = 0.0, conic: float = 0.0
    ) -> tuple[FloatOrArray, np.ndarray]:
        """Return the sag, mm, and ∂z/∂x and ∂z/∂y, (2, …).

        Sums the real part of Fₘ(ρ²)·zᵐ, z = x + iy, over m: polynomials without an angle, smooth at the centre. Fₘ is a
        sum of Jacobi polynomials P⁽⁰ᵐ⁾(2ρ² − 1) (Born & Wolf 1999, §9.2.1).
        """
        u, v = x / self.normalisation_mm, y / self.normalisation_mm
        z, square = u + 1j * v, u * u + v * v
        sag = across = up = 0.0 * square
        for m, numbers in self._by_frequency.items():
            value, slope = clenshaw(numbers, jacobi_steps(len(numbers), m), square)
            lower = z ** (m - 1) if m else 0.0
            power = lower * z if m else 1.0
            steeper, turn = slope * power, m * value * lower
            sag = sag + np.real(value * power)
            across = across + np.real(2 * u * steeper + turn)
            up = up + np.real(2 * v * steeper + 1j * turn)
        return sag, np.stack([across, up]) / self.normalisation_mm

    @cached_property
    def terms(self) -> dict[tuple[int, int], float]:
        """Return the factor of every R(ρ)·cos mθ or, for m < 0, sin |m|θ, by (n, m)."""
        listed = zernike_terms(self.order, len(self.coefficients))
        return {(term.n, term.m): a * self._norm(term) for term, a in zip(listed, self.coefficients, strict=True)}

    @cached_property
    def _by_frequency(self) -> dict[int, tuple[complex, ...]]:
        """Return cos − i·sin of every degree m, m + 2, …, by m."""
        found: dict[int, tuple[complex, ...]] = {}
        used = {key: value for key, value in self.terms.items() if value}
        for m in sorted({abs(m) for _, m in used}):
            top = max(n for n, frequency in used if abs(frequency) == m)
            pairs = ((used.get((n, m), 0.0), used.get((n, -m), 0.0) if m else 0.0) for n in range(m, top + 1, 2))
            found[m] = tuple(complex(cosine, -sine) for cosine, sine in pairs)
        return found

    @property
    def vertex_terms(self) -> tuple[float, float, float]:
        """Return the coefficients of x², xy and y², mm: of ρ² in m = 0, and of ρ²cos 2θ and ρ²sin 2θ.

        Near the vertex R of degree n and m = 2 is (−1)ⁿᐟ²⁻¹·n(n + 2)/8·ρ² (Born and Wolf 1999, §9.2.1).
        """
        along, across = (
            sum((-1) ** (n // 2 - 1) * n * (n + 2) / 8 * value for (n, m), value in self.terms.items() if m == which)
            for which in (2, -2)
        )
        mean = self.mean_powers.get(2, 0.0)
        return mean + along, 2 * across, mean - along

    @property
    def mean_powers(self) -> dict[int, float]:
        """Return the terms of m = 0 in powers of ρ."""
        found: dict[int, float] = {}
        for (n, m), value in self.terms.items():
            if value and not m:
                k = n // 2
                for j in range(k + 1):
                    share = (-1) ** (k - j) * factorial(k + j) // (factorial(j) ** 2 * factorial(k - j))
                    found[2 * j] = found.get(2 * j, 0.0) + value * share
        return found

    def turned(self, angle_deg: float) -> Self:
        """Return the polynomials turned about the vertex, from x towards y: cos m(θ − a), sin m(θ − a)."""
        terms: dict[tuple[int, int], float] = {}
        for n, m in {(n, abs(m)) for n, m in self.terms}:
            a, b = self.terms.get((n, m), 0.0), self.terms.get((n, -m), 0.0) if m else 0.0
            cosine, sine = cos(radians(m * angle_deg)), sin(radians(m * angle_deg))
            terms[n, m] = a * cosine - b * sine
            if m:
                terms[n, -m] = b * cosine + a * sine
        return self.of_terms(terms, self.normalisation_mm)

    @classmethod
    def of_terms(cls, terms: dict[tuple[int, int], float], normalisation_mm: float) -> Self:
        """Return the shape with these factors of R(ρ)·cos mθ and sin |m|θ; KeyError for a term outside its order."""
        listed = {(each.n, each.m): each for each in zernike_terms(cls.order, cls.most)}
        numbers = {listed[key].number: value / cls._norm(listed[key]) for key, value in terms.items() if value}
        count = max(numbers, default=1)
        return cls(tuple(numbers.get(place, 0.0) for place in range(1, count + 1)), normalisation_mm)

    def scaled(self, factor: float) -> Self:
        """Return the shape ``factor`` times as large."""
        numbers = tuple(a * factor for a in self.coefficients)
        return type(self)(numbers, self.normalisation_mm * factor)


@dataclass(frozen=True)
class ZernikeStandardSag(ZernikeSag):
    """Zernike polynomials in Noll's order, each of unit mean square over the disc (Noll 1976)."""

    order = "noll"
    most = 231
    endings = frozenset((".toml", ".zmx", ".seq"))
    kind = "Zernike standard sag"
    name = Message("Zernike standard sag")


@dataclass(frozen=True)
class ZernikeFringeSag(ZernikeSag):
    """Zernike polynomials in the Fringe order, each with a maximum of 1 on the edge."""

    order = "fringe"
    most = 37
    endings = frozenset((".toml", ".zmx", ".seq"))
    kind = "Zernike fringe sag"
    name = Message("Zernike fringe sag")
