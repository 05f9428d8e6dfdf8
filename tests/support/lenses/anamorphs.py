"""Lenses with two meridians, and what rays in either of these say: by products of 2 × 2 matrices of their own."""

from dataclasses import replace
from math import inf

import numpy as np

from p2sf.glass.media import AIR, ConstantIndex
from p2sf.lens.anamorphic import Toroid
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.placement import Placement

INDEX = 1.5168


def element(radius_y, radius_x, thickness, space, rim=15.0, **breaks):
    """Return a plane lens with one curved side, bent by its own radius in yz and in xz."""
    if radius_y == radius_x:
        front = Surface(radius_y, thickness, ConstantIndex(INDEX), semi_diameter=rim, **breaks)
    else:
        shape = Toroid(radius_x=radius_x, radius_y=radius_y)
        front = Surface(inf, thickness, ConstantIndex(INDEX), semi_diameter=rim, shape=shape, **breaks)
    return front, Surface(inf, space, AIR, semi_diameter=rim)


# Of every lens its elements: radius in yz and in xz, thickness, space behind, mm.
CYLINDER = ((2.0202, inf, 3.0, 1.93121),)
ANAMORPH = (
    (inf, 67.233, 4.0, 60.0),
    (inf, -34.862, 2.0, 3.0),
    (16.124, 16.124, 4.0, 28.5626),
)  # f' 31.20 mm in y, 60.17 mm in x


def lens_of(elements, rim, stop, name, fields=(0.0, 3.0)) -> Lens:
    surfaces = tuple(surface for rows in elements for surface in element(*rows))
    return Lens(surfaces, Aperture("stop_semi_diameter", rim), stop, fields_deg=fields, name=name)


def cylinder() -> Lens:
    """Return a plano-convex cylinder of the dimensions of LJ1598L1 of Thorlabs."""
    return lens_of(CYLINDER, 0.5, 1, "cylinder")


def anamorph() -> Lens:
    """Return a lens behind an afocal pair of cylinders, which magnifies in x alone."""
    return lens_of(ANAMORPH, 1.5, 5, "anamorph", (0.0, 2.0, 4.0))


def turned_by_breaks(lens: Lens) -> Lens:
    """Return the lens with each element a quarter turn about z before it, and back behind it."""
    surfaces = list(lens.surfaces)
    for k in range(0, len(surfaces), 2):
        surfaces[k] = replace(surfaces[k], before=(Placement(tilt_z_deg=30.0), Placement(tilt_z_deg=60.0)))
        surfaces[k + 1] = replace(surfaces[k + 1], after=(Placement(tilt_z_deg=-90.0),))
    return replace(lens, surfaces=tuple(surfaces))


def figures(elements, meridian: str) -> dict[str, float]:
    """Return focal lengths by the system matrix of one meridian: refractions and translations of (y, slope).

    A refraction at radius R from n to n' has the rows (1, 0) and ((n − n')/(n'R), n/n').
    """
    system = np.eye(2)
    for number, (radius_y, radius_x, thickness, space) in enumerate(elements, 1):
        radius = radius_y if meridian == "y" else radius_x
        front = np.array([[1.0, 0.0], [(1 - INDEX) / (INDEX * radius), 1 / INDEX]])
        through = np.array([[1.0, thickness], [0.0, 1.0]])
        rear = np.array([[1.0, 0.0], [0.0, INDEX]])
        system = rear @ through @ front @ system
        if number < len(elements):
            system = np.array([[1.0, space], [0.0, 1.0]]) @ system
    (a, _), (c, d) = system
    with np.errstate(divide="ignore"):
        focal = float(np.divide(-1.0, c)) if abs(c) > 1e-15 else inf
    return {
        "effective_focal_length": focal,
        "back_focal_distance": focal * a if np.isfinite(focal) else inf,
        "front_focal_distance": -focal * d if np.isfinite(focal) else inf,
    }
