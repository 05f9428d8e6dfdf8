"""The `fitted` method over a whole (depth, field, wavelength) space: a tensor of Chebyshev series (handbook 7.3).

The coefficients of a fit vary smoothly with s = 1/(object to entrance pupil), with h² and with wavelength, h
being the field slope: under h → −h, η → −η nothing changes, so each coefficient is even or odd in h and an odd one
is h times a function of h². They are stored as optical path (times λ), which is smoother than waves.

Of a lens without symmetry they are functions of the field along x and along y. There a fit stands in the axes of the
sensor, the same ones for all fields: in those of each field, which turn with its azimuth, nothing would be smooth about
the axis. A source's own fit follows by turning the polynomials (`turned_fit`).
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from p2sf.conventions import depth_of, vergence
from p2sf.database.exact import ExactDatabase, chebyshev_terms
from p2sf.database.render import Points, Sampling, critical_pixel_um
from p2sf.database.space import Space
from p2sf.lens.source import Source, source_at
from p2sf.paraxial.seidel import Coefficients
from p2sf.psf.fitted import psf_of_fit, summed
from p2sf.psf.result import Psf
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.zernike import basis, terms
from p2sf.raytrace.fit import UNIFORM, FittedPencil, Gradient, Level, level_rays, phase_slopes, rows_of
from p2sf.raytrace.ray_field import COARSE, SMALLEST, Steepness
from p2sf.raytrace.seen_mask import with_slopes
from p2sf.threads import mapped, one_blas_thread


@dataclass(frozen=True, eq=False)
class FittedDatabase:
    """Chebyshev series (s, h², wavelength, number) of a fit's coefficients, and the Seidel database of the same lens.

    Over a rectangle of fields (s, h_y, h_x, wavelength, number), and the Seidel database of the lens set straight.
    ``series``: path in µm for the phase, pure numbers for fx and fy, the chief ray's height (mm) last; over a rectangle
    its x and y on the sensor.
    ``errors``: the largest RMS phase error in waves where the rays land, at points between the nodes;
    ``residual_waves``: that of the fits themselves.
    """

    seidel: ExactDatabase
    series: np.ndarray
    level: Level
    errors: dict[str, float]
    residual_waves: float
    interpolant: str = "exact"
    method: str = "fitted"

    @property
    def space(self) -> Space:
        """Return the space that is covered."""
        return self.seidel.space

    @property
    def mask(self) -> PupilMask:
        """Return what stands in the pupil, as a source whose chief ray lands at +y sees it."""
        return self.seidel.mask

    def coefficients(self, depth_mm: ArrayLike, field_slope: ArrayLike, wavelength_um: ArrayLike) -> Coefficients:
        """Return the six Seidel coefficients and scales of the same lens; DatabaseError outside the space."""
        return self.seidel.coefficients(depth_mm, field_slope, wavelength_um)

    def numbers_at(self, source: Source) -> np.ndarray:
        """Return the coefficients of one source's fit, (numbers + 1,): waves, cycles/µm, and chief-ray height, mm.

        Over a rectangle of fields in the axes of the sensor, (numbers + 2,).
        """
        self.space.check_source(source)
        numbers = self.series
        for x, count in zip(self._axes.reduced(source), self.series.shape, strict=False):
            numbers = np.tensordot(chebyshev_terms(np.array(np.clip(x, -1, 1)), count), numbers, 1)
        numbers *= powers(self.level, source)
        return numbers

    def fit_at(self, source: Source) -> FittedPencil:
        """Return the fitted pencil of one source, looked up and not traced; DatabaseError outside the space."""
        phase, fx, fy, amplitude, _ = split(self.level, self.numbers_at(source))
        if self.level.skew and source.azimuth_deg:
            phase, fx, fy, amplitude = turned_fit(self.level, phase, fx, fy, amplitude, source.azimuth_deg)
        mask, colour = self.mask.turned(-source.azimuth_deg), float(source.wavelength_um)
        steep = with_slopes(steepness(self.level, phase, fx, fy), mask, colour)
        made = self.level, phase, fx, fy, self.residual_waves, steep
        return FittedPencil(*made, blur_um2=np.nan, rays=0, amplitude=amplitude, mask=mask, wavelength_um=colour)

    @one_blas_thread
    def psf(self, source: Source, pixels: int, pixel_um: float | None = None) -> Psf:
        """Return the PSF of one source, from looked-up numbers.

        Raises DatabaseError outside the space, SamplingError for a window no nodes can carry.
        """
        started = perf_counter()
        found = self.fit_at(source)
        six = self.coefficients(source.depth_mm, source.field_slope, source.wavelength_um)
        pixel_um = pixel_um or float(suitable_pixel_um(six, pixels))
        window = pixels, pixel_um
        psf = psf_of_fit(found, source.wavelength_um, window, "settled", started)
        return replace(psf, predicted_error=None)

    def rendered(
        self, points: Points, sampling: Sampling, dtype: DTypeLike = np.float32, threads: int | None = None
    ) -> np.ndarray:
        """Return unit-sum PSFs, (*points' broadcast shape, pixels, pixels), as `database.render.rendered` does."""
        pixels, pixel_um = sampling.pixels, sampling.pixel_um or critical_pixel_um(self)
        axes = np.broadcast_arrays(*points)
        out = np.empty((axes[0].size, pixels, pixels), dtype)

        def fill(numbered: tuple[int, tuple[float, ...]]) -> None:
            k, point = numbered
            values, _ = summed(self.fit_at(self.space.source(*point)), pixels, pixel_um, sampling.quality)
            out[k] = values / values.sum(dtype=float)

        mapped(fill, enumerate(zip(*(x.ravel().tolist() for x in axes), strict=True)), threads)
        return out.reshape(*axes[0].shape, pixels, pixels)

    @cached_property
    def _axes(self) -> "Axes":
        return axes_of(self.space, self.seidel)


@dataclass(frozen=True)
class Axes:
    """Middle and half-width of s (per mm), h² and wavelength (µm), and the place of the pupil, from which s is counted.

    Over a rectangle of fields h_y and h_x stand in the place of h². ``spread``: which of them vary at all.
    """

    middle: np.ndarray
    half: np.ndarray
    spread: tuple[bool, ...]
    pupil_mm: float

    def reduced(self, source: Source) -> np.ndarray:
        """Return (s, h², λ), or (s, h_y, h_x, λ), of a source mapped to −1…1."""
        near = float(vergence(source.depth_mm))
        s = near / (1 + self.pupil_mm * near)
        fields = [source.field_slope**2] if len(self.middle) == 3 else source.slopes_xy[::-1]
        reduced: np.ndarray = (np.array([s, *fields, source.wavelength_um]) - self.middle) / self.half
        return reduced

    def source(self, reduced: ArrayLike) -> Source:
        """Return the source at (s, h², λ), or (s, h_y, h_x, λ), each mapped to −1…1."""
        s, *fields, wavelength = (self.middle + self.half * np.asarray(reduced)).tolist()
        depth = depth_of(s) - self.pupil_mm
        if len(fields) == 2:
            return source_at(depth, fields[1], fields[0], wavelength)
        return Source(depth, float(np.sqrt(max(fields[0], 0.0))), wavelength)


def axes_of(space: Space, seidel: ExactDatabase) -> Axes:
    """Return the Chebyshev axes of a space; ``seidel`` knows where the entrance pupil is."""
    colours, slopes = space.wavelengths_um, space.field_slopes
    fields = [slopes[[0, -1]] ** 2]
    if space.field_x_slopes is not None:
        fields = [slopes[[0, -1]], space.field_x_slopes[[0, -1]]]
    pupil = seidel.pupil_mm(float(colours[0] + colours[-1]) / 2)
    near = vergence(space.depths_mm[[0, -1]])
    ends = np.array([near / (1 + pupil * near), *fields, colours[[0, -1]]])
    half = np.abs(np.diff(ends)[:, 0]) / 2
    return Axes(ends.mean(1), np.where(half > 0, half, 1.0), tuple((half > 0).tolist()), pupil)


def powers(level: Level, source: Source) -> np.ndarray:
    """Return h^(0 or 1)/λ for every number: odd in h where its polynomial asks for it, path turned into waves.

    Without symmetry there are no powers of h.
    """
    if level.skew:
        return np.append(np.full(level.unweighted_numbers, 1 / source.wavelength_um), np.ones(sum(level.counts[2]) + 2))
    even_phase = [m % 2 for _, m in terms(level.wave_order)]
    odd_map = [(m + 1) % 2 for _, m in terms(level.map_order, True)]
    even_map = [(m + 1) % 2 for _, m in terms(level.map_order)]
    even_amplitude = [m % 2 for _, m in terms(level.map_order)] if level.weighted else []
    parity = np.array([*even_phase, *odd_map, *even_map, *even_amplitude, 1])
    wavelength = np.full(parity.size, source.wavelength_um)
    wavelength[-1 - len(even_amplitude) :] = 1.0
    scale: np.ndarray = np.where(parity == 1, source.field_slope, 1.0) / wavelength
    return scale


def split(level: Level, numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, float]:
    """Return phase, fx, fy, amplitude and the chief ray's height, its y, from the numbers of one source."""
    ends = np.cumsum([sum(count) for count in level.counts])
    phase, fx, fy, amplitude = np.split(numbers[: -2 if level.skew else -1], ends)
    return phase, fx, fy, amplitude if level.weighted else UNIFORM, float(numbers[-1])


def turned_fit(
    level: Level, phase: np.ndarray, fx: np.ndarray, fy: np.ndarray, amplitude: np.ndarray, azimuth_deg: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return phase, fx, fy and amplitude of a fit without symmetry, in the sensor's axes, in those of an azimuth.

    Seen from there an angle about the pupil is θ − α, which mixes every cos mθ with its sin mθ, and (fx, fy) turns as
    a vector does.
    """
    turn, odd = np.deg2rad(azimuth_deg), level.counts[1][0]
    x = _turned(np.append(fx[odd:], fx[:odd]), level.map_order, turn)  # of fx the odd terms come first
    y = _turned(fy, level.map_order, turn)
    x, y = x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)
    phase, amplitude = _turned(phase, level.wave_order, turn), _turned(amplitude, level.map_order, turn)
    return phase, np.append(x[-odd:], x[:-odd]), y, amplitude


def _turned(form: np.ndarray, order: int, turn: float) -> np.ndarray:
    """Return the coefficients of the even terms up to an order and of the odd ones behind them, seen from ``turn``."""
    harmonic = np.array([m for _, m in terms(order)])
    paired = harmonic > 0  # the odd terms are the even ones without m = 0, in the same order
    even, odd = form[: harmonic.size], form[harmonic.size :]
    sine, cosine = np.sin(harmonic * turn), np.cos(harmonic * turn)
    new_even, new_odd = even * cosine, odd * cosine[paired] - even[paired] * sine[paired]
    new_even[paired] += odd * sine[paired]
    return np.append(new_even, new_odd)


def steepness(level: Level, phase: np.ndarray, fx: np.ndarray, fy: np.ndarray) -> Steepness:
    """Return how steep looked-up polynomials are, at the points of the level's rays, as `ray_field.steepness` does."""
    xi, eta, _ = level_rays(level)
    rho, sine = np.hypot(xi, eta), np.sqrt(np.maximum(1 - eta * eta, SMALLEST))
    slopes, (_, odd, even) = _rows_at_rays(level)
    across, along = (phase @ part[: phase.size] for part in slopes)
    return Steepness(
        radial=float(np.abs((xi * across + eta * along) / rho).max()),
        angular=float(np.abs(eta * across - xi * along).max()),
        across=COARSE * float((np.abs(across) * np.sqrt(np.maximum(1 - rho * rho, 0))).max()),
        along=COARSE * float(np.abs(across * (xi * eta / sine) - along * sine).max()),
        spread=float(np.hypot(fx @ odd, fy @ even).max()),
    )


@lru_cache(maxsize=16)
def _rows_at_rays(level: Level) -> tuple[Gradient, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Return ∂/∂ξ and ∂/∂η of the terms of the phase, and the terms of phase, fx and fy, at a level's rays."""
    (xi, eta, _), (even, odd) = level_rays(level), level.orders
    return phase_slopes(level), rows_of(level, basis(even, xi, eta), basis(odd, xi, eta, odd=True))
