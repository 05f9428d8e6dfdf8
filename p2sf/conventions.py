"""Every sign and unit of the project, stated once (handbook 1).

Geometry. Light travels +z. A radius is positive when the centre of curvature lies to the right.
Surfaces count from 1 in every message and file. Seidel signs are Welford's (Aberrations of
Optical Systems, 1986, ch. 8).

Units. Lens lengths mm; wavelength and sensor-plane coordinates µm; wavefront in waves; angles
radians. Whatever is not plain mm carries its unit in its name. Degrees and nanometres occur only
in files, on the command line and in the window.

Source. Depth is the distance from the object plane to the first vertex, positive, ``inf`` allowed;
computations use the vergence 1/depth, for which infinity is an ordinary number. Field is the slope
(tangent) of the chief ray at the entrance pupil, at every depth; a positive field comes from an
object below the axis and lands above it.

Axes. (depth, field, wavelength) come first and broadcast; physics axes come last, (…, y, x) and
(…, ray, 3); per-surface results put the surface first, so that a Seidel sum is ``.sum(0)``.

Wavefront. W = (optical path of the chief ray − optical path of the ray)/λ, positive for
undercorrected spherical aberration; W(ρ, θ) with θ from the +y axis, the field's direction.

PSF. Rows are +y up the sensor, columns +x, sample N//2 is the chief ray, unit sum. The field at
sensor offset (x, y) is ΣA·exp(+i2πW)·exp(−i2π n'u'(ξx + ηy)/λ) over entrance-pupil coordinates
(ξ, η), with u' the *signed* image-space marginal slope: −n'u' > 0 for a real image, which makes
this numpy's ``ifft2`` sign, and a relay is not turned by 180°.
"""

from math import atan, degrees, hypot, inf, radians, tan
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

FloatOrArray: TypeAlias = float | np.ndarray  # the formula is the same; plain numbers are several times faster

UM_PER_MM = 1000.0
NM_PER_UM = 1000.0
FARTHEST_MM = 1e16  # beyond Neptune: in double precision the rays from such a point are parallel


def vergence(distance_mm: ArrayLike) -> np.ndarray:
    """Return 1/distance, per mm; 0 for an infinite distance, so that infinity needs no branch."""
    return 1.0 / np.asarray(distance_mm, dtype=float)


def depth_of(vergence_per_mm: float) -> float:
    """Return the depth in mm of a vergence; inf for 0 and for a rounding residue of it."""
    return inf if abs(vergence_per_mm) * FARTHEST_MM < 1 else 1 / float(vergence_per_mm)


def slope_from_degrees(angle_deg: ArrayLike) -> np.ndarray:
    """Return the field slope (tangent) of a field angle in degrees."""
    slope: np.ndarray = np.tan(np.deg2rad(angle_deg))
    return slope


def degrees_from_slope(slope: ArrayLike) -> np.ndarray:
    """Return the field angle in degrees of a field slope."""
    degrees: np.ndarray = np.rad2deg(np.arctan(slope))
    return degrees


def angle_from_axis(x_deg: float, y_deg: float) -> float:
    """Return the angle between the axis and a field with these angles along x and y, degrees."""
    if not (x_deg and y_deg):
        return abs(x_deg or y_deg)
    return degrees(atan(hypot(tan(radians(x_deg)), tan(radians(y_deg)))))


def centred_axis(count: int, step: float = 1.0) -> np.ndarray:
    """Return sample positions of a PSF axis, shape (count,): sample count//2 is 0, the chief ray."""
    return (np.arange(count) - count // 2) * step


def anywhere(flags: np.ndarray | np.bool) -> bool:
    """Return whether any flag is set; a single numpy bool needs no reduction."""
    return bool(flags.any() if flags.ndim else flags)


def is_number(value: ArrayLike) -> bool:
    """Return whether a value has no axes; `np.ndim` alone takes ten times as long for a plain number."""
    return isinstance(value, float | int) or np.ndim(value) == 0


def write_protect(values: np.ndarray) -> np.ndarray:
    """Return the array write-protected, since a cache returns the same array to all callers."""
    values.setflags(write=False)
    return values
