"""Polynomials through the nearest nodes of an axis, for one number (plain floats, for speed) or for arrays."""

from bisect import bisect_right
from math import prod
from typing import NamedTuple

import numpy as np


class NodeAxis:
    """Ascending nodes that can be searched for one number or for many."""

    def __init__(self, nodes: np.ndarray):
        self.nodes = nodes
        self.numbers = nodes.tolist()
        self.plans = {}

    def stencil(self, at, count: int):
        """Return the first of the nodes that a point takes, and the list of their weights.

        The ``count`` consecutive nodes nearest to the point with Lagrange's weights, so that the polynomial of
        degree count − 1 through them is met exactly. An axis of fewer nodes takes all it has.
        """
        if count not in self.plans:
            self.plans[count] = self._plan(min(count, len(self.numbers)))
        plan = self.plans[count]
        if isinstance(at, float):
            first = bisect_right(plan.breaks, at) - plan.before
            first = 0 if first < 0 else min(first, plan.last)
            return first, lagrange(self.numbers[first : first + plan.count], plan.scales[first], at)
        first = np.clip(np.searchsorted(plan.breaks, at, side="right") - plan.before, 0, plan.last)
        nodes = [self.nodes.take(first + k) for k in range(plan.count)]
        return first, lagrange(nodes, np.transpose(plan.scales).take(first, axis=1), at)

    def _plan(self, count: int) -> "StencilRule":
        """Return how points find their stencil of ``count`` nodes: where the nearest ones change."""
        middles = ((self.nodes[1:] + self.nodes[:-1]) / 2).tolist()
        last = len(self.numbers) - count
        stencils = (self.numbers[first : first + count] for first in range(last + 1))
        scales = [[1 / prod(x - y for y in some if y != x) for x in some] for some in stencils]
        return StencilRule(count, middles if count % 2 else self.numbers, count // 2, last, scales)


class StencilRule(NamedTuple):
    """Stencils of ``count`` nodes: they change at ``breaks`` and begin ``before`` nodes earlier, at ``last`` at most.

    ``scales``: for every stencil 1/Π(node − other node), the constant part of Lagrange's weights.
    """

    count: int
    breaks: list[float]
    before: int
    last: int
    scales: list[list[float]]


def lagrange(nodes: list, scales: list, at) -> list:
    """Return Lagrange's weights of the polynomial through ``nodes`` at a point; ``scales`` as `NodeAxis` keeps them."""
    if len(nodes) == 1:
        return [1.0]
    if len(nodes) == 2:  # by far the most frequent
        share = (at - nodes[0]) * scales[1]
        return [1.0 - share, share]
    steps = [at - node for node in nodes]
    return [prod(steps[:i] + steps[i + 1 :], start=scale) for i, scale in enumerate(scales)]


def placed(stencil) -> list:
    """Return (place, weight) pairs of a stencil."""
    first, weights = stencil
    return [(first + k, weight) for k, weight in enumerate(weights)]


def crossed(rows, pairs, width: int) -> list:
    """Return (place, weight) pairs of a stencil and another's pairs on a table stored row by row, ``width`` a row."""
    first, weights = rows
    return [((first + k) * width + column, outer * inner) for k, outer in enumerate(weights) for column, inner in pairs]


def weighted(table, pairs) -> list:
    """Return the weighted sums over places of a table: (parts, places), or for one point plain rows, one per place."""
    if isinstance(table, list):
        (place, weight), *others = pairs
        sums = [value * weight for value in table[place]]
        for place, weight in others:
            sums = [total + value * weight for total, value in zip(sums, table[place], strict=True)]
        return sums
    # One part after the other, so that its sum stays in the cache.
    return [sum(column.take(place, mode="clip") * weight for place, weight in pairs) for column in table]
