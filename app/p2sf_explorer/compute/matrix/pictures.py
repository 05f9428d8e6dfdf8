"""The pictures of a matrix: as previews within a frame, and settled, one by one, by the method that was chosen."""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from time import perf_counter

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import GeometryError, P2SFError
from p2sf.figures.fans import Fan, opd_fan, ray_fan
from p2sf.figures.perfect import airy_radius_um
from p2sf.figures.spot import Spot
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message, Number
from p2sf.paraxial.seidel import check_seidel
from p2sf.psf.cost import nodes_beyond
from p2sf.psf.geometric import geometric_psf
from p2sf.psf.measures import energy_in
from p2sf.psf.methods import SEIDEL, psf_of
from p2sf.psf.result import Psf
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import Rays, pencil
from p2sf.raytrace.ray_field import AIRY_RADIUS
from p2sf_explorer.compute.deferred_sums import psf_request
from p2sf_explorer.compute.framing import LightRings, light_rings
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.matrix.points import MatrixRequest, matrix_request, nearest
from p2sf_explorer.compute.matrix.tiles import Light, Lines, MatrixTile, SpotTile, Tiles, WavefrontTile, refused_tile
from p2sf_explorer.compute.measured import MeasureRequest, measured_parts
from p2sf_explorer.compute.method import (
    ALONE,
    NO_REASON,
    Task,
    Window,
    choice_for_state,
    clipped_picture,
    too_coarse,
)
from p2sf_explorer.compute.preview import (
    Preview,
    first_level,
    points,
    preview_of_coefficients,
    preview_psf,
    preview_pupil,
)
from p2sf_explorer.compute.pupil import pupil_of
from p2sf_explorer.compute.setup import ParaxialSetup, everywhere_by_coefficients, paraxial_setup
from p2sf_explorer.compute.views.mtf import contrast_of
from p2sf_explorer.compute.views.rays import FAN_RAYS, landing_points, spot_of
from p2sf_explorer.state.scales import significant
from p2sf_explorer.state.state import State

SAMPLES = (128, 256)  # a side, while it moves and at most when it rests
SHARP = 0.1  # Strehl ratio below which the radius of the light says more
SHARP_ENOUGH = 8  # samples per λ/NA from which on the highest one is the peak to some 8 %
ALMOST = 0.7  # of it, which is below cos²(2π/8√2): so low samples have no sharp peak between them (`psf.peak`)
MOST_LIGHT = 0.97  # share of all light from which on a window's counts as all
HELD = 0.8  # share of the light within the radius that is quoted
BY_RAYS, BY_COEFFICIENTS = "exact rays", "six coefficients"
IN_A_FRAME = ("psf", "pupil", "spot", "ray_fan", "opd_fan")  # what has a preview
IN_FRAME = 4  # PSFs that are all renewed in each frame; of more,
TURNS = 1  # beside that of the present point
AT_ONCE = ("spot", "ray_fan", "opd_fan")  # and what settles within the frame too


@dataclass(frozen=True, eq=False)
class Matrix:
    """What a matrix shows: the ``request``, and the pictures that fit a frame, None where they do not.

    ``settled``: nothing better follows. ``turn``: the next picture to be renewed, where ``waiting`` ones are of an
    earlier setting; ``widths_um`` of the window of each.
    """

    request: MatrixRequest
    tiles: Tiles | None
    settled: bool
    turn: int = 0
    waiting: frozenset[int] = frozenset()
    widths_um: tuple[float, ...] = ()


Traced = Rays | Spot | Fan
SourceLike = Source | Sources


@dataclass(frozen=True)
class MatrixPoint:
    """One point of a matrix: its state and setup, and its rays where they were traced together with others."""

    state: State
    setup: ParaxialSetup
    traced: Traced | None = None

    @property
    def six(self) -> bool:
        """Return whether the six coefficients make every picture here."""
        return everywhere_by_coefficients(self.state, self.setup)

    @property
    def method(self) -> str:
        """Return what describes the wavefront."""
        return BY_COEFFICIENTS if self.six else BY_RAYS

    @property
    def preview(self) -> Preview | None:
        """Return the rays of a preview of PSF and pupil; None where they are not known, or one is lost."""
        rays = self.traced
        return Preview(rays, self.setup, perf_counter()) if isinstance(rays, Rays) and rays.passed.all() else None


