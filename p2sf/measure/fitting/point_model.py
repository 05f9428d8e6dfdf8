"""The light of one point on square pixels, and its derivatives by every number of the pupil (handbook 11.1).

The field is E(x) = Σ w·exp(i2π(W + f·(x − s))) over pupil nodes, the light |E|² on the average over each pixel. With
b_k = ∂W/∂c_k, ∂|E|²/∂c_k = 2Re(E*·i2πΣ w·b_k·exp(…)): one more sum over the same waves per number. A shift s is the
term −f, a number m of the map the term x·∂f/∂m. The sums go by a grid of frequencies (`scattered_sum`).
"""

from dataclasses import dataclass, replace
from math import ceil, inf, pi

import numpy as np

from p2sf.conventions import NM_PER_UM
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.quadrature import gauss_legendre
from p2sf.errors import RequestError
from p2sf.measure.fitting.pupil_model import rotate
from p2sf.measure.fitting.pupil_nodes import PupilNodes
from p2sf.measure.fitting.scattered_sum import ScatteredNodes

DTYPE = np.complex64  # errors of 1e-6 of the peak, where noise is hardly below 1e-3


@dataclass(frozen=True)
class PictureOptics:
    """What is known of a picture's scale: numerical aperture in air or image space, wavelength in µm, pixel in µm.

    ``fill``: side of a pixel's sensitive square over the pitch; 0 takes the intensity at the pixel's centre.
    ``mask``: what stands in the pupil, its ξ along +x and its η along +y of the sensor. ``light``: wavelengths in µm
    and how much of the light each brings, for light of several; waves are those of ``wavelength_um`` all the same.

    Raises RequestError for light that cannot be.
    """

    na: float
    wavelength_um: float
    pixel_um: float
    fill: float = 1.0
    mask: PupilMask = CLEAR
    light: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        for wavelength, share in self.light:
            if not (0 < wavelength < inf and 0 < share < inf):
                raise RequestError(
                    "a wavelength of {nm:g} nm that brings {share:g} of the light; give two positive numbers",
                    nm=wavelength * NM_PER_UM,
                    share=share,
                )

    @property
    def colours(self) -> tuple["PictureOptics", ...]:
        """Return the scale in every colour."""
        return tuple(replace(self, wavelength_um=wave, light=()) for wave, _ in self.light) or (self,)

    @property
    def shares(self) -> tuple[float, ...]:
        """Return the share of all light of every colour."""
        total = sum(share for _, share in self.light)
        return tuple(share / total for _, share in self.light) or (1.0,)

    @property
    def finest(self) -> "PictureOptics":
        """Return the scale in the colour of the shortest wavelength, which asks for most samples."""
        return min(self.colours, key=lambda colour: colour.wavelength_um)

    @property
    def cycles(self) -> float:
        """Return NA/λ, cycles per µm at the pupil's rim."""
        return self.na / self.wavelength_um

    @property
    def parts(self) -> int:
        """Return how many points across a pixel average the light, to 1e-3 of the peak."""
        return 1 if self.fill == 0 else max(3, ceil(4 * self.finest.cycles * self.pixel_um * self.fill) + 1)

    @property
    def coarse_parts(self) -> int:
        """Return how many points across a pixel tell one minimum from another."""
        return min(self.parts, ceil(1.8 * self.cycles * self.pixel_um))


