"""The PSF of a wavefront given as an array: a matrix DFT in real arithmetic with cached kernels.

The pupil of a field along y is even in ξ, so half of it is enough and the kernel across is a cosine; along y the
cosine and the sine of |y| serve both signs. It is tested against the plain formula, `transform.matrix_dft`.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import write_protect
from p2sf.disc.phasors import cosine_sine
from p2sf.errors import SamplingError
from p2sf.psf.seidel_sum import unfold

Precision = type[np.float32] | type[np.float64]


def opd_intensity(
    opd_waves: ArrayLike, area: ArrayLike, cycles: float, pixels: int, dtype: Precision = np.float32
) -> np.ndarray:
    """Return |Σ area·exp(i2πW + 2πi·cycles(ξx + ηy))|²/(Σ area)², (pixels, pixels), 1 at an unaberrated peak.

    ``opd_waves``: W in waves on a square grid of cell centres over −1…1, (size, size), rows η, even in ξ; only the
    half ξ > 0 is read. ``area``: how much of each cell the pupil covers, same shape. ``cycles``: NA·pixel/λ with the
    sign of −n'u' (`wave_number` times the pitch). ``dtype``: precision after the reduced phase. Raises SamplingError
    for a grid that is not square and even-sized.
    """
    opd, cells = np.asarray(opd_waves), np.asarray(area)
    size = opd.shape[-1]
    if opd.shape != (size, size) or size % 2 or cells.shape != opd.shape:
        raise SamplingError(
            "a wavefront of {shape} with areas of {areas}; give two equal even squares",
            shape=str(opd.shape),
            areas=str(cells.shape),
        )
    across, up = _kernels(size, float(cycles), int(pixels), np.dtype(dtype))
    right = cells[:, size // 2 :]
    parts = up @ (_pupil(opd[:, size // 2 :], right, dtype) @ across)
    even, odd = np.split(parts, 2, axis=1)
    turned = np.stack([-odd[1], odd[0]])  # i times the part odd in y
    intensity: np.ndarray = unfold(even[:, None], turned[:, None], pixels)[0] * dtype(1 / (2 * right.sum()) ** 2)
    return intensity


def _pupil(opd: np.ndarray, area: np.ndarray, dtype: Precision) -> np.ndarray:
    """Return the real and the imaginary part of area·exp(i2πW); whole waves are subtracted in the array's precision."""
    pupil = cosine_sine(opd.astype(np.result_type(opd, np.float32)), dtype)
    pupil *= area.astype(dtype)
    return pupil


@lru_cache(maxsize=16)
def _kernels(size: int, cycles: float, pixels: int, dtype: np.dtype) -> tuple[np.ndarray, np.ndarray]:
    """Return the kernels (ξ, |x|) and, cos above sin, (|y|, η) for a grid, a scale and a window."""
    cell = (2 * np.arange(size) + 1 - size) / size
    distance = np.arange(pixels // 2 + 1)
    phase = 2 * np.pi * cycles * np.multiply.outer(cell, distance)
    across = 2 * np.cos(phase[size // 2 :])
    up = np.concatenate([np.cos(phase).T, np.sin(phase).T])
    return write_protect(across.astype(dtype)), write_protect(up.astype(dtype))
