"""Differences of the coefficients of a database from those evaluated directly."""

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.database.parts import KINDS
from p2sf.database.space import Space
from p2sf.paraxial.seidel import Coefficients

Points = tuple[np.ndarray, ...]
"""Depth (mm), field slope or slopes and wavelength (µm) of points, as arrays that broadcast; see `Space.nodes`."""

# Additive recurrence that fills a cube of n dimensions most evenly (Roberts 2018): steps are powers of 1/g, gⁿ⁺¹ = g +
# 1.
EVEN_ROOTS = {3: 1.2207440846057596, 4: 1.1673039782614187}


def scatter(space: Space, count: int, last_depth_mm: float = np.inf) -> Points:
    """Return ``count`` points spread evenly over a space, in the order of its nodes; depth is uniform in 1/depth."""
    far, axes = min(float(space.depths_mm[-1]), last_depth_mm), len(space.nodes)
    steps = EVEN_ROOTS[axes] ** -np.arange(1, axes + 1)
    cube = (0.5 + np.outer(steps, np.arange(count))) % 1
    near = 1 / far + cube[0] * (1 / space.depths_mm[0] - 1 / far)
    others = (nodes[0] + part * (nodes[-1] - nodes[0]) for nodes, part in zip(space.nodes[1:], cube[1:], strict=True))
    with np.errstate(divide="ignore"):
        return np.clip(1 / near, space.depths_mm[0], far), *others


def cell_middles(space: Space, last_depth_mm: float = np.inf) -> Points:
    """Return the centres of cells, where interpolation errors are largest, as axes that broadcast.

    All depths (centres in 1/depth), the outermost field, and half a dozen wavelengths over the whole range.
    """
    near = 1 / space.depths_mm[space.depths_mm <= last_depth_mm]
    colours = _middles(space.wavelengths_um)
    few = colours[np.unique(np.linspace(0, len(colours) - 1, 6).round().astype(int))]
    with np.errstate(divide="ignore"):
        depth = 1 / _middles(near)
    return depth[:, None, None], _middles(space.field_slopes)[-1:, None], few


def _middles(nodes: np.ndarray) -> np.ndarray:
    return (nodes[1:] + nodes[:-1]) / 2 if len(nodes) > 1 else nodes


def departures(found: Coefficients, direct: Coefficients) -> dict[str, float]:
    """Return the largest difference in each coefficient, waves."""
    return {kind: float(np.abs(getattr(found, kind) - getattr(direct, kind)).max()) for kind in KINDS}


def largest(direct: Coefficients) -> dict[str, float]:
    """Return the largest magnitude of each coefficient, waves."""
    return {kind: float(np.abs(getattr(direct, kind)).max()) for kind in KINDS}


def path_scale(direct: Coefficients) -> float:
    """Return the largest optical path, waves, whose small differences are the coefficients: n'u'·(distance·u')/2.

    The rounding error is a fraction of this path, however small the coefficient itself is.
    """
    slope = direct.reduced_slope / direct.image_index
    with np.errstate(invalid="ignore"):
        path = np.abs(direct.reduced_slope * slope * direct.image_distance) * UM_PER_MM / direct.wavelength_um / 2
    return float(path[np.isfinite(path)].max(initial=0.0))
