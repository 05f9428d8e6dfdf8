"""Sums from pupil to focal plane: a direct sum over nodes, a matrix DFT, and the padded FFT of the paper.

Large sums over nodes and samples use a non-uniform FFT (Barnett, Magland & af Klinteberg 2019, finufft). All share one
sign: field(x, y) = Σ amplitude · exp(+2πi(kx·x + ky·y)), k in cycles per µm. A pupil point (ξ, η) has k = −n'u'(ξ, η)/λ
with the signed slope (`conventions`).

See handbook 4.1.
"""

from functools import lru_cache, partial
from math import prod
from threading import local
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from p2sf.disc.phasors import cosine_sine
from p2sf.errors import SamplingError

# Nodes per block of the direct sum: large enough for BLAS, small enough to stay in the cache.
BLOCK = 4096
MOST_PRODUCTS = 2**20  # nodes × samples above which a non-uniform FFT is faster
NUFFT_ERROR = {np.dtype(np.float64): 1e-14, np.dtype(np.float32): 1e-6}
# Least that a grid 1.25 times as fine as the samples allows, where 2 times is slow. In float32 places are rounded to
# some 1e-5 of a turn at the ends of 500 samples anyway.
COARSE_ERROR = {np.dtype(np.float64): 1e-9, np.dtype(np.float32): 5e-5}
MANY_SAMPLES = 2**15  # beyond which that one is taken; in float64 a picture then errs by its square, 1e-18, in R²
FEW_SAMPLES = 128 * 129  # up to which a plan, which takes as long as a sum, is kept
SAMPLES_OF_NODE = 11  # of an even picture, from which on a sum over half of them takes less time
_here = local()  # ``plan`` keeps plans, which hold the nodes of one sum at a time, apart in each thread


def sum_plane_waves(
    amplitude: np.ndarray, kx: np.ndarray, ky: np.ndarray, x: ArrayLike, y: ArrayLike, even: bool = True
) -> np.ndarray:
    """Return Σ_j amplitude_j exp(2πi(kx_j x + ky_j y)), complex, shape (…, len(y), len(x)).

    ``amplitude``, ``kx``, ``ky``: (…, nodes), broadcast; ``x``, ``y``: 1-D, in units of 1/k. ``even``: the nodes
    are one half of a set that is even in kx (folded weights), so the x kernel is a cosine and only |x| matters.
    Precision follows ``kx`` (float32 or float64). On evenly spaced axes, more than MOST_PRODUCTS nodes × samples are
    summed by a non-uniform FFT, to NUFFT_ERROR of the largest sum that these amplitudes could have, of more than
    MANY_SAMPLES samples to COARSE_ERROR. In float32 the rounding of places adds 2e-9 for each sample of an axis.
    """
    amplitude, kx, ky = np.asarray(amplitude), np.asarray(kx), np.asarray(ky)
    square = x is y
    x, y = (np.asarray(axis, dtype=kx.dtype) for axis in (x, y))
    by_transform, block = (_even_nufft, _even_block) if even else (_nufft, _block)
    many = x.size * y.size > 1 and amplitude.shape[-1] * x.size * y.size > MOST_PRODUCTS
    if many and _evenly_spaced(x) and (square or _evenly_spaced(y)):
        return by_transform(amplitude, kx, ky, x, y)
    nodes = amplitude.shape[-1]
    parts = (slice(start, start + BLOCK) for start in range(0, nodes, BLOCK))
    return np.asarray(sum(block(amplitude[..., part], kx[..., part], ky[..., part], x, y) for part in parts))


def _evenly_spaced(axis: np.ndarray) -> bool:
    if axis.size == 1:
        return True
    steps = np.diff(axis)
    rounding = 8 * np.finfo(axis.dtype).eps * np.abs(axis).max(initial=0)
    return bool(steps[0] > 0) and bool(np.ptp(steps) <= rounding)


