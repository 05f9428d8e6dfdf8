"""Polynomials through the nearest nodes of an axis, for one number (plain floats, for speed) or for arrays."""

from bisect import bisect_right
from math import prod

import numpy as np


class Axis:
    """Ascending nodes that can be searched for one number or for many."""

    def __init__(self, nodes: np.ndarray):
        self.nodes = nodes
        self.numbers = nodes.tolist()
        self.middles = (nodes[1:] + nodes[:-1]) / 2
        self.middle_numbers = self.middles.tolist()

    def stencil(self, at, count: int):
        """Return the first of the nodes that a point takes, and the list of their weights.

        The ``count`` consecutive nodes nearest to the point with Lagrange's weights, so that the polynomial of
        degree count − 1 through them is met exactly. An axis of fewer nodes takes all it has.
        """
        count = min(count, len(self.numbers))
        if isinstance(at, float):
            first = max(0, min(self._before_one(at, count), len(self.numbers) - count))
            return first, lagrange(self.numbers[first : first + count], at)
        first = np.clip(self._before(at, count), 0, len(self.numbers) - count)
        return first, lagrange([self.nodes.take(first + k) for k in range(count)], at)

    def _before_one(self, at: float, count: int) -> int:
        if count % 2:
            return bisect_right(self.middle_numbers, at) - count // 2
        return bisect_right(self.numbers, at) - count // 2

    def _before(self, at: np.ndarray, count: int) -> np.ndarray:
        return np.searchsorted(self.middles if count % 2 else self.nodes, at, side="right") - count // 2


def lagrange(nodes: list, at) -> list:
    """Return Lagrange's weights of the polynomial through ``nodes`` at a point."""
    if len(nodes) == 1:
        return [1.0]
    if len(nodes) == 2:  # by far the most frequent
        share = (at - nodes[0]) / (nodes[1] - nodes[0])
        return [1.0 - share, share]
    steps = [at - node for node in nodes]
    return [
        prod(steps[:i] + steps[i + 1 :]) / prod([node - other for other in nodes[:i] + nodes[i + 1 :]])
        for i, node in enumerate(nodes)
    ]


def crossed(first, second, width: int) -> list:
    """Return (place, weight) pairs of two stencils on a table stored row by row, ``width`` columns a row."""
    (row, row_weights), (column, column_weights) = first, second
    return [
        ((row + i) * width + (column + j), outer * inner)
        for i, outer in enumerate(row_weights)
        for j, inner in enumerate(column_weights)
    ]


def weighted(values, pairs):
    """Return the weighted sum of a flat table's entries; ``values`` a list for one point, an array for many."""
    if isinstance(values, list):
        return sum([values[place] * weight for place, weight in pairs])
    return sum(values.take(place, mode="clip") * weight for place, weight in pairs)


def along(values, stencil):
    """Return the weighted sum along one axis."""
    first, weights = stencil
    return weighted(values, [(first + k, weight) for k, weight in enumerate(weights)])
