"""Closed curves over the stop, all of which is seen from a point inside: rims and shadows as a source sees them.

Between corners the distance from that point is a smooth function of the direction, here a Chebyshev series, which
converges geometrically (Boyd 2001, §2.13). Gauss–Legendre nodes up to the curve, in directions between corners, then
integrate over its inside as fast as over the disc: in ρ, since about a point that is not the middle odd powers of it do
not cancel, of which nodes in ρ² miss 1e-5 where these miss 1e-11.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import pi

import numpy as np

from p2sf.disc.clear_radius import Clearance, clear_radius
from p2sf.disc.domain import WHOLE, ClearNodes, Piece, PupilDomain
from p2sf.disc.mask import WHOLE_STOP
from p2sf.disc.quadrature import gauss_legendre, ring_count

BEYOND = 1e-3  # of the way to a curve: what is held inside ends no farther out, where nothing is known of the pupil
FEWEST_TERMS, MOST_TERMS, LAST_TERMS = 24, 192, 1e-10  # of an arc's series, the last in radii of the rim
FEWEST_PER_ARC = 6
ALONG = 193  # points of a line of two radii at which crossings are sought
DRAWN = 512  # of half a curve
SECTIONS = 16  # of the interval of a corner in one step: so few rays cost no more than one
ROUNDING = 1e-12  # of a series
ROUND = 1e-9  # of a circle's radius: what a series of bisected radii leaves
GAUSS_EXCESS = 1.5  # Gauss–Legendre nodes per uniform direction for the same harmonics: some π/2


@dataclass(frozen=True, eq=False)
class StarCurve:
    """A closed curve over the stop, all of which is seen from ``middle`` inside.

    ``corners``: where its smooth arcs end, as `PupilDomain.between` has them. ``arcs``: of each, the Chebyshev series
    of its distance from the middle. ``domain``: the part of the disc they lie in; the other mirrors it.
    """

    middle: tuple[float, float]
    corners: tuple[float, ...]
    arcs: tuple[np.ndarray, ...]
    domain: PupilDomain

    def radius(self, theta: np.ndarray) -> np.ndarray:
        """Return the distance from the middle at angles of any shape."""
        first = self.corners[0]
        angle = np.mod(theta - first, 2 * pi)
        angle = first + np.minimum(angle, 2 * self.domain.turn - angle)
        which = np.searchsorted(self.corners[1:-1], angle)
        low, high = np.array(self.corners[:-1])[which], np.array(self.corners[1:])[which]
        twice = 2 * (2 * angle - low - high) / (high - low)
        after, value = np.zeros_like(twice), np.zeros_like(twice)
        for terms in self._terms[:0:-1]:  # Clenshaw 1955
            after, value = value, twice * value - after + terms[which]
        radius: np.ndarray = twice / 2 * value - after + self._terms[0][which]
        return radius

    @property
    def whole(self) -> bool:
        """Return whether it is the rim of the disc."""
        radius = self.radius(self.domain.directions(FEWEST_TERMS))
        return len(self.arcs) == 1 and max(*map(abs, self.middle), np.abs(radius - 1).max()) <= ROUND

    @cached_property
    def _terms(self) -> np.ndarray:
        """Return the series of all arcs without terms that are rounding, (terms, arcs)."""
        count = max(int(np.flatnonzero(np.abs(series) > ROUNDING).max()) for series in self.arcs) + 1
        terms = np.zeros((max(count, *map(len, self.arcs)), len(self.arcs)))
        for number, series in enumerate(self.arcs):
            terms[: series.size, number] = series
        return terms[:count]

    def beyond(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return how far points of any shape lie beyond the curve, seen from its middle; negative inside."""
        distance, radius = self._seen(xi, eta)
        beyond: np.ndarray = distance - radius
        return beyond

    def depth(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return how far inside the curve points lie, seen from its middle; negative beyond."""
        return -self.beyond(xi, eta)

    def distance(self, xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray) -> np.ndarray:
        """Return the distance of inner points (ξ, η) from the curve along the directions (sine, cosine)."""
        outer = WHOLE_STOP.distance(xi, eta, sine, cosine)

        def clearance(radius: np.ndarray, some: np.ndarray) -> Clearance:
            room = self.depth(xi[some] + radius * sine[some], eta[some] + radius * cosine[some])
            return room >= 0, room, np.zeros(room.shape, int)

        return clear_radius(clearance, outer)[0]

    def cuts(self, xi: np.ndarray, eta: np.ndarray, sine: float, cosine: float) -> list[np.ndarray]:
        """Return how far along a direction lines from points cross the curve, up to beyond the disc; inf for none."""
        place = np.linspace(0, 2, ALONG)
        inside = self.depth(xi + place[:, None] * sine, eta + place[:, None] * cosine) > 0
        step, line = np.nonzero(inside[1:] != inside[:-1])
        first = inside[step, line]

        def clearance(further: np.ndarray, some: np.ndarray) -> Clearance:
            at = place[step[some]] + further
            depth = self.depth(xi[line[some]] + at * sine, eta[line[some]] + at * cosine)
            return (depth > 0) == first[some], np.where(first[some], depth, -depth), np.ones(some.size, int)

        found = place[step] + clear_radius(clearance, np.full(step.size, place[1]))[0]
        order, counts = np.argsort(line, kind="stable"), np.bincount(line, minlength=xi.size)
        number = np.arange(step.size) - np.repeat(np.cumsum(counts) - counts, counts)
        cuts = np.full((int(counts.max(initial=0)), xi.size), np.inf)
        cuts[number, line[order]] = found[order]
        return list(cuts)

    def breaks_across(self, sine: float, cosine: float) -> list[float]:
        """Return how far corners and extremes lie beside the line through the stop's middle along a direction."""
        xi, eta = self.corner_points(WHOLE)
        beside = map(float, xi * cosine - eta * sine)
        xi, eta = self.points(DRAWN, WHOLE)
        across = xi * cosine - eta * sine
        before, after = np.roll(across, 1), np.roll(across, -1)
        some = (across >= before) != (after >= across)
        bend = np.where(some, before - 2 * across + after, 1.0)
        # Those of the parabolas through three points.
        extremes = (across - np.where(bend == 0, 0.0, (after - before) ** 2 / (8 * bend)))[some]
        return [*beside, *map(float, extremes)]

    def _seen(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return how far points are from the middle, and how far the curve is in that direction."""
        across, up = xi - self.middle[0], eta - self.middle[1]
        return np.hypot(across, up), self.radius(np.arctan2(across, up))

    def points(self, count: int, domain: PupilDomain | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η of points from +η towards +ξ, each once, its corners among them.

        Some ``count`` to half a turn, evenly seen from the middle. ``domain``: its own if not given; of a pupil without
        symmetry all around.
        """
        theta = self.domain.edge_directions(self.corners, count)
        radius = self.radius(theta)
        xi, eta = self.middle[0] + radius * np.sin(theta), self.middle[1] + radius * np.cos(theta)
        for side in (domain or self.domain).halves[len(self.domain.halves) :]:  # mirrors what is known
            xi, eta = np.append(xi, side * xi[-2:0:-1]), np.append(eta, eta[-2:0:-1])
        return xi, eta

    def corner_points(self, domain: PupilDomain) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η of its corners that belong to a domain."""
        theta = np.array(self.corners[1:-1] if self.domain.symmetric else self.corners[:-1])
        radius = self.radius(theta)
        xi, eta = self.middle[0] + radius * np.sin(theta), self.middle[1] + radius * np.cos(theta)
        return (xi, eta) if domain == self.domain else (np.append(xi, -xi), np.append(eta, eta))

    def hold(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return another closed curve whose parts far outside are drawn to just outside this one: the same inside."""
        excess = self._excess(xi, eta) - BEYOND
        following = np.roll(excess, -1)
        left = np.flatnonzero((excess > 0) != (following > 0))
        part = excess[left] / (excess[left] - following[left])
        xi, eta = (np.insert(v, left + 1, v[left] + part * (np.roll(v, -1) - v)[left]) for v in (xi, eta))
        nearer = np.minimum(1.0, (1 + BEYOND) / (1 + np.maximum(self._excess(xi, eta), 0.0)))
        return tuple(place + nearer * (v - place) for v, place in zip((xi, eta), self.middle, strict=True))

    def _excess(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        distance, radius = self._seen(xi, eta)
        excess: np.ndarray = distance / radius - 1
        return excess

    def piece(self, counts: tuple[int, int]) -> Piece:
        """Return nodes over the inside, in its own part of the disc, as dense as ``counts`` are over the whole disc."""
        theta, _ = self._directions(counts[1])
        return self._nodes(ring_count(counts[0], min(1.0, float(self.radius(theta).max()))), counts[1])

    def _nodes(self, radial: int, angular: int) -> Piece:
        """Return nodes over the inside, of so many radii: Gauss in ρ, and in ρ² over a circle about the stop's middle.

        Over such a circle, as over the disc, odd powers of ρ cancel.
        """
        theta, step = self._directions(angular)
        radius = self.radius(theta)
        place, weight = gauss_legendre(radial)
        inward = (1 + place[:, None]) / 2
        if max(*map(abs, self.middle), np.ptp(radius)) <= ROUND * radius.max():
            part, area = np.sqrt(inward), weight[:, None] / 4 * radius**2 * step / pi
        else:
            part, area = inward, weight[:, None] / 2 * inward * radius**2 * step / pi  # ρ dρ dθ over the disc's area π
        rho = part * radius
        xi, eta = self.middle[0] + rho * np.sin(theta), self.middle[1] + rho * np.cos(theta)
        return xi.ravel(), eta.ravel(), area.ravel()

    def _directions(self, angular: int) -> tuple[np.ndarray, np.ndarray]:
        """Return angles and weights of Gauss–Legendre nodes between corners, together some ``angular`` to a turn."""
        thetas, steps = [], []
        for low, high in pairwise(self.corners):
            number = max(FEWEST_PER_ARC, round(GAUSS_EXCESS * angular * (high - low) / (2 * pi)))
            node, weight = gauss_legendre(number)
            thetas.append((low + high + (high - low) * node) / 2)
            steps.append((high - low) / 2 * weight)
        return np.concatenate(thetas), np.concatenate(steps)

    def nodes(self, counts: tuple[int, int]) -> ClearNodes:
        """Return nodes over the inside with all radii of ``counts``, which determine a polynomial of their order."""
        xi, eta, area = self._nodes(*counts)
        area = area * len(self.domain.images)
        share = float(area.sum())
        return ClearNodes(xi, eta, area / share, share, domain=self.domain)


def curve_between(
    edge: Callable[[np.ndarray], np.ndarray],
    middle: tuple[float, float],
    corners: tuple[float, ...],
    domain: PupilDomain,
) -> StarCurve:
    """Return the curve whose distance from its middle ``edge`` returns at angles, smooth between its corners."""
    arcs: dict[int, np.ndarray] = {}
    ends, terms = list(pairwise(corners)), FEWEST_TERMS
    while len(arcs) < len(ends):
        place = np.cos(pi * (np.arange(terms) + 0.5) / terms)
        left = [number for number in range(len(ends)) if number not in arcs]
        theta = np.array([(low + high + (high - low) * place) / 2 for low, high in (ends[number] for number in left)])
        for number, radii in zip(left, edge(theta.ravel()).reshape(theta.shape), strict=True):
            series = _series(radii)
            if np.abs(series[-2:]).max() < LAST_TERMS or terms >= MOST_TERMS:
                arcs[number] = series
        terms *= 2
    return StarCurve(middle, corners, tuple(arcs[number] for number in range(len(ends))), domain)


def _series(values: np.ndarray) -> np.ndarray:
    """Return the Chebyshev series through values at the first Chebyshev points (Boyd 2001, §4.4)."""
    count = values.size
    waves = np.cos(np.outer(np.arange(count), pi * (np.arange(count) + 0.5) / count))
    series: np.ndarray = 2 / count * (waves @ values)
    series[0] /= 2
    return series


def changes_of(
    label_at: Callable[[np.ndarray], np.ndarray], theta: np.ndarray, label: np.ndarray, steps: int
) -> np.ndarray:
    """Return the angles at which a label changes, to 1/SECTIONS**steps of the distance between neighbours.

    ``label_at`` gives the labels at angles, (n,); ``label`` those at ``theta``.
    """
    change = np.flatnonzero(np.diff(label))
    low, high, first = theta[change], theta[change + 1], label[change]
    for _ in range(steps if change.size else 0):
        angle = low + (high - low) * (np.arange(SECTIONS + 1) / SECTIONS)[:, None]
        same = label_at(angle[1:-1].ravel()).reshape(SECTIONS - 1, -1) == first
        last, place = np.logical_and.accumulate(same).sum(0), np.arange(change.size)
        low, high = angle[last, place], angle[last + 1, place]
    middle: np.ndarray = (low + high) / 2
    return middle
