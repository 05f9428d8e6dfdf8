"""Blur against depth, and the depths between which it stays within what is tolerated."""

from dataclasses import dataclass
from math import inf, nan

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import P2SFError
from p2sf.lens.lens import seen_from
from p2sf.paraxial.depth_of_field import AxialBlur
from p2sf.pupil.landing import RINGS, landing
from p2sf.raytrace.pencil import Sources
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.ranges import closest_distance
from p2sf_explorer.compute.setup import ParaxialSetup, prescription
from p2sf_explorer.state.scales import nice

DEPTHS = {"preview": 17, "settled": 49}
FEWER_RINGS = 5  # while a slider moves, and to find the range
FEWEST = 3  # rays: fewer are no spot
FOCUS_UM = 1e-3  # a blur this small counts as none
SEEN = 3  # times what is tolerated: the sharp range, with as much again on either side
FAR_OFF = 2.0  # widths of the range: a least blur farther off is left out
AIR = 0.1  # of the range, beyond a least blur


@dataclass(frozen=True)
class DepthOfField:
    """Blur against depth: ``near`` is 1/depth in 1/mm, rising; diameters in µm.

    ``paraxial``: of the axial point's geometric blur; ``real``: twice the RMS radius of exact rays at the present
    field, NaN where they are lost. ``sharp_mm``: nearest and farthest depth whose paraxial blur is within
    ``tolerated_um``, None if there is none; ``hyperfocal_mm``: focus here and infinity is just sharp.
    """

    near: np.ndarray
    paraxial: np.ndarray
    real: np.ndarray
    tolerated_um: float
    sharp_mm: tuple[float, float] | None
    hyperfocal_mm: float


def depth_of_field(live: Live) -> View[DepthOfField]:
    """Return the blur at every depth with the sensor where it stands."""
    s, tolerated = live.setup, live.state.display.blur_um
    axial = axial_blur(s)
    clear = axial.sharp_mm(tolerated)
    near = np.linspace(*visible_range(live, 1 / closest_distance(prescription(live.state))), DEPTHS[live.quality])
    if focus := axial.sharp_mm(FOCUS_UM):
        near = np.sort(np.append(near, 1 / focus[1]))  # so that the V of the blur reaches its tip
    depths = np.divide(1.0, near, out=np.full(near.shape, inf), where=near > 0)
    heights = axial.heights_mm(depths)
    return View(
        DepthOfField(
            near,
            2 * UM_PER_MM * np.abs(heights),
            real_blur(live, depths, RINGS if live.quality == "settled" else FEWER_RINGS),
            tolerated,
            clear,
            axial.hyperfocal_mm(tolerated),
        )
    )


def visible_range(live: Live, closest: float) -> tuple[float, float]:
    """Return the 1/depth to show, 1/mm, up to ``closest``: about what is sharp, wider where there is more to see.

    As wide as the paraxial blur stays below three times what is tolerated, or twice the least there is; where the
    exact rays' least blur is larger, up to that; and out to where they have it, unless that is too far off.
    """
    blur = max(SEEN * live.state.display.blur_um, 2 * least_axial(live, closest))
    ends = within(live.setup, blur, closest)
    least = np.nanmin(probe_blur(live, ends)[1], initial=inf)
    if blur < least < inf:
        ends = within(live.setup, least, closest)
    vertex, air = vertex_of(*probe_blur(live, ends)), AIR * (ends[1] - ends[0])
    if not -FAR_OFF < (vertex - ends[0]) / (ends[1] - ends[0]) < 1 + FAR_OFF:
        return ends
    return max(0.0, min(ends[0], vertex - air)), min(max(closest, ends[1]), max(ends[1], vertex + air))


def highest(view: DepthOfField) -> float:
    """Return how much blur to show, µm: what is tolerated and the least of either curve, with air above."""
    least = max(
        float(np.nanmin(blur, initial=0.0 if np.isnan(blur).all() else inf)) for blur in (view.paraxial, view.real)
    )
    return nice(max(SEEN * view.tolerated_um, 2 * least), (1, 1.5, 2, 3, 4, 6, 8))


def within(setup: ParaxialSetup, blur_um: float, closest: float) -> tuple[float, float]:
    """Return between which 1/depth, 1/mm, the paraxial blur is below this, up to ``closest`` or just beyond its own."""
    clear = axial_blur(setup).sharp_mm(blur_um)
    if clear is None or not clear[0]:
        return 0.0, closest
    low, high = (1 / depth for depth in clear[::-1])
    return low, high if low < closest else 1.01 * high


def least_axial(live: Live, closest: float) -> float:
    """Return the least paraxial blur from infinity to 1/``closest``, µm; 0 where any depth is sharp."""
    axial = axial_blur(live.setup)
    if axial.sharp_mm(live.state.display.blur_um):
        return 0.0
    return 2 * UM_PER_MM * float(np.abs(axial.heights_mm(np.array([inf, 1 / closest]))).min())


def probe_blur(live: Live, ends: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Return three 1/depth over a range and the exact rays' blur there, µm."""
    near = np.linspace(*ends, 3)
    return near, real_blur(live, np.divide(1.0, near, out=np.full(3, inf), where=near > 0), FEWER_RINGS)


def vertex_of(near: np.ndarray, blur: np.ndarray) -> float:
    """Return where a blur of three equal steps is least, its square being quadratic; NaN where it is least nowhere.

    The spot of rays that all move linearly with the defocus has a variance quadratic in it.
    """
    first, middle, last = blur**2
    bend = first - 2 * middle + last
    return float(near[1] + (near[1] - near[0]) * (first - last) / (2 * bend)) if bend > 0 else nan


def axial_blur(setup: ParaxialSetup) -> AxialBlur:
    """Return the paraxial blur at every depth."""
    return AxialBlur(setup.lens, setup.source.wavelength_um, setup.stop)


def real_blur(live: Live, depths: np.ndarray, rings: int) -> np.ndarray:
    """Return twice the RMS radius of the exact rays' spot at the present field, µm, per depth, weighted by light."""
    s = live.setup
    source = Sources(np.asarray(depths), s.source.field_slope, s.source.wavelength_um)
    try:
        found = landing(seen_from(s.lens, s.source.azimuth_deg), source, live.state.optics.clip, rings=rings)
    except P2SFError:  # a chief ray is lost at some depth: only the paraxial curve remains
        return np.full(len(depths), np.nan)
    blur = np.where(np.count_nonzero(found.light, -1) < FEWEST, np.nan, 2 * np.hypot(*found.rms_um))
    # One depth alone, of a lens whose rays are lost at the others, is no curve.
    return blur if np.count_nonzero(np.isfinite(blur)) > 1 else np.full(len(depths), np.nan)
