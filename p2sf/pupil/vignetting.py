"""Pupil nodes that end at the clear apertures: the vignetted pupil of an oblique pencil, without a jagged edge.

From a centre inside the clear part, bisection on real rays finds where each direction meets a rim, and
Gauss–Legendre radii end exactly there. Where one rim takes over from another the outline has a corner; the
directions are Gauss–Legendre nodes between corners, so that the outline is smooth inside each interval. The clear
part must be star-shaped about its centre, as every overlap of rims seen through a lens is.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from p2sf.disc.domain import ClearNodes, PupilDomain
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.disc.open_part import PupilEdges, StarCurve
from p2sf.disc.quadrature import disc_nodes, gauss_legendre
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.pupil.clear_pieces import (
    CLIPPED,
    LOST,
    changes_of,
    check_without_holes,
    hole_curves,
    holes_of,
    piece_nodes,
    without_holes,
)
from p2sf.pupil.clear_radius import Clearance, clear_radius
from p2sf.pupil.fit import FittedPencil
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.aiming import pupil_rays, start
from p2sf.raytrace.pencil import hexapolar, pencil
from p2sf.raytrace.surface import BESIDE, Status, ended_at, rooms
from p2sf.raytrace.trace import lens_rims, run

SEARCH_RINGS = 12
SCAN = 192  # directions in which corners are looked for: an arc shorter than 1/192 of the half circle may be missed
CORNER_STEPS = 7  # a corner's direction to 6e-11
CROSSING_STEPS = 5  # of Newton's method from 1/192 of a turn or less
CROSSING_DIFFERENCE = 1e-5  # of the pupil's radius, far above what aiming leaves
CROSSING_FARTHEST = 1.1  # in the pupil's radius
CROSSING_ENOUGH = 1e-9  # of the last step, which leaves a hundred-thousandth of itself
FEWEST_PER_ARC = 6
BLUR_NODES = 16, 40  # carry the weight and the area of a fit, which are smooth
GAUSS_EXCESS = 1.5  # Gauss–Legendre nodes per uniform direction for the same harmonics: some π/2


@dataclass(frozen=True, eq=False)
class ClearPart:
    """The clear part of the pupil: its centre on the η axis, and the corners' angles from +η, 0 and π included.

    Without symmetry the centre lies ``aside`` at ξ, and the angles go once around. ``edge``: angles and radii of some
    points of the edge, its corners among them, where these are known.
    """

    centre: float
    corners: tuple[float, ...]
    aside: float = 0.0
    edge: tuple[np.ndarray, np.ndarray] | None = None

    def guess(self, theta: np.ndarray) -> np.ndarray | None:
        """Return the radius of the edge at angles, between those of ``edge``; None without that."""
        if self.edge is None:
            return None
        angles, radii = self.edge
        radius: np.ndarray = np.interp(theta, angles, radii, period=2 * np.pi if angles[-1] > np.pi else None)
        return radius


def whole_nodes(counts: tuple[int, int]) -> ClearNodes:
    """Return the nodes of (radial, angular) ``counts`` over the whole pupil, by its half ξ > 0."""
    nodes = disc_nodes(*counts)
    return ClearNodes(nodes.xi, nodes.eta, nodes.weight, 1.0)


def pupil_nodes(
    lens: Lens, source: Source, counts: tuple[int, int], clip: bool = False, whole: bool = True
) -> ClearNodes:
    """Return nodes over what mask, rims and lost rays leave open; about as dense as ``counts`` are over the disc.

    ``clip``: end the pupil at the rims, and at holes. ``whole``: every ray of the disc is known to reach the sensor.
    Raises GeometryError where nothing is open.
    """
    mask = mask_seen(lens, source)
    if whole and not clip:
        return lens.pupil_domain.over(whole_nodes(counts) if mask.clear else mask_nodes(mask, *counts))
    if mask.clear and not (clip and holes_of(lens)):
        return clear_nodes(lens, source, counts, clip)
    return piece_nodes(lens, source, counts, clip, mask)


def clear_nodes(lens: Lens, source: Source, counts: tuple[int, int], clip: bool = True) -> ClearNodes:
    """Return nodes over the clear part of the pupil, about as dense as ``counts`` are over the whole.

    Without ``clip`` the clear part ends where rays miss a surface or are totally reflected, not at rims.
    Raises GeometryError when no part is clear.
    """
    shape = outline(lens, source, clip)
    theta, share = _directions(shape.corners, counts[1])
    radius, _ = _edge(lens, source, clip, (shape.aside, shape.centre), theta, shape.guess(theta))
    square, weight = gauss_legendre(counts[0])
    rho = np.sqrt((1 + square) / 2)[:, None] * radius
    # ∫∫ρ dρ dθ over the domain, divided by its area.
    area = (weight[:, None] / 2 * radius**2 * share / lens.pupil_domain.turn).ravel()
    xi, eta = (shape.aside + rho * np.sin(theta)).ravel(), (shape.centre + rho * np.cos(theta)).ravel()
    return ClearNodes(xi, eta, area / area.sum(), float(area.sum()), domain=lens.pupil_domain)


def _directions(corners: tuple[float, ...], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return angles and weights (sum π) of Gauss–Legendre nodes between corners, together some ``count``/2."""
    angles, weights = [], []
    for low, high in pairwise(corners):
        number = max(FEWEST_PER_ARC, round(GAUSS_EXCESS * count / 2 * (high - low) / np.pi))
        node, weight = gauss_legendre(number)
        angles.append((low + high + (high - low) * node) / 2)
        weights.append((high - low) / 2 * weight)
    return np.concatenate(angles), np.concatenate(weights)


