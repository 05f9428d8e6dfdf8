"""A photo through the present lens: a coarse picture, a planned one, and one sharpened by its own PSFs.

Only `question` runs on the live path; a worker runs `moving` or `coarse` (some 0.1 s) and `planned_picture` (some
seconds).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import pairwise
from math import ceil, exp, hypot, prod
from pathlib import Path
from threading import Event
from time import perf_counter

import numpy as np

from p2sf.conventions import NM_PER_UM, UM_PER_MM, degrees_from_slope, slope_from_degrees, vergence
from p2sf.errors import GeometryError, P2SFError, RequestError
from p2sf.image.charts import CHARTS
from p2sf.image.deblur import photo_statistics, psnr, wiener, with_one_kernel
from p2sf.image.form import Forming, form_image, plan_lattice
from p2sf.image.lattice import Lattice
from p2sf.image.picture import sharpen_planned
from p2sf.image.preview import preview_lattice, preview_plan
from p2sf.image.progress import Progress
from p2sf.image.similarity import ssim
from p2sf.io.depth_files import DepthScale
from p2sf.io.photo_files import keeps_light, kept_depth, write_photo
from p2sf.io.transfer import srgb_from_linear
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.pupils import field_from_image_height
from p2sf.pixel_kernels.channel import RAYS, Recipe
from p2sf.pixel_kernels.sensor_points import chief_heights
from p2sf.scene.field_area import field_area
from p2sf.scene.planning.cost import computed_counts
from p2sf.scene.planning.plan import Plan, plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.views.depths import (
    FLAT,
    ONE_DISTANCE,
    OWN,
    WITH_DEPTHS,
    DepthChoice,
    depth_map,
    occupied_depths,
)
from p2sf_explorer.compute.views.photos import (
    MOST_PIXELS,
    NOISE,
    channels_of,
    cut_away,
    full_shape,
    own_shape,
    scene_values,
    source_photo,
)
from p2sf_explorer.state.state import State

SEEN = 0.005  # of a photo's side: less is a pixel or two


HEADINGS = {  # of a plan's decisions by kind, in the order in which they are shown
    "field": "Places",
    "colour": "Colour {channel}",
    "method": "Method",
    "sampling": "Sampling",
    "depth": "Depths",
    "pupils": "Pupils",
    "noise": "Noise",
}

Notes = tuple[tuple[Message, Message], ...]
"""Headings and what is to be said of each."""


def psf_counts(plan: Plan) -> tuple[Message, Message]:
    """Return how many PSFs make the picture, and the product that it is."""
    rows, columns = plan.counts
    waves = sum(len(colour.wavelengths_um) for colour in plan.colours)
    places, depths = prod(computed_counts(plan.counts, plan.mirrored)), len(plan.vergences)
    product = {"rows": rows, "columns": columns, "waves": waves}
    if depths > 1:
        return Message("{count} PSFs", count=places * waves * depths), Message(
            "{rows} × {columns} places × {waves} wavelengths × {depths} depths", **product, depths=depths
        )
    return Message("{count} PSFs", count=places * waves), (
        Message("{rows} × {columns} places × {waves} wavelengths, mirror images at no cost", **product)
        if places < rows * columns
        else Message("{rows} × {columns} places × {waves} wavelengths", **product)
    )


def plan_notes(plan: Plan) -> Notes:
    """Return the promise of a plan and its decisions; channels that agree appear once."""
    errors: dict[tuple[str, Message, Message, Message], list[float]] = {}
    for decision in plan.decisions:
        heading = Message(HEADINGS[decision.kind], **(decision.what.values if decision.kind == "colour" else {}))
        errors.setdefault((decision.kind, heading, decision.choice, decision.why), []).append(decision.error)
    kinds = list(HEADINGS)
    decisions = sorted(errors.items(), key=lambda item: kinds.index(item[0][0]))
    notes = (
        (heading, Message("{choice}: {why} (error {error:.1g})", choice=choice, why=why, error=max(each)))
        for (_, heading, choice, why), each in decisions
    )
    return ((Message("Error"), promise(plan)), *notes)


def promise(plan: Plan) -> Message:
    """Return the error that a plan predicts, whether that is within the tolerance, and what the plan saves."""
    values = {
        "error": plan.predicted_error,
        "tolerance": plan.allowed_error,
        "times": plan.naive.kernel_seconds / plan.cost.kernel_seconds,
    }
    if plan.meets:
        return Message(
            "{error:.2g} relative, keeps {tolerance:g}; the full grid takes {times:.0f} times as long", **values
        )
    return Message(
        "{error:.2g} relative, does not keep {tolerance:g}; the full grid takes {times:.0f} times as long", **values
    )


def frame_notes(photo: str, shape: tuple[int, int]) -> tuple[Message, Message] | None:
    """Return what is cut off a photo of other proportions than the sensor's, in short and at length; RequestError.

    None where all of it is taken.
    """
    high, wide = cut_away(photo, shape)
    sensor = {"columns": shape[1], "rows": shape[0]}
    if high > SEEN:
        return Message("top and bottom of the photo cut off"), Message(
            "The proportions of the photo differ from those of the sensor ({columns} × {rows} pixels). It fills the "
            "frame; its top and bottom are cut off, {percent:.0f} % of its height.",
            percent=100 * high,
            **sensor,
        )
    if wide > SEEN:
        return Message("sides of the photo cut off"), Message(
            "The proportions of the photo differ from those of the sensor ({columns} × {rows} pixels). It fills the "
            "frame; its sides are cut off, {percent:.0f} % of its width.",
            percent=100 * wide,
            **sensor,
        )
    return None


def transparency(photo: str, shape: tuple[int, int]) -> Notes:
    """Return a note on a photo with transparency, which is left out; RequestError."""
    caution = source_photo(photo, shape).caution
    return ((Message("Transparency"), caution),) if caution else ()


ROWS, COLUMNS = 208, 312
ENLARGED = (1, 1.5, 2, 2.5, 3, 3.5, 4, 5)  # times so many, where the panel has room for them
MOST_SAMPLES = 24  # of λ/2NA across a pixel: a plan of larger pixels takes minutes, and they hide what it is about
TOO_WIDE, TOO_LARGE = Message("No plan: these PSFs are too wide"), Message("No plan: these pixels hide the PSF")
UNMEASURED = {
    None: Message("Not measured. A plan follows when the sliders rest."),
    TOO_WIDE: Message("Not measured. PSFs as wide as these get no plan: it would take minutes."),
    TOO_LARGE: Message(
        "Not measured. Pixels as large as these get no plan, since they hide the blur: choose smaller ones."
    ),
}
RAY_NOTE = Message("These PSFs are ray densities; they are so wide that pixels hide most of what diffraction adds.")
SHARPENED = ("sharpened", "axis")  # of what can be shown
TAKEN = "taken"  # of what can be shown: the photo was taken through the lens, and is sharpened
NO_PHOTO = "choose a photo that was taken through this lens by Photo…, or drop it here: a chart was not"
NO_PIXEL = "choose how large the pixels of the camera are; To Image in Measured states those of the measured picture"
FILTERED = (
    "Wiener's filter by the PSFs of this lens, for noise between {least:.2%} and {most:.2%} of white: "
    "what the photo tells."
)
TOO_MANY = "the photo has {count:.3g} megapixels, of which {most:g} at most are sharpened at once; choose a part of it"
CELL_PX = 24  # of the map of PSFs, at least
ROWS_AT_ONCE, FINEST = 64, 2**16 - 1
CORNER = 0.97  # of the way to the outermost chief ray
BEYOND = 1.02  # of the widest field: image heights of colours, and of near objects, differ by that
TOLERANCE = 0.1  # relative error of a pixel's kernel: less cannot be seen
PLANNING = 0.9  # of the time of a planned picture; the rest are its kernels and the blur
KERNELS = 0.25  # of what follows the plan; the rest is the blur
PLANNING_LARGE = 0.15  # where the picture is of megapixels
USUAL_STEPS = 60  # a plan has 140 to 220 measurements, nobody knows how many, and the first half take most of the time
TO_THE_RIM = (1.0, 0.95, 0.9, 0.8, 0.7, 0.5)  # of the lens's widest field, where the outermost chief ray is lost


@dataclass(frozen=True, eq=False)
class PsfsByDepth:
    """The PSFs of a picture at some depths, ``vergences`` 1/mm from far to near, and its own depths, mm."""

    lattices: tuple[Lattice, ...]
    vergences: np.ndarray
    depth_mm: np.ndarray

    def nearest(self, row: float, column: float) -> Lattice:
        """Return those nearest to the depth of a place in the picture."""
        here = vergence(self.depth_mm[round(row), round(column)])
        return self.lattices[int(np.abs(self.vergences - here).argmin())]


@dataclass(frozen=True)
class ImageRequest:
    """Everything the picture depends on; ``pixel_um`` None takes the lens's whole field, ``shape`` is the sensor's.

    ``grey_nm``: the wavelength of a photo without colours that the lens took; 0 where it does not matter. ``depths``:
    how far away its parts are, all of it at ``depth_mm`` where it has one distance.
    """

    lens: Lens
    depth_mm: float
    photo: str
    show: str
    pixel_um: float | None
    centre_mm: float
    clip: bool = False
    shape: tuple[int, int] = (ROWS, COLUMNS)
    grey_nm: float = 0.0
    depths: DepthChoice = ONE_DISTANCE


@dataclass(frozen=True, eq=False)
class ImageResult:
    """Pictures in linear light (rows, columns, 3), ``before`` and ``after`` the lens (or the sharpening).

    ``quality`` is "coarse" or "planned"; ``headline`` and ``notes`` say what was computed and why, ``cut`` what of the
    photo is not taken, ``no_plan`` why no plan follows a coarse picture, ``alike`` how near the sharpened one comes.
    ``error``: the RMS error expected of a moving picture, of white. ``psfs``: those of a picture with depths.
    """

    question: ImageRequest
    before: np.ndarray
    after: np.ndarray
    quality: str
    plan: Plan
    lattice: Lattice
    seconds: float
    headline: Message
    notes: Notes
    cut: Message | None = None
    no_plan: Message | None = None
    alike: tuple[Message, ...] = ()
    error: float | None = None
    psfs: PsfsByDepth | None = None

    @cached_property
    def painted(self) -> np.ndarray:
        """Return what is seen after the lens, as `pixels`."""
        return pixels(self.after)


def question(live: Live) -> View[None]:
    """Return what the picture of the present state depends on."""
    state, setup = live.state, live.setup
    if state.photo.show == TAKEN:
        return View(None, _photo_request(live))
    whole = state.photo.pixel_um is None
    centre = 0.0 if whole else round(float(setup.coefficients.image_height), 6)
    photo, optics = state.photo, state.optics
    shape = _known_shape(full_shape, photo.source) if whole and photo.full else None
    what = photo.source, photo.show, photo.pixel_um
    depths = depth_choice(state) if photo.show in WITH_DEPTHS else ONE_DISTANCE
    far = optics.depth_mm if depths.source == FLAT else depths.scale.far_mm
    sensor = shape or (ROWS, COLUMNS)
    return View(None, ImageRequest(setup.lens, far, *what, centre, optics.clip, sensor, depths=depths))


def depth_choice(state: State) -> DepthChoice:
    """Return where the depths of the state's picture come from; its numbers only where they matter."""
    photo = state.photo
    if photo.depths in (FLAT, OWN):
        return DepthChoice(photo.depths)
    low, high = sorted((photo.near_mm, photo.far_mm))
    return DepthChoice(photo.depths, DepthScale(photo.depth_meaning, low, high))


