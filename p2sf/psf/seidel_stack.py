"""Many PSFs at once, each on about as many pupil samples as its own phase needs.

One PSF of steep phase must not slow down a whole stack: PSFs of one n'u'/λ are sorted by the steepness of their phase
and summed in batches, on the samples required by the steepest of a batch. A batch shares a kernel, which costs as much
as several PSFs, so smaller batches would save less than they cost.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import ceil, sqrt

import numpy as np
from numpy.typing import DTypeLike

from p2sf.conventions import write_protect
from p2sf.disc.basis import PupilBasis
from p2sf.disc.disc_function import DiscFunction
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.quadrature import (
    RowNodes,
    chord_rows,
    chords_for,
    disc_nodes,
    even_count,
    grid_rows,
)
from p2sf.errors import SamplingError
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import bound_of, chords_of, polar_of, shapes, steepest_of
from p2sf.psf.fitted import sum_fit
from p2sf.psf.seidel_sum import (
    BATCH,
    batch_intensities,
    groups,
    shape_terms,
    wave_number,
)
from p2sf.pupil.fit import ODD, FittedPencil, Level
from p2sf.pupil.seen_mask import with_slopes
from p2sf.raytrace.ray_field import Steepness
from p2sf.threads import map_threads, one_blas_thread, threads_or_default

PREVIEW_GRID = 128
LARGEST_NODES = 2**25  # of a quarter pupil: some 3000 waves of slope, seconds of work
SORTED_AT_ONCE = 512  # PSFs whose slopes are computed together, which takes some mebibytes
NODES_TOGETHER = 2**18  # nodes of quarter pupils that a thread sums at a time: some 5 ms of work
MOST_IN_ROWS = 2**24  # nodes of a quarter pupil times pixels of a side: beyond, a sum by rows is slower
MOST_ONE_BY_ONE = 2**23  # of the whole disc: beyond, only rows do
SEIDEL_LEVEL = Level(PupilBasis(4, 1), 0, 0)  # order of a fit equivalent to six coefficients

Part = tuple[slice | np.ndarray, RowNodes]
"""Indices of PSFs that are summed together, and their nodes."""


@dataclass(frozen=True, eq=False)
class SummedStack:
    """PSFs (…, pixels, pixels) of unit sum; their sums in units of the unaberrated peak; the nodes used."""

    values: np.ndarray
    total: np.ndarray
    sampling: Message


def stack_of(
    coefficients: Coefficients,
    pixels: int,
    pixel_um: float,
    quality: str,
    dtype: DTypeLike,
    threads: int | None = None,
    mask: PupilMask = CLEAR,
) -> SummedStack:
    """Return the PSFs of broadcast coefficients by `_seidel_sum`; SamplingError for too many pupil samples.

    ``threads`` as in `p2sf.threads`; the PSFs are the same on any number of them. Behind a ``mask``, and one alone
    that takes more than MOST_IN_ROWS products, they are summed one by one, as `fitted` is.
    """
    terms = shape_terms(coefficients)
    shape, terms = terms.shape[:-1], terms.reshape(-1, 5)
    steep = _steepness(terms, pixels, pixel_um, quality) if len(terms) == 1 else None
    if not mask.clear or (steep and _too_steep(*steep, pixels)):
        return _one_by_one(each_of(coefficients), shape, (pixels, pixel_um), quality, dtype, threads, mask)
    values = np.empty((len(terms), pixels, pixels), dtype)
    total = np.empty(len(terms))

    def fill(parts: list[Part]) -> RowNodes:
        taken = []
        for some, rows in parts:
            found = batch_intensities(terms[some], pixels, pixel_um, rows, dtype)
            flat = found.reshape(len(found), -1)
            total[some] = np.add.reduce(flat, 1, float)
            flat /= total[some, None].astype(dtype)
            values[some] = found
            taken.append(rows)
        return max(taken, key=_size)

    if steep:  # distributing it would take a tenth of its time
        if threads is not None:
            threads_or_default(threads)  # refuses an invalid number of threads
        with one_blas_thread:
            used = [fill([(slice(None), _rows(*steep, quality))])]
    else:
        used = map_threads(fill, _shares(stack_parts(terms, pixels, pixel_um, quality)), threads)
    sampling = Message(
        "{nodes}, {precision}" if len(terms) <= 1 else "up to {nodes}, {precision}",
        nodes=max(used, key=_size).name if used else Message("no nodes"),
        precision=values.dtype.type.__name__,
    )
    return SummedStack(values.reshape(*shape, pixels, pixels), total.reshape(shape), sampling)


def _steepness(terms: np.ndarray, pixels: int, pixel_um: float, quality: str) -> tuple[np.ndarray, float]:
    """Return the steepest phase of one PSF as `_slopes` does, and the waves at the window's corner."""
    reach = corner_reach(abs(float(terms[0, 4])), pixels, pixel_um)
    return _slopes(terms[:, :4], reach, quality)[0], reach