@lru_cache(maxsize=16)
def outline(lens: Lens, source: Source, clip: bool = True) -> ClearPart:
    """Return centre and corners of the clear part of the pupil. Raises GeometryError when no part is clear."""
    check_without_holes(lens, clip)
    xi, eta = hexapolar(SEARCH_RINGS)
    passed = pencil(lens, source, xi, eta, clip).passed
    if not passed.any():
        raise GeometryError(CLIPPED if clip else LOST, parameter="clip")
    aside, middle = lens.pupil_domain.middle(xi[passed], eta[passed])
    if not pencil(lens, source, [aside], [middle], clip).passed.all():
        raise GeometryError(
            "the clear part of the pupil has no clear centre; leave {parameter} off or reduce the field",
            parameter="clip",
        )
    corners, edge = _corners(lens, source, clip, (aside, middle))
    return ClearPart(middle, lens.pupil_domain.between(corners), aside, edge)


def _corners(
    lens: Lens, source: Source, clip: bool, centre: tuple[float, float]
) -> tuple[list[float], tuple[np.ndarray, np.ndarray] | None]:
    """Return the directions where one rim takes over from another, over half a turn, without symmetry over a whole.

    Also the directions and radii of points of the edge, as `ClearPart` has them.
    """
    theta = lens.pupil_domain.neighbours(lens.pupil_domain.directions(SCAN))
    radius, rim = _edge(lens, source, clip, centre, theta)
    if not np.ptp(rim):
        return [], (theta, radius)
    crossings = _crossings(lens, source, centre, theta, radius, rim) if clip else None
    if crossings is None:
        return changes_of(
            lambda angle: _edge(lens, source, clip, centre, angle)[1], theta, rim, CORNER_STEPS
        ).tolist(), None
    angles, radii = (np.append(a, b) for a, b in zip((theta, radius), crossings, strict=True))
    order = np.argsort(angles)
    return crossings[0].tolist(), (angles[order], radii[order])