def on_stage(request: ImageRequest, room: tuple[int, int]) -> ImageRequest:
    """Return the request with a pixel for each pixel of a room, (rows, columns), in steps, as far as the field goes.

    A photo that the lens took, or of which every pixel is wanted, keeps its own.
    """
    if request.show == TAKEN or request.shape != (ROWS, COLUMNS):
        return request
    fits = [times for times in ENLARGED if all(times * n <= most for n, most in zip(request.shape, room, strict=True))]
    for times in reversed(fits):
        larger = replace(request, shape=(round(times * ROWS), round(times * COLUMNS)))
        if request.pixel_um is None or _has_room(larger):
            return larger
    return request


def _has_room(request: ImageRequest) -> bool:
    """Return whether the field of the lens holds a sensor about the field point; a lost ray is no room."""
    half_mm = hypot(*request.shape) / 2 * (request.pixel_um or 0.0) / UM_PER_MM
    try:
        reach = rim_mm(request.lens, request.depth_mm, float(channels_of(request.lens)[1].wavelengths_um[1]))
    except P2SFError:
        return False
    return abs(request.centre_mm) + half_mm <= CORNER * reach


def _known_shape(shape_of: Callable[[str], tuple[int, int]], photo: str) -> tuple[int, int] | None:
    """Return the shape of a photo; None where it cannot be read, which is said where its pixels are asked for.

    A request that failed would cover the panel, and with it the button that chooses another photo.
    """
    try:
        return shape_of(photo)
    except RequestError:
        return None


