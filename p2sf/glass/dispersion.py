"""Refractive index from a dispersion formula or a table, for floats and arrays alike.

Formula numbers and the order of the coefficients ``c`` are those of refractiveindex.info's "Dispersion formulas"
sheet, which counts from c₁ = ``c[0]``. Wavelengths are µm throughout.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from p2sf.glass.pages import GlassPage

Values = float | np.ndarray
Coefficients = Sequence[float]
LINES_UM = {"F": 0.4861327, "d": 0.5875618, "C": 0.6562725, "g": 0.4358343, "t": 1.01398}  # Fraunhofer's


def refractive_index(page: GlassPage, wavelength_um: Values) -> np.ndarray:
    """Return n of one page of the database, in the shape of ``wavelength_um`` (µm, float or array)."""
    formula = FORMULAS.get(page.kind)
    if formula is None:
        return np.asarray(interpolate_index(page.wavelengths_um, page.numbers, wavelength_um))
    index: np.ndarray = formula(page.numbers, wavelength_um)
    return index


def _poles(c: Coefficients, square: Values) -> Values:
    """Return Σ B λ²/(λ² − C) over the pairs (B, C), C in µm²."""
    total: Values = 0.0
    for b, pole in zip(c[::2], c[1::2], strict=True):  # takes half the time of a generator, which matters for sliders
        total = total + b * square / (square - pole)
    return total


def _powers(c: Coefficients, wavelength: Values) -> Values:
    """Return Σ a λ^e over the pairs (a, e)."""
    total: Values = 0.0
    for a, e in zip(c[::2], c[1::2], strict=True):
        total = total + a * wavelength**e
    return total


def sellmeier(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 1, with resonance wavelengths: n² − 1 = c₁ + Σ Bλ²/(λ² − C²) (Sellmeier, 1871)."""
    square = wavelength * wavelength
    poles: Values = sum(b * square / (square - w * w) for b, w in zip(c[1::2], c[2::2], strict=True))
    return np.sqrt(1 + c[0] + poles)


def sellmeier_squared(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 2, resonances as squares, the form of makers' data sheets: n² − 1 = c₁ + Σ Bλ²/(λ² − C)."""
    return np.sqrt(1 + c[0] + _poles(c[1:], wavelength * wavelength))


def polynomial(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 3, the former Schott polynomial: n² = c₁ + Σ cλ^e."""
    return np.sqrt(c[0] + _powers(c[1:], wavelength))


def rational(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 4: n² = c₁ + Σ Bλ^b/(λ² − C^e) over two poles (B, b, C, e), + Σ aλ^e."""
    square = wavelength * wavelength
    poles: Values = sum(b * wavelength**p / (square - r**q) for b, p, r, q in (c[1:5], c[5:9]))
    return np.sqrt(c[0] + poles + _powers(c[9:], wavelength))


def cauchy(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 5: n = c₁ + Σ cλ^e (Cauchy, 1836)."""
    return c[0] + _powers(c[1:], wavelength)


def gas(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 6: n − 1 = c₁ + Σ B/(C − λ⁻²)."""
    return 1 + c[0] + sum(b / (pole - wavelength**-2) for b, pole in zip(c[1::2], c[2::2], strict=True))


def herzberger(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 7: powers of λ² beside powers of 1/(λ² − 0.028) (Herzberger, 1959)."""
    square = wavelength * wavelength
    pole = 1 / (square - 0.028)
    c1, c2, c3, *powers = c
    return c1 + pole * (c2 + c3 * pole) + sum(a * square**k for k, a in enumerate(powers, 1))


def retro(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 8: (n² − 1)/(n² + 2) = c₁ + c₂λ²/(λ² − c₃) + c₄λ²."""
    square = wavelength * wavelength
    ratio = c[0] + c[1] * square / (square - c[2]) + c[3] * square
    return np.sqrt((1 + 2 * ratio) / (1 - ratio))


def exotic(c: Coefficients, wavelength: Values) -> Values:
    """Evaluate formula 9: n² = c₁ + c₂/(λ² − c₃) + c₄(λ − c₅)/((λ − c₅)² + c₆)."""
    shifted = wavelength - c[4]
    return np.sqrt(c[0] + c[1] / (wavelength * wavelength - c[2]) + c[3] * shifted / (shifted * shifted + c[5]))


def interpolate_index(wavelengths_um: Sequence[float], values: Sequence[float], wavelength: Values) -> Values:
    """Return n of a table, interpolated through the four nearest points in λ⁻², in which a glass is nearly linear.

    ``wavelengths_um`` ascending. Linear interpolation in λ between the makers' usual wavelengths errs by up to 8e-4,
    this by less than 1e-5.
    """
    x = np.array(wavelengths_um[::-1]) ** -2.0
    return through_neighbours(x, np.array(values[::-1]), wavelength**-2.0)


def through_neighbours(x: np.ndarray, y: np.ndarray, at: Values) -> Values:
    """Return the polynomial through up to four samples around each ``at``; ``x`` (samples,) ascending.

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


FORMULAS: dict[str, Callable[[Coefficients, Any], Any]] = {
    "1": sellmeier,
    "2": sellmeier_squared,
    "3": polynomial,
    "4": rational,
    "5": cauchy,
    "6": gas,
    "7": herzberger,
    "8": retro,
    "9": exotic,
}
