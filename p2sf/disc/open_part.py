"""What is open of the pupil: its edges, nodes over it, and the lines between them (handbook 4.6, 6.3).

The field is linear in the pupil. Nodes are a signed sum of pieces, on each of which the pupil function is smooth: what
lies within rim and blades, less its intersections with obscuration, holes and shadows, less the vanes. Each piece but a
vane must be star-shaped about its middle, as overlaps of rims seen through a lens are.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import combinations, pairwise
from math import ceil, pi

import numpy as np

from p2sf.disc.domain import HALF, WHOLE, ClearNodes, PupilDomain
from p2sf.disc.mask import CLEAR, Disc, Inside, PupilMask
from p2sf.disc.mask_nodes import (
    exit_distance,
    join_pieces,
    mask_nodes,
    outline_radius,
    vane_pieces,
)
from p2sf.disc.quadrature import gauss_legendre, whole_disc
from p2sf.disc.star_curve import StarCurve, changes_of, curve_between
from p2sf.errors import GeometryError

CURVE = 1024  # points along an edge of the pupil: chords between them depart from it by 5e-6 of the radius
FEWEST_PER_PANEL = 8
CLOSE = 1e-8  # of the box: ends of edges no farther apart are one
SEARCHED = 24, 144  # radii and directions of points among which the middle of a piece is sought
SCAN = 192  # directions to half a turn between which corners are sought: a shorter arc may be missed
ON_EDGE = 1e-9  # in radii of the rim
CORNER_STEPS = 4  # a corner's direction to 2e-7: the radius is continuous there, and the sum good to the square

NOTHING_OPEN = "rims and the mask in the stop leave nothing open; leave {parameter} off"

TURN = np.arange(2 * CURVE) * (pi / CURVE)

Edges = list[tuple[np.ndarray, np.ndarray]]
"""Closed curves, ξ and η each."""


@dataclass(frozen=True, eq=False)
class OpenPart:
    """What is open of the pupil: all inside the ``rim`` of the clear part, the disc's where None, but ``shadows``.

    ``shadows``: of holes of mirrors and the like, within the clear part. ``mask``: what else stands in the stop, as
    the source sees it. ``domain``: the part of the disc that determines all.
    """

    rim: StarCurve | None = None
    shadows: tuple[StarCurve, ...] = ()
    mask: PupilMask = CLEAR
    domain: PupilDomain = HALF

    def behind(self, mask: PupilMask) -> "OpenPart":
        """Return what a mask leaves open of it."""
        return _behind(self, mask)

    @property
    def whole(self) -> bool:
        """Return whether nothing but the mask ends it."""
        return self.rim is None and not self.shadows

    def opens(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return which points of the disc are open, bool."""
        open_: np.ndarray = self.mask.opens(xi, eta) & (self.whole or self.beyond(xi, eta) <= 0)
        return open_

    def beyond(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return how far points lie beyond the rim or within a shadow, seen from their middles, whatever the mask."""
        beyond: np.ndarray = np.hypot(xi, eta) - 1 if self.rim is None else self.rim.beyond(xi, eta)
        for shadow in self.shadows:
            beyond = np.maximum(beyond, shadow.depth(xi, eta))
        return beyond

    def edges(self) -> tuple[Edges, Edges]:
        """Return the edges whose insides are open, without the rim's, and those with dark insides."""
        light, dark = edges_of(self.mask)
        if self.rim is not None:
            light, dark = ([self.rim.hold(*edge) for edge in some] for some in (light, dark))
        return light, [*dark, *[shadow.points(CURVE // 2, WHOLE) for shadow in self.shadows]]

    def nodes(self, counts: tuple[int, int]) -> ClearNodes:
        """Return nodes over it, some of negative weights, about as dense as ``counts`` are over the disc.

        It is the clear part behind the iris, minus its intersection with each dark disc and shadow, plus those with two
        of them, and so on, and minus vanes. Raises GeometryError where nothing is open, and where a piece is not all
        seen from a point inside.
        """
        if self.whole:
            return self.domain.nodes(counts) if self.mask.clear else self.domain.over(mask_nodes(self.mask, *counts))
        if not self._regions:
            raise GeometryError(NOTHING_OPEN, parameter="clip")
        pieces = []
        for sign, curve in self._regions:
            xi, eta, area = curve.piece(counts)
            pieces.append((xi, eta, sign * area))
        edges = [(self.rim, True)] if self.rim else []
        edges += [(shadow, False) for shadow in self.shadows]
        for angle in self.mask.vane_angles:
            pieces += vane_pieces(self.mask, angle, counts[0], edges, self._breaks_across(angle))
        return join_pieces(self.mask, pieces, self.domain)

    @property
    def _bounds(self) -> tuple[Inside, ...]:
        return self.mask.bounds if self.rim is None else (*self.mask.edges, self.rim)

    def _breaks_across(self, angle: float) -> list[float]:
        """Return where corners and extremes of edges lie beside the middle line of a vane."""
        curves = [*[curve for _, curve in self._regions], *self.shadows]
        return [x for curve in curves for x in curve.breaks_across(float(np.sin(angle)), float(np.cos(angle)))]

    @cached_property
    def _regions(self) -> list[tuple[int, StarCurve]]:
        """Return the signs and the edges of the pieces that are no vanes."""
        dark: list[Inside] = [*([self.mask.disc] if self.mask.obscured else []), *self.shadows]
        found, empty = list[tuple[int, StarCurve]](), list[tuple[int, ...]]()
        for size in range(len(dark) + 1):
            for some in combinations(range(len(dark)), size):
                if any(set(none) <= set(some) for none in empty):
                    continue
                curve = curve_within([*self._bounds, *(dark[k] for k in some)], self.domain)
                if curve is None:
                    empty.append(some)
                else:
                    found.append(((-1) ** size, curve))
        return found


WHOLE_DISC = OpenPart()


@lru_cache(maxsize=16)
def _behind(part: OpenPart, mask: PupilMask) -> OpenPart:
    return replace(part, mask=mask, domain=part.domain.behind(mask.domain))


def curve_within(edges: Sequence[Inside], domain: PupilDomain) -> StarCurve | None:
    """Return the edge of what lies within several edges; None if nothing does.

    Raises GeometryError if the middle of that is not in it.
    """
    if len(edges) == 1 and isinstance(edges[0], StarCurve) and edges[0].domain == domain:
        return edges[0]
    middle = _middle(edges, domain)
    if middle is None:
        return None

    def distances(theta: np.ndarray) -> np.ndarray:
        place = np.full_like(theta, middle[0]), np.full_like(theta, middle[1])
        return np.stack([edge.distance(*place, np.sin(theta), np.cos(theta)) for edge in edges])

    def first(theta: np.ndarray) -> np.ndarray:
        each = distances(theta)
        label: np.ndarray = (each <= each.min(0) + ON_EDGE).argmax(0)
        return label

    theta = domain.neighbours(domain.directions(SCAN))
    corners = [changes_of(first, theta, first(theta), CORNER_STEPS)]
    for curve in edges:
        if isinstance(curve, StarCurve):
            xi, eta = curve.corner_points(domain)  # also where another edge cuts them off: the cut may be short
            corners.append(np.arctan2(xi - middle[0], eta - middle[1]))
    ascending = np.unique(np.round(np.mod(np.concatenate(corners), 2 * pi), 9)).tolist()
    return curve_between(lambda angle: distances(angle).min(0), middle, domain.between(ascending), domain)


def _middle(edges: Sequence[Inside], domain: PupilDomain) -> tuple[float, float] | None:
    """Return the deepest within several edges of their middles and the mean of points there; None if there are none."""
    xi, eta, _ = whole_disc(*SEARCHED)
    middles = [edge.middle for edge in edges if isinstance(edge, Disc | StarCurve)]
    held = np.all([edge.depth(xi, eta) > 0 for edge in edges], axis=0)
    if held.any():
        middles.append(domain.middle(xi[held], eta[held]))
    elif (rims := _held_edges(edges)).size:
        middles.append(domain.middle(*rims))
    depths = [min(float(edge.depth(*map(np.array, middle))) for edge in edges) for middle in middles]
    deepest = int(np.argmax(depths))
    if depths[deepest] > ON_EDGE:
        return middles[deepest]
    if held.any():
        raise GeometryError(
            "the clear part of the pupil has no clear centre; leave {parameter} off or reduce the field",
            parameter="clip",
        )
    return None


def _held_edges(edges: Sequence[Inside]) -> np.ndarray:
    """Return the points of the edges that lie within all others, ξ and η, (2, points): of an overlap of any size."""
    found = [np.zeros((2, 0))]
    for number, edge in enumerate(edges):
        if isinstance(edge, Disc | StarCurve):
            points = np.stack(edge.outline(TURN) if isinstance(edge, Disc) else edge.points(CURVE // 2, WHOLE))
            others = [other.depth(*points) > 0 for at, other in enumerate(edges) if at != number]
            found.append(points[:, np.all(others, axis=0)])
    return np.concatenate(found, axis=1)


def edges_of(mask: PupilMask) -> tuple[Edges, Edges]:
    """Return the closed edges over the stop, ξ and η each: of the iris, if any, and of what is dark inside."""
    if not mask.edged:
        return [], []
    corners = [angle % (2 * pi) for angle in mask.corner_angles]
    theta = np.unique(np.concatenate([np.linspace(0, 2 * pi, CURVE, endpoint=False), corners]))
    sine, cosine, outer = np.sin(theta), np.cos(theta), outline_radius(mask, theta)
    middle = [mask.disc.outline(theta)] if mask.obscured else []
    iris = [(outer * sine, outer * cosine)] if mask.iris else []
    return iris, middle + [_vane_edge(mask, angle) for angle in mask.vane_angles]


def _vane_edge(mask: PupilMask, angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the edge of a vane from the middle to beyond the iris; where vanes meet they overlap."""
    half, sine, cosine = mask.vane_width, np.sin(angle), np.cos(angle)
    aside = np.linspace(-half, half, CURVE // 16)
    one = np.ones_like(aside)
    end = exit_distance(mask.bounds, aside * cosine, -aside * sine, sine * one, cosine * one)
    sides = np.linspace(0, 1, CURVE // 8)
    along = np.concatenate([end, sides[::-1] * end[-1], sides * end[0]])
    across = np.concatenate([aside, np.full(sides.size, half), np.full(sides.size, -half)])
    return across * cosine + along * sine, along * cosine - across * sine


def places_between(curves: list[np.ndarray], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return places of some ``count`` lines, and their weights.

    Between the ends and corners of all edges they are those of Gauss–Legendre in an angle, which crowd there.
    """
    breaks = set()
    for curve in curves:
        across = curve[0]
        turning = (across >= np.roll(across, 1)) != (np.roll(across, -1) >= across)
        breaks |= set(np.round(across[turning], 9).tolist())
    low, high = float(curves[0][0].min()), float(curves[0][0].max())
    inside = [low, *sorted(b for b in breaks if low + CLOSE < b < high - CLOSE), high]
    places, weights = [], []
    for low, high in pairwise(inside):
        node, weight = gauss_legendre(max(FEWEST_PER_PANEL, ceil(count * (high - low) / (inside[-1] - inside[0]))))
        angle = node * pi / 2
        places.append((low + high + (high - low) * np.sin(angle)) / 2)
        weights.append((high - low) / 2 * np.cos(angle) * weight * pi / 2)
    return np.concatenate(places), np.concatenate(weights)


def open_intervals(
    light: list[np.ndarray], dark: list[np.ndarray], places: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the lower and upper ends of the open intervals of lines, (intervals, lines); both 0 where there are fewer.

    The curves, (2, points): across the lines, and along them. A point of a line is inside a curve where an odd number
    of its crossings lie below.
    """
    curves = [*light, *dark]
    found = [_crossings(curve, places) for curve in curves]
    ends = np.concatenate(found, axis=1)
    curve_of = np.repeat(np.arange(len(curves)), [one.shape[1] for one in found])
    order = np.argsort(ends, axis=1, kind="stable")
    ends = np.take_along_axis(ends, order, axis=1)
    wanted = np.arange(len(curves)) < len(light)
    inside = (np.cumsum(curve_of[order][:, :, None] == np.arange(len(curves)), axis=1) % 2).astype(bool)
    open_ = (inside == wanted).all(2)[:, :-1] & np.isfinite(ends[:, 1:])
    first = np.argsort(~open_, axis=1, kind="stable")[:, : max(1, int(open_.sum(1).max(initial=0)))]
    some = np.take_along_axis(open_, first, axis=1)
    low, high = (np.where(some, np.take_along_axis(ends[:, k:], first, axis=1), 0.0).T for k in (0, 1))
    return low, high


def _crossings(curve: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return where lines cross a closed curve, (lines, crossings), infinite where there are fewer."""
    across, along = np.append(curve, curve[:, :1], axis=1)
    above = across > places[:, None]
    line, cut = np.divmod(np.flatnonzero(above[:, 1:] != above[:, :-1]), across.size - 1)  # faster than `nonzero`
    part = (places[line] - across[cut]) / (across[cut + 1] - across[cut])
    counts = np.bincount(line, minlength=places.size)
    table = np.full((places.size, max(1, int(counts.max(initial=0)))), np.inf)
    starts = np.cumsum(counts) - counts
    table[line, np.arange(line.size) - starts[line]] = along[cut] + part * (along[cut + 1] - along[cut])
    return table
