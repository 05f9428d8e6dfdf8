"""The polynomials that describe a pupil, and the part of the disc over which they must be known (handbook 5.3).

For a field along η phase, fy and amplitude are even in ξ and fx is odd, so that half the disc suffices. Without that
symmetry each of them has the terms of the other parity as well, behind its own, and the whole disc is needed. Users of
a basis need not distinguish the two: a symmetric basis has fewer terms and fewer nodes.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import write_protect
from p2sf.disc.domain import HALF, ClearNodes, PupilDomain
from p2sf.disc.zernike import basis, gradient, terms

Gradient: TypeAlias = tuple[np.ndarray, np.ndarray]  # ∂/∂ξ and ∂/∂η of some terms, each (terms, points)
Kinds: TypeAlias = tuple[np.ndarray, np.ndarray]  # values for the terms even in ξ and for the odd ones


@dataclass(frozen=True)
class Terms:
    """The polynomials of `zernike` up to an order that describe one function over the pupil.

    ``parities``: whether terms are odd in ξ, one group behind the other.
    """

    order: int
    parities: tuple[bool, ...]

    @cached_property
    def counts(self) -> tuple[int, ...]:
        """Return the number of terms of each parity."""
        return tuple(len(terms(self.order, odd)) for odd in self.parities)

    @cached_property
    def count(self) -> int:
        """Return the number of terms."""
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
        """Return the values of these terms, (…, terms, points), selected from those of all even and all odd ones."""
        found = [kinds[odd][..., :count, :] for odd, count in zip(self.parities, self.counts, strict=True)]
        return found[0] if len(found) == 1 else np.concatenate(found, axis=-2)

    def values(self, xi: ArrayLike, eta: ArrayLike) -> np.ndarray:
        """Return the terms at pupil points, (terms, points)."""
        return np.concatenate([basis(self.order, xi, eta, odd) for odd in self.parities])

    def gradient(self, xi: ArrayLike, eta: ArrayLike) -> Gradient:
        """Return ∂/∂ξ and ∂/∂η of the terms at pupil points, each (terms, points)."""
        across, along = zip(*(gradient(self.order, xi, eta, odd) for odd in self.parities), strict=True)
        return np.concatenate(across), np.concatenate(along)

    def widened(self, coefficients: np.ndarray, order: int) -> np.ndarray:
        """Return coefficients, (…, terms), with zeros for the terms up to a higher order."""
        parts = []
        for (_, own), wide in zip(self.kinds(coefficients), Terms(order, self.parities).counts, strict=True):
            parts.append(np.pad(own, [(0, 0)] * (own.ndim - 1) + [(0, wide - own.shape[-1])]))
        return np.concatenate(parts, axis=-1)

    def turned(self, coefficients: np.ndarray, angles: np.ndarray) -> Kinds:
        """Return even and odd coefficients, (…, terms), of functions rotated by ``angles``, (…), from +η to +ξ.

        θ becomes θ − angle, which mixes each cos mθ with its sin mθ; nothing is interpolated.
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
    """Return m of every even term, and the indices of those with m > 0, which the odd terms match in the same order."""
    harmonic = np.array([m for _, m in terms(order)])
    return write_protect(harmonic), write_protect(np.flatnonzero(harmonic))


class PupilValues(NamedTuple):
    """The terms of phase, fx and fy, or one of their slopes, each (terms, points); the amplitude shares those of fy."""

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
    """A basis at nodes over its domain."""

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
def at_nodes(basis: PupilBasis, counts: tuple[int, int]) -> BasisAtNodes:
    """Return a basis at the nodes of (radial, angular) ``counts``; it is cached with its terms."""
    return BasisAtNodes(basis, basis.domain.nodes(counts))