def matrix(live: Live) -> View[Matrix]:
    """Return the matrix of the present setup, with the pictures that fit a frame."""
    request = matrix_request(live)
    at_once = request.what in AT_ONCE and not (request.what == "spot" and live.state.optics.clip)
    quality = live.quality if at_once else "preview"
    before: Matrix | None = live.before["matrix"].found if "matrix" in live.before else None
    if live.quality == "preview" and before and in_turns(request, before):
        row, column, _ = nearest(request, live.state, live.side)
        made = renewed(request, before, row * len(request.columns) + column)
        return View(made, request if made.waiting else None, held=True)
    tiles = previews(request, quality) if request.what in IN_A_FRAME else None
    enough = quality == "settled" or (tiles and live.quality == "preview")
    return View(Matrix(request, tiles, quality == "settled"), None if enough else request)


@lru_cache(maxsize=4)
def previews(request: MatrixRequest, quality: str = "preview") -> Tiles:
    """Return the pictures that fit a frame, their rays traced together; only those of rays can be "settled"."""
    if request.what == "psf":
        places, tasks = _psf_tasks(request)
        each = zip(places, tasks, _widths(tasks, request.shared), strict=True)
        return _rows(request, [_try_tile(_moving_psf, place, task, width) for place, task, width in each])
    places = _trace_points(_places(request), request.what, quality)
    return _rows(request, [_try_tile(MAKERS[request.what], place, quality) for place in places])


def in_turns(request: MatrixRequest, before: Matrix) -> bool:
    """Return whether the PSFs are too many for a frame, and there are those of the frame before to go on from."""
    alike = before.tiles is not None and before.request.what == request.what
    same = (len(before.request.rows), len(before.request.columns)) == (len(request.rows), len(request.columns))
    many = len(request.rows) * len(request.columns) > IN_FRAME
    return request.what == "psf" and many and alike and same and request != before.request


