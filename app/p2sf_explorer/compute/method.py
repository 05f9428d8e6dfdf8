"""Which method makes the picture, and the picture itself. No Qt in here."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import floor, log10

import numpy as np

from p2sf.disc.mask import PupilMask, mask_slopes
from p2sf.errors import GeometryError
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients, reason_against_coefficients
from p2sf.paraxial.wavefront import steepest_slope
from p2sf.psf.choosing import Choice, choose
from p2sf.psf.cost import coefficient_node_count, fit_node_count, nodes_beyond
from p2sf.psf.methods import FITTED, SEIDEL, TRACED, PsfRequest, by_six, psf_of
from p2sf.psf.result import Psf
from p2sf.psf.seidel import check_focus, check_image
from p2sf.pupil.fit import FittedPencil
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.smooth_pupil import all_reach
from p2sf.pupil.wavefront_map import WavefrontMap
from p2sf.raytrace.pencil import Rays, pencil
from p2sf.raytrace.ray_field import AIRY_RADIUS
from p2sf_explorer.compute.deferred_sums import ComparisonRequest, Request, SumCache, most_samples, psf_request, slow
from p2sf_explorer.compute.preview import (
    EDGE,
    FAR,
    Preview,
    best_fit,
    clipped_psf,
    edge_points,
    first_fit,
    landing_um,
    preview,
    preview_of_coefficients,
    preview_psf,
    preview_pupil,
)
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.compute.warnings import remedy
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import State

Window = tuple[int, float]
"""Samples on a side, µm per sample."""
Least = tuple[int, float]
"""Samples on a side and width in µm that a window has at least, for the sake of another picture beside it."""

PIXELS = {"preview": 64, "settled": 128}
SIZES = (128, 256, 512, 1024)  # samples of a settled picture: the fewest that are λ/2NA apart, whose sum is the light
WINDOWS = (1, 1.5, 2, 3, 4, 5, 6, 8)
STEEP = 80.0  # waves of slope: beyond, a window of all rays would show the light as a dot
STEEPEST_IN_ALL = 210.0  # waves of slope and of the plane wave to the window's corner, for a frame of six coefficients
COARSEST = 4.0  # Airy radii between the samples of a window that is as wide as another picture asks for
ALL_LIGHT = 0.995
NO_REASON = Message("")
ALONE: Least = (0, 0.0)
QUICK_SECONDS = 0.02  # of a picture that moves, and on a busy machine a few times that
ROOM = 5  # Airy radii around the rays, for what diffraction adds


@dataclass(frozen=True)
class Rendered:
    """A PSF, why this method made it, whether by exact rays or six coefficients, and which ``method`` was chosen.

    ``why`` is empty for a person's own choice. ``pupil`` is the wavefront where the picture's own rays give it too.
    ``request`` is the sum of waves that made the picture, which may have up to ``finest`` samples a side, ``pending``
    the one that it stands in for. ``refused`` says why the method that a person chose has no picture here. ``slow``:
    whether its sum takes longer than a frame, at rest.
    """

    psf: Psf
    why: Message
    exact: bool
    method: str
    pupil: WavefrontMap | None = None
    pending: Request | None = None
    request: PsfRequest | None = None
    finest: int = 0
    refused: Message | None = None
    slow: bool = False


@dataclass(frozen=True)
class Task:
    """What is to be shown: a state and its setup by one method, and why by that, in a window of at least this size.

    ``known``: the rays of `preview` without rims, where they are traced already. ``choice``: of ``auto``, None of a
    person's own method and while a slider moves.
    """

    state: State
    setup: ParaxialSetup
    method: str
    why: Message
    least: Least
    cache: SumCache | None
    known: Preview | None = None
    choice: Choice | None = None

    @property
    def exact(self) -> bool:
        """Return whether exact rays make the picture."""
        return not by_six(self.method)

    @property
    def six(self) -> Coefficients | None:
        """Return the coefficients that make the picture; None where exact rays do."""
        return None if self.exact else self.setup.coefficients

    @cached_property
    def traced(self) -> Preview | None:
        """Return some eighty rays; None where one is lost."""
        return self.known or preview(self.setup)

    @cached_property
    def first_fit(self) -> FittedPencil | None:
        """Return a fit to the rays traced so far, which tells how many nodes a sum needs; None where one is lost."""
        return first_fit(self.traced) if self.traced else None

    @cached_property
    def fitted(self) -> FittedPencil | None:
        """Return a coarse fit to exact rays; None where one is lost."""
        return best_fit(self.traced, self.first_fit) if self.traced else None

    @cached_property
    def extent(self) -> "Extent":
        """Return how far the light reaches on the sensor."""
        if not self.exact:
            return extent_of_six(self.setup)
        return extent_of(self.setup, self.traced.rays if self.traced else edge_pencil(self.setup))

    @cached_property
    def own_width_um(self) -> float:
        """Return the width of the window without another picture beside it."""
        return width_um(self.setup, self.exact, self.extent, self.state.optics.clip)

    def window(self, quality: str) -> Window:
        """Return the samples and their pitch; a picture that moves has few."""
        width = max(self.own_width_um, self.least[1])
        if quality == "preview":
            return PIXELS["preview"], width / PIXELS["preview"]
        needed = 2 * self.own_width_um * AIRY_RADIUS / self.extent.airy_um
        fine = next((size for size in SIZES if needed <= size), SIZES[-1])
        pixels = max(self.least[0], min(fine, self.finest(width)))
        return pixels, width / pixels

    def finest(self, width: float) -> int:
        """Return the most samples a side that a picture so wide is made with in some seconds."""
        window = SIZES[-1], width / SIZES[-1]
        request = self.request(window)
        return most_samples(request, self.first_fit if self.exact else None)

    def request(self, window: Window) -> PsfRequest:
        """Return what is asked of the method for the settled picture in a window."""
        return psf_request(self.state, self.setup, self.method, window, choice=self.choice)

    @property
    def coarse(self) -> bool:
        """Return whether the window is so wide for another picture's sake that its samples miss this one."""
        pixels = max(self.least[0], PIXELS["settled"])
        return self.least[1] > max(self.own_width_um, COARSEST * self.extent.airy_um * pixels)