def _photo_request(live: Live) -> ImageRequest:
    """Return the request for a photo that the lens took: all of it, or its pixels at the field point."""
    state, setup = live.state, live.setup
    photo, wave_nm = state.photo, setup.source.wavelength_um * NM_PER_UM
    what = photo.source, photo.show, photo.pixel_um
    asked = ImageRequest(setup.lens, state.optics.depth_mm, *what, 0.0, state.optics.clip, grey_nm=wave_nm)
    own = None if photo.source in CHARTS else _known_shape(own_shape, photo.source)
    if own is None or photo.pixel_um is None:
        return asked  # `_taken_values` says what is wrong
    if photo.full:
        return replace(asked, shape=own)
    shape = min(ROWS, own[0]), min(COLUMNS, own[1])
    room = (own[0] - shape[0]) / 2  # pixels above and below
    height = float(setup.coefficients.image_height)
    if room and abs(height) * UM_PER_MM > own[0] / 2 * photo.pixel_um:
        return replace(asked, shape=shape, centre_mm=height)  # beyond the photo, as `_taken_values` says
    top = room - height * UM_PER_MM / photo.pixel_um
    middle = room - round(min(max(top, 0.0), 2 * room))
    return replace(asked, shape=shape, centre_mm=middle * photo.pixel_um / UM_PER_MM)


