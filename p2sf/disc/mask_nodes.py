"""Nodes over the open part of a mask: a signed sum of pieces, on each of which the pupil function is smooth.

The field is linear in the pupil. A round stop with an obscuration is integrated by Gauss–Legendre in ρ² from ε² to 1;
an iris by sectors between the directions of its corners, up to the outline; a vane is a strip with negative weights,
integrated along and across itself. So no edge falls between nodes, and the sums converge as fast as over the disc.
Amplitude and phase are factors at the nodes (handbook 4.6).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import ceil, cos, inf, pi, sin, tan
from typing import Protocol

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc.domain import ClearNodes, Piece, PupilDomain
from p2sf.disc.mask import Inside, PupilMask
from p2sf.disc.quadrature import MOST_KEPT, gauss_legendre, ring_count
from p2sf.errors import GeometryError

GAUSS_EXCESS = 1.5  # Gauss–Legendre nodes per uniform direction for the same harmonics: some π/2
EDGE_NODES = 5  # more in each sector, for an outline that is smooth but not a circle
FEWEST_ACROSS = 4  # nodes across a vane, or across a part of it between corners
UPRIGHT = 1e-9  # sine of the angle of a vane along η
THINNEST = 1e-12  # share of the disc that counts as zero


class Curve(Protocol):
    """A closed curve over the stop."""

    def depth(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return what is positive at points inside."""

    def cuts(self, xi: np.ndarray, eta: np.ndarray, sine: float, cosine: float) -> Sequence[np.ndarray]:
        """Return how far along a direction lines from points cross it."""


def mask_nodes(mask: PupilMask, radial: int, angular: int) -> ClearNodes:
    """Return nodes over the open part of the mask, as dense as ``radial`` × ``angular`` over the whole disc.

    For a mask that is even in ξ they cover half the disc. Raises GeometryError if nothing is open.
    """
    return (_kept_nodes if radial * angular <= MOST_KEPT else _kept_nodes.__wrapped__)(mask, radial, angular)


@lru_cache(maxsize=16)
def _kept_nodes(mask: PupilMask, radial: int, angular: int) -> ClearNodes:
    pieces = [_sectors(mask, radial, angular) if mask.iris else _rings(mask, radial, angular)]
    if not mask.disc.centred:
        pieces.append(_dark_disc(mask, radial, angular))
    for angle in mask.vane_angles:
        pieces += vane_pieces(mask, angle, radial)
    return join_pieces(mask, pieces, mask.domain)


def join_pieces(mask: PupilMask, pieces: list[Piece], domain: PupilDomain) -> ClearNodes:
    """Return the nodes of those of all pieces of the disc that lie in a domain, with what the mask does there."""
    xi, eta, area = (np.concatenate(column) for column in zip(*domain.of_pieces(pieces), strict=True))
    kept = area != 0
    xi, eta, area = xi[kept], eta[kept], area[kept]
    share = float(area.sum())
    if not share > THINNEST:
        raise GeometryError("the pupil mask leaves nothing open; make its obscuration or its vanes smaller")
    amplitude = write_protect(mask.amplitude(xi, eta)) if mask.shaded else 1.0
    path = write_protect(mask.path_um(xi, eta)) if mask.phased else 0.0
    xi, eta, weight = map(write_protect, (xi, eta, area / share))
    return ClearNodes(xi, eta, weight, share, amplitude, path, domain)


