"""The work of a plan, that of the full grid without a plan, and their cost by `pupil.cost`."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, prod

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.paraxial.seidel import reason_against_coefficients
from p2sf.pixel_kernels.channel import Colour, Recipe
from p2sf.pupil.cost import convolution_seconds, fit_seconds, transform_seconds
from p2sf.scene.planning.bounds import transforms
from p2sf.scene.planning.study import Study
from p2sf.scene.scene import Scene

ALONE_SECONDS, TOGETHER_SECONDS = 6e-4, 1e-4  # of any kernel: rotation of its pupil, summation; alone, among many
TRANSFORMS = 2  # pairs, forward and inverse, of a block with four corners
BLOCK = 256  # pixels along a block at most
TILE = 1024  # pixels a side of what is formed at a time: larger ones share more, and take more memory
HELD_PLANES = 20  # of tiles, by two threads
MOST_KERNELS = 2**26  # numbers of kernels that are kept
BYTES = 4
NAIVE_FINENESS, NAIVE_MARGIN = 2.0, 0.5  # every fringe of the light (λ/4NA), and half a window against aliasing


@dataclass(frozen=True)
class Work:
    """Amount of work: ``kernels`` of single wavelengths, each by a ``side``² transform; patches and pixels.

    ``each_seconds``: of any kernel in addition to its transform. ``pupil_seconds``: of all fits of pupils together.
    ``half``: pixels on either side of the centre of a kernel.
    """

    kernels: float
    side: float
    each_seconds: float
    pupil_seconds: float
    half: int
    rows: int
    columns: int
    channels: int
    nodes: tuple[int, int]
    layers: int


@dataclass(frozen=True)
class Cost:
    """Predicted seconds on one core, for the kernels and for one picture, and bytes at the peak."""

    kernel_seconds: float
    picture_seconds: float
    memory_bytes: float

    @property
    def seconds(self) -> float:
        """Return seconds for kernels and one picture together."""
        return self.kernel_seconds + self.picture_seconds


def predicted_cost(work: Work) -> Cost:
    """Return the cost of an amount of work."""
    kernel = work.each_seconds + transform_seconds(work.side)
    blocks, area = _blocks(work)
    planes, layers = work.channels + (work.layers > 1), min(work.layers, 2)  # a pixel lies between two nodes of depth
    picture = TRANSFORMS * blocks * planes * layers * convolution_seconds(area)
    tile = prod(min(TILE, n) + 2 * work.half for n in (work.rows, work.columns))
    held = 2 * work.rows * work.columns * (work.channels + (work.layers > 1)) + HELD_PLANES * tile * planes
    kernels = min(work.nodes[0] * work.nodes[1] * planes * work.layers * (2 * work.half + 1) ** 2, MOST_KERNELS)
    return Cost(work.pupil_seconds + work.kernels * kernel, picture, BYTES * (held + kernels) + 8 * 3 * work.side**2)


def _blocks(work: Work) -> tuple[int, float]:
    """Return how many blocks between nodes a picture is cut into, and the area of each with the width of a kernel."""
    counts = [max(n - 1, ceil(pixels / BLOCK)) for n, pixels in zip(work.nodes, (work.rows, work.columns), strict=True)]
    sides = (pixels / count + 2 * work.half for pixels, count in zip((work.rows, work.columns), counts, strict=True))
    return prod(counts), prod(sides)


def mirrored(lens: Lens, scene: Scene) -> bool:
    """Return whether one quarter of a scene's kernels determines the others as mirror images."""
    return scene.sensor.centred and lens.mask.quartered and not lens.misaligned


def computed_counts(counts: tuple[int, int], mirrored: bool) -> tuple[int, int]:
    """Return the number of kernel nodes computed along rows and columns; if ``mirrored``, a quarter of all."""
    rows, columns = counts
    return ceil(rows / (1 + mirrored)), ceil(columns / (1 + mirrored))


def plan_work(study: Study, recipe: Recipe, colours: Sequence[Colour], counts: tuple[int, int], layers: int) -> Work:
    """Return the work of the plan; its pupils were fitted during planning, unless each is fitted separately."""
    sensor, waves = study.scene.sensor, sum(len(colour.wavelengths_um) for colour in colours)
    nodes = prod(computed_counts(counts, mirrored(study.lens, study.scene)))
    halves, sides = _widths(study, recipe)
    kernels, side = nodes * layers * waves, float(np.sqrt(np.mean(np.square(sides))))
    fits = 0.0 if study.table else kernels * fit_seconds(recipe.method, recipe.numbers or 6)
    picture = sensor.rows, sensor.columns, len(colours), counts, layers
    return Work(kernels, side, TOGETHER_SECONDS, fits, int(halves.max()), *picture)


def naive_work(study: Study, recipe: Recipe, counts: tuple[int, int], layers: int) -> Work:
    """Return the work of the full grid that would be necessary for the same error without a plan.

    One method everywhere, six coefficients where the lens has them, lest the grid be priced too high, with separate
    rays for every PSF; depth × rows × columns × every wavelength, everywhere as dense as the worst point requires;
    every fringe; one window, that of the widest blur; no use of symmetry.
    """
    scene, recipe = study.scene, naive_recipe(recipe)
    halves, sides = _widths(study, recipe)
    kernels = counts[0] * counts[1] * layers * sum(len(channel.wavelengths_nm) for channel in scene.channels)
    method = recipe.method if reason_against_coefficients(study.lens) else "seidel"
    cost = kernels * fit_seconds(method, recipe.numbers or 6)
    picture = scene.sensor.rows, scene.sensor.columns, len(scene.channels), counts, layers
    return Work(kernels, float(sides.max()), ALONE_SECONDS, cost, int(halves.max()), *picture)


def naive_recipe(recipe: Recipe) -> Recipe:
    """Return the recipe of the full grid: the plan's method, every fringe."""
    return Recipe(recipe.method, recipe.numbers, NAIVE_FINENESS, NAIVE_MARGIN)


def _widths(study: Study, recipe: Recipe) -> tuple[np.ndarray, np.ndarray]:
    """Return half widths (pixels) and transform sides (samples) in the corner, at the ends and the sharpest depths."""
    return transforms(*study.of_corner, study.scene.sensor.pixel_um, (recipe.fineness, recipe.margin))