def coarse(request: ImageRequest, watch: Progress | None = None) -> ImageResult:
    """Return the picture by at most 3 × 3 PSFs per colour, which promise nothing; P2SFError, Cancelled among them."""
    begun, watch = perf_counter(), watch or Progress()
    if request.show == TAKEN:
        return _sharpen(request, watch, begun, quick=True)
    small = in_few_pixels(request)
    coarse_plan = unmeasured_plan(small)
    why_not = no_plan(coarse_plan if small == request else unmeasured_plan(request))
    rays: Notes = ((Message("Rays"), RAY_NOTE),) if by_rays(coarse_plan) else ()
    notes = ((Message("Coarse"), UNMEASURED[why_not]), *rays)
    lattice = preview_lattice(coarse_plan, watch)
    return replace(_answer(small, coarse_plan, watch, begun, notes, lattice), question=request, no_plan=why_not)


def unmeasured_plan(request: ImageRequest) -> Plan:
    """Return the plan of a coarse picture; GeometryError."""
    scene = scene_of(request)
    return preview_plan(scene.camera(request.lens), scene)


def in_few_pixels(request: ImageRequest) -> ImageRequest:
    """Return the request for the same part of the field in the usual number of pixels."""
    shape = small_shape(request.shape)
    pitch = request.pixel_um and request.pixel_um * request.shape[1] / shape[1]
    return replace(request, shape=shape, pixel_um=pitch)


def small_shape(shape: tuple[int, int]) -> tuple[int, int]:
    """Return a shape of the same proportions whose longer side has as many pixels as the usual sensor's, at most."""
    shrink = max(1.0, max(shape) / COLUMNS)
    return max(8, round(shape[0] / shrink)), max(8, round(shape[1] / shrink))


def planned_picture(
    request: ImageRequest, watch: Progress | None = None, known: ImageResult | None = None
) -> ImageResult:
    """Return the picture by a plan that keeps TOLERANCE; raises P2SFError, Cancelled among them.

    ``known``: a planned picture of the same optics, whose plan and kernels are this one's too.
    """
    begun, watch = perf_counter(), watch or Progress()
    if request.show == TAKEN:
        return _sharpen(request, watch, begun, known)
    if known and request.depths == ONE_DISTANCE:
        return _answer(request, known.plan, watch, begun, plan_notes(known.plan), known.lattice)
    share = PLANNING if request.shape == small_shape(request.shape) else PLANNING_LARGE
    new_plan = plan(request.lens, scene_of(request), planning(watch, share))
    return _answer(request, new_plan, forming(watch, share), begun, plan_notes(new_plan))


