"""Every sign and unit of the project, stated once.

Geometry. Light travels +z. A radius is positive when the centre of curvature lies to the right.
Surfaces count from 1 in every message and file. Seidel signs are Welford's (Aberrations of
Optical Systems, 1986, ch. 8).

Units. Lens lengths mm; wavelength and sensor-plane coordinates µm; wavefront in waves; angles
radians. Whatever is not plain mm carries its unit in its name. Degrees and nanometres live only
in files, on the command line and in the app.

Source. Depth is the distance from the object plane to the first vertex, positive, ``inf`` allowed;
inside it is a vergence 1/depth so that infinity is an ordinary number. Field is the slope
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

import numpy as np

UM_PER_MM = 1000.0
NM_PER_UM = 1000.0


def vergence(distance_mm):
    """1/distance, per mm; 0 for an infinite distance, so that infinity needs no branch."""
    return 1.0 / np.asarray(distance_mm, dtype=float)


def slope_from_degrees(angle_deg):
    """Return field slope (tangent) of a field angle in degrees."""
    return np.tan(np.deg2rad(angle_deg))


def degrees_from_slope(slope):
    """Return field angle in degrees of a field slope."""
    return np.rad2deg(np.arctan(slope))


def centred_axis(count: int, step: float = 1.0) -> np.ndarray:
    """Sample positions of a PSF axis, shape (count,): sample count//2 is 0, the chief ray."""
    return (np.arange(count) - count // 2) * step


def anywhere(flags) -> bool:
    """Return whether any flag is set; the one flag of one source, a numpy bool, needs no reduction."""
    return bool(flags.any() if flags.ndim else flags)


def is_number(value) -> bool:
    """Return whether a value has no axes; np.ndim alone takes ten times as long for a plain number."""
    return isinstance(value, float | int) or np.ndim(value) == 0


def protected(values: np.ndarray) -> np.ndarray:
    """Return the array write-protected, as one that a cache hands out to everybody must be."""
    values.setflags(write=False)
    return values
