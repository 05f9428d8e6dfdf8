"""Ideal lenses: planes that image every point sharply onto its paraxial image (handbook 8.9).

A point is (X, Y, Z, W), homogeneous: it lies at (X, Y, Z)/W, and for W = 0 infinitely far in the direction (X, Y, Z).
So no depth is a special case, not even an image at infinity.
"""

from typing import TypeAlias

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.lens.lens import Lens, surface_power
from p2sf.raytrace.surface import Beam

Point: TypeAlias = tuple[FloatOrArray, FloatOrArray, FloatOrArray, FloatOrArray]


def object_point(lens: Lens, beam: Beam, index: "np.ndarray | list[float]", number: int) -> Point | None:
    """Return the point that surface ``number`` images, in its axes: the image of the source by the surfaces before it.

    It is the paraxial image, exact if those surfaces are ideal as well. None for a beam whose source is unknown.
    """
    point = beam.source
    if point is None:
        return None
    for place, surface in enumerate(lens.surfaces[:number]):
        point = _in_next_axes(point, lens, place)
        if place + 1 < number:
            before, after = index[place], index[place + 1]
            point = image_point(point, surface_power(surface, before, after, beam.wavelength_um), before, after)
    return point


def _in_next_axes(point: Point, lens: Lens, place: int) -> Point:
    """Return a point in the axes of the next surface."""
    rotation, origin = lens.motions[place]
    x, y, z = (part - shift * point[3] for part, shift in zip(point[:3], origin, strict=True))
    x, y, z = (rotation[0, k] * x + rotation[1, k] * y + rotation[2, k] * z for k in range(3))
    return x, y, z, point[3]


def image_point(point: Point, power: FloatOrArray, before: FloatOrArray, after: FloatOrArray) -> Point:
    """Return the Gaussian image by a surface at z = 0: n'/z' = n/z + power, x'/x = nz'/(n'z) (Welford 1986, ch. 3)."""
    x, y, z, w = point
    return x, y, z * (after / before), w + power / before * z


def refract_ideal(
    beam: Beam, focal_length: float, before: FloatOrArray, after: FloatOrArray, point: Point | None
) -> None:
    """Bend rays that stand on an ideal lens, in the plane z = 0, by n'·tan U' = n·tan U − x/f, and so along y.

    With the tangents every ray from a point passes through its Gaussian image. The path that the lens adds makes all
    paths between the two points equal, as Fermat's principle requires for a sharp image: with O and O' the points and V
    the vertex, n(|OV| − |OP|) + n'(|VO'| − |PO'|) at P, zero at the vertex; signed, so that paths to virtual points are
    negative. It is NaN if the point is unknown.
    """
    here = beam.place[:2].copy()
    tangents = (before * beam.ray[:2] / beam.r - here / focal_length) / after
    beam.r[...] = after / np.sqrt(1 + tangents[0] ** 2 + tangents[1] ** 2)
    beam.ray[:2] = tangents * beam.r
    if point is None:
        beam.path[...] = np.nan
        return
    image = image_point(point, 1 / focal_length, before, after)
    beam.path += after * _path_difference(image, *here) - before * _path_difference(point, *here)


def _path_difference(point: Point, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return |OV| − |OP| for P = (x, y, 0), mm, with the sign of z of O, without subtracting distances."""
    across, up, along, w = point
    whole = np.sqrt(across * across + up * up + along * along)
    other = np.sqrt((across - w * x) ** 2 + (up - w * y) ** 2 + along * along)
    lead: np.ndarray = np.sign(along) * (2 * (across * x + up * y) - w * (x * x + y * y)) / (whole + other)
    return lead
