"""Nodes along one axis, and the linear interpolation between them."""

import numpy as np


def nodes_along(pixels: int, count: int) -> np.ndarray:
    """Return ``count`` node positions from the first pixel to the last; for one node the middle."""
    return np.array([(pixels - 1) / 2]) if count == 1 or pixels == 1 else np.linspace(0, pixels - 1, count)


def hats(nodes: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Return the linear interpolation weights of every node at these positions, (nodes, positions); they sum to 1."""
    return np.stack([np.interp(positions, nodes, row) for row in np.eye(len(nodes))])
