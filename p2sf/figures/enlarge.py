"""Pictures on finer grids for display: a PSF has few samples, but its light is smooth."""

from functools import lru_cache

import numpy as np

LARGEST = 512  # samples a side of an enlarged picture; painting does the rest
HIGHEST = 0.9  # share of the highest sampled frequency beyond which a sufficiently sampled picture has
QUIET = 0.02  # of its root mean square at most


def enlarge(values: np.ndarray, samples: int = LARGEST, coarse: bool = False) -> np.ndarray:
    """Return a picture on a finer grid over the same square for display; nonnegative values stay nonnegative.

    If samples are as close as λ/(4 NA), the cosine series through them, mirrored at the edges, is the light itself
    (Strang 1999, SIAM Review 41, 135, type 2). Coarser ones, and densities of rays, have light at the highest
    frequencies; they are interpolated by cubic convolution (Keys 1981, IEEE Trans. ASSP 29, 1153), which does not ring.

    Parameters
    ----------
    values : numpy.ndarray
        Shape (n, n); each sample is at the centre of its pixel.
    samples : int
        Samples a side of the result; no fewer than n are returned.
    coarse : bool
        Whether samples are known to be farther apart than λ/(4 NA), whatever their spectrum looks like: cosines would
        ring in the faint light about a bright line.

    Returns
    -------
    numpy.ndarray
        Shape (samples, samples), float32; the values themselves if they are as many.
    """
    count = values.shape[-1]
    if samples <= count:
        return values
    values = np.asarray(values, np.float32)
    matrix = (cubic_matrix if coarse or not is_band_limited(values) else cosine_matrix)(count, samples)
    finer: np.ndarray = matrix @ values @ matrix.T
    return finer if values.min() < 0 else np.maximum(finer, 0, out=finer)


def is_band_limited(values: np.ndarray) -> bool:
    """Return whether a picture, (n, n), has almost no energy at the highest frequencies, and so none beyond."""
    cosines = orthonormal_cosines(len(values))
    spectrum = cosines.T @ values @ cosines
    low = int(HIGHEST * len(values))
    high = np.linalg.norm(spectrum[low:]), np.linalg.norm(spectrum[:low, low:])
    return bool(np.hypot(*high) <= QUIET * np.linalg.norm(spectrum))


@lru_cache(maxsize=16)
def orthonormal_cosines(count: int) -> np.ndarray:
    """Return the cosines of type 2 in columns, (count, count)."""
    order = np.arange(count)
    scale = np.sqrt(np.where(order > 0, 2.0, 1.0) / count)
    return (scale * np.cos(np.pi * np.outer((order + 0.5) / count, order))).astype(np.float32)


@lru_cache(maxsize=16)
def cosine_matrix(count: int, samples: int) -> np.ndarray:
    """Return the matrix from samples to those of their cosine series on a finer grid, (samples, count)."""
    order = np.arange(count)
    coarse, fine = (np.cos(np.pi * np.outer((np.arange(n) + 0.5) / n, order)) for n in (count, samples))
    series = np.where(order > 0, 2.0, 1.0) / count
    return ((fine * series) @ coarse.T).astype(np.float32)


@lru_cache(maxsize=16)
def cubic_matrix(count: int, samples: int) -> np.ndarray:
    """Return the matrix of cubic convolution, mirrored at the edges, (samples, count)."""
    place = (np.arange(samples) + 0.5) * count / samples - 0.5
    first = np.floor(place).astype(int)
    matrix = np.zeros((samples, count), np.float32)
    for tap in range(-1, 3):
        mirrored = first + tap
        mirrored = np.where(mirrored < 0, -1 - mirrored, mirrored)
        mirrored = np.where(mirrored >= count, 2 * count - 1 - mirrored, mirrored)
        np.add.at(matrix, (np.arange(samples), mirrored), cubic(np.abs(place - first - tap)))
    return matrix


def windowed_sinc(away: np.ndarray, half_width: float, beta: float) -> np.ndarray:
    """Return the weight of a sample ``away`` by so many pitches, at most ``half_width``: a sinc times a Kaiser window.

    The window is I₀(β√(1 − t²))/I₀(β) (Kaiser & Schafer 1980, IEEE Trans. ASSP 28, 105). Of a band-limited function.
    """
    root = np.sqrt(np.maximum(1 - np.square(away / half_width), 0))
    weights: np.ndarray = np.sinc(away) * np.i0(beta * root) / np.i0(beta)
    return weights


def cubic(away: np.ndarray) -> np.ndarray:
    """Return the cubic-convolution weight of a sample ``away`` by so many pitches (Keys 1981, equation 15)."""
    near = (1.5 * away - 2.5) * away**2 + 1
    far = ((2.5 - 0.5 * away) * away - 4) * away + 2
    return np.where(away <= 1, near, np.where(away < 2, far, 0.0))
