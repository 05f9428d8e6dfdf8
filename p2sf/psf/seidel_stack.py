"""Many PSFs at once, each on about as many pupil samples as its own phase needs.

One PSF of steep phase must not slow down a whole stack: PSFs of one n'u'/λ are sorted by how steep their phase is
and summed in batches, on the samples that the steepest of a batch needs. A batch shares a kernel, which costs as
much as several PSFs, so smaller batches would save less than they cost.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np
from numpy.typing import DTypeLike

from p2sf.errors import SamplingError
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import bound_of, chords_of, steepest_of
from p2sf.psf._seidel_sum import BATCH, batch_intensities, groups, shape_terms
from p2sf.pupil.quadrature import RowNodes, chord_rows, chords_for, even_count, grid_rows
from p2sf.threads import mapped, one_blas_thread, threads_or_default

PREVIEW_GRID = 128
LARGEST_NODES = 2**25  # of a quarter pupil: some 3000 waves of slope, seconds of work
SORTED_AT_ONCE = 512  # PSFs whose slopes are found together, which takes some mebibytes
NODES_TOGETHER = 2**18  # nodes of quarter pupils that a thread sums at a time: some 5 ms of work

Part = tuple[slice | np.ndarray, RowNodes]
"""Indices of PSFs that are summed together, and their nodes."""


@dataclass(frozen=True)
class SummedStack:
    """PSFs (…, pixels, pixels) of unit sum; their sums and peaks in units of the unaberrated peak; the nodes used."""

    values: np.ndarray
    total: np.ndarray
    peak: np.ndarray
    sampling: Message


def stack_of(
    coefficients: Coefficients,
    pixels: int,
    pixel_um: float,
    quality: str,
    dtype: DTypeLike,
    threads: int | None = None,
) -> SummedStack:
    """Return the PSFs of broadcast coefficients by `_seidel_sum`; SamplingError for too many pupil samples.

    ``threads`` as in `p2sf.threads`; the PSFs are the same on any number of them.
    """
    terms = shape_terms(coefficients)
    shape, terms = terms.shape[:-1], terms.reshape(-1, 5)
    values = np.empty((len(terms), pixels, pixels), dtype)
    total, peak = np.empty(len(terms)), np.empty(len(terms))

    def fill(parts: list[Part]) -> RowNodes:
        for some, rows in parts:
            found = batch_intensities(terms[some], pixels, pixel_um, rows, dtype)
            flat = found.reshape(len(found), -1)
            total[some], peak[some] = np.add.reduce(flat, 1, float), np.maximum.reduce(flat, 1)
            flat /= total[some, None].astype(dtype)
            values[some] = found
        return max((rows for _, rows in parts), key=_size)

    parts = stack_parts(terms, pixels, pixel_um, quality)
    if len(terms) == 1:  # sharing it out would take a tenth of its time
        if threads is not None:
            threads_or_default(threads)  # refuses a number that is none
        with one_blas_thread:
            used = [fill(list(parts))]
    else:
        used = mapped(fill, _shares(parts), threads)
    sampling = Message(
        "{nodes}, {precision}" if len(terms) <= 1 else "up to {nodes}, {precision}",
        nodes=max(used, key=_size).name if used else Message("no nodes"),
        precision=values.dtype.type.__name__,
    )
    return SummedStack(values.reshape(*shape, pixels, pixels), total.reshape(shape), peak.reshape(shape), sampling)


def _size(rows: RowNodes) -> int:
    return rows.weight.size


def _shares(parts: Iterable[Part]) -> Iterator[list[Part]]:
    """Yield parts together, as many as make it worth while to hand them to a thread."""
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
    if len(terms) == 1:
        reach = corner_reach(abs(float(terms[0, 4])), pixels, pixel_um)
        yield slice(None), _rows(_slopes(terms[:, :4], reach, quality)[0], reach, quality)
        return
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
        rows, columns = chords_for(slopes[0], slopes[1], reach, reach / sqrt(2))
    else:
        rows = columns = max(PREVIEW_GRID, even_count(_grid_samples(float(slopes[0]), reach)))
    if rows * columns > 4 * LARGEST_NODES:
        raise SamplingError(
            "a phase slope of {slope:.0f} waves over a window of {cycles:.0f} cycles needs {rows} × {columns} pupil "
            "samples; bring the sensor nearer to the image, stop down, or show a smaller window",
            slope=float(slopes.max()),
            cycles=reach,
            rows=rows,
            columns=columns,
        )
    return chord_rows(rows, columns) if quality == "settled" else grid_rows(rows)
