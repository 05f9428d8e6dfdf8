"""What is wrong with a lens that can nevertheless be computed: rims where there is no glass, and lenses of nothing."""

from math import inf, isfinite, sqrt

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, Surface, indices
from p2sf.paraxial.pupils import named_stop, stop_rim


def lens_checks(lens: Lens) -> tuple[str, ...]:
    """Return a sentence for everything about a lens that no workshop could make or that does nothing, lengths in mm.

    Raises GlassError for a reference wavelength outside a glass's data.
    """
    rims = (_rim_beyond_its_sphere(number, surface) for number, surface in enumerate(lens.surfaces, 1))
    found = (*rims, _stop_beyond_its_sphere(lens), _nothing_bends(lens))
    return tuple(sentence for sentence in found if sentence)


def edge(surface: Surface) -> float:
    """Return the height at which a conicoid turns back on itself, |R|/√(1 + K), mm; inf for one that never does."""
    if not isfinite(surface.radius) or surface.conic <= -1:
        return inf
    return abs(surface.radius) / sqrt(1 + surface.conic)


def _rim_beyond_its_sphere(number: int, surface: Surface) -> str | None:
    if not edge(surface) < surface.semi_diameter < inf:
        return None
    return (
        f"surface {number} has a clear semi-diameter of {surface.semi_diameter:g} mm, but its radius of "
        f"{surface.radius:g} mm ends it at {edge(surface):.6g} mm; correct one of the two"
    )


def _stop_beyond_its_sphere(lens: Lens) -> str | None:
    try:
        number = lens.stop_surface or named_stop(lens)
        rim = float(stop_rim(lens))
    except GeometryError:  # an aperture that cannot be is refused by whoever needs it
        return None
    surface = lens.surfaces[number - 1]
    if rim <= edge(surface):
        return None
    return (
        f"the stop on surface {number} has a semi-diameter of {rim:.6g} mm, but a radius of {surface.radius:g} mm "
        f"ends that surface at {edge(surface):.6g} mm; stop the lens down or move the stop"
    )


def _nothing_bends(lens: Lens) -> str | None:
    index = indices(lens, lens.reference_wavelength_um)
    if np.ptp(index):
        return None
    return f"every medium of this lens has the index {float(index[0]):g}, so no surface bends light; name its glasses"
