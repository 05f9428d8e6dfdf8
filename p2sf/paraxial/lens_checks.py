"""Checks for lenses that can be computed but not made: rims beyond their surfaces, glass of negative thickness."""

from collections.abc import Iterator
from math import inf, isfinite, sqrt

import numpy as np

from p2sf.errors import GeometryError
from p2sf.glass.media import AIR
from p2sf.lens.lens import Lens, Surface, indices
from p2sf.lens.positions import steps_between
from p2sf.messages import Message
from p2sf.paraxial.pupils import default_stop, stop_rim

BEYOND = 1.001  # of the normalisation radius: smaller differences are rounding
AIR_LIKE = 1.01  # largest index of a gas


def lens_checks(lens: Lens) -> tuple[Message, ...]:
    """Return warnings about rims beyond their surfaces, glass of negative thickness, and surfaces that do not refract.

    Also about unknown absorption and, for a zoom between its columns, about each medium and every other property that
    is not interpolated.

    Raises GlassError for a reference wavelength outside a glass's data.
    """
    rims = (_rim_beyond_its_sphere(number, surface) for number, surface in enumerate(lens.surfaces, 1))
    shapes = (_rim_beyond_its_shape(number, surface) for number, surface in enumerate(lens.surfaces, 1))
    media = (*negative_glass(lens), _nothing_bends(lens), _unknown_absorption(lens))
    found = (*rims, *shapes, _stop_beyond_its_sphere(lens), *media)
    return (*(warning for warning in found if warning), *steps_between(lens))


def edge(surface: Surface) -> float:
    """Return the largest height of a closed conicoid, |R|/√(1 + K), mm; inf for an open one."""
    if not isfinite(surface.radius) or surface.conic <= -1:
        return inf
    return abs(surface.radius) / sqrt(1 + surface.conic)


def _rim_beyond_its_sphere(number: int, surface: Surface) -> Message | None:
    if not edge(surface) < surface.semi_diameter < inf:
        return None
    return Message(
        "surface {surface} has a clear semi-diameter of {rim:g} mm, but with its radius of {radius:g} mm it ends at "
        "{edge:.6g} mm; correct one of the two",
        surface=number,
        rim=surface.semi_diameter,
        radius=surface.radius,
        edge=edge(surface),
    )


def _rim_beyond_its_shape(number: int, surface: Surface) -> Message | None:
    """Return a warning for a rim beyond the normalisation radius, where Forbes's polynomials grow fast."""
    shape = surface.shape
    if shape is None or not shape.ends or not shape.normalisation_mm * BEYOND < surface.semi_diameter < inf:
        return None
    return Message(
        "surface {surface} has a clear semi-diameter of {rim:g} mm, beyond the normalisation radius of {radius:g} mm "
        "up to which its polynomials describe it; correct one of the two",
        surface=number,
        rim=surface.semi_diameter,
        radius=shape.normalisation_mm,
    )


def _stop_beyond_its_sphere(lens: Lens) -> Message | None:
    try:
        number = lens.stop_surface or default_stop(lens)
        rim = float(stop_rim(lens))
    except GeometryError:  # an impossible aperture is refused where it is needed
        return None
    surface = lens.surfaces[number - 1]
    if rim <= edge(surface):
        return None
    return Message(
        "the stop on surface {surface} has a semi-diameter of {rim:.6g} mm, but with a radius of {radius:g} mm that "
        "surface ends at {edge:.6g} mm; stop the lens down or move the stop",
        surface=number,
        rim=rim,
        radius=surface.radius,
        edge=edge(surface),
    )


def negative_glass(lens: Lens) -> Iterator[Message]:
    """Yield a warning for each glass of negative thickness; in air a negative thickness describes a virtual object."""
    index = np.abs(indices(lens, lens.reference_wavelength_um))
    for number, gap in enumerate(lens.gaps[:-1], 1):
        if gap * lens.directions[number] < 0 and index[number] > AIR_LIKE:
            yield Message(
                "the glass behind surface {surface} has a thickness of {thickness:g} mm, opposite to the direction of "
                "light; change its sign or its neighbours",
                surface=number,
                thickness=gap,
            )


def _nothing_bends(lens: Lens) -> Message | None:
    index = indices(lens, lens.reference_wavelength_um)
    if np.ptp(index) or any(surface.diffraction or surface.ideal for surface in lens.surfaces):
        return None
    return Message(
        "every medium of this lens has the index {index:g}, so no surface bends light; state its glasses",
        index=float(index[0]),
    )


def _unknown_absorption(lens: Lens) -> Message | None:
    """Return a warning if absorption is on and media count as clear because their transmittance is unknown."""
    media = zip(lens.media, lens.absorbs, strict=True)
    unknown = dict.fromkeys(medium.label for medium, lost in [*media][1:] if not lost and medium != AIR)
    if not (lens.absorption and unknown):
        return None
    return Message(
        "absorption is on, but the internal transmittance of {glasses} is unknown, so they count as clear; import the "
        "lens with their catalogues in the AGF format",
        glasses=tuple(unknown),
    )
