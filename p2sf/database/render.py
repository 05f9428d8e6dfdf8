"""From a database to pictures: coefficients looked up, pupils summed in batches."""

from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from p2sf.fastpath import intensities, wave_number
from p2sf.psf import Psf, check_image, check_window, corner_reach, rows_for, seidel_psf
from p2sf.seidel import Coefficients
from p2sf.source import Source
from p2sf.wavefront import steepest_slope

BLOCK = 64  # PSFs at a time: a mebibyte of 64² float32


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

    Each is summed on about what its own phase asks for, so that one defocused corner does not slow the whole
    stack, and in blocks, so that little more memory than the result is used. Raises DatabaseError outside
    the database's space, GeometryError and SamplingError where there is no PSF to sample.
    """
    if hasattr(database, "rendered"):
        return database.rendered(points, sampling, dtype)
    pixels, pixel_um = sampling.pixels, sampling.pixel_um or critical_pixel_um(database)
    found = database.coefficients(*(np.asarray(x, dtype=float) for x in points))
    check_image(found)
    check_window(found, pixels, pixel_um)
    flat, shape = _flat(found)
    out = np.empty((flat.wd.size, pixels, pixels), dtype)
    for block in _blocks(flat, pixels, pixel_um):
        chosen = _taken(flat, block)
        values = intensities(chosen, pixels, pixel_um, rows_for(chosen, pixels, pixel_um, sampling.quality), dtype)
        values /= values.sum((-2, -1), keepdims=True)
        out[block] = values
    return out.reshape(*shape, pixels, pixels)


def database_psf(database, source: Source, pixels: int = 64, pixel_um: float | None = None) -> Psf:
    """Return the settled PSF of one source, float64, looked up instead of traced; errors as `rendered`."""
    if hasattr(database, "psf"):
        return database.psf(source, pixels, pixel_um)
    start = perf_counter()
    found = database.coefficients(float(source.depth_mm), float(source.field_slope), float(source.wavelength_um))
    psf = seidel_psf(found, pixels, pixel_um)
    return replace(psf, seconds=perf_counter() - start)


def _blocks(flat: Coefficients, pixels: int, pixel_um: float):
    """Return the indices that are summed together: alike in pupil samples, and those of one n'u'/λ side by side.

    A kernel costs about as much as one PSF, so finer classes of samples would save less than they cost.
    """
    scale = wave_number(flat)
    classes = np.empty(len(scale))
    for start in range(0, len(scale), BLOCK):
        part = slice(start, start + BLOCK)
        reach = np.abs(scale[part]) * corner_reach(1.0, pixels, pixel_um)
        classes[part] = steepest_slope(_taken(flat, part)) + reach
    steps = np.exp2(np.floor(np.log2(np.maximum(classes, 1))) - 2)
    classes = np.ceil(classes / steps) * steps
    order = np.lexsort((scale, classes))
    cuts = np.flatnonzero(np.diff(classes[order])) + 1
    for same in np.split(order, cuts):
        yield from np.split(same, range(BLOCK, len(same), BLOCK))


def _flat(found: Coefficients) -> tuple[Coefficients, tuple[int, ...]]:
    arrays = np.broadcast_arrays(*vars(found).values())
    return Coefficients(*(x.ravel() for x in arrays)), arrays[0].shape


def _taken(flat: Coefficients, some) -> Coefficients:
    return Coefficients(*(x[some] for x in vars(flat).values()))


def critical_pixel_um(database) -> float:
    """Return the coarsest pitch that loses nothing of the finest PSF on the nodes: λ/(4 NA), its band limit.

    Source: an incoherent image holds no frequency above 2NA/λ (Goodman, Introduction to Fourier Optics, §6.3).
    """
    found = database.coefficients(*database.space.axes)
    return float(np.min(database.space.wavelengths_um / (4 * found.na)))
