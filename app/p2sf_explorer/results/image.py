"""A photo through the present lens: the coarse picture, the planned one, and what knowing the PSF gives back.

`question` alone runs on the live path; a worker runs `coarse` (some 0.2 s) and `planned` (some seconds).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import exp, hypot
from time import perf_counter

import numpy as np

from p2sf.conventions import UM_PER_MM, slope_from_degrees
from p2sf.errors import GeometryError, SamplingError
from p2sf.image import Forming, Progress, form_image, plan_lattice
from p2sf.image.deblur import psnr, wiener, with_one_kernel
from p2sf.image.lattice import Lattice
from p2sf.image.preview import preview_plan
from p2sf.io.transfer import srgb_from_linear
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pixel_kernels.nodes import hats
from p2sf.pixel_kernels.pixels import samples_across
from p2sf.pixel_kernels.sensor_points import chief_heights
from p2sf.scene import Plan, Scene, Sensor, plan
from p2sf_explorer.results.photos import NOISE, channels_of, cut_away, scene_values

SEEN = 0.005  # of a photo's side: less is a pixel or two


def count_words(made: Plan) -> tuple[str, str]:
    """Return how many PSFs make the picture, and the product that it is."""
    rows, columns = made.counts
    waves = sum(len(colour.wavelengths_um) for colour in made.colours)
    twins = made.scene.sensor.centred and rows * columns > 1
    once = (-(-rows // 2)) * (-(-columns // 2)) if twins else rows * columns
    text = f"{rows} × {columns} places × {waves} wavelengths"
    many = f"{once * waves} PSFs"
    return many, f"{text}, mirror images for nothing" if twins and once < rows * columns else text


PLAIN = {  # in the order they are told
    "field": "Places",
    "colour": "Colour",
    "method": "Method",
    "terms": "Phase",
    "sampling": "Sampling",
    "depth": "Depths",
    "pupils": "Pupils",
}


def plan_words(made: Plan) -> tuple[tuple[str, str], ...]:
    """Return every decision of a plan as (what, sentence); rings of the field that agree are told once."""
    found: dict[tuple[str, str, str], list[float]] = {}
    for decision in made.decisions:
        kind, _, which = decision.what.partition(" ")
        name = f"{PLAIN[kind]} {which}" if kind == "colour" else PLAIN[kind]
        found.setdefault((name, decision.choice, decision.why), []).append(decision.error)
    rows = [(name, f"{choice}: {why} (error {max(errors):.1g})") for (name, choice, why), errors in found.items()]
    order = list(PLAIN.values())
    rows.sort(key=lambda row: order.index(row[0].split(" ")[0]))
    verdict = "keeps" if made.meets else "does not keep"
    saved = made.naive.kernel_seconds / made.cost.kernel_seconds
    kept = f"{made.predicted_error:.2g} relative, {verdict} {made.scene.relative_tolerance:g}"
    promise = f"{kept}; the full grid takes {saved:.0f} times as long"
    return (("Error", promise), *rows)


def frame_words(photo: str, shape: tuple[int, int]) -> tuple[str, str]:
    """Return what becomes of a photo of other proportions than the sensor's, in short and in a sentence; RequestError.

    Nothing where all of it is taken.
    """
    for share, side, ends in zip(cut_away(photo, shape), ("height", "width"), ("top and bottom", "sides"), strict=True):
        if share > SEEN:
            why = f"The sensor has {shape[1]} × {shape[0]} pixels and the photo other proportions"
            long = f"{why}, so that it fills the frame and its {ends} are cut off, {100 * share:.0f} % of its {side}."
            return f"{ends} of the photo cut off", long
    return "", ""


ROWS, COLUMNS = 208, 312
MOST_SAMPLES = 24  # of λ/2NA across a pixel: a plan of larger pixels takes minutes, and they hide what it is about
TOO_WIDE, TOO_LARGE = "No plan: these PSFs are too wide", "No plan: these pixels hide the PSF"
PLANLESS = {
    TOO_WIDE: "No plan is made for PSFs as wide as these: it would take minutes.",
    TOO_LARGE: "No plan is made for pixels as large as these, which hide what it cares for: choose smaller ones.",
}
COUNTS = ((800, (3, 3)), (1200, (2, 2)), (2000, (1, 1)))  # samples along a PSF's side, and at how many places then
WIDEST = COUNTS[-1][0]
CORNER = 0.97  # of the way to the outermost chief ray
TOLERANCE = 0.1  # relative error of a pixel's kernel: less than that no eye sees
PLANNING = 0.9  # of the time of a planned picture; the rest are its kernels and the blur
USUAL_STEPS = 60  # a plan has 140 to 220 measurements, nobody knows how many, and the first half take most of the time
TO_THE_RIM = (1.0, 0.95, 0.9, 0.8, 0.7, 0.5)  # of the lens's widest field, where the outermost chief ray is lost

Result = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class ImageRequest:
    """Everything the picture depends on; ``pixel_um`` None takes the lens's whole field."""

    lens: Lens
    depth_mm: float
    photo: str
    show: str
    pixel_um: float | None
    centre_mm: float


