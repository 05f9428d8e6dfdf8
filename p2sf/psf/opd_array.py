"""The PSF of a wavefront given as an array: a matrix DFT with everything real and every kernel kept.

The pupil of a field along y is even in ξ, so half of it is enough and the kernel across is a cosine; along y the
cosine and the sine of |y| serve both signs. `transform.matrix_dft` is the plain formula this is tested against.
"""

from functools import lru_cache

import numpy as np

from p2sf.conventions import protected
from p2sf.errors import SamplingError
from p2sf.psf._seidel_sum import unfolded
from p2sf.pupil.phasors import cosine_sine


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
    across, up = _kernels(size, float(cycles), int(pixels), np.dtype(dtype))
    right = area[:, size // 2 :]
    parts = up @ (_pupil(opd[:, size // 2 :], right, dtype) @ across)
    even, odd = np.split(parts, 2, axis=1)
    turned = np.stack([-odd[1], odd[0]])  # i times the part odd in y
    return unfolded(even[:, None], turned[:, None], pixels)[0] * dtype(1 / (2 * right.sum()) ** 2)


def _pupil(opd, area, dtype):
    """Return real and imaginary part of area·exp(i2πW), stacked; whole waves are taken off in the array's precision."""
    pupil = cosine_sine(opd.astype(np.result_type(opd, np.float32)), dtype)
    pupil *= area.astype(dtype)
    return pupil


@lru_cache(maxsize=16)
def _kernels(size: int, cycles: float, pixels: int, dtype):
    """Return the kernels (ξ, |x|) and, cos above sin, (|y|, η) for a grid, a scale and a window."""
    cell = (2 * np.arange(size) + 1 - size) / size
    distance = np.arange(pixels // 2 + 1)
    turns = 2 * np.pi * cycles * np.multiply.outer(cell, distance)
    across = 2 * np.cos(turns[size // 2 :])
    up = np.concatenate([np.cos(turns).T, np.sin(turns).T])
    return protected(across.astype(dtype)), protected(up.astype(dtype))
