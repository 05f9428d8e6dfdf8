"""Databases on nodes: the rule of the paper, and linear interpolation (handbook 7.2).

The paper (Pieroni et al. 2015, table 1) states how each coefficient varies with depth and field. "Inverse" is taken as
a + b/d through the two nodes on either side of the point, "linear", "quadratic" and "cubic" as the polynomial through
the nearest two, three and four, "constant" as the nearest node. The paper does not mention wavelength: optical path is
interpolated linearly between the two nodes on either side.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import vergence
from p2sf.database.parts import KINDS, PARTS, Numbers, Parts, assemble, traced_parts
from p2sf.database.space import ROUNDING, Space
from p2sf.database.stencil import NodeAxis, Stencil, Table, cross, place_pairs, weighted_sum
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.errors import DatabaseError
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import Coefficients


class Depth(NamedTuple):
    """Interpolation of parts over depth: in 1/depth or in depth, the number of nodes, and the parts."""

    inverse: bool
    nodes: int
    parts: tuple[str, ...]


class Rule(NamedTuple):
    """An interpolation rule: groups of parts over depth, and the number of nodes of each coefficient over field."""

    depth: tuple[Depth, ...]
    field: dict[str, int]
    finite_only: bool


SCALES = ("nu", "y")  # the marginal ray, which scales the PSF: almost linear in 1/depth
PER_WAVELENGTH = ("chief", "image_index")  # parts that depend only on wavelength
RULES = {
    "table1": Rule(
        (
            Depth(True, 2, ("w40", "wd", *SCALES, *PER_WAVELENGTH)),
            Depth(False, 2, ("w31",)),
            Depth(False, 3, ("w22", "w20", "w11")),
        ),
        {"w40": 1, "w31": 2, "w22": 3, "w20": 3, "w11": 4, "wd": 1},
        True,
    ),
    "linear": Rule((Depth(True, 2, (*KINDS, *SCALES, *PER_WAVELENGTH)),), dict.fromkeys(KINDS, 2), False),
}
STORED = (*KINDS, *SCALES)
KEPT = (*STORED, *PER_WAVELENGTH)


@dataclass(frozen=True, eq=False)
class NodeGrid:
    """Traced nodes: ``depth`` (depths, wavelengths, 8) and ``wavelength`` (wavelengths, 2), mm, at unit slope."""

    depth: np.ndarray
    wavelength: np.ndarray


@dataclass(frozen=True, eq=False)
class GridDatabase:
    """Coefficients on the nodes of ``space``, and a rule between them.

    Only (depth, wavelength) is stored: a Seidel coefficient's value at a field node is its value at unit
    slope times a power of that slope. ``errors``: the largest departure of each coefficient from direct
    evaluation at points between the nodes, in waves. ``mask`` as in `ExactDatabase`.
    """

    space: Space
    grid: NodeGrid
    interpolant: str
    errors: dict[str, float]
    method: str = "seidel"
    mask: PupilMask = CLEAR

    @property
    def rule(self) -> Rule:
        """Return the interpolation rule."""
        return RULES[self.interpolant]

    @cached_property
    def last_depth_mm(self) -> float:
        """Return the largest depth up to which the rule has no gap, mm."""
        depths = self.space.depths_mm
        finite = depths[np.isfinite(depths)]
        return float(finite[-1] if self.rule.finite_only and finite.size else depths[-1])

    def coefficients(self, depth_mm: ArrayLike, field_slope: ArrayLike, wavelength_um: ArrayLike) -> Coefficients:
        """Return the six coefficients at one point or over broadcast arrays.

        Raises DatabaseError outside the space and, for table1, between the last finite depth and infinity.
        """
        if isinstance(depth_mm, float) and isinstance(field_slope, float) and isinstance(wavelength_um, float):
            self.space.check_one(depth_mm, field_slope, wavelength_um)
            return self._interpolate(depth_mm, field_slope, wavelength_um, self._one)
        self.space.check(depth_mm, field_slope, wavelength_um)
        depth, slope, wavelength = (np.asarray(x, dtype=float) for x in (depth_mm, field_slope, wavelength_um))
        return self._interpolate(depth, slope, wavelength, self._many)

    def _interpolate(
        self, depth: Numbers, slope: Numbers, wavelength: Numbers, tables: Sequence[Table]
    ) -> Coefficients:
        """Interpolate over (depth, wavelength), then multiply by each coefficient's own power of the field."""
        colour, width = place_pairs(self._axes["wavelength"].stencil(wavelength, 2)), len(self.space.wavelengths_um)
        rule = self.rule
        values: list[Numbers] = []
        if rule.finite_only:
            self._check_gap(depth)
        for group, table in zip(rule.depth, tables[1:], strict=True):
            values += weighted_sum(table, cross(self._depth_stencil(group, depth), colour, width))
        parts = Parts(*[values[place] for place in self._places])
        return assemble(parts, self._powers(slope, tables[0]), wavelength)

    def _powers(self, slope: Numbers, table: Table) -> list[Numbers]:
        """Return the field slope, its square and its cube as interpolated from ``table``, their values at the nodes.

        The polynomial through more nodes than its degree is the power itself, which then needs no table.
        """
        powers = [slope, slope * slope, slope * slope * slope]
        for count, which in self._short.items():
            found = weighted_sum(table, place_pairs(self._axes["field"].stencil(slope, count)))
            for k in which:
                powers[k] = found[k]
        return powers

    @cached_property
    def _short(self) -> dict[int, list[int]]:
        """Return by number of nodes which powers of the field, from 0, are inexact with so few."""
        counts = [min(self.rule.field[kind], len(self.space.field_slopes)) for kind in ("w31", "w22", "w11")]
        return {
            n: [k for k, count in enumerate(counts) if count == n <= k + 1]
            for n in {counts[k] for k in range(3) if counts[k] <= k + 1}
        }

    @cached_property
    def _places(self) -> list[int]:
        """Return the index of each part among all columns of the tables."""
        given = [name for group in self.rule.depth for name in group.parts]
        return [given.index(name) for name in PARTS]

    def _depth_stencil(self, group: Depth, depth: Numbers) -> Stencil:
        if not self.rule.finite_only:
            return self._axes["inverse"].stencil(-1.0 / depth, group.nodes)
        near = min(depth, self.last_depth_mm) if isinstance(depth, float) else np.minimum(depth, self.last_depth_mm)
        axis, at = (self._axes["inverse"], -1.0 / near) if group.inverse else (self._axes["depth"], near)
        first, weights = axis.stencil(at, group.nodes)
        return self._at_infinity(depth, first, weights)

    def _at_infinity(self, depth: Numbers, first: Numbers, weights: list[Numbers]) -> Stencil:
        """Return the stencil with infinity as a separate node, from which nothing is interpolated."""
        last = len(self.space.depths_mm) - 1
        if isinstance(depth, float):
            return (last, [1.0]) if depth == np.inf else (first, weights)
        alone = np.isinf(depth)
        if not alone.any():
            return first, weights
        return np.where(alone, last, first), [np.where(alone, k == 0, w) for k, w in enumerate(weights)]

    def _check_gap(self, depth: Numbers) -> None:
        last = self.last_depth_mm
        if isinstance(depth, float) and (depth <= last or depth == np.inf):
            return
        gap = (np.asarray(depth) > last * (1 + ROUNDING)) & np.isfinite(depth)
        if gap.any():
            raise DatabaseError(
                "depth {depth:.6g} mm lies between the last finite node, {last:.6g} mm, and infinity, where table1 has "
                "no rule; add nodes or build with the exact interpolant",
                depth=float(np.asarray(depth)[gap].ravel()[0]),
                last=last,
            )

    @cached_property
    def _axes(self) -> dict[str, NodeAxis]:
        depths = self.space.depths_mm
        usable = depths[depths <= self.last_depth_mm]
        return {
            "inverse": NodeAxis(-vergence(usable)),
            "depth": NodeAxis(usable),
            "field": NodeAxis(self.space.field_slopes),
            "wavelength": NodeAxis(self.space.wavelengths_um),
        }

    @cached_property
    def _many(self) -> list[np.ndarray]:
        """Return tables (parts, nodes): the powers of the field, then the parts of every depth group."""
        depth, colour = self.grid.depth, self.grid.wavelength
        both = np.concatenate([depth, np.broadcast_to(colour, (*depth.shape[:-1], colour.shape[-1]))], axis=-1)
        columns = [[KEPT.index(name) for name in group.parts] for group in self.rule.depth]
        tables = [both[..., some].reshape(-1, len(some)).T for some in columns]
        powers = np.stack([self.space.field_slopes**power for power in (1, 2, 3)])
        return [np.ascontiguousarray(table) for table in (powers, *tables)]

    @cached_property
    def _one(self) -> list[list[list[float]]]:
        """Return the same tables as plain rows, one per node: ten times faster for a single point."""
        return [table.T.tolist() for table in self._many]


def traced_grid(lens: Lens, space: Space, stop: Stop) -> NodeGrid:
    """Return the parts of a lens traced at every (depth, wavelength) node of a space."""
    parts = traced_parts(lens, space.depths_mm[:, None], space.wavelengths_um, stop)
    shape = (len(space.depths_mm), len(space.wavelengths_um))
    depth = np.stack([np.broadcast_to(getattr(parts, name), shape) for name in STORED], axis=-1)
    return NodeGrid(depth, np.stack([np.broadcast_to(getattr(parts, x), shape)[0] for x in PER_WAVELENGTH], axis=-1))