def _sharpen(
    request: ImageRequest, watch: Progress, begun: float, known: ImageResult | None = None, quick: bool = False
) -> ImageResult:
    """Return a photo that the lens took and the same sharpened, ``quick``: by few PSFs, or not yet if it is large."""
    photo = _taken_values(request)
    small = request.shape == small_shape(request.shape)
    used, lattice = _taken_lattice(request, photo.shape[-1], watch, quick, known)
    told = photo_statistics(photo, lattice)
    sharp = wiener(photo, lattice, told, part_of(watch, PLANNING, 1.0)) if small or not quick else photo
    count, product = psf_counts(used)
    why_not = no_plan(used) if quick else None
    measured = ((Message("Coarse"), UNMEASURED[why_not]),) if quick else plan_notes(used) if used.decisions else ()
    return ImageResult(
        question=request,
        before=in_colours(photo),
        after=in_colours(sharp),
        quality="coarse" if quick else "planned",
        plan=used,
        lattice=lattice,
        seconds=perf_counter() - begun,
        headline=count,
        notes=(
            (Message("Sharpening"), Message(FILTERED, least=told.low, most=told.high)),
            *transparency(request.photo, own_shape(request.photo)),
            (Message("PSFs"), product),
            *measured,
        ),
        no_plan=why_not,
    )


def _taken_values(request: ImageRequest) -> np.ndarray:
    """Return the pixels asked for of a photo, (rows, columns, 3), or 1 where it has no colours; RequestError."""
    if request.photo in CHARTS:
        raise RequestError(NO_PHOTO)
    if request.pixel_um is None:
        raise RequestError(NO_PIXEL)
    rows, columns = request.shape
    if rows * columns > MOST_PIXELS:
        raise RequestError(TOO_MANY, count=rows * columns / 1e6, most=MOST_PIXELS / 1e6)
    own = own_shape(request.photo)
    half_mm = own[0] / 2 * request.pixel_um / UM_PER_MM
    if abs(request.centre_mm) > half_mm:
        raise RequestError(
            "the field point lands {height:.4g} mm from the axis, and the photo ends at {half:.4g} mm; choose a "
            "smaller field, or every pixel of the photo",
            height=abs(request.centre_mm),
            half=half_mm,
        )
    whole = scene_values(request.photo, own)
    top = round((own[0] - rows) / 2 - request.centre_mm * UM_PER_MM / request.pixel_um)
    left = (own[1] - columns) // 2
    part = whole[top : top + rows, left : left + columns]
    grey = np.array_equal(part[..., 0], part[..., 1]) and np.array_equal(part[..., 0], part[..., 2])
    return part[..., :1] if grey else part


def _taken_lattice(
    request: ImageRequest, channels: int, watch: Progress, quick: bool, known: ImageResult | None
) -> tuple[Plan, Lattice]:
    """Return the plan and the kernels of a photo that the lens took."""
    if known and len(known.plan.scene.channels) == channels:
        return known.plan, known.lattice
    assert request.pixel_um is not None
    light = channels_of(request.lens) if channels > 1 else (Channel("grey", (request.grey_nm,), (1.0,)),)
    sensor = Sensor(*request.shape, request.pixel_um, (0.0, request.centre_mm))
    scene = Scene(sensor, light, request.depth_mm, request.depth_mm, TOLERANCE, clip=request.clip)
    if quick:
        coarse_plan = preview_plan(scene.camera(request.lens), scene)
        return coarse_plan, preview_lattice(coarse_plan, part_of(watch, 0.0, PLANNING))
    made = plan(request.lens, scene, planning(watch, PLANNING / 2))
    return made, plan_lattice(made, made.vergences[0], part_of(watch, PLANNING / 2, PLANNING))


def in_colours(values: np.ndarray) -> np.ndarray:
    """Return a picture of one channel or three as one of three."""
    return np.repeat(values, 3, axis=-1) if values.shape[-1] == 1 else values


def same_optics(one: ImageRequest, two: ImageRequest) -> bool:
    """Return whether two pictures differ only in what is photographed and shown."""
    return replace(one, photo=two.photo, show=two.show) == two


def planning(watch: Progress, share: float = PLANNING) -> Callable[[], None]:
    """Return what a plan calls before each measurement; the part approaches ``share``, since the end is not known."""
    tell = watch.progress
    steps = Progress(tell and (lambda _: tell(share * (1 - exp(-steps.done / USUAL_STEPS)))), watch.cancelled)
    return steps.advance


