"""What is open of the pupil of a source through a lens, and nodes over it, without a jagged edge (handbook 4.6)."""

from functools import lru_cache

from p2sf.disc.domain import ClearNodes
from p2sf.disc.open_part import OpenPart
from p2sf.disc.quadrature import disc_nodes
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.clear_curves import clear_curve, hole_curves
from p2sf.pupil.seen_mask import mask_seen


def whole_nodes(counts: tuple[int, int]) -> ClearNodes:
    """Return the nodes of (radial, angular) ``counts`` over the whole pupil, by its half ξ > 0."""
    nodes = disc_nodes(*counts)
    return ClearNodes(nodes.xi, nodes.eta, nodes.weight, 1.0)


@lru_cache(maxsize=16)
def clear_part(lens: Lens, source: Source, clip: bool = False, whole: bool = False) -> OpenPart:
    """Return what rims, holes and lost rays leave of the disc, without the mask.

    ``clip``: end the pupil at rims and holes. ``whole``: every ray of the disc is known to reach the sensor. Raises
    GeometryError where no part is clear.
    """
    if whole and not clip:
        return OpenPart(domain=lens.pupil_domain)
    rim, shadows = clear_curve(lens, source, clip), hole_curves(lens, source) if clip else ()
    return OpenPart(None if rim.whole else rim, shadows, domain=lens.pupil_domain)


@lru_cache(maxsize=16)
def open_part(lens: Lens, source: Source, clip: bool = False, whole: bool = False) -> OpenPart:
    """Return what the mask leaves open of the `clear_part`."""
    return clear_part(lens, source, clip, whole).behind(mask_seen(lens, source))


def pupil_nodes(
    lens: Lens, source: Source, counts: tuple[int, int], clip: bool = False, whole: bool = True
) -> ClearNodes:
    """Return nodes over the `open_part`, about as dense as ``counts`` are over the disc."""
    return open_part(lens, source, clip, whole and not clip).nodes(counts)
