"""Steepness of the phase of a pencil, which determines the sampling of its field (handbook 4.3)."""

from dataclasses import dataclass
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
    """

    radial: float
    angular: float
    across: float
    along: float
    spread: float

    @property
    def light_um(self) -> float:
        """Return the spread of a ray's light about its landing point, µm: Airy radius or blur/√(Fresnel number)."""
        blur = self.radial / self.spread
        return max(AIRY_RADIUS / self.spread, blur / sqrt(max(self.radial, 1.0)))


def steepness(rays: Rays, xi: np.ndarray, eta: np.ndarray) -> Steepness:
    """Return the steepness of the phase from the landing points: over f its gradient is −x, dw = −x·df (Hamilton).

    f is nearly proportional to (ξ, η), so no derivative is needed. NaN rays are ignored. Raises GeometryError where all
    rays are parallel.
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