def forming(watch: Progress, share: float = PLANNING) -> Progress:
    """Return the progress of forming a picture by a finished plan, which has taken ``share`` of the time."""
    return part_of(watch, share, 1.0)


def part_of(watch: Progress, start: float, end: float) -> Progress:
    """Return the progress of a part of the work, told as ``start`` to ``end`` of the whole."""
    tell = watch.progress
    return Progress(tell and (lambda part: tell(start + (end - start) * part)), watch.cancelled)


def _answer(
    request: ImageRequest, plan: Plan, watch: Progress, begun: float, notes: Notes, lattice: Lattice | None = None
) -> ImageResult:
    values = scene_values(request.photo, request.shape)
    lattice = lattice or plan_lattice(plan, plan.vergences[0], part_of(watch, 0.0, KERNELS))
    depths = depth_map(request.depths, request.photo, request.shape)
    before, after, sharpening = shown_picture(request.show, plan, values, lattice, part_of(watch, KERNELS, 1.0), depths)
    alike = (
        [
            Message("{name}: {likeness}", name=name, likeness=likeness(x, values))
            for name, x in ((Message("blurred"), before), (Message("sharpened"), after))
        ]
        if request.show in SHARPENED
        else []
    )
    count, product = psf_counts(plan)
    cut = frame_notes(request.photo, request.shape)
    frame = (*(((Message("Frame"), cut[1]),) if cut else ()), *transparency(request.photo, request.shape))
    return ImageResult(
        question=request,
        before=before,
        after=after,
        quality="planned" if plan.decisions else "coarse",
        plan=plan,
        lattice=lattice,
        seconds=perf_counter() - begun,
        headline=count,
        notes=(*sharpening, *frame, *moved_in(request, plan), (Message("PSFs"), product), *notes),
        cut=cut[0] if cut else None,
        alike=tuple(alike),
    )


def shown_picture(
    show: str, plan: Plan, values: np.ndarray, lattice: Lattice, watch: Progress, depth_mm: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray, Notes]:
    """Return the two pictures to compare, and notes on them."""
    if show == "lens":
        return values, form_image(plan, values, depth_mm, watch=watch, lattice=lattice), ()
    if show == "psfs":
        formed = form_image(plan, values, watch=watch, lattice=lattice)
        return formed, psf_map(lattice, values.shape[:2]), method_notes(plan)
    blurred = form_image(plan, values, depth_mm, Forming(geometry=False), watch, lattice)
    blurred = blurred + np.random.default_rng(0).normal(0, NOISE, blurred.shape).astype(np.float32)
    far = depth_mm is None
    right = wiener(blurred, lattice, NOISE, watch) if far else sharpen_planned(plan, blurred, depth_mm, NOISE, watch)
    wrong = wiener(blurred, with_one_kernel(lattice, axis_kernel(plan, lattice)), NOISE, watch)
    pictures = {"blurred": blurred, "own": right, "axis": wrong}
    note = Message(
        "Compared with the scene, the blurred picture has {blurred}; sharpened by its own PSFs {own}; by the PSF on "
        "the axis {axis} (Wiener's filter, noise {noise:.1%} of white; PSNR of linear light, SSIM of sRGB levels).",
        noise=NOISE,
        **{name: likeness(picture, values) for name, picture in pictures.items()},
    )
    return blurred, right if show == "sharpened" else wrong, ((Message("Sharpening"), note),)


def likeness(picture: np.ndarray, scene: np.ndarray) -> Message:
    """Return how near a picture comes to the scene, both in linear light."""
    shown, wanted = (srgb_from_linear(np.clip(x, 0, 1)) for x in (picture, scene))
    return Message("{psnr:.1f} dB, SSIM {ssim:.3f}", psnr=psnr(picture, scene), ssim=ssim(shown, wanted))


