"""A pupil as spherical waves from the reference sphere: their sum is the field, also at small Fresnel numbers.

A wavelet from s arrives at X of the sensor with exp(ik|X − s|)/|X − s| (Kirchhoff's integral: Born & Wolf 1999, eq.
8.3.7, without its obliquity, which is 1 to second order in the angle of blur and pupil). With L the distance of s from
the chief ray's point of the sensor, M the direction from s to there and L′ = |X − s|,

    L′ = L + M·X + (|X|² − (M·X)(L′ − L))/(L′ + L).

The first two terms make the wavelet a plane wave. The rest, less that of the chief ray, is the factor by which it
differs. Over nodes and places this factor is a matrix of small rank: columns at some places, chosen by pivoted QR,
give all others (Cheng, Gimbutas, Martinsson & Rokhlin 2005), and each column is one sum of plane waves.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf, pi

import numpy as np
from numpy.typing import DTypeLike

from p2sf.conventions import UM_PER_MM, FloatOrArray
from p2sf.disc.domain import WHOLE
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.cost import COLUMN_SECONDS, PAIR_SECONDS
from p2sf.pupil.fit import level_rays, levels_for
from p2sf.pupil.plane_waves import Waves
from p2sf.raytrace.exit_sphere import ExitSphere
from p2sf.raytrace.pencil import pencil

PROBED = 256  # nodes, and places PROBED_SIDE² of a grid, that show the rank
PROBED_SIDE = 12
FULL_RANK = 0.75  # of the places probed, from which on they do not tell the rank
RANK_ERROR = {np.dtype(np.float64): 3e-6, np.dtype(np.float32): 1e-3}  # of the factor, relative
SEED = 0
PAIRS = 2**20  # of nodes and places, or of columns and places, at a time: some tens of megabytes


@dataclass(frozen=True, eq=False, kw_only=True)
class SphericalWaves(Waves):
    """Spherical waves: plane ones at the chief ray's point of the sensor, and how far away they come from.

    ``length_um``: signed distance of each node from that point; ``chief``: direction cosines along x and y and the
    distance of the chief ray; ``waves_per_um``: n'/λ. The nodes are of the whole pupil. ``most_seconds``: estimated
    ones of a sum, which takes fewer columns than the factor has where it would take longer; ``allowed``: what may
    be left of the factor, relative, at least RANK_ERROR. ``watch`` is called between columns, and raises `Cancelled`
    where the sum is to end.
    """

    length_um: np.ndarray
    chief: tuple[float, float, float]
    waves_per_um: float
    most_seconds: float = inf
    allowed: float = 0.0
    watch: Callable[[], None] | None = None

    @property
    def plane(self) -> Waves:
        """Return the plane waves that agree with the wavelets at the chief ray's point, to second order beside it."""
        return Waves(self.amplitude, self.fx, self.fy, WHOLE, self.blur_um, self.reach_um)

    def within(self, seconds: float) -> "SphericalWaves":
        """Return the same waves with ``most_seconds``."""
        return replace(self, most_seconds=seconds)

    @cached_property
    def directions(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the direction cosines along x and y from each node to the chief ray's point."""
        return self.fx / self.waves_per_um + self.chief[0], self.fy / self.waves_per_um + self.chief[1]

    def field(self, x: np.ndarray, y: np.ndarray, dtype: DTypeLike = np.float64) -> np.ndarray:
        """Return the field over a grid of x and y, µm, (y, x), complex, less the phase that the chief ray adds."""
        found = self.skeleton(x, y, dtype)
        if found.missed is None:
            return self._one_by_one(x, y).astype(np.result_type(dtype, np.complex64))
        (at_x, at_y), (nodes, places) = _grid(x, y), (found.nodes, found.places)
        inverse = np.linalg.pinv(self.factor(nodes, at_x[places], at_y[places]))
        shares = np.empty((places.size, at_x.size), np.result_type(dtype, np.complex64))
        for some in _blocks(at_x.size, places.size):
            shares[:, some] = inverse @ self.factor(nodes, at_x[some], at_y[some])
        total: np.ndarray = np.zeros((y.size, x.size), shares.dtype)
        for place, share in zip(places, shares, strict=True):
            self._look()
            column = np.empty(self.fx.size, complex)
            for some in _blocks(column.size, 1):
                column[some] = self.factor(some, at_x[place : place + 1], at_y[place : place + 1])[:, 0]
            column *= self.amplitude
            total += replace(self.plane, amplitude=column).field(x, y, dtype) * share.reshape(total.shape)
        return total

    def _one_by_one(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the field by every wavelet at every place."""
        at_x, at_y = _grid(x, y)
        total = np.empty(at_x.size, complex)
        for some in _blocks(at_x.size, self.fx.size):
            self._look()
            turn = np.exp(2j * np.pi * (np.outer(self.fx, at_x[some]) + np.outer(self.fy, at_y[some])))
            total[some] = self.amplitude @ (turn * self.factor(slice(None), at_x[some], at_y[some]))
        return total.reshape(y.size, x.size)

    def _look(self) -> None:
        if self.watch:
            self.watch()

    def factor(self, nodes: slice | np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return by what wavelets differ from plane waves, relative to that of the chief ray, (nodes, places)."""
        mx, my, length = (part[nodes, None] for part in (*self.directions, self.length_um))
        more, beyond = _beyond_plane(mx, my, length, x, y)
        of_chief = _beyond_plane(*self.chief, x, y)[1]
        turn = np.exp((2j * np.pi * self.waves_per_um) * (beyond - of_chief))
        factor: np.ndarray = turn * (self.chief[2] / (length + more))
        return factor

    def obliquity(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the cosine of the angle at the pupil's centre between places of a grid and the chief ray, (y, x)."""
        at_x, at_y = _grid(x, y)
        more, distance = _beyond_plane(*self.chief, at_x, at_y)[0], self.chief[2]
        cosine: np.ndarray = (distance + self.chief[0] * at_x + self.chief[1] * at_y) / (distance + more)
        return cosine.reshape(y.size, x.size)

    def near(self, x: float, y: float) -> tuple[float, float, float, float]:
        """Return what `Waves.near` does, of the plane waves that agree with the wavelets there."""
        (mx, my), scale = self.directions, self.waves_per_um
        more, chief_more = _beyond_plane(mx, my, self.length_um, x, y)[0], _beyond_plane(*self.chief, x, y)[0]
        reach = self.length_um + more
        # The direction to (x, y) is (L·M + X)/L′.
        fx, fy = (
            f + scale * ((place - more * m) / reach - (place - chief_more * c) / (self.chief[2] + chief_more))
            for f, m, c, place in ((self.fx, mx, self.chief[0], x), (self.fy, my, self.chief[1], y))
        )
        turn = np.exp(2j * np.pi * (self.fx * x + self.fy * y))
        there = self.amplitude * self.factor(slice(None), np.array([x]), np.array([y]))[:, 0] * turn
        return Waves(there, fx, fy, WHOLE, self.blur_um).near(0.0, 0.0)

    def skeleton(self, x: np.ndarray, y: np.ndarray, dtype: DTypeLike = np.float64) -> "Skeleton":
        """Return the nodes and places of a grid whose rows and columns give the factor, and how exactly."""
        from scipy.linalg import qr

        order = np.random.default_rng(SEED).integers(self.fx.size, size=PROBED)
        ends = [int(find(f)) for f in (self.fx, self.fy) for find in (np.argmin, np.argmax)]
        nodes = np.unique(np.append(order, ends))
        columns, rows = (np.unique(np.linspace(0, axis.size - 1, PROBED_SIDE).round().astype(int)) for axis in (x, y))
        places = (rows[:, None] * x.size + columns).ravel()
        at_x, at_y = _grid(x[columns], y[rows])
        sample = self.factor(nodes, at_x, at_y)
        upper, chosen = qr(sample, mode="r", pivoting=True)[-2:]
        missed = np.append(np.abs(np.diag(upper)), 0.0) / max(abs(upper[0, 0]), np.finfo(float).tiny)
        rank = max(1, int((missed > max(self.allowed, RANK_ERROR[np.dtype(dtype)])).sum()))
        known = rank < FULL_RANK * places.size or places.size == x.size * y.size
        a_column, pairs = COLUMN_SECONDS * self.fx.size, PAIR_SECONDS * self.fx.size * x.size * y.size
        if pairs < min(a_column * rank, self.most_seconds) or (not known and pairs < self.most_seconds):
            return Skeleton(nodes, places, None)
        rank = max(1, min(rank, int(min(self.most_seconds / a_column, rank))))
        kept = chosen[:rank]
        rows_kept = qr(sample[:, kept].T, mode="r", pivoting=True)[-1][:rank]
        return Skeleton(nodes[rows_kept], places[kept], float(missed[rank]) if known else inf)


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Nodes and places, flat ones of a grid, whose rows and columns of a factor give all of it.

    ``missed``: what they leave of it, relative; infinite where that is unknown, None where every wavelet is summed.
    """

    nodes: np.ndarray
    places: np.ndarray
    missed: float | None


def _grid(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    at_x, at_y = np.meshgrid(x, y)
    return at_x.ravel(), at_y.ravel()


def _blocks(count: int, each: int) -> Iterator[slice]:
    """Yield slices of ``count`` things with ``each`` numbers, PAIRS numbers at a time."""
    size = max(1, PAIRS // max(each, 1))
    return (slice(first, first + size) for first in range(0, count, size))


def waves_from(waves: Waves, sphere: ExitSphere | None, length_mm: np.ndarray | None = None) -> Waves:
    """Return the spherical waves of nodes at these distances from the chief ray's point, (nodes,); plane of no sphere.

    ``waves``: the plane waves that agree with them there (`ExitSphere.seen_from`).
    """
    if sphere is None or length_mm is None:
        return waves
    amplitude, fx, fy, length = waves.amplitude, waves.fx, waves.fy, length_mm * UM_PER_MM
    images = waves.domain.images  # the wavelets of mirrored nodes differ beside the axis
    amplitude, fy, length = (np.tile(part, len(images)) for part in (amplitude / len(images), fy, length))
    fx = np.concatenate([image * fx for image in images])
    return SphericalWaves(
        amplitude,
        fx,
        fy,
        domain=WHOLE,
        blur_um=waves.blur_um,
        reach_um=waves.reach_um,
        length_um=length,
        chief=(*sphere.chief[:2], sphere.distance * UM_PER_MM),
        waves_per_um=sphere.waves_per_um,
    )


def _beyond_plane(
    mx: FloatOrArray, my: FloatOrArray, length: FloatOrArray, x: FloatOrArray, y: FloatOrArray
) -> tuple[np.ndarray, np.ndarray]:
    """Return L′ − L and what it has beyond M·X, of wavelets at a distance L in the directions M, at places X, µm."""
    along, square = mx * x + my * y, x * x + y * y
    far = np.copysign(np.sqrt(length * length + 2 * length * along + square), length)
    more = (2 * length * along + square) / (far + length)
    return more, (square - along * more) / (far + length)


def beyond_plane_waves(lens: Lens, source: Source, sphere: ExitSphere) -> float:
    """Return the RMS phase, in waves, by which wavelets differ from the plane waves that agree at the chief ray.

    Over a coarse pencil and where its rays land, less the mean over the rays, which no picture shows.
    """
    xi, eta, weight = level_rays(levels_for(lens)[0])
    rays = pencil(lens, source, xi[: weight.size], eta[: weight.size]).arrived
    seen, length = sphere.seen_from(rays)
    field = np.ones(rays.dx.size, complex)
    waves = waves_from(Waves(field, seen.fx, seen.fy, WHOLE, 0.0), sphere, length)
    assert isinstance(waves, SphericalWaves)
    turn = np.angle(waves.factor(slice(None), rays.x_um, rays.y_um)) / (2 * pi)
    return float(np.sqrt(np.mean((turn - turn.mean(0)) ** 2)))