def _even_nufft(amplitude: np.ndarray, kx: np.ndarray, ky: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return `_nufft` for nodes and their mirror images, of half the amplitude each.

    About x = 0 the images' sum is the mirror image of that of the nodes. x and −x are both samples of an odd number.
    Among many samples, twice the nodes over |x| take less time.
    """
    if not x.any():  # where the images have the waves of the nodes
        return _nufft(amplitude, kx, ky, x, y)
    middle, nodes, half = x.size // 2, amplitude.shape[-1], amplitude / 2
    about_0 = x[middle] == 0
    if about_0 and x.size * y.size < SAMPLES_OF_NODE * nodes:
        wide = x if x.size % 2 else np.append(x, -x[0])
        field = _nufft(half, kx, ky, wide, y)
        even: np.ndarray = field[..., : x.size] + field[..., ::-1][..., : x.size]
        return even
    pairs = (half, half), (kx, -kx), (ky, ky)
    both, across, up = (np.concatenate(pair, axis=-1) for pair in pairs)
    field = _nufft(both, across, up, -x[middle::-1] if about_0 else x, y)
    return np.concatenate([field[..., :0:-1], field[..., : x.size - middle]], axis=-1) if about_0 else field


def _nufft(amplitude: np.ndarray, kx: np.ndarray, ky: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return `sum_plane_waves` over evenly spaced axes by a non-uniform FFT of type 1, one set of nodes at a time."""
    shape = np.broadcast_shapes(amplitude.shape, kx.shape, ky.shape)
    sets = [np.broadcast_to(array, shape).reshape(-1, shape[-1]) for array in (amplitude, kx, ky)]
    steps = [2 * np.pi * (axis[-1] - axis[0]) / max(1, axis.size - 1) for axis in (x, y)]
    middle = float(x[x.size // 2]), float(y[y.size // 2])  # position of Fourier mode 0
    modes = tuple(axis.size for axis in (y, x) if axis.size > 1)
    transform = _plan(modes, kx.dtype)
    fields = np.empty((len(sets[0]), y.size, x.size), np.result_type(kx.dtype, np.complex64))
    for field, weight, across, up in zip(fields, *sets, strict=True):
        if any(middle):
            cycles = np.multiply(across, middle[0], dtype=float) + np.multiply(up, middle[1], dtype=float)
            weight = weight * np.exp(2j * np.pi * cycles)
        turns = [np.ascontiguousarray(k) * step for k, step in ((up, steps[1]), (across, steps[0])) if step]
        transform.setpts(*turns)
        transform.execute(weight.astype(fields.dtype), out=field.reshape(modes))
    return fields.reshape(*shape[:-1], y.size, x.size)


def _plan(modes: tuple[int, ...], dtype: np.dtype) -> Any:
    """Return a finufft plan for these Fourier modes and nodes of this precision."""
    if prod(modes) > FEW_SAMPLES:
        return _new_plan(modes, dtype)
    if not hasattr(_here, "plan"):
        _here.plan = lru_cache(maxsize=8)(_new_plan)
    return _here.plan(modes, dtype)


def _new_plan(modes: tuple[int, ...], dtype: np.dtype) -> Any:
    import finufft

    exact = prod(modes) <= MANY_SAMPLES
    return finufft.Plan(
        1,
        modes,
        eps=(NUFFT_ERROR if exact else COARSE_ERROR)[dtype],
        isign=1,
        dtype=np.result_type(dtype, np.complex64).name,
        nthreads=1,
        upsampfac=2.0 if exact else 1.25,
        spread_sort=0,  # nodes of one ring or line are neighbours already
    )


def _block(
    amplitude: np.ndarray, kx: np.ndarray, ky: np.ndarray, x: np.ndarray, y: np.ndarray, kernels: int = 2
) -> np.ndarray:
    """Return the block's sum from one real product at |x|, |y|: a(c + is)(c' + is') with the signs of x and y.

    ``kernels``: the number of kernels along x, cosine alone or cosine and sine.
    """
    columns, from_column = np.unique(np.abs(x), return_inverse=True)
    rows, from_row = np.unique(np.abs(y), return_inverse=True)
    waves = cosine_sine(kx[..., :, None] * columns, kx.dtype)[:kernels]
    both = np.concatenate([*cosine_sine(rows[:, None] * ky[..., None, :], ky.dtype)], axis=-2)
    parts = [part[..., None] * wave for wave in waves for part in (amplitude.real, amplitude.imag)]
    table, high = both @ np.concatenate(parts, axis=-1), rows.size
    table = table.reshape(*table.shape[:-1], len(waves), 2, columns.size)
    sums = table[..., 0, :] + 1j * table[..., 1, :]  # (…, cosines and then sines of y, cosine and sine of x, columns)
    above = (1j * np.sign(y)).astype(sums.dtype)[:, None, None]
    sums = sums[..., :high, :, :][..., from_row, :, :] + above * sums[..., high:, :, :][..., from_row, :, :]
    field: np.ndarray = sums[..., 0, :][..., from_column]
    for sine in np.moveaxis(sums, -2, 0)[1:]:
        field = field + (1j * np.sign(x)).astype(sums.dtype) * sine[..., from_column]
    return field


_even_block = partial(_block, kernels=1)


def _wave(cycles: np.ndarray) -> np.ndarray:
    cosine, sine = cosine_sine(np.array(cycles, dtype=float), np.float64)
    wave: np.ndarray = cosine + 1j * sine
    return wave


def matrix_dft(pupil: np.ndarray, kx: ArrayLike, ky: ArrayLike, x: ArrayLike, y: ArrayLike) -> np.ndarray:
    """Return Σ pupil_ji exp(2πi(kx_i x + ky_j y)) on a grid, shape (…, len(y), len(x)): two matrix products.

    ``pupil``: (…, len(ky), len(kx)); any pitch and any size on either side (Soummer et al. 2007, eq. 7).
    """
    up, across = (_wave(np.multiply.outer(a, b)) for a, b in ((y, ky), (kx, x)))
    field: np.ndarray = up @ pupil @ across
    return field


def padded_fft(pupil: np.ndarray, pupil_samples: int, pixels: int) -> np.ndarray:
    """Return the same sum by FFT, for kx = j/(pupil_samples·pitch), j centred, at the pitch of x, as in the paper.

    ``pupil``: (…, side, side), side even, sample side//2 is j = 0. Returns (…, pixels, pixels), sample pixels//2 is x =
    0. A pupil wider than ``pupil_samples`` is folded onto itself, which does not change the sum at these x, so that any
    pitch is allowed. Source: Pieroni et al. 2015. Raises SamplingError.
    """
    check_fft(pupil_samples, pixels)
    plane: np.ndarray = np.fft.ifft2(_wrap(pupil, pupil_samples), norm="forward")
    shown = np.arange(pixels) - pixels // 2
    return plane[..., shown[:, None], shown]


def check_fft(pupil_samples: int, pixels: int) -> None:
    """Raise SamplingError unless ``pixels`` is even and ``pupil_samples`` even and at least twice as large."""
    if pixels % 2:
        raise SamplingError(
            "an FFT needs an even number of PSF samples, not {pixels}; add one or use mdft", pixels=pixels
        )
    if pupil_samples % 2 or pupil_samples < 2 * pixels:
        raise SamplingError(
            "{pupil_samples} pupil samples are too few for {pixels} PSF samples by FFT; "
            "give an even number of at least {least}",
            pupil_samples=pupil_samples,
            pixels=pixels,
            least=2 * pixels,
        )


def _wrap(pupil: np.ndarray, size: int) -> np.ndarray:
    """Return the pupil on ``size``² samples, index 0 at its centre: padded with zeros, or folded if it is wider."""
    side = pupil.shape[-1]
    times = -(-side // size)
    before = (times * size - side) // 2
    padding = [(0, 0)] * (pupil.ndim - 2) + [(before, times * size - side - before)] * 2
    blocks = np.pad(pupil, padding).reshape(*pupil.shape[:-2], times, size, times, size)
    centre = before + side // 2
    return np.roll(blocks.sum((-4, -2)), (-centre, -centre), (-2, -1))


def newton_step(sums: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return |E|², (…,), Newton's step towards its maximum, (…, 2), and the gain expected of it.

    ``sums``: of plane waves at a point times 1, fx, fy, fx², fx·fy and fy², (…, 6). Where |E|² is not concave, the step
    is along its gradient.
    """
    # E′ = 2πi Σ f·wave and E″ = −4π² Σ f²·wave; of |E|², half of its derivatives, in units of 2π.
    field, by_x, by_y, by_xx, by_xy, by_yy = np.moveaxis(sums, -1, 0)
    back = field.conjugate()
    slope_x, slope_y = -(back * by_x).imag, -(back * by_y).imag
    bend_x, bend_y = np.abs(by_x) ** 2 - (back * by_xx).real, np.abs(by_y) ** 2 - (back * by_yy).real
    bend_xy = (by_x.conjugate() * by_y).real - (back * by_xy).real
    determinant = bend_x * bend_y - bend_xy**2
    concave = (bend_x < 0) & (determinant > 0)
    steepest, safe = np.maximum(np.abs(bend_x) + np.abs(bend_y), 1e-300), np.where(concave, determinant, 1.0)
    step_x = np.where(concave, (bend_xy * slope_y - bend_y * slope_x) / safe, slope_x / steepest)
    step_y = np.where(concave, (bend_xy * slope_x - bend_x * slope_y) / safe, slope_y / steepest)
    gain = slope_x * step_x + slope_y * step_y
    return np.abs(field) ** 2, np.stack([step_x, step_y], -1) / (2 * np.pi), gain
