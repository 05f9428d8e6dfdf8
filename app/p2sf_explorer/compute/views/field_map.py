"""The PSF over the picture: a grid of places on the sensor, each PSF turned as its field is."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.conventions import degrees_from_slope, slope_from_degrees
from p2sf.disc.domain import HALF, PupilDomain, domain_of
from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.tolerance.nodal import third_order
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.method import WINDOWS
from p2sf_explorer.compute.sampled import in_window, optics
from p2sf_explorer.compute.setup import everywhere_by_coefficients, paraxial_setup
from p2sf_explorer.compute.views.field import widest_slope
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import State, change

SHAPE = 5, 7  # along the short and the long side: nearly square pictures fill the 3:2 of the sensor
ASPECT = 1.5  # of the sensor, whose corner is the field's edge
PIXELS = {"preview": 24, "settled": 64}
SAME_ANGLE = 1e-9  # radians
MOST_OF = 0.8  # of the widest window: the rest of the worst corner is cut


@dataclass(frozen=True)
class FieldMapRequest:
    """Everything the map depends on: ``state`` of any field, the slope at the corner, and each picture's window.

    ``domain``: HALF where fields of one distance from the axis share a picture, turned about the axis. ``nodes``: of
    "coma" and "astigmatism", the places x and y where these vanish to third order, 1 from the middle to the corner.
    ``upright``: the picture is as high as it is wide otherwise.
    """

    state: State
    corner_slope: float
    window: tuple[int, float]
    six: bool
    domain: PupilDomain = HALF
    nodes: tuple[tuple[str, float, float], ...] = ()
    upright: bool = False

    @property
    def places(self) -> np.ndarray:
        """Return where the pictures stand, (rows, columns, 2): x and y, 1 from the middle to the corner."""
        return places(self.upright)

    @property
    def edge(self) -> np.ndarray:
        """Return the largest x and y of the places."""
        return np.abs(self.places).max(axis=(0, 1))

    def field_of(self, place: np.ndarray) -> tuple[float, float]:
        """Return the field along x and along y, degrees, whose picture stands at a place."""
        return self.domain.field(*degrees_from_slope(np.asarray(place) * self.corner_slope).tolist())


def field_map(live: Live) -> View[None]:
    """Return what to show, which does not depend on the present field and so is not repeated while that is dragged."""
    corner, pixels = widest_slope(live), PIXELS[live.quality]
    s = live.setup
    slopes = np.array([0.0, 0.5, 1.0]) * corner
    c = coefficients(s.lens, s.source.depth_mm, slopes, s.source.wavelength_um, s.stop)
    wide = nice(MOST_OF * pixels * float(np.max(suitable_pixel_um(c, pixels))), WINDOWS)
    six, state = (
        everywhere_by_coefficients(live.state, live.setup),
        change(optics(live.state), field_deg=0.0, field_x_deg=0.0),
    )
    bent = s.lens.misaligned and not six
    nodes = nodes_of(s.lens, s.source.depth_mm, s.source.wavelength_um, corner) if bent else ()
    domain = domain_of(s.lens.mask.round and not bent)
    return View(None, FieldMapRequest(state, corner, (pixels, wide / pixels), six, domain, nodes))


@lru_cache(maxsize=8)
def nodes_of(
    lens: Lens, depth_mm: float, wavelength_um: float, corner_slope: float
) -> tuple[tuple[str, float, float], ...]:
    """Return where coma and astigmatism vanish to third order; none beyond the field, or where unknown."""
    try:
        found = third_order(lens, depth_mm, wavelength_um)
    except P2SFError:  # no six coefficients, or a lost chief ray: the map has no nodes to show
        return ()
    named = [("coma", found.coma_node), *(("astigmatism", node) for node in found.astigmatism_nodes)]
    at = ((name, node.imag / corner_slope, node.real / corner_slope) for name, node in named)
    return tuple((name, float(x), float(y)) for name, x, y in at if np.hypot(x, y) <= 1)


def place_of(state: State, corner_slope: float) -> tuple[float, float]:
    """Return where the present field stands in the map, as `places` has it."""
    x, y = (slope_from_degrees(np.array([state.optics.field_x_deg, state.optics.field_deg])) / corner_slope).tolist()
    return x, y


def places(upright: bool = False) -> np.ndarray:
    """Return where the pictures of a sensor stand, (rows, columns, 2): x and y, 1 from the middle to the corner."""
    short, long = (np.linspace(-1, 1, count) for count in SHAPE)
    sides = np.array([1.0, ASPECT]) / np.hypot(ASPECT, 1.0)
    x, y = (sides[0] * short, sides[1] * long) if upright else (sides[1] * long, sides[0] * short)
    return np.stack(np.meshgrid(x, -y), axis=-1)


def answer(request: FieldMapRequest, stopped: Callable[[], bool], tell: Callable[[float, object], None]) -> np.ndarray:
    """Return the pictures, (rows, columns, pixels, pixels), each over its own peak, from the middle out.

    ``tell`` is called after each field.
    """
    where = request.places
    shape = where.shape[:2]
    found = np.full((*shape, request.window[0], request.window[0]), np.nan, np.float32)
    fields: dict[tuple[float, float], list[tuple[int, ...]]] = {}
    for at in sorted(np.ndindex(*shape), key=lambda at: float(np.hypot(*where[at]))):
        fields.setdefault(request.field_of(where[at]), []).append(at)
    for number, (field, own) in enumerate(fields.items(), 1):
        if stopped():
            break
        values, inverted = picture_at(request, field)
        for at in own:
            found[at] = rotate_picture(values, float(np.arctan2(*where[at])) + (np.pi if inverted else 0.0))
        tell(number / len(fields), found)
    return found


def picture_at(request: FieldMapRequest, field_deg: tuple[float, float]) -> tuple[np.ndarray, bool]:
    """Return the PSF of a field (x, y) over its peak, NaN where there is none, and whether +y is towards the axis."""
    state = change(request.state, field_x_deg=field_deg[0], field_deg=field_deg[1])
    try:
        values = in_window(state, request.window, request.six).values
    except P2SFError:  # rays lost at the edge of the field: an empty place
        return np.full((request.window[0],) * 2, np.nan), False
    inverted = float(paraxial_setup(state).coefficients.image_height) < 0
    return values / (float(values.max()) or 1.0), inverted


def rotate_picture(values: np.ndarray, angle: float) -> np.ndarray:
    """Return a picture whose +y points ``angle`` radians from +y towards +x, straight lines between samples."""
    if abs(np.remainder(angle + 1, 2 * np.pi) - 1) < SAME_ANGLE:
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
