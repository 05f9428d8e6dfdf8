"""The definition of space-variant blur, pixel by pixel, which every fast method must equal."""

from collections.abc import Callable

import numpy as np


def direct_sum(values: np.ndarray, kernel_at: Callable[[float, float], np.ndarray], half: int) -> np.ndarray:
    """Return Σ values[i, j]·kernel(i, j) placed at (i, j), (rows + 2·half, columns + 2·half, channels) float64.

    ``kernel_at(row, column)`` gives (channels, size, size), no wider than ``half`` on either side.
    """
    rows, columns, channels = values.shape
    out = np.zeros((channels, rows + 2 * half, columns + 2 * half))
    for i in range(rows):
        for j in range(columns):
            if not values[i, j].any():
                continue
            kernel = kernel_at(float(i), float(j))
            edge, size = half - kernel.shape[-1] // 2, kernel.shape[-1]
            out[:, i + edge : i + edge + size, j + edge : j + edge + size] += values[i, j][:, None, None] * kernel
    return np.moveaxis(out, 0, -1)
