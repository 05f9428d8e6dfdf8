"""The lens itself: no PSF is stored, and each is traced when it is asked for."""

from collections.abc import Callable, Iterator

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from tests.benchmarks.representations.representation import Representation, huygens_picture, traced_picture
from tests.benchmarks.representations.space import LensSpace, SpacePoints

PER_SURFACE = 3  # curvature, thickness, clear radius
PER_GLASS = 6  # of Sellmeier's formula
VALUE_BYTES = 8


def ray_representations(space: LensSpace) -> Iterator[Representation]:
    """Yield the lens by exact rays in rows of equal frequency, and by the settled Huygens sum."""
    numbers = prescription_numbers(space.lens)
    for family, picture in (("traced", traced_picture), ("huygens", huygens_picture)):

        def psf(points: SpacePoints, picture: Callable[[LensSpace, Source], np.ndarray] = picture) -> np.ndarray:
            return np.stack([picture(space, source) for source in points.sources()])

        yield Representation(family, "the prescription", numbers, VALUE_BYTES * numbers, 0.0, psf)


def prescription_numbers(lens: Lens) -> int:
    """Return how many numbers a prescription holds: surfaces, their figures, and six for each glass."""
    figures = sum((surface.conic != 0) + len(surface.aspheric) for surface in lens.surfaces)
    parts = (part for s in lens.surfaces for part in (s.shape, s.diffraction, s.irregularity, s.transmission))
    figures += sum(len(part.numbers) for part in parts if part is not None)
    figures += sum(surface.ideal for surface in lens.surfaces)
    glasses = {surface.medium for surface in lens.surfaces if surface.medium.label != "air"}
    return PER_SURFACE * len(lens.surfaces) + figures + PER_GLASS * len(glasses) + 1