@dataclass(frozen=True)
class Extent:
    """How far from the chief ray light lands, µm, and the Airy radius of the beam that brings it, µm."""

    landing_um: float
    airy_um: float

    @property
    def slope(self) -> float:
        """Return the slope of the wavefront at the farthest ray, waves per pupil radius."""
        return AIRY_RADIUS * self.landing_um / self.airy_um


def render_state(
    state: State,
    setup: ParaxialSetup,
    quality: str,
    kept_method: str = "",
    least: Least = ALONE,
    cache: SumCache | None = None,
) -> Rendered:
    """Return the PSF by the state's method, or by the one ``auto`` chooses, or by ``kept_method`` while moving.

    The window is as wide as the PSF asks for, and as ``least``. What is altered by hand has no rays: the six
    coefficients make its picture. A sum too slow for a frame is taken from ``cache`` or left pending; without
    ``cache`` it is waited for. Raises GeometryError for an image at infinity.
    """
    check_focus(setup.cone.na)
    if setup.altered:
        method, choice = SEIDEL.name, None
        why = Message("seidel from the six coefficients (what-if: coefficients altered by hand)")
    else:
        choice = None if kept_method else choice_for_state(state, setup, cache)
        method, why = kept_method or state.optics.method, NO_REASON
        if choice is not None:
            method, why = choice.method, Message("{method}: {reason}", method=choice.method, reason=choice.reason)
    refused = reason_against_coefficients(setup.lens) if by_six(method) and not state.what_if.free_pupil else None
    if refused:
        method, choice = TRACED.name, None  # for the pupil; the picture itself is covered
    elif by_six(method):
        check_image(setup.coefficients)
    task = Task(state, setup, method, why, least, cache, choice=choice)
    if quality == "preview":
        picture = moving(task, quality)
    else:
        picture = undecided(task) if choice is not None and choice.open else resting(task)
    return replace(picture, refused=refused) if refused else picture


def undecided(task: Task) -> Rendered:
    """Return the stand-in for a settled picture whose method a comparison too slow for a frame decides."""
    soon = Message("auto compares two sums of waves to choose a method, which takes a moment")
    pending = ComparisonRequest(task.setup.lens, task.setup.source, task.state.optics.clip)
    return replace(moving(task, "settled"), why=soon, pending=pending, slow=True)


def resting(task: Task) -> Rendered:
    """Return the settled picture; its stand-in while it is pending, or where it failed, is too large or too coarse."""
    window, own = task.window("settled"), not task.state.optics.automatic or task.setup.altered
    request = task.request(window)
    fitted = task.first_fit if task.exact else None
    samples = nodes_beyond(request, fitted)
    if samples and own and task.least[1] <= task.own_width_um:
        refused = too_many(task, samples)
        return replace(ray_density_picture(task, window), why=refused, refused=refused)
    if samples or task.coarse:
        return ray_density_picture(task, window)
    late = slow(request, fitted)
    result = task.cache.get(request) if late and task.cache else psf_of(request)
    if isinstance(result, Psf):
        return replace(settled_picture(task, result, request), slow=late)
    stand_in = replace(moving(task, "settled"), slow=True)
    if isinstance(result, Message):
        return replace(stand_in, why=result)
    soon = Message("{method} follows: its sum of waves takes a moment", method=task.method)
    return replace(stand_in, why=soon, pending=request)


