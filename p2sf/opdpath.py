"""The PSF of a wavefront given as an array: a matrix DFT with everything real and every kernel kept.

The pupil of a field along y is even in ξ, so half of it is enough and the kernel across is a cosine; along y the
cosine and the sine of |y| serve both signs. `transform.matrix_dft` is the plain formula this is tested against.
"""

from functools import lru_cache

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.errors import SamplingError


def opd_intensity(opd_waves, area, cycles: float, pixels: int, dtype=np.float32) -> np.ndarray:
    """Return |Σ area·exp(i2πW + 2πi·cycles(ξx + ηy))|²/(Σ area)², (pixels, pixels), 1 at an unaberrated peak.

    ``opd_waves``: W in waves on a square grid of cell centres over −1…1, (size, size), rows η, even in ξ; only the
    half ξ > 0 is read. ``area``: how much of each cell the pupil covers, same shape. ``cycles``: n'u'-signed NA·pixel/λ
    (`fastpath.wave_number` times the pitch). ``dtype``: precision behind the reduced phase. Raises SamplingError
    for a grid that is not square and even-sized.
    """
    opd, area = np.asarray(opd_waves), np.asarray(area)
    size = opd.shape[-1]
    if opd.shape != (size, size) or size % 2 or area.shape != opd.shape:
        raise SamplingError(f"a wavefront of {opd.shape} with areas of {area.shape}; give two equal even squares")
    across, up, rows, columns = _kernels(size, float(cycles), int(pixels), np.dtype(dtype))
    real, imaginary = _pupil(opd[:, size // 2 :], area[:, size // 2 :], dtype)
    part = up @ np.concatenate([real @ across, imaginary @ across], axis=1)
    half = len(part) // 2
    (even_real, even_imaginary), (odd_real, odd_imaginary) = (
        np.split(p, 2, axis=1) for p in (part[:half], part[half:])
    )
    above = (even_real - odd_imaginary) ** 2 + (even_imaginary + odd_real) ** 2
    below = (even_real + odd_imaginary) ** 2 + (even_imaginary - odd_real) ** 2
    values = np.where(centred_axis(pixels)[:, None] < 0, below[rows], above[rows])[:, columns]
    return values * dtype(1 / (2 * area[:, size // 2 :].sum()) ** 2)


def _pupil(opd, area, dtype):
    """Return real and imaginary part of area·exp(i2πW); whole waves are taken off in the array's own precision."""
    turn = ((opd - np.rint(opd)) * (2 * np.pi)).astype(dtype)
    weight = area.astype(dtype)
    return weight * np.cos(turn), weight * np.sin(turn)


@lru_cache(maxsize=16)
def _kernels(size: int, cycles: float, pixels: int, dtype):
    """Return (across, cos and sin up, row of |y|, column of |x|) for a grid, a scale and a window."""
    cell = (2 * np.arange(size) + 1 - size) / size
    distance = np.arange(pixels // 2 + 1)
    turns = 2 * np.pi * cycles * np.multiply.outer(cell, distance)
    across = 2 * np.cos(turns[size // 2 :])
    up = np.concatenate([np.cos(turns).T, np.sin(turns).T])
    fold = np.abs(np.arange(pixels) - pixels // 2)
    return across.astype(dtype), up.astype(dtype), fold, fold
