"""Functions over the unit disc by their values on a polar grid: exact for polynomials, linear, known anywhere.

f(ρ, θ) = Σ_m f_m(ρ)·cos(mθ), or with sin(mθ) if it is odd in ξ; f_m is even in ρ for even m and odd for odd m, so that
f_m(ρ)/ρ^(m mod 2) is a polynomial in ρ². Gauss–Legendre nodes in ρ² and evenly spaced angles determine as many of both
as there are nodes, and converge geometrically (Boyd 2001, §18.5).
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TypeAlias

import numpy as np
from numpy.polynomial.legendre import legder, legval, legvander

from p2sf.conventions import write_protect
from p2sf.disc.domain import HALF, PupilDomain
from p2sf.disc.quadrature import disc_axes, disc_nodes, gauss_legendre
from p2sf.disc.zernike import basis, powers, rising_powers

Counts: TypeAlias = tuple[int, int]
"""Radii, and directions around the whole circle, an even number."""
Pair: TypeAlias = tuple[np.ndarray, np.ndarray]
VALUE, BY_RADIUS, BY_ANGLE = "value", "∂/∂ρ", "∂/∂θ"
BLOCK = 2**14  # points evaluated at once: 3 MB for each channel of order 24


@dataclass(frozen=True, eq=False)
class DiscFunction:
    """Functions over the disc, each by its ``values`` at the nodes of ``domain.nodes(counts)``, (…, channels, nodes).

    ``odd``: of each channel, whether it is odd in ξ by symmetry; over the whole disc that says nothing. Sums and
    multiples of values are those of the functions.
    """

    values: np.ndarray
    counts: Counts
    odd: tuple[bool, ...]
    domain: PupilDomain = HALF

    def __sub__(self, other: "DiscFunction") -> "DiscFunction":
        """Return the difference of functions that have the same nodes."""
        return replace(self, values=self.values - other.values)

    def channels(self, some: slice) -> "DiscFunction":
        """Return some of the functions."""
        return replace(self, values=self.values[..., some, :], odd=self.odd[some])

    def on(self, counts: Counts) -> np.ndarray:
        """Return the functions at the nodes of other counts, (…, channels, nodes)."""
        return self.on_polar(*disc_axes(*counts))

    def on_polar(self, radius: np.ndarray, theta: np.ndarray, what: str = VALUE) -> np.ndarray:
        """Return the functions, or ∂/∂ρ or ∂/∂θ of them, at radii × angles, (…, channels, points).

        ``theta`` counts from +η towards the side on which a point lies; points at −ξ, if the domain has any, come last.
        """
        halves, axes = self.domain.halves, (radius.tobytes(), theta.tobytes())
        found = np.zeros((*self.values.shape[:-1], len(halves), radius.size, theta.size))
        for channel, odd, part in self._parts():  # one by one: of millions of points each takes 50 MB
            values = _onto(part, self.counts, axes, odd, what)
            for k, half in enumerate(halves):
                found[..., channel, k, :, :] += half * values if odd else values
        return found.reshape(*self.values.shape[:-1], -1)

    def at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the functions at points of the disc, each (points,), on whichever side: (…, channels, points).

        As polynomials of the `order` that the nodes determine, which are the functions where these are polynomials:
        fifteen times as fast as all harmonics, which `on_polar` shares between the points of a circle, at 2500 points.
        """
        found = np.zeros((*self.values.shape[:-1], xi.size))
        for some in (slice(first, first + BLOCK) for first in range(0, xi.size, BLOCK)):
            squares, heights = self._powers_at(xi[some], eta[some])
            for odd, table in self._tables:
                part = _sum(table, squares, heights)
                for channel in odd:
                    part[..., channel, :] *= xi[some]
                found[..., some] += part
        return found

    def on_grid(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the functions, as `at` has them, at all points of a grid by its columns ξ and rows η.

        (…, channels, rows, columns), by two products.
        """
        squares, heights = self._powers_at(xi, eta)
        found = np.zeros((*self.values.shape[:-1], eta.size, xi.size))
        for odd, table in self._tables:
            part = heights.T @ table @ squares
            part[..., odd, :, :] *= xi
            found += part
        return found

    def slopes_at(self, xi: np.ndarray, eta: np.ndarray) -> Pair:
        """Return ∂/∂ξ and ∂/∂η at points of the disc, as `at` does the functions."""
        squares, heights = self._powers_at(xi, eta)
        across, along = np.zeros((2, *self.values.shape[:-1], xi.size))
        for odd, table in self._tables:
            even = [channel for channel in range(len(self.odd)) if channel not in odd]
            power = 2 * np.arange(table.shape[-1])  # of ξ, one more in odd channels
            across[..., odd, :] += _sum(table[..., odd, :, :] * (power + 1), squares, heights)
            across[..., even, :] += xi * _sum((table[..., even, :, :] * power)[..., 1:], squares[:-1], heights)
            part = _sum(table[..., 1:, :] * np.arange(1, table.shape[-2])[:, None], squares, heights[:-1])
            part[..., odd, :] *= xi
            along += part
        return across, along

    def _powers_at(self, xi: np.ndarray, eta: np.ndarray) -> Pair:
        """Return the powers of ξ² and of η that the polynomials have, (powers, points)."""
        return rising_powers(xi * xi, self.order // 2 + 1), rising_powers(eta, self.order + 1)

    @property
    def order(self) -> int:
        """Return the highest order of polynomials all products of which the rule of its nodes integrates exactly."""
        return min(2 * self.counts[0], self.counts[1] // 2) - 1

    def gradient(self, counts: Counts | None = None) -> Pair:
        """Return ∂/∂ξ and ∂/∂η at its own nodes or those of other counts, each (…, channels, nodes)."""
        counts = counts or self.counts
        axes, nodes = disc_axes(*counts), self.domain.nodes(counts)
        square = nodes.xi**2 + nodes.eta**2
        by_radius, by_angle = (self.on_polar(*axes, what) for what in (BY_RADIUS, BY_ANGLE))
        outwards, around = by_radius / np.sqrt(square), by_angle * np.sign(nodes.xi) / square
        return outwards * nodes.xi + around * nodes.eta, outwards * nodes.eta - around * nodes.xi

    @cached_property
    def _tables(self) -> list[tuple[list[int], np.ndarray]]:
        """Return c[…, channel, b, a] of ηᵇ·ξ²ᵃ, times ξ for the channels named before it; over the whole disc twice."""
        shape = *self.values.shape[:-1], self.order + 1, self.order // 2 + 1
        tables: list[tuple[list[int], np.ndarray]] = [([], np.empty(shape)) for _ in self.domain.halves]
        for k, (channel, odd, part) in enumerate(self._parts()):
            of_odd, table = tables[k % len(tables)]
            of_odd += [channel] * odd
            # Terms first: those of high order, whose powers are large, are small.
            terms = part @ _means(self.counts, self.order, odd)
            forms = powers(self.order, odd)  # (terms, a, b)
            by_powers = (terms @ forms.reshape(len(forms), -1)).reshape(*terms.shape[:-1], *forms.shape[1:])
            table[..., channel, :, :] = by_powers.swapaxes(-1, -2)
        return tables

    def _parts(self) -> Iterator[tuple[int, bool, np.ndarray]]:
        """Yield, of each channel, what is even in ξ of it and what is odd, by the values on the half ξ > 0."""
        sides = self.values.reshape(*self.values.shape[:-1], len(self.domain.halves), -1)
        first, last = sides[..., 0, :], sides[..., -1, :]  # of the half disc they are one
        parts = ((first + last) / 2, (first - last) / 2) if len(self.domain.halves) > 1 else (first, first)
        for channel, own in enumerate(self.odd):
            for odd in self.domain.parities(own):
                yield channel, odd, parts[odd][..., channel, :]


def _sum(table: np.ndarray, squares: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Return Σ table[…, b, a]·heights[b]·squares[a], (…, points)."""
    found: np.ndarray = np.einsum("...bn,bn->...n", table @ squares, heights)
    return found


def _onto(values: np.ndarray, counts: Counts, axes: tuple[bytes, bytes], odd: bool, what: str) -> np.ndarray:
    """Return a function at radii × angles, (…, radii, angles), from its values at the nodes of the half disc."""
    up, across = _matrices(counts, axes, odd, what)
    both = values.reshape(*values.shape[:-1], counts[0], counts[1] // 2) @ across
    found: np.ndarray = up @ both.reshape(*values.shape[:-1], 2 * counts[0], -1)
    return found


@lru_cache(maxsize=32)
def _means(counts: Counts, order: int, odd: bool) -> np.ndarray:
    """Return the matrix (nodes, terms) from values on the half disc to orthonormal polynomials: means of products."""
    nodes = disc_nodes(*counts)
    return write_protect((basis(order, nodes.xi, nodes.eta, odd) * nodes.weight).T)


@lru_cache(maxsize=32)
def _matrices(counts: Counts, axes: tuple[bytes, bytes], odd: bool, what: str) -> Pair:
    """Return the matrices (radii, 2·radial) and (angular/2, 2·angles) between which `_onto` takes values.

    ``axes``: radii and angles as bytes. Even harmonics and odd ones are separate: the former in every other column of
    the first matrix and in the first half of the second, the latter in the others.
    """
    rho, theta = map(np.frombuffer, axes)
    analysis, number = _harmonics(counts[1], odd)
    wave, at_odd = _waves(number, theta, odd, what == BY_ANGLE), number % 2 == 1
    across = np.concatenate([analysis[:, some] @ wave[some] for some in (~at_odd, at_odd)], axis=1)
    # Of odd harmonics ρ·polynomial of what is divided by ρ at the nodes.
    polynomial, slope = _polynomials(counts[0], rho)
    linear = polynomial + rho[:, None] * slope if what == BY_RADIUS else rho[:, None] * polynomial
    even = slope if what == BY_RADIUS else polynomial
    up = np.stack([even, linear / disc_axes(*counts)[0]], axis=2).reshape(rho.size, -1)
    return write_protect(up), write_protect(across)


@lru_cache(maxsize=8)
def _harmonics(angular: int, odd: bool) -> Pair:
    """Return the matrix (angles, harmonics) from values over half a turn to their harmonics, and the harmonics."""
    half = angular // 2
    theta = (np.arange(half) + 0.5) * (np.pi / half)
    number = np.arange(1, half + 1) if odd else np.arange(half)
    matrix = _waves(number, theta, odd).T * (2 / half)
    matrix[:, number % half == 0] /= 2  # of the constant, and of the sine that alternates
    return write_protect(matrix), write_protect(number)


def _waves(number: np.ndarray, theta: np.ndarray, odd: bool, slope: bool = False) -> np.ndarray:
    """Return cos(mθ), or sin if ``odd``, or the slope of either, (harmonics, angles)."""
    turns = np.outer(number, theta)
    if not slope:
        return np.asarray(np.sin(turns) if odd else np.cos(turns))
    return number[:, None] * (np.cos(turns) if odd else -np.sin(turns))


@lru_cache(maxsize=32)
def _legendre(radial: int) -> np.ndarray:
    """Return the matrix (n, radial) from a polynomial's values at the Gauss nodes in ρ² to its Legendre coefficients.

    (2n + 1)/2·⟨f, Pₙ⟩, which the rule integrates exactly (A&S 22.2.10).
    """
    place, weight = gauss_legendre(radial)
    return write_protect(((legvander(place, radial - 1) * weight[:, None]) * (np.arange(radial) + 0.5)).T)


def _polynomials(radial: int, rho: np.ndarray) -> Pair:
    """Return the matrices (radii, radial) from a polynomial's values at the Gauss nodes to values and ∂/∂ρ at radii."""
    place, terms = 2 * np.square(rho) - 1, _legendre(radial)
    slopes = legval(place, legder(np.eye(radial))).T if radial > 1 else np.zeros((rho.size, 1))
    return legvander(place, radial - 1) @ terms, (4 * rho[:, None]) * (slopes @ terms)
