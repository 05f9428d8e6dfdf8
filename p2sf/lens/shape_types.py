"""The shapes that a surface may have, by their type in a lens file in TOML."""

from collections.abc import Callable
from typing import NamedTuple

from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.shapes import EXTENDED, EXTENDED_ODD, ODD, Qbfs, Qcon, RadialPolynomial, Shape


class ShapeType(NamedTuple):
    """What makes a shape of the coefficients of a file and a normalisation radius, and the most coefficients."""

    of: Callable[[tuple[float, ...], float], Shape]
    most: int = 60


def _even(numbers: tuple[float, ...], radius: float) -> Shape:
    return RadialPolynomial(tuple(x for number in numbers for x in (0.0, number)), radius)


# Coefficients are of r, r², … (in units⁰, units⁻¹, …), of ρ = r/normalisation radius, ρ², …, of ρ², ρ⁴, …, of Forbes's
# polynomials Q₀, Q₁, …, of x, y, x², xy, y², …, and of Zernike's from piston (all in units).
SHAPES = {
    ODD: ShapeType(RadialPolynomial),
    EXTENDED_ODD: ShapeType(RadialPolynomial),
    EXTENDED: ShapeType(_even),
    "Qbfs": ShapeType(Qbfs),
    "Qcon": ShapeType(Qcon),
    "XY polynomial": ShapeType(XYPolynomial, XYPolynomial.most),
    "Zernike standard sag": ShapeType(ZernikeStandardSag, ZernikeStandardSag.most),
    "Zernike fringe sag": ShapeType(ZernikeFringeSag, ZernikeFringeSag.most),
}
