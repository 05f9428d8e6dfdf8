"""Conversion of other shapes into a conic with even terms, exactly where possible, otherwise by a fit."""

from dataclasses import dataclass, replace
from math import isfinite

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Surface
from p2sf.lens.shapes import Qcon, RadialPart

SAMPLES = 400  # samples along the radius: far more than extremes of a polynomial of 30 terms


@dataclass(frozen=True)
class EvenAsphere:
    """A conic with even terms, and the largest difference of its sag from the original surface, mm."""

    surface: Surface
    residual_mm: float


def even_asphere(surface: Surface, terms: int = 12) -> EvenAsphere:
    """Return a surface as a conic with even terms from r⁴ on.

    Qcon and even polynomials without r² are converted exactly up to rounding. Qbfs and polynomials with a term in r²
    get their radius of curvature at the vertex and ``terms`` even terms, fitted by least squares over the clear radius
    or, without one, the normalisation radius. Raises GeometryError for odd terms.
    """
    shape = surface.shape
    if shape is None:
        return EvenAsphere(surface, 0.0)
    powers = shape.powers
    if not isinstance(shape, RadialPart):
        raise GeometryError("the surface is not of revolution, so even terms cannot describe it; keep its shape")
    if powers is not None and any(a for power, a in powers.items() if power % 2):
        raise GeometryError("even terms cannot describe the odd powers of the radius in the surface; keep its shape")
    if powers is None or powers.get(2):
        return _fit_powers(surface, terms)
    top = max(powers, default=2)
    more = tuple(powers.get(k, 0.0) / shape.normalisation_mm**k for k in range(4, top + 1, 2))
    return EvenAsphere(replace(surface, aspheric=_add_terms(surface.aspheric, more), shape=None), 0.0)


def _add_terms(one: tuple[float, ...], other: tuple[float, ...]) -> tuple[float, ...]:
    short, long = sorted((one, other), key=len)
    return tuple(a + b for a, b in zip((*short, *[0.0] * (len(long) - len(short))), long, strict=True))


def _fit_powers(surface: Surface, terms: int) -> EvenAsphere:
    """Return the least-squares fit in Forbes's Qcon, whose terms are orthogonal, in powers of r."""
    curvature = surface.vertex_curvature
    rim = surface.semi_diameter
    if not isfinite(rim):
        rim = surface.shape.normalisation_mm if surface.shape else 1.0
    r = rim * np.sin(np.linspace(0, np.pi / 2, SAMPLES))
    plain = replace(surface, radius=1 / curvature if curvature else np.inf, aspheric=(), shape=None)
    departure = surface.sag(0.0, r) - plain.sag(0.0, r)
    basis = [Qcon((*[0.0] * m, 1.0), rim).sag_and_slope(r * r, 0.0)[0] for m in range(terms)]
    found, *_ = np.linalg.lstsq(np.column_stack(basis), departure, rcond=None)
    made = replace(plain, aspheric=Qcon(tuple(found.tolist()), rim).even_terms())
    return EvenAsphere(made, float(np.abs(made.sag(0.0, r) - surface.sag(0.0, r)).max()))


def power_terms(surface: Surface) -> tuple[float, dict[int, float]]:
    """Return a normalisation radius and the coefficients of the powers of r over it, mm; other shapes are ignored."""
    more = (surface.shape.powers if surface.shape else None) or {}
    radius = surface.shape.normalisation_mm if surface.shape and more else 1.0
    terms = {power: a * radius**power for power, a in zip(range(4, 99, 2), surface.aspheric, strict=False)}
    return radius, {power: a for power in {*terms, *more} if (a := terms.get(power, 0.0) + more.get(power, 0.0))}
