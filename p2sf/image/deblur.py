"""What knowing the PSF buys: pictures sharpened by the same kernels that blurred them.

Both ways work on the lattice of a plan, so the kernel follows the field. Wiener's filter is linear and done at
once; Richardson and Lucy's iteration keeps the light positive.
"""

from collections.abc import Callable

import numpy as np

from p2sf.errors import RequestError
from p2sf.image.lattice import Lattice
from p2sf.image.overlap import convolve, overlap_add
from p2sf.image.progress import Progress
from p2sf.pixel_kernels.nodes import hats

DARKEST = 1e-4  # of white: the floor that keeps Richardson–Lucy's ratio finite
CORNER = 0.02  # cycles per pixel below which natural pictures' spectra are taken as flat


def wiener(values: np.ndarray, lattice: Lattice, noise: float, watch: Progress | None = None) -> np.ndarray:
    """Return the picture sharpened by Wiener's filter patch by patch, float32, shape kept.

    ``noise``: its standard deviation on white at 1. The prior is a spectrum falling with 1/f² and the picture's own
    variance (Wiener 1949; Field 1987). Raises RequestError for a noise that is not positive.
    """
    if not noise > 0:
        raise RequestError(f"the noise is {noise:g}; give the standard deviation of the picture's noise, above 0")
    return _by_patches(
        values, lattice, lambda patch, kernels: _filtered(patch, kernels, noise), watch, 3 * lattice.half
    )


