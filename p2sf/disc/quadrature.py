"""Sample points of the unit disc that integrate a smooth pupil to any accuracy (handbook 4.2).

A square grid with an all-or-nothing edge converges slowly; Gauss–Legendre in ρ² times uniform angles has
no such edge, and converges faster than any power once it resolves the phase.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, update_wrapper
from math import ceil, pi
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import DTypeLike

from p2sf.conventions import FloatOrArray, write_protect
from p2sf.errors import SamplingError

# Relative L2 error of a converged PSF in its window.
SETTLED_TOLERANCE = 1e-4
NEWTON_STEPS = 8
NEWTON_ENOUGH = 1e-6  # of a step, in units of the smallest distance between nodes: the next error is its square
MOST_KEPT = 2**18  # most nodes of a cached result: 3 MB for the half disc
UNCOUNTED = 2.0**40  # nodes along one line, more than any sum uses
AT_ONCE = 2**22  # numbers in one block of a summed table

Nodes = TypeVar("Nodes")


@dataclass(frozen=True, eq=False)
class DiscNodes:
    """Nodes on the half disc ξ ≥ 0, shape (nodes,); the weights count the mirror half too and sum to 1."""

    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray

    def astype(self, dtype: DTypeLike) -> "DiscNodes":
        """Return the same nodes in another precision."""
        return DiscNodes(*(x.astype(dtype) for x in (self.xi, self.eta, self.weight)))


class _Cached(Generic[Nodes]):
    """A function of two counts that caches its latest results with at most MOST_KEPT nodes."""

    def __init__(self, make: Callable[[int, int], Nodes]):
        self._make, self._known = make, lru_cache(maxsize=32)(make)
        self.cache_clear = self._known.cache_clear
        update_wrapper(self, make)

    def __call__(self, first: int, second: int) -> Nodes:
        return (self._make if first * second > MOST_KEPT else self._known)(first, second)


@lru_cache(maxsize=32)
def disc_axes(radial: int, angular: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the radii, (radial,), and the angles from +η over half a turn, (angular/2,), of `disc_nodes`."""
    theta = (np.arange(angular // 2) + 0.5) * (2 * pi / angular)
    return write_protect(np.sqrt((1 + gauss_legendre(radial)[0]) / 2)), write_protect(theta)


@_Cached
def disc_nodes(radial: int, angular: int) -> DiscNodes:
    """Return the half-disc nodes of Gauss–Legendre in ρ² times ``angular`` directions around the whole circle.

    ``angular`` is even, and the directions lie midway between multiples of 2π/angular: none falls on the
    fold ξ = 0, so each node's mirror image is a node of the full rule and the fold is exact for every
    function even in ξ. Shape (radial·angular/2,); the weighted sum is a mean over the area. Raises SamplingError.
    """
    if radial < 1 or angular < 2 or angular % 2:
        raise SamplingError(
            "{radial} radii × {angular} directions; give at least 1 radius and an even count ≥ 2",
            radial=radial,
            angular=angular,
        )
    rho, theta = disc_axes(radial, angular)
    xi, eta = np.outer(rho, np.sin(theta)), np.outer(rho, np.cos(theta))
    share = np.repeat(gauss_legendre(radial)[1] / angular, angular // 2)
    return DiscNodes(write_protect(xi.ravel()), write_protect(eta.ravel()), write_protect(share))


@_Cached
def whole_disc(radial: int, angular: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ξ, η and weights (sum 1) of the nodes of `disc_nodes` and their mirror images, each (radial·angular,)."""
    half = disc_nodes(radial, angular)
    xi, eta = np.append(half.xi, -half.xi), np.append(half.eta, half.eta)
    return write_protect(xi), write_protect(eta), write_protect(np.append(half.weight, half.weight) / 2)


@dataclass(frozen=True, eq=False)
class RowNodes:
    """Nodes of the quarter disc ξ, η > 0 in rows of equal η, for sums that separate into two products.

    ``eta``: (rows,); ``xi``: (rows, columns), or (1, columns) where all rows share it; ``weight``: (rows, columns)
    counts the three mirror images too and sums to 1. ``name`` describes the rule.
    """

    eta: np.ndarray
    xi: np.ndarray
    weight: np.ndarray
    name: str

    def part(self, some: slice) -> "RowNodes":
        """Return these rows only; their weights no longer sum to 1."""
        xi = self.xi if len(self.xi) == 1 else self.xi[some]
        return RowNodes(self.eta[some], xi, self.weight[some], self.name)


@_Cached
def chord_rows(rows: int, columns: int) -> RowNodes:
    """Return Gauss–Chebyshev rows (second kind) times Gauss–Legendre along each chord; both counts even.

    ∫∫ f dξ dη = ∫ √(1−η²) dη ∫ f(s√(1−η²), η) ds, s in (−1, 1): the root is the Chebyshev weight, so the rest is smooth
    and the rule converges like `disc_nodes` (Stroud 1971, §2.6), but the kernel in y is applied once per row. Counts
    are for the whole disc. Raises SamplingError.
    """
    if rows < 2 or columns < 2 or rows % 2 or columns % 2:
        raise SamplingError(
            "{rows} rows × {columns} columns; give even counts of at least 2", rows=rows, columns=columns
        )
    angle = np.arange(1, rows // 2 + 1) * (pi / (rows + 1))
    along, weight = (x[columns // 2 :] for x in gauss_legendre(columns))
    share = np.outer(np.sin(angle) ** 2 * (4 / (rows + 1)), weight)
    name = f"{rows} × {columns} Gauss–Chebyshev × Gauss–Legendre nodes"
    return RowNodes(
        write_protect(np.cos(angle)), write_protect(np.outer(np.sin(angle), along)), write_protect(share), name
    )


@lru_cache(maxsize=8)
def grid_rows(size: int) -> RowNodes:
    """Return the ``size``² uniform grid over [−1, 1]² with edge cells weighted by their area inside; size even.

    Second-order at best: good enough for a preview (128²: some 4e-2 relative L2 far off axis). Raises SamplingError.
    """
    if size < 2 or size % 2:
        raise SamplingError("a pupil grid of {size} samples; give an even count of at least 2", size=size)
    centre = (np.arange(size // 2) + 0.5) * (2 / size)
    area = cell_areas(centre, centre, 2 / size)
    name = f"{size} × {size} uniform grid, edge cells weighted by area"
    return RowNodes(write_protect(centre), write_protect(centre[None].copy()), write_protect(area / area.sum()), name)


def cell_areas(xi: FloatOrArray, eta: FloatOrArray, step: float, strips: int = 16) -> np.ndarray:
    """Return the fraction of each square cell inside the unit disc, shape (len(eta), len(xi)), centres given.

    Exact in η, Gauss–Legendre over ``strips`` strips in ξ.
    """
    node, weight = gauss_legendre(strips)
    column = np.abs(np.asarray(xi))[:, None] + node * (step / 2)
    chord = np.sqrt(np.maximum(0, 1 - column**2))
    bottom = np.abs(np.asarray(eta))[:, None, None] - step / 2
    blocks = np.array_split(bottom, ceil(bottom.size * chord.size / AT_ONCE))
    return np.concatenate([_overlap(chord, block, step) @ (weight / 2) for block in blocks])


def _overlap(chord: np.ndarray, bottom: np.ndarray, step: float) -> np.ndarray:
    """Return the share of each strip [bottom, bottom + step] that lies within ±chord."""
    top = np.minimum(chord, bottom + step)
    share: np.ndarray = np.maximum(0, top - np.maximum(-chord, bottom)) / step
    return share


@lru_cache(maxsize=256)
def gauss_legendre(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return nodes in (−1, 1), ascending, and weights (sum 2) of the rule that is exact to degree 2·count − 1.

    Newton's method on the positive half from Tricomi's guess (Abramowitz & Stegun 1964, 22.16.6 and 25.4.29):
    a thousand nodes take some ten milliseconds, where the eigenvalue method takes seconds.
    """
    x = (1 - (count - 1) / (8 * count**3)) * np.cos(pi * (np.arange(1, (count + 3) // 2) - 0.25) / (count + 0.5))
    for _ in range(NEWTON_STEPS):
        value, slope = _legendre(count, x)
        step = value / slope
        x = x - step
        if count**2 * np.abs(step).max() < NEWTON_ENOUGH:
            break
    _, slope = _legendre(count, x)
    weight = 2 / ((1 - x**2) * slope**2)
    return write_protect(np.append(-x, x[::-1][count % 2 :])), write_protect(
        np.append(weight, weight[::-1][count % 2 :])
    )


def ring_count(radial: int, width: float) -> int:
    """Return the number of radii for a part of the radius if the whole radius has ``radial``."""
    return ceil((radial - 4) * width) + 4 if radial > 4 else radial


def _legendre(order: int, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return P_n and its derivative by the three-term recurrence (A&S 22.7.10, 22.8.5)."""
    before, value, work = np.ones_like(x), x.copy(), np.empty_like(x)
    for n in range(1, order):  # in place: allocating short arrays takes as long as adding them
        np.multiply(x, value, out=work)
        work *= (2 * n + 1) / (n + 1)
        before *= n / (n + 1)
        np.subtract(work, before, out=before)
        before, value = value, before
    return value, order * (before - x * value) / (1 - x**2)


def nodes_for(slope: float, reach: float, twist: float | None = None) -> tuple[int, int]:
    """Return the (radial, angular) counts that resolve a phase, so that the PSF converges to SETTLED_TOLERANCE.

    ``slope``: steepest |∂W/∂ρ|, ``twist``: steepest |∂W/∂θ| (``slope`` bounds it if not given), both in
    waves; ``reach``: waves per unit radius of the kernel at the window's farthest corner. The margins are
    measured against four times finer rules, up to 200 waves (tests/disc/test_quadrature.py).
    """
    radial = 0.85 * _harmonics(slope + reach, 7) + 0.15 * _harmonics(reach, 7)
    angular = _harmonics((slope if twist is None else twist) + reach, 7)
    return _next_count(radial / 4 + 4), even_count(angular + 4)


def chords_for(
    row_slope: FloatOrArray, column_slope: FloatOrArray, reach: float, reach_across: float | None = None
) -> tuple[int, int]:
    """Return (rows, columns) of `chord_rows` for the slopes of `wavefront.steepest_chords`, as accurate as `nodes_for`.

    ``reach_across``: the kernel's waves at the window's side edge, the largest for columns; by default ``reach``, an
    upper bound. The largest slope of an array counts. n Gauss nodes integrate 2n harmonics.
    """
    across = reach if reach_across is None else reach_across
    return _chord_count(row_slope, reach), _chord_count(column_slope, across)


def _chord_count(slope: FloatOrArray, reach: float) -> int:
    return even_count(_harmonics(float(np.max(slope)) + reach, 7) / 2 + 4)


def _harmonics(slope: float, tail: float) -> float:
    """Return the number of harmonics of a phase whose steepest slope is ``slope`` waves per radian.

    They end like those of exp(iz·cosθ), which are Bessel functions J_m(z): at m = z + tail·z^⅓ (A&S 9.3.23),
    z = 2π·slope.
    """
    z = 2 * pi * abs(slope)
    return z + tail * float(np.cbrt(z))


def even_count(count: float) -> int:
    """Return the next even count with four significant bits."""
    return 2 * _next_count(count / 2)


def _next_count(count: float) -> int:
    """Return the next count with four significant bits, so that neighbouring requests share the cache.

    At most `UNCOUNTED`, also for NaN, which the sums refuse.
    """
    count = count if count < UNCOUNTED else UNCOUNTED
    step: int = 2 ** max(0, int(count).bit_length() - 4)
    return step * ceil(count / step)
