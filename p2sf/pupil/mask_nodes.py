"""Nodes over what a mask leaves open: a signed sum of pieces on each of which the pupil function is smooth.

The field is linear in the pupil. A round stop with an obscuration is integrated by Gauss–Legendre in ρ² from ε² to 1;
an iris by sectors between the directions of its corners, up to the outline; a vane is a strip with negative weights,
integrated along and across itself. So no edge falls between nodes, and the sums converge as those of the disc.
Amplitude and phase are factors at the nodes (handbook 4.6).
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import ceil, cos, inf, pi, sin, tan

import numpy as np

from p2sf.conventions import FloatOrArray, write_protect
from p2sf.errors import GeometryError
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.quadrature import MOST_KEPT, gauss_legendre

GAUSS_EXCESS = 1.5  # Gauss–Legendre nodes per uniform direction for the same harmonics: some π/2
EDGE_NODES = 5  # more in each sector, for an outline that is smooth but no circle
FEWEST_ACROSS = 4  # nodes across a vane, or across a part of it between corners
UPRIGHT = 1e-9  # sine of the angle of a vane along η
THINNEST = 1e-12  # share of the disc that is nothing


@dataclass(frozen=True)
class ClearNodes:
    """Nodes (ξ, η), each (nodes,), over the open part of the pupil, with weights of unit sum, some of them negative.

    ``share``: the open share of the pupil's area. ``amplitude`` and ``path_um``: what the mask does at the nodes,
    numbers where it does nothing. ``even``: whether these are the nodes of the half disc ξ ≥ 0, whose weights count
    the mirror half too; nodes over the whole disc otherwise.
    """

    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    share: float
    amplitude: FloatOrArray = 1.0
    path_um: FloatOrArray = 0.0
    even: bool = True

    @property
    def axes(self) -> np.ndarray:
        """Return the coordinates that a tilt is linear in, (1 or 2, nodes): over the half disc η alone."""
        return self.eta[None] if self.even else np.stack([self.eta, self.xi])

    def part(self, some: slice | np.ndarray) -> "ClearNodes":
        """Return only these nodes; their weights no longer sum to 1."""
        amplitude, path = (x[some] if isinstance(x, np.ndarray) else x for x in (self.amplitude, self.path_um))
        return ClearNodes(self.xi[some], self.eta[some], self.weight[some], self.share, amplitude, path, self.even)

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
        if not self.even:
            return self
        amplitude, path = (np.tile(x, 2) if isinstance(x, np.ndarray) else x for x in (self.amplitude, self.path_um))
        xi, weight = np.append(self.xi, -self.xi), np.tile(self.weight, 2) / 2
        return ClearNodes(xi, np.tile(self.eta, 2), weight, self.share, amplitude, path, False)


Piece = tuple[np.ndarray, np.ndarray, np.ndarray]
"""ξ, η and signed shares of the disc's area."""


def mask_nodes(mask: PupilMask, radial: int, angular: int) -> ClearNodes:
    """Return nodes over what the mask leaves open, as dense as ``radial`` × ``angular`` are over the whole disc.

    Of a mask that is even in ξ those of half the disc. Raises GeometryError where it leaves nothing open.
    """
    return (_kept_nodes if radial * angular <= MOST_KEPT else _kept_nodes.__wrapped__)(mask, radial, angular)


@lru_cache(maxsize=16)
def _kept_nodes(mask: PupilMask, radial: int, angular: int) -> ClearNodes:
    pieces = [_sectors(mask, radial, angular) if mask.iris else _rings(mask, radial, angular)]
    if not mask.disc.centred:
        pieces.append(_dark_disc(mask, radial, angular))
    for angle in mask.vane_angles:
        pieces += _vane(mask, angle, radial)
    if mask.even:
        pieces = [(xi, eta, 2 * area) for xi, eta, area in pieces if xi.mean() > 0]
    xi, eta, area = (np.concatenate(column) for column in zip(*pieces, strict=True))
    return shaded_nodes(mask, xi, eta, area, mask.even)


def shaded_nodes(mask: PupilMask, xi: np.ndarray, eta: np.ndarray, area: np.ndarray, even: bool) -> ClearNodes:
    """Return nodes with signed shares of the disc's area, and with the mask's amplitude and path."""
    kept = area != 0
    xi, eta, area = xi[kept], eta[kept], area[kept]
    share = float(area.sum())
    if not share > THINNEST:
        raise GeometryError("the mask in the stop leaves nothing open; make its obscuration or its vanes smaller")
    amplitude = write_protect(mask.amplitude(xi, eta)) if mask.shaded else 1.0
    path = write_protect(mask.path_um(xi, eta)) if mask.phased else 0.0
    return ClearNodes(write_protect(xi), write_protect(eta), write_protect(area / share), share, amplitude, path, even)


