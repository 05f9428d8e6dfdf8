"""What the defaults of image simulation cost: the same pictures by several programs, beside the kernel of every pixel.

``python -m tests.benchmarks.image_simulation --keep FOLDER [--optiland PYTHON] [--deeplens PYTHON] [--figure FILE]``

Twelve pictures of 120 × 180 pixels, four scenes with depth (`tests.support.depth_scenes`) through three shipped lenses,
in three wavelengths; distortion and illumination are left out. The lens is in focus in the middle of 1/depth, and
either end is a wave out of focus. A pixel is some samples λ/(4 NA) wide, so that optiland's PSFs fit. Errors are those
of green in a part of 20 × 28 pixels on the way to the corner, relative to the picture in which every pixel has its own
kernel (`tests.support.per_pixel`); times are CPU seconds of a fresh process, kernels and picture, on one thread; memory
is what the process takes beyond its start. PYTHON is the interpreter of an environment that has the program; without it
the program is left out. What is in FOLDER already is not computed again, so that several processes may share the lenses
(`--lens`); without any program the table is made of what FOLDER holds (`--table`).
"""

import argparse
import resource
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import product
from math import inf
from multiprocessing import get_context
from pathlib import Path
from statistics import median
from time import process_time

import numpy as np
from scipy.ndimage import gaussian_filter, shift
from scipy.optimize import least_squares

from p2sf import write_lens
from p2sf.image.form import Forming, form_image
from p2sf.image.layers import map_depths
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.channel import Recipe
from p2sf.scene.planning.plan import Plan, plan
from p2sf.scene.planning.reference import reference_kernel
from p2sf.scene.planning.study import distance
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from p2sf.scene.spectrum import reduce_spectrum
from p2sf.threads import using_threads
from tests.support.depth_scenes import SCENES
from tests.support.per_pixel import per_pixel_picture, widest_half

SHAPE = 120, 180
REGION = slice(20, 40), slice(24, 52)
SHIFTED = 4  # pixels about REGION that are kept, so that a picture may be shifted onto the reference
WIDER = tuple(slice(part.start - SHIFTED, part.stop + SHIFTED) for part in REGION)
INNER = (slice(SHIFTED, -SHIFTED),) * 2
COLOURS = tuple(Channel(name, (nm,), (1.0,)) for name, nm in (("red", 620.0), ("green", 540.0), ("blue", 465.0)))
GREEN, GREEN_UM = 1, 0.54
WAVES = 1.0  # of defocus at either end of the depths
BLUR = Forming(geometry=False)
SLICES = 9  # depths of PSFs on a grid
TIGHTEST = 0.003  # the least tolerance of a scene: a fifth of it is the error of kernels between computed nodes
FINE, FINEST = (4.0, 1.0), (5.0, 1.5)  # samples per λ/(2 NA) and margins of kernels on grids, and of the reference's
QUANTILES = 0.5, 0.95, 1.0
COLUMNS = 5  # of the figure
FARTHEST = 1e5  # focal lengths: what programs that need a finite depth take for infinity


@dataclass(frozen=True)
class BenchCamera:
    """A shipped lens, its focal length and f-number, and the width of a pixel in samples λ/(4 NA)."""

    lens: str
    focal_mm: float
    f_number: float
    samples: int

    @property
    def pixel_um(self) -> float:
        return self.samples * GREEN_UM * self.f_number / 2

    @property
    def middle(self) -> float:
        """Return the vergence in focus, 1/mm: W = D²·Δv/8 is the path that defocus adds at the pupil's rim."""
        return 8 * WAVES * GREEN_UM / 1000 / (self.focal_mm / self.f_number) ** 2

    def scene(self, rtol: float = 0.05, shape: tuple[int, int] = SHAPE) -> Scene:
        sensor = Sensor(*shape, self.pixel_um)
        return Scene(sensor, COLOURS, 1 / (2 * self.middle), inf, rtol, focus_mm=1 / self.middle)

    def plan(self, rtol: float, shape: tuple[int, int] = SHAPE, depth: np.ndarray | None = None) -> Plan:
        """Return the plan of the whole range of depths, or of those of a map alone."""
        scene = self.scene(rtol, shape)
        return plan(find_lens(self.lens), scene if depth is None else scene.at_depths(depth))

    def exact(self, shape: tuple[int, int] = SHAPE) -> Plan:
        """Return kernels in every wavelength, as finely sampled as any plan's; its nodes are not used."""
        made = self.plan(0.005, shape)
        colours = tuple(reduce_spectrum(channel, len(channel.wavelengths_nm)) for channel in COLOURS)
        return replace(made, colours=colours, recipe=Recipe("fitted", made.recipe.numbers, *FINE))


