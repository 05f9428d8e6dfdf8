"""The part of (depth, field, wavelength) space that a database covers, and its nodes."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import isfinite

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import NM_PER_UM, degrees_from_slope
from p2sf.errors import DatabaseError
from p2sf.lens.source import Source, source_at
from p2sf.messages import Message
from p2sf.parameters import check_distance

# Converted from degrees or nanometres and back, a limit is a rounding or two away from its node.
ROUNDING = 1e-9

Limits = tuple[float, float]
DEPTH, FIELD, WAVELENGTH = Message("depth"), Message("field"), Message("wavelength")
FIELD_X, FIELD_Y = Message("field x"), Message("field y")


@dataclass(frozen=True, eq=False)
class Space:
    """Nodes along each axis, ascending; a database covers everything between the outermost ones.

    Attributes
    ----------
    depths_mm
        Object distances from the first vertex, shape (depths,), mm; the last may be inf.
    field_slopes
        Chief-ray slopes at the entrance pupil, shape (fields,); those along y where there are others along x.
    wavelengths_um
        Wavelengths, shape (wavelengths,), µm.
    field_x_slopes
        Chief-ray slopes along x, shape (fields x,), of a space whose fields fill a rectangle, as a lens without
        symmetry needs them. None: fields along one line, which represent all azimuths.
    """

    depths_mm: np.ndarray
    field_slopes: np.ndarray
    wavelengths_um: np.ndarray
    field_x_slopes: np.ndarray | None = None

    def __post_init__(self) -> None:
        for key, axis in (("depths_mm", DEPTH), ("field_slopes", FIELD), ("wavelengths_um", WAVELENGTH)):
            object.__setattr__(self, key, _ascending(getattr(self, key), axis))
        if self.field_x_slopes is not None:
            object.__setattr__(self, "field_x_slopes", _ascending(self.field_x_slopes, FIELD_X))
        if not self.depths_mm[0] > 0:
            raise DatabaseError(
                "depth {depth:g} mm is not in front of the lens; give positive depths", depth=float(self.depths_mm[0])
            )

        for depth in self.depths_mm.tolist():
            check_distance("depths_mm", depth)

    @cached_property
    def _limits(self) -> tuple[Limits, Limits, Limits]:
        slopes = self.field_slopes if self.field_x_slopes is None else np.array([-1, 1]) * self.radial_slopes.max()
        return _widen(self.depths_mm), _widen(slopes), _widen(self.wavelengths_um)

    @property
    def nodes(self) -> tuple[np.ndarray, ...]:
        """Return the nodes along depth, field and wavelength; of a rectangle of fields those along y, then x."""
        across = () if self.field_x_slopes is None else (self.field_x_slopes,)
        return self.depths_mm, self.field_slopes, *across, self.wavelengths_um

    @property
    def shape(self) -> tuple[int, ...]:
        """Return the number of nodes along each axis."""
        return tuple(len(nodes) for nodes in self.nodes)

    @property
    def axes(self) -> tuple[np.ndarray, ...]:
        """Return ``nodes`` as arrays that broadcast to ``shape``."""
        return np.ix_(*self.nodes)

    @cached_property
    def radial_slopes(self) -> np.ndarray:
        """Return the slopes of all fields away from the axis, (fields,), or (fields y, fields x) of a rectangle."""
        if self.field_x_slopes is None:
            return self.field_slopes
        found: np.ndarray = np.hypot(self.field_slopes[:, None], self.field_x_slopes)
        return found

    @property
    def line(self) -> "Space":
        """Return the space whose fields along one line reach as far from the axis as those of the rectangle."""
        if self.field_x_slopes is None:
            return self
        slopes = np.unique([0.0, self.radial_slopes.max()])
        return Space(self.depths_mm, slopes, self.wavelengths_um)

    def source(self, *point: float) -> Source:
        """Return the source at a point, given in the order of ``nodes``."""
        depth, *slopes, wavelength = point
        if len(slopes) == 1:
            return Source(depth, slopes[0], wavelength)
        return source_at(depth, slopes[1], slopes[0], wavelength)

    def check_source(self, source: Source) -> None:
        """Raise DatabaseError, naming the range, unless this source is covered."""
        if self.field_x_slopes is None:
            return self.check_one(source.depth_mm, source.field_slope, source.wavelength_um)
        across, up = source.slopes_xy
        for slope, nodes, axis in ((across, self.field_x_slopes, FIELD_X), (up, self.field_slopes, FIELD_Y)):
            _check_axis(np.array(slope), _widen(nodes), axis, *SHOWN_AXES[1][1:])
        return self.check_one(source.depth_mm, 0.0, source.wavelength_um)

    def check_one(self, depth_mm: float, field_slope: float, wavelength_um: float) -> None:
        """Raise DatabaseError, naming the range, unless this one point is covered."""
        (near, far), (low, high), (blue, red) = self._limits
        if not (near <= depth_mm <= far and low <= field_slope <= high and blue <= wavelength_um <= red):
            self.check(depth_mm, field_slope, wavelength_um)

    def check(self, depth_mm: ArrayLike, field_slope: ArrayLike, wavelength_um: ArrayLike) -> None:
        """Raise DatabaseError, naming the range, unless every point is covered."""
        points = (depth_mm, field_slope, wavelength_um)
        for values, limits, shown in zip(points, self._limits, SHOWN_AXES, strict=True):
            _check_axis(np.asarray(values, dtype=float), limits, *shown)


def _same(value: float) -> float:
    return value


def _in_degrees(slope: float) -> float:
    return float(degrees_from_slope(slope))


def _in_nm(wavelength_um: float) -> float:
    return wavelength_um * NM_PER_UM


# Each axis in error messages: its name, its unit and the conversion to that unit.
SHOWN_AXES = (
    (DEPTH, Message("mm"), _same),
    (FIELD, Message("degrees"), _in_degrees),
    (WAVELENGTH, Message("nm"), _in_nm),
)


def _widen(nodes: np.ndarray) -> Limits:
    """Return the outermost nodes, extended by ROUNDING."""
    low, high = float(nodes[0]), float(nodes[-1])
    return (low - ROUNDING * abs(low) if isfinite(low) else low), high + ROUNDING * abs(high)


def _check_axis(
    values: np.ndarray, limits: Limits, axis: Message, unit: Message, shown: Callable[[float], float]
) -> None:
    inside = (values >= limits[0]) & (values <= limits[1])
    if inside.all():
        return
    wrong = float(values[~inside].ravel()[0])
    remedy = Message("ask inside, or build one that reaches there")
    if axis is FIELD and limits[0] <= -wrong <= limits[1]:
        remedy = Message(
            "ask for {mirror:.6g} {unit}, whose PSF is the same upside down, or build one that reaches there",
            mirror=-shown(wrong),
            unit=unit,
        )
    raise DatabaseError(
        "{axis} {value:.6g} {unit} is outside this database, which covers {low:.6g} to {high:.6g} {unit}; {remedy}",
        axis=axis,
        value=shown(wrong),
        unit=unit,
        low=shown(limits[0]),
        high=shown(limits[1]),
        remedy=remedy,
    )


def _ascending(values: ArrayLike, axis: Message) -> np.ndarray:
    """Return nodes as a write-protected array. Raises DatabaseError."""
    nodes = np.array(values, dtype=float, ndmin=1)
    if nodes.ndim != 1 or not nodes.size or np.isnan(nodes).any() or not (nodes[1:] > nodes[:-1]).all():
        raise DatabaseError("the {axis} nodes must be one or more numbers in ascending order; sort them", axis=axis)
    if not np.isfinite(nodes[:-1]).all() or (axis is not DEPTH and not np.isfinite(nodes[-1])):
        raise DatabaseError("a {axis} node is not finite; only a depth may be infinite", axis=axis)
    nodes.flags.writeable = False
    return nodes
