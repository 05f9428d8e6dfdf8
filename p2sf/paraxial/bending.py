"""Bending a lens element at constant thin-lens power, and its shape factor.

The power of a thin element is the sum of the powers of its surfaces, (n′ − n)c (Welford 1986, ch. 3). Adding the same
curvature to all of them adds (n_last − n_first)·Δc, which vanishes if the same medium lies on both sides (Kingslake and
Johnson 2010, ch. 3): the element, cemented or not, changes its shape and hardly its power.
"""

from dataclasses import replace
from itertools import pairwise
from math import inf

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, Surface, indices, surface_power

IMMERSED = 1.0001  # of the refractive index: less than this is air
FLAT = 1e-12  # of the larger curvature: a smaller difference is rounding


def elements(lens: Lens) -> tuple[tuple[int, int], ...]:
    """Return the elements in air as (first, last) surface from 1; cemented elements count as one.

    Parts with air on one side only, such as the eye, and glass with a mirror on it are not elements.
    """
    index = indices(lens, lens.reference_wavelength_um)
    spans, first = [], 0
    for surface, (before, after) in enumerate(pairwise(np.abs(index)), 1):
        if before < IMMERSED <= after:
            first = surface
        elif first and after < IMMERSED <= before:
            if lens.directions[first - 1] == lens.directions[surface]:
                spans.append((first, surface))
            first = 0
    return tuple(spans)


def element_of(lens: Lens, surface: int) -> tuple[int, int] | None:
    """Return the element of `elements` that a surface (from 1) belongs to, None for a stop or the eye."""
    return next((span for span in elements(lens) if span[0] <= surface <= span[1]), None)


def thin_power(lens: Lens, first: int, last: int, wavelength_um: FloatOrArray | None = None) -> FloatOrArray:
    """Return the sum of the powers (n′ − n)c of surfaces ``first`` to ``last`` (from 1), per mm."""
    wave = lens.reference_wavelength_um if wavelength_um is None else wavelength_um
    index = indices(lens, wave)
    power: FloatOrArray = sum(
        surface_power(lens.surfaces[number - 1], index[number - 1], index[number], wave)
        for number in range(first, last + 1)
    )
    return power


def shape_factor(lens: Lens, first: int, last: int) -> float:
    """Return X = (c₁ + c₂)/(c₁ − c₂) of the outer curvatures (Coddington; Welford 1986, ch. 12), inf where c₁ = c₂.

    0 is equiconvex or equiconcave, 1 has a plane second surface, −1 a plane first one.
    """
    one, two = lens.curvatures[first - 1], lens.curvatures[last - 1]
    if abs(one - two) <= FLAT * max(abs(one), abs(two)):
        return inf
    return (one + two) / (one - two)


def bend(lens: Lens, first: int, last: int, by_per_mm: float) -> Lens:
    """Return the lens with a curvature, 1/mm, added to every surface of an element, which keeps its thin-lens power.

    Conic constants, aspheric terms and thicknesses stay. Raises GeometryError unless the surfaces are an element of
    `elements`.
    """
    if (first, last) not in elements(lens):
        raise GeometryError(
            "surfaces {first} to {last} are not an element with air on both sides; choose such an element",
            first=first,
            last=last,
        )
    made = (*(add_curvature(surface, by_per_mm) for surface in lens.surfaces[first - 1 : last]),)
    return replace(lens, surfaces=(*lens.surfaces[: first - 1], *made, *lens.surfaces[last:]))


def with_shape_factor(lens: Lens, first: int, last: int, shape: float) -> Lens:
    """Return the lens with an element bent to a `shape_factor` by `bend`; GeometryError for one without power."""
    before = shape_factor(lens, first, last)
    if before == inf:
        raise GeometryError(
            "surfaces {first} and {last} are equally curved, so the element has no shape factor; change a radius first",
            first=first,
            last=last,
        )
    return bend(lens, first, last, (shape - before) * (lens.curvatures[first - 1] - lens.curvatures[last - 1]) / 2)


def add_curvature(surface: Surface, by_per_mm: float) -> Surface:
    """Return a surface with its curvature changed; a plane where only rounding is left."""
    curvature = surface.curvature + by_per_mm
    rounding = FLAT * max(abs(surface.curvature), abs(by_per_mm))
    return replace(surface, radius=inf if abs(curvature) <= rounding else 1 / curvature)