CAMERAS = (
    BenchCamera("achromat_f6", 20.006, 6.0, 5),
    BenchCamera("tessar", 3.998, 4.5, 5),
    BenchCamera("reverse_telephoto", 2.005, 6.684, 4),
)


def picture_of(
    camera: BenchCamera, scene: str, shape: tuple[int, int] = SHAPE, seed: int = 1
) -> tuple[np.ndarray, np.ndarray]:
    """Return colours and depths, mm, of a scene."""
    values, place = SCENES[scene](shape, seed)
    return values, 1 / (place * 2 * camera.middle)


def by_plan(rtol: float, camera: BenchCamera, values: np.ndarray, depth: np.ndarray) -> np.ndarray:
    return form_image(camera.plan(rtol, depth=depth), values, depth, BLUR)


def by_grid(count: int, camera: BenchCamera, values: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Return the picture by ``count``² PSFs at each of SLICES depths, bilinear between them, without symmetry.

    Of close nodes only some are computed, from which the others follow to a fifth of TIGHTEST.
    """
    made, scene = camera.exact(), camera.scene(TIGHTEST)
    beside = replace(scene, sensor=replace(scene.sensor, centre_mm=(1e-9, 0.0)))  # so that no quarter is mirrored
    nodes = tuple(scene.vergences(SLICES).tolist())
    return form_image(replace(made, scene=beside, counts=(count, count), vergences=nodes), values, depth, BLUR)


def by_one_psf(camera: BenchCamera, values: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Return the picture by the PSF of the axis in focus, in each colour."""
    return form_image(replace(camera.exact(), counts=(1, 1), vergences=(camera.middle,)), values, None, BLUR)


def by_gaussian(camera: BenchCamera, values: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Return the picture by Gaussians as wide as diffraction, a pixel and the disc of defocus together, by layers.

    Standard deviations of an axis: c/4 of a disc of diameter c, 1/√12 of a pixel, 0.42 λN of an Airy disc (Zhang,
    Zerubia and Olivo-Marin 2007, whose 0.21 λ/NA it is).
    """
    nodes = camera.scene().vergences(SLICES)
    disc = camera.focal_mm**2 / camera.f_number * np.abs(nodes - camera.middle) * 1000 / camera.pixel_um
    airy = 0.42 * GREEN_UM * camera.f_number / camera.pixel_um
    widths = np.sqrt((disc / 4) ** 2 + airy**2 + 1 / 12)
    light, covered, passing = np.zeros(values.shape), np.zeros((*SHAPE, 1)), np.ones((*SHAPE, 1))
    for layer in map_depths(depth, nodes, SHAPE, int(4 * widths.max())).layers(values):
        planes = np.dstack([layer.colours * layer.opacity[..., None], layer.opacity, layer.hiding])
        blurred = gaussian_filter(planes, (*(widths[layer.number],) * 2, 0), mode="nearest")
        light += passing * blurred[..., :3]
        covered += passing * blurred[..., 3:4]
        passing *= 1 - blurred[..., 4:]
    return light / covered


def by_peer(program: str, python: str, camera: BenchCamera, values: np.ndarray, depth: np.ndarray) -> tuple:
    """Return another program's picture, and the CPU seconds that it says it took."""
    with tempfile.TemporaryDirectory() as folder:
        task, lens, answer = (str(Path(folder) / name) for name in ("task.npz", "lens.zmx", "answer.npz"))
        write_lens(camera.scene().camera(find_lens(camera.lens)), lens)
        np.savez(
            task,
            values=values,
            depth_mm=depth,
            farthest_mm=FARTHEST * camera.focal_mm,
            focus_mm=1 / camera.middle,
            focal_mm=camera.focal_mm,
            pupil_mm=camera.focal_mm / camera.f_number,
            pixel_mm=camera.pixel_um / 1000,
            oversample=camera.samples,
            wavelengths_um=[channel.wavelengths_um[0] for channel in COLOURS],
        )
        script = str(Path(__file__).with_name("image_peers.py"))
        subprocess.run([python, script, program, task, lens, answer], check=True, capture_output=True)
        with np.load(answer) as found:
            return found["picture"], float(found["seconds"])


PLANS = {f"plan, ε = {rtol}": rtol for rtol in (0.1, 0.02, 0.005)}
OURS = {
    "one PSF": by_one_psf,
    "Gaussian of the depth": by_gaussian,
    "9 × 9 PSFs": partial(by_grid, 9),
    "33 × 33 PSFs": partial(by_grid, 33),
    **{name: partial(by_plan, rtol) for name, rtol in PLANS.items()},
}

PEERS = "optiland", "deeplens"


def timed_picture(program: str, python: str | None, camera: BenchCamera, scene: str) -> tuple[np.ndarray, float, float]:
    """Return WIDER of a program's picture, CPU seconds, and MiB beyond the start of the process.

    Of the reference, REGION; of another program, all MiB that its process took.
    """
    values, depth = picture_of(camera, scene)
    if python is not None:
        found, seconds = by_peer(program, python, camera, values, depth)
        return found[WIDER], seconds, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    before, started = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, process_time()
    with using_threads(1):
        found = reference(camera, scene) if program == "reference" else OURS[program](camera, values, depth)[WIDER]
    return found, process_time() - started, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024


def reference(camera: BenchCamera, scene: str) -> np.ndarray:
    """Return REGION of the green picture by every pixel's own kernel."""
    values, depth = picture_of(camera, scene)
    return per_pixel_picture(for_reference(camera), values[..., GREEN], depth, REGION, GREEN)


@cache
def for_reference(camera: BenchCamera, shape: tuple[int, int] = SHAPE) -> Plan:
    made = camera.exact(shape)
    return replace(made, recipe=replace(made.recipe, fineness=FINEST[0], margin=FINEST[1]))


def error_of_reference(camera: BenchCamera, points: int = 4) -> float:
    """Return the largest relative error of the reference's kernels against sums of exact rays at random points."""
    made, random, errors = for_reference(camera), np.random.default_rng(2), []
    sensor = made.scene.sensor
    for _ in range(points):
        depth = float(random.uniform(0, 2 * camera.middle))
        x, y = float(sensor.x_mm(random.uniform(0, SHAPE[1]))), float(sensor.y_mm(random.uniform(0, SHAPE[0])))
        channel = int(random.integers(3))
        points_there = made.kernels(channel, depth).points([x], [y])
        half = points_there.half_widths()
        seen = made.sensor_map(depth)
        exact = reference_kernel(seen, COLOURS[channel], x, y, int(half[0]), sensor.pixel_um)
        errors.append(distance(points_there.kernels(half)[0], exact))
    return max(errors)


def in_fresh_process(work: Callable, *arguments: object) -> object:
    with get_context("fork").Pool(1) as pool:
        return pool.apply(work, arguments)


def keep(path: Path, work: Callable[[], dict[str, object]]) -> None:
    """Store the arrays of the work, unless they are there."""
    if not path.exists():
        np.savez(path, **work())
        print(path.stem, flush=True)


def make_pictures(folder: Path, programs: dict[str, str | None], cameras: Sequence[BenchCamera]) -> None:
    """Store every program's picture of every scene, seconds and MiB; the interpreters of other programs are given."""
    folder.mkdir(parents=True, exist_ok=True)
    for (program, python), scene, camera in product(programs.items(), SCENES, cameras):

        def work(args: tuple = (program, python, camera, scene)) -> dict[str, object]:
            picture, seconds, mib = in_fresh_process(timed_picture, *args)
            return {"picture": picture, "seconds": seconds, "mib": mib}

        keep(path_of(folder, camera, scene, program), work)


def path_of(folder: Path, camera: BenchCamera, scene: str, program: str) -> Path:
    return folder / f"{camera.lens} {scene} {program}.npz".replace(" ", "_")


def stored_pictures(folder: Path) -> dict[tuple[str, str, str], dict[str, np.ndarray]]:
    """Return what the folder holds by program, lens and scene: the picture's region, seconds, mib."""
    found = {}
    for program, camera, scene in product(("reference", *OURS, *PEERS), CAMERAS, SCENES):
        path = path_of(folder, camera, scene, program)
        if path.exists():
            with np.load(path) as each:
                found[program, camera.lens, scene] = dict(each)
    return found


def relative_error(found: dict, program: str, lens: str, scene: str) -> float:
    """Return the error of green in a picture over its reference, both as root sums of squares."""
    truth, green = found["reference", lens, scene]["picture"], found[program, lens, scene]["picture"][..., GREEN]
    return float(np.linalg.norm(green[INNER] - truth) / np.linalg.norm(truth))


def shifted_error(found: dict, program: str, lens: str, scene: str) -> float:
    """Return `relative_error` of the picture in the place where it fits best, up to SHIFTED - 1 pixels away."""
    truth, green = found["reference", lens, scene]["picture"], found[program, lens, scene]["picture"][..., GREEN]
    most = SHIFTED - 1

    def off(places: Sequence[float]) -> np.ndarray:
        return np.ravel(shift(green, places, order=3, mode="nearest")[INNER] - truth)

    start = min(product(range(-most, most + 1), repeat=2), key=lambda places: float(np.linalg.norm(off(places))))
    fitted = least_squares(off, start, bounds=(-most - 0.5, most + 0.5), diff_step=0.01)
    return float(np.linalg.norm(fitted.fun) / np.linalg.norm(truth))


def print_table(found: dict) -> None:
    print(
        "| program | pictures | error, median | worst | shifted to fit, median | CPU, median | most | memory, most |\n"
        + "|---" * 8
        + "|"
    )
    for program in dict.fromkeys(name for name, *_ in found if name != "reference"):
        mine = {tuple(where): each for (name, *where), each in found.items() if name == program}
        compared = [where for where in mine if ("reference", *where) in found]
        errors, fitted = (
            [100 * measure(found, program, *where) for where in compared] for measure in (relative_error, shifted_error)
        )
        seconds, mib = ([float(each[key]) for each in mine.values()] for key in ("seconds", "mib"))
        print(
            f"| {program} | {len(errors)} | {median(errors):.2g} % | {max(errors):.2g} % | {median(fitted):.2g} % | "
            f"{median(seconds):.2g} s | {max(seconds):.2g} s | {max(mib):.0f} MiB |"
        )


def print_plans(found: dict) -> None:
    """Print the plans' errors over ε, and how many pictures other programs make better, and sooner too."""
    compared = [each for each in found if each[0] != "reference" and ("reference", *each[1:]) in found]
    errors = {each: relative_error(found, *each) for each in compared}
    shares = [error / PLANS[name] for (name, *_), error in errors.items() if name in PLANS]
    text = ", ".join(f"{q:.0%} {share:.2f}" for q, share in zip(QUANTILES, np.quantile(shares, QUANTILES), strict=True))
    print(f"{len(shares)} pictures by plans, error / ε: {text}")
    for ours, other in product(PLANS, [name for name in (*OURS, *PEERS) if name not in PLANS]):
        pairs = [((ours, *at), (other, *at)) for name, *at in errors if name == ours and (other, *at) in errors]
        better = [(mine, theirs) for mine, theirs in pairs if errors[theirs] < errors[mine]]
        sooner = sum(float(found[theirs]["seconds"]) < float(found[mine]["seconds"]) for mine, theirs in better)
        print(f"{ours}: {other} better in {len(better)} of {len(pairs)} pictures, in {sooner} of these sooner too")


def save_figure(found: dict, path: Path, lens: str = "achromat_f6", scene: str = "posts") -> None:
    """Save one picture by every program with its error, and below each five times its difference, about grey."""
    import matplotlib.pyplot as plt

    pictures = {name: each["picture"] for (name, *where), each in found.items() if tuple(where) == (lens, scene)}
    truth = pictures.pop("reference")
    shown = {"every pixel's kernel": truth}
    for name, picture in pictures.items():
        shown[f"{name}: {100 * relative_error(found, name, lens, scene):.2g} %"] = picture[*INNER, GREEN]
    figure, axes = plt.subplots(4, COLUMNS, figsize=(2.4 * COLUMNS, 7.2), layout="constrained")
    places = [(axes[row, column], axes[row + 1, column]) for row in (0, 2) for column in range(COLUMNS)]
    for axis in axes.flat:
        axis.set_axis_off()
    for (above, below), (name, picture) in zip(places, shown.items(), strict=False):
        above.imshow(np.clip(picture, 0, 1) ** (1 / 2.2), cmap="gray", vmin=0, vmax=1, interpolation="nearest")
        below.imshow(5 * (picture - truth), cmap="gray", vmin=-0.5, vmax=0.5, interpolation="nearest")
        above.set_title(name, fontsize=9)
    figure.savefig(path, dpi=110)


def print_cameras() -> None:
    for camera in CAMERAS:
        made, error = camera.exact(), error_of_reference(camera)
        print(
            f"{camera.lens}, f/{camera.f_number:.3g}: pixels of {camera.pixel_um:.2f} µm, {made.scene.near_mm:.0f} mm "
            f"to infinity, kernels up to {2 * widest_half(made, made.scene.vergences(2)) + 1}² pixels, error of the "
            f"reference's {error:.2g}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", type=Path, required=True)
    parser.add_argument("--lens", choices=[camera.lens for camera in CAMERAS], action="append")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--figure", type=Path)
    for peer in PEERS:
        parser.add_argument(f"--{peer}")
    asked = parser.parse_args()
    peers = {name: getattr(asked, name) for name in PEERS if getattr(asked, name)}
    cameras = [camera for camera in CAMERAS if camera.lens in (asked.lens or camera.lens)]
    if not asked.table:
        make_pictures(asked.keep, dict.fromkeys(("reference", *OURS)) | peers, cameras)
    found = stored_pictures(asked.keep)
    print_table(found)
    print_plans(found)
    print_cameras()
    if asked.figure:
        save_figure(found, asked.figure)


if __name__ == "__main__":
    main()