def psf_map(lattice: Lattice, shape: tuple[int, int]) -> np.ndarray:
    """Return the PSFs that make a picture, each at its place, (rows, columns, 3).

    Each is the root of its kernel over its peak, as large as its cell allows; where cells are small only every second
    place is shown, or every third, and so on.
    """
    picture = np.zeros((*shape, 3), np.float32)
    places = [np.arange(0, len(nodes), every(nodes)) for nodes in (lattice.row_nodes, lattice.column_nodes)]
    edges = [
        cell_edges(nodes[at], count)
        for nodes, at, count in zip((lattice.row_nodes, lattice.column_nodes), places, shape, strict=True)
    ]
    for a, (top, bottom) in zip(places[0], pairwise(edges[0]), strict=True):
        for b, (left, right) in zip(places[1], pairwise(edges[1]), strict=True):
            tile = small_psf(lattice.kernels[a][b], min(bottom - top, right - left) - 2)
            row, column = (top + bottom - len(tile)) // 2, (left + right - len(tile)) // 2
            picture[row : row + len(tile), column : column + len(tile)] = tile
    return picture


def every(nodes: np.ndarray) -> int:
    """Return which of the nodes are shown, so that their cells are not smaller than `CELL_PX`."""
    return 1 if len(nodes) < 2 else max(1, ceil(CELL_PX / float(nodes[1] - nodes[0])))


def cell_edges(nodes: np.ndarray, count: int) -> list[int]:
    """Return where the cells about nodes begin and end, pixels from 0 to ``count``."""
    middles = (nodes[1:] + nodes[:-1]) / 2
    return [0, *(round(float(m)) for m in middles), count]


def small_psf(kernels: np.ndarray, side: int) -> np.ndarray:
    """Return the kernels of one place as a square of ``side`` pixels at most, (side, side, 3), each place's peak 1."""
    from PIL import Image

    side = max(1, side)
    planes = (Image.fromarray(np.ascontiguousarray(plane)) for plane in kernels)
    how = Image.Resampling.BOX if kernels.shape[-1] >= side else Image.Resampling.NEAREST
    tile = np.stack([np.asarray(plane.resize((side, side), how)) for plane in planes], axis=-1)
    found: np.ndarray = np.sqrt(np.maximum(tile, 0) / tile.max())
    return found


def method_notes(plan: Plan) -> Notes:
    """Return which method makes the PSFs, of a plan whose decisions do not say so."""
    return () if plan.decisions else ((Message("Method"), recipe_words(plan.recipe)),)


def recipe_words(recipe: Recipe) -> Message:
    """Return how kernels are made."""
    if recipe.method == RAYS:
        return Message("ray density")
    if recipe.numbers is None:
        return Message(recipe.method)
    return Message("{method}, {count} numbers", method=recipe.method, count=recipe.numbers)


def fine_enough(answer: ImageResult) -> bool:
    """Return whether a plan is worth its time, for a coarse picture."""
    return answer.no_plan is None


