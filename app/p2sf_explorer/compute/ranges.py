"""The closest source distance, where a lens is focused, and the wavelengths its glasses have data for. No Qt here."""

from functools import lru_cache
from math import inf, isfinite

import numpy as np

from p2sf.conventions import NM_PER_UM, angle_from_axis, slope_from_degrees
from p2sf.lens.lens import Lens, indices, lens_range_um
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.lens_checks import AIR_LIKE
from p2sf.paraxial.pupils import f_number, paraxial_rays
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import steepest_slope
from p2sf.raytrace.focusing import FAR_MM, focused_distance, focused_vergence, object_distance
from p2sf_explorer.state.scales import nice

VISIBLE_NM = (400.0, 700.0)
SHARES = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01)
FOCAL_LENGTHS = 10.0  # from the lens to the middle of a slider of distance
ABOVE_CLOSEST = 1.2  # times the closest distance: the middle is farther than the end
OPENED, OPENINGS = 1.4, 401  # times as fast as its file says, at most, and how many of these are tried
TELLING_WAVES = 60.0  # of slope: a steeper wavefront is a blur of rays that shows no diffraction


def closest_distance(lens: Lens) -> float:
    """Return the closest sensible source distance in mm: outside the front focus by a fifth of the focal length.

    For a lens that is focused closer than that (a relay), or whose object stands closer, half of that distance.
    """
    cardinal = cardinal_points(lens, lens.reference_wavelength_um)
    focal = abs(float(cardinal.effective_focal_length))
    focus = -float(cardinal.front_focal_distance)
    if not isfinite(focal):
        return nice(2 * lens.vertices[-1] + 10)
    closest = nice(max(focus + 0.2 * focal, 0.5 * focal), (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8))
    focused = min(focused_distance(lens), object_distance(lens))
    if focused > 1.5 * closest:
        return closest
    return 0.5 * (focus + focused) if 0 < focus < focused else 0.5 * focused


def middle_distance(lens: Lens) -> float | None:
    """Return the distance in mm for the middle of the sliders of distance: ten focal lengths, or a nearer file's focus.

    Beside the focus a slider must be fine: a photographer's lens is focused at metres, a relay at two focal lengths.
    None for an afocal lens, which has no such scale.
    """
    focal = abs(float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length))
    if not isfinite(focal):
        return None
    near = min(FOCAL_LENGTHS * focal, focused_distance(lens), object_distance(lens))
    return max(near, ABOVE_CLOSEST * closest_distance(lens))


def file_focus(lens: Lens) -> float:
    """Return `focused_distance`, but negative for a sensor nearer to the lens than the image of infinity is, mm."""
    vergence = focused_vergence(lens)
    return 1 / vergence if abs(vergence) > 1 / FAR_MM else inf


@lru_cache(maxsize=32)
def wavelength_range(lens: Lens) -> tuple[float, float]:
    """Return the visible wavelengths every glass of the lens has data for, nm."""
    low, high = lens_range_um(lens) or (0.0, inf)
    low, high = max(VISIBLE_NM[0], NM_PER_UM * low), min(VISIBLE_NM[1], NM_PER_UM * high)
    return (low, high) if low < high else VISIBLE_NM


@lru_cache(maxsize=32)
def fastest_f_number(lens: Lens) -> float:
    """Return the smallest f-number up to which a slider goes: OPENED times as fast, while all glass has an edge.

    The edge is judged at the heights of the axial beam. A lens whose glass has none in its file opens no farther.
    """
    usual = float(f_number(lens, lens.reference_wavelength_um))
    if not isfinite(usual):
        return 1.0
    heights = np.abs(paraxial_rays(lens, inf, lens.reference_wavelength_um).y)
    index = np.abs(indices(lens, lens.reference_wavelength_um))
    glass = np.flatnonzero(index[1:-1] > AIR_LIKE)
    opened = np.linspace(1.0, OPENED, OPENINGS)
    kept = np.ones(OPENINGS, bool)
    for k in glass.tolist():
        front, back = lens.surfaces[k : k + 2]
        rim = np.maximum(heights[k], heights[k + 1]) * opened
        with np.errstate(invalid="ignore"):
            behind, before = (surface.sag(0.0, rim) for surface in (back, front))
        edge = (lens.gaps[k] + behind - before) * lens.directions[k + 1]
        kept &= ~(edge <= 0)  # beyond its own edge a surface has no sag, and `lens_checks` warns
    return usual / float(opened[np.logical_and.accumulate(kept)].max(initial=1.0))


def telling_field(lens: Lens, depth_mm: float) -> tuple[float, float]:
    """Return a field (x, y), degrees, worth showing first: the file's middle one; near by, a share showing diffraction.

    A relay's file may state fields for infinity that at its own depth are objects wider than its glass.
    """
    places = lens.field_places_deg
    middle = places[len(places) // 2]
    middle = middle if any(middle) else places[-1]
    if not isfinite(depth_mm):
        return middle
    slopes = slope_from_degrees(angle_from_axis(*middle) * np.array(SHARES))
    steep = steepest_slope(coefficients(lens, depth_mm, slopes, lens.reference_wavelength_um))
    good = np.flatnonzero(steep <= TELLING_WAVES)
    share = SHARES[good[0]] if good.size else 1.0
    return middle[0] * share, middle[1] * share
