"""From pupil to focal plane, in plain formulas: a sum over nodes, a matrix DFT, and the paper's padded FFT.

All three share one sign: field(x, y) = Σ amplitude · exp(+2πi(kx·x + ky·y)), k in cycles per µm. A pupil
point (ξ, η) has k = −n'u'(ξ, η)/λ with the signed slope (`conventions`).
"""

import numpy as np

# Nodes per block of the direct sum: large enough for BLAS, small enough to stay in the cache.
BLOCK = 4096


def sum_plane_waves(amplitude, kx, ky, x, y, even: bool = True) -> np.ndarray:
    """Return Σ_j amplitude_j exp(2πi(kx_j x + ky_j y)), complex, shape (…, len(y), len(x)).

    ``amplitude``, ``kx``, ``ky``: (…, nodes), broadcast; ``x``, ``y``: 1-D, in units of 1/k. ``even``: the nodes
    are one half of a set that is even in kx (folded weights), so the x kernel is a cosine and only |x| matters.
    Precision follows ``kx`` (float32 or float64).
    """
    amplitude, kx, ky = np.asarray(amplitude), np.asarray(kx), np.asarray(ky)
    x, y = (np.asarray(axis, dtype=kx.dtype) for axis in (x, y))
    block = _even_block if even else _plain_block
    nodes = amplitude.shape[-1]
    parts = (slice(start, start + BLOCK) for start in range(0, nodes, BLOCK))
    return sum(block(amplitude[..., part], kx[..., part], ky[..., part], x, y) for part in parts)


def _plain_block(amplitude, kx, ky, x, y):
    rows = amplitude[..., None, :] * _wave(y[:, None] * ky[..., None, :])
    return rows @ _wave(kx[..., :, None] * x)


def _even_block(amplitude, kx, ky, x, y):
    """Return the block's sum from all-real products at |x|, |y| only: half the kernels and half the products."""
    columns, from_column = np.unique(np.abs(x), return_inverse=True)
    rows, from_row = np.unique(np.abs(y), return_inverse=True)
    across = np.cos(_radians(kx[..., :, None] * columns))
    phase = _radians(rows[:, None] * ky[..., None, :])
    upright, odd = (_real_product(amplitude, kernel, across) for kernel in (np.cos(phase), np.sin(phase)))
    sign = np.sign(y)[:, None]
    field = upright[..., from_row, :] + (1j * sign).astype(upright.dtype) * odd[..., from_row, :]
    return field[..., from_column]


def _real_product(amplitude, kernel, across):
    """Return (amplitude·kernel) @ across with its real and imaginary parts as two real products."""
    real = (amplitude.real[..., None, :] * kernel) @ across
    return real + 1j * ((amplitude.imag[..., None, :] * kernel) @ across)


def _radians(cycles: np.ndarray) -> np.ndarray:
    """Return 2π times the cycles less their whole part, which keeps float32 exact where phases are large."""
    return (2 * np.pi) * (cycles - np.rint(cycles))


def _wave(cycles: np.ndarray) -> np.ndarray:
    phase = _radians(cycles)
    return np.cos(phase) + 1j * np.sin(phase)
