"""The light of one point on square pixels, and its derivatives by every number of the pupil (handbook 11.1).

The field is E(x) = Σ w·exp(i2π(W + f·(x − s))) over pupil nodes, the light |E|² on the average over each pixel. With
b_k = ∂W/∂c_k, ∂|E|²/∂c_k = 2Re(E*·i2πΣ w·b_k·exp(…)): one more sum over the same waves per number. A shift s is the
term −f, a number m of the map the term x·∂f/∂m. The nodes lie in rows of equal fy, so that each sum is two products.
"""

from dataclasses import dataclass
from math import ceil, pi

import numpy as np

from p2sf.measure.pupil_model import PupilModel
from p2sf.psf.separable_sum import frequency_rows
from p2sf.pupil.quadrature import chord_rows, chords_for, gauss_legendre
from p2sf.raytrace.fit import FittedPencil, Level
from p2sf.raytrace.ray_field import Steepness

DTYPE = np.complex64  # errors of 1e-6 of the peak, where noise is hardly below 1e-3
NO_SLOPES = Steepness(0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Optics:
    """What is known of a picture's scale: numerical aperture in air or image space, wavelength in µm, pixel in µm.

    ``fill``: side of a pixel's sensitive square over the pitch; 0 takes the intensity at the pixel's centre.
    """

    na: float
    wavelength_um: float
    pixel_um: float
    fill: float = 1.0

    @property
    def cycles(self) -> float:
        """Return NA/λ, cycles per µm at the pupil's rim."""
        return self.na / self.wavelength_um

    @property
    def parts(self) -> int:
        """Return how many points across a pixel average the light, to 1e-3 of the peak."""
        return 1 if self.fill == 0 else max(3, ceil(4 * self.cycles * self.pixel_um * self.fill) + 1)

    @property
    def coarse_parts(self) -> int:
        """Return how many points across a pixel tell one minimum from another."""
        return min(self.parts, ceil(1.8 * self.cycles * self.pixel_um))


@dataclass(frozen=True, eq=False)
class PupilRows:
    """Nodes of the whole pupil in rows of equal fy: ``fy`` (rows,), the rest (rows, columns); weights of unit sum."""

    fy: np.ndarray
    fx: np.ndarray
    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray


def paraxial_rows(counts: tuple[int, int], cycles: float) -> PupilRows:
    """Return nodes (Gauss–Chebyshev × Gauss–Legendre) whose frequencies are NA/λ·(ξ, η)."""
    quarter = chord_rows(*counts)
    half = np.concatenate([quarter.xi, quarter.xi[::-1]])
    eta = np.concatenate([quarter.eta, -quarter.eta[::-1]])
    weight = np.concatenate([quarter.weight, quarter.weight[::-1]]) / 4
    xi = np.concatenate([-half[:, ::-1], half], axis=1)
    weight = np.concatenate([weight[:, ::-1], weight], axis=1)
    return PupilRows(cycles * eta, cycles * xi, xi, np.broadcast_to(eta[:, None], xi.shape), weight)


def mapped_rows(model: PupilModel, numbers: np.ndarray, counts: tuple[int, int], cycles: float) -> PupilRows | None:
    """Return nodes for the pupil map of these numbers, None where the map folds the pupil over."""
    _, across, along = model.split(numbers)
    level = Level(model.wave_order, model.map_order, 1, 2)
    fx, fy = cycles * across, cycles * np.append(0.0, along)
    found = FittedPencil(level, np.zeros(1), fx, fy, 0.0, NO_SLOPES, 0.0, 0)
    rows = frequency_rows(found, *counts)
    if rows is None:
        return None
    terms, _ = model.maps(rows.xi, rows.eta)
    right = np.tensordot(fx, terms, 1)
    return PupilRows(
        rows.fy,
        np.concatenate([-right[:, ::-1], right], axis=1),
        np.concatenate([-rows.xi[:, ::-1], rows.xi], axis=1),
        np.concatenate([rows.eta[:, ::-1], rows.eta], axis=1),
        np.concatenate([rows.weight[:, ::-1], rows.weight], axis=1) / 2,
    )


def counts_for(slope: float, cycles: float, half_um: float) -> tuple[int, int]:
    """Return (rows, columns) for a wavefront's steepest slope, waves per unit radius, over a window."""
    return chords_for(slope, slope, cycles * half_um)


def pixel_points(count: int, optics: Optics, parts: int) -> tuple[np.ndarray, np.ndarray]:
    """Return positions in µm, (count·parts,), that average over pixels about a centred axis, and the parts' weights."""
    node, weight = gauss_legendre(parts)
    centre = (np.arange(count) - count // 2)[:, None]
    place = (centre + node * (optics.fill / 2)) * optics.pixel_um
    return place.ravel(), weight / 2


def wave(cycles: np.ndarray) -> np.ndarray:
    """Return exp(i2π·cycles), its whole cycles subtracted in the precision given."""
    turn = ((2 * pi) * (cycles - np.rint(cycles))).astype(np.float32)
    out = np.empty(turn.shape, DTYPE)
    np.cos(turn, out=out.real)
    np.sin(turn, out=out.imag)
    return out


class PixelSum:
    """Sums over the rows of one pupil on one window of (y, x) pixels; the kernels are computed once."""

    def __init__(self, rows: PupilRows, shape: tuple[int, int], optics: Optics, parts: int | None = None):
        self.rows, self.shape, self.optics = rows, shape, optics
        (self.y, share), (self.x, _) = (pixel_points(count, optics, parts or optics.parts) for count in shape)
        self.share = share.astype(np.float32)
        self.up = wave(np.multiply.outer(self.y, rows.fy))
        self.across = wave(np.multiply.outer(rows.fx, self.x))
        # of all the light, a pixel's part: ∫|E|²dx = 1/(π·cycles²) for weights of unit sum (Parseval)
        self.scale = pi * (optics.cycles * optics.pixel_um) ** 2

    def fields(self, phase: np.ndarray, terms: np.ndarray) -> np.ndarray:
        """Return Σ w·exp(i2π·phase)·(1, terms…)·wave, (y points, 1 + terms, x points)."""
        amplitude = wave(phase) * self.rows.weight.astype(np.float32)
        every = np.empty((len(phase), 1 + len(terms), phase.shape[1]), DTYPE)
        every[:, 0] = amplitude
        np.multiply(amplitude[:, None], terms.transpose(1, 0, 2), out=every[:, 1:])
        along = every @ self.across
        field: np.ndarray = self.up @ along.reshape(len(along), -1)
        return field.reshape(self.y.size, len(terms) + 1, self.x.size)

    def many(self, pupils: np.ndarray) -> np.ndarray:
        """Return the light of many fields exp(i2π·phase), (pupils, rows, columns), as (pupils, y, x)."""
        along = (pupils * self.rows.weight.astype(np.float32)).transpose(1, 0, 2) @ self.across
        field = (self.up @ along.reshape(len(along), -1)).reshape(self.y.size, len(pupils), self.x.size)
        light: np.ndarray = self.scale * self.binned(field.real**2 + field.imag**2)
        return light

    def binned(self, light: np.ndarray) -> np.ndarray:
        """Return the mean over each pixel of (y points, planes, x points): (planes, y, x)."""
        parts, planes = self.share.size, light.shape[1]
        if parts == 1:
            return light.transpose(1, 0, 2)
        across = light.reshape(-1, parts) @ self.share
        up = across.reshape(self.shape[0], parts, planes * self.shape[1])
        mean: np.ndarray = np.einsum("ypk,p->yk", up, self.share)
        return mean.reshape(self.shape[0], planes, -1).transpose(1, 0, 2)

    def light(self, phase: np.ndarray) -> np.ndarray:
        """Return the share of all light on each pixel, (y, x)."""
        field = self.fields(phase, np.empty((0, *phase.shape), np.float32))
        light: np.ndarray = self.binned(field.real**2 + field.imag**2)[0].astype(float)
        return self.scale * light

    def light_and_slopes(
        self, phase: np.ndarray, terms: np.ndarray, maps: tuple[int, int] = (0, 0), place: tuple[float, float] = (0, 0)
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the light (y, x) and its derivatives (terms, y, x) by the factors of terms of the phase.

        ``maps``: how many of the last terms are of the map across, times x − x₀, and along, times y − y₀; ``place``
        is (x₀, y₀), µm.
        """
        field = self.fields(phase, terms)
        one, rest = field[:, :1], field[:, 1:]
        slopes = np.empty(field.shape, np.float32)
        slopes[:, :1] = one.real**2 + one.imag**2
        np.multiply(one.imag, rest.real, out=slopes[:, 1:])
        slopes[:, 1:] -= one.real * rest.imag
        slopes[:, 1:] *= 4 * pi
        (across, along), end = maps, field.shape[1]
        slopes[:, end - across - along : end - along] *= (self.x - place[0]).astype(np.float32)
        slopes[:, end - along :] *= (self.y - place[1]).astype(np.float32)[:, None, None]
        found = self.scale * self.binned(slopes).astype(float)
        return found[0], found[1:]
