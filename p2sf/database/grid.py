"""Databases on nodes: the paper's rule and straight lines.

The paper (Pieroni et al. 2015, table 1) names for each coefficient how it runs with depth and with field.
We read "inverse" as a + b/d through the two nodes beside the point, "linear", "quadratic" and "cubic" as
the polynomial through the nearest two, three and four, "constant" as the nearest node. On wavelength the
paper says nothing: straight lines, of optical path, between the two nodes beside.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from p2sf.conventions import vergence
from p2sf.database.parts import KINDS, PARTS, Parts, assemble, traced_parts
from p2sf.database.space import ROUNDING, Space
from p2sf.database.stencil import NodeAxis, crossed, placed, weighted
from p2sf.errors import DatabaseError
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import Coefficients


class Depth(NamedTuple):
    """How parts run with depth: the coordinate, the number of nodes, and which parts."""

    inverse: bool
    nodes: int
    parts: tuple[str, ...]


class Rule(NamedTuple):
    """An interpolation rule: groups over depth, and how many nodes each coefficient takes over field."""

    depth: tuple[Depth, ...]
    field: dict[str, int]
    finite_only: bool


SCALES = ("nu", "y")  # what scales the PSF is a marginal ray, linear in 1/depth but for the pupil's place
PER_WAVELENGTH = ("chief", "image_index")  # what changes with wavelength alone
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
    slope times a power of that slope. ``errors``: largest departure from direct evaluation at points
    between the nodes, in waves, by coefficient.
    """

    space: Space
    grid: NodeGrid
    interpolant: str
    errors: dict[str, float]
    method: str = "seidel"

    @property
    def rule(self) -> Rule:
        """Return the interpolation rule in force."""
        return RULES[self.interpolant]

    @cached_property
    def last_depth_mm(self) -> float:
        """Return the farthest depth that the rule reaches without a gap, mm."""
        depths = self.space.depths_mm
        finite = depths[np.isfinite(depths)]
        return float(finite[-1] if self.rule.finite_only and finite.size else depths[-1])

    def coefficients(self, depth_mm, field_slope, wavelength_um) -> Coefficients:
        """Return the six coefficients at one point or over broadcast arrays.

        Raises DatabaseError outside the space and, for table1, between the last finite depth and infinity.
        """
        point = (depth_mm, field_slope, wavelength_um)
        if all([isinstance(x, float) for x in point]):
            self.space.check_one(*point)
            return self._interpolate(*point, self._one)
        self.space.check(*point)
        return self._interpolate(*(np.asarray(x, dtype=float) for x in point), self._many)

    def _interpolate(self, depth, slope, wavelength, tables) -> Coefficients:
        """Weigh the nodes around: over (depth, wavelength), then each coefficient's own power of the field."""
        colour, width = placed(self._axes["wavelength"].stencil(wavelength, 2)), len(self.space.wavelengths_um)
        rule, values = self.rule, []
        if rule.finite_only:
            self._check_gap(depth)
        for group, table in zip(rule.depth, tables[1:], strict=True):
            values += weighted(table, crossed(self._depth_stencil(group, depth), colour, width))
        parts = Parts(*[values[place] for place in self._places])
        return assemble(parts, self._powers(slope, tables[0]), wavelength)

    def _powers(self, slope, table) -> list:
        """Return what interpolation makes of the field slope, its square and its cube; ``table``: at the nodes.

        The polynomial through more nodes than its degree is the power itself.
        """
        powers = [slope, slope * slope, slope * slope * slope]
        for count, which in self._short.items():
            found = weighted(table, placed(self._axes["field"].stencil(slope, count)))
            for k in which:
                powers[k] = found[k]
        return powers

    @cached_property
    def _short(self) -> dict[int, list[int]]:
        """Return which powers of the field, from 0, have too few nodes to be exact, by how many they have."""
        counts = [min(self.rule.field[kind], len(self.space.field_slopes)) for kind in ("w31", "w22", "w11")]
        return {
            n: [k for k, count in enumerate(counts) if count == n <= k + 1]
            for n in {counts[k] for k in range(3) if counts[k] <= k + 1}
        }

    @cached_property
    def _places(self) -> list[int]:
        """Return where each part stands among what the tables give one after the other."""
        given = [name for group in self.rule.depth for name in group.parts]
        return [given.index(name) for name in PARTS]

    def _depth_stencil(self, group: Depth, depth):
        if not self.rule.finite_only:
            return self._axes["inverse"].stencil(-1.0 / depth, group.nodes)
        near = min(depth, self.last_depth_mm) if isinstance(depth, float) else np.minimum(depth, self.last_depth_mm)
        axis, at = (self._axes["inverse"], -1.0 / near) if group.inverse else (self._axes["depth"], near)
        first, weights = axis.stencil(at, group.nodes)
        return self._at_infinity(depth, first, weights)

    def _at_infinity(self, depth, first, weights):
        """Infinity is a node like any other, but nobody's neighbour: it stands alone."""
        last = len(self.space.depths_mm) - 1
        if isinstance(depth, float):
            return (last, [1.0]) if depth == np.inf else (first, weights)
        alone = np.isinf(depth)
        if not alone.any():
            return first, weights
        return np.where(alone, last, first), [np.where(alone, k == 0, w) for k, w in enumerate(weights)]

    def _check_gap(self, depth) -> None:
        last = self.last_depth_mm
        if isinstance(depth, float) and (depth <= last or depth == np.inf):
            return
        gap = (np.asarray(depth) > last * (1 + ROUNDING)) & np.isfinite(depth)
        if gap.any():
            raise DatabaseError(
                f"depth {np.asarray(depth)[gap].ravel()[0]:.6g} mm lies between the last finite node, {last:.6g} mm, "
                "and infinity, where table1 has no rule; add nodes or build with the exact interpolant"
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
        """Return tables (parts, nodes): the field's powers, then the parts of every depth group."""
        depth, colour = self.grid.depth, self.grid.wavelength
        both = np.concatenate([depth, np.broadcast_to(colour, (*depth.shape[:-1], colour.shape[-1]))], axis=-1)
        columns = [[KEPT.index(name) for name in group.parts] for group in self.rule.depth]
        tables = [both[..., some].reshape(-1, len(some)).T for some in columns]
        powers = [self.space.field_slopes**power for power in (1, 2, 3)]
        return [np.ascontiguousarray(table) for table in (powers, *tables)]

    @cached_property
    def _one(self) -> list[list]:
        """Return the same as plain rows, one per node, which one lookup is read from ten times faster."""
        return [table.T.tolist() for table in self._many]


def traced_grid(lens: Lens, space: Space, stop: Stop) -> NodeGrid:
    """Trace a lens at every (depth, wavelength) node of a space."""
    parts = traced_parts(lens, space.depths_mm[:, None], space.wavelengths_um, stop)
    shape = (len(space.depths_mm), len(space.wavelengths_um))
    depth = np.stack([np.broadcast_to(getattr(parts, name), shape) for name in STORED], axis=-1)
    return NodeGrid(depth, np.stack([np.broadcast_to(getattr(parts, x), shape)[0] for x in PER_WAVELENGTH], axis=-1))
