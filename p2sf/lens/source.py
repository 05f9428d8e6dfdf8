"""One point source: the point in (depth, field, wavelength) of a PSF."""

from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, inf, radians, sin
from typing import Any

import numpy as np

from p2sf.arguments import argument, in_own_unit
from p2sf.conventions import FARTHEST_MM, NM_PER_UM, degrees_from_slope, is_number, slope_from_degrees
from p2sf.errors import RequestError
from p2sf.messages import ParameterName
from p2sf.parameters import check_angle, check_distance, check_finite, check_positive, check_wavelength_nm

D_LINE_UM = 0.5875618
NAMES = "depth_mm", "field_slope", "wavelength_um", "field_deg", "wavelength_nm", "azimuth_deg"
PLAIN = frozenset((float, int, type(None)))
_set = object.__setattr__  # as the generated __init__ of a frozen dataclass sets its fields


@dataclass(frozen=True, init=False)
class Source:
    """A point source: its distance, field and wavelength.

    Parameters
    ----------
    depth_mm : float
        Distance of the object plane from the first vertex, mm, up to 1e16; inf (the default) is allowed.
    field_slope : float
        Slope (tangent) of the chief ray at the entrance pupil, 0 by default; for positive slopes the image is above the
        axis.
    wavelength_um : float
        Wavelength, µm; by default 0.5875618, the d line of helium.
    field_deg : float or (float, float)
        Instead of ``field_slope``: the angle of the chief ray, degrees, or its angles (x, y) if the source is outside
        the plane x = 0. Such a source is described as one in that plane, rotated by ``azimuth_deg``.
    wavelength_nm : float
        Instead of ``wavelength_um``: the wavelength, nm.
    azimuth_deg : float
        The direction in which the chief ray lands on the sensor, degrees from +y towards +x.

    Raises
    ------
    RequestError
        For an impossible value, and for a quantity given twice.

    Examples
    --------
    >>> Source(field_deg=10, wavelength_nm=587.6)
    Source(depth_mm=inf, field_deg=10, wavelength_nm=587.6)
    >>> round(Source(field_deg=(3, 4)).azimuth_deg, 2)
    36.85
    """

    depth_mm: float = inf
    field_slope: float = 0.0
    wavelength_um: float = D_LINE_UM
    azimuth_deg: float = 0.0

    def __init__(
        self,
        depth_mm: float | np.ndarray = inf,
        field_slope: float | np.ndarray | None = None,
        wavelength_um: float | np.ndarray | None = None,
        *,
        field_deg: float | tuple[float, float] | None = None,
        wavelength_nm: float | None = None,
        azimuth_deg: float = 0.0,
    ):
        given = (depth_mm, field_slope, wavelength_um, field_deg, wavelength_nm, azimuth_deg)
        if not PLAIN.issuperset(map(type, given)):
            depth_mm, field_slope, wavelength_um, field_deg, wavelength_nm, azimuth_deg = map(_number, NAMES, given)
        if depth_mm is None:
            raise RequestError("{parameter} is None; give a distance, inf for infinity", parameter="depth_mm")
        if field_deg is not None:
            _check_once("field_deg", "field_slope", field_slope)
            field_slope, azimuth_deg = _direction(field_deg, azimuth_deg)
        elif field_slope is None:
            field_slope = 0.0
        if wavelength_nm is not None:
            _check_once("wavelength_nm", "wavelength_um", wavelength_um)
            check_wavelength_nm("wavelength_nm", wavelength_nm)
            wavelength_um = wavelength_nm / NM_PER_UM
        elif wavelength_um is None:
            wavelength_um = D_LINE_UM
        _set(self, "depth_mm", depth_mm)
        _set(self, "field_slope", field_slope)
        _set(self, "wavelength_um", wavelength_um)
        _set(self, "azimuth_deg", azimuth_deg)
        try:
            possible = (
                (0 < depth_mm <= FARTHEST_MM or depth_mm == inf)
                and -inf < field_slope < inf
                and 0 < wavelength_um < inf
            )
        except ValueError:  # arrays describe many sources at once; the functions that use them check them
            return
        if not possible or azimuth_deg:
            _check(self)

    @property
    def field_deg(self) -> float:
        """Return the angle of the chief ray at the entrance pupil, degrees."""
        return float(degrees_from_slope(self.field_slope))

    @property
    def field_xy_deg(self) -> tuple[float, float]:
        """Return the angles (x, y) of the chief ray at the entrance pupil, degrees, as ``field_deg`` takes them."""
        x, y = (float(degrees_from_slope(slope)) for slope in self.slopes_xy)
        return x, y

    @property
    def slopes_xy(self) -> tuple[float, float]:
        """Return the slopes (x, y) of the chief ray at the entrance pupil, as `source_at` takes them."""
        turn = radians(self.azimuth_deg)
        off_axis = self.azimuth_deg % 180  # cos 90° and sin 180° are not exactly 0
        x, y = (self.field_slope * part for part in (sin(turn), cos(turn)))
        return x if off_axis else 0.0, y if off_axis != 90 else 0.0

    def __repr__(self) -> str:
        place = (
            f"depth_mm={_number_text(self.depth_mm)}, field_deg={_number_text(degrees_from_slope(self.field_slope))}"
        )
        turned = f", azimuth_deg={self.azimuth_deg:.10g}" if self.azimuth_deg else ""
        return f"Source({place}, wavelength_nm={_number_text(self.wavelength_um * NM_PER_UM)}{turned})"