def renewed(request: MatrixRequest, before: Matrix, here: int) -> Matrix:
    """Return the PSFs of a frame: that of the present point and the next in turn are new, the others of before.

    A person who drags sees the picture in hand follow at once, and all others within some frames.
    """
    wide, old = len(request.columns), [tile for row in before.tiles or () for tile in row]
    numbers = list(dict.fromkeys((here, *((before.turn + k) % len(old) for k in range(TURNS)))))
    states = [request.states[number // wide][number % wide] for number in numbers]
    places = _trace_points([_place(state) for state in states], "psf", "preview")
    tasks = [_task(place, _quick_method(place)) if isinstance(place, MatrixPoint) else None for place in places]
    widths = list(before.widths_um) if len(before.widths_um) == len(old) else [0.0] * len(old)
    for number, width in zip(numbers, _widths(tasks, False), strict=True):
        widths[number] = width
    for number, place, task in zip(numbers, places, tasks, strict=True):
        old[number] = _try_tile(_moving_psf, place, task, max(widths) if request.shared else widths[number])
    waiting = frozenset(range(len(old))) - set(numbers)
    turn = (before.turn + TURNS) % len(old)
    return Matrix(request, _rows(request, old), False, turn, waiting, tuple(widths))


def settle(request: MatrixRequest, stopped: Callable[[], bool], tell: Callable[[float, Tiles], None]) -> Tiles:
    """Return the settled pictures, for a worker; ``tell(share, so far)`` is called after each."""
    places = _places(request)
    empty = (MatrixTile(None, settled=False),) * len(request.columns)
    first = previews(request) if request.what in IN_A_FRAME else (empty,) * len(request.rows)
    found = [tile for row in first for tile in row]
    widths = _widths(_psf_tasks(request)[1], request.shared) if request.what == "psf" else []
    for number, place in enumerate(places):
        if stopped():
            break
        if request.what == "psf":
            found[number] = _try_tile(_resting_psf, place, widths[number], stopped)
        elif request.what == "mtf":
            found[number] = _try_tile(_contrast, place, request.pixel_um)
        else:
            found[number] = _try_tile(MAKERS[request.what], place, "settled")
        tell((number + 1) / len(places), _rows(request, found))
    return _rows(request, found)


def _rows(request: MatrixRequest, found: list[MatrixTile]) -> Tiles:
    wide = len(request.columns)
    return tuple(tuple(found[start : start + wide]) for start in range(0, len(found), wide))


Found = MatrixPoint | Message


def _places(request: MatrixRequest) -> list[Found]:
    """Return the setup of every point, row by row, or why it has none."""
    return [_place(state) for row in request.states for state in row]


def _place(state: State) -> Found:
    try:
        return MatrixPoint(state, paraxial_setup(state))
    except P2SFError as error:
        return error.message


def _try_tile(make: Callable[..., MatrixTile], place: Found, *arguments: object) -> MatrixTile:
    """Return a picture, or why there is none."""
    if isinstance(place, Message):
        return refused_tile(place)
    try:
        return make(place, *arguments)
    except P2SFError as error:
        return refused_tile(error.message)


def _trace_points(places: list[Found], what: str, quality: str) -> list[Found]:
    """Return the points with their rays, those of one lens traced together: that takes a quarter of the time."""
    found = list(places)
    groups: dict[tuple[Lens, bool], list[int]] = {}
    for number, place in enumerate(places):
        if isinstance(place, MatrixPoint) and not (place.six and what in ("psf", "pupil")):
            groups.setdefault((place.setup.lens, place.state.optics.clip), []).append(number)
    for (lens, clip), numbers in groups.items():
        own = [place for place in (places[number] for number in numbers) if isinstance(place, MatrixPoint)]
        for number, place, rays in zip(numbers, own, _together(own, lens, clip, what, quality), strict=True):
            found[number] = replace(place, traced=rays)
    return found


def _together(places: list[MatrixPoint], lens: Lens, clip: bool, what: str, quality: str) -> list[Traced | None]:
    """Return the rays of points of one lens; of each by itself where one chief ray is lost, None for that."""
    columns = (np.array([getattr(place.setup.source, name) for place in places]) for name in SOURCE)
    if any(place.setup.source.azimuth_deg for place in places):  # each sees another lens, or another mask
        return [_alone(place, what, quality) for place in places]
    try:
        rays = TRACES[what](lens, Sources(*columns), clip, quality)
    except GeometryError:
        return [_alone(place, what, quality) for place in places]
    return [_part(rays, number, len(places)) for number in range(len(places))]


def _alone(place: MatrixPoint, what: str, quality: str) -> Traced | None:
    try:
        return TRACES[what](place.setup.lens, place.setup.source, place.state.optics.clip, quality)
    except GeometryError:  # whoever makes the picture says why
        return None


SOURCE = ("depth_mm", "field_slope", "wavelength_um")


def _part(rays: Traced, number: int, count: int) -> Traced:
    """Return one source's rays of those of ``count`` sources, whose axis comes first."""
    values = {field.name: getattr(rays, field.name) for field in fields(rays)}
    own = {
        name: value[number] if isinstance(value, np.ndarray) and value.shape[:1] == (count,) else value
        for name, value in values.items()
    }
    return type(rays)(**own)


def _few_rays(lens: Lens, source: SourceLike, clip: bool, quality: str) -> Rays:
    return pencil(lens, source, *points(first_level(lens)), clip=clip)


def _many_rays(lens: Lens, source: SourceLike, clip: bool, quality: str) -> Spot:
    return spot_of(lens, source, clip, quality)


def _landing(lens: Lens, source: SourceLike, clip: bool, quality: str) -> Fan:
    return ray_fan(lens, source, FAN_RAYS, clip)


def _paths(lens: Lens, source: SourceLike, clip: bool, quality: str) -> Fan:
    return opd_fan(lens, source, FAN_RAYS, clip)


TRACES: dict[str, Callable[[Lens, SourceLike, bool, str], Traced]] = {
    "psf": _few_rays,
    "pupil": _few_rays,
    "spot": _many_rays,
    "ray_fan": _landing,
    "opd_fan": _paths,
}


def _task(place: MatrixPoint, method: str) -> Task:
    return Task(place.state, place.setup, method, NO_REASON, ALONE, None, place.preview)


def _psf_tasks(request: MatrixRequest) -> tuple[list[Found], list[Task | None]]:
    """Return the points and how each PSF is previewed, None where the point has no setup."""
    places = _trace_points(_places(request), "psf", "preview")
    return places, [_task(place, _quick_method(place)) if isinstance(place, MatrixPoint) else None for place in places]


def _widths(tasks: list[Task | None], shared: bool) -> list[float]:
    """Return the width of every PSF's window, µm, the largest for all where the scale is ``shared``; 0 for none."""
    found = []
    for task in tasks:
        try:
            if task and not task.exact:
                check_seidel(task.setup.lens)
            found.append(task.own_width_um if task else 0.0)
        except P2SFError:
            found.append(0.0)
    return [max(found)] * len(found) if shared else found


def _quick_method(place: MatrixPoint) -> str:
    return "seidel" if place.six else "fitted"


def _moving_psf(place: MatrixPoint, task: Task, width_um: float) -> MatrixTile:
    """Return the PSF of the six coefficients, or of a fit to exact rays, or ray density, within some milliseconds."""
    window = SAMPLES[0], width_um / SAMPLES[0]
    if too_coarse(task, window):
        return _light(place, _density(task, window, "preview"), settled=False)
    if not task.exact:
        return _light(place, preview_of_coefficients(place.setup, window), settled=False)
    rays = task.known
    psf = preview_psf(rays, *window, task.fitted) if rays else clipped_picture(task, window, "preview").psf
    return _light(place, psf, settled=False)


def _resting_psf(place: MatrixPoint, width_um: float, stopped: Callable[[], bool]) -> MatrixTile:
    """Return the PSF by the method that was chosen; the density of rays where that would need too many samples."""
    choice = None if place.setup.altered else choice_for_state(place.state, place.setup)
    own = SEIDEL.name if place.setup.altered else place.state.optics.method
    method = own if choice is None else choice.method
    task = _task(place, method)
    count = SAMPLES[2 * task.own_width_um * AIRY_RADIUS / task.extent.airy_um > SAMPLES[0]]
    window = count, width_um / count
    request = psf_request(place.state, place.setup, method, window, choice=choice)
    if too_coarse(task, window) or nodes_beyond(request, task.first_fit if task.exact else None):
        return _light(place, _density(task, window, "settled"), settled=True)
    return _light(place, psf_of(request, stopped), settled=True)


def _density(task: Task, window: Window, quality: str) -> Psf:
    return geometric_psf(task.setup.lens, task.setup.source, window, quality, task.state.optics.clip, task.six)


def _light(place: MatrixPoint, psf: Psf, settled: bool) -> MatrixTile:
    """Return a PSF as a picture of light per µm², with the radius of 80 %, and its Strehl ratio where that tells."""
    na = place.setup.cone.na
    width = psf.values.shape[-1] * psf.pixel_um
    airy = float(airy_radius_um(place.setup.source.wavelength_um, na))
    share = 1.0 if psf.energy is None else float(psf.energy)
    rings = light_rings(psf.values, psf.pixel_um)
    content = Light(psf.values * (share / psf.pixel_um**2), width, airy, rings.circle(airy))
    sharpness = strehl_figure(psf, na)
    return MatrixTile(
        content,
        (pupil_radius(place) if settled and psf.method != "geometric" else None) or radius_figure(psf, rings),
        psf.method,
        psf.predicted_error,
        settled,
        strehl=sharpness,
    )


def strehl_figure(psf: Psf, na: float) -> Message | None:
    """Return the Strehl ratio of a sharp picture whose samples resolve the peak, None for another picture."""
    resolved = psf.pixel_um * SHARP_ENOUGH * na <= psf.wavelength_um
    highest = np.inf if psf.sum_over_peak is None else float(psf.values.max() * psf.sum_over_peak)
    if not resolved or highest < SHARP * ALMOST:  # none that has to be looked for
        return None
    if psf.strehl is None or psf.strehl < SHARP:
        return None
    return Message("Strehl {value}", value=Number(significant(float(psf.strehl), 2)))


def pupil_radius(place: MatrixPoint) -> Message | None:
    """Return R80 of all light of the pupil, as *Profiles* has it; None where its energy is not known."""
    try:
        found = energy_in(measured_parts(_measured(place)), "").radius_80_um
    except P2SFError:
        return None
    return Message("R80 {radius} µm", radius=Number(significant(found, 3))) if np.isfinite(found) else None


def radius_figure(psf: Psf, rings: LightRings) -> Message:
    """Return R80 of the light in the window, by rings of its samples, and the share of all light that is."""
    radius = Number(significant(rings.radius_of(HELD), 3))
    if psf.energy is not None and psf.energy < MOST_LIGHT:
        return Message("R80 {radius} µm (of {percent:.0f} % in view)", radius=radius, percent=100 * float(psf.energy))
    return Message("R80 {radius} µm (in view)", radius=radius)


def _measured(place: MatrixPoint) -> MeasureRequest:
    """Return what is to be measured at a point: the six coefficients where they make its picture, else exact rays."""
    setup, clip = place.setup, place.state.optics.clip and not place.six
    six = tuple(float(value) for value in vars(setup.coefficients).values()) if place.six else ()
    return MeasureRequest(setup.lens, setup.source, clip, six, by_hand=setup.altered)


def _waves(place: MatrixPoint, quality: str) -> MatrixTile:
    """Return the wavefront that makes the PSF, with its RMS."""
    rays = place.preview if quality == "preview" else None
    found = preview_pupil(rays) if rays else pupil_of(place.setup, not place.six, quality, place.state.optics.clip)
    figure = Message("RMS {rms} λ", rms=Number(significant(found.rms, 3)))
    return MatrixTile(WavefrontTile(found.waves, found.outline), figure, place.method, None, quality == "settled")


def _spot(place: MatrixPoint, quality: str) -> MatrixTile:
    """Return where exact rays land, with the RMS radius."""
    setup, rays = place.setup, place.traced
    if isinstance(rays, Spot) and (quality == "preview" or np.isfinite(rays.x_um).all()):
        found = rays
    else:
        found = _many_rays(setup.lens, setup.source, place.state.optics.clip, quality)
    airy = float(airy_radius_um(setup.source.wavelength_um, setup.cone.na))
    figure = Message("RMS {value} µm", value=Number(significant(float(found.rms_um), 3)))
    return MatrixTile(
        SpotTile(landing_points(found), airy),
        figure,
        BY_RAYS,
        None,
        quality == "settled" or not place.state.optics.clip,
    )


def _ray_errors(place: MatrixPoint, quality: str) -> MatrixTile:
    """Return the transverse ray errors, with the largest."""
    return _fan(place, _landing, "max {value} µm")


def _path_errors(place: MatrixPoint, quality: str) -> MatrixTile:
    """Return the optical path differences, with the largest."""
    return _fan(place, _paths, "max {value} λ")


def _fan(place: MatrixPoint, trace: Callable[[Lens, SourceLike, bool, str], Fan], words: str) -> MatrixTile:
    setup, rays = place.setup, place.traced
    found = rays if isinstance(rays, Fan) else trace(setup.lens, setup.source, place.state.optics.clip, "")
    lines = {"sagittal": np.asarray(found.sagittal), "tangential": np.asarray(found.tangential)}
    both = np.abs(np.concatenate(list(lines.values())))
    if not np.isfinite(both).any():
        raise GeometryError("no ray of the fan reaches the sensor; choose a smaller field")
    figure = Message(words, value=Number(significant(float(np.nanmax(both)), 3)))
    return MatrixTile(Lines(found.pupil, lines), figure, BY_RAYS)


def _contrast(place: MatrixPoint, pixel_um: float) -> MatrixTile:
    """Return the contrast of both patterns up to the cut-off; figure: the smaller at the sensor's Nyquist frequency."""
    found = contrast_of(_measured(place))
    lines = {"perfect lens": found.perfect, "sagittal": found.sagittal, "tangential": found.tangential}
    nyquist = UM_PER_MM / (2 * pixel_um)
    both = (np.interp(nyquist, found.frequency_per_mm, line, right=0.0) for line in (found.sagittal, found.tangential))
    figure = Message("{contrast} (at {f:.3g}/mm)", contrast=Number(significant(float(min(both)), 2)), f=nyquist)
    return MatrixTile(Lines(found.frequency_per_mm, lines), figure, place.method)


MAKERS: dict[str, Callable[[MatrixPoint, str], MatrixTile]] = {
    "pupil": _waves,
    "spot": _spot,
    "ray_fan": _ray_errors,
    "opd_fan": _path_errors,
}
