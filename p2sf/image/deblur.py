"""Deconvolution of pictures by the kernels that blurred them (handbook 10.4).

Both methods use the lattice of a plan, so that the kernel varies over the field. The Wiener filter is linear and takes
one step; the Richardson–Lucy iteration keeps the light positive.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from math import ceil, sqrt
from typing import NamedTuple

import numpy as np

from p2sf.errors import RequestError
from p2sf.image.blur_operator import BlurOperator
from p2sf.image.lattice import Lattice
from p2sf.image.layers import DepthMap, nearest_open
from p2sf.image.progress import Progress
from p2sf.pixel_kernels.nodes import hats
from p2sf.threads import for_each, one_blas_thread

KERNEL_ERROR = 0.05  # relative L2 error of kernels, interpolated between nodes: what plans usually allow
# Power of what is wrong beyond borders, of the picture's variance there. With 0.1 no picture of
# `tests.long.sharpening` is farther from its scene than before, with 0.01 those far out of focus are.
BORDER_ERROR = 0.1
KINKS = 4.0  # falloff of the spectrum of a line where the slope changes
ALIKE = 0.5  # of the texture's least power: how far real spectra are from a power of f
FALLOFFS = 1.0, 1.5, 2.0, 2.5  # of the power of scenes: texture to edges and natural scenes (Field 1987)
SPECTRUM_SIDE, MOST_BLOCKS, FIT_ROUNDS = 64, 16, 60  # pixels, blocks along a side, steps of a fit
TINY = 1e-12
LEAST_NOISE = 1e-3  # of white, a quarter of a step of 8 bits
DARKEST = 1e-4  # of white: the floor that keeps the Richardson–Lucy ratio finite
MAD = 1.4826  # median absolute deviation to standard deviation of a normal distribution
MASK_NORM = 6.0  # √ of the sum of squares of (1, −2, 1) × (1, −2, 1)
BLOCK, FEWEST_BLOCKS = 16, 20  # pixels a side of the blocks in which noise is estimated, enough for 10 %
QUIET, OF_WHITE_NOISE = (
    0.1,
    0.870,
)  # share of quieter blocks, and in white noise the ratio of that quantile to the median
CORNER = 0.02  # cycles per pixel below which spectra of natural pictures are assumed flat


@dataclass(frozen=True)
class PhotoStatistics:
    """What is known of a photo before it is sharpened: its noise lies between ``low`` and ``high``, white at 1.

    Of each channel, the power of the scene falls with spatial frequency to the power in ``falloffs``, and has the
    variance of the photo times ``strengths``: of slow shades a photo may have more than such a spectrum, or of edges.
    """

    low: float
    high: float
    falloffs: tuple[float, ...]
    strengths: tuple[float, ...]


def photo_statistics(values: np.ndarray, lattice: Lattice, noise: float | None = None) -> PhotoStatistics:
    """Return what a photo and its kernels tell of its noise and its spectrum; ``noise`` if that is known.

    The mean spectrum of the photo is fitted by a·|H|²/(f² + CORNER²)^(falloff/2) + σ² (maximum likelihood of
    exponentially distributed powers, Whittle 1953). Texture and noise look alike where the model's texture is no
    weaker than the noise at any frequency: σ² is known only to ALIKE of its least power. `estimated_noise` is too
    large at worst, since texture adds to it. Raises RequestError for a noise that is not positive, and for fewer than
    4 × 4 pixels, which have no spectrum beside the mean.
    """
    _check_size(values, 4)
    if noise is not None and not noise > 0:
        raise RequestError(
            "the noise is {noise:g}; give the standard deviation of the picture's noise, above 0", noise=noise
        )
    fits = [_fit_spectrum(values[..., channel], lattice, channel, noise) for channel in range(values.shape[-1])]
    falloffs, squares, leasts, scales = zip(*fits, strict=True)
    variances = np.maximum(values.var((0, 1)), TINY).tolist()
    strengths = tuple(scale / variance for scale, variance in zip(scales, variances, strict=True))
    if noise is not None:
        return PhotoStatistics(noise, noise, falloffs, strengths)
    square, least = float(np.mean(squares)), float(np.mean(leasts))
    high = max(LEAST_NOISE, min(estimated_noise(values), sqrt(square + ALIKE * least)))
    # A fit that finds more noise than there can be has a scene of another spectrum, and no lower bound.
    low = sqrt(max(0.0, square - ALIKE * least)) if square <= high**2 else 0.0
    return PhotoStatistics(low, high, falloffs, strengths)


class SpectrumFit(NamedTuple):
    """What a photo's spectrum tells of one channel.

    The ``falloff`` of the scene's, the ``square`` of the noise, the ``least`` power of the scene's share, and the
    scene's variance, its ``scale``.
    """

    falloff: float
    square: float
    least: float
    scale: float


def _fit_spectrum(plane: np.ndarray, lattice: Lattice, channel: int, noise: float | None) -> SpectrumFit:
    """Return the fit of the mean spectrum of one channel.

    All that a known ``noise`` does not explain is the scene's.
    """
    power = _mean_spectrum(plane, max(SPECTRUM_SIDE, 4 * lattice.half))
    shape = power[1]
    transfers = (
        np.abs(np.fft.rfft2(_centre(lattice.kernels[a][b][[channel]], shape)[0])) ** 2
        for a in {0, len(lattice.row_nodes) // 2, len(lattice.row_nodes) - 1}
        for b in {0, len(lattice.column_nodes) // 2, len(lattice.column_nodes) - 1}
    )
    passed, used = np.mean(list(transfers), axis=0), np.ones(power[0].shape, bool)
    used[[0, 1, -1], :2] = False  # the mean, and what the window makes of slopes
    found = power[0][used] + TINY  # a frequency without any power has no logarithm
    fits = []
    for falloff in FALLOFFS:
        shape_of = (passed * _prior(shape, falloff))[used]
        scale = float(np.median(found) / np.median(shape_of))
        square = float(np.quantile(found, 0.02)) if noise is None else noise**2
        for _ in range(FIT_ROUNDS):  # multiplicative steps of Févotte, Bertin and Durrieu 2009, eq. 26
            model = scale * shape_of + square
            scale *= sqrt(float((found * shape_of / model**2).sum() / (shape_of / model).sum()))
            if noise is None:
                square *= sqrt(float((found / model**2).sum() / (1 / model).sum()))
        model = scale * shape_of + square
        likelihood = float((np.log(model) + found / model).sum())
        fits.append((likelihood, falloff, square, scale * float(shape_of.min()), scale))
    return SpectrumFit(*min(fits)[1:])


def _mean_spectrum(plane: np.ndarray, side: int) -> tuple[np.ndarray, tuple[int, int]]:
    """Return the mean power of blocks that overlap by half, of unit variance for white noise, and their shape.

    P. D. Welch, IEEE Trans. Audio Electroacoust. 15, 1967; Hann's window.
    """
    sides = min(side, plane.shape[0]), min(side, plane.shape[1])
    window = np.outer(*(np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 2 for n in sides))
    starts = [
        np.unique(np.linspace(0, count - n, max(1, min(MOST_BLOCKS, 2 * count // n - 1))).astype(int)).tolist()
        for count, n in zip(plane.shape, sides, strict=True)
    ]
    total, blocks = np.zeros((sides[0], sides[1] // 2 + 1)), list(product(*starts))
    for top, left in blocks:
        block = plane[top : top + sides[0], left : left + sides[1]]
        total += np.abs(np.fft.rfft2((block - (block * window).sum() / window.sum()) * window)) ** 2
    return total / (len(blocks) * np.square(window).sum()), sides


@one_blas_thread
def wiener(
    values: np.ndarray,
    lattice: Lattice,
    noise: float | PhotoStatistics,
    watch: Progress | None = None,
    threads: int | None = None,
    known: np.ndarray | None = None,
) -> np.ndarray:
    """Return the picture sharpened by a Wiener filter patch by patch, float32, shape kept.

    ``noise``: its standard deviation on white at 1, or what `photo_statistics` tells. ``known``, (rows, columns): the
    pixels that these kernels blurred; all by default. ``threads`` as in `richardson_lucy`. Raises RequestError for a
    noise that is not positive.

    Between the filter for the least noise and that for the most, the one taken at each frequency is the nearest to
    leaving the picture as it is. The expected error is quadratic in the filter, with its minimum at the true noise's:
    so whatever the noise between these ends, no frequency is expected to be farther from the scene than before.
    """
    values, margin = np.asarray(values, np.float32), 3 * lattice.half
    about = noise if isinstance(noise, PhotoStatistics) else photo_statistics(values, lattice, noise)
    around = (margin, margin), (margin, margin)
    planes = np.moveaxis(np.pad(values, (*around, (0, 0)), mode="symmetric"), -1, 0)
    told = np.pad(np.ones(values.shape[:2], bool) if known is None else known, around)
    by_row, by_column = (
        hats(nodes, np.arange(n))
        for nodes, n in zip((lattice.row_nodes, lattice.column_nodes), values.shape[:2], strict=True)
    )
    out, watch = np.zeros((len(planes), *values.shape[:2]), np.float32), watch or Progress()
    watch.expect(len(by_row) * len(by_column))

    def sharpen_patch(node: tuple[int, int]) -> tuple[slice, slice, np.ndarray]:
        down, right = by_row[node[0]], by_column[node[1]]
        rows, columns = support(down), support(right)
        wide = np.s_[rows.start : rows.stop + 2 * margin, columns.start : columns.stop + 2 * margin]
        guessed = 1 - float(told[wide].mean())
        found = _wiener_filter(planes[:, *wide], lattice.kernels[node[0]][node[1]], about, guessed)
        inner = found[:, margin : found.shape[1] - margin, margin : found.shape[2] - margin]
        return rows, columns, inner * np.outer(down[rows], right[columns]).astype(np.float32)

    def take(patch: tuple[slice, slice, np.ndarray]) -> None:
        rows, columns, found = patch
        out[:, rows, columns] += found
        watch.advance()

    for_each(sharpen_patch, product(range(len(by_row)), range(len(by_column))), take, threads)
    return np.moveaxis(out, 0, -1)


def wiener_by_depth(
    values: np.ndarray,
    depths: DepthMap,
    lattice_of: Callable[[int], Lattice],
    noise: float | None,
    watch: Progress | None = None,
) -> np.ndarray:
    """Return a picture with a map of depths sharpened by the kernels of each depth, as `wiener` does.

    ``lattice_of`` a depth node's number. Each node's filter sees its own pixels alone, beyond which the nearest of them
    go on, and between two nodes the two results are interpolated as kernels are. Beside jumps in depth
    (`DepthMap.continued`) pixels have light of both sides, which no kernel tells apart: these stay as they are.
    """
    values = np.asarray(values, np.float32)
    beside, out = depths.continued[..., None], np.zeros_like(values)
    for number in range(int(depths.place.min()), ceil(depths.place.max()) + 1):
        share = np.clip(1 - np.abs(depths.place - number), 0, 1)
        own = (share > 0) & ~depths.continued
        if own.any():
            seen, lattice = values[nearest_open(~own)], lattice_of(number)
            found = wiener(seen, lattice, photo_statistics(seen, lattice, noise), watch, known=own)
            out += share[..., None] * found
    return np.where(beside, values, out)


def support(weight: np.ndarray) -> slice:
    """Return the range in which a window is not zero."""
    inside = np.flatnonzero(weight)
    return slice(int(inside[0]), int(inside[-1]) + 1) if inside.size else slice(0, 1)


def _wiener_filter(patch: np.ndarray, kernels: np.ndarray, about: PhotoStatistics, guessed: float) -> np.ndarray:
    """Return conj(H)/(|H|² + N/S) of (channels, rows, columns), about the patch's mean, as `wiener` has it.

    ``guessed``: the share of pixels that are mirrored at a border. What is wrong in them has kinks, whose spectrum
    falls with 1/f⁴, and counts as noise; so do errors of the kernels, which are in proportion to the scene.
    """
    import scipy.fft

    rows, columns = patch.shape[1:]
    shape = scipy.fft.next_fast_len(rows, real=True), scipy.fft.next_fast_len(columns, real=True)
    transfer = scipy.fft.rfft2(_centre(kernels, shape))
    square = np.abs(transfer) ** 2
    mean, variance = patch.mean((1, 2), keepdims=True), patch.var((1, 2), keepdims=True)
    strength = np.array(about.strengths)[:, None, None] * variance + TINY
    scene = strength * np.stack([_prior(shape, falloff) for falloff in about.falloffs])
    wrong = KERNEL_ERROR**2 * np.square(kernels).sum((1, 2))[:, None, None]  # of |H|², by Parseval
    border = BORDER_ERROR * guessed * variance * _prior(shape, KINKS)
    modulus = np.sqrt(square)
    weak = modulus / (square + (about.high**2 + border) / scene + wrong)
    strong = modulus / (square + about.low**2 / scene + TINY)
    gain = np.clip(1, weak, np.maximum(weak, strong))
    padded = np.zeros((len(patch), *shape), np.float32)
    # The edge fades into the mean: an abrupt edge would ring through the whole patch.
    padded[:, :rows, :columns] = (patch - mean) * _fade((rows, columns), 2 * (kernels.shape[-1] // 2))
    spectrum = scipy.fft.rfft2(padded) * gain * np.conj(transfer) / np.maximum(modulus, TINY)
    sharp: np.ndarray = scipy.fft.irfft2(spectrum, shape)[:, : patch.shape[1], : patch.shape[2]] + mean
    return sharp


def _fade(shape: tuple[int, int], width: int) -> np.ndarray:
    """Return a window that rises over ``width`` pixels from every edge, half a cosine."""
    rows, columns = (np.clip((np.minimum(np.arange(n), np.arange(n)[::-1]) + 0.5) / max(width, 1), 0, 1) for n in shape)
    return np.outer(np.sin(np.pi / 2 * rows) ** 2, np.sin(np.pi / 2 * columns) ** 2).astype(np.float32)


def _prior(shape: tuple[int, int], falloff: float) -> np.ndarray:
    """Return the power of a picture of unit variance per frequency, falling with 1/f to the ``falloff``."""
    square = np.fft.fftfreq(shape[0])[:, None] ** 2 + np.fft.rfftfreq(shape[1]) ** 2
    power = (square + CORNER**2) ** (-falloff / 2)
    prior: np.ndarray = power / _plane_mean(power, shape)
    return prior


def _plane_mean(half: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Return the mean over all frequencies of a plane whose real transform has (…, rows, columns // 2 + 1) of them."""
    twice = np.full(half.shape[-1], 2.0)
    twice[0] = 1.0
    if shape[1] % 2 == 0:
        twice[-1] = 1.0
    mean: np.ndarray = (half * twice).sum((-2, -1), keepdims=True) / (shape[0] * shape[1])
    return mean


