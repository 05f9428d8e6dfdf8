"""Light per pixel from finer samples of an intensity."""

import numpy as np


def bin_samples(light: np.ndarray, size: int, samples: int) -> np.ndarray:
    """Return the light of every pixel from its ``samples``² samples, (…, size, size), none of it negative."""
    lines = np.ascontiguousarray(_edge_sums(light, size, samples).swapaxes(-1, -2))
    sums: np.ndarray = np.maximum(_edge_sums(lines, size, samples).swapaxes(-1, -2), 0)
    return sums


def _edge_sums(light: np.ndarray, size: int, samples: int) -> np.ndarray:
    """Return sums over samples in the middle of equal steps, (…, pixels · samples, columns) → (…, pixels, columns).

    The midpoint rule errs by h²/24 of the slope's change from edge to edge (Abramowitz & Stegun 1964, 25.4.2 over half
    steps). The slope at an edge is taken from the samples on either side: both pixels use the same, so no light is
    lost.
    """
    light = light.reshape(*light.shape[:-2], size, samples, -1)
    sums: np.ndarray = light.sum(-2)
    passed = (light[..., 1:, 0, :] - light[..., :-1, -1, :]) / np.float32(24)
    sums[..., :-1, :] += passed
    sums[..., 1:, :] -= passed
    return sums