def settled_picture(task: Task, psf: Psf, request: PsfRequest) -> Rendered:
    """Return the settled picture that a sum made."""
    finest = task.finest(request.window[0] * request.window[1])
    return Rendered(psf, task.why, task.exact, task.method, request=request, finest=finest)


def too_many(task: Task, samples: float) -> Message:
    """Return why the method that a person chose has no picture here, and what to do."""
    return Message(
        "{method} would need {count:.2g} pupil samples for this blur, which takes too long; {remedy}, or choose auto "
        "to see ray density",
        method=task.method,
        count=samples,
        remedy=remedy(task.setup),
    )


def moving(task: Task, quality: str) -> Rendered:
    """Return what is shown in place of a slower method: fitted, or the density of rays where a sum would take long.

    Where rays are lost and there is no cache, traced is waited for. ``quality`` sets the number of samples.
    """
    window = task.window(quality)
    if not task.exact:
        return moving_coefficients(task, window, quality)
    traced = preview(task.setup, True) if task.state.optics.clip else task.traced
    pupil = preview_pupil(traced) if traced and quality == "preview" else None
    if task.coarse or (traced and not quickly(task, window)):
        return replace(ray_density_picture(task, window, quality), pupil=pupil)
    if traced:
        psf = preview_psf(traced, *window, task.fitted)
        return Rendered(psf, instead(task, psf), True, task.method, pupil)
    if task.cache is None:
        waited = psf_request(task.state, task.setup, TRACED.name, window, "preview")
        return Rendered(psf_of(waited), NO_REASON, True, task.method)
    found = clipped_picture(task, window, quality)
    return replace(found, why=instead(task, found.psf))


def instead(task: Task, psf: Psf) -> Message:
    """Return that a quicker method than the one in use made a picture that moves; empty where it is that one."""
    if psf.method == task.method:
        return NO_REASON
    return Message("{quicker} while the slider moves, {method} when it rests", quicker=psf.method, method=task.method)


def moving_coefficients(task: Task, window: Window, quality: str) -> Rendered:
    """Return the picture of six coefficients while it moves; the density of their rays where it has many waves."""
    mask = mask_seen(task.setup.lens, task.setup.source)
    if task.coarse or quality == "settled" or steep_coefficients(task, window, mask):
        return ray_density_picture(task, window, quality)
    return Rendered(preview_of_coefficients(task.setup, window, quality), task.why, False, task.method)


def steep_coefficients(task: Task, window: Window, mask: PupilMask) -> bool:
    """Return whether a moving picture of six coefficients takes longer than a frame."""
    c = task.setup.coefficients
    if float(steepest_slope(c)) + corner_waves(task, window) > STEEPEST_IN_ALL:
        return True
    return not mask.clear and SEIDEL.seconds(coefficient_node_count(c, window, mask), window[0]) > QUICK_SECONDS


def too_coarse(task: Task, window: Window) -> bool:
    """Return whether a small picture among many shows no waves: its samples miss them, or their sum takes long."""
    if window[1] > COARSEST * task.extent.airy_um:
        return True
    if not task.exact:
        return steep_coefficients(task, window, mask_seen(task.setup.lens, task.setup.source))
    return task.traced is not None and not quickly(task, window)


def corner_waves(task: Task, window: Window) -> float:
    """Return the waves per pupil radius of the plane wave to a window's corner."""
    return AIRY_RADIUS * window[0] * window[1] / 2**0.5 / task.extent.airy_um


def quickly(task: Task, window: Window) -> bool:
    """Return whether the sum of a fit, or of exact rays where it misses much, is done within a frame or two.

    False where a ray is lost. Only where the first rays are not too steep for that are more of them traced.
    """
    if task.first_fit is None:
        return False
    if FITTED.seconds(fit_node_count(task.first_fit, window), window[0]) >= QUICK_SECONDS or task.fitted is None:
        return False
    if task.fitted.error_waves > FAR:
        few = TRACED.seconds(fit_node_count(task.fitted, window), window[0]) < QUICK_SECONDS
        return few and all_reach(task.setup.lens, task.setup.source)
    return True


