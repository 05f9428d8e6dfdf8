"""The exact wavefront of a source as a sum of terms that are orthogonal over the pupil in force (handbook 3.4).

Over the whole disc these are Zernike's polynomials. Over the part that rims or lost rays leave clear they are the same
polynomials made orthogonal there in turn, by Gram and Schmidt (Mahajan & Dai 2007); over a ring these are the annular
polynomials of Mahajan 1981. The mean squares then add up to the variance of the wavefront, whatever the pupil's shape.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.mask_nodes import ClearNodes
from p2sf.pupil.tilt import rms
from p2sf.pupil.zernike_terms import ZernikeOrder, ZernikeTerm, zernike_terms, zernike_values
from p2sf.raytrace.pencil import displayed_opd, pencil
from p2sf.raytrace.vignetting import clear_nodes, pupil_nodes
from p2sf.threads import one_blas_thread

COUNTS = 24, 64  # radii and directions: exact for terms up to degree 20 and a wavefront of degree 40
USUAL_TERMS = 37
RIM_RAYS = 65  # on the rim's right half, which is clipped first


@dataclass(frozen=True)
class ZernikeFit:
    """A wavefront's terms over the pupil in force, each array (terms,); its light may fill part of the pupil only.

    ``waves``: coefficients, waves RMS in Noll's order and peak waves in the Fringe order, as both are defined on the
    disc. ``rms_waves``: each term's share of the RMS, with its sign. ``share``: of the variance without piston and
    tilt, which do not blur; 0 for those two. ``rms``: of the wavefront without piston and tilt; ``rms_with_tilt``
    without piston alone; ``residual``: of what the terms leave. ``clear``: the part of the pupil's area that
    passes light; below 1 the terms are orthogonal over that part. ``rays``: how many were traced.
    """

    order: ZernikeOrder
    terms: tuple[ZernikeTerm, ...]
    waves: np.ndarray
    rms_waves: np.ndarray
    share: np.ndarray
    rms: float
    rms_with_tilt: float
    residual: float
    clear: float
    rays: int


@one_blas_thread
def zernike_fit(
    lens: Lens, source: Source, order: ZernikeOrder = "noll", count: int = USUAL_TERMS, clip: bool = False
) -> ZernikeFit:
    """Return the first ``count`` terms of the displayed OPD of exact rays; ``clip`` applies every clear semi-diameter.

    Raises RequestError for an order or a count that does not exist, GeometryError where no part of the pupil is clear,
    and for what stands in the stop beside an obscuration.
    """
    terms = zernike_terms(order, count)
    nodes, waves = pupil_opd(lens, source, clip)
    return decompose(nodes, waves, order, terms)


def pupil_opd(
    lens: Lens, source: Source, clip: bool = False, counts: tuple[int, int] = COUNTS
) -> tuple[ClearNodes, np.ndarray]:
    """Return nodes over the clear part of the pupil and the displayed OPD there, waves, (nodes,).

    The nodes are those of `Lens.pupil_domain`.
    """
    nodes = open_nodes(lens, source, counts)
    turn = np.linspace(0, np.pi, RIM_RAYS)
    rim = lens.pupil_domain.points(np.sin(turn), np.cos(turn))
    tried = np.append(nodes.xi, rim[0]), np.append(nodes.eta, rim[1])
    if not pencil(lens, source, *tried, clip).passed.all():
        if not lens.mask.clear:
            raise GeometryError(
                "rims cut off a pupil that has an obscuration, or some of its rays are lost, but annular terms need "
                "a whole ring; leave {parameter} off, stop the lens down, or remove the obscuration",
                parameter="clip",
            )
        nodes = clear_nodes(lens, source, counts, clip)
    return nodes, displayed_opd(lens, source, nodes.xi, nodes.eta)


def open_nodes(lens: Lens, source: Source, counts: tuple[int, int]) -> ClearNodes:
    """Return nodes over the disc, or the ring about an obscuration; GeometryError for what else stands in the stop."""
    mask = lens.mask
    if not (mask.clear or mask.annular):
        raise GeometryError(
            "Zernike terms are over a disc or a ring, and more than an obscuration in its middle stands in the stop; "
            "remove vanes, blades, filters and phases, and put an obscuration in the middle"
        )
    radial = ceil((counts[0] - 4) / (1 - mask.obscuration)) + 4  # as many in the ring as else in the disc
    return pupil_nodes(lens, source, (radial, counts[1]))


def decompose(nodes: ClearNodes, waves: np.ndarray, order: ZernikeOrder, terms: tuple[ZernikeTerm, ...]) -> ZernikeFit:
    """Return the terms of a wavefront at nodes, (nodes,) waves; nodes of the half disc stand for one even in ξ.

    Terms that are odd in ξ are then zero. Each of the others is made orthogonal to those before it, as a QR
    decomposition of the terms at the weighted nodes does (Mahajan & Dai 2007, eq. 11); over the whole disc that changes
    nothing.
    """
    there = [number for number, term in enumerate(terms) if term.even or not nodes.even]
    root = np.sqrt(nodes.weight)
    columns, lengths = np.linalg.qr((zernike_values(tuple(terms[k] for k in there), nodes.xi, nodes.eta) * root).T)
    columns *= np.sign(np.diag(lengths))
    found = np.zeros(len(terms))
    found[there] = columns.T @ (root * waves)
    rest = root * waves - columns @ found[there]
    blur = rms(waves, nodes.weight, nodes.axes)
    still = np.array([term.n < 2 for term in terms])  # piston and tilt
    scale = np.array([term.norm if order == "fringe" else 1.0 for term in terms])
    return ZernikeFit(
        order=order,
        terms=terms,
        waves=found * scale,
        rms_waves=found,
        share=np.where(still, 0.0, found**2) / (blur**2 or 1.0),
        rms=blur,
        rms_with_tilt=rms(waves, nodes.weight),
        residual=float(np.linalg.norm(rest)),
        clear=nodes.share,
        rays=nodes.xi.size,
    )
