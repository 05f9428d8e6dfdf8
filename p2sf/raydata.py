"""What a traced pencil says about the field at the sensor: phase, spatial frequency and landing point per ray."""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.raytrace import Pencil, diffraction_phase


@dataclass(frozen=True)
class RayData:
    """Per ray: phase (waves), f = n'(K − K chief)/λ (cycles/µm), landing point (µm)."""

    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    x_um: np.ndarray
    y_um: np.ndarray


@dataclass(frozen=True)
class Steepness:
    """What sampling must carry, in waves: steepest |∂w/∂ρ|, |∂w/∂θ|, |∂w/∂ξ|, |∂w/∂η|; ``spread``: largest |f|, /µm."""

    radial: float
    angular: float
    across: float
    along: float
    spread: float


def ray_data(rays: Pencil) -> RayData:
    """Return phase, spatial frequencies and landing points of a traced pencil."""
    scale = rays.index / rays.wavelength_um
    fx, fy = rays.kx * scale, (rays.ky - rays.chief_ky) * scale
    return RayData(diffraction_phase(rays), fx, fy, rays.dx * UM_PER_MM, rays.dy * UM_PER_MM)


def steepness(rays: RayData, xi, eta) -> Steepness:
    """Return how steep the phase is, from where the rays land: over f it has the gradient −x, dw = −x·df (Hamilton).

    With f nearly proportional to (ξ, η) that needs no derivative. NaN rays are left out.
    """
    radial = np.abs(rays.x_um * rays.fx + rays.y_um * rays.fy) / np.hypot(xi, eta)
    angular = np.abs(rays.x_um * rays.fy - rays.y_um * rays.fx)
    square = rays.fx * rays.fx + rays.fy * rays.fy
    columns = radial, angular, np.abs(rays.x_um), np.abs(rays.y_um), square
    radial, angular, across, along, square = (float(np.fmax.reduce(column)) for column in columns)
    spread = sqrt(square)
    return Steepness(radial, angular, spread * across, spread * along, spread)
