"""A pupil as plane waves at the sensor, one per node: their sum is the field, its squared modulus the PSF."""

from dataclasses import dataclass
from functools import cached_property
from math import ceil, inf, sqrt

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from p2sf.disc.domain import PupilDomain
from p2sf.disc.phasors import cosine_sine
from p2sf.disc.quadrature import nodes_for
from p2sf.disc.transform import newton_step, sum_plane_waves
from p2sf.messages import Message
from p2sf.raytrace.ray_field import Steepness

Counts = tuple[int, int]
"""Radial and angular node counts of the whole disc."""
ODD = np.array([0, 1, 0, 0, 1, 0])  # whether a moment changes its sign where fx does
BLOCK = 2**18  # nodes summed at once, 40 MB: of millions, as of a wide blur, all at once take a gigabyte
RADIAL_STEP, ANGULAR_STEP = 4, 16  # of node counts, so that cached nodes serve the next picture too


def pupil_amplitude(weight: np.ndarray, phase_waves: ArrayLike, dtype: DTypeLike = np.float64) -> np.ndarray:
    """Return weight·exp(2πi·phase), complex; whole waves are subtracted first, so that float32 stays accurate."""
    cosine, sine = cosine_sine(np.array(phase_waves, dtype=float), dtype)
    amplitude = np.empty(cosine.shape, np.result_type(dtype, np.complex64))
    weight = weight.astype(dtype, copy=False)
    np.multiply(cosine, weight, out=amplitude.real)
    np.multiply(sine, weight, out=amplitude.imag)
    return amplitude


def window_reach_um(pixels: int, pixel_um: float) -> float:
    """Return the distance of the corner of a window from the chief ray, µm."""
    return pixel_um * (pixels // 2) * sqrt(2)


def counts_for(steepness: Steepness, reach_um: float, share: float = 1.0) -> Counts:
    """Return (radial, angular) node counts that resolve this phase up to a distance from the chief ray, µm.

    ``share``: of the counts of `nodes_for`.
    """
    reach = steepness.spread * steepness.stretch * reach_um
    radial, angular = (share * count for count in nodes_for(steepness.radial, reach, steepness.angular))
    return RADIAL_STEP * ceil(radial / RADIAL_STEP), ANGULAR_STEP * ceil(angular / ANGULAR_STEP)


def disc_words(counts: Counts) -> Message:
    """Return (radial, angular) node counts in words."""
    return Message("{radii} radii × {directions} directions", radii=counts[0], directions=counts[1])


def _products(moments: np.ndarray, waves: np.ndarray) -> np.ndarray:
    """Return real arrays times complex waves, by products of real arrays."""
    products: np.ndarray = moments @ waves.real + 1j * (moments @ waves.imag)
    return products


@dataclass(frozen=True, eq=False)
class Waves:
    """Plane waves whose sum is the field, 1 at most: complex amplitudes (…, nodes), frequencies in cycles per µm.

    ``domain``: HALF where the nodes are one half of a set that is even in fx, and amplitudes include the other half.
    ``blur_um``: largest distance of rays from the chief ray. ``reach_um``: distance from it up to which the nodes
    resolve the phase.
    """

    amplitude: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    domain: PupilDomain
    blur_um: float
    reach_um: float = inf

    @cached_property
    def spread(self) -> float:
        """Return the largest |f|, cycles per µm."""
        return float(np.sqrt((self.fx * self.fx + self.fy * self.fy).max(initial=0.0)))

    @property
    def plane(self) -> "Waves":
        """Return the plane waves that agree with these at the chief ray: these themselves."""
        return self

    def within(self, seconds: float) -> "Waves":
        """Return waves whose sum takes these estimated seconds at most, and may be rough: these themselves."""
        return self

    def field(self, x: np.ndarray, y: np.ndarray, dtype: DTypeLike = np.float64) -> np.ndarray:
        """Return the field over a grid of x and y, µm, complex, (…, y, x)."""
        amplitude = self.amplitude.astype(np.result_type(dtype, np.complex64), copy=False)
        fx, fy = (f.astype(dtype, copy=False) for f in (self.fx, self.fy))
        return sum_plane_waves(amplitude, fx, fy, x, y, self.domain.symmetric)

    def intensity(self, x: np.ndarray, y: np.ndarray, dtype: DTypeLike = np.float64) -> np.ndarray:
        """Return the intensity over a grid of x and y, µm, (…, y, x)."""
        field = self.field(x, y, dtype)
        intensity: np.ndarray = field.real**2 + field.imag**2
        return intensity

    def _moments_at(self, x: float, y: float, nodes: slice) -> np.ndarray:
        """Return the sums over nodes of their waves at a point times 1, fx, fy, fx², fx·fy and fy², complex, (6,)."""
        fx, fy = self.fx[nodes], self.fy[nodes]
        moments = np.stack([np.ones_like(fx), fx, fy, fx * fx, fx * fy, fy * fy])
        cosine, sine = cosine_sine(fy * y, np.float64)
        along = self.amplitude[nodes] * (cosine + 1j * sine)
        even, odd = (_products(moments, along * part) for part in cosine_sine(fx * x, np.float64))
        sums: np.ndarray = np.where(ODD, 1j * odd, even) if self.domain.symmetric else even + 1j * odd
        return sums

    def near(self, x: float, y: float) -> tuple[float, float, float, float]:
        """Return the intensity at a point, Newton's step from there in x and y, and its expected gain.

        Where the intensity is not concave, the step is along the gradient.
        """
        blocks = (slice(first, first + BLOCK) for first in range(0, max(1, len(self.fx)), BLOCK))
        sums = [self._moments_at(x, y, nodes) for nodes in blocks]
        value, (step_x, step_y), gain = newton_step(np.sum(sums, axis=0))
        return float(value), float(step_x), float(step_y), float(gain)
