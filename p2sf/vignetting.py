"""Pupil nodes that end at the clear apertures: the cat's eye of an oblique pencil, without a jagged edge.

From a centre inside the clear part every direction is followed to the rim it meets (bisection on real rays), and
Gauss–Legendre radii run to exactly there, so that no edge crosses a node's cell. The part must be star-shaped
about its centre, as every overlap of rims seen through a lens is. What is lost: at the corners of the cat's
eye the rim has a kink, and convergence in the number of directions is only second order there; the reference
measures what that leaves and reports it.
"""

from dataclasses import dataclass

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens import Lens
from p2sf.quadrature import disc_nodes, gauss_legendre
from p2sf.rayfit import fit
from p2sf.raytrace import hexapolar, pencil
from p2sf.source import Source

SEARCH_RINGS = 12
BISECTIONS = 36  # the pupil radius to 2e-11


@dataclass(frozen=True)
class ClearShape:
    """The clear part of the pupil: its centre on the η axis, and its radius per direction of the half circle."""

    centre: float
    radius: np.ndarray


@dataclass(frozen=True)
class ClearNodes:
    """Half-disc nodes (ξ, η) with weights of unit sum, and the clear share of the pupil's area."""

    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    share: float


def clear_nodes(counts, shape: ClearShape | None) -> ClearNodes:
    """Return the nodes of (radial, angular) ``counts`` over the whole pupil, or over its clear part."""
    if shape is None:
        nodes = disc_nodes(*counts)
        return ClearNodes(nodes.xi, nodes.eta, nodes.weight, 1.0)
    square, weight = gauss_legendre(counts[0])
    rho = np.sqrt((1 + square) / 2)[:, None] * shape.radius
    theta = directions(counts[1])
    area = (weight[:, None] * shape.radius**2 / counts[1]).ravel()
    xi, eta = (rho * np.sin(theta)).ravel(), (shape.centre + rho * np.cos(theta)).ravel()
    return ClearNodes(xi, eta, area / area.sum(), float(area.sum()))


def pencil_blur(lens: Lens, source: Source, nodes: ClearNodes, aim: str) -> float | None:
    """Return ∫|field|²dx in µm² by Parseval from the fitted pupil map; None where rays are lost and none is fitted."""
    try:
        found = fit(lens, source, aim=aim)
    except GeometryError:
        return None
    if nodes.share == 1.0:
        return found.blur_um2
    return float(nodes.weight @ (1 / np.abs(found.jacobian(nodes.xi, nodes.eta))) / (np.pi * nodes.share))


def directions(count: int) -> np.ndarray:
    """Return the angles from +η of the half circle's share of ``count`` uniform directions."""
    return (np.arange(count // 2) + 0.5) * (2 * np.pi / count)


def clear_shape(lens: Lens, source: Source, count: int, aim: str = "paraxial") -> ClearShape:
    """Return the clear part of the pupil along ``count`` directions. Raises GeometryError when nothing is clear."""
    xi, eta = hexapolar(SEARCH_RINGS)
    passed = pencil(lens, source, xi, eta, aim, clip=True).passed
    if not passed.any():
        raise GeometryError("the rims clip every ray of this field; leave clip off or reduce the field")
    centre = float(eta[passed].mean())
    sine, cosine = np.sin(directions(count)), np.cos(directions(count))
    # The unit circle seen from the centre: |centre + r·direction| = 1.
    outer = np.sqrt(1 - (centre * sine) ** 2) - centre * cosine
    inner = np.zeros_like(outer)
    if not _clear(lens, source, aim, inner, (sine, cosine, centre)).all():
        raise GeometryError("the clear part of the pupil has no clear centre; leave clip off or reduce the field")
    open_ = _clear(lens, source, aim, outer, (sine, cosine, centre))
    limit, high = outer.copy(), outer.copy()
    for _ in range(BISECTIONS):
        middle = (inner + high) / 2
        clear = _clear(lens, source, aim, middle, (sine, cosine, centre))
        inner, high = np.where(clear, middle, inner), np.where(clear, high, middle)
    return ClearShape(centre, np.where(open_, limit, inner))


def _clear(lens, source, aim, radius, polar) -> np.ndarray:
    sine, cosine, centre = polar
    return pencil(lens, source, radius * sine, centre + radius * cosine, aim, clip=True).passed
