"""The work of a plan, and that of the full grid without a plan."""

from collections.abc import Sequence
from math import ceil, prod

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.paraxial.seidel import reason_against_coefficients
from p2sf.pixel_kernels.channel import Colour, Recipe
from p2sf.scene.planning.bounds import transforms
from p2sf.scene.planning.cost import ALONE_SECONDS, TOGETHER_SECONDS, Work, pupil_seconds
from p2sf.scene.planning.study import Study
from p2sf.scene.scene import Scene

NAIVE_FINENESS, NAIVE_MARGIN = 2.0, 0.5  # every fringe of the light (λ/4NA), and half a window against aliasing


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
    fits = 0.0 if study.table else kernels * pupil_seconds(recipe.method, recipe.numbers or 6)
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
    cost = kernels * pupil_seconds(method, recipe.numbers or 6)
    picture = scene.sensor.rows, scene.sensor.columns, len(scene.channels), counts, layers
    return Work(kernels, float(sides.max()), ALONE_SECONDS, cost, int(halves.max()), *picture)


def naive_recipe(recipe: Recipe) -> Recipe:
    """Return the recipe of the full grid: the plan's method, every fringe."""
    return Recipe(recipe.method, recipe.numbers, NAIVE_FINENESS, NAIVE_MARGIN)


def _widths(study: Study, recipe: Recipe) -> tuple[np.ndarray, np.ndarray]:
    """Return half widths (pixels) and transform sides (samples) in the corner, at the ends and the sharpest depths."""
    return transforms(*study.of_corner, study.scene.sensor.pixel_um, (recipe.fineness, recipe.margin))
