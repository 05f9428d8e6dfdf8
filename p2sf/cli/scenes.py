"""`p2sf plan` and `p2sf image`: what a scene requires, and its picture through the lens."""

import json
import sys
from dataclasses import dataclass, fields, replace
from math import inf
from pathlib import Path
from time import perf_counter
from typing import Annotated, Any, Literal

import numpy as np
from cyclopts import Parameter

from p2sf.camera import Camera
from p2sf.cli.cautions import open_lens
from p2sf.cli.options import AS_IN_ITS_FILE, CameraFlags, Json, LensName, Output, Threads, check_output
from p2sf.cli.screen import print_json, print_table, warn
from p2sf.errors import RequestError
from p2sf.files.writing import plain, write_beside
from p2sf.image.charts import CHARTS, draw_chart
from p2sf.image.exposure import check_seed, expose, raw_numbers
from p2sf.io.depth_files import read_scene_depths
from p2sf.io.photo_files import WRITABLE, Photo, check_ending, kept_depth, read_photo, stored_as, write_photo
from p2sf.io.record import RECORD, describe_many
from p2sf.lens.lens import Lens
from p2sf.messages import Message, ParameterName
from p2sf.parameters import check_whole
from p2sf.raytrace.focusing import object_distance
from p2sf.scene.files import read_scene
from p2sf.scene.planning.plan import Plan, plan
from p2sf.scene.planning.table import plan_facts, plan_rows, plan_sentences
from p2sf.scene.planning.verify import verify
from p2sf.scene.scene import DIMMEST, MOST_LIGHT, RGB, Scene
from p2sf.scene.sensor import MOST_ROWS, Sensor
from p2sf.setting import explicit_values, set_up
from p2sf.threads import using_threads

CHART = "chart:"
RAW = ".npy", ".dng"
TELL_EVERY_S = 1.0
BARELY_WHITE = 1.001  # rounding of white is no light that is cut off
LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)  # of linear sRGB (IEC 61966-2-1)
SCENE_HELP = (
    "A scene as TOML: rtol = 0.05 (or min_r2, mtf_error, min_psnr_db, tail_error), f_number, zoom, focus_position, "
    "focus_mm, aim, clip, brightest; [sensor] rows, columns, pixel_um, centre_mm, full_well, read_noise, bits, "
    "black_level, mosaic, fill_factor; [depth] near_mm, far_mm, gaps_mm, map, map_meaning; [[channel]] name, "
    "wavelengths_nm, weights, or [filters] curves, light, by default red, green and blue."
)
TOO_TIGHT = Message("the plan cannot keep the tolerance; loosen it or reduce the scene")
SceneFile = Annotated[Path, Parameter(help=SCENE_HELP)]


def plan_command(
    lens: LensName,
    scene: SceneFile,
    /,
    *,
    check: Annotated[int, Parameter(help="Measure the error at this many random points against exact rays.")] = 0,
    threads: Threads = None,
    as_json: Json = False,
) -> None:
    """Decide what a scene requires of a lens model, and say why."""
    check_whole("check", check, 0, 1000)
    glass = open_lens(lens)
    asked = _read_scene(glass, scene)
    depth = depth_map(asked)
    planned = _make_plan(glass, asked if depth is None else asked.at_depths(depth))
    with using_threads(threads):
        verdict = verify(planned, check) if check else None
    measured = None if verdict is None else {"points": check, "worst": verdict.worst, "kept": verdict.kept}
    if as_json:
        return print_json({"lens": lens, "scene": planned.scene.name, **plan_facts(planned), "measured": measured})
    warn(None if planned.meets else TOO_TIGHT)
    title = f"{glass.title or glass.name}: {planned.scene.name}"
    print_table(title, ("decision", "choice", "error", "why"), plan_rows(planned))
    sentences = plan_sentences(planned)
    if verdict is not None:
        held = "within" if verdict.kept else "beyond"
        sentences.append(f"At {check} random points exact rays find {verdict.worst:.3g} at most, {held} the tolerance.")
    print("\n".join(sentences))
    return None


