"""The `fitted` method over a whole (depth, field, wavelength) space: a tensor of Chebyshev series (handbook 7.3).

The coefficients of a fit vary smoothly with s = 1/(object to entrance pupil), with h² and with wavelength, h
being the field slope: under h → −h, η → −η nothing changes, so each coefficient is even or odd in h and an odd one
is h times a function of h². They are stored as optical path (times λ), which is smoother than waves.

For a lens without symmetry they are functions of the field along x and along y. There a fit is in the axes of the
sensor, the same for all fields: in the axes of each field, which rotate with its azimuth, the coefficients would not be
smooth about the axis. The fit of a source follows by rotating the polynomials (`turned_fit`).
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
from p2sf.disc.basis import Gradient, PupilValues
from p2sf.disc.domain import HALF, WHOLE, PupilDomain
from p2sf.disc.mask import PupilMask
from p2sf.lens.source import Source, source_at
from p2sf.paraxial.seidel import Coefficients
from p2sf.psf.fitted import sum_fit
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.result import Psf
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.pupil.fit import UNIFORM, FittedPencil, Level, level_rays, phase_slopes
from p2sf.pupil.seen_mask import with_slopes
from p2sf.raytrace.ray_field import COARSE, SMALLEST, Steepness, map_slopes
from p2sf.threads import map_threads, one_blas_thread


@dataclass(frozen=True, eq=False)
class FittedDatabase:
    """Chebyshev series (s, h², wavelength, number) of a fit's coefficients, and the Seidel database of the same lens.

    Over a rectangle of fields (s, h_y, h_x, wavelength, number), and the Seidel database of the aligned lens.
    ``series``: path in µm for the phase, pure numbers for fx and fy, the chief ray's height (mm) last; over a rectangle
    its x and y on the sensor.
    ``errors``: the largest RMS phase error in waves at the landing points, between the nodes;
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
        for x, count in zip(self.axes.normalise(source), self.series.shape, strict=False):
            numbers = np.tensordot(chebyshev_terms(np.array(np.clip(x, -1, 1)), count), numbers, 1)
        numbers *= powers(self.level, source, self.axes.fields)
        return numbers

    def fit_at(self, source: Source) -> FittedPencil:
        """Return the fitted pencil of one source, looked up and not traced; DatabaseError outside the space."""
        phase, fx, fy, amplitude, _ = split(self.level, self.numbers_at(source))
        turn_deg = self.axes.fields.turn_deg(source)
        if turn_deg:
            phase, fx, fy, amplitude = turned_fit(self.level, phase, fx, fy, amplitude, turn_deg)
        mask, colour = self.mask.turned(-source.azimuth_deg), float(source.wavelength_um)
        steep = with_slopes(steepness(self.level, phase, fx, fy), mask, colour)
        made = self.level, self.level.function(phase, fx, fy, amplitude), self.residual_waves, steep
        return FittedPencil(*made, blur_um2=np.nan, rays=0, mask=mask, wavelength_um=colour)

    @one_blas_thread
    def psf(self, source: Source, pixels: int, pixel_um: float | None = None) -> Psf:
        """Return the PSF of one source, from looked-up numbers.

        Raises DatabaseError outside the space, SamplingError for a window that needs too many nodes.
        """
        started = perf_counter()
        found = self.fit_at(source)
        six = self.coefficients(source.depth_mm, source.field_slope, source.wavelength_um)
        pixel_um = pixel_um or float(suitable_pixel_um(six, pixels))
        psf = psf_of_pupil(found, (pixels, pixel_um)).with_figures(predicted_error=None)
        return replace(psf, seconds=perf_counter() - started)

    def rendered(
        self, points: Points, sampling: Sampling, dtype: DTypeLike = np.float32, threads: int | None = None
    ) -> np.ndarray:
        """Return unit-sum PSFs, (*points' broadcast shape, pixels, pixels), as `database.render.rendered` does."""
        pixels, pixel_um = sampling.pixels, sampling.pixel_um or critical_pixel_um(self)
        axes = np.broadcast_arrays(*points)
        out = np.empty((axes[0].size, pixels, pixels), dtype)

        def fill(numbered: tuple[int, tuple[float, ...]]) -> None:
            k, point = numbered
            values, _ = sum_fit(self.fit_at(self.space.source(*point)), pixels, pixel_um, sampling.quality)
            out[k] = values / values.sum(dtype=float)

        map_threads(fill, enumerate(zip(*(x.ravel().tolist() for x in axes), strict=True)), threads)
        return out.reshape(*axes[0].shape, pixels, pixels)

    @cached_property
    def axes(self) -> "Axes":
        """Return the Chebyshev axes of the space."""
        return axes_of(self.space, self.seidel)