def no_plan(plan: Plan) -> Message | None:
    """Return why a plan is not worth its time, `TOO_WIDE` or `TOO_LARGE`; None where it is."""
    kernels = plan.kernels(len(plan.colours) // 2, plan.vergences[0])
    middle, _ = kernels.lights(*field_area(kernels.seen.fields, plan.scene.sensor).near)[0]
    if 2 * middle.radius * kernels.pixel_um > MOST_SAMPLES:
        return TOO_LARGE
    return TOO_WIDE if by_rays(plan) else None


def by_rays(plan: Plan) -> bool:
    """Return whether a plan's kernels are densities of rays."""
    return plan.recipe.method == RAYS


def axis_kernel(plan: Plan, lattice: Lattice) -> np.ndarray:
    """Return the kernels on the axis, one per channel, all of the lattice's largest size."""
    kernels = [plan.kernels(number, plan.vergences[0]) for number in range(len(plan.colours))]
    return np.stack([k.at(0.0, 0.0, lattice.half) for k in kernels])


def scene_of(request: ImageRequest) -> Scene:
    """Return the scene: one depth, the lens's colours, and a sensor at the field point or over the whole field.

    A sensor that would stand out over the lens's field is moved in. Raises GeometryError for a field point beyond it.
    """
    channels = channels_of(request.lens)
    if request.pixel_um is not None:
        _check_within(request)
    depths = occupied_depths(request.depths, request.photo, request.shape)
    near, far, gaps = depths or (request.depth_mm, request.depth_mm, ())
    reach = CORNER * rim_mm(request.lens, request.depth_mm, float(channels[1].wavelengths_um[1]))
    half_um = hypot(*request.shape) / 2
    if request.pixel_um is None:
        sensor = Sensor(*request.shape, reach * UM_PER_MM / half_um)
    else:
        room = max(0.0, reach - half_um * request.pixel_um / UM_PER_MM)
        sensor = Sensor(*request.shape, request.pixel_um, (0.0, float(np.clip(request.centre_mm, -room, room))))
    return Scene(sensor, channels, near, far, TOLERANCE, clip=request.clip, gaps_mm=gaps)


def moved_in(request: ImageRequest, plan: Plan) -> Notes:
    """Return a note where the sensor, moved in, no longer holds the field point."""
    sensor = plan.scene.sensor
    off = abs(request.centre_mm - sensor.centre_mm[1])
    if request.pixel_um is None or off <= sensor.rows / 2 * sensor.pixel_mm:
        return ()
    words = "{off:.3g} mm from the middle of this picture, which was moved in to stay within the field of the lens"
    return ((Message("Field point"), Message(words, off=off)),)


def _check_within(request: ImageRequest) -> None:
    """Raise GeometryError where the field point lies beyond the lens's field: the sensor would show another place."""
    lens = request.lens
    asked = float(degrees_from_slope(field_from_image_height(lens, lens.reference_wavelength_um, request.centre_mm)))
    widest = lens.widest_field_deg
    if widest and abs(asked) > widest * BEYOND:
        raise GeometryError(
            "the field of {field:.4g}° lies beyond the {widest:g}° of this lens, where there is no picture of it; "
            "choose a smaller field, or the whole field",
            field=abs(asked),
            widest=widest,
        )


def rim_mm(lens: Lens, depth_mm: float, wavelength_um: float) -> float:
    """Return how far from the axis the lens's widest field lands, mm; GeometryError where no ray lands."""
    widest = lens.widest_field_deg or 1.0
    for part in TO_THE_RIM:
        slope = float(slope_from_degrees(part * widest))
        try:
            return abs(float(chief_heights(lens, Source(depth_mm, slope, wavelength_um))))
        except GeometryError:
            continue
    raise GeometryError("no chief ray of this lens's field reaches the sensor; choose a part of the field instead")


def local_psf(answer: ImageResult, row: float, column: float) -> np.ndarray:
    """Return the PSF of a place in the picture as the picture uses it, (size, size, 3), its peak at 1."""
    lattice = answer.psfs.nearest(row, column) if answer.psfs else answer.lattice
    total = lattice.at(row, column)
    return in_colours(np.moveaxis(total / total.max(), 0, -1).astype(np.float32))


def pixels(values: np.ndarray) -> np.ndarray:
    """Return linear light (rows, columns, 3) as 0xffRRGGBB in sRGB, row 0 the top; a few rows at a time."""
    found, levels = np.empty(values.shape[:2], np.uint32), srgb_levels()
    for start in range(0, len(values), ROWS_AT_ONCE):
        part = values[start : start + ROWS_AT_ONCE]
        codes = (np.clip(part, 0, 1) * np.float32(FINEST) + np.float32(0.5)).astype(np.uint16)
        red, green, blue = (levels[codes[..., channel]] for channel in range(3))
        found[start : start + len(part)] = 0xFF000000 | red << 16 | green << 8 | blue
    return found


@lru_cache(maxsize=1)
def srgb_levels() -> np.ndarray:
    """Return the level of sRGB, 0 to 255, of linear light in steps of 1/FINEST, which are a twentieth of it at most."""
    found: np.ndarray = np.rint(255 * srgb_from_linear(np.arange(FINEST + 1) / FINEST)).astype(np.uint32)
    return found


def work(
    make: Callable[[ImageRequest, Progress], ImageResult], request: ImageRequest
) -> Callable[[Event, Callable[[float], None]], ImageResult]:
    """Return a worker's job for one way of making the picture, and what is seen of it."""

    def job(cancelled: Event, progress: Callable[[float], None]) -> ImageResult:
        found = make(request, Progress(progress, cancelled.is_set))
        assert found.painted.size  # here, and not in the window's thread
        return found

    return job


def save_picture(answer: ImageResult, path: str | Path, texts: Mapping[str, str]) -> None:
    """Write the picture at the right of the split as .png, .tif or .exr, at the depth of its photo; ExportError.

    ``texts`` are stored in it by name.
    """
    photo = source_photo(answer.question.photo, answer.question.shape)
    encoding = "linear" if keeps_light(path, photo.encoding) else "srgb"
    write_photo(path, answer.after, encoding, kept_depth(path, replace(photo, encoding=encoding)), texts)