def _read_scene(glass: Lens, path: Path) -> Scene:
    """Return a file's scene; a focus or f-number that the lens cannot take is named as in the file."""
    scene = read_scene(path, object_distance(glass))
    try:
        scene.camera(glass)
    except RequestError as error:
        # The keys of the file are Python's names, so the error is put into plain words here, not with the flags.
        raise RequestError("{path}: {error}", path=str(path), error=str(error)) from error
    return scene


@dataclass
class PlanningProgress:
    """How many measurements of a plan there were, and after how many seconds that was last printed."""

    count: int = 0
    seconds: float = 0.0


def _make_plan(glass: Lens, scene: Scene) -> Plan:
    """Return the plan, with a line of progress on a terminal; Ctrl+C stops it."""
    if not sys.stderr.isatty():
        return plan(glass, scene)
    begun, told = perf_counter(), PlanningProgress()

    def tell() -> None:
        told.count, passed = told.count + 1, perf_counter() - begun
        if passed - told.seconds > TELL_EVERY_S:
            told.seconds = passed
            line = f"\rplanning: {told.count} measurements in {passed:.0f} s, Ctrl+C stops "
            print(line, end="", file=sys.stderr, flush=True)

    try:
        return plan(glass, scene, tell)
    finally:
        if told.seconds:
            print("\r" + " " * 60 + "\r", end="", file=sys.stderr)


@dataclass(frozen=True)
class Shown:
    """How the picture is formed and written.

    Attributes
    ----------
    method
        By patches (overlap-add), or by few kernels (lowrank).
    surround
        What is beyond the picture: its last pixels (edge), or nothing (black).
    deblur
        Sharpen the formed picture with the same kernels.
    noise
        Add noise of this standard deviation, white being 1.
    seed
        Of all noise; the same one gives the same picture.
    encoding
        What the picture file's numbers mean; whole numbers are sRGB and floats linear when not given.
    depth
        Bits of whole numbers written, or floats of 16 (half) or 32 bits (float), which keep light above white.
    preview
        A coarse picture at once, without a plan.
    longest
        Pixels along the longer side at most, as of a screen; so many pixels of the sensor are joined to one.
    region
        The part to form: top, bottom, left and right in pixels from 0, the ends excluded.
    scheduler
        Address of a dask.distributed scheduler whose workers form the picture, a row of tiles at a time (p2sf cluster);
        this machine's threads when not given.
    """

    method: Literal["patches", "lowrank"] = "patches"
    surround: Literal["edge", "black"] = "edge"
    deblur: Literal["wiener", "richardson-lucy"] | None = None
    noise: float = 0.0
    seed: int = 0
    encoding: Literal["srgb", "linear"] | None = None
    depth: Literal["8", "16", "half", "float"] | None = None
    preview: bool = False
    longest: int | None = None
    region: Annotated[tuple[int, int, int, int] | None, Parameter(negative="")] = None
    scheduler: str | None = None

    def __post_init__(self) -> None:
        check_seed(self.seed)
        if self.longest is not None:
            check_whole("longest", self.longest, 1, MOST_ROWS)
        given = {each.name for each in fields(self) if getattr(self, each.name) != each.default}
        for first, other in (
            ("region", "preview"),
            ("region", "deblur"),
            ("region", "longest"),
            *((name, "preview") for name in ("longest", "method", "surround", "noise", "scheduler")),
        ):
            if {first, other} <= given:
                raise RequestError(
                    "{parameter} and {other} are both given; keep one of them",
                    parameter=first,
                    other=ParameterName(other),
                )
        if not 0 <= self.noise < inf:
            raise RequestError(
                "{parameter} is {value:g}; give a standard deviation of 0 or more", parameter="noise", value=self.noise
            )
        if self.deblur and self.preview:
            raise RequestError(
                "{parameter} needs the plan's kernels, which {preview} does without; leave one out",
                parameter="deblur",
                preview=ParameterName("preview"),
            )