def _filtered(patch: np.ndarray, kernels: np.ndarray, noise: float) -> np.ndarray:
    """Return conj(H)/(|H|² + N/S) of (channels, rows, columns), about the patch's mean."""
    import scipy.fft

    shape = tuple(scipy.fft.next_fast_len(n, real=True) for n in patch.shape[1:])
    transfer = scipy.fft.rfft2(_centred(kernels, shape))
    mean = patch.mean((1, 2), keepdims=True)
    variance = np.maximum(patch.var((1, 2), keepdims=True) - noise**2, noise**2)
    prior = _prior(shape)
    ratio = noise**2 / (variance * prior)
    padded = np.zeros((len(patch), *shape), np.float32)
    # The rim fades into the mean: a cut edge would ring through the whole patch.
    padded[:, : patch.shape[1], : patch.shape[2]] = (patch - mean) * _fade(
        patch.shape[1:], 2 * (kernels.shape[-1] // 2)
    )
    spectrum = scipy.fft.rfft2(padded) * np.conj(transfer) / (np.abs(transfer) ** 2 + ratio)
    return scipy.fft.irfft2(spectrum, shape)[:, : patch.shape[1], : patch.shape[2]] + mean


def _fade(shape, width: int) -> np.ndarray:
    """Return a window that rises over ``width`` pixels from every rim, half a cosine."""
    rows, columns = (np.clip((np.minimum(np.arange(n), np.arange(n)[::-1]) + 0.5) / max(width, 1), 0, 1) for n in shape)
    return np.outer(np.sin(np.pi / 2 * rows) ** 2, np.sin(np.pi / 2 * columns) ** 2).astype(np.float32)


def _prior(shape) -> np.ndarray:
    """Return the power of a picture of unit variance per frequency, falling with 1/f²."""
    square = np.fft.fftfreq(shape[0])[:, None] ** 2 + np.fft.rfftfreq(shape[1]) ** 2
    power = 1 / (square + CORNER**2)
    return power / power.mean()


def _centred(kernels: np.ndarray, shape) -> np.ndarray:
    """Return kernels with their middle at index 0 of a periodic plane."""
    half = kernels.shape[-1] // 2
    plane = np.zeros((len(kernels), *shape), np.float32)
    rows, columns = (np.arange(-half, half + 1) % n for n in shape)
    np.add.at(plane, (slice(None), rows[:, None], columns), kernels)
    return plane


def _by_patches(values, lattice: Lattice, act: Callable, watch: Progress | None, margin: int) -> np.ndarray:
    """Return Σ window·act(patch with a margin, kernels) over all nodes, the rim mirrored outwards."""
    values, watch = np.asarray(values, np.float32), watch or Progress()
    rows, columns, _ = values.shape
    planes = np.moveaxis(np.pad(values, ((margin, margin), (margin, margin), (0, 0)), mode="symmetric"), -1, 0)
    by_row, by_column = hats(lattice.row_nodes, np.arange(rows)), hats(lattice.column_nodes, np.arange(columns))
    out = np.zeros((planes.shape[0], rows, columns), np.float32)
    watch.expect(len(by_row) * len(by_column))
    for a, down in enumerate(by_row):
        for b, right in enumerate(by_column):
            (top, bottom), (left, stop) = (
                (int(i[0]), int(i[-1]) + 1) for i in (np.flatnonzero(down), np.flatnonzero(right))
            )
            patch = planes[:, top : bottom + 2 * margin, left : stop + 2 * margin]
            found = act(patch, lattice.kernels[a][b])[:, margin:, margin:][:, : bottom - top, : stop - left]
            out[:, top:bottom, left:stop] += found * np.outer(down[top:bottom], right[left:stop]).astype(np.float32)
            watch.advance()
    return np.moveaxis(out, 0, -1)


def richardson_lucy(
    values: np.ndarray, lattice: Lattice, rounds: int = 30, watch: Progress | None = None
) -> np.ndarray:
    """Return the picture after ``rounds`` of x ← x·Hᵀ(y/Hx)/Hᵀ1 (Richardson 1972; Lucy 1974), float32, not negative.

    H is the space-variant blur with its light cut at the rim. Raises RequestError for no rounds.
    """
    if rounds < 1:
        raise RequestError(f"{rounds} rounds of Richardson–Lucy; give at least 1")
    measured = np.maximum(np.asarray(values, np.float32), 0)
    estimate = np.maximum(measured, DARKEST)
    gain = np.maximum(transposed(np.ones_like(measured), lattice), DARKEST)
    watch = watch or Progress()
    watch.expect(rounds)
    for _ in range(rounds):
        blurred = np.maximum(forward(estimate, lattice), DARKEST)
        estimate = estimate * transposed(measured / blurred, lattice) / gain
        watch.advance()
    return estimate


def forward(values: np.ndarray, lattice: Lattice) -> np.ndarray:
    """Return the blurred picture on its own pixels, black beyond."""
    half = lattice.half
    return overlap_add(values, lattice)[half : half + values.shape[0], half : half + values.shape[1]]


def transposed(values: np.ndarray, lattice: Lattice) -> np.ndarray:
    """Return the adjoint of `forward`: each pixel collects what its light became."""
    half = lattice.half
    planes = np.pad(np.asarray(values, np.float32), ((half, half), (half, half), (0, 0)))
    return _collected(np.moveaxis(planes, -1, 0), lattice, values.shape[:2])


def _collected(planes: np.ndarray, lattice: Lattice, shape) -> np.ndarray:
    by_row, by_column = (
        hats(n, np.arange(p)) for n, p in zip((lattice.row_nodes, lattice.column_nodes), shape, strict=True)
    )
    out = np.zeros((len(planes), *shape), np.float32)
    for a, down in enumerate(by_row):
        for b, right in enumerate(by_column):
            (top, bottom), (left, stop) = (
                (int(i[0]), int(i[-1]) + 1) for i in (np.flatnonzero(down), np.flatnonzero(right))
            )
            patch = planes[:, top : bottom + 2 * lattice.half, left : stop + 2 * lattice.half]
            kernel, edge = lattice.kernels[a][b][:, ::-1, ::-1], lattice.half + lattice.kernels[a][b].shape[-1] // 2
            found = convolve(patch, kernel)[:, edge : edge + bottom - top, edge : edge + stop - left]
            out[:, top:bottom, left:stop] += found * np.outer(down[top:bottom], right[left:stop]).astype(np.float32)
    return np.moveaxis(out, 0, -1)


def with_one_kernel(lattice: Lattice, kernels: np.ndarray) -> Lattice:
    """Return a lattice that knows only one kernel (channels, size, size): a wrong PSF, to compare with."""
    return Lattice(lattice.row_nodes, lattice.column_nodes, [[kernels for _ in line] for line in lattice.kernels])


def psnr(values: np.ndarray, truth: np.ndarray) -> float:
    """Return the peak signal-to-noise ratio in dB, white at 1."""
    return float(-10 * np.log10(np.mean(np.square(np.asarray(values, float) - truth))))
