"""The quantities that every database stores per (depth, wavelength), and the six coefficients computed from them.

Everything is stored as mm of optical path at unit field slope, so that neither the 1/λ of waves nor the powers of
the field have to be interpolated.
"""

from collections.abc import Sequence
from math import copysign, inf
from typing import Any, NamedTuple

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import ParaxialRays, Stop, paraxial_rays
from p2sf.paraxial.seidel import Coefficients, defocus, seidel_sums

KINDS = ("w40", "w31", "w22", "w20", "w11", "wd")

Numbers = Any
"""A float, for a fast look-up of one point, or an array; the same arithmetic serves both."""


class Parts(NamedTuple):
    """Coefficients at unit field slope, mm of path, and the quantities that scale the PSF.

    ``nu`` is the reduced marginal slope n'u', ``y`` the marginal height at the last vertex (mm),
    ``chief`` the paraxial chief ray's height on the sensor at unit field slope (mm).
    """

    w40: np.ndarray
    w31: np.ndarray
    w22: np.ndarray
    w20: np.ndarray
    w11: np.ndarray
    wd: np.ndarray
    nu: np.ndarray
    y: np.ndarray
    chief: np.ndarray
    image_index: np.ndarray


PARTS = Parts._fields


def parts_of(lens: Lens, rays: ParaxialRays) -> Parts:
    """Return the stored quantities for these paraxial rays (Welford 1986, eq. 8.40)."""
    total = seidel_sums(lens, rays).total()
    index = rays.index[-1]
    return Parts(
        w40=total.spherical / 8,
        w31=total.coma / 2,
        w22=total.astigmatism / 2,
        w20=(total.astigmatism + total.petzval) / 4,
        w11=total.distortion / 2,
        wd=defocus(rays, lens.sensor_mm),
        nu=rays.nu[-1],
        y=rays.y[-1],
        chief=rays.chief_y[-1] + rays.chief_nu[-1] / index * lens.sensor_mm,
        image_index=index,
    )


def traced_parts(lens: Lens, depth_mm: float | np.ndarray, wavelength_um: float | np.ndarray, stop: Stop) -> Parts:
    """Return the parts over broadcast (depth, wavelength), traced directly."""
    return parts_of(lens, paraxial_rays(lens, depth_mm, wavelength_um, stop))


def assemble(parts: Parts, powers: Sequence[Numbers], wavelength_um: Numbers) -> Coefficients:
    """Return coefficients in waves from parts and the powers 1, 2, 3 of the field, for numbers or arrays."""
    waves = UM_PER_MM / wavelength_um
    first, second, third = powers
    return Coefficients(
        w40=parts.w40 * waves,
        w31=parts.w31 * waves * first,
        w22=parts.w22 * waves * second,
        w20=parts.w20 * waves * second,
        w11=parts.w11 * waves * third,
        wd=parts.wd * waves,
        reduced_slope=parts.nu,
        image_index=parts.image_index,
        image_distance=_quotient(-parts.image_index * parts.y, parts.nu),
        image_height=parts.chief * first,
        wavelength_um=wavelength_um,
    )


def _quotient(above: Numbers, below: Numbers) -> Numbers:
    """Return above/below, infinite where below is 0: the image is at infinity."""
    if isinstance(below, float):
        return above / below if below else copysign(inf, above)
    with np.errstate(divide="ignore"):
        return above / below