def ring_count(radial: int, width: float) -> int:
    """Return how many radii of ``radial`` over the whole radius a part of it takes."""
    return ceil((radial - 4) * width) + 4 if radial > 4 else radial


def _rings(mask: PupilMask, radial: int, angular: int) -> Piece:
    """Return nodes from an obscuration in the middle to the rim in uniform directions, of an even mask over half."""
    angular += angular % 2
    count = angular // 2 if mask.even else angular
    theta = (np.arange(count) + 0.5) * (2 * pi / angular)
    return _polar(theta, np.full(count, 2 * pi / angular), np.full(count, _inner_radius(mask)), np.ones(count), radial)


def _sectors(mask: PupilMask, radial: int, angular: int) -> Piece:
    """Return nodes from an obscuration in the middle to the blades, in directions between corners."""
    angles = [*mask.corner_angles]
    if mask.disc.centred:
        angles += [angle for edge in mask.edges for angle in edge.crossings(mask.disc)]
    theta, step = _directions(angles, mask.even, angular)
    outer = outline_radius(mask, theta)
    return _polar(theta, step, np.minimum(_inner_radius(mask), outer), outer, radial)


def _inner_radius(mask: PupilMask) -> float:
    return mask.obscuration if mask.disc.centred else 0.0


def _dark_disc(mask: PupilMask, radial: int, angular: int) -> Piece:
    """Return what an obscuration beside the middle covers within the iris, with negative areas."""
    disc = mask.disc
    middle = np.full(1, disc.xi), np.full(1, disc.eta)
    if not all(edge.lies_inside(*middle)[0] for edge in mask.edges):
        raise GeometryError("the middle of the obscuration lies behind a blade of the iris; move it or open the iris")
    angles = [angle for edge in mask.edges for angle in edge.crossings(disc)]
    theta, step = _directions(angles or [0.0], mask.even, angular)
    one, sine, cosine = np.ones_like(theta), np.sin(theta), np.cos(theta)
    outer = np.minimum(disc.radius, exit_distance(mask, disc.xi * one, disc.eta * one, sine, cosine))
    xi, eta, area = _polar(theta, step, 0 * one, outer, radial)
    return disc.xi + xi, disc.eta + eta, -area


def _directions(angles: list[float], even: bool, angular: int) -> tuple[np.ndarray, np.ndarray]:
    """Return directions between those of corners, Gauss–Legendre nodes, and the angles that they stand for."""
    thetas, steps = [], []
    for low, high in pairwise(_breaks(angles, even).tolist()):
        count = ceil(GAUSS_EXCESS * angular * (high - low) / (2 * pi)) + EDGE_NODES
        node, weight = gauss_legendre(count)
        thetas.append((low + high + (high - low) * node) / 2)
        steps.append((high - low) / 2 * weight)
    return np.concatenate(thetas), np.concatenate(steps)


def _breaks(angles: list[float], even: bool) -> np.ndarray:
    """Return directions over one turn, of an even mask over the half ξ > 0, ascending and with both ends."""
    turned = np.unique(np.round(np.mod(angles, 2 * pi), 12))
    if even:
        inside = turned[(turned > 1e-9) & (turned < pi - 1e-9)]
        return np.concatenate([[0.0], inside, [pi]])
    return np.append(turned, turned[0] + 2 * pi)


def outline_radius(mask: PupilMask, theta: np.ndarray) -> np.ndarray:
    """Return the radius up to which the rim, or the iris, is open in directions from +η towards +ξ."""
    return exit_distance(mask, np.zeros_like(theta), np.zeros_like(theta), np.sin(theta), np.cos(theta))


