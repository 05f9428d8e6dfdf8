"""The central obscuration of a telescope, computed from the rims and holes of its mirrors in first order."""

from collections.abc import Iterator
from math import inf

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import find_stop, paraxial_rays


def central_obscuration(lens: Lens, depth_mm: float = inf) -> float:
    """Return the ratio of the radii of central obscuration and pupil for a point on the axis; 0 if there is none.

    A hole obscures the ratio of its radius to the height of the marginal ray on that surface. A mirror obscures the
    ratio of its rim to the height of the marginal ray where light passes it from behind, between two other surfaces.
    Raises GeometryError if no light passes or there is no marginal ray.
    """
    rays = paraxial_rays(lens, depth_mm, lens.reference_wavelength_um, find_stop(lens, depth_mm))
    heights = np.abs(np.asarray(rays.y, float))
    holes = [s.inner_radius / y for s, y in zip(lens.surfaces, heights, strict=True) if s.inner_radius]
    share = max([0.0, *holes, *_shadows(lens, np.asarray(rays.y, float), np.asarray(rays.nu, float), rays.index)])
    if not share < 1:
        raise GeometryError(
            "rims and holes of mirrors obscure {share:.3g} of the pupil's radius, so no light passes; make them "
            "smaller",
            share=share,
        )
    return float(share)


def _shadows(lens: Lens, y: np.ndarray, nu: np.ndarray, index: np.ndarray) -> Iterator[float]:
    """Yield the share of the marginal ray's height that each mirror with a rim obscures where light passes it."""
    place = np.array(lens.vertices[:-1])
    for number, surface in enumerate(lens.surfaces):
        if not (surface.reflects and np.isfinite(surface.semi_diameter)):
            continue
        for gap in range(len(lens.surfaces)):  # the path to each surface
            begin = -inf if gap == 0 else place[gap - 1]
            low, high = sorted((begin, place[gap]))
            if number not in (gap, gap - 1) and low < place[number] < high:
                slope = nu[gap] / float(np.ravel(index[gap])[0])
                yield surface.semi_diameter / abs(y[gap] - slope * (place[gap] - place[number]))
