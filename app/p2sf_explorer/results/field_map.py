"""The PSF over the picture: a grid of places on the sensor, each PSF turned as its field is."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.conventions import degrees_from_slope, slope_from_degrees
from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.tolerance.nodal import third_order
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.method import WINDOWS
from p2sf_explorer.compute.sampled import in_window, optics
from p2sf_explorer.compute.setup import everywhere_by_coefficients, paraxial_setup
from p2sf_explorer.results.field import widest_slope
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import State, changed

SHAPE = 3, 9  # rows, columns
ASPECT = 1.5  # of the sensor, whose corner is the field's edge
PIXELS = {"preview": 24, "settled": 40}
MOST_OF = 0.8  # of the widest window: the rest of the worst corner is cut


@dataclass(frozen=True)
class FieldMapRequest:
    """Everything the map depends on: ``state`` of any field, the slope at the corner, and each picture's window.

    ``skew``: the lens is not symmetric, and every picture has a field (x, y) of its own. ``nodes``: of "coma" and
    "astigmatism", the places x and y where these vanish to third order, 1 from the middle to the corner.
    """

    state: State
    corner_slope: float
    window: tuple[int, float]
    six: bool
    skew: bool = False
    nodes: tuple[tuple[str, float, float], ...] = ()


def field_map(live: Live) -> FieldMapRequest:
    """Return what to show, which does not depend on the present field and so is not repeated while that is dragged."""
    corner, pixels = widest_slope(live), PIXELS[live.quality]
    s = live.setup
    slopes = np.array([0.0, 0.5, 1.0]) * corner
    c = coefficients(s.lens, s.source.depth_mm, slopes, s.source.wavelength_um, s.stop)
    wide = nice(MOST_OF * pixels * float(np.max(suitable_pixel_um(c, pixels))), WINDOWS)
    six, state = (
        everywhere_by_coefficients(live.state, live.setup),
        changed(optics(live.state), field_deg=0.0, field_x_deg=0.0),
    )
    skew = s.lens.misaligned and not six
    nodes = nodes_of(s.lens, s.source.depth_mm, s.source.wavelength_um, corner) if skew else ()
    return FieldMapRequest(state, corner, (pixels, wide / pixels), six, skew, nodes)


@lru_cache(maxsize=8)
def nodes_of(
    lens: Lens, depth_mm: float, wavelength_um: float, corner_slope: float
) -> tuple[tuple[str, float, float], ...]:
    """Return where in the map coma and astigmatism vanish to third order; none beyond the map, or where unknown."""
    try:
        found = third_order(lens, depth_mm, wavelength_um)
    except P2SFError:  # no six coefficients, or a lost chief ray: the map has no nodes to show
        return ()
    named = [("coma", found.coma_node), *(("astigmatism", node) for node in found.astigmatism_nodes)]
    edge = np.abs(places()).max(axis=(0, 1))
    at = ((name, node.imag / corner_slope, node.real / corner_slope) for name, node in named)
    return tuple((name, float(x), float(y)) for name, x, y in at if abs(x) <= edge[0] and abs(y) <= edge[1])


def fields_deg(place: np.ndarray, corner_slope: float) -> tuple[float, float]:
    """Return the field along x and along y, degrees, of a place of the map, 1 from the middle to the corner."""
    x, y = degrees_from_slope(np.asarray(place) * corner_slope).tolist()
    return x, y


def place_of(state: State, corner_slope: float) -> tuple[float, float]:
    """Return where the present field stands in the map, as `places` has it."""
    x, y = (slope_from_degrees(np.array([state.optics.field_x_deg, state.optics.field_deg])) / corner_slope).tolist()
    return x, y


def places() -> np.ndarray:
    """Return where the pictures stand, (rows, columns, 2): x and y, 1 from the middle to the corner."""
    corner = np.hypot(ASPECT, 1.0)
    x = np.linspace(-1, 1, SHAPE[1]) * ASPECT / corner
    y = np.linspace(1, -1, SHAPE[0]) / corner
    return np.stack(np.meshgrid(x, y), axis=-1)


def answer(request: FieldMapRequest, stopped: Callable[[], bool], tell: Callable[[float, object], None]) -> np.ndarray:
    """Return the pictures, (rows, columns, pixels, pixels), each over its own peak; ``tell`` is called after each.

    Fields of one distance from the axis share a PSF, mirrored or turned about the axis (the lens is round).
    """
    found = np.full((*SHAPE, request.window[0], request.window[0]), np.nan, np.float32)
    where = places()
    radius = np.round(np.hypot(where[..., 0], where[..., 1]), 9)
    if request.skew:
        return _everywhere(request, where, found, stopped, tell)
    rings = np.unique(radius)
    for number, ring in enumerate(rings, 1):
        if stopped():
            break
        values = picture_at(request, float(ring))
        for at in zip(*np.nonzero(radius == ring), strict=True):
            found[at] = turned(values, float(np.arctan2(where[at][0], where[at][1])))
        tell(number / len(rings), found)
    return found


def _everywhere(
    request: FieldMapRequest,
    where: np.ndarray,
    found: np.ndarray,
    stopped: Callable[[], bool],
    tell: Callable[[float, object], None],
) -> np.ndarray:
    """Return the pictures of a lens that is not symmetric, none of which stands in for another; from the middle out."""
    order = sorted(np.ndindex(*SHAPE), key=lambda at: float(np.hypot(*where[at])))
    for number, at in enumerate(order, 1):
        if stopped():
            break
        found[at] = _skew_picture(request, where[at])
        tell(number / len(order), found)
    return found


def _skew_picture(request: FieldMapRequest, place: np.ndarray) -> np.ndarray:
    """Return the PSF at a place of the map over its peak, in the sensor's axes, NaN where there is none."""
    field_x, field_y = fields_deg(place, request.corner_slope)
    state = changed(request.state, field_deg=field_y, field_x_deg=field_x)
    try:
        setup = paraxial_setup(state)
        values = in_window(state, request.window, request.six).values
    except P2SFError:  # rays lost at the edge of the field: an empty place
        return np.full((request.window[0],) * 2, np.nan)
    inverted = float(setup.coefficients.image_height) * setup.source.field_slope < 0
    angle = np.deg2rad(setup.source.azimuth_deg) + (np.pi if inverted else 0.0)
    return turned(values, float(angle)) / (float(values.max()) or 1.0)


