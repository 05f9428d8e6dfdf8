"""Points along the outline of an iris, from which rows of nodes go to the middle line ξ = 0.

Gauss–Legendre along each blade's edge: by Green's theorem the integral over the open part is one along its outline, and
each edge is smooth.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil

import numpy as np

from p2sf.conventions import protected
from p2sf.pupil.mask import BladeEdge, PupilMask
from p2sf.pupil.quadrature import RowNodes, gauss_legendre

EDGE_NODES = 5  # more on each edge than its part of a diameter's
AXIS = 1e-12  # an edge that comes this close to an axis ends there


@dataclass(frozen=True)
class OutlinePoints:
    """Points (ξ, η) clockwise along an outline and the steps dξ and dη there, each (points,).

    Of an outline that is even in ξ there is the half ξ > 0.
    """

    xi: np.ndarray
    eta: np.ndarray
    step_xi: np.ndarray
    step_eta: np.ndarray


@lru_cache(maxsize=16)
def outline_points(mask: PupilMask, rows: int) -> OutlinePoints:
    """Return points along the blades, as dense as ``rows`` are along a diameter."""
    parts = [_along(edge, *ends, rows) for edge in mask.edges for ends in _ends(edge, mask.even, False)]
    return OutlinePoints(*(protected(np.concatenate(column)) for column in zip(*parts, strict=True)))


@lru_cache(maxsize=16)
def quarter_rows(mask: PupilMask, rows: int, columns: int) -> RowNodes:
    """Return rows of equal η over a quarter of an iris that is even in ξ and in η; weights sum to its share."""
    parts = [_along(edge, *ends, rows) for edge in mask.edges for ends in _ends(edge, True, True)]
    xi, eta, _, step = (np.concatenate(column) for column in zip(*parts, strict=True))
    lies = np.abs(step) > AXIS * np.abs(step).max()  # a level edge adds nothing
    xi, eta, step = xi[lies], eta[lies], step[lies]
    node, weight = (x[columns // 2 :] for x in gauss_legendre(columns))
    share = np.outer(-4 / np.pi * step * xi, weight)
    name = f"{2 * xi.size} × {columns} Gauss–Legendre nodes"
    return RowNodes(protected(eta), protected(np.outer(xi, node)), protected(share), name)


def _along(edge: BladeEdge, low: float, high: float, rows: int) -> tuple[np.ndarray, ...]:
    """Return points of an edge between two places on its chord, and the steps dξ and dη of the rule."""
    half = (high - low) / 2
    node, weight = gauss_legendre(ceil(half * rows) + EDGE_NODES)
    xi, eta, xi_slope, eta_slope = edge.points((low + high) / 2 + half * node)
    return xi, eta, half * weight * xi_slope, half * weight * eta_slope


def _ends(edge: BladeEdge, right: bool, upper: bool) -> list[tuple[float, float]]:
    """Return the part of an edge at ξ > 0 and at η > 0, where asked for; by symmetry an axis halves it."""
    half = edge.half_length
    low, high = -half, half
    for wanted, axis in ((right, 0), (upper, 1)):
        if not wanted:
            continue
        start, end = edge.points(np.array([-half, half]))[axis].tolist()
        if max(start, end) < AXIS:
            return []
        if min(start, end) < -AXIS:
            low, high = (0.0, high) if start < 0 else (low, 0.0)
    return [(low, high)]
