"""Interpolation between even nodes of (1/depth, field, wavelength), as weights of the nodes."""

from collections.abc import Callable
from functools import lru_cache
from typing import Literal

import numpy as np

from tests.benchmarks.representations.space import axis_nodes

Rule = Literal["nearest", "linear", "cubic"]
RULES: tuple[Rule, ...] = ("nearest", "linear", "cubic")
Counts = tuple[int, int, int]


def node_weights(counts: Counts, rule: Rule, cube: np.ndarray) -> np.ndarray:
    """Return the weight of every node, (points, nodes), the wavelength's nodes running fastest; ``cube``: (points, 3).

    "cubic" is the spline through all nodes, "not a knot" at the ends (de Boor 1978, ch. IV); through three nodes that
    is the parabola, through two the straight line.
    """
    depth, field, colour = (_axis_weights(n, rule, cube[:, axis]) for axis, n in enumerate(counts))
    weights: np.ndarray = np.einsum("pi,pj,pk->pijk", depth, field, colour).reshape(len(cube), -1)
    return weights


def _axis_weights(count: int, rule: Rule, at: np.ndarray) -> np.ndarray:
    """Return the weights of the nodes of one axis, (points, count)."""
    if count == 1:
        return np.ones((at.size, 1))
    place = at * (count - 1)
    if rule == "nearest":
        nearest: np.ndarray = np.eye(count)[np.clip(np.rint(place).astype(int), 0, count - 1)]
        return nearest
    if rule == "cubic" and count > 2:
        spline: np.ndarray = _spline(count)(at)
        return spline
    below = np.clip(place.astype(int), 0, count - 2)
    share = (place - below)[:, None]
    rows = np.eye(count)
    linear: np.ndarray = (1 - share) * rows[below] + share * rows[below + 1]
    return linear


@lru_cache(maxsize=16)
def _spline(count: int) -> Callable[[np.ndarray], np.ndarray]:
    """Return what gives the weights of even nodes, (points, count), at points, (points,)."""
    from scipy.interpolate import CubicSpline

    spline: Callable[[np.ndarray], np.ndarray] = CubicSpline(axis_nodes(count), np.eye(count))
    return spline
