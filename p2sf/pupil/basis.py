"""Which polynomials describe a pupil, and over which part of the disc they have to be known (handbook 5.3).

A field along η leaves phase, fy and amplitude even in ξ, and fx odd, so that half the disc tells everything. Without
that symmetry each of them has the terms of the other kind as well, behind its own, and the whole disc is needed.
Whoever uses a basis need not ask which it is: a symmetric one has fewer terms and fewer nodes.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import write_protect
from p2sf.pupil.mask import CLEAR, PupilMask
from p2sf.pupil.mask_nodes import ClearNodes, mask_nodes
from p2sf.pupil.quadrature import disc_nodes, gauss_legendre
from p2sf.pupil.zernike import basis, columns, evaluate, gradient, terms

Gradient: TypeAlias = tuple[np.ndarray, np.ndarray]  # ∂/∂ξ and ∂/∂η of some terms, each (terms, points)
Kinds: TypeAlias = tuple[np.ndarray, np.ndarray]  # what belongs to the terms even in ξ, and to the odd ones

# Rays held out of a fit to test it, on the rim, where a polynomial deviates first: (ξ, η), and angles from +η to +ξ.
HELD_OUT = np.array([[0.0, 0.0, 1.0, 0.6], [1.0, -1.0, 0.0, 0.8]])
HELD_OUT_AROUND_DEG = np.array([0.0, 80.0, 170.0, 260.0])
RING_POWER = 1.3  # of a ring's radius: with 60 rays the terms of degree 8 have a condition number of 3


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

    def nodes(self, counts: tuple[int, int]) -> ClearNodes:
        """Return the nodes of (radial, angular) ``counts``."""
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
        return 0.0, *corners, np.pi

    def middle(self, xi: np.ndarray, eta: np.ndarray) -> tuple[float, float]:
        """Return the middle of points all over the disc: of a symmetric pupil on the line ξ = 0."""
        return 0.0, float(eta.mean())

    def over(self, nodes: ClearNodes) -> ClearNodes:
        """Return nodes that are known over half the disc, or over all of it, over the domain."""
        return nodes

    def sampling_rays(self, radii: int, directions: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return ξ and η of radii × directions rays for a fit and of those held out, and the former's area weights."""
        nodes = disc_nodes(radii, 2 * directions)
        return np.append(nodes.xi, HELD_OUT[0]), np.append(nodes.eta, HELD_OUT[1]), nodes.weight


