"""The (depth, field) space of the present lens from its coefficient databases: maps, what interpolants lose, an atlas.

It takes some 50 ms, so only `question` runs on the live path, and a worker runs `answer`.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from p2sf.conventions import NM_PER_UM, slope_from_degrees
from p2sf.database.accuracy import accuracy
from p2sf.database.build import build_database, build_exact
from p2sf.database.exact import ExactDatabase
from p2sf.database.grid import GridDatabase
from p2sf.database.parts import KINDS
from p2sf.database.render import Sampling, render_source
from p2sf.database.space import Space
from p2sf.errors import Cancelled, P2SFError, SamplingError
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.wavefront import steepest_slope
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.spans import depth_nodes
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.setup import prescription, ranges

NODES = (20, 21, 31)  # depths, fields, wavelengths: the defaults of the command line
LOSSY = ("table1", "linear")
MAP = (41, 81)  # fields, depths
ATLAS = (4, 9)
ATLAS_PIXELS = 40
BLURRED = 400.0  # waves of phase slope: all cells together then take a second, and would be drawn as ray density anyway
SHOWN_WHOLE = 0.6  # of the atlas's PSFs; a pitch that fits the widest would shrink the rest to specks
ATLAS_DEFOCUS = 8.0  # waves at the first and the last column; Pieroni et al. 2015 trust the method to 10
SHORT_OF_PUPIL = 0.8  # of the way to an entrance pupil that stands among the depths


@dataclass(frozen=True)
class DatabaseRequest:
    """Everything the maps depend on; a moved source is not among it."""

    lens: Lens
    stop_surface: int
    stop_rim: float
    wavelength_um: float
    depths_mm: tuple[float, float]
    field_deg: float
    wavelengths_nm: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Atlas:
    """PSFs, (fields, depths, pixels, pixels), peak = 1, all at one pitch; depths in mm, fields in degrees."""

    psfs: np.ndarray
    depths_mm: np.ndarray
    fields_deg: np.ndarray
    pixel_um: float


@dataclass(frozen=True, eq=False)
class DatabaseResult:
    """Maps over (field, 1/depth) by coefficient, and errors by interpolant and coefficient, in waves.

    ``near``: the map's columns as 1/depth in 1/mm, ``fields_deg`` its rows; errors are NaN where a rule has none.
    ``largest`` are the databases' own figures; ``accuracy`` tells what is predicted of PSFs against exact rays. Where
    ``atlas`` is None, ``why_no_atlas`` is the reason.
    """

    question: DatabaseRequest
    near: np.ndarray
    fields_deg: np.ndarray
    nodes: Space
    maps: dict[str, np.ndarray]
    errors: dict[str, dict[str, np.ndarray]]
    largest: dict[str, dict[str, float]]
    atlas: Atlas | None
    why_no_atlas: Message | None = None
    accuracy: Message | None = None


def question(live: Live) -> View[None]:
    """Return what the maps of the present state depend on."""
    setup, limits = live.setup, ranges(prescription(live.state))
    pupil = -float(setup.pupils.entrance_from_first)
    far = SHORT_OF_PUPIL * pupil if limits.closest_mm / SHORT_OF_PUPIL < pupil < inf else inf
    nm = setup.source.wavelength_um * NM_PER_UM
    low, high = limits.wavelength_nm
    return View(
        None,
        DatabaseRequest(
            setup.lens,
            int(setup.stop.surface),
            float(setup.stop.semi_diameter),
            setup.source.wavelength_um,
            (limits.closest_mm, far),
            limits.field_deg,
            (min(low, nm), max(high, nm)),
        ),
    )


def answer(request: DatabaseRequest, stopped: Callable[[], bool] = lambda: False) -> DatabaseResult:
    """Return maps, errors and atlas; raises P2SFError where the lens has no database, Cancelled when stopped."""
    fields = np.linspace(0.0, request.field_deg, MAP[0])
    space = nodes(request)
    near = np.linspace(1 / request.depths_mm[1], 1 / request.depths_mm[0], MAP[1])
    near[-1] = 1 / space.depths_mm[0]
    exact = build_exact(request.lens, space, stop(request))
    maps = map_errors(exact, near, fields, request.wavelength_um)
    errors, largest = {}, {"exact": exact.errors}
    for rule in LOSSY:
        if stopped():
            raise Cancelled("the database maps were stopped")
        lossy = build_database(request.lens, space, rule, stop(request))
        found = map_errors(lossy, near, fields, request.wavelength_um)
        errors[rule] = {kind: np.abs(found[kind] - maps[kind]) for kind in KINDS}
        largest[rule] = lossy.errors
    known = DatabaseResult(
        request, near, fields, space, maps, errors, largest, None, accuracy=prediction_message(exact, request)
    )
    try:
        return replace(known, atlas=atlas(exact, request))
    except P2SFError as error:
        return replace(known, why_no_atlas=error.message)


def prediction_message(exact: ExactDatabase, request: DatabaseRequest) -> Message:
    """Return what is predicted of the database's PSFs, or why nothing is."""
    try:
        return accuracy(exact, request.lens).summary
    except P2SFError as error:
        return error.message