@dataclass(frozen=True, eq=False)
class ImageResult:
    """Pictures in linear light (rows, columns, 3), ``before`` and ``after`` the lens (or the sharpening).

    ``quality`` is "coarse" or "planned"; ``headline`` and ``words``, (what, sentence), say what was computed and why,
    ``cut`` what of the photo is not taken, ``no_plan`` why a coarse picture stays so.
    """

    question: ImageRequest
    before: np.ndarray
    after: np.ndarray
    quality: str
    plan: Plan
    lattice: Lattice
    seconds: float
    headline: str
    words: tuple[tuple[str, str], ...]
    cut: str = ""
    no_plan: str = ""


def question(live) -> ImageRequest:
    """Return what the image panel must know of the present state."""
    state, setup = live.state, live.setup
    whole = state.photo_pixel_um is None
    centre = 0.0 if whole else round(float(setup.coefficients.image_height), 6)
    return ImageRequest(setup.lens, state.depth_mm, state.photo, state.photo_show, state.photo_pixel_um, centre)


def coarse(asked: ImageRequest, watch: Progress | None = None) -> ImageResult:
    """Return the picture by at most 3 × 3 PSFs per colour, which promise nothing; P2SFError, Cancelled among them."""
    begun, scene = perf_counter(), scene_of(asked)
    made = affordable(preview_plan(scene.camera(asked.lens), scene))
    why_not = no_plan(made)
    words = ("Coarse", f"Unmeasured. {PLANLESS.get(why_not, 'When the sliders rest a plan follows.')}")
    return replace(_answer(asked, made, watch or Progress(), begun, (words,)), no_plan=why_not)


def planned(asked: ImageRequest, watch: Progress | None = None, known: ImageResult | None = None) -> ImageResult:
    """Return the picture by a plan that keeps TOLERANCE; raises P2SFError, Cancelled among them.

    ``known``: a planned picture of the same optics, whose plan and kernels are this one's too.
    """
    begun, watch = perf_counter(), watch or Progress()
    if known:
        return _answer(asked, known.plan, watch, begun, plan_words(known.plan), known.lattice)
    made = plan(asked.lens, scene_of(asked), planning(watch))
    return _answer(asked, made, forming(watch), begun, plan_words(made))


def same_optics(one: ImageRequest, two: ImageRequest) -> bool:
    """Return whether two pictures differ in what is photographed and shown alone."""
    return replace(one, photo=two.photo, show=two.show) == two


def planning(watch: Progress) -> Callable[[], None]:
    """Return what a plan calls before each measurement; its share nears PLANNING ever slower, since no end is known."""
    tell = watch.progress
    steps = Progress(tell and (lambda _: tell(PLANNING * (1 - exp(-steps.done / USUAL_STEPS)))), watch.cancelled)
    return steps.advance


def forming(watch: Progress) -> Progress:
    """Return what watches the picture being formed by a plan that is made."""
    tell = watch.progress
    return Progress(tell and (lambda part: tell(PLANNING + (1 - PLANNING) * part)), watch.cancelled)


def _answer(
    asked: ImageRequest, made: Plan, watch: Progress, begun: float, said, lattice: Lattice | None = None
) -> ImageResult:
    values = scene_values(asked.photo, (ROWS, COLUMNS))
    lattice = lattice or plan_lattice(made, made.vergences[0], watch)
    before, after, more = shown(asked.show, made, values, lattice, watch)
    quality = "planned" if made.decisions else "coarse"
    many, product = count_words(made)
    short, cut = frame_words(asked.photo, (ROWS, COLUMNS))
    words = (*more, *((("Frame", cut),) if cut else ()), ("PSFs", product), *said)
    return ImageResult(asked, before, after, quality, made, lattice, perf_counter() - begun, many, words, short)


def shown(show: str, made: Plan, values, lattice: Lattice, watch: Progress):
    """Return the two pictures to compare, and sentences about them."""
    if show == "lens":
        return values, form_image(made, values, watch=watch, lattice=lattice), ()
    blurred = form_image(made, values, how=Forming(geometry=False), watch=watch, lattice=lattice)
    blurred = blurred + np.random.default_rng(0).normal(0, NOISE, blurred.shape).astype(np.float32)
    right = wiener(blurred, lattice, NOISE, watch)
    wrong = wiener(blurred, with_one_kernel(lattice, axis_kernel(made, lattice)), NOISE, watch)
    marks = [f"{psnr(picture, values):.1f} dB" for picture in (blurred, right, wrong)]
    words = (
        "Sharpening",
        f"Against the scene the blurred picture has {marks[0]}, sharpened by its own PSFs {marks[1]}, "
        f"by the PSF of the axis {marks[2]} (Wiener's filter, noise {NOISE:.1%} of white).",
    )
    return blurred, right if show == "sharpened" else wrong, (words,)