@dataclass(frozen=True)
class WholeDisc(PupilDomain):
    """The domain of a pupil without symmetry."""

    symmetric: ClassVar = False
    halves: ClassVar[tuple[int, ...]] = (1, -1)
    images: ClassVar[tuple[int, ...]] = (1,)

    def neighbours(self, theta: np.ndarray) -> np.ndarray:
        """Return the directions, and the first once more."""
        return np.append(theta, theta[0] + self.turn)

    def between(self, corners: list[float]) -> tuple[float, ...]:
        """Return the corners, once around."""
        return (*corners, corners[0] + self.turn) if corners else (0.0, self.turn)

    def middle(self, xi: np.ndarray, eta: np.ndarray) -> tuple[float, float]:
        """Return the middle of points, wherever it lies."""
        return float(xi.mean()), float(eta.mean())

    def over(self, nodes: ClearNodes) -> ClearNodes:
        """Return nodes over the whole disc."""
        return nodes.unfolded()

    def sampling_rays(self, radii: int, directions: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return rays: on every ring as many as the harmonics need that are not small there.

        A term ρⁿ·cos mθ has n ≥ m, so that near the middle few directions do, while on the rim a polynomial of degree n
        takes 2n + 1. With as many on all rings, the same number of rays tells some terms apart by rounding alone.
        """
        square, weight = gauss_legendre(radii)
        rho, held = np.sqrt((1 + square) / 2), np.deg2rad(HELD_OUT_AROUND_DEG)
        counts = ring_counts(rho, radii * directions)
        angle = np.concatenate([(np.arange(count) + 0.25) * (2 * np.pi / count) for count in counts])
        radius, share = np.repeat(rho, counts), np.repeat(weight / 2 / counts, counts)
        xi, eta = radius * np.sin(angle), radius * np.cos(angle)
        return np.append(xi, np.sin(held)), np.append(eta, np.cos(held)), share


HALF, WHOLE = PupilDomain(), WholeDisc()


def ring_counts(rho: np.ndarray, total: int) -> np.ndarray:
    """Return how many of all rays are on each ring, in proportion to a power of its radius."""
    part = rho**RING_POWER
    counts: np.ndarray = np.maximum(1, np.rint(total * part / part.sum())).astype(int)
    counts[-1] += total - int(counts.sum())
    return counts


@dataclass(frozen=True)
class Terms:
    """The polynomials of `zernike` up to an order that describe one function over the pupil.

    ``parities``: whether they are odd in ξ, those of one parity behind those of the other.
    """

    order: int
    parities: tuple[bool, ...]

    @cached_property
    def counts(self) -> tuple[int, ...]:
        """Return how many terms there are of each parity."""
        return tuple(len(terms(self.order, odd)) for odd in self.parities)

    @cached_property
    def count(self) -> int:
        """Return how many terms there are."""
        return sum(self.counts)

    @property
    def constant(self) -> bool:
        """Return whether the constant is one of them."""
        return False in self.parities

    @cached_property
    def indices(self) -> np.ndarray:
        """Return n and m of every term, (2, terms)."""
        return write_protect(np.array([index for odd in self.parities for index in terms(self.order, odd)]).T)

    def kinds(self, coefficients: np.ndarray) -> tuple[tuple[bool, np.ndarray], ...]:
        """Return coefficients, (…, terms), by parity."""
        return tuple((odd, coefficients[..., part]) for odd, part in self._parts)

    @cached_property
    def _parts(self) -> tuple[tuple[bool, slice], ...]:
        ends = np.cumsum(self.counts).tolist()
        slices = (slice(end - count, end) for end, count in zip(ends, self.counts, strict=True))
        return tuple(zip(self.parities, slices, strict=True))

    def of(self, kinds: Kinds) -> np.ndarray:
        """Return the values of the terms, (…, terms, points), among those of all even and of all odd ones."""
        found = [kinds[odd][..., :count, :] for odd, count in zip(self.parities, self.counts, strict=True)]
        return found[0] if len(found) == 1 else np.concatenate(found, axis=-2)

    def values(self, xi: ArrayLike, eta: ArrayLike) -> np.ndarray:
        """Return the terms at pupil points, (terms, points)."""
        return np.concatenate([basis(self.order, xi, eta, odd) for odd in self.parities])

    def gradient(self, xi: ArrayLike, eta: ArrayLike) -> Gradient:
        """Return ∂/∂ξ and ∂/∂η of the terms at pupil points, each (terms, points)."""
        across, along = zip(*(gradient(self.order, xi, eta, odd) for odd in self.parities), strict=True)
        return np.concatenate(across), np.concatenate(along)

    def evaluate(self, coefficients: np.ndarray, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return Σ coefficient·term at pupil points of any shape, by Horner's rule."""
        square = xi * xi
        parts = ((odd, evaluate(columns(own, self.order, odd), square, eta)) for odd, own in self.kinds(coefficients))
        first, *others = (xi * value if odd else value for odd, value in parts)
        for other in others:
            first = first + other
        return first

    def widened(self, coefficients: np.ndarray, order: int) -> np.ndarray:
        """Return coefficients, (…, terms), with zeros for the terms up to a higher order."""
        parts = []
        for (_, own), wide in zip(self.kinds(coefficients), Terms(order, self.parities).counts, strict=True):
            parts.append(np.pad(own, [(0, 0)] * (own.ndim - 1) + [(0, wide - own.shape[-1])]))
        return np.concatenate(parts, axis=-1)

    def turned(self, coefficients: np.ndarray, angles: np.ndarray) -> Kinds:
        """Return the even and the odd coefficients, (…, terms), of functions turned by ``angles``, (…), from +η to +ξ.

        An angle about the pupil becomes θ − angle, which mixes every cos mθ with its sin mθ; there is no interpolation.
        """
        harmonic, paired = _harmonics(self.order)
        phases = np.multiply.outer(angles, harmonic)
        cosine, sine = np.cos(phases), np.sin(phases)
        even, odd = np.zeros_like(cosine), np.zeros(cosine[..., paired].shape)
        for is_odd, own in self.kinds(coefficients):
            if is_odd:
                even[..., paired] -= own * sine[..., paired]
                odd += own * cosine[..., paired]
            else:
                even += own * cosine
                odd += own[..., paired] * sine[..., paired]
        return even, odd

    def joined(self, kinds: Kinds) -> np.ndarray:
        """Return even and odd coefficients, (…, terms), in the order of the terms."""
        return np.concatenate([kinds[odd] for odd in self.parities], axis=-1)


@lru_cache(maxsize=32)
def _harmonics(order: int) -> tuple[np.ndarray, np.ndarray]:
    """Return m of every even term, and the places of those with m > 0: the odd terms are these, in the same order."""
    harmonic = np.array([m for _, m in terms(order)])
    return write_protect(harmonic), write_protect(np.flatnonzero(harmonic))


CONSTANT = Terms(0, (False,))


class PupilValues(NamedTuple):
    """The terms of phase, fx and fy, or one of their slopes, each (terms, points); the amplitude has those of fy."""

    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray


@dataclass(frozen=True)
class PupilBasis:
    """The terms of a pupil's phase up to ``wave_order``, and of its map (fx, fy) and amplitude up to ``map_order``."""

    wave_order: int
    map_order: int
    domain: PupilDomain = HALF

    @cached_property
    def phase(self) -> Terms:
        """Return the terms of the phase."""
        return Terms(self.wave_order, self.domain.parities(False))

    @cached_property
    def fx(self) -> Terms:
        """Return the terms of the frequency along x."""
        return Terms(self.map_order, self.domain.parities(True))

    @cached_property
    def fy(self) -> Terms:
        """Return the terms of the frequency along y, and of the amplitude."""
        return Terms(self.map_order, self.domain.parities(False))

    @cached_property
    def orders(self) -> tuple[int, int]:
        """Return the orders of all terms that are even in ξ, and of all that are odd."""
        every = self.phase, self.fx, self.fy
        even, odd = (max(some.order for some in every if odd in some.parities) for odd in (False, True))
        return even, odd

    def values(self, xi: ArrayLike, eta: ArrayLike) -> PupilValues:
        """Return the terms of phase, fx and fy at pupil points."""
        even, odd = self.orders
        kinds = basis(even, xi, eta), basis(odd, xi, eta, odd=True)
        return PupilValues(self.phase.of(kinds), self.fx.of(kinds), self.fy.of(kinds))

    def map_slopes(self, xi: ArrayLike, eta: ArrayLike) -> tuple[Gradient, Gradient]:
        """Return (∂/∂ξ, ∂/∂η) of the terms of fx and of fy at pupil points."""
        even, odd = (gradient(self.map_order, xi, eta, odd) for odd in (False, True))
        across, along = zip(even, odd, strict=True)
        return (self.fx.of(across), self.fx.of(along)), (self.fy.of(across), self.fy.of(along))


@dataclass(frozen=True, eq=False)
class BasisAtNodes:
    """A basis at nodes over what a mask leaves open of its domain."""

    basis: PupilBasis
    nodes: ClearNodes

    @cached_property
    def values(self) -> PupilValues:
        """Return the terms of phase, fx and fy."""
        return self.basis.values(self.nodes.xi, self.nodes.eta)

    @cached_property
    def map_slopes(self) -> tuple[Gradient, Gradient]:
        """Return the gradients of the terms of fx and of fy."""
        return self.basis.map_slopes(self.nodes.xi, self.nodes.eta)


@lru_cache(maxsize=24)
def at_nodes(basis: PupilBasis, counts: tuple[int, int], mask: PupilMask = CLEAR) -> BasisAtNodes:
    """Return a basis at the nodes of (radial, angular) ``counts``, which is kept with its terms."""
    return BasisAtNodes(basis, basis.domain.over(mask_nodes(mask, *counts)))


def determinant(fx: np.ndarray, fy: np.ndarray, of_fx: Gradient, of_fy: Gradient) -> np.ndarray:
    """Return ∂(fx, fy)/∂(ξ, η) from coefficients and the gradients of the terms of fx and of fy."""
    determinant: np.ndarray = (fx @ of_fx[0]) * (fy @ of_fy[1]) - (fx @ of_fx[1]) * (fy @ of_fy[0])
    return determinant
