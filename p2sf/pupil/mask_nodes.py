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

from p2sf.conventions import FloatOrArray, protected
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
    amplitude = protected(mask.amplitude(xi, eta)) if mask.shaded else 1.0
    path = protected(mask.path_um(xi, eta)) if mask.phased else 0.0
    return ClearNodes(protected(xi), protected(eta), protected(area / share), share, amplitude, path, even)


def ring_count(radial: int, width: float) -> int:
    """Return how many radii of ``radial`` over the whole radius a part of it takes."""
    return ceil((radial - 4) * width) + 4 if radial > 4 else radial


def _rings(mask: PupilMask, radial: int, angular: int) -> Piece:
    """Return nodes from the obscuration to the rim in uniform directions, of an even mask over half the disc."""
    angular += angular % 2
    count = angular // 2 if mask.even else angular
    theta = (np.arange(count) + 0.5) * (2 * pi / angular)
    return _polar(theta, np.full(count, 2 * pi / angular), np.full(count, mask.obscuration), np.ones(count), radial)


def _sectors(mask: PupilMask, radial: int, angular: int) -> Piece:
    """Return nodes from the obscuration to the blades, in directions between corners and wherever those two meet."""
    theta, step = _directions(mask, angular)
    outer = outline_radius(mask, theta)
    return _polar(theta, step, np.minimum(mask.obscuration, outer), outer, radial)


def _directions(mask: PupilMask, angular: int) -> tuple[np.ndarray, np.ndarray]:
    """Return directions between those of corners, Gauss–Legendre nodes, and the angles that they stand for."""
    thetas, steps = [], []
    for low, high in pairwise(_breaks(mask).tolist()):
        count = ceil(GAUSS_EXCESS * angular * (high - low) / (2 * pi)) + EDGE_NODES
        node, weight = gauss_legendre(count)
        thetas.append((low + high + (high - low) * node) / 2)
        steps.append((high - low) / 2 * weight)
    return np.concatenate(thetas), np.concatenate(steps)


def _breaks(mask: PupilMask) -> np.ndarray:
    """Return the directions over one turn, of an even mask over the half ξ > 0, where the open radii have a corner."""
    angles = list(mask.corner_angles)
    for edge in mask.edges:
        crossing = edge.crossing(mask.obscuration)
        if crossing is not None:
            angles += [edge.angle - crossing, edge.angle + crossing]
    turned = np.unique(np.round(np.mod(angles, 2 * pi), 12))
    if mask.even:
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
    """Return the pieces of one vane, with negative areas, from where it leaves the obscuration and the other vanes."""
    return [_strip(mask, angle, *ends, radial) for ends in zip(*_across(mask, angle), strict=True)]


def _across(mask: PupilMask, angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the ends of the intervals across a vane between which both its ends are smooth."""
    half = mask.vane_width
    meeting = mask.obscuration * (sin(pi / mask.vanes) if mask.vanes > 2 else 1.0)
    corners = [sin(corner - angle) for corner in mask.corner_angles if cos(corner - angle) > 0]
    # A vane that meets its neighbours outside the obscuration starts with a corner in its middle; one on the line of
    # symmetry is halved by it.
    middle = [0.0] if half > meeting or (mask.even and abs(sin(angle)) < UPRIGHT) else []
    breaks = [x for x in (*middle, meeting, -meeting, *corners) if abs(x) < half]
    ends = np.unique(np.round([-half, *breaks, half], 14))
    return ends[:-1], ends[1:]


def _strip(mask: PupilMask, angle: float, low: float, high: float, radial: int) -> Piece:
    """Return the nodes of one interval across a vane."""
    sine, cosine = sin(angle), cos(angle)
    node, weight = gauss_legendre(FEWEST_ACROSS + ceil(radial * (high - low) / 2))
    place, share = gauss_legendre(ring_count(radial, 1 - mask.obscuration))
    aside = (low + high + (high - low) * node) / 2
    foot_xi, foot_eta = aside * cosine, -aside * sine
    meeting = np.abs(aside) / tan(pi / mask.vanes) if mask.vanes > 2 else np.zeros_like(aside)
    start = np.maximum(np.sqrt(np.maximum(mask.obscuration**2 - aside**2, 0)), meeting)
    one = np.ones_like(aside)
    end = np.maximum(exit_distance(mask, foot_xi, foot_eta, sine * one, cosine * one), start)
    along = (start + end + (end - start) * place[:, None]) / 2
    area = -share[:, None] * (end - start) / 2 * weight * (high - low) / 2 / pi
    return (foot_xi + along * sine).ravel(), (foot_eta + along * cosine).ravel(), area.ravel()


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