def affordable(made: Plan) -> Plan:
    """Return a coarse plan with fewer places where a PSF is wide; SamplingError where one alone takes seconds."""
    rim = made.scene.sensor.corners_mm()[1]
    kernels = made.kernels(1, made.vergences[0])
    size = 2 * kernels.half_width(rim) + 1
    side = size * samples_across(kernels.pupils(rim)[0][0], kernels.pixel_um)
    if side > WIDEST:
        raise SamplingError(
            f"points blur over {size * kernels.pixel_um / UM_PER_MM:.2g} mm here, too much to wait for; "
            "stop down, or move the source towards the axis or into focus"
        )
    return replace(made, counts=next(counts for most, counts in COUNTS if side <= most))


def fine_enough(answer: ImageResult) -> bool:
    """Return whether a plan is worth its time."""
    return not no_plan(answer.plan)


def no_plan(made: Plan) -> str:
    """Return why a plan is not worth its time, one of PLANLESS; nothing where it is."""
    if made.counts == (1, 1):
        return TOO_WIDE
    kernels = made.kernels(1, made.vergences[0])
    pupil, _ = kernels.pupils(0.0)[0]
    return TOO_LARGE if 2 * pupil.radius * kernels.pixel_um > MOST_SAMPLES else ""


def axis_kernel(made: Plan, lattice: Lattice) -> np.ndarray:
    """Return the kernels on the axis, one per channel, all of the lattice's largest size."""
    kernels = [made.kernels(number, made.vergences[0]) for number in range(len(made.colours))]
    return np.stack([k.at(0.0, 0.0, lattice.half) for k in kernels])


def scene_of(asked: ImageRequest) -> Scene:
    """Return the scene: one depth, the lens's colours, and a sensor at the field point or over the whole field.

    A sensor that would stand out over the lens's field is moved in.
    """
    channels = channels_of(asked.lens)
    reach = CORNER * rim_mm(asked.lens, asked.depth_mm, float(channels[1].wavelengths_um[1]))
    half_um = hypot(ROWS, COLUMNS) / 2
    if asked.pixel_um is None:
        sensor = Sensor(ROWS, COLUMNS, reach * UM_PER_MM / half_um)
    else:
        room = max(0.0, reach - half_um * asked.pixel_um / UM_PER_MM)
        sensor = Sensor(ROWS, COLUMNS, asked.pixel_um, (0.0, float(np.clip(asked.centre_mm, -room, room))))
    return Scene(sensor, channels, asked.depth_mm, asked.depth_mm, TOLERANCE)


def rim_mm(lens: Lens, depth_mm: float, wavelength_um: float) -> float:
    """Return how far from the axis the lens's widest field lands, mm; GeometryError where no ray lands."""
    widest = max(abs(angle) for angle in lens.fields_deg) or 1.0
    for part in TO_THE_RIM:
        slope = float(slope_from_degrees(part * widest))
        try:
            return abs(float(chief_heights(lens, Source(depth_mm, slope, wavelength_um))))
        except GeometryError:
            continue
    raise GeometryError("no chief ray of this lens's field reaches the sensor; choose a part of the field instead")


def local_psf(answer: ImageResult, row: float, column: float) -> np.ndarray:
    """Return the PSF of a place in the picture as the picture uses it, (size, size, 3), its peak at 1."""
    lattice, size = answer.lattice, 2 * answer.lattice.half + 1
    down = hats(lattice.row_nodes, np.array([row]))[:, 0]
    right = hats(lattice.column_nodes, np.array([column]))[:, 0]
    total = np.zeros((lattice.channels, size, size), np.float32)
    for a, b in zip(*np.nonzero(np.outer(down, right)), strict=True):
        kernel = lattice.kernels[a][b]
        edge = (size - kernel.shape[-1]) // 2
        total[:, edge : size - edge, edge : size - edge] += np.float32(down[a] * right[b]) * kernel
    return np.moveaxis(total / total.max(), 0, -1)


def pixels(values: np.ndarray) -> np.ndarray:
    """Return linear light (rows, columns, 3) as 0xffRRGGBB in sRGB, row 0 the top."""
    levels = np.rint(255 * np.clip(srgb_from_linear(np.clip(values, 0, 1)), 0, 1)).astype(np.uint32)
    return np.ascontiguousarray(0xFF000000 | levels[..., 0] << 16 | levels[..., 1] << 8 | levels[..., 2], np.uint32)


def work(make: Callable[[ImageRequest, Progress], ImageResult], asked: ImageRequest):
    """Return a worker's job for one way of making the picture."""
    return lambda cancelled, progress: make(asked, Progress(progress, cancelled.is_set))


def save_picture(answer: ImageResult, path) -> None:
    """Write the picture at the right of the split as .png or .tif; ExportError."""
    from p2sf.io.photo_files import write_photo

    write_photo(path, answer.after)
