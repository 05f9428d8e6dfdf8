"""What the content of a picture saves: ``python -m tests.benchmarks.content [--quick]``.

Eleven pictures, each planned and formed twice: without regard to content, for all depths between the nearest and the
farthest, ideal pixels, every pixel blurred; and for what it holds: depths that occur, structure, what the sensor's
noise hides, the pixels of a screen, the region in view. Lens: wide_angle_35 at f/8 on 30 mm, 1 to 100 m, focused in the
middle of 1/depth, three colours, ε = 0.05 unless stated. Depth nodes, kernels of all channels that were computed, and
CPU seconds of plan and picture together, the least of two runs, which alternate.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace
from time import process_time
from unittest import mock

import numpy as np

from p2sf.image import form
from p2sf.image.binning import fit_screen
from p2sf.image.form import form_image
from p2sf.image.region import Region
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor
from tests.support.depth_scenes import leaves, posts, stairs
from tests.support.kernel_counts import counted_kernels

LENS, WIDTH_MM, NEAR, FAR, F_NUMBER = "wide_angle_35", 30.0, 1000.0, 1e5, 8.0
MEGAPIXELS, QUICK = 0.5, 0.06
COUNTING = {"full_well": 400.0, "read_noise": 4.0, "bits": 10}

Picture = tuple[np.ndarray, np.ndarray]
"""Colours (rows, columns, 3) and depths, mm, (rows, columns)."""


@dataclass(frozen=True)
class Case:
    """A picture, its tolerance, and of what it holds: a counting sensor, pixels of a screen, a part of its sides."""

    name: str
    picture: Callable[[tuple[int, int]], Picture]
    rtol: float = 0.05
    sensor: dict[str, float] | None = None
    screen: float = 1.0
    view: float = 1.0


@dataclass(frozen=True)
class Figures:
    """Depth nodes, kernels computed, CPU seconds."""

    nodes: int
    kernels: int
    seconds: float


def _texture(shape: tuple[int, int]) -> np.ndarray:
    return np.random.default_rng(0).random((*shape, 3)).astype(np.float32)


def _between(place: np.ndarray) -> np.ndarray:
    """Return depths at parts of 1/depth from far, 0, to near, 1."""
    return 1 / (1 / FAR + place * (1 / NEAR - 1 / FAR))


def _with_places(made: tuple[np.ndarray, np.ndarray]) -> Picture:
    return made[0], _between(made[1])


def two_depths(shape: tuple[int, int]) -> Picture:
    """Return textures in two depths."""
    return _texture(shape), np.where(np.arange(shape[1]) < shape[1] // 2, NEAR, FAR) * np.ones((shape[0], 1))


def two_ranges(shape: tuple[int, int]) -> Picture:
    """Return a floor close by and a far range, with a gap between them."""
    part = np.linspace(0, 1, shape[0])[:, None] * np.ones(shape[1])
    return _texture(shape), _between(np.where(part > 0.6, 0.85 + 0.375 * (part - 0.6), 0.1 * part))


def slope(shape: tuple[int, int]) -> Picture:
    """Return a floor with all depths."""
    return _texture(shape), _between(np.linspace(0, 1, shape[0])[:, None] * np.ones(shape[1]))


def studio(shape: tuple[int, int]) -> Picture:
    """Return a ball with texture before an even background."""
    row, column = np.indices(shape)
    ball = np.hypot(row - shape[0] / 2, column - shape[1] / 2) < shape[0] / 4
    return np.where(ball[..., None], _texture(shape), np.float32(0.7)), np.where(ball, NEAR, FAR)


def sky(shape: tuple[int, int]) -> Picture:
    """Return a floor below a sky that grows brighter downwards."""
    part = np.linspace(0, 1, shape[0])[:, None] * np.ones(shape[1])
    light = (0.6 + 0.1 * part)[..., None] * np.array([0.6, 0.8, 1.0], np.float32)
    below = part > 0.6
    colours = np.where(below[..., None], _texture(shape), light).astype(np.float32)
    return colours, _between(np.where(below, (part - 0.6) / 0.4, 0.0))


def night(shape: tuple[int, int]) -> Picture:
    """Return lamps in darkness."""
    random, values = np.random.default_rng(1), np.zeros((*shape, 3), np.float32)
    rows, columns = (random.integers(n // 3, n // 2, 40) for n in shape)
    values[rows, columns] = 1.0
    return values, np.full(shape, FAR)


CASES = (
    Case("two depths", two_depths),
    Case("stairs, twelve depths", lambda shape: _with_places(stairs(shape))),
    Case("leaves, ten depths", lambda shape: _with_places(leaves(shape))),
    Case("posts, five depths", lambda shape: _with_places(posts(shape))),
    Case("two ranges with a gap", two_ranges),
    Case("studio", studio),
    Case("floor and sky", sky),
    Case("night", night),
    Case("floor, 400 electrons, ε = 0.005", slope, 0.005, COUNTING),
    Case("floor, a third of the pixels a side", slope, screen=1 / 3),
    Case("floor, a quarter a side in view", slope, view=0.25),
)


def run(case: Case, shape: tuple[int, int], content: bool) -> tuple[Figures, np.ndarray]:
    """Return figures and picture, planned and formed for its content or without regard to it."""
    values, depth = case.picture(shape)
    sensor = Sensor(*shape, 1000 * WIDTH_MM / shape[1], **(case.sensor or {}) if content else {})
    scene = Scene(
        sensor, near_mm=NEAR, far_mm=FAR, rtol=case.rtol, f_number=F_NUMBER, focus_mm=2 / (1 / NEAR + 1 / FAR)
    )
    region, flat = None, form.FLAT if content else -1.0
    with counted_kernels() as numbers, mock.patch.object(form, "FLAT", flat):
        begun = process_time()
        if content:
            scene, values, depth = fit_screen(scene, values, depth, round(case.screen * shape[1]))
            scene = scene.at_depths(depth)
            rows, columns = (round(case.view * n) for n in values.shape[:2])
            region = Region(0, rows, 0, columns)
        made = plan(find_lens(LENS), scene)
        formed = form_image(made, values, depth, region=region)
        spent = process_time() - begun
    return Figures(len(made.vergences), len(made.colours) * sum(numbers), spent), formed


def compare(case: Case, shape: tuple[int, int], rounds: int = 2) -> tuple[Figures, Figures]:
    """Return the figures without regard to content, and for it."""
    every = [[run(case, shape, content)[0] for content in (False, True)] for _ in range(rounds)]
    plain, held = zip(*every, strict=True)
    return tuple(replace(each[0], seconds=min(one.seconds for one in each)) for each in (plain, held))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} megapixels in place of {MEGAPIXELS}")
    columns = round((1.5e6 * (QUICK if parser.parse_args().quick else MEGAPIXELS)) ** 0.5)
    shape = round(columns / 1.5), columns
    run(CASES[0], shape, True)  # what is kept of the lens
    print(
        f"{shape[1]} × {shape[0]} pixels\n| picture | depth nodes | kernels | seconds | times |\n|---|---|---|---|---|"
    )
    for case in CASES:
        plain, held = compare(case, shape)
        print(
            f"| {case.name} | {plain.nodes} → {held.nodes} | {plain.kernels} → {held.kernels} | "
            f"{plain.seconds:.2f} → {held.seconds:.2f} | {plain.seconds / held.seconds:.1f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