def _too_steep(slopes: np.ndarray, reach: float, pixels: int) -> bool:
    """Return whether one PSF needs so many products that a non-uniform FFT is faster."""
    if slopes.size == 1 and _grid_samples(float(slopes[0]), reach) <= PREVIEW_GRID:
        return False
    rows, columns = chords_for(slopes[0], slopes[-1], reach, reach / sqrt(2))
    return MOST_IN_ROWS < rows * columns / 4 * pixels and rows * columns < MOST_ONE_BY_ONE


def _one_by_one(
    coefficients: Sequence[Coefficients],
    shape: tuple[int, ...],
    window: tuple[int, float],
    quality: str,
    dtype: DTypeLike,
    threads: int | None,
    mask: PupilMask,
) -> SummedStack:
    """Return the PSFs of a stack of this shape one after the other, as those of fits with a linear map."""
    found = map_threads(lambda one: sum_fit(as_fit(one, mask), *window, quality), coefficients, threads)
    planes = np.reshape([plane for plane, _ in found], (*shape, window[0], window[0])).astype(dtype)
    total = planes.sum((-2, -1), dtype=float)
    nodes = found[-1][1] if found else Message("no nodes")
    return SummedStack(planes / total[..., None, None].astype(dtype), total, nodes)


def each_of(coefficients: Coefficients) -> list[Coefficients]:
    """Return the coefficients of each PSF of a stack, in the order of its flat array."""
    columns = np.broadcast_arrays(*(np.asarray(x, float) for x in vars(coefficients).values()))
    if not columns[0].shape:
        return [coefficients]
    return [Coefficients(*one) for one in zip(*(column.ravel() for column in columns), strict=True)]


def as_fit(coefficients: Coefficients, mask: PupilMask) -> FittedPencil:
    """Return one wavefront of six coefficients as a fit with a linear map, behind a mask.

    W is the conjugate of a fit's phase (`conventions`), so that phase and frequencies change their signs.
    """
    shape, scale = shape_terms(coefficients)[:4], -float(wave_number(coefficients))
    (along, across), (radial, angular) = chords_of(shape).tolist(), polar_of(shape).tolist()
    nodes, every = disc_nodes(*SEIDEL_LEVEL.counts), _shapes()
    values = np.ones((len(ODD), nodes.xi.size))
    values[0], values[1], values[2] = -(shape @ every), scale * nodes.xi, scale * nodes.eta
    wavelength = float(coefficients.wavelength_um)
    return FittedPencil(
        SEIDEL_LEVEL,
        DiscFunction(values, SEIDEL_LEVEL.counts, ODD),
        residual_waves=0.0,
        steepness=with_slopes(Steepness(radial, angular, across, along, abs(scale)), mask, wavelength),
        blur_um2=1 / (np.pi * scale**2),
        rays=2,
        mask=mask,
        wavelength_um=wavelength,
        method="seidel",
    )


