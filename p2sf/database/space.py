"""The part of (depth, field, wavelength) space that a database covers, and the nodes laid through it."""

from dataclasses import dataclass
from math import inf, isfinite

import numpy as np

from p2sf.conventions import NM_PER_UM, degrees_from_slope, vergence
from p2sf.errors import DatabaseError

# A limit typed in degrees or nanometres comes back a rounding or two away from the node it was meant to be.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Space:
    """Nodes along each axis, ascending; what lies between the outermost nodes is covered.

    Attributes
    ----------
    depths_mm
        Object distances from the first vertex, shape (depths,), mm; the last may be inf.
    field_slopes
        Chief-ray slopes at the entrance pupil, shape (fields,).
    wavelengths_um
        Wavelengths, shape (wavelengths,), µm.
    """

    depths_mm: np.ndarray
    field_slopes: np.ndarray
    wavelengths_um: np.ndarray

    def __post_init__(self):
        for key, name in (("depths_mm", "depth"), ("field_slopes", "field"), ("wavelengths_um", "wavelength")):
            object.__setattr__(self, key, _ascending(getattr(self, key), name))
        if not self.depths_mm[0] > 0:
            raise DatabaseError(f"depth {self.depths_mm[0]:g} mm is not in front of the lens; give positive depths")
        limits = [_widened(float(x[0]), float(x[-1])) for x in (self.depths_mm, self.field_slopes, self.wavelengths_um)]
        object.__setattr__(self, "_limits", limits)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Return how many nodes there are along depth, field and wavelength."""
        return len(self.depths_mm), len(self.field_slopes), len(self.wavelengths_um)

    @property
    def axes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return depth, field slope and wavelength as arrays that broadcast to ``shape``."""
        return self.depths_mm[:, None, None], self.field_slopes[:, None], self.wavelengths_um

    def check_one(self, depth_mm: float, field_slope: float, wavelength_um: float) -> None:
        """Raise DatabaseError, naming the range, unless this one point is covered."""
        (near, far), (low, high), (blue, red) = self._limits
        if not (near <= depth_mm <= far and low <= field_slope <= high and blue <= wavelength_um <= red):
            self.check(depth_mm, field_slope, wavelength_um)

    def check(self, depth_mm, field_slope, wavelength_um) -> None:
        """Raise DatabaseError, naming the range, unless every point is covered."""
        kinds = (("depth", "mm", _same), ("field", "degrees", degrees_from_slope), ("wavelength", "nm", _in_nm))
        for values, limits, kind in zip((depth_mm, field_slope, wavelength_um), self._limits, kinds, strict=True):
            _check_axis(np.asarray(values, dtype=float), limits, *kind)


def _same(value):
    return value


def _in_nm(value):
    return value * NM_PER_UM


def _widened(low: float, high: float) -> tuple[float, float]:
    return (low - ROUNDING * abs(low) if isfinite(low) else low), high + ROUNDING * abs(high)


def _check_axis(values: np.ndarray, limits, name: str, unit: str, shown) -> None:
    inside = (values >= limits[0]) & (values <= limits[1])
    if not inside.all():
        wrong = values[~inside].ravel()[0]
        bad, low, high = (shown(x) for x in (wrong, *limits))
        mirrored = name == "field" and limits[0] <= -wrong <= limits[1]
        way = f"ask for {-bad:.6g} {unit}, whose PSF is the same upside down" if mirrored else "ask inside"
        raise DatabaseError(
            f"{name} {bad:.6g} {unit} is outside this database, which covers {low:.6g} to {high:.6g} {unit}; "
            f"{way}, or build one that reaches there"
        )


def _ascending(values, name: str) -> np.ndarray:
    nodes = np.array(values, dtype=float, ndmin=1)
    if nodes.ndim != 1 or not nodes.size or np.isnan(nodes).any() or not (nodes[1:] > nodes[:-1]).all():
        raise DatabaseError(f"the {name} nodes must be one or more numbers in ascending order; sort them")
    if not np.isfinite(nodes[:-1]).all() or (name != "depth" and not np.isfinite(nodes[-1])):
        raise DatabaseError(f"a {name} node is not finite; only a depth may be infinite")
    nodes.flags.writeable = False
    return nodes


def depth_nodes(near_mm: float, far_mm: float = inf, count: int = 20) -> np.ndarray:
    """Return depths uniform in 1/depth, nearest first, shape (count,), mm; ``far_mm`` may be inf."""
    with np.errstate(divide="ignore"):
        depths = 1 / np.linspace(vergence(near_mm), vergence(far_mm), count)
    depths[0] = near_mm
    if count > 1:
        depths[-1] = far_mm
    return depths
