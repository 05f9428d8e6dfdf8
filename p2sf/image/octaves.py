"""A picture in octaves of spatial frequency: what is finer than two of its pixels, and the rest in half as many.

P. J. Burt, E. H. Adelson, "The Laplacian pyramid as a compact image code", IEEE Trans. Commun. 31, 1983.
"""

import numpy as np


def block_means(planes: np.ndarray, times: int) -> np.ndarray:
    """Return the means of blocks of ``times``² pixels of (…, rows, columns), float32."""
    planes = np.asarray(planes, np.float32)
    while times > 1:
        planes, times = (planes[..., ::2, :] + planes[..., 1::2, :]) * np.float32(0.5), times // 2
        planes = (planes[..., ::2] + planes[..., 1::2]) * np.float32(0.5)
    return planes


def enlarge(planes: np.ndarray) -> np.ndarray:
    """Return planes of twice as many rows and columns, linear between the middles of pixels, float32."""
    *first, rows, columns = planes.shape
    tall, out = (np.empty((*first, 2 * rows, n), np.float32) for n in (columns, 2 * columns))
    _between(planes, tall, -2)
    _between(tall, out, -1)
    return out


def _between(planes: np.ndarray, out: np.ndarray, axis: int) -> None:
    """Put planes of twice the length along an axis into ``out``: ¾ of the nearer and ¼ of the other neighbour."""
    source, target = planes.swapaxes(0, axis), out.swapaxes(0, axis)
    quarter = source * np.float32(0.25)
    most = source - quarter
    np.add(most[1:], quarter[:-1], out=target[2::2])
    np.add(most[:-1], quarter[1:], out=target[1:-1:2])
    target[0], target[-1] = source[0], source[-1]


def finest_octave(planes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return what `enlarge` of the halved planes lacks of them, and the halved planes."""
    half = block_means(planes, 2)
    return planes - enlarge(half), half


def octave_weights(side: int, falloff: float) -> np.ndarray:
    """Return how much of the finest octave's power lies at the frequencies of a transform of ``side``², sum 1.

    The response of `finest_octave` is 1 − (cos πf_x·cos πf_y)⁴; the picture's power falls as f to the ``falloff``: 0
    for noise, 2 for most pictures (D. J. Field, J. Opt. Soc. Am. A 4, 1987).
    """
    f = np.fft.fftfreq(side)
    square = f * f + (f * f)[:, None]
    response = 1 - np.outer(np.cos(np.pi * f), np.cos(np.pi * f)) ** 4
    power = np.square(response) / np.where(square > 0, square, 1.0) ** (falloff / 2)
    weights: np.ndarray = power / power.sum()
    return weights
