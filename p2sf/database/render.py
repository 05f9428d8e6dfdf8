"""From a database to pictures: coefficients looked up, pupils summed in batches."""

from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from p2sf.lens.source import Source
from p2sf.psf.result import Psf
from p2sf.psf.seidel import check_image, check_window, seidel_psf
from p2sf.psf.seidel_stack import stack_of


@dataclass(frozen=True)
class Sampling:
    """Samples along each side, their pitch in µm (None: what the finest PSF on the nodes needs), and how exact.

    ``quality``: "settled", relative L2 below 1e-4, or "preview", a 128² pupil grid, as `psf.seidel_psf` has them.
    """

    pixels: int = 64
    pixel_um: float | None = None
    quality: str = "settled"


def rendered(database, points, sampling: Sampling, dtype=np.float32) -> np.ndarray:
    """Return unit-sum PSFs, (*points' broadcast shape, pixels, pixels), at (depth mm, slope, wavelength µm).

    They are summed a few at a time (`batches`), so that little more memory than the result is used. Raises
    DatabaseError outside the database's space, GeometryError and SamplingError where there is no PSF to sample.
    """
    if hasattr(database, "rendered"):
        return database.rendered(points, sampling, dtype)
    pixels, pixel_um = sampling.pixels, sampling.pixel_um or critical_pixel_um(database)
    found = database.coefficients(*(np.asarray(x, dtype=float) for x in points))
    check_image(found)
    check_window(found, pixels, pixel_um)
    return stack_of(found, pixels, pixel_um, sampling.quality, dtype).values


def database_psf(database, source: Source, pixels: int = 64, pixel_um: float | None = None) -> Psf:
    """Return the settled PSF of one source, float64, looked up instead of traced; errors as `rendered`."""
    if hasattr(database, "psf"):
        return database.psf(source, pixels, pixel_um)
    start = perf_counter()
    found = database.coefficients(float(source.depth_mm), float(source.field_slope), float(source.wavelength_um))
    psf = seidel_psf(found, pixels, pixel_um)
    return replace(psf, seconds=perf_counter() - start)


def critical_pixel_um(database) -> float:
    """Return the coarsest pitch that loses nothing of the finest PSF on the nodes: λ/(4 NA), its band limit.

    Source: an incoherent image holds no frequency above 2NA/λ (Goodman, Introduction to Fourier Optics, §6.3).
    """
    found = database.coefficients(*database.space.axes)
    return float(np.min(database.space.wavelengths_um / (4 * found.na)))
