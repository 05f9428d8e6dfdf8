"""The two meridians of a lens whose surfaces are bent more strongly one way than the other."""

from dataclasses import replace
from functools import lru_cache
from math import inf
from typing import NamedTuple

from p2sf.lens.lens import Lens, Surface

FLAT = 1e-15  # per mm: what rounding leaves of a section along a cylinder


class Meridians(NamedTuple):
    """A lens for paraxial rays in yz and in xz; both are the same lens if every surface bends alike in all directions.

    Sections of surfaces turned by other angles than right ones send rays out of their meridian, which is left out.
    """

    y: Lens
    x: Lens


def meridians(lens: Lens) -> Meridians:
    """Return the lens for paraxial rays in each of its meridians."""
    return Meridians(in_meridian(lens, 0.0), in_meridian(lens, 90.0))


@lru_cache(maxsize=16)
def in_meridian(lens: Lens, azimuth_deg: float) -> Lens:
    """Return the lens for paraxial rays in one meridian, from +y towards +x: with the curvatures of its shapes there.

    Azimuths are those of the axes before the first surface: breaks turn shapes with their axes about z. A lens whose
    surfaces bend alike in all directions is returned unchanged.
    """
    if all(surface.shape is None or surface.shape.radial for surface in lens.surfaces):
        return lens
    surfaces, turned = [], azimuth_deg
    for surface in lens.surfaces:
        turned += sum(each.tilt_z_deg for each in surface.before)
        surfaces.append(_section(surface, turned))
        turned += sum(each.tilt_z_deg for each in surface.after)
    return replace(lens, surfaces=tuple(surfaces))


def _section(surface: Surface, azimuth_deg: float) -> Surface:
    """Return the surface of revolution that has the curvature at the vertex of this surface's section."""
    if surface.shape is None or surface.shape.radial:
        return surface
    bend = surface.curvature + surface.shape.curvature_at(azimuth_deg)
    return replace(surface, shape=None, radius=1 / bend if abs(bend) > FLAT else inf)
