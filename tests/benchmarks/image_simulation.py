"""What the defaults of image simulation cost: the same pictures by several programs, beside the kernel of every pixel.

``python -m tests.benchmarks.image_simulation --keep FOLDER [--optiland PYTHON] [--deeplens PYTHON] [--figure FILE]``

Twelve pictures of 160 × 240 pixels, four scenes with depth (`tests.support.depth_scenes`) through three shipped lenses,
in three wavelengths; distortion and illumination are left out. The lens is in focus in the middle of 1/depth, and
either end is a wave out of focus. A pixel is some samples λ/(4 NA) wide, so that optiland's PSFs fit. Errors are those
of a part of 24 × 32 pixels on the way to the corner, relative to the picture in which every pixel has its own kernel
(`tests.support.per_pixel`); times are CPU seconds of a fresh process, kernels and picture, on one thread; memory is
what the process takes beyond its start. PYTHON is the interpreter of an environment that has the program; without it
the program is left out. What is in FOLDER already is not computed again.
"""

import argparse
import resource
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from math import inf
from multiprocessing import get_context
from pathlib import Path
from statistics import median
from time import process_time

import numpy as np
from scipy.ndimage import gaussian_filter

from p2sf import write_lens
from p2sf.image import Forming, form_image
from p2sf.image.layers import map_depths
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels import Recipe
from p2sf.scene import Channel, Plan, Scene, Sensor, plan
from p2sf.scene.planning.reference import reference_kernel
from p2sf.scene.planning.study import distance
from p2sf.scene.spectrum import reduce_spectrum
from p2sf.threads import using_threads
from tests.support.depth_scenes import SCENES
from tests.support.per_pixel import per_pixel_picture, widest_half

SHAPE = 160, 240
REGION = slice(24, 48), slice(28, 60)
COLOURS = tuple(Channel(name, (nm,), (1.0,)) for name, nm in (("red", 620.0), ("green", 540.0), ("blue", 465.0)))
GREEN_UM = 0.54
WAVES = 1.0  # of defocus at either end of the depths
BLUR = Forming(geometry=False)
SLICES = 9  # depths of PSFs on a grid
FINE, FINEST = (4.0, 1.0), (5.0, 1.5)  # samples per λ/(2 NA) and margins of kernels on grids, and of the reference's
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

    def scene(self, rtol: float = 0.05) -> Scene:
        sensor = Sensor(*SHAPE, self.pixel_um)
        return Scene(sensor, COLOURS, 1 / (2 * self.middle), inf, rtol, focus_mm=1 / self.middle)

    def plan(self, rtol: float) -> Plan:
        return plan(find_lens(self.lens), self.scene(rtol))

    def exact(self) -> Plan:
        """Return kernels in every wavelength, as finely sampled as any plan's; its nodes are not used."""
        made = self.plan(0.005)
        colours = tuple(reduce_spectrum(channel, len(channel.wavelengths_nm)) for channel in COLOURS)
        return replace(made, colours=colours, recipe=Recipe("fitted", made.recipe.numbers, *FINE))


CAMERAS = (
    BenchCamera("achromat_f6", 20.006, 6.0, 5),
    BenchCamera("tessar", 3.998, 4.5, 5),
    BenchCamera("reverse_telephoto", 2.005, 6.684, 4),
)


def picture_of(camera: BenchCamera, scene: str) -> tuple[np.ndarray, np.ndarray]:
    """Return colours and depths, mm, of a scene."""
    values, place = SCENES[scene](SHAPE, 1)
    return values, 1 / (place * 2 * camera.middle)


def by_plan(rtol: float, camera: BenchCamera, values: np.ndarray, depth: np.ndarray) -> np.ndarray:
    return form_image(camera.plan(rtol), values, depth, BLUR)


