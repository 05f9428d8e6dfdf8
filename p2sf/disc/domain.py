"""Over which part of the disc a pupil has to be known, and nodes over what of it is open (handbook 5.3).

A field along η leaves everything even or odd in ξ in a symmetric lens, so that half the disc tells all. Whoever has a
domain need not ask which it is: it says what nodes, lines and means of its pupil are.
"""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import ClassVar

import numpy as np

from p2sf.conventions import FloatOrArray, angle_from_axis

Piece = tuple[np.ndarray, np.ndarray, np.ndarray]
"""ξ, η and signed shares of the disc's area."""

# Rays held out of a fit to test it, on the rim, where a polynomial deviates first: (ξ, η), and angles from +η to +ξ.
HELD_OUT = np.array([[0.0, 0.0, 1.0, 0.6], [1.0, -1.0, 0.0, 0.8]])
HELD_OUT_AROUND_DEG = np.array([0.0, 80.0, 170.0, 260.0])
RING_POWER = 1.3  # of a ring's radius: with 60 rays the terms of degree 8 have a condition number of 3
ON_AXIS = 1e-9  # of the radius, or a radian: what lies nearer to the line of symmetry lies on it


@dataclass(frozen=True)
class PupilDomain:
    """The part of the disc that tells everything of a pupil: the half ξ > 0 where that is symmetric about η.

    ``halves``: the signs of ξ of the half discs that belong to it. ``images``: those for which a point of it stands.
    """

    symmetric: ClassVar = True
    halves: ClassVar[tuple[int, ...]] = (1,)
    images: ClassVar[tuple[int, ...]] = (1, -1)

    def parities(self, odd: bool) -> tuple[bool, ...]:
        """Return whether terms are odd in ξ: those of a function that is so by symmetry, then any that it forbids."""
        return (odd, not odd)[: len(self.halves)]

    def points(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return points of the half disc ξ ≥ 0, and behind them their mirror images that belong to the domain too."""
        return np.concatenate([half * xi for half in self.halves]), np.tile(eta, len(self.halves))

    def nodes(self, counts: tuple[int, int]) -> "ClearNodes":
        """Return the nodes of (radial, angular) ``counts``."""
        from p2sf.disc.quadrature import disc_nodes

        half = disc_nodes(*counts)
        return self.over(ClearNodes(half.xi, half.eta, half.weight, 1.0))

    @property
    def turn(self) -> float:
        """Return the angle that its directions from the middle go over, radians from +η towards +ξ."""
        return np.pi * len(self.halves)

    def directions(self, count: int) -> np.ndarray:
        """Return ``count`` even directions to half a turn, the first half a step from +η, radians."""
        return (np.arange(count * len(self.halves)) + 0.5) * (np.pi / count)

    def neighbours(self, theta: np.ndarray) -> np.ndarray:
        """Return directions each of which is next to the one before; all around the first comes last once more."""
        return theta

    def between(self, corners: list[float]) -> tuple[float, ...]:
        """Return the ends of the intervals of direction between corners, ascending and over its whole turn."""
        return 0.0, *(corner for corner in corners if ON_AXIS < corner < np.pi - ON_AXIS), np.pi

    def middle(self, xi: np.ndarray, eta: np.ndarray) -> tuple[float, float]:
        """Return the middle of points all over the disc: of a symmetric pupil on the line ξ = 0."""
        return 0.0, float(eta.mean())

    def edge_directions(self, corners: tuple[float, ...], count: int) -> np.ndarray:
        """Return some ``count`` directions to half a turn, each once: those of the ends `between`, and even steps."""
        return np.append(_steps(corners, count), corners[-1])

    def over(self, nodes: "ClearNodes") -> "ClearNodes":
        """Return nodes that are known over half the disc, or over all of it, over the domain."""
        return nodes

    def unfold(self, nodes: "ClearNodes") -> "ClearNodes":
        """Return nodes of this domain over the whole disc."""
        amplitude, path = (np.tile(x, 2) if isinstance(x, np.ndarray) else x for x in (nodes.amplitude, nodes.path_um))
        xi, weight = np.append(nodes.xi, -nodes.xi), np.tile(nodes.weight, 2) / 2
        return ClearNodes(xi, np.tile(nodes.eta, 2), weight, nodes.share, amplitude, path, WHOLE)

    def of_pieces(self, pieces: list[Piece]) -> list[Piece]:
        """Return those of the pieces of a whole disc that lie in the domain, for their mirror images too."""
        return [(xi, eta, 2 * area) for xi, eta, area in pieces if xi.mean() > 0]

    def of_lines(self, place: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return those of the lines ξ = ``place`` over a whole disc that lie in the domain, and their weights.

        A line in the middle is its own mirror image.
        """
        half = place > -ON_AXIS
        return place[half], (weight * np.where(place > ON_AXIS, 2, 1))[half]

    def holds(self, xi: np.ndarray) -> np.ndarray:
        """Return which points of a whole disc tell of others too, those on the line of symmetry left out, bool."""
        return np.asarray(xi > ON_AXIS)

    def axes(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the coordinates that a tilt is linear in, (1 or 2, points)."""
        return eta[None]

    def mean_across(self, share: np.ndarray, xi: np.ndarray) -> np.ndarray:
        """Return the mean over the last axis of what is odd in ξ, by shares of unit sum, 0 by symmetry."""
        return np.zeros(np.broadcast_shapes(share.shape, xi.shape)[:-1])

    def field(self, x_deg: float, y_deg: float) -> tuple[float, float]:
        """Return the field (x, y) that stands for one at these angles: a lens of revolution sees its angle alone."""
        return 0.0, angle_from_axis(x_deg, y_deg)

    def turned(self, angle_deg: float) -> "PupilDomain":
        """Return the domain of the pupil in axes turned by an angle."""
        return WHOLE if angle_deg else self

    def behind(self, other: "PupilDomain") -> "PupilDomain":
        """Return the domain of the pupil behind what has a domain of its own, such as a mask."""
        return other

    def sampling_rays(self, radii: int, directions: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return ξ and η of radii × directions rays for a fit and of those held out, and the former's area weights."""
        from p2sf.disc.quadrature import disc_nodes

        nodes = disc_nodes(radii, 2 * directions)
        return np.append(nodes.xi, HELD_OUT[0]), np.append(nodes.eta, HELD_OUT[1]), nodes.weight


@dataclass(frozen=True)
class WholeDisc(PupilDomain):
    """The domain of a pupil without symmetry."""

    symmetric: ClassVar = False
    halves: ClassVar[tuple[int, ...]] = (1, -1)
    images: ClassVar[tuple[int, ...]] = (1,)

    def field(self, x_deg: float, y_deg: float) -> tuple[float, float]:
        """Return the field itself, which no other looks like."""
        return x_deg, y_deg

    def neighbours(self, theta: np.ndarray) -> np.ndarray:
        """Return the directions, and the first once more."""
        return np.append(theta, theta[0] + self.turn)

    def between(self, corners: list[float]) -> tuple[float, ...]:
        """Return the corners, once around."""
        return (*corners, corners[0] + self.turn) if corners else (0.0, self.turn)

    def edge_directions(self, corners: tuple[float, ...], count: int) -> np.ndarray:
        """Return directions once around."""
        return _steps(corners, count)

    def middle(self, xi: np.ndarray, eta: np.ndarray) -> tuple[float, float]:
        """Return the middle of points, wherever it lies."""
        return float(xi.mean()), float(eta.mean())

    def over(self, nodes: "ClearNodes") -> "ClearNodes":
        """Return nodes over the whole disc."""
        return nodes.unfolded()

    def unfold(self, nodes: "ClearNodes") -> "ClearNodes":
        """Return the nodes."""
        return nodes

    def of_pieces(self, pieces: list[Piece]) -> list[Piece]:
        """Return the pieces."""
        return pieces

    def of_lines(self, place: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the lines."""
        return place, weight

    def holds(self, xi: np.ndarray) -> np.ndarray:
        """Return that every point tells of itself."""
        return np.ones(xi.shape, bool)

    def axes(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return η and ξ."""
        return np.stack([eta, xi])

    def mean_across(self, share: np.ndarray, xi: np.ndarray) -> np.ndarray:
        """Return the mean over the last axis."""
        return np.asarray((share * xi).sum(-1))

    def behind(self, other: "PupilDomain") -> "PupilDomain":
        """Return the whole disc, whatever stands before it."""
        return self

    def sampling_rays(self, radii: int, directions: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return rays: on every ring as many as the harmonics need that are not small there.

        A term ρⁿ·cos mθ has n ≥ m, so that near the middle few directions do, while on the rim a polynomial of degree n
        takes 2n + 1. With as many on all rings, the same number of rays tells some terms apart by rounding alone.
        """
        from p2sf.disc.quadrature import gauss_legendre

        square, weight = gauss_legendre(radii)
        rho, held = np.sqrt((1 + square) / 2), np.deg2rad(HELD_OUT_AROUND_DEG)
        counts = ring_counts(rho, radii * directions)
        angle = np.concatenate([(np.arange(count) + 0.25) * (2 * np.pi / count) for count in counts])
        radius, share = np.repeat(rho, counts), np.repeat(weight / 2 / counts, counts)
        xi, eta = radius * np.sin(angle), radius * np.cos(angle)
        return np.append(xi, np.sin(held)), np.append(eta, np.cos(held)), share


HALF, WHOLE = PupilDomain(), WholeDisc()


def domain_of(symmetric: bool) -> PupilDomain:
    """Return the domain of a pupil that is symmetric about η, or of one that is not."""
    return HALF if symmetric else WHOLE


def _steps(ends: tuple[float, ...], count: int) -> np.ndarray:
    """Return directions from end to end, at even steps between neighbours, some ``count`` to half a turn."""
    arcs = ((low, high, max(2, round(count * (high - low) / np.pi))) for low, high in pairwise(ends))
    return np.concatenate([np.linspace(*arc, endpoint=False) for arc in arcs])


def ring_counts(rho: np.ndarray, total: int) -> np.ndarray:
    """Return how many of all rays are on each ring, in proportion to a power of its radius."""
    part = rho**RING_POWER
    counts: np.ndarray = np.maximum(1, np.rint(total * part / part.sum())).astype(int)
    counts[-1] += total - int(counts.sum())
    return counts


@dataclass(frozen=True, eq=False)
class ClearNodes:
    """Nodes (ξ, η), each (nodes,), over the open part of the pupil, with weights of unit sum, some of them negative.

    ``share``: the open share of the pupil's area. ``amplitude`` and ``path_um``: what the mask does at the nodes,
    numbers where it does nothing. ``domain``: HALF where these are the nodes of the half disc ξ ≥ 0, whose weights
    count the mirror half too.
    """

    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    share: float
    amplitude: FloatOrArray = 1.0
    path_um: FloatOrArray = 0.0
    domain: PupilDomain = HALF

    @property
    def axes(self) -> np.ndarray:
        """Return the coordinates that a tilt is linear in, (1 or 2, nodes): over the half disc η alone."""
        return self.domain.axes(self.xi, self.eta)

    def part(self, some: slice | np.ndarray) -> "ClearNodes":
        """Return only these nodes; their weights no longer sum to 1."""
        amplitude, path = (x[some] if isinstance(x, np.ndarray) else x for x in (self.amplitude, self.path_um))
        return ClearNodes(self.xi[some], self.eta[some], self.weight[some], self.share, amplitude, path, self.domain)

    def with_points(self, xi: np.ndarray, eta: np.ndarray) -> "ClearNodes":
        """Return the nodes and behind them points of no area, where the mask counts as open."""
        amplitude, path = (
            np.append(v, np.full(xi.size, one)) if isinstance(v, np.ndarray) else v
            for v, one in ((self.amplitude, 1.0), (self.path_um, 0.0))
        )
        weight = np.append(self.weight, np.zeros(xi.size))
        return replace(
            self,
            xi=np.append(self.xi, xi),
            eta=np.append(self.eta, eta),
            weight=weight,
            amplitude=amplitude,
            path_um=path,
        )

    def unfolded(self) -> "ClearNodes":
        """Return nodes over the whole disc, for light that is not even in ξ."""
        return self.domain.unfold(self)