def picture_at(request: FieldMapRequest, ring: float) -> np.ndarray:
    """Return the PSF at a share of the corner's field over its peak, +y away from the axis, NaN where there is none."""
    state = changed(request.state, field_deg=float(degrees_from_slope(ring * request.corner_slope)))
    try:
        values = in_window(state, request.window, request.six).values
    except P2SFError:  # rays lost at the edge of the field: an empty place
        return np.full((request.window[0],) * 2, np.nan)
    outward = values if float(paraxial_setup(state).coefficients.image_height) >= 0 else turned(values, np.pi)
    return outward / (float(values.max()) or 1.0)


def turned(values: np.ndarray, angle: float) -> np.ndarray:
    """Return a picture whose +y points ``angle`` radians from +y towards +x, straight lines between samples."""
    if not angle:
        return values
    count = len(values)
    axis = np.arange(count) - count // 2
    x, y = np.meshgrid(axis, axis)
    column = np.cos(angle) * x - np.sin(angle) * y + count // 2
    row = np.sin(angle) * x + np.cos(angle) * y + count // 2
    left, low = np.floor(column).astype(int), np.floor(row).astype(int)
    right, up = column - left, row - low
    padded = np.pad(values, ((0, 1), (0, 1)))
    inside = (left >= 0) & (left < count) & (low >= 0) & (low < count)
    left, low = np.where(inside, left, 0), np.where(inside, low, 0)
    below = (1 - right) * padded[low, left] + right * padded[low, left + 1]
    above = (1 - right) * padded[low + 1, left] + right * padded[low + 1, left + 1]
    return np.where(inside, (1 - up) * below + up * above, 0.0)
