"""Polynomials through the nearest nodes of an axis, for one point (plain floats, for speed) or for arrays of them."""

from bisect import bisect_right
from collections.abc import Sequence
from math import prod
from typing import NamedTuple

import numpy as np

from p2sf.database.parts import Numbers

Stencil = tuple[Numbers, list[Numbers]]
"""The first of consecutive nodes, and the weight of each: numbers for one point, or arrays."""
Pairs = list[tuple[Numbers, Numbers]]
"""Places in a table, and their weights."""
Table = list[list[float]] | np.ndarray
"""An array (parts, places), or for one point plain rows (places, parts)."""


class NodeAxis:
    """Ascending nodes, searched for one number or an array."""

    def __init__(self, nodes: np.ndarray) -> None:
        self.nodes = nodes
        self.numbers = nodes.tolist()
        self.rules: dict[int, StencilRule] = {}

    def stencil(self, at: Numbers, count: int) -> Stencil:
        """Return the ``count`` consecutive nodes nearest to a point: the first of them, and the list of their weights.

        The weights are Lagrange's: they give the value of the polynomial of degree count − 1 through the nodes. If the
        axis has fewer nodes, all are used.
        """
        if count not in self.rules:
            self.rules[count] = self._rule(min(count, len(self.numbers)))
        rule = self.rules[count]
        if isinstance(at, float):
            first = bisect_right(rule.breaks, at) - rule.before
            first = 0 if first < 0 else min(first, rule.last)
            return first, lagrange(self.numbers[first : first + rule.nodes], rule.scales[first], at)
        starts = np.clip(np.searchsorted(rule.breaks, at, side="right") - rule.before, 0, rule.last)
        nodes = [self.nodes.take(starts + k) for k in range(rule.nodes)]
        return starts, lagrange(nodes, np.transpose(rule.scales).take(starts, axis=1), at)

    def _rule(self, count: int) -> "StencilRule":
        """Return how points find their stencil of ``count`` nodes."""
        middles = ((self.nodes[1:] + self.nodes[:-1]) / 2).tolist()
        last = len(self.numbers) - count
        stencils = (self.numbers[first : first + count] for first in range(last + 1))
        scales = [[1 / prod(x - y for y in some if y != x) for x in some] for some in stencils]
        return StencilRule(count, middles if count % 2 else self.numbers, count // 2, last, scales)


class StencilRule(NamedTuple):
    """Stencils of ``nodes`` nodes: they change at ``breaks`` and start ``before`` nodes earlier, at ``last`` at most.

    ``scales``: for every stencil 1/Π(node − other node), the constant factors of Lagrange's weights.
    """

    nodes: int
    breaks: list[float]
    before: int
    last: int
    scales: list[list[float]]


def lagrange(nodes: Sequence[Numbers], scales: Sequence[Numbers] | np.ndarray, at: Numbers) -> list[Numbers]:
    """Return Lagrange's weights of the polynomial through ``nodes`` at a point; ``scales`` as `NodeAxis` keeps them."""
    if len(nodes) == 1:
        return [1.0]
    if len(nodes) == 2:  # by far the most common case
        share = (at - nodes[0]) * scales[1]
        return [1.0 - share, share]
    steps = [at - node for node in nodes]
    return [prod(steps[:i] + steps[i + 1 :], start=scale) for i, scale in enumerate(scales)]


def place_pairs(stencil: Stencil) -> Pairs:
    """Return (place, weight) pairs of a stencil."""
    first, weights = stencil
    return [(first + k, weight) for k, weight in enumerate(weights)]


def cross(rows: Stencil, pairs: Pairs, width: int) -> Pairs:
    """Return pairs over a table of ``width`` columns, stored row by row: a stencil of rows times pairs of columns."""
    first, weights = rows
    return [((first + k) * width + column, outer * inner) for k, outer in enumerate(weights) for column, inner in pairs]


def weighted_sum(table: Table, pairs: Pairs) -> list[Numbers]:
    """Return the weighted sum over places for every part of a table."""
    if isinstance(table, list):
        (place, weight), *others = pairs
        sums = [value * weight for value in table[place]]
        for place, weight in others:
            sums = [total + value * weight for total, value in zip(sums, table[place], strict=True)]
        return sums
    # One part at a time, so that its sum stays in the cache.
    return [sum(column.take(place, mode="clip") * weight for place, weight in pairs) for column in table]