USUAL = Shown()


def image(
    lens: LensName,
    scene: SceneFile,
    picture: Annotated[
        str, Parameter(help=f"A PNG, TIFF or OpenEXR, or one of {', '.join(CHART + name for name in CHARTS)}.")
    ],
    /,
    *,
    output: Output = None,
    shown: Annotated[Shown, Parameter(name="*")] = USUAL,
    threads: Threads = None,
    as_json: Json = False,
) -> None:
    """Form the picture that the lens makes of a scene, and write it as .png, .tif or .exr, or raw as .npy or .dng."""
    if output is None:
        raise RequestError(
            "there is no {parameter}; say with -o where the picture goes, such as -o out.png", parameter="output"
        )
    glass = open_lens(lens)
    asked = _read_scene(glass, scene)
    check_output(output, (*WRITABLE, *RAW), None if picture.startswith(CHART) else picture, asked.depth_map)
    if output.suffix.lower() not in RAW:
        check_ending(output)
    _check_reading(output, asked, shown)
    source = source_picture(picture, asked, shown)
    warn(source.caution)
    with using_threads(threads):
        formed, facts = _form_picture(glass, asked, source.values, shown)
    if output.suffix.lower() in RAW:
        encoding = "raw"
        _write_raw(output, formed, asked.sensor)
    else:
        encoding, depth = stored_as(output, source.encoding), shown.depth or kept_depth(output, source)
        _warn_of_white(output, formed, depth)
        texts = {RECORD: json.dumps(plain(_facts(glass, asked, scene, picture) | {"image": facts}))}
        write_photo(output, _for_file(formed, asked), encoding, depth, texts)
    rows, columns = formed.shape[:2]
    if as_json:
        about = {"file": str(output), "aim": asked.camera(glass).aim, "rows": rows, "columns": columns}
        return print_json({**about, "encoding": encoding, **facts})
    print(
        f"{output}: {columns} × {rows} pixels, {encoding}"
        + "".join(f", {key.replace('_', ' ')} {_short(value)}" for key, value in facts.items())
    )
    return None


def _check_reading(output: Path, scene: Scene, shown: Shown) -> None:
    """Raise RequestError, before the work, for what does not go with how the sensor counts light."""
    raw, sensor = output.suffix.lower() in RAW, scene.sensor
    if output.suffix.lower() == ".dng" and len(scene.channels) != len(RGB):
        raise RequestError(
            "{path} holds red, green and blue, but the scene has {count} channels; choose .npy",
            path=str(output),
            count=len(scene.channels),
        )
    if raw and sensor.bits is None:
        raise RequestError("{path} holds raw numbers; state the bits of the sensor in the scene", path=str(output))
    for flag, reason in (
        ("preview", Message("a preview does not count light as the sensor does") if raw or sensor.mosaic else None),
        ("deblur", Message("a mosaic has no colours to sharpen") if sensor.mosaic else None),
        ("noise", Message("the sensor has noise of its own") if sensor.full_well else None),
        ("longest", Message("raw numbers and mosaics are of single pixels") if raw or sensor.mosaic else None),
    ):
        if reason and getattr(shown, flag):
            raise RequestError("{reason}; leave {parameter} out", reason=reason, parameter=flag)


def _warn_of_white(output: Path, formed: np.ndarray, depth: str) -> None:
    """Warn where whole numbers cut off light above white."""
    share = float((formed > BARELY_WHITE).any(-1).mean())
    if share and depth not in ("half", "float"):
        warn(
            Message(
                "{share:.2g} % of the picture is brighter than white, which {path} cuts off; choose {parameter} float "
                "in a .tif, or .exr",
                share=100 * share,
                path=output.name,
                parameter=ParameterName("depth"),
            )
        )