def pixel_points(count: int, optics: PictureOptics, parts: int) -> tuple[np.ndarray, np.ndarray]:
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
    """Sums over the nodes of one pupil on one window of (y, x) pixels; the kernels are computed once."""

    def __init__(self, nodes: PupilNodes, shape: tuple[int, int], optics: PictureOptics, parts: int | None = None):
        self.nodes, self.shape, self.optics = nodes, shape, optics
        (self.y, share), (self.x, _) = (pixel_points(count, optics, parts or optics.parts) for count in shape)
        self.share = share.astype(np.float32)
        self.waves = ScatteredNodes(nodes.fx, nodes.fy, self.x, self.y)
        # Of all the light, a pixel's part: ∫|E|²dx = ⟨A²⟩/⟨A⟩²/(π·cycles²) for weights of unit sum (Parseval).
        self.scale = pi * (optics.cycles * optics.pixel_um) ** 2 / nodes.spreading

    def fields(self, phase: np.ndarray, terms: np.ndarray) -> np.ndarray:
        """Return Σ w·exp(i2π·phase)·(1, terms…)·wave, (y points, 1 + terms, x points); ``terms`` (terms, nodes)."""
        amplitude = wave(phase) * self.nodes.weight.astype(np.float32)
        return self.waves.transform(np.concatenate([amplitude[None], amplitude * terms]))

    def many(self, pupils: np.ndarray) -> np.ndarray:
        """Return the light of many fields exp(i2π·phase), (pupils, nodes), as (pupils, y, x)."""
        field = self.waves.transform(pupils * self.nodes.weight.astype(np.float32))
        light: np.ndarray = self.scale * self.mean_per_pixel(field.real**2 + field.imag**2)
        return light

    def mean_per_pixel(self, light: np.ndarray) -> np.ndarray:
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
        light: np.ndarray = self.mean_per_pixel(field.real**2 + field.imag**2)[0].astype(float)
        return self.scale * light

    def light_and_slopes(
        self,
        phase: np.ndarray,
        terms: np.ndarray,
        maps: tuple[int, int] = (0, 0),
        place: tuple[float, float] = (0, 0),
        azimuth: float = 0.0,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the light (y, x) and its derivatives (terms, y, x) by the factors of terms of the phase.

        ``maps``: how many of the last terms are of the map across the field, times how far from (x₀, y₀) light lands
        across it, and along it, times how far along; ``place`` is (x₀, y₀), µm, ``azimuth`` the field's, radians.
        """
        field = self.fields(phase, terms)
        one, rest = field[:, :1], field[:, 1:]
        slopes = np.empty(field.shape, np.float32)
        slopes[:, :1] = one.real**2 + one.imag**2
        np.multiply(one.imag, rest.real, out=slopes[:, 1:])
        slopes[:, 1:] -= one.real * rest.imag
        slopes[:, 1:] *= 4 * pi
        (across, along), end = maps, field.shape[1]
        if across or along:
            x, y = (self.x - place[0])[None, None], (self.y - place[1])[:, None, None]
            aside, out = rotate(x.astype(np.float32), y.astype(np.float32), azimuth)
            slopes[:, end - across - along : end - along] *= aside
            slopes[:, end - along :] *= out
        found = self.scale * self.mean_per_pixel(slopes).astype(float)
        return found[0], found[1:]


class SpectralSum:
    """`PixelSum` in every colour of the light: optical paths are the same in all, and so W in waves is not."""

    def __init__(self, nodes: PupilNodes, shape: tuple[int, int], optics: PictureOptics, parts: int | None = None):
        self.ratios = [optics.wavelength_um / colour.wavelength_um for colour in optics.colours]
        self.shares = optics.shares
        parts = parts or optics.parts
        self.sums = [
            PixelSum(replace(nodes, fx=ratio * nodes.fx, fy=ratio * nodes.fy), shape, colour, parts)
            for ratio, colour in zip(self.ratios, optics.colours, strict=True)
        ]

    def light_and_slopes(
        self,
        phase: np.ndarray,
        terms: np.ndarray,
        maps: tuple[int, int] = (0, 0),
        place: tuple[float, float] = (0, 0),
        azimuth: float = 0.0,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return what `PixelSum.light_and_slopes` does; ``phase`` in waves of the wavelength that the nodes are of."""
        light: np.ndarray | float = 0.0
        slopes: np.ndarray | float = 0.0
        for ratio, share, one in zip(self.ratios, self.shares, self.sums, strict=True):
            found, moved = one.light_and_slopes(ratio * phase, terms, maps, place, azimuth)
            light, slopes = light + share * found, slopes + share * ratio * moved
        return np.asarray(light), np.asarray(slopes)
