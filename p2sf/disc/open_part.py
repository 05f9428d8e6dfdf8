"""What is open of the pupil, by its edges: closed curves over the stop, and the lines between them (handbook 6.3)."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, pi

import numpy as np

from p2sf.disc.domain import ClearNodes, PupilDomain
from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import THINNEST, exit_distance, outline_radius
from p2sf.disc.quadrature import gauss_legendre
from p2sf.errors import GeometryError

CURVE = 1024  # points along an edge of the pupil: chords between them depart from it by 5e-6 of the radius
FEWEST_PER_PANEL = 8
CLOSE = 1e-8  # of the box: ends of edges no farther apart are one
BEYOND = 1e-3  # of the way to a rim: no edge is drawn farther outside, where nothing is known of the pupil

TURN = np.arange(2 * CURVE) * (pi / CURVE)
DISC = np.stack([np.sin(TURN), np.cos(TURN)])

Edges = list[tuple[np.ndarray, np.ndarray]]
"""Closed curves, ξ and η each."""


@dataclass(frozen=True, eq=False)
class StarCurve:
    """A closed curve over the stop, ``xi`` and ``eta`` (points,), all of which is seen from ``middle`` inside."""

    middle: tuple[float, float]
    xi: np.ndarray
    eta: np.ndarray

    @cached_property
    def _polar(self) -> tuple[np.ndarray, np.ndarray]:
        return self._polar_about_middle(self.xi, self.eta)

    def _polar_about_middle(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        across, up = xi - self.middle[0], eta - self.middle[1]
        return np.arctan2(across, up), np.hypot(across, up)

    def excess(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return how far beyond the curve points of any shape lie, over its distance from the middle there."""
        angle, distance = self._polar_about_middle(xi, eta)
        excess: np.ndarray = distance / np.interp(angle, *self._polar, period=2 * pi) - 1
        return excess

    def hold(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return another closed curve whose parts far outside are drawn to just outside this one: the same inside."""
        excess = self.excess(xi, eta) - BEYOND
        following = np.roll(excess, -1)
        left = np.flatnonzero((excess > 0) != (following > 0))
        part = excess[left] / (excess[left] - following[left])
        xi, eta = (np.insert(v, left + 1, v[left] + part * (np.roll(v, -1) - v)[left]) for v in (xi, eta))
        nearer = np.minimum(1.0, (1 + BEYOND) / (1 + np.maximum(self.excess(xi, eta), 0.0)))
        return tuple(place + nearer * (v - place) for v, place in zip((xi, eta), self.middle, strict=True))


@dataclass(frozen=True, eq=False)
class PupilEdges:
    """What lens and stop leave open: all inside the ``rim`` of the clear part, the disc's where None, but ``shadows``.

    ``shadows``: of holes of mirrors and the like, within the clear part.
    """

    rim: StarCurve | None = None
    shadows: tuple[StarCurve, ...] = ()

    def behind(self, mask: PupilMask) -> tuple[Edges, Edges]:
        """Return the edges whose insides are open, behind a mask and without the rim, and those with dark insides."""
        light, dark = edges_of(mask)
        if self.rim is not None:
            light, dark = ([self.rim.hold(*edge) for edge in some] for some in (light, dark))
        return light, [*dark, *((shadow.xi, shadow.eta) for shadow in self.shadows)]

    def opens(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return which points within the clear part lie in no shadow, bool."""
        open_ = np.ones(np.shape(xi), bool)
        for shadow in self.shadows:
            open_ &= shadow.excess(xi, eta) >= 0
        return open_

    def nodes(self, mask: PupilMask, lines: int, samples: int, domain: PupilDomain) -> ClearNodes:
        """Return nodes of positive weights over what a mask and these edges leave open of a domain.

        Some ``lines`` along η between the ends and corners of all edges, of ``samples`` to a diameter. Raises
        GeometryError where nothing is open.
        """
        light, dark = ([np.stack(edge) for edge in some] for some in self.behind(mask))
        light = [DISC if self.rim is None else np.stack([self.rim.xi, self.rim.eta]), *light]
        places, widths = domain.of_lines(*places_between([*light, *dark], lines))
        parts = []
        for low, high in zip(*open_intervals(light, dark, places), strict=True):
            node, weight = gauss_legendre(max(FEWEST_PER_PANEL, ceil(samples * float((high - low).max()) / 2)))
            half = (high - low)[:, None] / 2
            eta, area = (low + high)[:, None] / 2 + half * node, widths[:, None] * half * weight
            kept = area > 0
            parts.append((np.broadcast_to(places[:, None], eta.shape)[kept], eta[kept], area[kept] / pi))
        xi, eta, area = (np.concatenate(column) for column in zip(*parts, strict=True))
        share = float(area.sum())
        if not share > THINNEST:
            raise GeometryError(
                "rims and the mask in the stop leave nothing open; leave {parameter} off", parameter="clip"
            )
        return ClearNodes(xi, eta, area / share, share, domain=domain)


WHOLE_DISC = PupilEdges()


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
    end = exit_distance(mask, aside * cosine, -aside * sine, sine * one, cosine * one)
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