def clipped_picture(task: Task, window: Window, quality: str) -> Rendered:
    """Return the moving picture where rims clip: the fit to all rays, summed over those that pass, else ray density."""
    try:
        psf = clipped_psf(task.traced, *window) if task.traced and quickly(task, window) else None
    except GeometryError:  # every ray is clipped, or the fit is no map: the density says which
        psf = None
    return Rendered(psf, NO_REASON, True, task.method) if psf else ray_density_picture(task, window, quality)


def ray_density_picture(task: Task, window: Window, quality: str = "settled") -> Rendered:
    """Return the density of rays over a window."""
    from p2sf.psf.geometric import geometric_psf

    psf = geometric_psf(task.setup.lens, task.setup.source, window, quality, task.state.optics.clip, task.six)
    return Rendered(psf, density_reason(psf), task.exact, task.method)


def density_reason(psf: Psf) -> Message:
    """Return what a picture of ray density is, and how much of the light it holds."""
    percent = 100 * float(psf.energy or 0.0)
    if percent > 100 * ALL_LIGHT:
        return Message("geometric: ray density, no diffraction")
    return Message(
        "geometric: ray density, no diffraction; {percent:.0f} % of the light in the window", percent=percent
    )


def extent_of_six(setup: ParaxialSetup) -> Extent:
    """Return how far light reaches by the slope of the six coefficients."""
    cycles = float(setup.coefficients.na) / setup.source.wavelength_um
    slope = float(steepest_slope(setup.coefficients)) + mask_slope(setup)
    return Extent(slope / cycles, AIRY_RADIUS / cycles)


def extent_of(setup: ParaxialSetup, rays: Rays) -> Extent:
    """Return how far light reaches by a pencil whose last rays are those at the rim; none if all are lost."""
    cycles = np.hypot(rays.fx, rays.fy)[-2 * EDGE :]
    near = setup.cone.na / setup.source.wavelength_um
    widest = float(np.nanmax(cycles)) if np.isfinite(cycles).any() else near
    return Extent(landing_um(rays) + mask_slope(setup) / widest, AIRY_RADIUS / widest)


def mask_slope(setup: ParaxialSetup) -> float:
    """Return the steepest slope of the phase of what stands in the stop, waves per pupil radius."""
    if not setup.lens.mask.phased:
        return 0.0
    slopes = mask_slopes(setup.lens.mask)
    return float(np.hypot(slopes.path_radial_um, slopes.path_angular_um)) / setup.source.wavelength_um


def width_um(setup: ParaxialSetup, exact: bool, found: Extent, clip: bool) -> float:
    """Return the width of the shown window, µm: a round number, so that axes stand still while sliders move.

    It holds every ray, or most of the light where some rays land far out, and what diffraction adds.
    """
    from p2sf.psf.geometric import main_reach_um

    whole = round_width_um(found.landing_um, found.airy_um)
    if found.slope <= STEEP:
        return whole
    six = None if exact else setup.coefficients
    return min(whole, round_width_um(main_reach_um(setup.lens, setup.source, clip, six), found.airy_um))


def round_width_um(reach_um: float, airy_um: float) -> float:
    """Return the width of a window that shows light landing so far out, and what diffraction adds, µm."""
    return nice(2 * (reach_um + ROOM * airy_um), WINDOWS)


def window_um(setup: ParaxialSetup, clip: bool = False) -> float:
    """Return the width of the window that exact rays ask for, µm."""
    return width_um(setup, True, extent_of(setup, edge_pencil(setup)), clip)


def edge_pencil(setup: ParaxialSetup) -> Rays:
    """Return the few rays at the rim that show how far light reaches."""
    return pencil(setup.lens, setup.source, *edge_points())


def choice_for_state(state: State, setup: ParaxialSetup, cache: SumCache | None = None) -> Choice | None:
    """Return what ``auto`` chooses, with a ``cache`` within a frame; None where a person chose the method."""
    if not state.optics.automatic:
        return None
    lens, source, clip = setup.lens, setup.source, state.optics.clip
    # What the worker has compared is kept beside the comparison itself, too.
    quick = cache is not None and cache.get(ComparisonRequest(lens, source, clip)) is None
    return choose(lens, source, state.optics.tolerance, clip, quick=quick)


def at_least(r_squared: float) -> str:
    """Return R² rounded down, with two digits of what it lacks to one, and four places at most."""
    places = min(4, 1 - floor(log10(max(1 - r_squared, 1e-9))))
    return f"{floor(r_squared * 10**places) / 10**places:.{places}f}".rstrip("0")
