"""From a database to pictures: coefficients looked up, pupils summed in batches."""

from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from p2sf.fastpath import intensities, wave_number
from p2sf.psf import Psf, check_image, check_window, corner_reach, rows_for, seidel_psf
from p2sf.quadrature import chords_for
from p2sf.seidel import Coefficients
from p2sf.source import Source
from p2sf.wavefront import steepest_slope


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

    The fields of one depth and wavelength share their kernels and hence their pupil samples; each such group
    takes what its own steepest phase asks, so that one defocused depth does not slow the whole stack. Raises
    DatabaseError outside the database's space, GeometryError and SamplingError where there is no PSF to sample.
    """
    pixels, pixel_um = sampling.pixels, sampling.pixel_um or critical_pixel_um(database)
    found = database.coefficients(*(np.asarray(x, dtype=float) for x in points))
    check_image(found)
    check_window(found, pixels, pixel_um)
    flat, shape = _flat(found)
    counts = _counts(flat, pixels, pixel_um)
    out = np.empty((len(counts), pixels, pixels), dtype)
    for count in np.unique(counts):
        some = np.flatnonzero(counts == count)
        chosen = _taken(flat, some)
        rows = rows_for(chosen, pixels, pixel_um, sampling.quality)
        out[some] = intensities(chosen, pixels, pixel_um, rows, dtype)
    out /= out.sum((-2, -1), keepdims=True)
    return out.reshape(*shape, pixels, pixels)


def database_psf(database, source: Source, pixels: int = 64, pixel_um: float | None = None) -> Psf:
    """Return the settled PSF of one source, float64, looked up instead of traced; errors as `rendered`."""
    start = perf_counter()
    found = database.coefficients(float(source.depth_mm), float(source.field_slope), float(source.wavelength_um))
    psf = seidel_psf(found, pixels, pixel_um)
    return replace(psf, seconds=perf_counter() - start)


def _counts(flat: Coefficients, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the chords that each PSF is summed on: what the steepest PSF of its n'u'/λ needs."""
    _, group = np.unique(wave_number(flat), return_inverse=True)
    steepest = np.zeros(group.max() + 1)
    np.maximum.at(steepest, group, steepest_slope(flat))
    scale = np.zeros_like(steepest)
    scale[group] = np.abs(wave_number(flat))
    pairs = zip(steepest.tolist(), scale.tolist(), strict=True)
    return np.array([chords_for(slope, corner_reach(one, pixels, pixel_um))[0] for slope, one in pairs])[group]


def _flat(found: Coefficients) -> tuple[Coefficients, tuple[int, ...]]:
    arrays = np.broadcast_arrays(*vars(found).values())
    return Coefficients(*(x.ravel() for x in arrays)), arrays[0].shape


def _taken(flat: Coefficients, some: np.ndarray) -> Coefficients:
    return Coefficients(*(x[some] for x in vars(flat).values()))


def critical_pixel_um(database) -> float:
    """Return the coarsest pitch that loses nothing of the finest PSF on the nodes: λ/(4 NA), its band limit.

    Source: an incoherent image holds no frequency above 2NA/λ (Goodman, Introduction to Fourier Optics, §6.3).
    """
    found = database.coefficients(*database.space.axes)
    return float(np.min(database.space.wavelengths_um / (4 * found.na)))
