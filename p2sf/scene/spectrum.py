"""Reduction of wavelengths: the Gauss rule for the spectrum of a channel."""

import numpy as np

from p2sf.pixel_kernels.channel import Colour
from p2sf.scene.scene import Channel


def reduce_spectrum(channel: Channel, count: int) -> Colour:
    """Return ``count`` wavelengths and weights whose moments up to 2·count − 1 are the channel's.

    Lanczos on the given wavelengths, then the eigenvectors of the Jacobi matrix (Golub & Welsch 1969). If ``count`` is
    not less than their number, they are returned unchanged.
    """
    waves, shares = channel.wavelengths_um, channel.shares
    if count >= len(waves):
        return Colour(tuple(waves.tolist()), tuple(shares.tolist()))
    diagonal, beside = _lanczos(waves, np.sqrt(shares), count)
    nodes, vectors = np.linalg.eigh(np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1))
    return Colour(tuple(nodes.tolist()), tuple(np.square(vectors[0]).tolist()))


def _lanczos(values: np.ndarray, start: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return diagonal and off-diagonal of the Jacobi matrix of diag(values) from this start vector."""
    q, before = start / np.linalg.norm(start), np.zeros(len(start))
    diagonal: list[float] = []
    beside = [0.0]
    for _ in range(count):
        r = values * q
        diagonal.append(float(q @ r))
        r = r - diagonal[-1] * q - beside[-1] * before
        beside.append(float(np.linalg.norm(r)))
        before, q = q, r / max(beside[-1], 1e-300)
    return np.array(diagonal), np.array(beside[1:-1])