def _crossings(
    lens: Lens, source: Source, centre: tuple[float, float], theta: np.ndarray, radius: np.ndarray, rim: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """Return directions and radii of the points of the edge that have no room at either rim that ends a neighbour.

    ``radius``, ``rim``: as `_edge` returns them at ``theta``. By Newton's method from midway; None where that leads
    to no such point, as where rays are lost at one of the two.
    """
    change = np.flatnonzero(np.diff(rim))
    labels, (low, high) = np.stack([rim[change], rim[change + 1]]), (theta[change], theta[change + 1])
    far, angle = (radius[change] + radius[change + 1]) / 2, (low + high) / 2
    xi, eta = centre[0] + far * np.sin(angle), centre[1] + far * np.cos(angle)
    for _ in range(CROSSING_STEPS):
        if not (np.hypot(xi, eta) < CROSSING_FARTHEST).all():
            return None
        beside = np.stack([xi, xi + CROSSING_DIFFERENCE, xi]), np.stack([eta, eta, eta + CROSSING_DIFFERENCE])
        room = _rooms(lens, source, *(column.ravel() for column in beside))
        if not all(label in room for label in labels.ravel()):
            return None
        here, right, up = np.stack([_of_each(room, label) for label in labels]).swapaxes(0, 1)
        (a, c), (b, d) = (right - here) / CROSSING_DIFFERENCE, (up - here) / CROSSING_DIFFERENCE
        area = a * d - b * c
        with np.errstate(invalid="ignore", divide="ignore"):
            xi, eta = xi - (d * here[0] - b * here[1]) / area, eta - (a * here[1] - c * here[0]) / area
    least = np.minimum.reduce([each.reshape(3, -1)[0] for each in room.values()])
    found = np.arctan2(xi - centre[0], eta - centre[1])
    found += 2 * np.pi * np.round((angle - found) / (2 * np.pi))
    moved = np.hypot(xi - beside[0][0], eta - beside[1][0])
    good = (moved < CROSSING_ENOUGH) & (least > -CROSSING_ENOUGH) & (low <= found) & (found <= high)
    return (found, np.hypot(xi - centre[0], eta - centre[1])) if good.all() else None


def _rooms(lens: Lens, source: Source, xi: np.ndarray, eta: np.ndarray) -> dict[int, np.ndarray]:
    """Return how far inside each rim, by the label of `ended_at`, rays land that none stops; 0: the pupil's own."""
    lens = seen_from(lens, source.azimuth_deg)
    rays, rims = pupil_rays(lens, source, xi, eta), lens_rims(lens, keep_stop=False)
    beam, found = start(rays), {0: 1 - xi * xi - eta * eta}

    def visit(number: int) -> None:
        for why, room in rooms(beam, rims[number - 1], lens.surfaces[number - 1].rim):
            found[number + BESIDE * (why == Status.CLIPPED_BESIDE)] = room

    run(lens, beam, rays.index, last=len(lens.surfaces), visit=visit)
    return found


def _of_each(room: dict[int, np.ndarray], labels: np.ndarray) -> np.ndarray:
    """Return of three rays about each point, one behind the other, the room at one rim per point, (3, points)."""
    return np.stack([room[label].reshape(3, -1)[:, i] for i, label in enumerate(labels)], axis=-1)


def clear_outline(
    lens: Lens, source: Source, points: int, clip: bool = True, domain: PupilDomain | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return (ξ, η) along the clear part's edge, from its top towards +ξ, its corners among them.

    Some ``points`` to half a turn, evenly seen from the centre. ``domain``: of the pupil for which it is wanted, the
    lens's own if not given: half the edge or all of it. Raises GeometryError when no part is clear.
    """
    shape, own = outline(lens, source, clip), lens.pupil_domain
    theta = own.edge_directions(shape.corners, points)
    radius, _ = _edge(lens, source, clip, (shape.aside, shape.centre), theta, shape.guess(theta))
    xi, eta = shape.aside + radius * np.sin(theta), shape.centre + radius * np.cos(theta)
    for half in (domain or own).halves[len(own.halves) :]:  # the mirror image of what is known
        xi, eta = np.append(xi, half * xi[-2:0:-1]), np.append(eta, eta[-2:0:-1])
    return xi, eta


def pupil_edges(lens: Lens, source: Source, points: int, clip: bool = True) -> PupilEdges:
    """Return the edges of what rims, holes and lost rays leave of the disc, some ``points`` to half a turn each.

    Raises GeometryError when no part is clear.
    """
    solid, own = without_holes(lens), lens.pupil_domain
    shape = outline(solid, source, clip)
    rim = StarCurve((shape.aside, shape.centre), *own.closed(*clear_outline(solid, source, points, clip)))
    return PupilEdges(rim, hole_curves(lens, source, clip, points))


def _edge(
    lens: Lens,
    source: Source,
    clip: bool,
    centre: tuple[float, float],
    theta: np.ndarray,
    guess: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the clear radius along each angle about a centre (ξ, η), and the surface that ends it (0: the rim).

    ``guess``: as `clear_radius` has it.
    """
    sine, cosine, (aside, up) = np.sin(theta), np.cos(theta), centre
    # The unit circle seen from the centre: |centre + r·direction| = 1.
    outer = np.sqrt(1 - (up * sine - aside * cosine) ** 2) - (up * cosine + aside * sine)

    def clearance(radius: np.ndarray, some: np.ndarray) -> Clearance:
        rays = pencil(lens, source, aside + radius * sine[some], up + radius * cosine[some], clip)
        known = rays.passed == (rays.clearance >= 0)
        return rays.passed, np.where(known, rays.clearance, np.nan), ended_at(rays.status, rays.failed_surface)

    return clear_radius(clearance, outer, guess)


def masked_blur(found: FittedPencil, nodes_of: Callable[[tuple[int, int]], ClearNodes] | None = None) -> float | None:
    """Return ∫|field|²dx of a fit in µm² at unit unaberrated peak of its own pupil, by Parseval; None where it folds.

    ``nodes_of``: the nodes of (radial, angular) counts over that pupil where rims end it.
    """
    if nodes_of is None and found.mask.clear and np.isfinite(found.blur_um2):  # not known of a fit that was looked up
        return found.blur_um2
    nodes = nodes_of(BLUR_NODES) if nodes_of else found.level.basis.domain.over(mask_nodes(found.mask, *BLUR_NODES))
    area = found.jacobian(nodes.xi, nodes.eta)
    if not area.min() * area.max() > 0:
        return None
    field = nodes.amplitude * found.function.at(nodes.xi, nodes.eta)[-1]
    field = field / ((nodes.weight * field).sum() / nodes.weight.sum())
    return float(nodes.weight @ (field * field / np.abs(area)) / (np.pi * nodes.share))