def by_grid(count: int, camera: BenchCamera, values: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Return the picture by ``count``² PSFs at each of SLICES depths, bilinear between them, without symmetry."""
    made, scene = camera.exact(), camera.scene()
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


OURS = {
    "one PSF": by_one_psf,
    "Gaussian of the depth": by_gaussian,
    "9 × 9 PSFs": partial(by_grid, 9),
    "33 × 33 PSFs": partial(by_grid, 33),
    **{f"plan, ε = {rtol}": partial(by_plan, rtol) for rtol in (0.1, 0.02, 0.005)},
}


def timed_picture(program: str, python: str | None, camera: BenchCamera, scene: str) -> tuple[np.ndarray, float, float]:
    """Return REGION of a program's picture, CPU seconds, and MiB beyond the start of the process."""
    values, depth = picture_of(camera, scene)
    if python is not None:
        found, seconds = by_peer(program, python, camera, values, depth)
        return found[REGION], seconds, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    before, started = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, process_time()
    with using_threads(1):
        found = reference(camera, scene) if program == "reference" else OURS[program](camera, values, depth)[REGION]
    return found, process_time() - started, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024


def reference(camera: BenchCamera, scene: str) -> np.ndarray:
    """Return REGION of the picture by every pixel's own kernel."""
    values, depth = picture_of(camera, scene)
    return per_pixel_picture(for_reference(camera), values, depth, REGION)


def for_reference(camera: BenchCamera) -> Plan:
    made = camera.exact()
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


def kept(folder: Path, name: str, work: Callable[[], dict[str, object]]) -> dict[str, np.ndarray]:
    """Return stored arrays, or those of the work, which are stored."""
    path = folder / (name.replace(" ", "_").replace("/", "_") + ".npz")
    if not path.exists():
        np.savez(path, **work())
        print(name, "done", flush=True)
    with np.load(path) as found:
        return dict(found)


def all_pictures(folder: Path, peers: dict[str, str]) -> dict[tuple[str, str, str], dict[str, np.ndarray]]:
    """Return by lens, scene and program: the picture's region, seconds, mib; program "reference" among them."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {}
    for program, python in ({"reference": None} | dict.fromkeys(OURS) | peers).items():
        for camera, scene in product(CAMERAS, SCENES):

            def work(args: tuple = (program, python, camera, scene)) -> dict[str, object]:
                picture, seconds, mib = in_fresh_process(timed_picture, *args)
                return {"picture": picture, "seconds": seconds, "mib": mib}

            found[camera.lens, scene, program] = kept(folder, f"{camera.lens} {scene} {program}", work)
    return found


def relative_errors(found: dict, program: str) -> list[float]:
    """Return the error of each picture over its reference, both as root sums of squares."""
    return [
        float(
            np.linalg.norm(found[lens, scene, program]["picture"] - each["picture"]) / np.linalg.norm(each["picture"])
        )
        for (lens, scene, name), each in found.items()
        if name == "reference"
    ]


def print_table(found: dict) -> None:
    print("| program | error, median | worst | CPU, median | most | memory, most |\n|---|---|---|---|---|---|")
    for program in dict.fromkeys(name for *_, name in found if name != "reference"):
        errors = relative_errors(found, program)
        mine = [each for (*_, name), each in found.items() if name == program]
        seconds, mib = [float(each["seconds"]) for each in mine], max(float(each["mib"]) for each in mine)
        print(
            f"| {program} | {100 * median(errors):.2g} % | {100 * max(errors):.2g} % | {median(seconds):.2g} s | "
            f"{max(seconds):.2g} s | {mib:.0f} MiB |"
        )


def save_figure(found: dict, path: Path, lens: str = "achromat_f6", scene: str = "leaves") -> None:
    """Save one picture by every program, and below each five times its error."""
    import matplotlib.pyplot as plt

    names = [name for *where, name in found if tuple(where) == (lens, scene)]
    truth = found[lens, scene, "reference"]["picture"]
    figure, axes = plt.subplots(2, len(names), figsize=(1.7 * len(names), 2.9), layout="constrained")
    for (above, below), name in zip(axes.T, names, strict=True):
        picture = found[lens, scene, name]["picture"]
        above.imshow(np.clip(picture, 0, 1) ** (1 / 2.2), interpolation="nearest")
        below.imshow(np.clip(0.5 + 5 * (picture - truth), 0, 1), interpolation="nearest")
        above.set_title(name, fontsize=7)
        for axis in (above, below):
            axis.set_axis_off()
    figure.savefig(path, dpi=110)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", type=Path, required=True)
    parser.add_argument("--optiland")
    parser.add_argument("--deeplens")
    parser.add_argument("--figure", type=Path)
    asked = parser.parse_args()
    peers = {name: getattr(asked, name) for name in ("optiland", "deeplens") if getattr(asked, name)}
    found = all_pictures(asked.keep, peers)
    print_table(found)
    for camera in CAMERAS:
        made, error = camera.exact(), error_of_reference(camera)
        print(
            f"{camera.lens}, f/{camera.f_number:.3g}: pixels of {camera.pixel_um:.2f} µm, {made.scene.near_mm:.0f} mm "
            f"to infinity, kernels up to {2 * widest_half(made, made.scene.vergences(2)) + 1}² pixels, error of the "
            f"reference's {error:.2g}"
        )
    if asked.figure:
        save_figure(found, asked.figure)


if __name__ == "__main__":
    main()
