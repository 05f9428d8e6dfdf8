"""Deconvolution of pictures by the kernels that blurred them (handbook 10.4).

Both methods use the lattice of a plan, so that the kernel varies over the field. The Wiener filter is linear and takes
one step; the Richardson–Lucy iteration keeps the light positive.
"""

from itertools import product

import numpy as np

from p2sf.errors import RequestError
from p2sf.image.blur_operator import BlurOperator
from p2sf.image.lattice import Lattice
from p2sf.image.progress import Progress
from p2sf.pixel_kernels.nodes import hats
from p2sf.threads import for_each, one_blas_thread

# Of the picture's contrast: the error of kernels interpolated between nodes. With it the filter stays
# within 0.2 dB of its best for every noise from 0.001 to 0.02; without, it loses up to 3.3 dB, and with twice the noise
# 2.3 dB (`python -m tests.benchmarks.deblurring`).
KERNEL_ERROR = 0.01
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


@one_blas_thread
def wiener(
    values: np.ndarray, lattice: Lattice, noise: float, watch: Progress | None = None, threads: int | None = None
) -> np.ndarray:
    """Return the picture sharpened by a Wiener filter patch by patch, float32, shape kept.

    ``noise``: its standard deviation on white at 1. The prior is a spectrum falling with 1/f² and the picture's own
    variance (Wiener 1949; Field 1987). Errors of the kernels count as additional independent noise: KERNEL_ERROR of the
    picture's contrast. ``threads`` as in `richardson_lucy`. Raises RequestError for a noise that is not positive.
    """
    if not noise > 0:
        raise RequestError(
            "the noise is {noise:g}; give the standard deviation of the picture's noise, above 0", noise=noise
        )
    values, margin = np.asarray(values, np.float32), 3 * lattice.half
    planes = np.moveaxis(np.pad(values, ((margin, margin), (margin, margin), (0, 0)), mode="symmetric"), -1, 0)
    by_row, by_column = (
        hats(nodes, np.arange(n))
        for nodes, n in zip((lattice.row_nodes, lattice.column_nodes), values.shape[:2], strict=True)
    )
    out, watch = np.zeros((len(planes), *values.shape[:2]), np.float32), watch or Progress()
    watch.expect(len(by_row) * len(by_column))

    def sharpen_patch(node: tuple[int, int]) -> tuple[slice, slice, np.ndarray]:
        down, right = by_row[node[0]], by_column[node[1]]
        rows, columns = support(down), support(right)
        patch = planes[:, rows.start : rows.stop + 2 * margin, columns.start : columns.stop + 2 * margin]
        found = _wiener_filter(patch, lattice.kernels[node[0]][node[1]], noise)
        inner = found[:, margin : found.shape[1] - margin, margin : found.shape[2] - margin]
        return rows, columns, inner * np.outer(down[rows], right[columns]).astype(np.float32)

    def take(patch: tuple[slice, slice, np.ndarray]) -> None:
        rows, columns, found = patch
        out[:, rows, columns] += found
        watch.advance()

    for_each(sharpen_patch, product(range(len(by_row)), range(len(by_column))), take, threads)
    return np.moveaxis(out, 0, -1)


def support(weight: np.ndarray) -> slice:
    """Return the range in which a window is not zero."""
    inside = np.flatnonzero(weight)
    return slice(int(inside[0]), int(inside[-1]) + 1) if inside.size else slice(0, 1)


def _wiener_filter(patch: np.ndarray, kernels: np.ndarray, noise: float) -> np.ndarray:
    """Return conj(H)/(|H|² + N/S) of (channels, rows, columns), about the patch's mean."""
    import scipy.fft

    rows, columns = patch.shape[1:]
    shape = scipy.fft.next_fast_len(rows, real=True), scipy.fft.next_fast_len(columns, real=True)
    transfer = scipy.fft.rfft2(_centre(kernels, shape))
    mean = patch.mean((1, 2), keepdims=True)
    variance = np.maximum(patch.var((1, 2), keepdims=True) - noise**2, noise**2)
    prior = _prior(shape)
    ratio = (noise**2 + KERNEL_ERROR**2 * variance) / (variance * prior)
    padded = np.zeros((len(patch), *shape), np.float32)
    # The edge fades into the mean: an abrupt edge would ring through the whole patch.
    padded[:, :rows, :columns] = (patch - mean) * _fade((rows, columns), 2 * (kernels.shape[-1] // 2))
    spectrum = scipy.fft.rfft2(padded) * np.conj(transfer) / (np.abs(transfer) ** 2 + ratio)
    sharp: np.ndarray = scipy.fft.irfft2(spectrum, shape)[:, : patch.shape[1], : patch.shape[2]] + mean
    return sharp


def _fade(shape: tuple[int, int], width: int) -> np.ndarray:
    """Return a window that rises over ``width`` pixels from every edge, half a cosine."""
    rows, columns = (np.clip((np.minimum(np.arange(n), np.arange(n)[::-1]) + 0.5) / max(width, 1), 0, 1) for n in shape)
    return np.outer(np.sin(np.pi / 2 * rows) ** 2, np.sin(np.pi / 2 * columns) ** 2).astype(np.float32)


def _prior(shape: tuple[int, int]) -> np.ndarray:
    """Return the power of a picture of unit variance per frequency, falling with 1/f²."""
    square = np.fft.fftfreq(shape[0])[:, None] ** 2 + np.fft.rfftfreq(shape[1]) ** 2
    power = 1 / (square + CORNER**2)
    prior: np.ndarray = power / power.mean()
    return prior


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
    if min(values.shape[:2]) < 3:
        raise RequestError("a picture of {shape} pixels; give at least 3 × 3", shape=str(values.shape[:2]))
    down = values[:-2] - 2 * values[1:-1] + values[2:]
    both = np.abs(down[:, :-2] - 2 * down[:, 1:-1] + down[:, 2:])
    quiet = [_quiet(plane) for plane in np.moveaxis(both, -1, 0)]
    return MAD * float(np.sqrt(np.mean(np.square(quiet)))) / MASK_NORM


def photo_noise(values: np.ndarray) -> float:
    """Return `estimated_noise`, at least LEAST_NOISE: what rounding to whole numbers adds, and demosaicing hides."""
    return max(LEAST_NOISE, estimated_noise(values))


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