@dataclass(frozen=True)
class FieldLine:
    """Fields along one line, which represent all azimuths: one axis, of h²; fits are in the axes of the field."""

    domain: PupilDomain = HALF
    chief_numbers: int = 1  # of the chief ray's place on the sensor: y

    def ends(self, space: Space) -> list[np.ndarray]:
        """Return the ends of h²."""
        return [space.field_slopes[[0, -1]] ** 2]

    def values(self, source: Source) -> list[float]:
        """Return h²."""
        return [source.field_slope**2]

    def source(self, depth_mm: float, values: list[float], wavelength_um: float) -> Source:
        """Return the source at h²."""
        return Source(depth_mm, float(np.sqrt(max(values[0], 0.0))), wavelength_um)

    def odd_factor(self, source: Source) -> float:
        """Return h, by which numbers that are odd in it are divided."""
        return source.field_slope

    def turn_deg(self, source: Source) -> float:
        """Return the rotation of the axes of a source from those of its fit: none."""
        return 0.0


@dataclass(frozen=True)
class FieldRectangle:
    """Fields over a rectangle, in axes of h_y and h_x; fits are in the axes of the sensor."""

    domain: PupilDomain = WHOLE
    chief_numbers: int = 2  # x and y

    def ends(self, space: Space) -> list[np.ndarray]:
        """Return the ends of h_y and h_x."""
        return [nodes[[0, -1]] for nodes in space.nodes[1:-1]]

    def values(self, source: Source) -> list[float]:
        """Return h_y and h_x."""
        return [*source.slopes_xy[::-1]]

    def source(self, depth_mm: float, values: list[float], wavelength_um: float) -> Source:
        """Return the source at h_y and h_x."""
        return source_at(depth_mm, values[1], values[0], wavelength_um)

    def odd_factor(self, source: Source) -> float:
        """Return 1: along these axes no number is even or odd."""
        return 1.0

    def turn_deg(self, source: Source) -> float:
        """Return the azimuth."""
        return source.azimuth_deg


FieldAxes = FieldLine | FieldRectangle


@dataclass(frozen=True, eq=False)
class Axes:
    """Middle and half-width of s (per mm), fields and wavelength (µm), and the place of the pupil, where s starts.

    ``spread``: which of them vary.
    """

    fields: FieldAxes
    middle: np.ndarray
    half: np.ndarray
    spread: tuple[bool, ...]
    pupil_mm: float

    def normalise(self, source: Source) -> np.ndarray:
        """Return s, fields and wavelength of a source, each mapped to −1…1."""
        near = float(vergence(source.depth_mm))
        s = near / (1 + self.pupil_mm * near)
        values = np.array([s, *self.fields.values(source), source.wavelength_um])
        reduced: np.ndarray = (values - self.middle) / self.half
        return reduced

    def source(self, reduced: ArrayLike) -> Source:
        """Return the source at s, fields and wavelength, each mapped to −1…1."""
        s, *fields, wavelength = (self.middle + self.half * np.asarray(reduced)).tolist()
        return self.fields.source(depth_of(s) - self.pupil_mm, fields, wavelength)


def fields_of(space: Space) -> FieldAxes:
    """Return the axes of the fields of a space."""
    return FieldLine() if space.field_x_slopes is None else FieldRectangle()


def axes_of(space: Space, seidel: ExactDatabase) -> Axes:
    """Return the Chebyshev axes of a space; ``seidel`` gives the position of the entrance pupil."""
    fields, colours = fields_of(space), space.wavelengths_um
    pupil = seidel.pupil_mm(float(colours[0] + colours[-1]) / 2)
    near = vergence(space.depths_mm[[0, -1]])
    ends = np.array([near / (1 + pupil * near), *fields.ends(space), colours[[0, -1]]])
    half = np.abs(np.diff(ends)[:, 0]) / 2
    return Axes(fields, ends.mean(1), np.where(half > 0, half, 1.0), tuple((half > 0).tolist()), pupil)