@lru_cache(maxsize=1)
def _shapes() -> np.ndarray:
    """Return the shapes at the nodes that determine them, (4, nodes)."""
    nodes = disc_nodes(*SEIDEL_LEVEL.counts)
    return write_protect(shapes(nodes.xi, nodes.eta))


def _size(rows: RowNodes) -> int:
    return rows.weight.size


def _shares(parts: Iterable[Part]) -> Iterator[list[Part]]:
    """Yield parts in groups large enough to be worth a thread."""
    share, nodes = [], 0
    for some, rows in parts:
        share.append((some, rows))
        nodes += _size(rows) * (1 if isinstance(some, slice) else len(some))
        if nodes >= NODES_TOGETHER:
            yield share
            share, nodes = [], 0
    if share:
        yield share


def stack_parts(terms: np.ndarray, pixels: int, pixel_um: float, quality: str) -> Iterator[Part]:
    """Yield the indices of PSFs that are summed together and the pupil samples they need.

    ``terms``: (PSFs, 5) as `shape_terms` gives them. Raises SamplingError for too many samples.
    """
    for same in groups(terms[:, 4]):
        reach = corner_reach(abs(float(terms[same[0], 4])), pixels, pixel_um)
        for part in _split(same, SORTED_AT_ONCE):
            slopes = _slopes(terms[part, :4], reach, quality)
            for some in _split(np.argsort(slopes.sum(-1), kind="stable"), BATCH):
                yield part[some], _rows(slopes[some].max(0), reach, quality)


def _split(values: np.ndarray, most: int) -> list[np.ndarray]:
    """Return the values in parts of about equal size, none longer than ``most``."""
    size = ceil(len(values) / ceil(len(values) / most))
    return [values[start : start + size] for start in range(0, len(values), size)]


def corner_reach(scale: float, pixels: int, pixel_um: float) -> float:
    """Return waves per unit pupil radius of the kernel at the window's corner; ``scale``: NA/λ, cycles per µm."""
    return scale * pixel_um * (pixels // 2) * sqrt(2)


def _slopes(shape: np.ndarray, reach: float, quality: str) -> np.ndarray:
    """Return the steepest phase, waves: (PSFs, 2) across and along chords if settled, (PSFs, 1) on a grid."""
    if quality == "settled":
        return chords_of(shape)
    bound = bound_of(shape)[:, None]
    return bound if _grid_samples(float(bound.max()), reach) <= PREVIEW_GRID else steepest_of(shape)[:, None]


def _grid_samples(slope: float, reach: float) -> float:
    """Return how many samples N a preview's grid needs: its step of 2/N repeats blur and window every N/2 cycles."""
    return 2.1 * (slope + reach)


def _rows(slopes: np.ndarray, reach: float, quality: str) -> RowNodes:
    """Return the pupil samples that carry these slopes, the steepest of each kind."""
    if quality == "settled":
        return chord_rows(*_counts(slopes, reach))
    rows = max(PREVIEW_GRID, even_count(_grid_samples(float(slopes[0]), reach)))
    if rows * rows > 4 * LARGEST_NODES:
        raise _too_many(float(slopes.max()), reach, rows, rows)
    return grid_rows(rows)


def _counts(slopes: np.ndarray, reach: float) -> tuple[int, int]:
    """Return rows and columns that carry these slopes across and along chords."""
    rows, columns = chords_for(slopes[0], slopes[1], reach, reach / sqrt(2))
    if rows * columns > 4 * LARGEST_NODES:
        raise _too_many(float(slopes.max()), reach, rows, columns)
    return rows, columns


def _too_many(slope: float, reach: float, rows: int, columns: int) -> SamplingError:
    return SamplingError(
        "a phase slope of {slope:.0f} waves over a window of {cycles:.0f} cycles needs {rows} × {columns} pupil "
        "samples; bring the sensor nearer to the image, stop down, or show a smaller window",
        slope=slope,
        cycles=reach,
        rows=rows,
        columns=columns,
    )