def source_at(depth_mm: float, slope_x: float, slope_y: float, wavelength_um: float) -> Source:
    """Return the point source whose chief ray has these slopes in x and y at the entrance pupil."""
    azimuth = degrees(atan2(slope_x, slope_y))
    return Source(depth_mm, hypot(slope_x, slope_y), wavelength_um, azimuth_deg=azimuth)


def check_one(source: Source) -> None:
    """Raise RequestError for a source that holds arrays."""
    for value in (source.depth_mm, source.field_slope, source.wavelength_um, source.azimuth_deg):
        if not is_number(value):
            raise RequestError(
                "the source has values of shape {shape}, so it describes many sources; give one at a time",
                shape=str(np.shape(value)),
            )


def _number(name: str, value: Any) -> Any:
    """Return an argument without its unit; RequestError unless it is a number or an array of numbers."""
    return in_own_unit(name, value) if name == "field_deg" else argument(name, value, float | np.ndarray | None)


def _number_text(value: float | np.ndarray) -> str:
    return f"{value:.10g}" if np.ndim(value) == 0 else np.array2string(np.asarray(value), precision=6, threshold=6)


def _check(source: Source) -> None:
    check_distance("depth_mm", source.depth_mm)
    check_finite("field_slope", source.field_slope)
    check_positive("wavelength_um", source.wavelength_um)
    check_finite("azimuth_deg", source.azimuth_deg)


def _check_once(name: str, other: str, value: object) -> None:
    if value is not None:
        raise RequestError(
            "{parameter} and {other} are both given; keep one of them", parameter=name, other=ParameterName(other)
        )


def _direction(field_deg: float | tuple[float, float], azimuth_deg: float) -> tuple[float, float]:
    """Return the radial field slope of an angle, or of angles (x, y), and the azimuth in degrees."""
    given = np.asarray(field_deg)
    if given.shape not in ((), (2,)) or given.dtype.kind not in "biuf":
        raise RequestError(
            "{parameter} is {value}; give one angle in degrees, or two, x and y",
            parameter="field_deg",
            value=f"{field_deg!r:.40}",
        )
    angles = given.ravel().tolist()
    for angle in angles:
        check_angle("field_deg", angle)
    *beside, y = (float(slope_from_degrees(angle)) for angle in angles)
    x = beside[0] if beside else 0.0
    if x == 0:
        return y, azimuth_deg
    if azimuth_deg:
        _check_once("azimuth_deg", "field_deg", field_deg)
    return hypot(x, y), degrees(atan2(x, y))