def _write_raw(output: Path, reading: np.ndarray, sensor: Sensor) -> None:
    """Write raw numbers: (rows, columns[, channels]) uint16, or a DNG."""
    from p2sf.io.dng import RawLevels, write_dng

    numbers = raw_numbers(sensor, reading)
    numbers = numbers[..., 0] if numbers.shape[-1] == 1 else numbers
    if output.suffix.lower() == ".npy":
        write_beside(output, lambda handle: np.save(handle, numbers))
        return
    dark, full = np.square(sensor.noise([0.0, 1 / sensor.fill_factor])).tolist()
    white = sensor.black_level + (sensor.steps or 0)
    write_dng(output, numbers, RawLevels(sensor.black_level, white, sensor.mosaic, (full - dark, dark)))


def _facts(glass: Lens, asked: Scene, scene: Path, picture: str) -> dict[str, Any]:
    """Return what a formed picture states: lens, camera and versions, and the files of scene and picture."""
    setup = set_up(glass, asked.request)
    return {**describe_many(setup), "scene": {"file": str(scene), "name": asked.name, "picture": picture}}


def _short(value: object) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def source_picture(picture: str, scene: Scene, shown: Shown) -> Photo:
    """Return a chart or file with the scene's channels."""
    if picture.startswith(CHART):
        rows, columns = scene.sensor.rows, scene.sensor.columns
        photo = Photo(draw_chart(picture.removeprefix(CHART), rows, columns), "srgb", "8")
    else:
        photo = read_photo(picture, shown.encoding)
    wanted, given = len(scene.channels), photo.values.shape[-1]
    if given == wanted:
        return photo
    if given == 1:
        return replace(photo, values=np.repeat(photo.values, wanted, axis=-1))
    if wanted == 1:
        return replace(photo, values=(photo.values @ LUMINANCE)[..., None])
    raise RequestError(
        "{path} has {given} channels and the scene {wanted}; give the scene 1 or {given}",
        path=picture,
        given=given,
        wanted=wanted,
    )


def _form_picture(glass: Lens, scene: Scene, values: np.ndarray, shown: Shown) -> tuple[np.ndarray, dict[str, Any]]:
    from p2sf.image.binning import fit_screen
    from p2sf.image.form import Forming, form_image
    from p2sf.image.picture import region_of_sensor
    from p2sf.image.preview import preview

    if shown.preview:
        return preview(glass, scene, values), {"method": "preview"}
    depth = depth_map(scene)  # before the plan, which takes seconds
    if depth is not None and shown.deblur == "richardson-lucy":
        raise RequestError(
            "{parameter} richardson-lucy has the kernels of one depth, and the scene a map of depths; choose wiener, "
            "which has those of each",
            parameter="deblur",
        )
    region = None if shown.region is None else region_of_sensor(scene.sensor, shown.region)
    if shown.longest is not None:
        scene, values, depth = fit_screen(scene, values, depth, shown.longest)
    scene = replace(scene, brightest=float(np.clip(values.max(), DIMMEST, MOST_LIGHT)))
    planned = _make_plan(glass, scene if depth is None else scene.at_depths(depth))
    warn(None if planned.meets else TOO_TIGHT)
    how = Forming(shown.method, shown.surround, scheduler=shown.scheduler)
    light = _noisy(form_image(planned, values, depth, how, region=region), shown)
    formed = expose(scene.sensor, light, shown.seed)
    facts = {"method": shown.method, "predicted_error": planned.predicted_error}
    if not shown.deblur:
        return formed, facts
    noise = noise_of(scene.sensor, light, shown)
    return _sharpen(planned, formed, depth, shown, noise), {**facts, "deblur": shown.deblur}


def noise_of(sensor: Sensor, light: np.ndarray, shown: Shown) -> float:
    """Return the standard deviation of a reading at the mean of the light: the sensor's noise and what is added."""
    return float(np.hypot(sensor.noise(np.mean(light)), shown.noise))