def exit_distance(mask: PupilMask, xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """Return how far inner points lie from the rim, or the iris, along the directions (sine, cosine)."""
    if mask.iris:
        nearest: np.ndarray = np.min([edge.distance(xi, eta, sine, cosine) for edge in mask.edges], axis=0)
        return nearest
    return circle_exit(1.0, xi, eta, sine, cosine)


def circle_exit(radius: float, xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """Return how far points inside a circle about the centre lie from it along the directions."""
    along = xi * sine + eta * cosine
    distance: np.ndarray = np.sqrt(np.maximum(along**2 + radius**2 - xi * xi - eta * eta, 0)) - along
    return distance


def _polar(theta: np.ndarray, step: np.ndarray, inner: np.ndarray, outer: np.ndarray, radial: int) -> Piece:
    """Return Gauss–Legendre nodes in ρ² between radii along directions that stand for angles ``step``."""
    node, weight = gauss_legendre(ring_count(radial, float((outer - inner).max())))
    low, high = inner**2, outer**2
    rho = np.sqrt((low + high + (high - low) * node[:, None]) / 2)
    area = weight[:, None] * (high - low) / 4 * step / pi  # ∫ρ dρ dθ = ½∫d(ρ²) dθ over the disc's area π
    return (rho * np.sin(theta)).ravel(), (rho * np.cos(theta)).ravel(), area.ravel()


def _vane(mask: PupilMask, angle: float, radial: int) -> list[Piece]:
    """Return the pieces of one vane, with negative areas, outside the obscuration and the other vanes."""
    return [piece for ends in zip(*_across(mask, angle), strict=True) for piece in _strips(mask, angle, *ends, radial)]


def _across(mask: PupilMask, angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the ends of the intervals across a vane between which both its ends are smooth."""
    half, disc = mask.vane_width, mask.disc
    meeting = _inner_radius(mask) * (sin(pi / mask.vanes) if mask.vanes > 2 else 1.0)
    corners = [sin(corner - angle) for corner in mask.corner_angles if cos(corner - angle) > 0]
    # A vane that meets its neighbours outside the obscuration starts with a corner in its middle; one on the line of
    # symmetry is halved by it.
    middle = [0.0] if half > meeting or (mask.even and abs(sin(angle)) < UPRIGHT) else []
    beside = [] if disc.centred else corners_of_disc(mask, angle)
    breaks = [x for x in (*middle, meeting, -meeting, *corners, *beside) if abs(x) < half]
    ends = np.unique(np.round([-half, *breaks, half], 14))
    return ends[:-1], ends[1:]


def corners_of_disc(mask: PupilMask, angle: float) -> list[float]:
    """Return how far aside of a vane's line an obscuration ends, and meets the blades and where the vane starts."""
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


def _strips(mask: PupilMask, angle: float, low: float, high: float, radial: int) -> list[Piece]:
    """Return the nodes of one interval across a vane: behind the obscuration, and before one beside the middle."""
    sine, cosine = sin(angle), cos(angle)
    node, weight = gauss_legendre(FEWEST_ACROSS + ceil(radial * (high - low) / 2))
    aside = (low + high + (high - low) * node) / 2
    foot_xi, foot_eta = aside * cosine, -aside * sine
    start = np.abs(aside) / tan(pi / mask.vanes) if mask.vanes > 2 else np.zeros_like(aside)
    one = np.ones_like(aside)
    end = np.maximum(exit_distance(mask, foot_xi, foot_eta, sine * one, cosine * one), start)
    near, far = (np.clip(part, start, end) for part in mask.disc.chord(foot_xi, foot_eta, sine, cosine))
    count, across = ring_count(radial, 1 - _inner_radius(mask)), weight * (high - low) / 2
    ends = ((start, near), (far, end))
    return [strip((foot_xi, foot_eta), (sine, cosine), two, across, count) for two in ends if (two[1] > two[0]).any()]


def strip(
    foot: tuple[np.ndarray, np.ndarray],
    direction: tuple[float, float],
    ends: tuple[np.ndarray, np.ndarray],
    across: np.ndarray,
    count: int,
) -> Piece:
    """Return ``count`` nodes along each of the lines from ``foot`` between ``ends``, with negative areas.

    ``across``: the width that each line stands for, all in radii of the rim.
    """
    (sine, cosine), (first, last) = direction, ends
    place, share = gauss_legendre(count)
    along = (first + last + (last - first) * place[:, None]) / 2
    area = -share[:, None] * (last - first) / 2 * across / pi
    return (foot[0] + along * sine).ravel(), (foot[1] + along * cosine).ravel(), area.ravel()


@dataclass(frozen=True)
class Throughput:
    """Means over the disc: of the amplitude, and of its square, the light that passes."""

    amplitude: float
    light: float

    @property
    def spreading(self) -> float:
        """Return how much more a field of unit peak spreads than that of the clear disc: mean A² over (mean A)²."""
        return self.light / self.amplitude**2 if self.amplitude else inf


@lru_cache(maxsize=64)
def throughput(mask: PupilMask) -> Throughput:
    """Return how much a mask lets through."""
    nodes = mask_nodes(mask, 24, 48)
    amplitude = nodes.amplitude + 0 * nodes.xi
    return Throughput(nodes.share * float(nodes.weight @ amplitude), nodes.share * float(nodes.weight @ amplitude**2))
