"""What a surface is besides a conic with even terms, in words."""

from p2sf.lens.lens import Surface
from p2sf.lens.shapes import Qbfs, Qcon, RadialPolynomial, Shape
from p2sf.messages import Message

ODD, EXTENDED, EXTENDED_ODD = Message("odd asphere"), Message("extended asphere"), Message("extended odd asphere")
QBFS, QCON = Message("Qbfs asphere"), Message("Qcon asphere")


def kind_of(shape: Shape) -> Message:
    """Return the name of a shape, OpticStudio's."""
    if isinstance(shape, Qbfs):
        return QBFS
    if isinstance(shape, Qcon):
        return QCON
    if shape.normalisation_mm == 1:
        return ODD
    return EXTENDED if shape.even else EXTENDED_ODD


def shape_words(surface: Surface) -> tuple[Message, ...]:
    """Return shape and diffraction in numbers, or the ideal lens; nothing for conics with even terms."""
    found = []
    if surface.ideal:
        found.append(Message("ideal lens: focal length {focal:g} mm", focal=surface.ideal_focal_length))
    shape, diffraction = surface.shape, surface.diffraction
    if isinstance(shape, RadialPolynomial) and shape.normalisation_mm == 1:
        found.append(Message("odd asphere: coefficients of r, r², … in mm {numbers:.6g}", numbers=shape.coefficients))
    elif shape is not None:
        even = isinstance(shape, RadialPolynomial) and shape.even
        found.append(
            Message(
                "{kind}: normalisation radius {radius:g} mm, coefficients {numbers:.6g} mm",
                kind=kind_of(shape),
                radius=shape.normalisation_mm,
                numbers=shape.coefficients[1::2] if even else shape.coefficients,
            )
        )
    if diffraction is not None:
        found.append(
            Message(
                "diffracts in order {order:g}: normalisation radius {radius:g} mm, phase in rad of ρ², ρ⁴, … "
                "{numbers:.6g}",
                order=diffraction.order,
                radius=diffraction.normalisation_mm,
                numbers=diffraction.coefficients,
            )
        )
    return tuple(found)
