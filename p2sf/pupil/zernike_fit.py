"""The exact wavefront of a source as a sum of terms that are orthogonal over its actual pupil (handbook 3.4).

Over the whole disc these are Zernike's polynomials. Over the part that rims or lost rays leave clear they are the same
polynomials orthogonalised there by Gram–Schmidt (Mahajan & Dai 2007); over a ring these are the annular polynomials of
Mahajan 1981. The mean squares then add up to the variance of the wavefront for any shape of the pupil.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np

from p2sf.disc.domain import ClearNodes
from p2sf.disc.mask import PupilMask
from p2sf.disc.tilt import rms
from p2sf.disc.zernike_terms import ZernikeOrder, ZernikeTerm, orthonormal_terms, zernike_terms
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.smooth_pupil import all_reach
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.pencil import displayed_opd
from p2sf.threads import one_blas_thread

COUNTS = 24, 64  # radii and directions: exact for terms up to degree 20 and a wavefront of degree 40
USUAL_TERMS = 37


@dataclass(frozen=True, eq=False)
class ZernikeFit:
    """The terms of a wavefront over its pupil, each array (terms,); light may fill only part of the pupil.

    ``waves``: coefficients, waves RMS in Noll's order and peak waves in the Fringe order, as both are defined on the
    disc. ``rms_waves``: each term's share of the RMS, with its sign. ``share``: of the variance without piston and
    tilt, which do not blur; 0 for those two. ``rms``: of the wavefront without piston and tilt; ``rms_with_tilt``
    without piston alone; ``residual``: of the remainder. ``clear``: the share of the pupil's area that passes light;
    below 1 the terms are orthogonal over that part. ``rays``: the number of rays traced.
    """

    basis: ZernikeOrder
    terms: tuple[ZernikeTerm, ...]
    waves: np.ndarray
    rms_waves: np.ndarray
    share: np.ndarray
    rms: float
    rms_with_tilt: float
    residual: float
    clear: float
    rays: int

    def __repr__(self) -> str:
        terms, strehl = f"{len(self.terms)} terms, {self.basis}", f"Strehl ratio by Maréchal {self.marechal:.3g}"
        return f"<ZernikeFit: {terms}, RMS {self.rms:.4g} waves, residual {self.residual:.2g}, {strehl}>"

    @property
    def marechal(self) -> float:
        """Return exp(−(2π·rms)²), the Strehl ratio of so small an RMS by Maréchal (Mahajan 1983, eq. 6)."""
        return float(np.exp(-((2 * np.pi * self.rms) ** 2)))


@one_blas_thread
def zernike_fit(
    lens: Lens, source: Source, basis: ZernikeOrder = "noll", count: int = USUAL_TERMS, clip: bool = False
) -> ZernikeFit:
    """Return the first ``count`` terms of the displayed OPD of exact rays; ``clip`` applies every clear semi-diameter.

    The phase of a mask is part of the wavefront. Raises RequestError for an order or a count that does not exist,
    GeometryError where no part of the pupil is clear and open.
    """
    terms = zernike_terms(basis, count)
    nodes, waves = pupil_opd(lens, source, clip)
    return decompose(nodes, waves, basis, terms)


def pupil_opd(
    lens: Lens, source: Source, clip: bool = False, counts: tuple[int, int] = COUNTS
) -> tuple[ClearNodes, np.ndarray]:
    """Return nodes over the open part of the pupil and the displayed OPD there, waves, (nodes,).

    The nodes are those of `Lens.pupil_domain`. Raises GeometryError where nothing is open.
    """
    mask, (radial, angular) = mask_seen(lens, source), counts
    if mask.disc.centred:
        radial = ceil((radial - 4) / (1 - mask.obscuration)) + 4  # as many in the ring as in the disc
    nodes = pupil_nodes(lens, source, (radial, angular), clip, all_reach(lens, source))
    return nodes, displayed_opd(lens, source, nodes.xi, nodes.eta) - path_waves(mask, source, nodes)


def path_waves(mask: PupilMask, source: Source, nodes: ClearNodes) -> np.ndarray:
    """Return by how much a mask shortens W at nodes, waves, against the chief ray."""
    centre = mask.path_um(np.zeros(1), np.zeros(1))
    waves: np.ndarray = (mask.path_um(nodes.xi, nodes.eta) - centre) / source.wavelength_um
    return waves


def decompose(nodes: ClearNodes, waves: np.ndarray, basis: ZernikeOrder, terms: tuple[ZernikeTerm, ...]) -> ZernikeFit:
    """Return the terms of a wavefront at nodes, (nodes,) waves; nodes of the half disc mean one that is even in ξ.

    Terms that are odd in ξ are then zero. The others are orthogonalised in order over the nodes, as `orthonormal_terms`
    does; over the whole disc that changes nothing.
    """
    there = [number for number, term in enumerate(terms) if term.odd in nodes.domain.parities(False)]
    columns = orthonormal_terms(tuple(terms[k] for k in there), nodes)
    found = np.zeros(len(terms))
    found[there] = columns.T @ (nodes.weight * waves)
    rest = waves - columns @ found[there]
    blur = rms(waves, nodes.weight, nodes.axes)
    still = np.array([term.n < 2 for term in terms])  # piston and tilt
    scale = np.array([term.norm if basis == "fringe" else 1.0 for term in terms])
    return ZernikeFit(
        basis=basis,
        terms=terms,
        waves=found * scale,
        rms_waves=found,
        share=np.where(still, 0.0, found**2) / (blur**2 or 1.0),
        rms=blur,
        rms_with_tilt=rms(waves, nodes.weight),
        residual=float(np.sqrt(max(float(nodes.weight @ rest**2), 0.0))),  # of weights that may be negative
        clear=nodes.share,
        rays=nodes.xi.size,
    )
