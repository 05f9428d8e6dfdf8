"""The plane waves of pupil nodes, put on a grid of spatial frequencies.

A plane wave of any frequency is nearly a sum of those of the nearest frequencies of a grid, divided by a function of
the place: the non-uniform Fourier transform (Dutt and Rokhlin 1993), here with the kernel exp(β(√(1 − z²) − 1)) of
Barnett, Magland and af Klinteberg (2019). A sum over the grid is two products of matrices.
"""

import numpy as np

from p2sf.disc.quadrature import gauss_legendre

WIDTH = 7  # grid points that a node is spread to along each axis: errors of 1e-6 of the field's peak
FINER = 2.0  # times the spacing of frequencies that the places can tell apart
BETA = 2.3 * WIDTH
KERNEL_NODES = 40


class ScatteredNodes:
    """Nodes at frequencies (fx, fy) in cycles/µm, (nodes,), on a grid for light at places x and y, µm.

    ``up`` (y, rows) and ``across`` (columns, x) are the waves of the grid, complex64.
    """

    def __init__(self, fx: np.ndarray, fy: np.ndarray, x: np.ndarray, y: np.ndarray):
        from scipy.sparse import csc_array

        self.up, row, down = _spread(fy, y)
        along, column, aside = _spread(fx, x)
        self.across = np.ascontiguousarray(along.T)
        self.shape = self.up.shape[1], along.shape[1]
        cells = row[:, :, None] * self.shape[1] + column[:, None]
        shares = (down[:, :, None] * aside[:, None]).astype(np.float32)
        ends = np.arange(fx.size + 1) * WIDTH**2
        self.matrix = csc_array((shares.ravel(), cells.ravel(), ends), shape=(self.shape[0] * self.shape[1], fx.size))

    def transform(self, values: np.ndarray) -> np.ndarray:
        """Return the sums of plane waves with these values, (terms, nodes), as (y, terms, x)."""
        parts = np.ascontiguousarray(values.T, np.complex64).view(np.float32)  # a real matrix times real columns
        laid = (self.matrix @ parts).view(np.complex64).reshape(*self.shape, -1)
        rows = np.ascontiguousarray(laid.transpose(0, 2, 1)) @ self.across
        field: np.ndarray = self.up @ rows.reshape(len(rows), -1)
        return field.reshape(len(field), *rows.shape[1:])


def _spread(frequency: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the waves of an axis's grid, (places, grid), each node's grid points and their shares, (nodes, WIDTH)."""
    step = float(1 / (2 * FINER * (np.abs(place).max() or 1.0)))
    low = float(frequency.min()) - step * WIDTH / 2
    at = (frequency - low) / step
    first = np.ceil(at - WIDTH / 2).astype(int)
    points = first[:, None] + np.arange(WIDTH)
    share = _kernel((points - at[:, None]) * (2 / WIDTH))
    grid = low + step * np.arange(int(points.max()) + 1)
    z, weight = gauss_legendre(KERNEL_NODES)
    # ∫φ(f)·exp(i2πf·place)df over the kernel, in units of the grid's spacing
    smooth = WIDTH / 2 * np.cos(np.pi * WIDTH * step * np.multiply.outer(place, z)) @ (weight * _kernel(z))
    waves = np.exp(2j * np.pi * np.multiply.outer(place, grid)) / smooth[:, None]
    return waves.astype(np.complex64), points, share


def _kernel(z: np.ndarray) -> np.ndarray:
    found: np.ndarray = np.exp(BETA * (np.sqrt(np.maximum(1 - z * z, 0.0)) - 1))
    return found
