"""PSFs from a database: coefficients looked up, pupils summed in batches."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from p2sf.database.space import Space
from p2sf.disc.mask import PupilMask
from p2sf.figures import pixel_light
from p2sf.figures.pixel_light import FineGrid, fine_grid
from p2sf.lens.source import Source
from p2sf.parameters import check_samples
from p2sf.paraxial.seidel import Coefficients
from p2sf.psf.pixel_integrals import integrate
from p2sf.psf.result import Psf
from p2sf.psf.seidel import check_image, check_window, seidel_psf, suitable_pixel_um
from p2sf.psf.seidel_stack import stack_of
from p2sf.threads import map_threads, one_blas_thread

Points = Iterable[ArrayLike]
"""Depth (mm), field slope or slopes and wavelength (µm), which broadcast; in the order of `Space.nodes`."""


class Database(Protocol):
    """A coefficient database of any kind; one with more than six coefficients per PSF renders them itself."""

    @property
    def space(self) -> Space:
        """Return the space covered."""

    @property
    def method(self) -> str:
        """Return the method that its PSFs are of."""

    @property
    def interpolant(self) -> str:
        """Return the method of interpolation between the nodes."""

    @property
    def errors(self) -> dict[str, float]:
        """Return the largest errors against direct evaluation, waves."""

    @property
    def mask(self) -> PupilMask:
        """Return the pupil mask in the coordinates of a source whose chief ray lands at +y."""

    def __hash__(self) -> int:
        """Return the hash of its identity."""

    def coefficients(self, depth_mm: ArrayLike, field_slope: ArrayLike, wavelength_um: ArrayLike) -> Coefficients:
        """Return the six coefficients at one point or over broadcast arrays; DatabaseError outside the space."""


@dataclass(frozen=True)
class Sampling:
    """Samples along each side, their pitch in µm (None: what the finest PSF on the nodes needs), and how exact.

    ``quality``: "settled", relative L2 below 1e-4, or "preview", a 128² pupil grid, as in `seidel_psf`.
    """

    pixels: int = 64
    pixel_um: float | None = None
    quality: str = "settled"


@one_blas_thread
def render_source(
    database: Database,
    points: Points,
    sampling: Sampling,
    dtype: DTypeLike = np.float32,
    threads: int | None = None,
) -> np.ndarray:
    """Return unit-sum PSFs, (*points' broadcast shape, pixels, pixels), at (depth mm, slope, wavelength µm).

    Their chief rays land at +y (azimuth 0); for other azimuths behind a mask that is not round use `database_psf`. They
    are summed in batches (`seidel_stack`), so that little more memory than the result is used, and by ``threads``
    (`p2sf.threads`), whose number does not change the result. Raises DatabaseError outside the database's space,
    GeometryError and SamplingError if there is no PSF to sample.
    """
    if hasattr(database, "rendered"):
        values: np.ndarray = database.rendered(points, sampling, dtype, threads)
        return values
    pixels, pixel_um = sampling.pixels, sampling.pixel_um or critical_pixel_um(database)
    found = database.coefficients(*(np.asarray(x, dtype=float) for x in points))
    check_image(found)
    check_window(found, pixels, pixel_um)
    return stack_of(found, pixels, pixel_um, sampling.quality, dtype, threads, database.mask).values


@one_blas_thread
def rendered_light(
    database: Database,
    points: Points,
    sampling: Sampling,
    dtype: DTypeLike = np.float32,
    threads: int | None = None,
) -> np.ndarray:
    """Return PSFs as `render_source`, as light per pixel if the pitch exceeds that of `critical_pixel_um`."""
    return light_of(database, points, sampling, grid_of(database, sampling), dtype, threads)


@one_blas_thread
def light_of(
    database: Database,
    points: Points,
    sampling: Sampling,
    grid: FineGrid | None,
    dtype: DTypeLike = np.float32,
    threads: int | None = None,
) -> np.ndarray:
    """Return `rendered_light` for a known `grid_of`, which evaluates every depth and colour.

    Each thread takes one PSF after the other: the finer samples may be a hundred times as many.
    """
    if grid is None:
        return render_source(database, points, sampling, dtype, threads)
    fine = fine_sampling(sampling, grid)
    places = np.broadcast_arrays(*points)
    shape = places[0].shape
    found = np.empty((*shape, sampling.pixels, sampling.pixels), dtype)

    def fill(index: tuple[int, ...]) -> None:
        one = render_source(database, [place[index] for place in places], fine, dtype)
        light = grid.light(one)
        found[index] = light / light.sum(dtype=float)

    map_threads(fill, np.ndindex(shape), threads)
    return found


def fine_sampling(sampling: Sampling, grid: FineGrid) -> Sampling:
    """Return the samples of a grid in the quality asked for."""
    return replace(sampling, pixels=grid.side, pixel_um=grid.pitch_um)


def grid_of(database: Database, sampling: Sampling) -> FineGrid | None:
    """Return the samples that the light on pixels takes; None for point samples."""
    critical = critical_pixel_um(database)
    return fine_grid(sampling.pixels, sampling.pixel_um or critical, critical)


def pixels_psf(
    database: Database, source: Source, pixels: int = 64, pixel_um: float | None = None, integrated: bool | None = None
) -> Psf:
    """Return `database_psf` as light per pixel or as samples, by default light where the pitch exceeds λ/(4 NA)."""
    check_samples(pixels, pixel_um)
    six = database.coefficients(float(source.depth_mm), float(source.field_slope), float(source.wavelength_um))
    psf = integrate(
        lambda count, pitch: database_psf(database, source, count, pitch),
        pixels,
        pixel_um or float(suitable_pixel_um(six, pixels)),
        float(pixel_light.critical_pixel_um(six.wavelength_um, six.na)),
        integrated,
    )
    return replace(psf, azimuth_deg=source.azimuth_deg)


@one_blas_thread
def database_psf(database: Database, source: Source, pixels: int = 64, pixel_um: float | None = None) -> Psf:
    """Return the settled PSF of one source, float64, looked up instead of traced; errors as `render_source`.

    The mask is rotated against the source's azimuth, as in `raytrace.seen_mask`.
    """
    if hasattr(database, "psf"):
        own: Psf = database.psf(source, pixels, pixel_um)
        return own
    start = perf_counter()
    found = database.coefficients(float(source.depth_mm), float(source.field_slope), float(source.wavelength_um))
    psf = seidel_psf(found, pixels, pixel_um, mask=database.mask.turned(-source.azimuth_deg))
    return replace(psf, seconds=perf_counter() - start)


def critical_pixel_um(database: Database) -> float:
    """Return the coarsest pitch that samples the finest PSF on the nodes without loss: λ/(4 NA), its band limit."""
    space = database.space
    # The numerical aperture does not depend on the field.
    found = database.coefficients(space.depths_mm[:, None], space.field_slopes[0], space.wavelengths_um)
    return float(np.min(pixel_light.critical_pixel_um(space.wavelengths_um, found.na)))