def nodes(request: DatabaseRequest) -> Space:
    """Return the nodes the databases are built on."""
    depths, fields, wavelengths = NODES
    low, high = request.wavelengths_nm
    return Space(
        depth_nodes(*request.depths_mm, depths),
        slope_from_degrees(np.linspace(0.0, request.field_deg, fields)),
        np.linspace(low, high, wavelengths) / NM_PER_UM if low < high else np.array([low]) / NM_PER_UM,
    )


def stop(request: DatabaseRequest) -> Stop:
    """Return the stop in use, one for all depths."""
    surface = np.asarray(request.stop_surface)
    return Stop(surface, np.asarray(request.stop_rim), surface, "file")


def map_errors(
    database: ExactDatabase | GridDatabase, near: np.ndarray, fields_deg: np.ndarray, wavelength_um: float
) -> dict[str, np.ndarray]:
    """Return each coefficient, (fields, depths), in waves; NaN between the last depth a rule reaches and infinity."""
    last = getattr(database, "last_depth_mm", inf)
    known = (near == 0) | (near >= (1 - 1e-12) / last)
    with np.errstate(divide="ignore"):
        depths = np.minimum(1 / near[known], database.space.depths_mm[-1])
    found = database.coefficients(depths, slope_from_degrees(fields_deg)[:, None], wavelength_um)
    maps = {kind: np.full((len(fields_deg), len(near)), np.nan) for kind in KINDS}
    for kind, values in maps.items():
        values[:, known] = getattr(found, kind)
    return maps


def atlas(exact: ExactDatabase, request: DatabaseRequest) -> Atlas:
    """Return PSFs over the lens's own field and the depths sharp within `ATLAS_DEFOCUS`; NaN where all is blur.

    Raises P2SFError where none of them can be sampled.
    """
    near = sharp_range(exact, request)
    with np.errstate(divide="ignore"):
        depths = np.clip(1 / near, *request.depths_mm)
    widest = request.lens.widest_field_deg
    fields = np.linspace(0.0, min(widest, request.field_deg) or request.field_deg, ATLAS[0])
    slopes = slope_from_degrees(fields)[:, None]
    found = exact.coefficients(depths, slopes, request.wavelength_um)
    drawn = steepest_slope(found) <= BLURRED
    if not drawn.any():
        raise SamplingError("no PSF of this lens is sharp enough for the atlas; stop down")
    pitch = float(np.quantile(suitable_pixel_um(found, ATLAS_PIXELS)[drawn], SHOWN_WHOLE))
    points = [np.broadcast_to(axis, drawn.shape)[drawn] for axis in (depths, slopes, request.wavelength_um)]
    psfs = np.full((*drawn.shape, ATLAS_PIXELS, ATLAS_PIXELS), np.nan, np.float32)
    psfs[drawn] = render_source(exact, points, Sampling(ATLAS_PIXELS, pitch, "preview"))
    return Atlas(psfs / psfs.max((-2, -1), keepdims=True), depths, fields, pitch)


def sharp_range(exact: ExactDatabase, request: DatabaseRequest) -> np.ndarray:
    """Return 1/depth, 1/mm, of the atlas's columns, around the depth in focus, where Wd runs nearly straight."""
    low, high = 1 / request.depths_mm[1], 1 / request.depths_mm[0]
    near = np.linspace(low, high, 2001)
    with np.errstate(divide="ignore"):
        depths = np.clip(1 / near, *request.depths_mm)
    defocus = exact.coefficients(depths, 0.0, request.wavelength_um).wd
    sharpest = int(np.argmin(np.abs(defocus)))
    slope = np.gradient(defocus, near)[sharpest]
    focus = near[sharpest] - defocus[sharpest] / slope if slope else near[sharpest]
    half = ATLAS_DEFOCUS / abs(slope) if slope else high
    first, last = np.clip([focus - half, focus + half], low, high)
    return np.linspace(first, last, ATLAS[1])


def nearest(atlas: Atlas, depth_mm: float, field_deg: float) -> tuple[int, int] | None:
    """Return the (field, depth) cell of a source, None when it lies more than half a cell outside."""
    places, cell = _places(atlas, depth_mm, field_deg), closest(atlas, depth_mm, field_deg)
    steps = [abs(nodes[1] - nodes[0]) for nodes, _ in places]
    inside = [abs(nodes[k] - v) <= 0.51 * s for (nodes, v), k, s in zip(places, cell, steps, strict=True)]
    return cell if all(inside) else None


def closest(atlas: Atlas, depth_mm: float, field_deg: float) -> tuple[int, int]:
    """Return the (field, depth) cell that a source is in or, outside, that is the least away from it."""
    row, column = (int(np.argmin(np.abs(n - value))) for n, value in _places(atlas, depth_mm, field_deg))
    return row, column


def _places(atlas: Atlas, depth_mm: float, field_deg: float) -> tuple[tuple[np.ndarray, float], ...]:
    """Return (nodes, value) of the fields in degrees and of 1/depth in 1/mm."""
    with np.errstate(divide="ignore"):
        return (atlas.fields_deg, field_deg), (1 / atlas.depths_mm, 1 / depth_mm)