def powers(level: Level, source: Source, fields: FieldAxes) -> np.ndarray:
    """Return h^(0 or 1)/λ for every number: odd in h where its polynomial asks for it, path turned into waves."""
    odd, colours = _powers_of(level, fields)
    scale: np.ndarray = np.where(odd, fields.odd_factor(source), 1.0) / np.where(colours, source.wavelength_um, 1.0)
    return scale


@lru_cache(maxsize=16)
def _powers_of(level: Level, fields: FieldAxes) -> tuple[np.ndarray, np.ndarray]:
    """Return which numbers are odd in h, and which are divided by the wavelength, where fields are along a line.

    Under h → −h, η → −η the phase and the amplitude stay, and fx and fy change their sign.
    """
    basis, amplitude = level.basis, level.basis.fy.indices[1] if level.weighted else np.empty(0)
    same, other = (basis.phase.indices[1],), (basis.fx.indices[1], basis.fy.indices[1])
    chief = np.ones(fields.chief_numbers)
    odd = np.concatenate([*same, *(m + 1 for m in other), amplitude, chief]) % 2 == 1
    return odd, np.arange(odd.size) < level.unweighted_numbers


def split(level: Level, numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, float]:
    """Return phase, fx, fy, amplitude and the chief ray's height, its y, from the numbers of one source."""
    basis = level.basis
    ends = np.cumsum([basis.phase.count, basis.fx.count, basis.fy.count, basis.fy.count * level.weighted])
    phase, fx, fy, amplitude, chief = np.split(numbers, ends)
    return phase, fx, fy, amplitude if level.weighted else UNIFORM, float(chief[-1])


def turned_fit(
    level: Level, phase: np.ndarray, fx: np.ndarray, fy: np.ndarray, amplitude: np.ndarray, azimuth_deg: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return phase, fx, fy and amplitude of a fit in the sensor's axes in those of an azimuth.

    In those axes an angle in the pupil is θ − α, and (fx, fy) rotates as a vector.
    """
    basis, turn = level.basis, np.deg2rad(azimuth_deg)
    sine, cosine = np.sin(turn), np.cos(turn)
    x, y = basis.fx.turned(fx, -turn), basis.fy.turned(fy, -turn)
    across = x[0] * cosine - y[0] * sine, x[1] * cosine - y[1] * sine
    along = x[0] * sine + y[0] * cosine, x[1] * sine + y[1] * cosine
    of_phase, light = basis.phase.turned(phase, -turn), basis.fy.turned(amplitude, -turn)
    return basis.phase.joined(of_phase), basis.fx.joined(across), basis.fy.joined(along), basis.fy.joined(light)


def steepness(level: Level, phase: np.ndarray, fx: np.ndarray, fy: np.ndarray) -> Steepness:
    """Return the steepness of looked-up polynomials at the points of the level's rays, as `ray_field.steepness`."""
    xi, eta, _ = level_rays(level)
    rho, sine = np.hypot(xi, eta), np.sqrt(np.maximum(1 - eta * eta, SMALLEST))
    slopes, values, (of_fx, of_fy) = _terms_at_rays(level)
    across, along = (phase @ part for part in slopes)
    by_xi, by_eta = (np.stack([fx @ a, fy @ b]) for a, b in zip(of_fx, of_fy, strict=True))
    spread = float(np.hypot(fx @ values.fx, fy @ values.fy).max())
    return Steepness(
        radial=float(np.abs((xi * across + eta * along) / rho).max()),
        angular=float(np.abs(eta * across - xi * along).max()),
        across=COARSE * float((np.abs(across) * np.sqrt(np.maximum(1 - rho * rho, 0))).max()),
        along=COARSE * float(np.abs(across * (xi * eta / sine) - along * sine).max()),
        spread=spread,
        stretch=max(1.0, map_slopes(xi, eta, by_xi, by_eta).largest / spread),
    )


@lru_cache(maxsize=16)
def _terms_at_rays(level: Level) -> tuple[Gradient, PupilValues, tuple[Gradient, Gradient]]:
    """Return ∂/∂ξ and ∂/∂η of the terms of the phase, all terms, and those slopes of fx and fy, at a level's rays."""
    xi, eta, _ = level_rays(level)
    return phase_slopes(level), level.basis.values(xi, eta), level.basis.map_slopes(xi, eta)
