"""The OTF of six coefficients by its plain integral over the overlap of two discs, Gauss nodes on each chord."""

import numpy as np
from numpy.polynomial.legendre import leggauss

from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import wavefront


def overlap(c: Coefficients, nu_x: float, nu_y: float) -> complex:
    """Return the OTF at a frequency over the cut-off, along x or along y (the other is 0)."""
    node, weight = leggauss(400)
    nu = np.hypot(nu_x, nu_y)
    across = np.sqrt(1 - nu**2) * np.sin(np.pi / 2 * node)  # perpendicular to the shift, its ends smoothed
    share = weight * np.pi / 2 * np.sqrt(1 - nu**2) * np.cos(np.pi / 2 * node)
    half = np.sqrt(1 - across**2) - nu
    along = half[:, None] * node
    side = across[:, None] + 0 * along
    xi, eta = (along, side) if nu_x else (side, along)
    phase = wavefront(c, xi + nu_x, eta + nu_y) - wavefront(c, xi - nu_x, eta - nu_y)
    return complex((share * half) @ (np.exp(2j * np.pi * np.asarray(phase)) @ weight) / np.pi)
