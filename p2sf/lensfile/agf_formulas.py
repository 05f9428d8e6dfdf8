"""The thirteen dispersion formulas an AGF catalogue may use, by its formula number.

Each takes the coefficients c of the CD line and λ in µm and returns n² (``SQUARED``) or n (``DIRECT``).
Source of all forms: the Zemax OpticStudio manual, "Dispersion formulas"; each is checked against the
n_d that catalogues print beside it.
"""

import numpy as np

COEFFICIENTS = 12


def schott(c, w):
    """Return n² of formula 1, a power series."""
    return c[0] + c[1] * w**2 + c[2] * w**-2 + c[3] * w**-4 + c[4] * w**-6 + c[5] * w**-8


def resonances(c, w, count):
    """Return Σ K λ²/(λ² − L) over ``count`` pairs (K, L); a pair with K = 0 adds nothing, its pole included."""
    return sum(
        (k * w**2 / (w**2 - pole) for k, pole in zip(c[: 2 * count : 2], c[1 : 2 * count : 2], strict=True) if k), 0
    )


def sellmeier_1(c, w):
    """Return n² of formula 2, three resonances (W. Sellmeier 1871)."""
    return 1 + resonances(c, w, 3)


def herzberger(c, w):
    """Return n of formula 3 (M. Herzberger, Opt. Acta 6, 197, 1959)."""
    pole = 1 / (w**2 - 0.028)
    return c[0] + c[1] * pole + c[2] * pole**2 + c[3] * w**2 + c[4] * w**4 + c[5] * w**6


def sellmeier_2(c, w):
    """Return n² of formula 4: the second resonance without λ² above, both wavelengths squared."""
    return 1 + c[0] + c[1] * w**2 / (w**2 - c[2] ** 2) + c[3] / (w**2 - c[4] ** 2)


def conrady(c, w):
    """Return n of formula 5 (A. E. Conrady, Applied Optics and Optical Design, 1960, §126)."""
    return c[0] + c[1] / w + c[2] / w**3.5


def sellmeier_3(c, w):
    """Return n² of formula 6, four resonances."""
    return 1 + resonances(c, w, 4)


def handbook_1(c, w):
    """Return n² of formula 7 (Handbook of Optics)."""
    return c[0] + c[1] / (w**2 - c[2]) - c[3] * w**2


def handbook_2(c, w):
    """Return n² of formula 8 (Handbook of Optics)."""
    return c[0] + c[1] * w**2 / (w**2 - c[2]) - c[3] * w**2


def sellmeier_4(c, w):
    """Return n² of formula 9, a constant and two resonances."""
    return c[0] + resonances(c[1:], w, 2)


def extended_1(c, w):
    """Return n² of formula 10, the power series two terms further down."""
    return schott(c, w) + c[6] * w**-10 + c[7] * w**-12


def sellmeier_5(c, w):
    """Return n² of formula 11, five resonances."""
    return 1 + resonances(c, w, 5)


def extended_2(c, w):
    """Return n² of formula 12, the power series two terms further up."""
    return schott(c, w) + c[6] * w**4 + c[7] * w**6


def extended_3(c, w):
    """Return n² of formula 13, λ⁴ down to λ⁻¹²."""
    powers = (0, 2, 4, -2, -4, -6, -8, -10, -12)
    return sum(a * w**p for a, p in zip(c, powers, strict=False))


DIRECT = {3: herzberger, 5: conrady}
SQUARED = {
    1: schott,
    2: sellmeier_1,
    4: sellmeier_2,
    6: sellmeier_3,
    7: handbook_1,
    8: handbook_2,
    9: sellmeier_4,
    10: extended_1,
    11: sellmeier_5,
    12: extended_2,
    13: extended_3,
}


def refractive_index(formula: int, coefficients, wavelength_um) -> np.ndarray:
    """Return n(λ), same shape as ``wavelength_um``; nan where the formula gives no real index."""
    wavelength = np.asarray(wavelength_um, dtype=float)
    c = (*coefficients, *[0.0] * (COEFFICIENTS - len(coefficients)))
    with np.errstate(all="ignore"):
        if formula in DIRECT:
            return DIRECT[formula](c, wavelength) + 0 * wavelength
        return np.sqrt(SQUARED[formula](c, wavelength) + 0 * wavelength)
