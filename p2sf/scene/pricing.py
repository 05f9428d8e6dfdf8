"""How much a plan computes, and how much a person without one would."""

from math import ceil

import numpy as np

from p2sf.pixel_kernels import Recipe
from p2sf.pixel_kernels.pixels import samples_across
from p2sf.scene.cost import Work, pupil_seconds
from p2sf.scene.sharing import node_heights
from p2sf.scene.study import RUNGS, Study

NAIVE_FINENESS, NAIVE_MARGIN = 2.0, 0.5  # every fringe of the light (λ/4NA), and half a window against what folds over


def dearest_method(rings) -> int:
    """Return the dearest method of (rim, method) pairs: the cheapest that holds at the worst place."""
    return max(method for _, method in rings)


def method_seconds(method: int) -> float:
    """Return what one pupil of a method costs, seconds."""
    method, numbers = RUNGS[method]
    return pupil_seconds(method, numbers or 6)


def single_seconds(study: Study, rings, counts, layers: int, waves: int) -> float:
    """Return the seconds of fitting each height of each layer by its own ring's method."""
    rims = np.array([rim for rim, _ in rings])
    heights = node_heights(study.scene.sensor, counts)
    which = np.minimum(np.searchsorted(rims, heights), len(rims) - 1)
    return layers * waves * float(sum(method_seconds(rings[n][1]) for n in which))


def plan_work(study: Study, rings, colours, counts, layers: int, pupil_cost: float) -> Work:
    """Return the plan's work; ``rings`` hold (rim, recipe)."""
    sensor = study.scene.sensor
    nodes = ceil(counts[0] / 2) * ceil(counts[1] / 2) if sensor.centred else counts[0] * counts[1]
    halves, sides = _widths(study, rings)
    kernels = nodes * layers * sum(len(colour.wavelengths_um) for colour in colours)
    side = float(np.sqrt(np.mean(np.square(sides))))
    return Work(kernels, side, pupil_cost, int(halves.max()), *_picture(study, len(colours), counts, layers))


def naive_work(study: Study, rings, counts, layers: int) -> Work:
    """Return the work of the full grid, what a person would compute without a plan for the same error.

    One method everywhere, the cheapest that holds at the worst place, its own rays for every PSF; depth × rows ×
    columns × every wavelength, as dense all over as the worst place asks; every fringe; one window, that of the widest
    blur; nothing from symmetry.
    """
    scene, recipe = study.scene, naive_recipe(rings)
    halves, sides = _widths(study, [(rim, recipe) for rim, _ in rings])
    kernels = counts[0] * counts[1] * layers * sum(len(channel.wavelengths_nm) for channel in scene.channels)
    cost = kernels * pupil_seconds(recipe.method, recipe.numbers or 6)
    picture = _picture(study, len(scene.channels), counts, layers)
    return Work(kernels, float(sides.max()), cost, int(halves.max()), *picture)


def naive_recipe(rings) -> Recipe:
    """Return the recipe of the full grid: the dearest method of (rim, recipe) pairs, all terms, every fringe."""
    dearest = max((recipe for _, recipe in rings), key=lambda recipe: recipe.numbers or 0)
    return Recipe(dearest.method, dearest.numbers, NAIVE_FINENESS, NAIVE_MARGIN)


def _picture(study: Study, channels: int, counts, layers: int):
    sensor = study.scene.sensor
    return sensor.rows, sensor.columns, channels, counts, layers


def _widths(study: Study, rings):
    """Return half widths and transform sides at the rings' rims over all depths, pixels and samples."""
    pixel, halves, sides = study.scene.sensor.pixel_um, [], []
    for vergence in study.depths(study.reference_um):
        kernels = study.kernels(study.recipe(), study.single, vergence)
        for rim, recipe in rings:
            half, (pupil, _) = kernels.half_width(rim), kernels.pupils(rim)[0]
            halves.append(half)
            sides.append((2 * (half + ceil(half * recipe.margin)) + 1) * samples_across(pupil, pixel, recipe.fineness))
    return np.array(halves), np.array(sides)
