"""Where the sensor of a lens is in focus: by first order or, behind tilts and decentres, by real rays on the axis."""

from functools import lru_cache, reduce
from math import inf, isfinite, nan

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.placement import Motion, along_z
from p2sf.lens.source import Source
from p2sf.paraxial import positions
from p2sf.paraxial.first_order import cardinal_points, image_distance

FAR_FOCAL_LENGTHS = 30.0  # a sensor in focus beyond them is in effect set for infinity
FAR_MM = 1e6  # six digits in a file do not distinguish a focus at a kilometre from infinity
FAR = 20.0  # focal lengths to the farther of two objects by whose images the focused one is found; the other is at half


def sensor_in_focus(lens: Lens, depth_mm: float) -> float:
    """Return where along the axis the sensor is in focus for a depth, mm behind the last vertex; infinite if nowhere.

    At the reference wavelength: the paraxial image or, where parts of the lens are tilted or decentred, halfway between
    both foci of the real chief ray of the field on the axis.
    """
    shift = focal_shift(lens, depth_mm) if lens.tilted else nan
    if isfinite(shift):
        return lens.sensor_mm + shift
    return float(image_distance(lens, depth_mm, lens.reference_wavelength_um))


@lru_cache(maxsize=128)
def focused_vergence(lens: Lens) -> float:
    """Return the vergence in 1/mm of the object that the sensor is in focus for, as `sensor_in_focus` has it.

    0 is infinity; it is negative for a sensor nearer to the lens than the image of infinity. The place of an image is
    (a + bv)/(1 + cv) for a vergence v, which three of them determine.
    """
    far = FAR * abs(float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length))
    if lens.tilted and isfinite(far):
        a, one, two = (focal_shift(lens, depth) for depth in (inf, far, far / 2))
        c = (a - 2 * one + two) / (2 * (one - two)) if one != two else 0.0  # per 1/far, as b
        b = one * (1 + c) - a
        if b and isfinite(a + b):
            return -a / b / far
    return positions.focused_vergence(lens)


def focused_distance(lens: Lens) -> float:
    """Return the object distance in mm whose paraxial image lies on the sensor; inf at or beyond infinity."""
    vergence = focused_vergence(lens)
    return 1 / vergence if vergence > 1 / FAR_MM else inf


@lru_cache(maxsize=64)
def object_distance(lens: Lens) -> float:
    """Return the distance in mm at which a source stands that is not placed elsewhere: that of the lens's design.

    Where it is not known, the distance that the sensor is in focus for, or infinity from thirty focal lengths on.
    """
    if lens.object_distance is not None:
        return lens.object_distance
    focused = focused_distance(lens)
    focal = abs(float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length))
    return float(f"{focused:.6g}") if focused <= FAR_FOCAL_LENGTHS * focal < inf else inf


@lru_cache(maxsize=128)
def focal_shift(lens: Lens, depth_mm: float) -> float:
    """Return how far behind the sensor the middle of both foci of the axis is, mm along the axis; NaN without one."""
    from p2sf.raytrace.field_curves import real_foci

    try:
        foci = real_foci(lens, Source(depth_mm, 0.0, lens.reference_wavelength_um), 0.0)
    except GeometryError:
        return nan
    turn = reduce(Motion.then, (one.motion for one in lens.sensor_before), along_z(0.0)).rotation
    return float(foci.sagittal + foci.tangential) / 2 / float(turn[2, 2])