def _centre(kernels: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Return kernels, (channels, size, size), with their middle at index 0 of a periodic plane."""
    half = kernels.shape[-1] // 2
    plane = np.zeros((len(kernels), *shape), np.float32)
    rows, columns = (np.arange(-half, half + 1) % n for n in shape)
    np.add.at(plane, np.ix_(np.arange(len(kernels)), rows, columns), kernels)
    return plane


@one_blas_thread
def richardson_lucy(
    values: np.ndarray,
    lattice: Lattice,
    rounds: int = 30,
    watch: Progress | None = None,
    threads: int | None = None,
) -> np.ndarray:
    """Return the picture after ``rounds`` of x ← x·Hᵀ(y/Hx)/Hᵀ1 (Richardson 1972; Lucy 1974), float32, not negative.

    H is the space-variant blur, cut off at the picture's edge; ``threads`` (`p2sf.threads`) share its blocks, and the
    picture is the same on any number. Raises RequestError for fewer than one round.
    """
    if rounds < 1:
        raise RequestError("{rounds} rounds of Richardson–Lucy; give at least 1", rounds=rounds)
    measured = np.maximum(np.asarray(values, np.float32), 0)
    blur = BlurOperator(lattice, (measured.shape[0], measured.shape[1]), threads)
    estimate = np.maximum(measured, DARKEST)
    gain = np.maximum(blur.transposed(np.ones_like(measured)), DARKEST)
    watch = watch or Progress()
    watch.expect(rounds)
    for _ in range(rounds):
        blurred = np.maximum(blur.forward(estimate), DARKEST)
        # Rounding in the transforms may leave a dark pixel slightly below zero.
        estimate = np.maximum(estimate * blur.transposed(measured / blurred) / gain, 0)
        watch.advance()
    return estimate


def estimated_noise(values: np.ndarray) -> float:
    """Return the standard deviation of a picture's noise, (rows, columns, channels), in its own unit.

    The difference of two Laplacians, a mask that edges and slopes hardly pass (Immerkær 1996), in the quiet parts of
    the picture: texture only ever adds to noise, so the median of a block is taken, which lines in it do not move, and
    of all blocks the tenth quietest, as white noise would have it. Blocks without any noise are clipped, and left out.
    The channels' estimates are averaged as variances. Noise must differ from pixel to pixel: what demosaicing smoothed
    is underestimated. Raises RequestError for fewer than 3 × 3 pixels.
    """
    _check_size(values, 3)
    down = values[:-2] - 2 * values[1:-1] + values[2:]
    both = np.abs(down[:, :-2] - 2 * down[:, 1:-1] + down[:, 2:])
    quiet = [_quiet(plane) for plane in np.moveaxis(both, -1, 0)]
    return MAD * float(np.sqrt(np.mean(np.square(quiet)))) / MASK_NORM


def _check_size(values: np.ndarray, least: int) -> None:
    if min(values.shape[:2]) < least:
        raise RequestError(
            "a picture of {shape} pixels; give at least {least} × {least}", shape=str(values.shape[:2]), least=least
        )


def _quiet(plane: np.ndarray) -> float:
    """Return the median of white noise's size that the quiet blocks of a plane (rows, columns) suggest."""
    rows, columns = (count // BLOCK for count in plane.shape)
    if rows * columns < FEWEST_BLOCKS:
        return float(np.median(plane[plane > 0])) if plane.any() else 0.0
    blocks = plane[: rows * BLOCK, : columns * BLOCK].reshape(rows, BLOCK, columns, BLOCK)
    medians = np.median(blocks, axis=(1, 3)).ravel()
    noisy = medians[medians > 0]
    return float(np.quantile(noisy, QUIET)) / OF_WHITE_NOISE if noisy.size else 0.0


def with_one_kernel(lattice: Lattice, kernels: np.ndarray) -> Lattice:
    """Return a lattice with one kernel (channels, size, size) at every node: a wrong PSF, for comparison."""
    return Lattice(lattice.row_nodes, lattice.column_nodes, [[kernels for _ in line] for line in lattice.kernels])


def psnr(values: np.ndarray, truth: np.ndarray) -> float:
    """Return the peak signal-to-noise ratio in dB, white at 1."""
    return float(-10 * np.log10(np.mean(np.square(np.asarray(values, float) - truth))))
