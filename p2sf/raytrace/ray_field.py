"""Steepness of the phase of a pencil, which determines the sampling of its field (handbook 4.3)."""

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from p2sf.errors import GeometryError
from p2sf.messages import Message
from p2sf.raytrace.pencil import Rays

COARSE = 1.15  # margin for the maximum that some tens of rays may miss
SMALLEST = 1e-12
ONE_DIRECTION = 1e-12  # cycles per µm: rays whose frequencies differ by no more are parallel, to rounding
COLLIMATED = Message(
    "rays from all parts of the pupil arrive in one direction, along one axis at least, so that their light has no "
    "focus; move the object or refocus"
)
AIRY_RADIUS = 0.60983494563325  # first zero of J1 over 2π (Airy 1835), times λ/NA: over the largest frequency


@dataclass(frozen=True)
class Steepness:
    """The slopes that sampling must resolve, in waves; ``spread``: largest |f|, cycles per µm.

    ``radial``, ``angular``: steepest |∂w/∂ρ| and |∂w/∂θ|, for disc nodes. ``across``, ``along``: steepest |∂w/∂s| and
    |∂w/∂t| with η = cos t and ξ = sin s·sin t, for the columns and rows of `chord_rows`, as `steepest_chords` gives.
    ``stretch``: how much faster than ``spread`` f may change over disc nodes; 1 where f is proportional to (ξ, η).
    """

    radial: float
    angular: float
    across: float
    along: float
    spread: float
    stretch: float = 1.0

    @property
    def light_um(self) -> float:
        """Return the spread of a ray's light about its landing point, µm: Airy radius or blur/√(Fresnel number)."""
        blur = self.radial / self.spread
        return max(AIRY_RADIUS / self.spread, blur / sqrt(max(self.radial, 1.0)))


def steepness(rays: Rays, xi: np.ndarray, eta: np.ndarray) -> Steepness:
    """Return the steepness of the phase from the landing points: over f its gradient is −x, dw = −x·df (Hamilton).

    f is taken as proportional to (ξ, η), which needs no derivative; `with_map` corrects that. NaN rays are ignored.
    Raises GeometryError where all rays are parallel.
    """
    rho2 = xi * xi + eta * eta
    sine = np.sqrt(np.maximum(1 - eta * eta, SMALLEST))
    columns = (
        np.abs(rays.x_um * rays.fx + rays.y_um * rays.fy) / np.sqrt(rho2),
        np.abs(rays.x_um * rays.fy - rays.y_um * rays.fx),
        np.abs(rays.x_um) * np.sqrt(np.maximum(1 - rho2, 0)),
        np.abs(rays.x_um * (xi * eta / sine) - rays.y_um * sine),
        rays.fx * rays.fx + rays.fy * rays.fy,
    )
    radial, angular, across, along, square = (float(np.fmax.reduce(column)) for column in columns)
    spread = sqrt(square)
    if spread <= ONE_DIRECTION:
        raise GeometryError(COLLIMATED)
    return Steepness(radial, angular, COARSE * spread * across, COARSE * spread * along, spread)


@dataclass(frozen=True, eq=False)
class MapSlopes:
    """How f changes over the nodes of a disc, (2, points) each, cycles per µm: ∂f/∂ρ·√(1 − ρ²) and ∂f/∂θ.

    Gauss–Legendre nodes in ρ² are even in φ, ρ² = (1 + cos φ)/2, over which f changes by half of the first: near the
    rim they lie so close that even a steep phase is resolved.
    """

    radial: np.ndarray
    angular: np.ndarray

    @property
    def largest(self) -> float:
        """Return the largest change, cycles per µm."""
        return sqrt(max(float(np.square(part).sum(0).max()) for part in (self.radial, self.angular)))

    def steepest(self, x_um: np.ndarray, y_um: np.ndarray) -> tuple[float, float]:
        """Return the steepest slopes of the phase at these distances from where rays land, (…, points), in waves."""
        radial, angular = (float(np.abs(x_um * x + y_um * y).max()) for x, y in (self.radial, self.angular))
        return radial, angular


def map_slopes(xi: np.ndarray, eta: np.ndarray, across: np.ndarray, up: np.ndarray) -> MapSlopes:
    """Return the slopes of a map (fx, fy) from its derivatives by ξ and by η at points of the disc, (2, points)."""
    rho = np.hypot(xi, eta)
    cut = np.sqrt(np.maximum(1 - rho * rho, 0)) / np.maximum(rho, SMALLEST)
    return MapSlopes(cut * (xi * across + eta * up), eta * across - xi * up)


def with_map(steep: Steepness, slopes: MapSlopes, x_um: np.ndarray, y_um: np.ndarray) -> Steepness:
    """Return the steepness that rays landing at (x, y) have at least, by the slopes of their map there."""
    radial, angular = slopes.steepest(x_um, y_um)
    stretch = max(steep.stretch, slopes.largest / steep.spread)
    return replace(steep, radial=max(steep.radial, radial), angular=max(steep.angular, angular), stretch=stretch)
