"""Weights of evenly spaced samples along a line that ends between two of them."""

import numpy as np

END = 3  # samples at the end of a line whose weights differ from 1
ENDS = np.arange(END)[:, None]
GREGORY = np.array([[1 / 2], [1 / 12], [0.0]])  # −B₁, B₂/2, B₃/3: see `end_weights`
BY_MOMENTS = np.linalg.inv(np.vander(-np.arange(float(END)), END, increasing=True).T)
POWERS = np.arange(1, END + 1)[:, None]


def end_weights(ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the last sample of lines that end at ``ends`` steps, and the weights of the last END, (END, lines).

    Σ weight·f is then ∫f to the end, exact for polynomials of degree END − 1: Gregory's rule (Davis & Rabinowitz 1984,
    §2.9) for an end up to half a step on either side of the last sample. The moments of the weights are ∫uᵐdu from 0 to
    the end, and those of plain samples (Euler–Maclaurin) −Bₘ₊₁(1)·(−1)ᵐ/(m + 1).
    """
    last = np.floor(ends + 0.5).astype(int)
    return last, 1 + BY_MOMENTS @ ((ends - last) ** POWERS / POWERS - GREGORY)


def interval_weights(low: np.ndarray, high: np.ndarray, size: int) -> np.ndarray:
    """Return positive weights (lines, size) of samples for intervals, in steps, one a line; 0 where low ≥ high.

    At both ends those of `end_weights`. If the ends are closer than the number of samples they affect, the weights are
    scaled to the length of the interval, which is exact for a constant.
    """
    last, top = end_weights(high)
    behind, bottom = end_weights(size - 1 - low)
    place, line, first = np.arange(size), np.arange(low.size), size - 1 - behind
    weight = ((place >= first[:, None]) & (place <= last[:, None])).astype(float)
    weight[line, last - ENDS] *= top
    weight[line, first + ENDS] *= bottom
    total = weight.sum(1)
    length = np.maximum(high - low, 0.0)
    weight *= np.divide(length, total, out=np.zeros_like(total), where=total > 0)[:, None]
    return weight
