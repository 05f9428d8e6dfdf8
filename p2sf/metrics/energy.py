"""Encircled energy from the pupil, of all light and without a window (handbook 6.3).

With OTF the transfer function in two dimensions about a point, the light within a radius R of that point is

    E(R) = ∫∫ OTF(ν)·R·J₁(2πRν)/ν d²ν,

Parseval's theorem with the transform of a disc (Goodman 2005, eq. 2-35). The transfer function is the autocorrelation
of the pupil on an even grid, by FFT, gathered in rings of equal |ν|.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import pi

import numpy as np
from scipy import fft
from scipy.special import j1

from p2sf.conventions import protected
from p2sf.errors import SamplingError
from p2sf.metrics.frequency_pupil import FrequencyPupil, landing_um, reach_of, uniform_disc
from p2sf.metrics.mask_lines import masked_cells
from p2sf.metrics.perfect import circle_energy
from p2sf.pupil.phasors import cosine_sine
from p2sf.pupil.quadrature import even_count

FEWEST, PER_WAVE = 192, 4.5  # samples across the pupil: two blurs side by side fit into the period of the PSF
MOST_ACROSS = 3072  # 300 MB; beyond, at some 650 waves of slope, the landing points of rays are as exact
STRIPS = 8  # of a cell, over which the part inside the edge is averaged
RINGS = 8  # per step of frequency
RADII = 128  # of a tabulated curve
BEYOND = 12.0  # λ/2NA beyond the outermost ray up to which a curve is tabulated
HALF_PERIOD = 0.5  # of the PSF, which repeats
GEOMETRIC = 400  # rows and columns of landing points
JUDGED = 180.0  # waves of slope, to which a pupil is scaled where both roads are compared
COMPARED = 64  # radii


@dataclass(frozen=True, eq=False)
class RingSums:
    """The transfer function of one pupil about a point, summed over rings: Σ E = ``sums``·(transform of a disc).

    ``radius``: mean |ν| of each ring in steps of the grid, (rings,); ``step``: cycles per µm; ``across``: samples.
    """

    radius: np.ndarray
    sums: np.ndarray
    step: float
    across: int

    def within(self, radius_um: np.ndarray) -> np.ndarray:
        """Return the share of all light within each radius, (n,).

        The sum is periodic. Beyond HALF_PERIOD there are only the wings of a hard edge, with light outside R that falls
        as 1/R (Lommel 1885).
        """
        scaled = radius_um * self.step
        inside = np.minimum(scaled, HALF_PERIOD)
        found: np.ndarray = _disc_transform(inside, self.radius) @ self.sums + _missing(self.across, inside)
        outside = (1 - found) * (HALF_PERIOD / np.maximum(scaled, HALF_PERIOD))
        return np.clip(1 - outside, 0.0, 1.0)

    def tabulated(self) -> tuple[np.ndarray, np.ndarray]:
        """Return RADII + 1 even radii from 0 to beyond the blur, µm, and the share within each, from a kept matrix."""
        scaled, matrix = _kept_transform(self.across)
        found = matrix @ self.sums + _missing(self.across, scaled)
        # Energy rises, to 1 at most: held to that, the sum can only come closer to it.
        return scaled / self.step, np.clip(np.maximum.accumulate(found), 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class LandingPoints:
    """Where rays land about a point, ascending in µm, and the light up to each: energy where diffraction is nothing.

    ``departure``: how far it lies at most from a sum of waves, as measured on the same pupil with a JUDGED slope.
    """

    radius_um: np.ndarray
    light: np.ndarray
    departure: float = float("nan")

    def within(self, radius_um: np.ndarray) -> np.ndarray:
        """Return the share of all light within each radius, (n,)."""
        within: np.ndarray = np.interp(radius_um, self.radius_um, self.light)
        return within

    def tabulated(self) -> tuple[np.ndarray, np.ndarray]:
        """Return RADII + 1 even radii from 0 to the outermost ray, µm, and the share within each."""
        radius = np.linspace(0, float(self.radius_um[-1]), RADII + 1)
        return radius, self.within(radius)


def energy_of(
    pupil: FrequencyPupil, centre_um: float | None = None, aside_um: float | None = None
) -> "RingSums | LandingPoints":
    """Return the energy of a pupil about (``aside_um``, ``centre_um``), its centroid if not given."""
    centre = pupil.centroid_um if centre_um is None else centre_um
    aside = pupil.centroid_x_um if aside_um is None else aside_um
    across = samples_across(pupil, centre, aside)
    if across <= MOST_ACROSS:
        return ring_sums(pupil, centre, across, aside)
    if not pupil.mask.clear:
        raise SamplingError(
            "a blur that takes {across} pupil samples a side behind a mask; bring the sensor nearer to the image or "
            "stop down",
            across=across,
        )
    return replace(landing_points(pupil, centre, aside), departure=departure_of_rays(pupil, centre, aside))


def departure_of_rays(pupil: FrequencyPupil, centre_um: float, aside_um: float = 0.0) -> float:
    """Return the largest difference between energy by waves and by landing points, of a pupil with a JUDGED slope.

    With the phase all distances scale, but diffraction does not: in the pupil itself it matters less than there.
    """
    reach = reach_of(pupil)
    scale = JUDGED / max(reach.x, reach.y)
    centroid = scale * pupil.centroid_um, scale * pupil.centroid_x_um
    smaller = replace(pupil, phase=scale * pupil.phase, centroid_um=centroid[0], centroid_x_um=centroid[1])
    centre, aside = scale * centre_um, scale * aside_um
    waves = ring_sums(smaller, centre, samples_across(smaller, centre, aside), aside)
    rays = landing_points(smaller, centre, aside)
    radius = np.linspace(0, float(rays.radius_um[-1]), COMPARED)
    return float(np.abs(waves.within(radius) - rays.within(radius)).max())


def samples_across(pupil: FrequencyPupil, centre_um: float, aside_um: float = 0.0) -> int:
    """Return how many samples across the pupil its blur about a point takes."""
    reach = reach_of(pupil)
    beside = abs(aside_um - pupil.centroid_x_um) * pupil.half_x
    above = abs(centre_um - pupil.centroid_um) * pupil.half_y
    return even_count(FEWEST + PER_WAVE * max(reach.x + beside, reach.y + above))


def ring_sums(pupil: FrequencyPupil, centre_um: float, across: int, aside_um: float = 0.0) -> RingSums:
    """Return the transfer function about a point on a grid of ``across`` samples, summed over rings."""
    step = 2 * max(pupil.half_x, pupil.half_y) / across
    half = pupil.mask.clear and pupil.even
    wave, kept = (
        _cells(pupil, centre_um, step, across) if half else _whole_cells(pupil, (aside_um, centre_um), step, across)
    )
    length = fft.next_fast_len(2 * across + 4)
    both = np.concatenate([wave[:, ::-1], wave], axis=1) if half else wave
    field = fft.fft2(both, (length, length))
    transfer = fft.rfft2(field.real**2 + field.imag**2).real
    light = float(transfer[0, 0])
    ring, radius = _rings(length)
    transfer[:, 1 : (length + 1) // 2] *= 2  # the half at −ν
    sums = np.bincount(ring, transfer.ravel(), radius.size) * (kept / light)
    return RingSums(radius, sums, step, across)


def _cells(pupil: FrequencyPupil, centre_um: float, step: float, across: int) -> tuple[np.ndarray, float]:
    """Return an even clear pupil's function (y, x > 0) on the cells of a grid, and how much of the light that is.

    A cell on the edge has an amplitude equal to its share inside. The square of that is less than the share: what lacks
    is light that the whole edge would send beyond half the period of the grid.
    """
    wide, high = step / pupil.half_x, step / pupil.half_y
    x = (np.arange(across // 2 + 1) + 0.5) * wide
    y = (np.arange(across + 2) - (across + 1) / 2) * high
    area = np.zeros((y.size, x.size))
    for strip in (np.arange(STRIPS) + 0.5) / STRIPS - 0.5:
        area += np.clip((pupil.chords(y + strip * high)[:, None] - x) / wide + 0.5, 0, 1)
    area /= STRIPS
    phase, density = pupil.on_grid(x, y)
    density *= area > 0
    phase += centre_um * pupil.half_y * y[:, None]
    return _waves(area * density, density, phase)


def _whole_cells(
    pupil: FrequencyPupil, centre_um: tuple[float, float], step: float, across: int
) -> tuple[np.ndarray, float]:
    """Return `_cells` of any pupil about a point (x, y), of the whole pupil, (y, x)."""
    x, y = ((np.arange(across + 2) - (across + 1) / 2) * (step / half) for half in (pupil.half_x, pupil.half_y))
    amplitude, density, phase = masked_cells(pupil, x, y)
    phase += centre_um[0] * pupil.half_x * x + centre_um[1] * pupil.half_y * y[:, None]
    return _waves(amplitude, density, phase)


def _waves(amplitude: np.ndarray, density: np.ndarray, phase: np.ndarray) -> tuple[np.ndarray, float]:
    """Return amplitude·exp(2πi·phase), and how much of the light the amplitude keeps of density, without shares."""
    wave = np.empty(phase.shape, np.complex64)
    wave.real, wave.imag = cosine_sine(phase, np.float32)
    wave *= amplitude.astype(np.float32)
    return wave, float(np.vdot(amplitude, amplitude) / np.vdot(amplitude, density))


@lru_cache(maxsize=8)
def _rings(length: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the ring of every sample of a real transform's half plane, flat, and the mean radius of each ring."""
    along, across = fft.fftfreq(length, 1 / length), np.arange(length // 2 + 1)
    radius = np.hypot(across, along[:, None]).ravel()
    ring = np.rint(RINGS * radius).astype(np.int32)
    count = np.maximum(np.bincount(ring), 1)
    return protected(ring), protected(np.bincount(ring, radius) / count)


def _disc_transform(radius: np.ndarray, frequency: np.ndarray) -> np.ndarray:
    """Return R·J₁(2πRν)/ν, πR² at ν = 0, (radii, frequencies) (Goodman 2005, eq. 2-35)."""
    wide = radius[:, None]
    table: np.ndarray = wide * j1(2 * pi * wide * frequency) / np.where(frequency > 0, frequency, 1.0)
    table[:, frequency == 0] = pi * wide**2
    return table


@lru_cache(maxsize=8)
def _kept_transform(across: int) -> tuple[np.ndarray, np.ndarray]:
    """Return even radii up to BEYOND the blur that needs such a grid, in periods of the PSF, and the matrix of E(R)."""
    top = min(
        HALF_PERIOD, (2 * max(across - FEWEST, 0) / PER_WAVE + BEYOND) / across
    )  # S waves land at S/half = 2S/(step·across)
    scaled = np.linspace(0, top, RADII + 1)
    radius = _rings(fft.next_fast_len(2 * across + 4))[1]
    return protected(scaled), protected(_disc_transform(scaled, radius))


@lru_cache(maxsize=16)
def _missing_table(across: int) -> tuple[np.ndarray, np.ndarray]:
    """Return what the grid's energy of a uniform disc lacks of the closed form, at radii in periods of the PSF."""
    scaled = np.linspace(0, HALF_PERIOD, 4 * RADII + 1)
    found = ring_sums(uniform_disc(), 0.0, across)
    exact = circle_energy(scaled / found.step)
    return scaled, exact - _disc_transform(scaled, found.radius) @ found.sums


def _missing(across: int, scaled: np.ndarray) -> np.ndarray:
    missing: np.ndarray = np.interp(scaled, *_missing_table(across))
    return missing


def landing_points(pupil: FrequencyPupil, centre_um: float, aside_um: float = 0.0) -> LandingPoints:
    """Return where the pupil's rays land about a point."""
    x, y, light = landing_um(pupil, GEOMETRIC)
    radius = np.hypot(x - aside_um, y - centre_um).ravel()
    order = np.argsort(radius)
    share = np.cumsum(light.ravel()[order])
    return LandingPoints(np.append(0.0, radius[order]), np.append(0.0, share / share[-1]))