def _noisy(formed: np.ndarray, shown: Shown) -> np.ndarray:
    if not shown.noise:
        return formed
    noisy: np.ndarray = formed + np.random.default_rng(shown.seed).normal(0, shown.noise, formed.shape).astype(
        np.float32
    )
    return noisy


def _sharpen(planned: Plan, formed: np.ndarray, depth: np.ndarray | None, shown: Shown, noise: float) -> np.ndarray:
    """Return the picture sharpened with its kernels, assuming the noise of 8 bits at least."""
    from p2sf.image.deblur import LEAST_NOISE, richardson_lucy
    from p2sf.image.form import plan_lattice
    from p2sf.image.picture import sharpen_planned

    if shown.deblur == "wiener":
        return sharpen_planned(planned, formed, depth, max(noise, LEAST_NOISE))
    return richardson_lucy(formed, plan_lattice(planned, planned.vergences[0]))


def sharpen(
    lens: LensName,
    photo: Annotated[Path, Parameter(help="A PNG, TIFF, OpenEXR, JPEG or HEIF that the lens took, not cropped.")],
    /,
    *,
    pixel_um: Annotated[float | None, Parameter(help="Distance between the pixels of the photo on the sensor.")] = None,
    depth_mm: Annotated[float | None, Parameter(help="The depth to sharpen; that in focus, or the lens's own.")] = None,
    camera: CameraFlags = AS_IN_ITS_FILE,
    clip: Annotated[bool, Parameter(help="Stop rays at the rims of all surfaces.")] = False,
    noise: Annotated[
        float | None, Parameter(help="Its standard deviation, white being 1; estimated if left out.")
    ] = None,
    rtol: Annotated[float, Parameter(help="Relative error of each kernel that is allowed.")] = 0.05,
    encoding: Annotated[
        Literal["srgb", "linear"] | None, Parameter(help="What the numbers of the file mean, as for image.")
    ] = None,
    output: Output = None,
    threads: Threads = None,
    as_json: Json = False,
) -> None:
    """Sharpen a photo that the lens took, by the kernels of every place, and write it as .png or .tif."""
    from p2sf.image.form import check_picture
    from p2sf.image.picture import sharpen_one_depth

    if output is None or pixel_um is None:
        missing = "output" if output is None else "pixel_um"
        raise RequestError("there is no {parameter}; give it", parameter=missing)
    check_output(output, WRITABLE, photo)
    own = Camera(open_lens(lens), pixel_um=pixel_um, **explicit_values(camera))
    taken = read_photo(photo, encoding)
    warn(taken.caution)
    planned = own.picture_plan(taken.values, depth_mm, rtol=rtol, clip=clip)
    with using_threads(threads):
        sharp, about = sharpen_one_depth(planned, check_picture(planned.scene, taken.values), noise)
    write_photo(output, sharp, taken.encoding, kept_depth(output, taken))
    rows, columns = sharp.shape[:2]
    if as_json:
        facts = {"file": str(output), "rows": rows, "columns": columns, "encoding": taken.encoding}
        return print_json({**facts, "least_noise": about.low, "noise": about.high})
    low, high = (f"{level:.2g}" for level in (about.low, about.high))
    noises = high if low == high else f"{low} to {high}"
    print(f"{output}: {columns} × {rows} pixels, {taken.encoding}, noise {noises} of white")
    return None


def depth_map(scene: Scene) -> np.ndarray | None:
    """Return the depths of the scene's map, (rows, columns) mm; None where it has none."""
    if scene.depth_map is None:
        return None
    return read_scene_depths(scene.depth_map, scene.near_mm, scene.far_mm, scene.map_meaning)


def _for_file(values: np.ndarray, scene: Scene) -> np.ndarray:
    if values.shape[-1] not in (1, 3):
        raise RequestError(
            "the scene has {count} channels, but a picture file has 1 or 3; change the scene", count=len(scene.channels)
        )
    return values