def _rings(mask: PupilMask, radial: int, angular: int) -> Piece:
    """Return nodes from a central obscuration to the rim in uniform directions of the mask's domain."""
    theta = mask.domain.directions((angular + 1) // 2)
    one = np.ones_like(theta)
    return _polar(theta, mask.domain.turn / theta.size * one, _inner_radius(mask) * one, one, radial)


def _sectors(mask: PupilMask, radial: int, angular: int) -> Piece:
    """Return nodes from a central obscuration to the blades, in directions between corners."""
    angles = [*mask.corner_angles]
    if mask.disc.centred:
        angles += [angle for edge in mask.edges for angle in edge.crossings(mask.disc)]
    theta, step = _directions(angles, mask.domain, angular)
    outer = outline_radius(mask, theta)
    return _polar(theta, step, np.minimum(_inner_radius(mask), outer), outer, radial)


def _inner_radius(mask: PupilMask) -> float:
    return mask.obscuration if mask.disc.centred else 0.0


def _dark_disc(mask: PupilMask, radial: int, angular: int) -> Piece:
    """Return nodes with negative areas over a decentred obscuration within the iris."""
    disc = mask.disc
    middle = np.full(1, disc.xi), np.full(1, disc.eta)
    if not all(edge.lies_inside(*middle)[0] for edge in mask.edges):
        raise GeometryError("the centre of the obscuration lies behind a blade of the iris; move it or open the iris")
    angles = [angle for edge in mask.edges for angle in edge.crossings(disc)]
    theta, step = _directions(angles or [0.0], mask.domain, angular)
    one, sine, cosine = np.ones_like(theta), np.sin(theta), np.cos(theta)
    outer = np.minimum(disc.radius, exit_distance(mask.bounds, disc.xi * one, disc.eta * one, sine, cosine))
    xi, eta, area = _polar(theta, step, 0 * one, outer, radial)
    return disc.xi + xi, disc.eta + eta, -area


def _directions(angles: list[float], domain: PupilDomain, angular: int) -> tuple[np.ndarray, np.ndarray]:
    """Return directions between corners, Gauss–Legendre nodes, and their angular weights."""
    thetas, steps = [], []
    corners = np.unique(np.round(np.mod(angles, 2 * pi), 12)).tolist()
    for low, high in pairwise(domain.between(corners)):
        count = ceil(GAUSS_EXCESS * angular * (high - low) / (2 * pi)) + EDGE_NODES
        node, weight = gauss_legendre(count)
        thetas.append((low + high + (high - low) * node) / 2)
        steps.append((high - low) / 2 * weight)
    return np.concatenate(thetas), np.concatenate(steps)


def outline_radius(mask: PupilMask, theta: np.ndarray) -> np.ndarray:
    """Return the radius of the rim or iris in directions from +η towards +ξ."""
    return exit_distance(mask.bounds, np.zeros_like(theta), np.zeros_like(theta), np.sin(theta), np.cos(theta))


def exit_distance(
    bounds: Sequence[Inside], xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray
) -> np.ndarray:
    """Return the distance of inner points from the nearest of several edges along the directions (sine, cosine)."""
    nearest = bounds[0].distance(xi, eta, sine, cosine)
    for edge in bounds[1:]:
        nearest = np.minimum(nearest, edge.distance(xi, eta, sine, cosine))
    return nearest


def _polar(theta: np.ndarray, step: np.ndarray, inner: np.ndarray, outer: np.ndarray, radial: int) -> Piece:
    """Return Gauss–Legendre nodes in ρ² between radii along directions with the angular weights ``step``."""
    node, weight = gauss_legendre(ring_count(radial, float((outer - inner).max())))
    low, high = inner**2, outer**2
    rho = np.sqrt((low + high + (high - low) * node[:, None]) / 2)
    area = weight[:, None] * (high - low) / 4 * step / pi  # ∫ρ dρ dθ = ½∫d(ρ²) dθ over the disc's area π
    return (rho * np.sin(theta)).ravel(), (rho * np.cos(theta)).ravel(), area.ravel()


def vane_pieces(
    mask: PupilMask, angle: float, radial: int, curves: Sequence[tuple[Curve, bool]] = (), breaks: Sequence[float] = ()
) -> list[Piece]:
    """Return the pieces of one vane, with negative areas, outside the obscuration and the other vanes.

    ``curves``: other edges, and whether their insides are open. ``breaks``: distances from the vane's middle line at
    which these have corners and extremes.
    """
    ends = zip(*_across(mask, angle, breaks), strict=True)
    return [piece for pair in ends for piece in _strips(mask, angle, pair, radial, curves)]


def _across(mask: PupilMask, angle: float, others: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """Return the limits of the intervals across a vane within which both of its ends are smooth."""
    half, disc = mask.vane_width, mask.disc
    meeting = _inner_radius(mask) * (sin(pi / mask.vanes) if mask.vanes > 2 else 1.0)
    corners = [sin(corner - angle) for corner in mask.corner_angles if cos(corner - angle) > 0]
    # A vane that meets its neighbours outside the obscuration starts with a corner on its centre line; one on the line
    # ξ = 0 may be halved by that line.
    middle = [0.0] if half > meeting or abs(sin(angle)) < UPRIGHT else []
    beside = [] if disc.centred else _corners_of_disc(mask, angle)
    breaks = [x for x in (*middle, meeting, -meeting, *corners, *beside, *others) if abs(x) < half]
    ends = np.unique(np.round([-half, *breaks, half], 14))
    return ends[:-1], ends[1:]


def _corners_of_disc(mask: PupilMask, angle: float) -> list[float]:
    """Return the offsets from a vane's centre line where an obscuration ends or meets blades or the vane's start."""
    disc = mask.disc
    middle = disc.xi * cos(angle) - disc.eta * sin(angle)
    found = [middle - disc.radius, middle + disc.radius]
    for edge in mask.edges:
        xi, eta = disc.outline(np.array(edge.crossings(disc)))
        found += (xi * cos(angle) - eta * sin(angle)).tolist()
    lean = pi / max(mask.vanes, 2)
    for side in (-lean, lean):
        sine, cosine = sin(angle + side), cos(angle + side)
        found += [float(end) * sin(side) for end in disc.chord(np.zeros(()), np.zeros(()), sine, cosine) if end > 0]
    return found


def _strips(
    mask: PupilMask, angle: float, interval: tuple[float, float], radial: int, curves: Sequence[tuple[Curve, bool]]
) -> list[Piece]:
    """Return the nodes of one interval across a vane: what of its lines is open, between all edges that cut them."""
    sine, cosine, (low, high) = sin(angle), cos(angle), interval
    node, weight = gauss_legendre(FEWEST_ACROSS + ceil(radial * (high - low) / 2))
    aside = (low + high + (high - low) * node) / 2
    foot_xi, foot_eta = foot = aside * cosine, -aside * sine
    start = np.abs(aside) / tan(pi / mask.vanes) if mask.vanes > 2 else np.zeros_like(aside)
    directions = (np.full(aside.size, part) for part in (sine, cosine))
    end = np.maximum(exit_distance(mask.bounds, *foot, *directions), start)
    near, far = (np.clip(part, start, end) for part in mask.disc.chord(*foot, sine, cosine))
    cuts = [np.clip(cut, start, end) for curve, _ in curves for cut in curve.cuts(*foot, sine, cosine)]
    places = np.array([start, near, far, end, *cuts])
    if cuts:
        places.sort(axis=0)
    middle = (places[:-1] + places[1:]) / 2
    open_ = (middle <= near) | (middle >= far)
    for curve, inside in curves:
        open_ &= (curve.depth(foot_xi + middle * sine, foot_eta + middle * cosine) > 0) == inside
    last = np.where(open_, places[1:], places[:-1])
    count, across = ring_count(radial, 1 - _inner_radius(mask)), weight * (high - low) / 2
    ends = (pair for pair in zip(places[:-1], last, strict=True) if (pair[1] > pair[0]).any())
    return [_strip(foot, (sine, cosine), pair, across, count) for pair in ends]


def _strip(
    foot: tuple[np.ndarray, np.ndarray],
    direction: tuple[float, float],
    ends: tuple[np.ndarray, np.ndarray],
    across: np.ndarray,
    count: int,
) -> Piece:
    """Return ``count`` nodes along each of the lines from ``foot`` between ``ends``, with negative areas.

    ``across``: the width of each line; all lengths are in radii of the rim.
    """
    (sine, cosine), (first, last) = direction, ends
    place, share = gauss_legendre(count)
    along = (first + last + (last - first) * place[:, None]) / 2
    area = -share[:, None] * (last - first) / 2 * across / pi
    return (foot[0] + along * sine).ravel(), (foot[1] + along * cosine).ravel(), area.ravel()


@dataclass(frozen=True)
class Throughput:
    """Means over the disc of the amplitude and of its square, the transmitted light."""

    amplitude: float
    light: float

    @property
    def spreading(self) -> float:
        """Return mean A²/(mean A)²: the spread of a field of unit peak relative to that of the clear disc."""
        return self.light / self.amplitude**2 if self.amplitude else inf


@lru_cache(maxsize=64)
def throughput(mask: PupilMask) -> Throughput:
    """Return the throughput of a mask."""
    nodes = mask_nodes(mask, 24, 48)
    amplitude = nodes.amplitude + 0 * nodes.xi
    return Throughput(nodes.share * float(nodes.weight @ amplitude), nodes.share * float(nodes.weight @ amplitude**2))
