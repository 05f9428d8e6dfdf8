"""The shapes of surfaces by their type in a lens file in TOML."""

from collections.abc import Callable
from typing import NamedTuple

from p2sf.lens.anamorphic import Biconic, Toroid
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.shapes import EXTENDED, EXTENDED_ODD, ODD, Qbfs, Qcon, RadialPolynomial, Shape


class ShapeType(NamedTuple):
    """A function from coefficients and normalisation radius to a shape, and the largest number of coefficients.

    With ``keys`` it is one from these keywords instead, which are fields of the shape.
    """

    of: Callable[..., Shape]
    most: int = 60
    keys: tuple[str, ...] = ()


def _even(numbers: tuple[float, ...], radius: float) -> Shape:
    return RadialPolynomial(tuple(x for number in numbers for x in (0.0, number)), radius)


# Coefficients belong to r, r², … (in units⁰, units⁻¹, …), ρ = r/normalisation radius, ρ², …, ρ², ρ⁴, …, Forbes's
# polynomials Q₀, Q₁, …, x, y, x², xy, y², …, and Zernike polynomials from piston (all in units).
SHAPES = {
    ODD: ShapeType(RadialPolynomial),
    EXTENDED_ODD: ShapeType(RadialPolynomial),
    EXTENDED: ShapeType(_even),
    "Qbfs": ShapeType(Qbfs),
    "Qcon": ShapeType(Qcon),
    "XY polynomial": ShapeType(XYPolynomial, XYPolynomial.most),
    "Zernike standard sag": ShapeType(ZernikeStandardSag, ZernikeStandardSag.most),
    "Zernike fringe sag": ShapeType(ZernikeFringeSag, ZernikeFringeSag.most),
    "biconic": ShapeType(Biconic, keys=("radius_x", "radius_y", "conic_x", "conic_y", "turn_deg")),
    "toroid": ShapeType(Toroid, keys=("radius_x", "radius_y", "conic_y", "coefficients", "turn_deg")),
}
